"""Check that an array is an outcome map."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss.models.records import Outcome

OutcomeCodes = NDArray[np.int8]
"""Codes of `Outcome`."""


def outcome_map(outcomes: ArrayLike) -> OutcomeCodes:
    """Return an array, checked to be an outcome map, (y, x).

    Raises:
        ValueError: as `outcome_codes`, and unless it has two dimensions.
    """
    codes = outcome_codes(outcomes)
    if codes.ndim != 2:
        raise ValueError(f"outcomes: shape {codes.shape}, accepted: (y, x)")
    return codes


def measured(codes: OutcomeCodes) -> OutcomeCodes:
    """Return codes as they are measured, where a transient is left out as the undecided are, in any shape."""
    return np.where(codes == Outcome.TRANSIENT, Outcome.UNDECIDED.value, codes).astype(np.int8)


def outcome_codes(outcomes: ArrayLike) -> OutcomeCodes:
    """Return an array as outcomes, in any shape.

    Raises:
        ValueError: for an empty array, and for anything but whole numbers that are codes of `Outcome`.
    """
    codes = np.asarray(outcomes)
    if codes.size == 0:
        raise ValueError(f"outcomes: shape {codes.shape}, accepted: at least one outcome")
    if not np.issubdtype(codes.dtype, np.integer):
        raise ValueError(f"outcomes: of type {codes.dtype}, accepted: whole numbers, the codes of Outcome")
    least, largest = int(min(Outcome)), int(max(Outcome))
    for code in (codes.min(), codes.max()):
        if not least <= code <= largest:
            raise ValueError(f"outcomes: {code} is no outcome, accepted: {least} to {largest}")
    return codes.astype(np.int8, copy=False)
