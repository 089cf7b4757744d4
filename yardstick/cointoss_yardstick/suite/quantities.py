"""What is measured of a simulated toss: one function a quantity, by its name in cases.toml."""

from collections.abc import Callable

import numpy as np

from cointoss import Impacts
from cointoss.study import Array, common_prefix, energies, momentum_residuals
from cointoss_yardstick.simulators.observed import ObservedToss


class NothingSeenError(ValueError):
    """The event that a quantity measures did not happen in a toss."""


def _impacts(seen: ObservedToss) -> Impacts:
    if not len(seen.impacts):
        raise NothingSeenError(f"no impact was seen in {seen.states.time[-1]:.4g} s")
    return seen.impacts


def _first_impact(seen: ObservedToss) -> Impacts:
    return _impacts(seen)[:1]


def position_at_the_end(seen: ObservedToss) -> Array:
    """Return the position of the mass centre at the end, space frame, (3,) [m]."""
    return seen.states.position[-1]


def way_sideways_at_the_end(seen: ObservedToss) -> Array:
    """Return the horizontal way of the mass centre, (2,) [m]."""
    return (seen.states.position[-1] - seen.states.position[0])[:2]


def velocity_at_the_end(seen: ObservedToss) -> Array:
    """Return the velocity of the mass centre at the end, space frame, (3,) [m/s]."""
    return seen.states.velocity[-1]


def spin_halfway_and_at_the_end(seen: ObservedToss) -> Array:
    """Return the angular velocity at half the time and at the end, body frame, (6,) [rad/s]."""
    return seen.states.angular_velocity[[len(seen.states.time) // 2, -1]].ravel()


def attitude_halfway_and_at_the_end(seen: ObservedToss) -> Array:
    """Return the Euler parameters at half the time and at the end, each with its largest positive, (8,)."""
    e = seen.states.quaternion[[len(seen.states.time) // 2, -1]]
    return (e * np.sign(e[[0, 1], np.argmax(np.abs(e), axis=1)])[:, None]).ravel()


def period_of_spin(seen: ObservedToss) -> Array:
    """Return the mean time from one rise of ω_η through 0 to the next [s]."""
    return _period(seen.states.time, seen.states.angular_velocity[:, 1])


def period_of_lean(seen: ObservedToss) -> Array:
    """Return the mean time from one rise of n_z through its middle to the next [s]."""
    n_z = seen.states.normal[:, 2]
    return _period(seen.states.time, n_z - (n_z.max() + n_z.min()) / 2)


def _period(time: Array, values: Array) -> Array:
    i = np.flatnonzero((values[:-1] <= 0) & (values[1:] > 0))
    if len(i) < 2:
        raise NothingSeenError(f"no whole period was seen in {time[-1]:.4g} s")
    rises = time[i] - values[i] * (time[i + 1] - time[i]) / (values[i + 1] - values[i])
    return np.array([(rises[-1] - rises[0]) / (len(rises) - 1)])


def restitution(seen: ObservedToss) -> Array:
    """Return -v_Az'/v_Az of the point that touches first."""
    first = _first_impact(seen)
    return -first.contact_velocity_after[:, 2] / first.contact_velocity_before[:, 2]


def rebound_of_the_centre(seen: ObservedToss) -> Array:
    """Return -v_z'/v_z of the mass centre at the first impact."""
    first = _first_impact(seen)
    return -first.velocity_after[:, 2] / first.velocity_before[:, 2]


def height_after_ten_touches(seen: ObservedToss) -> Array:
    """Return the largest height of the lowest point between touches 10 and 11, over the first height."""
    touches, _ = seen.stretches
    if len(touches) < 11:
        raise NothingSeenError(f"{len(touches)} touches were seen in {seen.states.time[-1]:.4g} s, not 11")
    return seen.heights[touches[9][1] : touches[10][0] + 1].max(keepdims=True) / seen.heights[0]


def first_impulse(seen: ObservedToss) -> Array:
    """Return the impulse of the first impact, space frame, (3,) [N s]."""
    return _first_impact(seen).impulse[0]


def spin_after_the_first_impact(seen: ObservedToss) -> Array:
    """Return the angular velocity after the first impact, body frame, (3,) [rad/s]."""
    return _first_impact(seen).angular_velocity_after[0]


def sideways_impulse(seen: ObservedToss) -> Array:
    """Return the largest horizontal part of an impulse, |S_xy|/|S|."""
    S = _impacts(seen).impulse
    return np.array([np.max(np.hypot(S[:, 0], S[:, 1]) / np.linalg.norm(S, axis=1))])


def moment_of_the_impulse(seen: ObservedToss) -> Array:
    """Return by how much J Δω = a × S fails at the first impact, against r |S|."""
    return momentum_residuals(seen.scenario.body, _first_impact(seen))


def time_of_rest(seen: ObservedToss) -> Array:
    """Return the time from which the coin stays within a thousandth of its first height [s]."""
    high = np.flatnonzero(seen.heights > 1e-3 * seen.heights[0])
    return seen.states.time[[min(int(high[-1]) + 1, len(seen.heights) - 1)]]


def exponent_of_the_fall(seen: ObservedToss) -> Array:
    """Return p of a lean that falls as (t₀ - t)^p, from the times at which it is 0.2, 0.1 and 0.05 rad."""
    lean, time = np.arccos(np.clip(np.abs(seen.states.normal[:, 2]), 0, 1)), seen.states.time
    last = [np.flatnonzero(lean > each) for each in (0.2, 0.1, 0.05)]
    if not all(len(each) and each[-1] + 1 < len(time) for each in last):
        raise NothingSeenError("the coin did not come down from 0.2 to 0.05 rad")
    a, b, c = (time[each[-1] + 1] for each in last)
    return np.array([np.log(2) / np.log((b - a) / (c - b))])


def drift(seen: ObservedToss) -> Array:
    """Return how far the mass centre moves at most, but for the depth m g/k on a spring that is named [m]."""
    away = seen.states.position - seen.states.position[0]
    away[:, 2] -= np.clip(
        away[:, 2], -seen.scenario.body.mass * seen.scenario.body.gravity / seen.stiffness, 0
    )
    return np.array([np.linalg.norm(away, axis=1).max()])


def energy_gained_at_a_touch(seen: ObservedToss) -> Array:
    """Return the mean relative change of energy from touch to touch."""
    E = energies(seen.scenario.body, seen.states)
    return np.array([np.log(E[-1] / E[0]) / len(_impacts(seen))])


def faces(seen: ObservedToss) -> Array:
    """Return the faces up at the touches, 1 heads and 2 tails, (n,)."""
    return seen.impacts.face.astype(float)


QUANTITIES: dict[str, Callable[[ObservedToss], Array]] = {
    each.__name__: each
    for each in (
        position_at_the_end,
        way_sideways_at_the_end,
        velocity_at_the_end,
        spin_halfway_and_at_the_end,
        attitude_halfway_and_at_the_end,
        period_of_spin,
        period_of_lean,
        restitution,
        rebound_of_the_centre,
        height_after_ten_touches,
        first_impulse,
        spin_after_the_first_impact,
        sideways_impulse,
        moment_of_the_impulse,
        time_of_rest,
        exponent_of_the_fall,
        drift,
        energy_gained_at_a_touch,
        faces,
    )
}
"""The quantities by their names."""


def height_at_touches(seen: ObservedToss, tolerance: float, part: float) -> tuple[float, bool]:
    """Return the height most beyond what is allowed, or else the largest, and whether it is beyond.

    Heights are of the lowest point. At a touch, of a coin that came from above, it is that at the time at
    which its change of velocity explains the next position; at rest it is that of the last state of a lasting
    contact. Allowed are the tolerance, at a touch a part of the way to the next state, the whole where a step
    may be late, and the depth m g/k on a spring that the engine names [m].
    """
    body, states, (impacts, contacts) = seen.scenario.body, seen.states, seen.stretches
    above, z, v = seen.heights, states.position[:, 2], states.velocity[:, 2]
    touches = [
        k
        for k, ((_, end), (first, _)) in enumerate(zip([(0, 0), *impacts], impacts, strict=False))
        if above[min(end, first) : first + 1].max() > -tolerance
    ]
    a = np.array([impacts[k][0] for k in touches], dtype=int)
    T, gain, rate = (
        np.diff(states.time)[a],
        seen.gains[a, 2],
        seen.impacts.contact_velocity_before[touches, 2],
    )
    by_floor = z[a + 1] - z[a] - v[a] * T + body.gravity * T**2 / 2
    until = T - np.divide(by_floor, gain, out=np.zeros_like(gain), where=gain > 0)
    turning = body.radius * np.linalg.norm(states.angular_velocity[a, :2], axis=1)
    rest = [above[k] for _, k in contacts if seen.is_still(k)]
    height = np.array([0.0, *(above[a] + rate * np.clip(until, 0.0, T)), *rest])
    first = height if part < 1 else np.array([0.0, *above[a], *rest])
    way = part * np.array([0.0, *((np.abs(rate) + turning) * T), *(0.0 for _ in rest)])
    low = -first - way - body.mass * body.gravity / seen.stiffness
    beyond = np.maximum(first - way, low) - tolerance
    is_beyond = bool(beyond.max() > 0)
    return float(height[np.argmax(beyond if is_beyond else np.abs(height))]), is_beyond


def error_of(found: Array, right: Array, scale: float) -> float:
    """Return the error of a quantity: |found - right| over a scale; of faces, the part missed.

    Args:
        found: that was measured, (n,).
        right: what it should be, (n,).
        scale: of the error, in the quantity's unit; of faces 0.
    """
    if scale == 0:
        known, seen = ("".join(f"{face:.0f}" for face in each) for each in (right, found))
        return 1 - common_prefix(known, seen) / len(right)
    return float(np.linalg.norm(found - right)) / scale
