"""The axes of Keller's map, Fig. 2."""

import numpy as np

from cointoss.models.records import Array

FASTEST, HIGHEST = 20.0, 0.25
"""Ends of the axes: ω_0/π [1/s] and v_0/g [s]."""


def middles(end: float, count: int) -> Array:
    """Return the middles of equal parts of an axis from 0 on: for an even count none lies on a boundary."""
    return (np.arange(count) + 0.5) * end / count
