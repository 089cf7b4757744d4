"""How far two paths are apart: in position, and in attitude as an angle."""

import numpy as np

from cointoss.models.records import Array, States


def distance(a: States, b: States) -> Array:
    """Return the distance between the mass centres, (n,) [m]."""
    return np.linalg.norm(a.position - b.position, axis=1)


def attitude_angle(a: States, b: States) -> Array:
    """Return the angle of the rotation from one attitude to the other, (n,) [rad].

    With the Euler parameters of both as unit vectors p and q, the angle is 4 atan2(|p - q|, |p + q|) for the
    nearer of q and -q; this keeps its digits for small angles, where arccos loses half of them.
    """
    p, q = a.quaternion, b.quaternion
    apart, together = np.linalg.norm(p - q, axis=1), np.linalg.norm(p + q, axis=1)
    return 4 * np.arctan2(np.minimum(apart, together), np.maximum(apart, together))


def parting_time(times: Array, apart: Array, limit: float) -> float | None:
    """Return the first time at which a distance exceeds `limit`, or None where it never does.

    Args:
        times: increasing, (n,) [s].
        apart: a distance at these times, (n,).
        limit: the largest distance that counts as together.
    """
    beyond = apart > limit
    return float(times[np.argmax(beyond)]) if beyond.any() else None


def tilt(states: States) -> Array:
    """Return the angle between the coin's normal and the vertical, (n,) [rad]."""
    n = states.normal
    return np.arctan2(np.hypot(n[:, 0], n[:, 1]), n[:, 2])
