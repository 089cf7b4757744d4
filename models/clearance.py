"""Bounds on the motion of a flying coin, and a time during which it certainly stays clear of the floor."""

import math
from typing import NamedTuple

from cointoss.models.body import Body, is_linear
from cointoss.models.geometry import FLAT_SINE, height_of_center, tilt_sine_of
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, cross, dot, norm


@compiled
def _spin_bound(body: Body, w: Vector) -> float:
    """Return ω̃ = √(2 T_rot/J_min) ≥ |ω| [rad/s]; without air it never changes."""
    J = body.inertia
    energy_twice = dot(w, (dot(J[0], w), dot(J[1], w), dot(J[2], w)))
    return (energy_twice / body.inertia_smallest) ** 0.5


@compiled
def drag_bound(body: Body, v: Vector, w: Vector, window: float) -> tuple[float, float, float]:
    """Bound the air's force and moment about C by k p and ℓ k p + d ω̃, with p = |v_C| + ω̃ ℓ, over a window.

    For b = 0 p bounds the speed of B: k and d are the largest coefficients, ℓ is B's distance from C.
    For b > 0 p bounds the speed of the whole surface, ℓ its distance from C: the force on dA is at most
    λ p^b p. Pressure acts on one of the faces and half of the wall at a time. Air takes energy, so gravity
    alone can raise √(2 T/m), by g dt: that bounds p^b for the whole window.

    Args:
        body: the coin.
        v: velocity of C, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        window: length of the time window [s].

    Returns:
        k [kg/s], ℓ [m], and d [kg m²/s].
    """
    air, drag, r, h = body.air, body.drag, body.radius, body.thickness
    if is_linear(air):
        return (
            max(drag.force_tangential, drag.force_normal),
            norm(body.center),
            max(drag.moment_tangential, drag.moment_normal),
        )
    arm = norm(body.center) + math.hypot(r, h / 2)
    spin, ratio = _spin_bound(body, w), body.inertia_smallest / body.mass
    start = (dot(v, v) + ratio * spin * spin) ** 0.5
    fastest = (start + (body.gravity + body.downhill) * window) * (1 + arm * arm / ratio) ** 0.5
    k = math.pi * r * (r + h) * (air.normal + 2 * air.tangential) * _power(fastest, air.exponent)
    return k, arm, 0.0


@compiled
def _power(x: float, b: float | None) -> float:
    """Return x^b, with b = 0 in linear air."""
    return 1.0 if b is None else x**b


@compiled
def damping_rate(body: Body, v: Vector, w: Vector, window: float) -> float:
    """Return κ = k (1/m + ℓ²/J_min), bounding the rate at which drag changes velocities [1/s].

    Args:
        body: the coin.
        v: velocity of C, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        window: length of the time window [s].
    """
    k, arm, _ = drag_bound(body, v, w, window)
    return k * (1 / body.mass + arm * arm / body.inertia_smallest)


@compiled
def fastest_motion(
    body: Body, v: Vector, w: Vector, window: float
) -> tuple[float, float, float, float, float]:
    """Bound p = |v_C| + ω̃ ℓ and ω̃ over a time window, and return k, ℓ and d of `drag_bound` before them."""
    drag, arm, turn_drag = drag_bound(body, v, w, window)
    spin = _spin_bound(body, w)
    speed = norm(v) + spin * arm
    if drag > 0:
        g = body.gravity + body.downhill
        speed = (speed + g * window) * math.exp(damping_rate(body, v, w, window) * window)
        spin += drag * arm / body.inertia_smallest * window * speed
    return drag, arm, turn_drag, speed, spin


class Accelerations(NamedTuple):
    """Bounds on the accelerations of a flying coin."""

    of_height: float
    """Downward, of any point on the axis Bζ within the coin [m/s²]."""
    of_height_of_normal: float
    """|d²n_z/dt²|, n the coin's normal in space [1/s²]."""
    of_normal: float
    """|d²n/dt²| [1/s²]."""


@compiled
def acceleration_bounds(body: Body, v: Vector, up: Vector, w: Vector, window: float) -> Accelerations:
    """Bound the accelerations of a flying coin over a time window.

    The spin: ω̃ = √(2 T_rot/J_min) ≥ |ω| changes only by the air: dω̃/dt ≤ ℓ k p/J_min, with k, ℓ and
    p = |v_C| + ω̃ ℓ of `drag_bound`. dp/dt ≤ g + κ p, κ = k (1/m + ℓ²/J_min), which Grönwall's lemma
    closes.

    The turning ω⊥ across the normal, alone, tilts the coin: |ṅ| = |ω⊥|. With j = (J_ξζ, J_ηζ) and D the
    spread of the moments of inertia, |ω̇⊥| ≤ a + β |ω⊥|, β = (ω̃ D + d)/J_min, where a holds the rest: of j and
    of the air. So a coin that spins flat is known to stay nearly flat, however fast it spins.

    n̈ = ω̇ × n + ω × (ω × n) is at most ω̃ |ω⊥| + |ω̇⊥|. Its vertical part is -n_z |ω⊥|² plus, times the sine of
    the tilt, at most ω̃ |ω⊥| + |ω̇⊥|. C, |c| off the axis, adds at most |c| (|ω̇| + ω̃ |ω_h|), ω_h the horizontal
    part of ω.

    Args:
        body: the coin.
        v: velocity of C, space frame, (3,) [m/s].
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
        window: length of the time window [s].
    """
    J, J_min = body.inertia, body.inertia_smallest
    drag, arm, turn_drag, speed, spin = fastest_motion(body, v, w, window)
    j, spread = math.hypot(J[0][2], J[1][2]), body.inertia_largest - J_min
    apart = (2 * spin * spin * j + arm * drag * speed) / J_min + j / J_min * turn_drag * spin / J_min
    growth = (spin * spread + turn_drag) / J_min
    across = math.hypot(w[0], w[1])
    # Beyond this the exponential overflows, and is no number times 0.
    across = (
        min((across + apart * window) * math.exp(growth * window), spin) if growth * window < 700 else spin
    )
    spin_rate = (spread / 2 * spin * spin + turn_drag * spin + arm * drag * speed) / J_min
    across_rate = min(apart + growth * across, spin_rate)
    tilt_sine = min(math.hypot(up[0], up[1]) + across * window, 1.0)
    of_height_of_normal = across * min(across + tilt_sine * spin, spin) + tilt_sine * across_rate
    of_center = norm(body.center) * (spin_rate + spin * (across + tilt_sine * spin))
    return Accelerations(
        body.gravity + drag * speed / body.mass + of_center + body.thickness / 2 * of_height_of_normal,
        of_height_of_normal,
        spin * across + across_rate,
    )


@compiled
def clear_time(body: Body, z: float, v: Vector, up: Vector, w: Vector, window: float) -> float:
    """Return a time during which a flying coin certainly does not reach the floor [s].

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
    window = useful_window(body, v, w, window)
    bounds = acceleration_bounds(body, v, up, w, window)
    up_rate = cross(up, w)
    tilt_sine = tilt_sine_of(up)
    center_rate = v[2] - dot(up_rate, body.center)
    clear = window
    for rim in (-0.5, 0.5):
        q = height_of_center(body, z, up) + rim * body.thickness * up[2]
        q_rate = center_rate + rim * body.thickness * up_rate[2]
        q_most = abs(q) + abs(q_rate) * window + bounds.of_height * window * window / 2
        F = max((q - r * tilt_sine) * (q + r * tilt_sine), 0.0)
        F_rate = 2 * (q * q_rate + r * r * up[2] * up_rate[2])
        K = 2 * (q_most * bounds.of_height + r * r * bounds.of_height_of_normal)
        clear = min(clear, first_root(F, F_rate, K))
    return clear


@compiled
def useful_window(body: Body, v: Vector, w: Vector, window: float) -> float:
    """Return a window of at most half the drag's time constant; in longer windows the bounds are too wide."""
    rate = damping_rate(body, v, w, window)
    return 0.5 / rate if rate * window > 0.5 else window


@compiled
def first_root(F: float, rate: float, K: float) -> float:
    """Return the positive root of F + rate t - K t²/2, or 0 where F = 0 falls; F >= 0 and K > 0."""
    root = (rate * rate + 2 * K * F) ** 0.5
    # Each sign of the rate uses that form of the root which has no cancellation.
    if rate > 0:
        return (rate + root) / K
    return 2 * F / (root - rate) if F > 0 else 0.0


@compiled
def grazing_time(body: Body, v: Vector, up: Vector, w: Vector, sink: float) -> tuple[float, float]:
    """Return a time in which a coin that touches, its lowest point not moving down, hardly sinks.

    With q the height of the lower face's centre and p the horizontal part of the normal, |p| the sine of the
    tilt, the gap is q - r |p|. Beside the accelerations, two kinks lower it: as p passes 0 the opposite side
    of the rim becomes the lowest, as n_z passes 0 the other face does.

    Args:
        body: the coin.
        v: velocity of C, space frame, (3,) [m/s].
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
        sink: by how much the acceleration and each of the two kinks may lower the gap [m].

    Returns:
        time: the time [s].
        acceleration: the largest downward acceleration of the gap in that time, apart from a passing of 0
        [m/s²].
    """
    bounds = acceleration_bounds(body, v, up, w, 0.0)
    acceleration = bounds.of_height + body.radius * bounds.of_normal
    time = (2 * sink / acceleration) ** 0.5
    tilt_sine = tilt_sine_of(up)
    up_rate = cross(up, w)
    if tilt_sine > FLAT_SINE:
        # |p + ṗ t| exceeds |p| + |p|' t by at most sink/r up to the root of a quadratic.
        rate = (up[0] * up_rate[0] + up[1] * up_rate[1]) / tilt_sine
        turning = (up[0] * w[0] + up[1] * w[1]) / tilt_sine
        acceleration += body.radius * turning * turning / tilt_sine
        part = sink / body.radius
        room = (2 * tilt_sine + part) * part
        divisor = ((part * rate) ** 2 + turning * turning * room) ** 0.5 - part * rate
        if divisor > 0:
            time = min(time, room / divisor)
    if up[2] * up_rate[2] < 0 and body.thickness > 0:
        time = min(time, (abs(up[2]) + sink / body.thickness) / abs(up_rate[2]))
    return time, acceleration
