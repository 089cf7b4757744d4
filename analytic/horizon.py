"""How far a toss can be trusted: the leading impacts that all its shadows share with it."""

import numpy as np

from analytic.events import run
from analytic.rotation import quaternion_rate
from models.attitude import rotation_matrix
from models.body import Body, Rules
from models.geometry import FLAT_SINE
from models.records import Impacts

RELEASE_ERROR = 3e-12
"""Displacement of a shadow's height, speed, spins (relative) and tilt at release; above the integration's
error."""
LOW_HOP = 1e-8
"""A flight no higher than this part of the radius ends the trust: its touch is known only to `TOUCH`, an
error that all shadows share."""
TIME_ERROR = 1e-7
"""Within the horizon no shadow differs by more in the time of an impact [s]."""
IMPULSE_ERROR = 1e-5
"""Within the horizon no shadow differs by more in an impulse, relative."""

# Three directions and their opposites: signs of the displacement of the height, the vertical velocity, the
# components of the angular velocity, and the tilt.
_SIGNS = np.array(
    [
        [+1, +1, +1, +1, +1, +1],
        [+1, -1, +1, -1, +1, -1],
        [+1, +1, -1, -1, +1, -1],
        [-1, -1, -1, -1, -1, -1],
        [-1, +1, -1, +1, -1, +1],
        [-1, -1, +1, +1, -1, +1],
    ]
)


def trusted_impacts(body: Body, rules: Rules, start: np.ndarray, impacts: Impacts) -> int:
    """Count the leading impacts at which every shadow agrees in face, time and impulse.

    Args:
        body: the coin.
        rules: floor and ending.
        start: state at release, (13,).
        impacts: the toss from there.
    """
    if len(impacts) == 0:
        return 0
    speed = (body.gravity * max(start[2], body.radius)) ** 0.5 + abs(start[5])
    # A spin component that is zero keeps its zero: symmetric motions stay symmetric in rounding too.
    sizes = RELEASE_ERROR * np.array([max(start[2], body.radius), speed, *np.abs(start[10:13])])
    trusted = before_a_low_hop(body, impacts)
    for signs in _SIGNS:
        shadow_start = start.copy()
        shadow_start[[2, 5, 10, 11, 12]] += signs[:5] * sizes
        shadow_start[6:10] = tilted(shadow_start[6:10], signs[5] * RELEASE_ERROR)
        shadow = Impacts.from_rows(run(body, rules._replace(max_impacts=trusted), shadow_start).rows)
        trusted = agreeing_impacts(impacts, shadow)
        if trusted == 0:
            break
    return trusted


def tilted(e: np.ndarray, angle: float) -> np.ndarray:
    """Turn the attitude e, (4,), about the horizontal axis across the normal; a flat coin stays flat."""
    up = rotation_matrix(e)[2]
    sine = np.hypot(up[0], up[1])
    if sine <= FLAT_SINE:
        return e
    turn = angle * np.array(quaternion_rate(e, (-up[1] / sine, up[0] / sine, 0.0)))
    return (e + turn) / np.linalg.norm(e + turn)


def before_a_low_hop(body: Body, impacts: Impacts) -> int:
    """Count the leading impacts up to the first flight no higher than `LOW_HOP` r."""
    hops = impacts.contact_velocity_after[:-1, 2] * np.diff(impacts.time)
    low = hops < LOW_HOP * body.radius
    return int(np.argmax(low)) + 1 if low.any() else len(impacts)


def agreeing_impacts(a: Impacts, b: Impacts) -> int:
    """Count the leading impacts that agree in face, in time and in impulse within the horizon's errors."""
    n = min(len(a), len(b))
    difference = np.linalg.norm(a.impulse[:n] - b.impulse[:n], axis=1)
    agrees = (
        (a.face[:n] == b.face[:n])
        & (np.abs(a.time[:n] - b.time[:n]) <= TIME_ERROR)
        & (difference <= IMPULSE_ERROR * np.linalg.norm(a.impulse[:n], axis=1))
    )
    return n if agrees.all() else int(np.argmin(agrees))
