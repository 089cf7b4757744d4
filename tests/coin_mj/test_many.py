"""Many tosses in MuJoCo: each is that of `toss`, to the bit."""

import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from cointoss import coin_mj
from cointoss.coin_mj import MANY, Friction, MujocoSettings, Realisation
from cointoss.coin_mj.many import TILE
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.toss import run
from cointoss.models.answers import Answers, names_of
from cointoss.models.batch import rows_from_states, rows_of
from cointoss.models.laws import ContactLaw
from cointoss.models.records import ApproximationWarning, Ending, UnsupportedError
from cointoss.models.rows import row_of
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, draw_coin, draw_release, scenario
from tests.helpers.many import assert_same_toss, draw_states, same_states


def assert_same(a: Answers, b: Answers) -> None:
    for name in names_of(None):
        assert np.array_equal(getattr(a, name), getattr(b, name)), name


def assert_each_is_a_toss(
    case: Scenario, drawn: list[dict[str, Any]], answers: Answers, settings: MujocoSettings = MANY
) -> None:
    for i, release in enumerate(drawn):
        one = case.replace("release", release)
        # What `toss` makes its record of; it also tosses softer coins, for its horizon of trust.
        assert_same_toss(answers, i, run(machine_of(one, settings), one.rules))


@pytest.mark.parametrize("law", ["smooth", "coulomb", "perfectly_rough"])
@pytest.mark.parametrize("air", [{}, AIR])
@pytest.mark.parametrize("thickness", [0.0, 2e-3])
@pytest.mark.parametrize("realisation", list(Realisation))
@pytest.mark.parametrize("friction", list(Friction))
def test_each_toss_is_that_of_toss_to_the_bit(law, air, thickness, realisation, friction):
    """All laws that are realised, with and without air, thin and thick; whole tosses, contacts and all."""
    settings = replace(MANY, contact=realisation, friction=friction)
    center = np.array(PAPER_OFFSET) * [1, 1, thickness > 0]
    case = scenario(
        coin={**ZLOTY, "thickness": thickness, "center_of_mass": center.tolist()},
        air=air,
        floor={"restitution": 0.5, "contact": law, "friction": 0.3},
        ending={"max_impacts": 30, "max_time": 2.0},
    )
    drawn, states = draw_states(np.random.default_rng([len(law), len(air), int(1e4 * thickness)]), 4)
    with warnings.catch_warnings(action="ignore", category=ApproximationWarning):
        answers = coin_mj.toss_rows(rows_from_states(case, states), settings=settings)
    assert_each_is_a_toss(case, drawn, answers, settings)


@pytest.mark.parametrize("workers", [1, 3])
def test_rows_that_differ_in_everything_are_tossed_as_each_alone(workers):
    """Coins, floors, airs, releases and endings, each after others, some coins twice; to the bit."""
    rng, cases = np.random.default_rng(12), []
    for number in range(24):
        coin, air, floor = draw_coin(rng), ({}, AIR)[number % 2], ("smooth", "coulomb")[rng.integers(2)]
        alike = scenario(coin=coin, air=air, floor={"restitution": rng.uniform(0.1, 0.8), "contact": floor})
        for _ in range(2):
            cases.append(
                alike.replace("release", draw_release(rng), "ending.max_impacts", int(rng.integers(1, 6)))
            )
    order = rng.permutation(len(cases))
    answers = coin_mj.toss_rows(np.array([row_of(cases[i]) for i in order]), workers=workers)
    for i, number in enumerate(order):
        assert_same_toss(answers, i, run(machine_of(cases[number], MANY), cases[number].rules))
    assert len({*answers.impacts}) > 3


@pytest.mark.parametrize(
    ("exponent", "n", "longest"),
    # Air with b > 0 costs a quadrature for each force.
    [(0.0, 3 * TILE + 5, 100.0), (0.5, TILE + 3, 0.15)],
)
def test_neither_threads_nor_tiles_nor_order_change_a_toss(exponent, n, longest, monkeypatch):
    case = scenario(
        air={**AIR, "exponent": exponent},
        floor={"contact": "coulomb", "friction": 0.3},
        ending={"max_impacts": 1, "max_time": longest},
    )
    drawn, states = draw_states(np.random.default_rng(2), n)
    rows, answers = rows_from_states(case, states), []
    for threads in (1, 2, 5):
        monkeypatch.setenv("COINTOSS_THREADS", str(threads))
        answers.append(coin_mj.toss_rows(rows))
    assert_same(answers[0], answers[1])
    assert_same(answers[0], answers[2])
    assert len(np.unique(answers[0].end_time)) > (n - 1 if exponent == 0 else 1)
    assert_same(answers[0], some_of(coin_mj.toss_rows(rows[::-1]), slice(None, None, -1)))
    part = some_of(answers[0], slice(TILE - 2, TILE + 2))
    assert_each_is_a_toss(case, drawn[TILE - 2 : TILE + 2], part)


def some_of(answers, chosen):
    return Answers(*(column[chosen] for column in answers if column is not None))


def test_no_rows_give_no_answers():
    assert len(coin_mj.toss_rows(rows_from_states(scenario(), same_states(0))).outcome) == 0


def test_what_toss_refuses_is_refused_and_what_it_warns_of_is_warned_of():
    laws = [ContactLaw.SMOOTH, ContactLaw.KNURLED]
    with pytest.raises(UnsupportedError, match=r"floor\.contact = "):
        coin_mj.toss_rows(rows_of(scenario(), 2, {"floor.contact": laws}))
    for trust in ("impacts", "certain"):
        with pytest.raises(UnsupportedError, match=rf'^trust = "{trust}": accepted by the MuJoCo engine'):
            coin_mj.toss_rows(rows_of(scenario(), 1), trust=trust)
    rough = scenario(floor={"contact": "perfectly_rough"}, ending={"max_impacts": 1})
    with pytest.warns(ApproximationWarning, match="friction 100"):
        answers = coin_mj.toss_rows(rows_of(rough, 1))
    assert answers.ending.tolist() == [Ending.MAX_IMPACTS]
