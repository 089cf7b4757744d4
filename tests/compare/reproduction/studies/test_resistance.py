"""The study of resistance to rolling and pivoting: its page shows what it saved, and what it claims."""

from cointoss.compare.reproduction.saving import read_numbers
from cointoss.compare.reproduction.setups.ends import on_edge
from cointoss.compare.reproduction.studies.resistance import ResistanceRecord, power_law
from tests.helpers.pages import saved

SAVED = read_numbers(saved("resistance"), ResistanceRecord)


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
