"""A hand fitted to counts: closed forms, intervals that cover the truth, and people whom none explains."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.stats import binom, chi2

from cointoss import Flips, Hand, flips, load, load_hand, parse
from cointoss.compare.flips.answer import as_lines
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.hand import same_side_probability
from tests.helpers.command_line import cointoss, printed

COIN = """
[coin]
mass = "5 g"
radius = "12.5 mm"
thickness = "2 mm"

[floor]
contact = "smooth"
restitution = 0.2

[release]
position = [0, 0, 1]
"""


def degrees(estimate) -> list[float]:
    return [math.degrees(end) for end in estimate.ends]


def drawn(people: int, count: int, psi_scatter: float, seed: int) -> Flips:
    """Return counts of people who wobble so."""
    rng = np.random.default_rng(seed)
    p = same_side_probability(rng.normal(np.pi / 2, psi_scatter, people))
    return Flips(same=rng.binomial(count, p), flips=np.full(people, count))


def test_a_persons_psi_is_the_inverse_of_the_probability():
    """p = 1/2 + asin(cot² ψ)/π at ψ, and at the ends of the interval twice the log-likelihood is χ² lower."""
    found = flips(Flips(same=[5_600], flips=[10_000])).people[0].psi
    assert found.low < found.value < found.high
    value, *ends = (float(same_side_probability(psi)) for psi in found.ends)
    assert value == pytest.approx(0.56, abs=1e-6)
    drop = chi2.ppf(0.99, 1) / 2

    def above(p):
        return binom.logpmf(5_600, 10_000, p) - binom.logpmf(5_600, 10_000, 0.56) + drop

    assert sorted(ends) == pytest.approx([brentq(above, 0.5, 0.56), brentq(above, 0.56, 0.7)], abs=1e-6)


@pytest.mark.parametrize(
    ("same", "count", "expected"),
    [
        (50, 100, [90, 60, 90]),
        (0, 0, [math.nan, 0, 90]),
        (1, 1, [math.nan, 0, 90]),
        (1000, 1000, [45, 0, 46]),
    ],
)
def test_the_ends_of_what_a_person_can_count(same, count, expected):
    """A fair share is that of 90°, no flips say nothing, and from 45° on all flips are the same."""
    found = flips(Flips(same=[same, 50], flips=[count, 100]))
    assert degrees(found.people[0].psi) == pytest.approx(expected, abs=6, nan_ok=True)
    assert ("not determined" in as_lines(found)) == math.isnan(expected[0])
    assert found.is_possible


def test_one_person_has_a_psi_and_no_scatter_over_people():
    found = flips(Flips(same=[560], flips=[1000], people=("Anna",)))
    assert (found.scatter, found.hand) == (None, Hand(psi=found["Anna"].psi.value))
    assert "over" not in as_lines(found)
    with pytest.raises(KeyError, match="Ben: accepted: Anna"):
        found["Ben"]


@pytest.mark.parametrize(
    ("people", "count", "scatter", "seed", "within"),
    [(200, 5000, 15.0, 3, 1.5), (10, 3000, 12.0, 0, 8.0), (10, 3000, 12.0, 1, 8.0), (20, 2000, 0.0, 1, 12.0)],
)
def test_the_scatter_that_was_drawn_is_found_again(people, count, scatter, seed, within):
    found: Any = flips(drawn(people, count, math.radians(scatter), seed))
    value, low, high = degrees(found.scatter)
    assert found.hand == Hand(psi_scatter=found.scatter.value)
    assert value == pytest.approx(scatter, abs=within)
    assert low <= scatter <= high < scatter + 2 * within


@pytest.mark.parametrize("count", [2000, 5000, 25_000, 1_000_000])
@pytest.mark.parametrize(
    ("shares", "expected"), [((0.8, 0.88, 0.52, 0.96), (38.4, 19.1, 90)), ((0.8,) * 5, (42.0, 22.1, 90))]
)
def test_people_who_wobble_much_scatter_as_their_shares_do(shares, expected, count):
    """However many flips: the angles of such shares are 42 to 45°, and 20°; their interval ends at 90°."""
    found: Any = flips(Flips(same=[round(share * count) for share in shares], flips=[count] * len(shares)))
    assert found.is_possible
    assert degrees(found.scatter) == pytest.approx(expected, abs=0.3)


@pytest.mark.parametrize(
    ("same", "count", "why"),
    [
        ([300], [1000], "too seldom"),
        ([450, 440], [1000, 1000], "too seldom"),
        ([400, 600, 550, 600], [1000, 1000, 1000, 1000], "too seldom for 1"),
        ([5000] * 30 + [7000], [10_000] * 31, "differ too much"),
    ],
)
def test_shares_below_one_half_are_those_of_no_wobble(same, count, why):
    found = flips(Flips(same=same, flips=count))
    assert not found.is_possible
    assert why in found.verdict
    assert "[" not in as_lines(found).splitlines()[1].split("]")[1]
    assert math.isnan(found.people[0].psi.low)


def test_a_simulated_coin_that_is_caught_has_the_closed_form(tmp_path):
    """The simulation's error widens the intervals, and moves them by a part of their width."""
    (tmp_path / "caught.toml").write_text(COIN + '\n[ending]\ncaught = "1 m"\n', encoding="utf-8")
    counts, hand = Flips(same=[620, 540], flips=[1000, 1000]), Hand(psi=1.0, up="either")
    closed, tossed = flips(counts), flips(counts, tmp_path / "caught.toml", hand=hand, tosses=250)
    for one, other in zip(closed.people, tossed.people, strict=True):
        assert degrees(other.psi)[0] == pytest.approx(degrees(one.psi)[0], abs=8)
        assert other.psi.low < one.psi.value < other.psi.high
    assert closed.people[0].psi.high - closed.people[0].psi.low < 0.9 * (
        tossed.people[0].psi.high - tossed.people[0].psi.low
    )
    assert (closed.scenario, tossed.scenario) == (None, load(tmp_path / "caught.toml"))
    assert tossed.hand.psi == math.pi / 2, "its own is not used"


def test_on_a_smooth_floor_all_same_is_more_likely_with_less_wobble():
    """Bounces complete the bias: 95 of 100 need a ψ far nearer to 90° than a catch does."""
    counts = Flips(same=[95], flips=[100])
    caught, bounced = flips(counts), flips(counts, parse(COIN, "coin"), tosses=30)
    assert math.degrees(bounced.people[0].psi.high - caught.people[0].psi.high) > 10


@pytest.fixture
def counts(here):
    (here / "counts.csv").write_text("person,same,flips\nAnna,560,1000\nBen,9,20\n", encoding="utf-8")
    return "counts.csv"


def test_the_command_answers_as_python(counts):
    Path("found.toml").touch()
    found = flips(counts)
    told = json.loads(printed("flips", counts, "--json", "--out", "found.toml"))
    assert [one["person"] for one in told["people"]] == ["Anna", "Ben"]
    assert told["people"][0]["psi"]["value"] == found["Anna"].psi.value
    assert told["scatter"]["value"] == load_hand("found.toml").psi_scatter == found.hand.psi_scatter
    assert as_lines(found) in cointoss("flips", counts).stdout


def test_the_command_ends_with_1_where_no_wobble_explains_it(counts, tmp_path):
    (tmp_path / counts).write_text("same,flips\n300,1000\n", encoding="utf-8")
    told, answered = (cointoss("flips", counts, *more, "--out", "found.toml") for more in ((), ("--json",)))
    assert "found.toml is not written: no hand explains these counts" in told.stdout
    assert (answered.exit_code, (tmp_path / "found.toml").exists()) == (1, False)
    psi = json.loads(answered.stdout)["people"][0]["psi"]
    assert psi == {"value": math.pi / 2, "low": None, "high": None}


@pytest.mark.parametrize(("name", "value"), [("hand", Hand()), ("tosses", 7), ("device", "cuda")])
def test_python_refuses_what_a_coin_that_is_caught_has_no_use_for(name, value):
    with pytest.raises(SweepError, match=f"^`{name}` .*accepted: only with a scenario whose coin"):
        flips(Flips(same=[1], flips=[2]), **{name: value})
