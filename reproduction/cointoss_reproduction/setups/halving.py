"""Halving, to the last digit of a double."""

from collections.abc import Callable


def halved(low: float, high: float, label: Callable[[float], int]) -> tuple[float, float]:
    """Return neighbouring doubles between two places where a label first differs from that of the lower."""
    lower = label(low)
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if label(middle) == lower else (low, middle)
    return low, high
