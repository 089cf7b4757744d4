"""A toss is the same, to the bit, however it is made: ways to toss against situations, on both engines."""

from dataclasses import replace
from functools import cache, partial
from itertools import product

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.analytic.by_rows import CERTAIN, IMPACT, NO_TRUST, PIECE
from cointoss.analytic.entries import sample_path, toss_apart, toss_each, toss_one, toss_rows
from cointoss.analytic.settings import contact_limits
from cointoss.coin_mj import Friction, Realisation
from cointoss.models.answers import ANSWER, REFUSED, unanswered
from cointoss.models.batch import rows_of as many_rows
from cointoss.models.body import NO_CODE
from cointoss.models.fields import FIELDS
from cointoss.models.laws import ContactLaw, RestitutionKind
from cointoss.models.rows import row_of
from tests.helpers.bits import cases
from tests.helpers.mirror import Mirror

pytestmark = pytest.mark.filterwarnings("ignore::cointoss.models.records.ApproximationWarning")

CASES = cases()
ENGINES = {
    "analytic": (analytic, analytic.MANY),
    "analytic, coarse": (analytic, analytic.AnalyticSettings(contact_tolerance=1e-6, contact_steps=2000)),
} | {
    f"mujoco, {contact}, {friction}": (coin_mj, replace(coin_mj.MANY, contact=contact, friction=friction))
    for contact, friction in product(Realisation, Friction)
}
REALISED = (ContactLaw.SMOOTH, ContactLaw.COULOMB, ContactLaw.PERFECTLY_ROUGH)


def is_tossed(package, settings, floor):
    """Return whether an engine tosses on a floor: MuJoCo by three laws; its cone resists no rolling."""
    is_resisted = floor.rolling_friction > 0 or floor.contour_friction > 0
    kinematic = floor.restitution_kind == RestitutionKind.KINEMATIC
    realised = floor.contact in REALISED and kinematic
    return package is analytic or (realised and not (is_resisted and settings.friction == Friction.NATIVE))


TOSSED = {
    engine: [name for name, case in CASES.items() if is_tossed(*how, case.floor)]
    for engine, how in ENGINES.items()
}
"""The situations that an engine tosses."""
LIMITS = contact_limits(analytic.MANY)
LATER = 0.3
"""How long a coin is followed after its toss [s]."""


@cache
def toss_of(engine, name, later=None):
    """Return a toss by itself; with `later`, one that is followed on for that time [s]."""
    package, settings = ENGINES[engine]
    followed = () if later is None else ("ending.until", toss_of(engine, name).end_time + later)
    return package.toss(CASES[name].replace("gravity", CASES[name].gravity, *followed), settings=settings)


def answer_of(toss):
    """Return what many tosses say of one."""
    faces = [0, *toss.impacts.face.tolist()]
    ended = [toss.outcome, toss.ending, len(faces) - 1, faces[-1], toss.end_time]
    return [*ended, toss.trusted_impacts, toss.outcome_certain]


@cache
def answers_of(engine, seed, workers, trust):
    """Return what is said of all situations, tossed together in an order of their own, by name."""
    (package, settings), names = ENGINES[engine], TOSSED[engine]
    names = names if seed is None else np.random.default_rng(seed).permutation(names).tolist()
    rows = np.array([row_of(CASES[name]) for name in names])
    answers = package.toss_rows(rows, settings=settings, workers=workers, trust=trust)
    columns = (column.tolist() for column in answers if column is not None)
    return dict(zip(names, map(list, zip(*columns, strict=True)), strict=True))


def together(engine, name, seed=None, workers=1, trust=None):
    found = answers_of(engine, seed, workers, trust)[name]
    return found, answer_of(toss_of(engine, name))[: len(found)]


def by_entry(toss, engine, name):
    """Toss it before and after the same coin thrown from higher, a heavier one, and one that is none."""
    case, answers = CASES[name], unanswered(5)
    others = case.replace("release.position.z", 0.7), case.replace("coin.mass", 0.05), case
    rows = np.array([row_of(each) for each in (case, *others, case)])
    rows[3, 0] = np.nan if toss is on_page else rows[3, 0]
    toss(rows, answers)
    assert (answers[3, 0] == REFUSED) == (toss is on_page)
    return answers[[0, 4]].tolist(), [answer_of(toss_of(engine, name))] * 2


def side_by_side(_, name):
    """Toss it with others of its coin, whose contacts go side by side, on two floors; and each by itself."""
    changed = {"release.position.z": CASES[name].release.position[2] * np.linspace(1, 1.3, 30)}
    rows = many_rows(CASES[name], 30, changed | {"floor.friction": np.repeat([0.0, 0.3, 0.3], 10)})
    answers = unanswered(30), unanswered(30)
    toss_rows(rows, NO_CODE, LIMITS, NO_TRUST, answers[0])
    toss_apart(rows, answers[1], LIMITS, NO_TRUST)
    return answers[0].tolist(), answers[1].tolist()


def on_page(rows, answers):
    toss_each(rows, CERTAIN, answers)


def rows_of(states):
    """Return states as rows, (n, 13)."""
    return np.hstack([states.position, states.velocity, states.quaternion, states.angular_velocity])


def by_numbers(engine, name):
    """Toss as a page does, with impacts and path, and follow it on."""
    followed = toss_of(engine, name, LATER)
    row, answer, sizes = row_of(followed.scenario), np.empty(len(ANSWER)), np.empty(2)
    impacts, pieces = np.empty((300, len(IMPACT))), np.empty((300, PIECE))
    toss_one(row, answer, impacts, pieces, sizes)
    times = np.sort(np.append(np.linspace(0, followed.path_end, 40)[:-1], followed.contacts[:, 0]))
    states, more = np.empty((len(times), 13)), np.empty((len(times), 4))
    sample_path(row, pieces[: int(sizes[1])].copy(), times, states, more)
    struck, started = followed.impacts, followed.path.started
    modes = np.column_stack([started.times, started.modes, started.states])
    due = np.column_stack([struck.time, struck.face, struck.energy, struck.impulse])
    count, k = sizes.astype(int)
    found = [answer, impacts[:count], pieces[:k], states, more[:, 1:]]
    path = [modes, rows_of(followed.sample(times)), followed.floor_force(times)]
    return [each.tolist() for each in found], [answer_of(followed), *(each.tolist() for each in (due, *path))]


def followed_on(engine, name):
    """Compare a toss that is followed on with the toss: what is said of it, and its path up to its end."""
    tosses = toss_of(engine, name), toss_of(engine, name, LATER)
    before = np.linspace(0, tosses[0].end_time, 60)[:-1]
    return [
        [answer_of(toss), toss.trust_end, toss.certificate, toss.contacts.tolist()]
        + [column.tolist() for column in vars(toss.impacts).values()]
        + [rows_of(toss.sample(before)).tolist()]
        for toss in tosses
    ]


def at_times(engine, name):
    """Compare states and forces of a path at times in disorder with those at one time after the other."""
    toss = toss_of(engine, name, LATER)
    times = np.concatenate([toss.contacts.ravel(), np.linspace(0, toss.path_end, 20)])
    times = np.random.default_rng(3).permutation(times)
    found = np.hstack([rows_of(toss.sample(times)), toss.floor_force(times)])
    due = [np.hstack([rows_of(toss.sample(time)), toss.floor_force(time)])[0] for time in times]
    return found.tolist(), np.array(due).tolist()


def mirrored(mirror, engine, name):
    """Compare the image of a toss, mirrored back, with the toss; certainty may hang on the last digit."""
    toss, image, back = toss_of(engine, name), analytic.toss(mirror.scenario(CASES[name])), mirror.signs
    return [
        [outcome, each.ending, each.end_time, faces, each.contacts.tolist()]
        + [(sign * getattr(each.impacts, column)).tolist() for column, sign in signs.items()]
        for each, outcome, faces, signs in (
            (image, mirror.outcome(image.outcome), mirror.sequence(image.sequence), back),
            (toss, toss.outcome, toss.sequence, dict.fromkeys(back, 1)),
        )
    ]


WAYS = {
    "one after the other": together,
    "mixed, by three threads": partial(together, seed=1, workers=3),
    "by five threads": partial(together, workers=5),
    "with its horizon": partial(together, trust="impacts"),
    "with its certainty": partial(together, seed=2, trust="certain"),
    "by the entry of many": partial(by_entry, lambda rows, to: toss_rows(rows, NO_CODE, LIMITS, CERTAIN, to)),
    "by the entry of cards": partial(by_entry, lambda rows, to: toss_apart(rows, to, LIMITS, CERTAIN)),
    "by the entry of pages": partial(by_entry, on_page),
    "side by side": side_by_side,
    "by numbers": by_numbers,
    "followed on": followed_on,
    "at any times": at_times,
    "mirrored in eta": partial(mirrored, Mirror.ETA),
    "mirrored in zeta": partial(mirrored, Mirror.ZETA),
}
BY_ALL = ("one after the other", "mixed, by three threads", "followed on", "at any times")
LINEAR_ALONE = ("by the entry of cards", "side by side", "mirrored in eta", "mirrored in zeta")
"""Ways for air that is linear in the velocity."""
USUAL = ("analytic, coarse", "mujoco, spring, explicit")


def marks_of(way, engine, name):
    """Mark what takes long: MuJoCo's settings, its paths and coarse ones, quadratures but once."""
    is_dear = way in ("followed on", "at any times") if engine in USUAL else engine != "analytic"
    return pytest.mark.slow if is_dear or (CASES[name].air.exponent and way != "one after the other") else []


TABLE = [
    pytest.param(way, engine, name, marks=marks_of(way, engine, name))
    for engine in ENGINES
    for way in (WAYS if engine == "analytic" else BY_ALL if engine in USUAL else BY_ALL[:1])
    for name in TOSSED[engine]
    if way not in LINEAR_ALONE or CASES[name].air.exponent == 0
]


@pytest.mark.parametrize(("way", "engine", "name"), TABLE)
def test_a_toss_is_the_same_to_the_bit(way, engine, name):
    found, due = WAYS[way](engine, name)
    assert found == due


@pytest.mark.parametrize("engine", ["analytic", "mujoco, spring, explicit"])
def test_no_rows_give_no_answers(engine):
    answers = ENGINES[engine][0].toss_rows(np.empty((0, len(FIELDS))))
    assert {len(column) for column in answers if column is not None} == {0}
    assert answers.after(0).shape == (0,)
