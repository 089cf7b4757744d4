"""How much of a map each outcome fills."""

from numpy.typing import ArrayLike

from cointoss.compare.basins.maps import outcome_codes
from cointoss.models.answers import tally
from cointoss.models.records import Outcome


def fractions(outcomes: ArrayLike) -> dict[Outcome, float]:
    """Return the share of a map or a line that each outcome fills; the shares, undecided included, sum to 1.

    Were all pixels decided, the share of an outcome would lie between its share here and that plus the share
    of the undecided.
    """
    codes = outcome_codes(outcomes)
    counts = tally(codes)
    return {outcome: float(counts[outcome] / codes.size) for outcome in Outcome}
