"""The study of resistance to rolling and pivoting: its page shows what it saved, and what it claims."""

from cointoss.compare.reproduction.claim import unexpected
from cointoss.compare.reproduction.saving import read_numbers
from cointoss.compare.reproduction.studies.resistance import ResistanceRecord, claims, edge_share, power_law
from tests.helpers.pages import pictures, saved

SAVED = read_numbers(saved("resistance"), ResistanceRecord)


def test_the_saved_claims_come_out_as_known():
    assert pictures("CONTACT.md", "resistance") == {"disk.png"}
    assert unexpected(claims(SAVED)) == ()


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
    assert edge_share(ends).value == 0.3
