"""No side is preferred: mirror images of tosses are tosses, and one that is its own is certain of no face."""

from itertools import product

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.engines import Engine
from cointoss.models.batch import rows_from_states
from cointoss.models.laws import ContactLaw
from cointoss.models.records import Outcome
from tests.helpers import engines
from tests.helpers.draws import AIR, IMPERFECT, THIN, ZLOTY, draw_release, scenario
from tests.helpers.many import as_states
from tests.helpers.mirror import SPACE, Mirror
from tests.helpers.symmetries import SYMMETRIES

COINS = {
    "thin": THIN,
    "thick": ZLOTY,
    "stout": {**ZLOTY, "thickness": 1.2e-2},
    "imperfect": IMPERFECT,
    "of any inertia": {
        **IMPERFECT,
        "inertia": [[1.1e-7, 6e-9, -3e-9], [6e-9, 9e-8, 4e-9], [-3e-9, 4e-9, 1.6e-7]],
    },
}
FLOORS = {
    **{str(law): {"contact": str(law)} for law in ContactLaw},
    "energetic": {"contact": "coulomb", "restitution_kind": "energetic"},
    "resistance": {"contact": "coulomb", "rolling_friction": 1e-5, "pivoting_friction": 2e-5},
    "threshold": {"contact": "coulomb", "restitution_threshold": 0.05},
}
FACES = (Outcome.HEADS, Outcome.TAILS)


def parts_of(coin, floor, air):
    described = {"friction": 0.3, "restitution": 0.5, **FLOORS[floor]}
    return {"coin": COINS[coin], "floor": described, "air": air, "ending": {"max_time": 10.0}}


@pytest.mark.slow_after_first
@pytest.mark.parametrize("mirror", list(Mirror))
@pytest.mark.parametrize("floor", FLOORS)
@pytest.mark.parametrize("count", [2, pytest.param(100, marks=pytest.mark.long)])
def test_a_mirrored_toss_is_the_same_to_the_bit_and_no_pair_is_certain_of_one_face(count, floor, mirror):
    rng = np.random.default_rng([51, sorted(FLOORS).index(floor)])
    ended = set()
    for coin, air in product(COINS, ({}, AIR)):
        parts = parts_of(coin, floor, air)
        drawn = [draw_release(rng) for _ in range(count)]
        rows, mirrored = (
            rows_from_states(scenario(**parts | {"coin": shape}), as_states(releases))
            for shape, releases in (
                (parts["coin"], drawn),
                (mirror.coin(parts["coin"]), [mirror.release(one) for one in drawn]),
            )
        )
        here, there = (analytic.toss_rows(each, trust="certain") for each in (rows, mirrored))
        assert there.end_time.tolist() == here.end_time.tolist()
        assert there.impacts.tolist() == here.impacts.tolist()
        assert there.trusted_impacts == pytest.approx(here.trusted_impacts, abs=1)
        images = [mirror.outcome(Outcome(outcome)) for outcome in here.outcome]
        assert images == there.outcome.tolist()
        ended.update(images)
    assert ended & set(FACES)


@pytest.mark.parametrize("mirror", list(Mirror))
@pytest.mark.parametrize("law", ["smooth", "coulomb", "knurled"])
def test_the_impacts_of_a_mirrored_toss_are_mirrored_to_the_bit(law, mirror):
    parts = parts_of("imperfect", law, AIR)
    parts["release"] = draw_release(np.random.default_rng([3, list(Mirror).index(mirror)]))
    here, there = (analytic.toss(case) for case in (scenario(**parts), mirror.scenario(**parts)))
    assert len(here.impacts) > 3
    for name, signs in {
        "time": 1,
        "energy": 1,
        "impulse": SPACE,
        "position": SPACE,
        "velocity_after": SPACE,
        "contact_velocity_before": SPACE,
        "point": mirror.body,
        "angular_velocity_after": -mirror.body,
    }.items():
        assert np.array_equal(getattr(there.impacts, name), signs * getattr(here.impacts, name)), name
    assert there.sequence == mirror.sequence(here.sequence)
    assert np.array_equal(there.contacts, here.contacts)


@pytest.mark.slow_after_first
@pytest.mark.parametrize("mirror", list(Mirror))
@pytest.mark.parametrize("exponent", [0.4, 1.0])
def test_in_air_with_b_above_0_a_mirrored_toss_is_mirrored_to_the_error_of_a_step(exponent, mirror):
    """The friction of the air on the wall is summed in one order around it."""
    parts = {**parts_of("imperfect", "coulomb", {**AIR, "exponent": exponent}), "ending": {"max_impacts": 3}}
    parts["release"] = draw_release(np.random.default_rng(4))
    here, there = (analytic.toss(case) for case in (scenario(**parts), mirror.scenario(**parts)))
    n = min(here.trusted_impacts, there.trusted_impacts)
    assert n == 3
    # Another rounding gives other steps, which err by 1e-13. An impact multiplies that, by a hundred at most.
    late = np.abs(there.impacts.time - here.impacts.time)
    off = np.linalg.norm(there.impacts.impulse - SPACE * here.impacts.impulse, axis=1)
    assert np.all(late < 1e-12 * 100.0 ** np.arange(n))
    assert np.all(off < 1e-10 * 100.0 ** np.arange(n) * np.linalg.norm(here.impacts.impulse, axis=1))
    assert there.sequence == mirror.sequence(here.sequence)


@pytest.mark.parametrize("mirror", list(Mirror))
def test_mujocos_toss_is_mirrored_within_its_error(mirror):
    parts = {**parts_of("imperfect", "coulomb", AIR), "ending": {"max_impacts": 3}}
    parts["release"] = draw_release(np.random.default_rng(5))
    here, there = (
        engines.toss(Engine.MUJOCO, case) for case in (scenario(**parts), mirror.scenario(**parts))
    )
    n = min(here.trusted_impacts, there.trusted_impacts)
    assert n > 0
    # Rounding moves the first step in a contact; see test_conformance_contacts.
    assert there.impacts.time[:n] == pytest.approx(here.impacts.time[:n], abs=5e-7)
    assert there.sequence[:n] == mirror.sequence(here.sequence[:n])


@pytest.mark.parametrize("floor", FLOORS)
def test_a_turned_toss_is_the_same_within_its_certificate(floor):
    """The time of a trusted impact is good to 1e-7 s."""
    turn, rng, compared = SYMMETRIES["a turn about the vertical"], np.random.default_rng(6), 0
    for coin in COINS:
        parts = parts_of(coin, floor, AIR)
        release = draw_release(rng)
        here, there = (
            analytic.toss(scenario(**parts, release=one)) for one in (release, turn.release(release))
        )
        n = min(here.trusted_impacts, there.trusted_impacts)
        compared += n
        assert there.impacts.time[:n] == pytest.approx(here.impacts.time[:n], abs=2e-7)
        assert there.sequence[:n] == here.sequence[:n]
        if here.outcome_certain and there.outcome_certain:
            assert there.outcome == here.outcome
    assert compared > 5


def upright(rng, coin):
    """Draw a toss that is its own mirror image in ζ: in its plane, upright, and slipping on the floor."""
    psi = 2 * np.pi * rng.integers(4) / 4 if rng.integers(2) else rng.uniform(0, 2 * np.pi)
    # A little above the floor, for the coin is to lean. One that comes to roll fast stays upright for long.
    speed, low = rng.uniform(0, 0.3), COINS[coin]["radius"] * (1 + 1e-8)
    return {
        "coin": COINS[coin],
        "floor": {
            "contact": "coulomb",
            "friction": rng.uniform(0.1, 0.5),
            "restitution": rng.uniform(0, 0.8),
        },
        "air": AIR if rng.integers(4) else {},
        "release": {
            "position": [0.0, 0.0, float(rng.choice([low, 2 * low]))],
            "velocity": [speed * np.cos(psi), speed * np.sin(psi), 0.0],
            "angles": [psi, np.pi / 2, 0.0],
            "angular_velocity": [0.0, 0.0, rng.uniform(-40, 40)],
        },
        "ending": {"max_time": 10.0},
    }


@pytest.mark.parametrize("coin", ["thin", "thick", "stout"])
@pytest.mark.parametrize("count", [15, pytest.param(500, marks=pytest.mark.long)])
def test_a_coin_that_is_its_own_mirror_image_is_never_certain_of_a_face(count, coin):
    """Nor are two that lean to either side certain of the same one, however little they lean."""
    rng, opposite = np.random.default_rng([7, list(COINS).index(coin)]), 0
    for _ in range(count):
        parts = upright(rng, coin)
        tie = analytic.toss(scenario(**parts))
        assert not (tie.outcome_certain and tie.outcome in FACES)
        psi, _, phi = parts["release"]["angles"]
        lean = 10 ** rng.uniform(-13, -8)
        pair = []
        for tilt in (np.pi / 2 - lean, np.pi / 2 + lean):
            parts["release"]["angles"] = [psi, tilt, phi]
            pair.append(analytic.toss(scenario(**parts)))
        faces = [toss.outcome for toss in pair if toss.outcome in FACES]
        if len(faces) == 2:
            certain = [toss.outcome_certain for toss in pair]
            assert faces[0] != faces[1] or not any(certain)
            opposite += faces[0] != faces[1]
    # The thicker a coin, the more of them stand on their edge.
    assert opposite >= {"thin": count / 2, "thick": count / 4, "stout": 0}[coin]
