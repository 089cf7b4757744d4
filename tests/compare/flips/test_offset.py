"""The offset of a mass centre that explains counts of heads: an inverse, its ends, coins on edge."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import binom, chi2

from cointoss import Hand, Sides, offset
from cointoss.compare.flips.offset import LARGEST, offset_of
from cointoss.compare.flips.people import SameSide
from tests.helpers.command_line import cointoss, printed

LINEAR = SameSide(lambda x: 0.5 + 0.4 * x)
COIN = """
[coin]
mass = "2.5 g"
radius = "9.525 mm"
thickness = "0.4 mm"

[floor]
contact = "smooth"
restitution = 0

[release]
position = [0, 0, 1]
"""
SPUN = Hand(spun=True, spin=0.0, psi_scatter=math.radians(1))


def test_an_offset_is_the_inverse_of_the_probability():
    """At the ends of its interval twice the log-likelihood is χ² lower."""
    found = offset_of(Sides(heads=600, tails=400), LINEAR)
    value, *ends = (0.5 + 0.4 * x for x in found.ends)
    assert value == pytest.approx(0.6, abs=1e-6)
    least = binom.logpmf(600, 1000, 0.6) - chi2.ppf(0.99, 1) / 2
    assert binom.logpmf(600, 1000, ends) == pytest.approx([least, least], abs=1e-3)
    assert found.low < found.value < found.high


@pytest.mark.parametrize(
    ("heads", "tails", "family", "ends"),
    [
        (999, 1, LINEAR, (1, math.nan, math.nan)),
        (1, 999, LINEAR, (-1, math.nan, math.nan)),
        (50, 50, SameSide(lambda x: 0.5 + 1e-3 * x, 1000), (math.nan, -1, 1)),
    ],
    ids=["more heads than any", "more tails", "a coin that forgets its centre"],
)
def test_counts_that_no_offset_or_every_one_explains_determine_none(heads, tails, family, ends):
    found = offset_of(Sides(heads=heads, tails=tails), family)
    assert found.ends == pytest.approx(ends, abs=1e-6, nan_ok=True)


@pytest.fixture
def coin(here):
    (here / "coin.toml").write_text(COIN, encoding="utf-8")
    (here / "hand.toml").write_text(
        "spun = true\nspin = 0\npsi_scatter = '1 deg'\nup = 'heads'\n", encoding="utf-8"
    )
    (here / "counts.csv").write_text("HH,HT,TT,TH\n5,20,20,5\n", encoding="utf-8")
    return "coin.toml"


def test_a_coin_that_is_set_on_its_edge_falls_to_its_heavier_side(coin):
    """Tails is up where the mass centre is towards heads, and the other way."""
    more_tails, more_heads = (
        offset(Sides(heads=heads, tails=100 - heads), coin, hand=SPUN, tosses=400) for heads in (20, 80)
    )
    assert 0 < more_tails.low <= more_tails.value <= LARGEST * 0.4e-3
    assert more_heads.ends == pytest.approx(-np.array(more_tails.ends)[[0, 2, 1]], abs=1e-9)


def test_the_command_finds_the_offset_of_a_spun_coin(coin):
    """Also where the side at the release is known; either is up at first as often."""
    hand = ("--hand", "hand.toml", "--tosses", 400)
    told = json.loads(printed("flips", "counts.csv", coin, *hand, "--json"))
    found = offset(Sides(heads=10, tails=40), coin, hand=replace(SPUN, up="either"), tosses=400)
    assert (*list(told["offset"].values())[:3], told["tosses"]) == (*found.ends, 400)
    value, low, high = (f"{1e3 * end:.3f}" for end in found.ends)
    assert f"mass centre towards heads [mm], 99 %  {value} [{low}, {high}]" in printed(
        "flips", "counts.csv", coin, *hand
    )


def test_the_command_ends_with_1_where_no_offset_explains_it(coin):
    assert printed("flips", "--heads", 100, "--tails", 0), "a coin that is not fair is an answer"
    Path("counts.csv").write_text("heads,tails\n3000,0\n", encoding="utf-8")
    told = cointoss("flips", "counts.csv", coin, "--hand", "hand.toml", "--tosses", 400)
    assert told.exit_code == 1
    assert "mass centre towards heads [mm], 99 %  no offset explains these counts" in told.stdout
