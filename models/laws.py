"""The names of the contact laws, of the kinds of restitution, and of the tests that end a toss."""

from cointoss.models.words import Word


class ContactLaw(Word):
    """How the contact point A leaves the floor; Strzalko et al. 2008, Fig. 17, and Coulomb friction."""

    SHARP_EDGE = 1
    KNURLED = 2
    PERFECTLY_ROUGH = 3
    SLIP_PRESERVING = 4
    SMOOTH = 5
    SLIDING_FRICTION = 6
    COULOMB = 7

    def __hash__(self) -> int:
        """Return the hash of its word, by which an engine of one's own looks a law up."""
        return hash(str(self))


class EndingTest(Word):
    """The test by which the face that is up counts as final."""

    RIGOROUS = 1
    """The energy is below the lowest pass to the other face."""
    PAPER = 2
    """E < m g r."""
    PAPER_SMOOTH = 3
    """E - m (ẋ² + ẏ²)/2 - J_ζ ω_ζ²/2 < m g r, eq. (20)."""
    LYING = 4
    """The coin lies on a face, still to the eye, or stays on its edge."""


class RestitutionKind(Word):
    """The quantities that the restitution χ compares, before and after an impact by the law `coulomb`."""

    KINEMATIC = 1
    """The normal speeds of A: Newton's v_Az' = -χ v_Az."""
    ENERGETIC = 2
    """The work of the normal impulse: the part χ² of the work of compression is returned (Stronge)."""
