"""A coin that falls flat, whose touches up to a speed are plastic: the closed form of its touches."""

from typing import NamedTuple

import numpy as np

from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from tests.helpers.draws import ZLOTY, scenario

G = 9.81


class FlatFall(NamedTuple):
    """A scenario, and what becomes of its coin."""

    scenario: Scenario
    speeds: Array
    """At which it touches, down to the first plastic touch, (n + 1,) [m/s]."""
    end_time: float
    """Of that touch [s]."""


def flat_fall(restitution: float, threshold: float, height: float = 1.0) -> FlatFall:
    """Return the fall of a flat coin in vacuum.

    It comes down at v₀ χⁿ, so touch number ln(v₀/v)/ln(1/χ), rounded up, is the first plastic one.

    Args:
        restitution: χ.
        threshold: v, up to which touches are plastic [m/s].
        height: of its lower face above the floor [m].
    """
    v0 = (2 * G * height) ** 0.5
    bounces = int(np.ceil(np.log(v0 / threshold) / np.log(1 / restitution)))
    speeds = v0 * restitution ** np.arange(bounces + 1)
    return FlatFall(
        scenario=scenario(
            floor={"contact": "smooth", "restitution": restitution, "restitution_threshold": threshold},
            release={"position": [0, 0, height + ZLOTY["thickness"] / 2]},
        ),
        speeds=speeds,
        end_time=float(v0 + 2 * speeds[1:].sum()) / G,
    )
