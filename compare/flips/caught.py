"""How likely a coin that a hand catches shows its first side, by the three moments of its inertia."""

import math
from functools import cache

import numpy as np
from scipy.special import ellipj, ellipk

from cointoss.compare.flips.people import CAUGHT, SameSide
from cointoss.models.body import in_vacuum, is_ideal
from cointoss.models.kernel.vectors import Matrix
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario

OFF = np.linspace(1e-6, math.pi / 2 - 1e-6, 91)
"""|90° - ψ| of which the probability is computed [rad]; between them it is interpolated. At neither end is L
along or across the normal, where some paths of L are single points."""
AZIMUTHS = (np.arange(360) + 0.5) * math.pi / 180
"""Of L about the normal at the release [rad]."""
TIMES = (np.arange(64) + 0.5) / 64
"""In periods of L's path in the body."""


def has_closed_form(scenario: Scenario | None, hand: object) -> bool:
    """Return whether the coin is caught after many turns in vacuum, by a hand of which no more is known.

    Args:
        scenario: of the coin; None for an ideal one that is caught.
        hand: that tosses the scenario's coin; None for none.
    """
    return scenario is None or (
        hand is None and scenario.ending.caught is not None and bool(in_vacuum(scenario.body))
    )


def caught(scenario: Scenario | None) -> SameSide:
    """Return how likely a scenario's coin shows its first side when it is caught, for any inertia about C."""
    return CAUGHT if scenario is None or is_ideal(scenario.body) else _of_three_moments(scenario.body.inertia)


@cache
def _of_three_moments(inertia: Matrix) -> SameSide:
    """Return the mean over the azimuths of L at the release and over the time.

    The vertical keeps the angle ψ to L, and the coin's normal has the angle θ to it. All angles of the normal
    about L are equally likely, so the first side is up with 1/2 + asin(cot ψ cot θ)/π.
    """
    moments, axes = np.linalg.eigh(np.array(inertia))
    across, along = np.cos(OFF)[:, None], np.sin(OFF)[:, None]
    released = np.stack(
        np.broadcast_arrays(across * np.cos(AZIMUTHS), across * np.sin(AZIMUTHS), along), axis=-1
    )
    cosines = _along_the_normal(moments, axes, released @ axes)
    cotangents = cosines / np.sqrt(np.maximum(1 - cosines**2, 1e-300)) * np.tan(OFF)[:, None, None]
    p = 1 / 2 + np.arcsin(np.clip(cotangents, -1, 1)).mean(axis=(1, 2)) / math.pi
    return SameSide(lambda off: np.interp(off, OFF, p))


def _along_the_normal(moments: Array, axes: Array, released: Array) -> Array:
    """Return the cosine between the normal and L, (n, azimuths, times), by Jacobi's elliptic functions.

    In the body L goes round the axis c of the least or of the largest moment, and a is the other of these:
    L_a ~ cn, L_b ~ sn, L_c ~ dn (L. D. Landau, E. M. Lifshitz, Mechanics, § 37).

    Args:
        moments: rising, (3,) [kg m²].
        axes: theirs, as columns.
        released: L's direction along these axes at the release, (n, azimuths, 3).
    """
    energy = (released**2 / moments).sum(axis=-1)[..., None]
    about_the_largest = energy * moments[1] < 1
    (a, c), (n_a, n_c), (_, l_c) = (
        (np.where(about_the_largest, least, most), np.where(about_the_largest, most, least))
        for least, most in (moments[[0, 2]], axes[2, [0, 2]], (released[..., [0]], released[..., [2]]))
    )
    b, n_b = moments[1], axes[2, 1]
    from_a, from_c = 1 - energy * a, energy * c - 1
    k2 = np.clip((b - a) * from_c / ((c - b) * from_a), 0, 1 - 1e-12)
    sn, cn, dn, _ = ellipj(4 * ellipk(k2) * TIMES, k2)
    along_a, along_b, along_c = (
        np.sqrt(np.maximum(square, 0))
        for square in (a * from_c / (c - a), b * from_c / (c - b), c * from_a / (c - a))
    )
    return n_a * along_a * cn + n_b * along_b * sn + n_c * np.sign(l_c) * along_c * dn
