"""Many tosses, on both engines: each is that of one at a time, to the bit, whatever is tossed beside it."""

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.models.batch import rows_from_states
from cointoss.models.laws import ContactLaw
from cointoss.models.rows import row_of
from tests.helpers.draws import AIR, draw_coin, draw_release, scenario
from tests.helpers.engines import toss_as_many, toss_many
from tests.helpers.many import assert_same_answers, assert_same_toss, draw_states, same_states

pytestmark = [
    pytest.mark.parametrize("engine", list(Engine)),
    pytest.mark.usefixtures("without_horizon"),
]

LAWS = {Engine.ANALYTIC: [*ContactLaw], Engine.MUJOCO: [ContactLaw.SMOOTH, ContactLaw.COULOMB]}
AIRS = ({}, AIR, {}, AIR, {**AIR, "exponent": 0.5})


def assert_tossed_as_alone(engine, count):
    """Coins, floors, airs, releases, endings and hands of all kinds, each after others; some coins twice."""
    rng, cases = np.random.default_rng(12), []
    for number in range(count):
        law, air = LAWS[engine][number % len(LAWS[engine])], AIRS[number % 5]
        most, hand = (
            3 if "exponent" in air else int(rng.integers(4, 30)),
            {"caught": 0.1} if number % 4 == 3 else {},
        )
        case = scenario(
            gravity=rng.uniform(5, 15),
            coin=draw_coin(rng),
            air=air,
            floor={"restitution": rng.uniform(0, 0.9), "contact": str(law), "friction": 0.3},
            release=draw_release(rng),
            ending={"max_impacts": most, "max_time": 0.3 if "exponent" in air else 2.0, **hand},
        )
        cases += [case, case.replace("release", draw_release(rng))][: 1 + number % 2]
    rows, tosses = np.array([row_of(case) for case in cases]), [toss_as_many(engine, case) for case in cases]
    for order, workers in ((np.arange(len(rows)), 1), (rng.permutation(len(rows)), 3)):
        answers = engine.package.toss_rows(rows[order], workers=workers)
        for i, number in enumerate(order):
            assert_same_toss(answers, i, tosses[number])
    assert len({*answers.outcome}) > 2


def test_rows_that_differ_in_everything_are_tossed_as_each_alone(engine):
    assert_tossed_as_alone(engine, 14 if engine == Engine.ANALYTIC else 8)


@pytest.mark.long
def test_a_thousand_rows_that_differ_in_everything_are_tossed_as_each_alone(engine):
    assert_tossed_as_alone(engine, 1000)


@pytest.mark.slow_after_first
@pytest.mark.parametrize(
    ("exponent", "n", "longest"),
    # Several tiles; air with b > 0 costs a quadrature for each force.
    [(0.0, {Engine.ANALYTIC: 1100, Engine.MUJOCO: 29}, 100.0), (0.5, dict.fromkeys(Engine, 11), 0.15)],
    ids=["linear air", "other air"],
)
def test_neither_threads_nor_tiles_nor_order_change_a_toss(engine, exponent, n, longest, monkeypatch):
    case = scenario(
        air={**AIR, "exponent": exponent},
        floor={"contact": "coulomb", "friction": 0.3},
        ending={"max_impacts": 1, "max_time": longest},
    )
    states = draw_states(np.random.default_rng(2), n[engine])[1]
    first = toss_many(engine, case, states)
    assert len(np.unique(first.end_time)) > (n[engine] - 1 if exponent == 0 else 1)
    for threads, step in ((1, 1), (2, -1), (5, 1)):
        monkeypatch.setenv("COINTOSS_THREADS", str(threads))
        again = engine.package.toss_rows(rows_from_states(case, states[::step]))
        assert_same_answers(type(again)(*(each if each is None else each[::step] for each in again)), first)


def test_no_rows_give_no_answers(engine):
    answers = toss_many(engine, scenario(), same_states(0))
    assert {len(column) for column in answers if column is not None} == {0}
    assert answers.after(0).shape == (0,)
