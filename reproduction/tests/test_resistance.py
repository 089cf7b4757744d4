"""The study of resistance to rolling and pivoting: closed forms, and a power law that would be seen."""

import numpy as np
import pytest

from cointoss_reproduction.studies.resistance.study import NICKELS, STOPS, disk, on_edge, power_law


@pytest.mark.parametrize("stop", ["disc pivots", "thick coin pivots"])
def test_a_coin_that_pivots_upright_stops_as_the_closed_form_says(stop):
    found = STOPS[stop]()
    # Rest is found at 1e-3 √(g/r), 3e-4 of the spin; slow slip is regularised likewise.
    assert found["time"] == pytest.approx(found["closed"], rel=1e-3)


def test_a_fall_by_another_power_law_is_seen():
    _, _, fall, _ = disk("rolling")
    times, tilts = (np.array(fall[name]) for name in ("time", "tilt"))
    assert abs(power_law(times, tilts)["exponent"] - 2) < 0.05
    assert abs(power_law(times, tilts**1.5)["exponent"] - 2) > 0.2


def test_the_share_on_edge_counts_every_ending_there():
    first, endings = on_edge(NICKELS["0"], 60)
    numbers, there = np.array(endings["number"]), [name.startswith("edge, ") for name in endings["ending"]]
    assert numbers[there].sum() == first["edges"] > 0
    assert numbers.sum() == first["tosses"] == 60
