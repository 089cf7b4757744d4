"""Many tosses in MuJoCo: each is that of `toss`, to the bit."""

import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from cointoss import coin_mj
from cointoss.coin_mj import MANY, Friction, MujocoSettings, Realisation
from cointoss.coin_mj.ensemble import TILE
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.toss import run
from cointoss.models.outcomes import Outcomes
from cointoss.models.records import ApproximationWarning, Ending, UnsupportedError
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, scenario
from tests.helpers.many import as_releases, assert_same_toss, draw_releases, releases_of


def assert_same(a: Outcomes, b: Outcomes) -> None:
    for name in vars(a):
        assert np.array_equal(getattr(a, name), getattr(b, name)), name


def assert_each_is_a_toss(
    case: Scenario, drawn: list[dict[str, Any]], outcomes: Outcomes, settings: MujocoSettings = MANY
) -> None:
    for i, release in enumerate(drawn):
        one = case.replace("release", release)
        # What `toss` makes its record of; it also tosses softer coins, for its horizon of trust.
        assert_same_toss(outcomes, i, run(machine_of(one, settings), one.rules))


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
    drawn, releases = draw_releases(np.random.default_rng([len(law), len(air), int(1e4 * thickness)]), 4)
    with warnings.catch_warnings(action="ignore", category=ApproximationWarning):
        outcomes = coin_mj.toss_many(case, releases, settings=settings)
    assert_each_is_a_toss(case, drawn, outcomes, settings)


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
    drawn, releases = draw_releases(np.random.default_rng(2), n)
    answers = []
    for threads in (1, 2, 5):
        monkeypatch.setenv("COINTOSS_THREADS", str(threads))
        answers.append(coin_mj.toss_many(case, releases))
    assert_same(answers[0], answers[1])
    assert_same(answers[0], answers[2])
    assert len(np.unique(answers[0].end_time)) > (n - 1 if exponent == 0 else 1)
    there = coin_mj.toss_many(case, as_releases(drawn[::-1]))
    assert_same(answers[0], rows_of(there, slice(None, None, -1)))
    part = rows_of(answers[0], slice(TILE - 2, TILE + 2))
    assert_each_is_a_toss(case, drawn[TILE - 2 : TILE + 2], part)


def rows_of(outcomes, chosen):
    columns = {name: array for name, array in vars(outcomes).items() if array is not None}
    return Outcomes(**{name: array[chosen].copy() for name, array in columns.items()})


def test_no_releases_give_no_outcomes():
    assert len(coin_mj.toss_many(scenario(), releases_of(0))) == 0


def test_what_toss_refuses_is_refused_and_what_it_warns_of_is_warned_of():
    _, releases = draw_releases(np.random.default_rng(0), 1)
    with pytest.raises(UnsupportedError, match=r"floor\.contact = "):
        coin_mj.toss_many(scenario(floor={"contact": "knurled"}), releases)
    with pytest.raises(UnsupportedError, match="horizon = True: accepted"):
        coin_mj.toss_many(scenario(), releases, horizon=True)
    with pytest.raises(UnsupportedError, match="certain = True: accepted"):
        coin_mj.toss_many(scenario(), releases, certain=True)
    with pytest.raises(ValueError, match="a coin above the floor"):
        coin_mj.toss_many(scenario(), releases_of(1, position=[0, 0, 0]))
    rough = scenario(floor={"contact": "perfectly_rough"}, ending={"max_impacts": 1})
    with pytest.warns(ApproximationWarning, match="friction 100"):
        outcomes = coin_mj.toss_many(rough, releases)
    assert outcomes.ending.tolist() == [Ending.MAX_IMPACTS]
