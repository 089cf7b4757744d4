"""A frame that turns as a flying coin does, but for what air and a lack of symmetry make of it.

A symmetric top that no moment acts on turns at a constant rate W about an axis fixed in space, and about its
normal at a constant rate s: e(t) = g exp(W t/2) exp(s ζ t/2), g constant. So the attitude g of the frame, and
ω_F = R_ζ(s t) ω, change slowly in any flight, and a step of a Runge-Kutta method may be the longer (Lawson
1967). This is a change of variables: for every W and s the motion is that of MuJoCo's accelerations.
"""

import math
from typing import NamedTuple

from cointoss.coin_mj.model.state import Motion
from cointoss.models.attitude import Quaternion, quaternion_product
from cointoss.models.kernel.arrays import Array, copy_into, four, three
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, cross, norm, scale


class TurningFrame(NamedTuple):
    """How the frame turns in a step."""

    rate: Vector
    """W, in the body frame at the start of the step, (3,) [rad/s]."""
    spin: float
    """s [rad/s]."""


class Turn(NamedTuple):
    """How far the coin has turned from the frame at a time."""

    about_axis: Quaternion
    """exp(W t/2)."""
    about_normal: Quaternion
    """exp(s ζ t/2)."""


@compiled
def frame_of(motion: Motion, rate: Array) -> TurningFrame:
    """Return the `TurningFrame` in which the coin is at rest at first, and ω nearly constant.

    Args:
        motion: qpos and qvel, (13,).
        rate: their rate of change, (13,).
    """
    w = (motion[10], motion[11], motion[12])
    across = w[0] * w[0] + w[1] * w[1]
    spin = 0.0
    if across > 0:
        # Of a free symmetric top ω̇ = -s ζ × ω, and |s| <= |ω_ζ|.
        spin = (rate[10] * w[1] - rate[11] * w[0]) / across
        spin = min(max(spin, -abs(w[2])), abs(w[2]))
    return TurningFrame((w[0], w[1], w[2] - spin), spin)


@compiled
def turn_after(frame: TurningFrame, time: float) -> Turn:
    """Return the `Turn` after a time [s]."""
    size = norm(frame.rate)
    axis = scale(math.sin(size * time / 2) / size if size > 0 else 0.0, frame.rate)
    half = frame.spin * time / 2
    return Turn(
        (math.cos(size * time / 2), axis[0], axis[1], axis[2]), (math.cos(half), 0.0, 0.0, math.sin(half))
    )


@compiled
def to_motion(turn: Turn, slow: Array, motion: Array) -> None:
    """Write qpos and qvel, (13,), of a state in the turning frame.

    Args:
        turn: the coin's from the frame.
        slow: position of B, g, velocity of B and ω_F, (13,).
        motion: where they go.
    """
    e = quaternion_product(quaternion_product(four(slow, 3), turn.about_axis), turn.about_normal)
    w = about_normal_back(turn, three(slow, 10))
    copy_into(motion, three(slow, 0) + e + three(slow, 7) + w)


@compiled
def write_slow_rate(
    frame: TurningFrame, turn: Turn, slow: Motion | Array, acceleration: Array, rate: Array
) -> None:
    """Write the rate of change of a state in the turning frame.

    Args:
        frame: how it turns.
        turn: the coin's from the frame.
        slow: see `to_motion`.
        acceleration: rate of qvel there, (6,).
        rate: where it goes, (13,).
    """
    w = three(slow, 10)
    w_rate = spin_rate(frame, turn, w, three(acceleration, 3))
    w_g = about_axis(turn, left_over(frame, w))
    g_rate = quaternion_product(four(slow, 3), (0.0, w_g[0] / 2, w_g[1] / 2, w_g[2] / 2))
    copy_into(rate, three(slow, 7) + g_rate + three(acceleration, 0) + w_rate)


@compiled
def left_over(frame: TurningFrame, w: Vector) -> Vector:
    """Return ω_F - s ζ - W, with which g turns, (3,) [rad/s]."""
    return w[0] - frame.rate[0], w[1] - frame.rate[1], w[2] - frame.spin - frame.rate[2]


@compiled
def spin_rate(frame: TurningFrame, turn: Turn, w: Vector, acceleration: Vector) -> Vector:
    """Return the rate of change of ω_F, R_ζ(s t) ω̇ + s ζ × ω_F, (3,) [rad/s²]."""
    turned = about_normal(turn, acceleration)
    return turned[0] - frame.spin * w[1], turned[1] + frame.spin * w[0], turned[2]


@compiled
def about_normal(turn: Turn, a: Vector) -> Vector:
    """Return R_ζ(s t) a of a vector, (3,)."""
    c, s = _cosine_and_sine(turn)
    return c * a[0] - s * a[1], s * a[0] + c * a[1], a[2]


@compiled
def about_normal_back(turn: Turn, a: Vector) -> Vector:
    """Return R_ζ(-s t) a of a vector, (3,)."""
    c, s = _cosine_and_sine(turn)
    return c * a[0] + s * a[1], c * a[1] - s * a[0], a[2]


@compiled
def about_axis(turn: Turn, a: Vector) -> Vector:
    """Return R(exp(W t/2)) a of a vector, (3,)."""
    return _turned(turn.about_axis, a)


@compiled
def about_axis_back(turn: Turn, a: Vector) -> Vector:
    """Return R(exp(W t/2))ᵀ a of a vector, (3,)."""
    p = turn.about_axis
    return _turned((p[0], -p[1], -p[2], -p[3]), a)


@compiled
def _cosine_and_sine(turn: Turn) -> tuple[float, float]:
    c, s = turn.about_normal[0], turn.about_normal[3]
    return c * c - s * s, 2 * c * s


@compiled
def _turned(p: Quaternion, a: Vector) -> Vector:
    """Return a vector turned by Euler parameters p of norm 1, (3,)."""
    axis = (p[1], p[2], p[3])
    twice = scale(2.0, cross(axis, a))
    return add(add(a, scale(p[0], twice)), cross(axis, twice))
