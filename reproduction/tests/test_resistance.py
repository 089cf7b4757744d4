"""The study of resistance to rolling and pivoting: its page shows what it saved, and what it claims."""

import pytest

from cointoss_reproduction.frame.saving import read_numbers
from cointoss_reproduction.setups.ends import on_edge
from cointoss_reproduction.studies.resistance import study as resistance
from cointoss_reproduction.studies.resistance.study import ResistanceRecord, pivoting_stop, power_law
from saved import saved

SAVED = read_numbers(saved("resistance"), ResistanceRecord)


@pytest.mark.parametrize("coin", [resistance._DISC, resistance._THICK], ids=["disc", "thick"])
def test_a_coin_that_pivots_upright_stops_as_the_closed_form_says(coin):
    found = pivoting_stop(coin)
    # Rest is found at 1e-3 √(g/r), 3e-4 of the spin; slow slip is regularised likewise.
    assert found.time == pytest.approx(found.expected_time, rel=1e-3)


def test_a_fall_by_another_power_law_is_seen():
    disk = SAVED.disks["rolling"]
    other = type(disk)(
        times=disk.times,
        tilts=[tilt**1.5 for tilt in disk.tilts],
        energies=disk.energies,
        pivots=disk.pivots,
    )
    assert abs(power_law(other)[0] - 2) > 0.2


def test_the_share_on_edge_counts_every_ending_there():
    ends = {"edge, at_rest": 1, "edge, paper": 2, "heads, paper": 7}
    assert on_edge(ends).value == 0.3
