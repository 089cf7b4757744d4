"""What a formula gives against each bound that is proved on it, over the ranges that its fields may have."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.edge.restoring import TRIAL, restoring_acceleration
from cointoss.analytic.contact.edge.rocking import steady_lean, turning_back
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.entries import force_and_moment
from cointoss.analytic.flight.first_touch import (
    HeightAndTilt,
    bounds_of,
    height_and_tilt,
    rim_clearance,
    touch_bound,
)
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.flight.turning import turning_of
from cointoss.analytic.horizon.touch_derivatives import LEAST_STEP, speed_scale, step_size
from cointoss.analytic.numerics.rotation import quaternion_rate
from cointoss.models.attitude import rotation_matrix, turn_by
from cointoss.models.barriers import barrier, highest_on_floor, spin_barrier, spin_barrier_bound
from cointoss.models.body import AirLaw, Body, is_ideal
from cointoss.models.catch import approach_hand
from cointoss.models.clearance import (
    acceleration_bounds,
    clear_time,
    drag_bound,
    fastest_motion,
    grazing_time,
    useful_window,
)
from cointoss.models.ending import idle_energy
from cointoss.models.geometry import contact_velocity, evaluate_gap, gap, lowest_point
from cointoss.models.kernel.vectors import Vector
from cointoss.models.laws import ContactLaw
from cointoss.models.making import Cylinder, make_body, moved_inertia
from cointoss.models.perpetual import loss_to_come
from cointoss.models.rest import is_held
from cointoss.models.restitution import (
    chatter_restitution,
    elastic_restitution,
    elastic_speed,
    largest_restitution,
    restitution_at_speed,
)
from tests.helpers.contacts import held, upright_coin
from tests.helpers.draws import draw_quaternion, scenario
from tests.helpers.tuples import matrix, quaternion, vector

RULES = scenario().rules
Pairs = Iterator[tuple[float, float]]
"""Values, each with what bounds it from above."""


def power_of_ten(rng: np.random.Generator, low: float, high: float) -> float:
    """Draw a number whose logarithm is uniform; one in four is 0."""
    return float(10 ** rng.uniform(low, high)) if rng.random() < 3 / 4 else 0.0


def draw_body(rng: np.random.Generator, air: bool = True, exponent: float | None = None) -> Body:
    """Draw a coin of any size, shape, mass and inertia, in any air and gravity."""
    size, mass, g = 10 ** rng.uniform(-6, 6, 3)
    cylinder = Cylinder(mass, size, size * power_of_ten(rng, -3, 1))
    center, J = (0.0, 0.0, 0.0), moved_inertia(cylinder, (0.0, 0.0, 0.0))
    if rng.random() < 2 / 3:
        center = vector(rng.uniform(-0.5, 0.5, 3) * [size, size, cylinder.thickness])
        turn = np.array(rotation_matrix(quaternion(draw_quaternion(rng))))
        a, b, c = mass * size**2 * 10 ** rng.uniform(-2, 0, 3)
        J = matrix(turn @ np.diag([b + c, a + c, a + b]) @ turn.T)
    slows = mass * (g / size) ** 0.5 / size**2 / (size * g) ** ((exponent or 0.0) / 2)
    drags = [slows * power_of_ten(rng, -4, 0.5) if air else 0.0 for _ in range(2)]
    return make_body(cylinder, center, J, AirLaw(exponent, *drags), g, 0.0)


def draw_state(rng: np.random.Generator, body: Body) -> np.ndarray:
    """Draw a motion whose lowest point is at the floor, often nearly flat or upright, (13,)."""
    e = draw_quaternion(rng)
    if rng.random() < 1 / 2:  # near to the flat or the upright attitude
        tilt = rng.choice([0.0, np.pi / 4]) + 10 ** rng.uniform(-9, -1)
        e = [np.cos(tilt), np.sin(tilt), 0.0, 0.0]
    rate = (body.gravity / body.radius) ** 0.5
    w = rng.normal(size=3) * [power_of_ten(rng, -4, 2) * rate for _ in range(3)]
    v = rng.normal(size=3) * power_of_ten(rng, -4, 1.5) * body.radius * rate
    z = -gap(body, 0.0, rotation_matrix(quaternion(e))[2])
    return np.array([0.0, 0.0, z, *v, *e, *w])


def rate_of(body: Body, y: np.ndarray) -> np.ndarray:
    """Return the rate of a flying coin's state, (13,)."""
    R, w, J = np.array(rotation_matrix(quaternion(y[6:10]))), y[10:13], np.array(body.inertia)
    f, m = force_and_moment(body, vector(R.T @ y[3:6]), vector(w))
    speeding = R @ f / body.mass - [0, 0, body.gravity]
    spinning = np.array(body.inertia_inverse) @ (m - np.cross(w, J @ w))
    return np.array([*y[3:6], *speeding, *quaternion_rate(quaternion(y[6:10]), vector(w)), *spinning])


def flown(body: Body, y: np.ndarray, time: float, steps: int = 24) -> np.ndarray:
    """Return states on a flight, by Runge-Kutta's method, (steps + 1, 13)."""
    states, dt = [y], time / steps
    for _ in range(steps):
        a = rate_of(body, y)
        b = rate_of(body, y + dt / 2 * a)
        c = rate_of(body, y + dt / 2 * b)
        y = y + dt / 6 * (a + 2 * b + 2 * c + rate_of(body, y + dt * c))
        y[6:10] /= np.linalg.norm(y[6:10])
        states.append(y)
    return np.array(states)


def motion_of(y: np.ndarray) -> tuple[Vector, Vector, Vector]:
    """Return the velocity, the upward unit vector in the body frame and the spin of a state, (13,)."""
    return vector(y[3:6]), rotation_matrix(quaternion(y[6:10]))[2], vector(y[10:13])


class Flight(NamedTuple):
    """A flight from the floor on, a window long."""

    body: Body
    window: float
    states: np.ndarray
    start: tuple[Vector, Vector, Vector]
    """The `motion_of` its start."""


def draw_flight(rng: np.random.Generator) -> Flight:
    """Draw a flight of a few radians at most, in linear air or other."""
    body = draw_body(rng, exponent=rng.choice([None, None, None, 0.5, 1.0]))
    y = draw_state(rng, body)
    v, up, w = motion_of(y)
    turning = np.linalg.norm(np.array(body.inertia) @ w) / body.inertia_smallest
    window = 10 ** rng.uniform(-3, 0) / (turning + (body.gravity / body.radius) ** 0.5)
    window = useful_window(body, v, w, window)
    return Flight(body, window, flown(body, y, window), (v, up, w))


def restitutions(rng: np.random.Generator) -> Pairs:
    """A restitution never grows with the speed; the largest is that above the threshold."""
    rules, v = draw_floor(rng), 10 ** rng.uniform(-6, 3)
    yield restitution_at_speed(rules, v), largest_restitution(rules)
    yield elastic_restitution(rules, v * 10 ** rng.uniform(0, 2)), elastic_restitution(rules, v)


def draw_floor(rng: np.random.Generator):
    """Draw how the restitution falls with the speed."""
    return RULES._replace(
        restitution=rng.choice([rng.uniform(0, 1), 1.0]),
        restitution_threshold=power_of_ten(rng, -4, 1),
        restitution_speed=10 ** rng.uniform(-3, 3),
        restitution_exponent=rng.choice([0.0, rng.uniform(0, 1)]),
        restitution_viscous=power_of_ten(rng, -3, 1),
    )


def impacts_to_come(rng: np.random.Generator) -> Pairs:
    """A geometric chatter outlasts the impacts to come: their speeds add up to no more."""
    rules = draw_floor(rng)
    first = speed = rules.restitution_threshold + 10 ** rng.uniform(-4, 2)
    total, kept = 0.0, chatter_restitution(rules, speed)
    for _ in range(300):
        total += speed
        speed *= restitution_at_speed(rules, speed)
    yield total, first / (1 - kept) if kept < 1 else np.inf


def forces_of_air(rng: np.random.Generator) -> Pairs:
    """The force and the moment about C of the air."""
    body = draw_body(rng, exponent=rng.choice([None, 0.5, 1.0]))
    y = draw_state(rng, body)
    v, _, w = motion_of(y)
    f, m = force_and_moment(body, vector(np.array(rotation_matrix(quaternion(y[6:10]))).T @ v), w)
    k, arm, turn_drag = drag_bound(body, v, w, 0.0)
    spin = (np.array(w) @ body.inertia @ w / body.inertia_smallest) ** 0.5
    p = np.linalg.norm(v) + spin * arm
    yield float(np.linalg.norm(f)), k * p
    yield float(np.linalg.norm(m)), arm * k * p + turn_drag * spin


def motions(rng: np.random.Generator) -> Pairs:
    """Speed and spin over a window."""
    body, window, states, (v, _, w) = draw_flight(rng)
    _, arm, _, speed, spin = fastest_motion(body, v, w, window)
    energy = np.einsum("ni,ij,nj->n", states[:, 10:], np.array(body.inertia), states[:, 10:])
    spins = (energy / body.inertia_smallest) ** 0.5
    yield spins.max(), spin
    if body.drag.force_normal + body.drag.force_tangential > 0:  # else it isn't bounded by it
        yield (np.linalg.norm(states[:, 3:6], axis=1) + spins * arm).max(), speed


def accelerations(rng: np.random.Generator) -> Pairs:
    """Of the normal, of its height, and downward of the faces' centres."""
    body, window, states, (v, up, w) = draw_flight(rng)
    bounds = acceleration_bounds(body, v, up, w, window)
    for y in states[::6]:
        R, dy, spin = np.array(rotation_matrix(quaternion(y[6:10]))), rate_of(body, y), y[10:13]

        def bent(point: np.ndarray) -> np.ndarray:
            """Return the acceleration in space of a point of the coin, from C, less that of C."""
            turning = np.cross(dy[10:13], point) + np.cross(spin, np.cross(spin, point))  # noqa: B023
            return R @ turning  # noqa: B023

        normal = bent(np.array([0.0, 0.0, 1.0]))
        yield abs(normal[2]), bounds.of_height_of_normal
        yield float(np.linalg.norm(normal)), bounds.of_normal
        for side in (-0.5, 0.5):
            face = bent(np.array([0.0, 0.0, side * body.thickness]) - body.center)
            yield -(dy[5] + face[2]), bounds.of_height


def clear_times(rng: np.random.Generator) -> Pairs:
    """The time for which a coin just above the floor is clear, against its first touch."""
    body, window, states, (v, up, w) = draw_flight(rng)
    above = body.radius * 10 ** rng.uniform(-6, 0)
    times = np.linspace(0, window, len(states))
    gaps = [gap(body, y[2] + above, rotation_matrix(quaternion(y[6:10]))[2]) for y in states]
    touches = times[np.array(gaps) < -1e-9 * body.radius]
    yield clear_time(body, states[0, 2] + above, v, up, w, window), touches.min(initial=np.inf)


def grazes(rng: np.random.Generator) -> Pairs:
    """How far a coin sinks whose lowest point has no speed, in its grazing time."""
    body = draw_body(rng, air=False)
    y = draw_state(rng, body)
    y[5] -= evaluate_gap(body, state_of(y)).speed
    v, up, w = motion_of(y)
    sink = 1e-6 * body.radius
    time, _ = grazing_time(body, v, up, w, sink)
    gaps = [
        gap(body, z, rotation_matrix(quaternion(e))[2]) for z, *e in flown(body, y, time)[:, [2, 6, 7, 8, 9]]
    ]
    yield -min(gaps), 3 * sink + 1e-12 * abs(y[2])


def catches(rng: np.random.Generator) -> Pairs:
    """The time for which C stays on its side of a hand."""
    body, window, states, _ = draw_flight(rng)
    start, side = states[0].copy(), rng.choice([1.0, -1.0])
    start[2] += 10 * body.radius
    height = start[2] - side * body.radius * 10 ** rng.uniform(-3, 0)
    passed = side * (states[:, 2] - states[0, 2] + start[2] - height) < 0
    found = approach_hand(body, height, side > 0, state_of(start), window)
    yield found.step, np.linspace(0, window, len(states))[passed].min(initial=np.inf)


def heights_of_center(body: Body, tilts: np.ndarray, around: np.ndarray) -> np.ndarray:
    """Return the height of C of a coin on the floor, by tilt and by direction, (tilts, directions) [m]."""
    across, up = np.sin(tilts)[:, None], np.cos(tilts)[:, None]
    x, y, z = body.center
    lever = x * np.sin(around) * across + y * np.cos(around) * across + z * up
    return lever + body.thickness / 2 * abs(up) + body.radius * across


AROUND = np.linspace(0, 2 * np.pi, 121)
SAMPLED = 1 + 1e-4
"""What the largest of samples may lack."""


def barriers(rng: np.random.Generator) -> Pairs:
    """The least energy to roll over, against all ways over; and the largest height of C."""
    body, side = draw_body(rng), rng.choice([1.0, -1.0])
    tilts = np.linspace(0 if side > 0 else np.pi, np.pi / 2, 400)
    heights = heights_of_center(body, tilts, AROUND)
    lowest = body.mass * body.gravity * heights.max(axis=0).min()
    yield barrier(body, side), lowest * SAMPLED
    yield lowest, barrier(body, side) * (1 + 1e-3)
    yield heights.max(), highest_on_floor(body)


def spins(rng: np.random.Generator) -> Pairs:
    """The least energy that conserved spin needs to turn over, against every tilt and direction."""
    body = draw_body(rng, air=False)
    y = draw_state(rng, body)
    up, w, J = rotation_matrix(quaternion(y[6:10]))[2], vector(y[10:13]), np.array(body.inertia)
    now = np.arctan2(np.hypot(up[0], up[1]), up[2])
    tilts = np.linspace(now, np.pi / 2, 400)
    u = np.stack(
        np.broadcast_arrays(
            np.sin(tilts)[:, None] * np.sin(AROUND),
            np.sin(tilts)[:, None] * np.cos(AROUND),
            np.cos(tilts)[:, None],
        ),
        axis=-1,
    )
    weight = body.mass * body.gravity * heights_of_center(body, tilts, AROUND)
    L = J @ w
    spinning = (L @ up) ** 2 / (2 * np.einsum("...i,ij,...j", u, J, u))
    if is_ideal(body):
        turning = L @ up - L[2] * np.cos(tilts)
        spinning = (turning**2 / (2 * J[0, 0] * np.sin(tilts) ** 2) + L[2] ** 2 / (2 * J[2, 2]))[:, None]
    needed = spin_barrier(body, up, w)
    yield needed, spin_barrier_bound(body, up, w)
    yield needed, (weight + spinning).min(axis=1).max() * SAMPLED


def idle_energies(rng: np.random.Generator) -> Pairs:
    """The loss of the energy that never turns into height, against that of all energy, in linear air."""
    body = draw_body(rng)
    y, dt = draw_state(rng, body), (body.radius / body.gravity) ** 0.5

    def losses(spin: np.ndarray) -> tuple[float, float]:
        """Return both, with another spin."""
        y[10:13] = spin
        dy, R = rate_of(body, y), np.array(rotation_matrix(quaternion(y[6:10])))
        before, after = (  # their difference is exact, of squares
            idle_energy(body, RULES, vector(y[3:6] + side * dy[3:6]), vector(spin + side * dy[10:13]))
            for side in (-dt / 2, dt / 2)
        )
        f, m = force_and_moment(body, vector(R.T @ y[3:6]), vector(spin))
        return (before - after) / dt, -(R @ f @ y[3:6] + np.array(m) @ spin) + 1e-12 * (before + after) / dt

    spin = y[10:13].copy()
    if np.any(body.center):  # the air's horizontal force at B turns the coin so
        R = np.array(rotation_matrix(quaternion(y[6:10])))
        f, _ = force_and_moment(body, vector(R.T @ y[3:6]), (0.0, 0.0, 0.0))
        spin = np.cross(body.center, R.T @ (R @ f * [1, 1, 0]))
    # Of all spins about the axis that which loses least of the rest.
    back, still, on = (np.subtract(*losses(side * spin)) for side in (-1.0, 0.0, 1.0))
    bend = back + on - 2 * still
    yield losses((back - on) / (2 * bend) * spin if bend < 0 else spin)


def losses_to_come(rng: np.random.Generator) -> Pairs:
    """What a coin will lose whose loss in each doubling grows no faster than it did."""
    growth = np.sort(rng.uniform(0.2, 1.3) * rng.uniform(0.8, 1, 20) ** rng.integers(2))[::-1]
    losses = rng.uniform(0, 1) * np.cumprod(growth)
    energies = 1e3 - np.cumsum(losses)
    yield losses[6:].sum(), loss_to_come(energies[:6], 1e-12, 14.0)


def steps_to_a_kink(rng: np.random.Generator) -> Pairs:
    """The change with which an impact is differentiated, against where it is not smooth."""
    body = draw_body(rng)
    y, rules = draw_state(rng, body), draw_floor(rng)._replace(law=ContactLaw.COULOMB, friction=0.3)
    v, up, w = motion_of(y)
    v_A = contact_velocity(body, state_of(y).R, v, w, lowest_point(body, up, w)[0])
    if elastic_speed(rules) > 0:  # near to which it is drawn
        near = abs(v_A[2]) * (1 + power_of_ten(rng, -9, 0)) / elastic_speed(rules)
        rules = rules._replace(restitution_speed=rules.restitution_speed * near)
    part = step_size(body, rules, y, v_A)
    if part > LEAST_STEP:
        yield part, min(abs(up[2]), np.hypot(up[0], up[1]))
        for speed in (v_A[2], np.hypot(v_A[0], v_A[1]), v_A[2] + elastic_speed(rules)):
            yield part * speed_scale(body, y), abs(speed)


def holds(rng: np.random.Generator) -> Pairs:
    """How far C and the floor's point part before resistance has taken the energy that it holds."""
    body = draw_body(rng, air=False)
    y, unit = draw_state(rng, body), (body.gravity / body.radius) ** 0.5
    up = np.array(state_of(y).R[2])
    point, _ = lowest_point(body, vector(up), (0.0, 0.0, 0.0))
    arm = np.array(state_of(y).R) @ (np.array(point) - body.center)
    lever = np.hypot(arm[0], arm[1])
    delta = lever + body.radius * 10 ** rng.uniform(-3, 0)
    axis = rng.normal(size=3)
    slow, fast = 0.0, 1e-2 * unit
    for _ in range(50):
        y[3:6], y[10:13] = 0.0, axis / np.linalg.norm(axis) * (slow + fast) / 2
        if is_held(body, delta, 0.0, state_of(y), vector(arm), False):
            slow = (slow + fast) / 2
        else:
            fast = (slow + fast) / 2
    energy, spare = slow**2 * (axis @ body.inertia @ axis) / (axis @ axis) / 2, delta - lever
    for angle in np.linspace(0, 2 * energy / (body.mass * body.gravity * spare), 5)[1:]:
        turned = rotation_matrix(turn_by(vector(angle * axis / np.linalg.norm(axis))))
        after = vector(np.array(turned).T @ up)
        new, _ = lowest_point(body, after, (0.0, 0.0, 0.0))
        yield np.linalg.norm(np.cross(after, np.array(new) - body.center)) - lever, spare / 2


def restoring(rng: np.random.Generator) -> Pairs:
    """The work that turns a rocking coin back, against its two ends; and the strongest force, at the edge."""
    body = draw_body(rng, air=False)
    if body.thickness == 0:
        return
    y = upright_coin(body, rng.uniform(0, 6), *rng.normal(0, (body.gravity / body.radius) ** 0.5, 2))
    contact, rim, most = (
        held(body, FloorFriction(0.0), Mode.SLIDING, y),
        rng.choice([1.0, -1.0]),
        steady_lean(body),
    )
    leans = np.linspace(TRIAL, most, 17)
    weakest, mean, strongest = turning_back(contact, rim, most, y)
    if most > 1e-6 and weakest > 0:
        back = [restoring_acceleration(contact, rim, lean, y) for lean in leans]
        yield mean * most, np.trapezoid(back, leans) * (1 + 1e-3)
        yield max(back), strongest * (1 + 5e-3)


def closed_touches(rng: np.random.Generator) -> Pairs:
    """F of a rim, in the time that one evaluation of an ideal coin's flight bounds."""
    body = draw_body(rng, air=False)
    body = make_body(
        Cylinder(body.mass, body.radius, body.thickness),
        (0.0, 0.0, 0.0),
        moved_inertia(Cylinder(body.mass, body.radius, body.thickness), (0.0, 0.0, 0.0)),
        body.air,
        body.gravity,
        0.0,
    )
    y = draw_state(rng, body)
    turning = turning_of(body, state_of(y))
    z = y[2] + body.radius * 10 ** rng.uniform(-6, -0.5)
    heights = (z, y[5], -body.gravity / 2)
    window = 10 ** rng.uniform(-2, 0) / (turning.rate + (body.gravity / body.radius) ** 0.5)

    def at(t: float) -> HeightAndTilt:
        return height_and_tilt(turning, heights, t)

    now = touch_bound(body, at(0.0), bounds_of(turning, body.gravity, 0.0, 0.0), window)
    for t in np.linspace(0, now.ahead, 9)[:-1]:
        for rim in (1.0, -1.0):
            yield -rim_clearance(body, at(t), rim)[0], 1e-9 * body.radius**2
    for t in np.linspace(0, now.latest, 9):
        yield rim_clearance(body, at(t), now.lower)[2], now.rise


BOUNDED: dict[str, tuple[Callable[[np.random.Generator], Pairs], int, float]] = {
    "restitution": (restitutions, 300, 0.99),
    "impacts to come": (impacts_to_come, 100, 0.99),
    "air": (forces_of_air, 200, 0.5),
    "motion": (motions, 40, 0.9),
    "acceleration": (accelerations, 30, 0.9),
    "clear time": (clear_times, 40, 0.5),
    "graze": (grazes, 60, 0.1),
    "catch": (catches, 40, 0.5),
    "barrier": (barriers, 100, 0.99),
    "spin": (spins, 100, 0.9),
    "idle energy": (idle_energies, 300, 0.9),
    "losses to come": (losses_to_come, 300, 0.5),
    "kink": (steps_to_a_kink, 300, 1e-3),
    "hold": (holds, 200, 0.1),
    "restoring": (restoring, 40, 0.9),
    "closed touch": (closed_touches, 100, 0.9),
}
"""What yields values with their bounds, how often it is drawn, and how near to a bound some comes."""


@pytest.mark.parametrize("name", BOUNDED)
def test_no_value_is_beyond_its_bound_and_some_come_near(name):
    pairs_of, draws, near = BOUNDED[name]
    rng, nearest = np.random.default_rng(1), 0.0
    for number in range(draws):
        for value, bound in pairs_of(rng):
            assert value <= bound + 1e-9 * abs(bound), (number, value, bound)
            if 0 < bound < np.inf:
                nearest = max(nearest, value / bound)
    assert nearest > near
