"""Where a coin is above the floor: its gap, its lowest point, and how long it surely stays clear."""

import math

from models.compiled import compiled
from models.vectors import add, cross, dot, norm

# Below this sine of the tilt a face counts as flat: its whole rim is at one height within rounding.
FLAT_SINE = 1e-14


@compiled
def height_of_center(body, z, up):
    """Give the height of the geometric centre B [m].

    Args:
        body: the coin.
        z: height of the mass centre C [m].
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
    """
    return z - dot(up, body.center)


@compiled
def gap(body, z, up):
    """Give the height of the coin's lowest point above the floor [m], negative below it.

    Args:
        body: the coin.
        z: height of the mass centre C [m].
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
    """
    tilt_sine = (up[0] * up[0] + up[1] * up[1]) ** 0.5
    return height_of_center(body, z, up) - body.thickness / 2 * abs(up[2]) - body.radius * tilt_sine


@compiled
def lowest_point(body, up, w):
    """Give the point of the coin that is lowest, or about to be.

    On the rim, unless a face lies flat. The whole rim of a flat face is lowest: if the coin turns, the
    point that moves down fastest is given; if it does not, the point of the face under C.

    Args:
        body: the coin.
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
        w: angular velocity, body frame, (3,) [rad/s].

    Returns:
        point: from B, body frame, (3,) [m].
        flat: whether the point is that under C, for a coin that lands flat without turning.
    """
    r, half = body.radius, body.thickness / 2
    side = -1.0 if up[2] > 0 else 1.0
    tilt_sine = (up[0] * up[0] + up[1] * up[1]) ** 0.5
    if tilt_sine > FLAT_SINE:
        return (-r * up[0] / tilt_sine, -r * up[1] / tilt_sine, side * half), False
    turning = (w[0] * w[0] + w[1] * w[1]) ** 0.5
    if turning > 0:
        return (-side * r * w[1] / turning, side * r * w[0] / turning, side * half), False
    return (body.center[0], body.center[1], side * half), True


@compiled
def _largest_drag(body):
    """Give k, the larger of the drag coefficients of force [kg/s]."""
    return max(body.drag.force_tangential, body.drag.force_normal)


@compiled
def damping_rate(body):
    """Give κ = k (1/m + |c|²/J_min), a bound on the rate at which drag changes the velocity of B [1/s]."""
    c = body.center
    return _largest_drag(body) * (1 / body.mass + dot(c, c) / body.inertia_smallest)


@compiled
def acceleration_bounds(body, v, w, window):
    """Bound the accelerations of a flying coin over a time window.

    The spin: ω̃ = √(2 T_rot/J_min) ≥ |ω| changes only by the air's force at B, whose arm to C is c:
    dω̃/dt ≤ k |c| |v_B|/J_min. With p = |v_C| + ω̃ |c| ≥ |v_B| and k the largest drag coefficient,
    dp/dt ≤ g + κ p, κ = k (1/m + |c|²/J_min), which Grönwall's lemma closes.

    Args:
        body: the coin.
        v: velocity of C, space frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        window: length of the time window [s].

    Returns:
        of_height: bound on the downward acceleration of any point on the axis Bζ within the coin [m/s²].
        of_normal: bound on |d²n_z/dt²|, n the coin's normal in space [1/s²].
    """
    J = body.inertia
    energy_twice = dot(w, (dot(J[0], w), dot(J[1], w), dot(J[2], w)))
    arm = norm(body.center)
    drag = _largest_drag(body)
    turn_drag = max(body.drag.moment_tangential, body.drag.moment_normal)
    spin = (energy_twice / body.inertia_smallest) ** 0.5
    speed = norm(v) + spin * arm
    if drag > 0:
        speed = (speed + body.gravity * window) * math.exp(damping_rate(body) * window)
        spin += drag * arm / body.inertia_smallest * window * speed
    turning = (
        (body.inertia_largest - body.inertia_smallest) / 2 * spin * spin
        + turn_drag * spin
        + arm * drag * speed
    ) / body.inertia_smallest
    of_normal = spin * spin + turning
    of_height = body.gravity + drag * speed / body.mass + (arm + body.thickness / 2) * of_normal
    return of_height, of_normal


@compiled
def clear_time(body, z, v, up, w, window):
    """Give a time during which a flying coin surely does not reach the floor [s].

    The rim of the face at ζ = ±h/2, whose centre is at height q, is clear while F = q² - r² (1 - n_z²) > 0.
    F has no kinks, and F'' >= -K with K = 2 q_max (bound on -q'') + 2 r² (bound on |n_z''|); so F stays
    positive up to the positive root of F + F' t - K t²/2. Stepping by this time is a Newton iteration
    that approaches the first touch from before, quadratically, and never passes it.

    Args:
        body: the coin.
        z: height of C [m].
        v: velocity of C, space frame, (3,) [m/s].
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
        window: the longest time of interest [s].

    Returns:
        A time in [0, window].
    """
    r = body.radius
    # Bounds over a window much longer than the drag's own time would be too wide to be of use.
    if damping_rate(body) * window > 0.5:
        window = 0.5 / damping_rate(body)
    of_height, of_normal = acceleration_bounds(body, v, w, window)
    up_rate = cross(up, w)
    tilt_sine = (up[0] * up[0] + up[1] * up[1]) ** 0.5
    center_rate = v[2] - dot(up_rate, body.center)
    clear = window
    for side in (-0.5, 0.5):
        q = height_of_center(body, z, up) + side * body.thickness * up[2]
        q_rate = center_rate + side * body.thickness * up_rate[2]
        q_most = abs(q) + abs(q_rate) * window + of_height * window * window / 2
        F = max((q - r * tilt_sine) * (q + r * tilt_sine), 0.0)
        F_rate = 2 * (q * q_rate + r * r * up[2] * up_rate[2])
        K = 2 * (q_most * of_height + r * r * of_normal)
        root = (F_rate * F_rate + 2 * K * F) ** 0.5
        # Of the two forms of the root, each sign of F_rate takes the one without cancellation.
        if F_rate > 0:
            clear = min(clear, (F_rate + root) / K)
        elif F > 0:
            clear = min(clear, 2 * F / (root - F_rate))
        else:
            clear = 0.0
    return clear


@compiled
def contact_velocity(body, R, v, w, point):
    """Give the velocity of the coin's point `point` in space: v_C + R (ω × (A - C)).

    Args:
        body: the coin.
        R: rotation matrix, body to space.
        v: velocity of C, space frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        point: A from B, body frame, (3,) [m].
    """
    arm = (point[0] - body.center[0], point[1] - body.center[1], point[2] - body.center[2])
    turn = cross(w, arm)
    return add(v, (dot(R[0], turn), dot(R[1], turn), dot(R[2], turn)))
