"""The names of the contact laws and of the tests that end a toss."""

from enum import IntEnum


class ContactLaw(IntEnum):
    """How the contact point A leaves the floor; Strzalko et al. 2008, Fig. 17, and Routh's law."""

    SHARP_EDGE = 1
    KNURLED = 2
    PERFECTLY_ROUGH = 3
    SLIP_PRESERVING = 4
    SMOOTH = 5
    SLIDING_FRICTION = 6
    COULOMB = 7

    @property
    def label(self) -> str:
        """The law's name in a scenario file."""
        return self.name.lower()


class EndingTest(IntEnum):
    """When the face that is up counts as final."""

    RIGOROUS = 1
    """The energy is below the lowest pass to the other face."""
    PAPER = 2
    """E < m g r."""
    PAPER_SMOOTH = 3
    """E - m (ẋ² + ẏ²)/2 - J_ζ ω_ζ²/2 < m g r, eq. (20)."""

    @property
    def label(self) -> str:
        """The test's name in a scenario file."""
        return self.name.lower()
