"""What a formula gives against each bound that is proved on it, over the ranges that its fields may have."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.edge.restoring import TRIAL, restoring_acceleration
from cointoss.analytic.contact.edge.rocking import steady_lean, turning_back
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.entries import force_and_moment
from cointoss.analytic.flight.first_touch import bounds_of, height_and_tilt, rim_clearance, touch_bound
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.flight.turning import turning_of
from cointoss.analytic.horizon.touch_derivatives import LEAST_STEP, speed_scale, step_size
from cointoss.analytic.numerics.rotation import quaternion_rate
from cointoss.models.attitude import rotation_matrix, turn_by
from cointoss.models.barriers import barrier, edge_barrier, highest_on_floor, spin_barrier, spin_barrier_bound
from cointoss.models.body import AirLaw, Body, Rules, is_ideal
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

RULES, FREE = scenario().rules, FloorFriction(0.0)
AROUND, SAMPLED = np.linspace(0, 2 * np.pi, 121), 1 + 1e-4
"""Directions, and what the largest of samples may lack."""
Draws = np.random.Generator
Pairs = Iterator[tuple[Any, Any]]
"""Values, each with what bounds it from above."""


def power_of_ten(rng: Draws, low: float, high: float) -> float:
    """Draw a number whose logarithm is uniform; one in four is 0."""
    return float(10 ** rng.uniform(low, high)) if rng.random() < 3 / 4 else 0.0


def rotation(y: np.ndarray) -> np.ndarray:
    """Return the rotation matrix of a state, (3, 3)."""
    return np.array(rotation_matrix(quaternion(y[6:10])))


def draw_body(rng: Draws, air: float = 1.0, exponent: float | None = None, balanced: bool = False) -> Body:
    """Draw a coin of any size, shape, mass and inertia, in any air and gravity."""
    size, mass, g = 10 ** rng.uniform(-6, 6, 3)
    cylinder, center = Cylinder(mass, size, size * power_of_ten(rng, -3, 1)), (0.0, 0.0, 0.0)
    J = moved_inertia(cylinder, center)
    if not balanced and rng.random() < 2 / 3:
        center = vector(rng.uniform(-0.5, 0.5, 3) * [size, size, cylinder.thickness])
        turn = np.array(rotation_matrix(quaternion(draw_quaternion(rng))))
        a, b, c = mass * size**2 * 10 ** rng.uniform(-2, 0, 3)
        J = matrix(turn @ np.diag([b + c, a + c, a + b]) @ turn.T)
    slows = air * mass * (g / size) ** 0.5 / size**2 / (size * g) ** ((exponent or 0.0) / 2)
    drags = [slows * power_of_ten(rng, -4, 0.5) for _ in range(2)]
    return make_body(cylinder, center, J, AirLaw(exponent, *drags), g, 0.0)


def draw_state(rng: Draws, body: Body) -> np.ndarray:
    """Draw a motion whose lowest point is at the floor, often nearly flat or upright, (13,)."""
    e, tilt = draw_quaternion(rng), rng.choice([0.0, np.pi / 4]) + 10 ** rng.uniform(-9, -1)
    e = e if rng.random() < 1 / 2 else [np.cos(tilt), np.sin(tilt), 0.0, 0.0]
    rate = (body.gravity / body.radius) ** 0.5
    w = rng.normal(size=3) * [power_of_ten(rng, -4, 2) * rate for _ in range(3)]
    v = rng.normal(size=3) * power_of_ten(rng, -4, 1.5) * body.radius * rate
    return np.array([0.0, 0.0, -gap(body, 0.0, rotation_matrix(quaternion(e))[2]), *v, *e, *w])


def motion_of(y: np.ndarray) -> tuple[Any, Any, Any]:
    """Return the velocity, the upward unit vector in the body frame and the spin of a state, (13,)."""
    return vector(y[3:6]), vector(rotation(y)[2]), vector(y[10:13])


def accelerated(body: Body, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the rates of a flying coin's velocity and spin, (3,) each."""
    R, w, J = rotation(y), y[10:13], np.array(body.inertia)
    f, m = force_and_moment(body, vector(R.T @ y[3:6]), vector(w))
    return R @ f / body.mass + [body.downhill, 0, -body.gravity], np.linalg.solve(J, m - np.cross(w, J @ w))


def rate_of(body: Body, y: np.ndarray) -> np.ndarray:
    """Return the rate of a flying coin's state, (13,)."""
    speeding, spinning = accelerated(body, y)
    turning = quaternion_rate(quaternion(y[6:10]), vector(y[10:13]))
    return np.concatenate([y[3:6], speeding, turning, spinning])


def flown(body: Body, y: np.ndarray, time: float) -> np.ndarray:
    """Return states on a flight, by Runge-Kutta's method, (17, 13)."""
    states, dt = [y], time / 16
    while len(states) < 17:
        a = rate_of(body, y)
        b = rate_of(body, y + dt / 2 * a)
        c = rate_of(body, y + dt / 2 * b)
        y = y + dt / 6 * (a + 2 * b + 2 * c + rate_of(body, y + dt * c))
        states.append(y)
    return np.array(states)


def draw_flight(rng: Draws) -> tuple[Body, float, np.ndarray, Any, Any, Any]:
    """Draw a flight of a radian at most: coin, length, states and `motion_of` the first."""
    body = draw_body(rng, exponent=(None, None, None, 0.5, 1.0)[rng.integers(5)])
    body = body._replace(downhill=body.gravity * power_of_ten(rng, -1, 2))
    y = draw_state(rng, body)
    v, up, w = motion_of(y)
    turning = np.linalg.norm(np.array(body.inertia) @ w) / body.inertia_smallest
    window = useful_window(
        body, v, w, 10 ** rng.uniform(-3, 0) / (turning + (body.gravity / body.radius) ** 0.5)
    )
    return body, window, flown(body, y, window), v, up, w


def draw_floor(rng: Draws) -> Rules:
    """Draw how the restitution falls with the speed."""
    return RULES._replace(
        restitution=rng.choice([rng.uniform(0, 1), 1.0]),
        restitution_threshold=power_of_ten(rng, -4, 1),
        restitution_speed=10 ** rng.uniform(-3, 3),
        restitution_exponent=rng.choice([0.0, rng.uniform(0, 1)]),
        restitution_viscous=power_of_ten(rng, -3, 1),
    )


def restitutions(rng: Draws) -> Pairs:
    """A restitution never grows with the speed; the largest is that above the threshold."""
    rules, v = draw_floor(rng), 10 ** rng.uniform(-6, 3)
    yield restitution_at_speed(rules, v), largest_restitution(rules)
    yield elastic_restitution(rules, v * 10 ** rng.uniform(0, 2)), elastic_restitution(rules, v)


def impacts_to_come(rng: Draws) -> Pairs:
    """A geometric chatter outlasts the impacts to come: their speeds add up to no more."""
    rules = draw_floor(rng)
    speeds = [rules.restitution_threshold + 10 ** rng.uniform(-4, 2)]
    for _ in range(300):
        speeds.append(speeds[-1] * restitution_at_speed(rules, speeds[-1]))
    yield sum(speeds) * (1 - chatter_restitution(rules, speeds[0])), speeds[0]


def forces_of_air(rng: Draws) -> Pairs:
    """The force and the moment about C of the air."""
    body = draw_body(rng, exponent=(None, 0.5, 1.0)[rng.integers(3)])
    y = draw_state(rng, body)
    v, _, w = motion_of(y)
    f, m = force_and_moment(body, vector(rotation(y).T @ v), w)
    k, arm, turn_drag = drag_bound(body, v, w, 0.0)
    spin = (np.array(w) @ body.inertia @ w / body.inertia_smallest) ** 0.5
    p = np.linalg.norm(v) + spin * arm
    yield from zip(np.linalg.norm([f, m], axis=1), (k * p, arm * k * p + turn_drag * spin), strict=True)


def motions(rng: Draws) -> Pairs:
    """Spin, and speed in air, over a window."""
    body, window, states, v, _, w = draw_flight(rng)
    drag, arm, _, speed, spin = fastest_motion(body, v, w, window)
    energies = np.einsum("ni,ij,nj->n", states[:, 10:], np.array(body.inertia), states[:, 10:])
    spins = (energies / body.inertia_smallest) ** 0.5
    yield spins.max(), spin
    yield (np.linalg.norm(states[:, 3:6], axis=1) + spins * arm).max() * (drag > 0), speed


def accelerations(rng: Draws) -> Pairs:
    """Of the normal, of its height, and downward of the faces' centres."""
    body, window, states, v, up, w = draw_flight(rng)
    bounds = acceleration_bounds(body, v, up, w, window)
    faces = np.outer([-0.5, 0.5], [0.0, 0.0, body.thickness]) - body.center
    for y in states[::4]:
        falling, spinning = accelerated(body, y)
        points = np.vstack([[0.0, 0.0, 1.0], faces])
        bent = (np.cross(spinning, points) + np.cross(y[10:13], np.cross(y[10:13], points))) @ rotation(y).T
        yield abs(bent[0, 2]), bounds.of_height_of_normal
        yield np.linalg.norm(bent[0]), bounds.of_normal
        yield -(falling[2] + bent[1:, 2].min()), bounds.of_height


def clear_times(rng: Draws) -> Pairs:
    """The time for which a coin just above the floor is clear, against its first touch."""
    body, window, states, v, up, w = draw_flight(rng)
    above = body.radius * 10 ** rng.uniform(-6, 0)
    gaps = np.array([gap(body, y[2] + above, vector(rotation(y)[2])) for y in states])
    touches = np.linspace(0, window, len(states))[gaps < -1e-9 * body.radius]
    yield clear_time(body, states[0, 2] + above, v, up, w, window), touches.min(initial=np.inf)


def grazes(rng: Draws) -> Pairs:
    """How far a coin sinks whose lowest point has no speed, in its grazing time."""
    body = draw_body(rng, air=0.0)
    y, sink = draw_state(rng, body), 1e-6 * body.radius
    y[5] -= evaluate_gap(body, state_of(y)).speed
    time, _ = grazing_time(body, *motion_of(y), sink)
    gaps = [gap(body, each[2], vector(rotation(each)[2])) for each in flown(body, y, time)]
    yield -min(gaps), 3 * sink + 1e-12 * abs(y[2])


def catches(rng: Draws) -> Pairs:
    """The time for which C stays on its side of a hand."""
    body, window, states, *_ = draw_flight(rng)
    side, away = rng.choice([1.0, -1.0]), body.radius * 10 ** rng.uniform(-3, 0)
    passed = side * (states[:, 2] - states[0, 2]) + away < 0
    lifted = state_of(states[0] + 10 * body.radius * np.eye(13)[2])
    found = approach_hand(body, lifted.position[2] - side * away, side > 0, lifted, window)
    yield found.step, np.linspace(0, window, len(states))[passed].min(initial=np.inf)


def ups(tilts: np.ndarray) -> np.ndarray:
    """Return the upward unit vector in the body frame by tilt and by direction, (tilts, directions, 3)."""
    across, up = np.sin(tilts)[:, None], np.cos(tilts)[:, None] + 0 * AROUND
    return np.stack([across * np.sin(AROUND), across * np.cos(AROUND), up], axis=-1)


def weights(body: Body, up: np.ndarray) -> np.ndarray:
    """Return the energy of C's height where the coin is on the floor, by its `ups` [J]."""
    sine = np.hypot(up[..., 0], up[..., 1])
    height = up @ body.center + body.thickness / 2 * abs(up[..., 2]) + body.radius * sine
    return body.mass * body.gravity * height


def barriers(rng: Draws) -> Pairs:
    """The least energy to roll over is that of all ways over; and the largest height of C."""
    body, side = draw_body(rng), rng.choice([1.0, -1.0])
    energies = weights(body, ups(np.linspace(0 if side > 0 else np.pi, np.pi / 2, 400)))
    lowest = energies.max(axis=0).min()
    yield barrier(body, side), lowest * SAMPLED
    yield lowest, barrier(body, side) * (1 + 1e-3)
    yield energies.max(), highest_on_floor(body) * body.mass * body.gravity


def spins(rng: Draws) -> Pairs:
    """The least energy that conserved spin needs to turn over, against every tilt and direction."""
    body = draw_body(rng, air=0.0)
    _, up, w = motion_of(draw_state(rng, body))
    tilts, J = np.linspace(np.arctan2(np.hypot(up[0], up[1]), up[2]), np.pi / 2, 400), np.array(body.inertia)
    u, L = ups(tilts), J @ w
    spinning = (L @ up) ** 2 / (2 * np.einsum("...i,ij,...j", u, J, u))
    if is_ideal(body):
        across = (L @ up - L[2] * np.cos(tilts)) ** 2 / (2 * J[0, 0] * np.sin(tilts) ** 2)
        spinning = (across + L[2] ** 2 / (2 * J[2, 2]))[:, None]
    needed = spin_barrier(body, up, w)
    yield needed, spin_barrier_bound(body, up, w)
    yield needed, (weights(body, u) + spinning).min(axis=1).max() * SAMPLED


def edges(rng: Draws) -> Pairs:
    """What the edge is said to need beyond an upright coin, and what some lean to either side needs."""
    body = draw_body(rng, air=0.0, balanced=True)
    h, (J, _, J_zeta) = body.thickness / 2, np.diag(body.inertia)
    corner, weight = h / np.hypot(body.radius, h), body.mass * body.gravity
    n, turn = corner * rng.uniform(-1, 1), (body.gravity / body.radius) ** 0.5 * 10 ** rng.uniform(-1, 1)
    roll = rng.uniform(-1, 1) * weight * h / (J_zeta * turn)
    L_z, L_zeta = J * turn * (1 - n * n) ** 0.5 + J_zeta * roll * n, J_zeta * roll
    needed = edge_barrier(body, ((1 - n * n) ** 0.5, 0.0, n), (turn, 0.0, roll))
    side, leans = np.array([[1], [-1]]), np.linspace(0, corner, 2000)
    across = (L_z - side * L_zeta * leans) ** 2 / (2 * J * (1 - leans**2)) + L_zeta**2 / (2 * J_zeta)
    energies = weight * (body.radius * np.sqrt(1 - leans**2) + h * leans) + across
    if needed and corner > 1e-3:
        passes = np.where(leans >= side * n, energies, 0).max(axis=1) - energies[0, 0]
        yield needed - energies[0, 0], passes.min() * SAMPLED


def idle_energies(rng: Draws) -> Pairs:
    """The loss of the energy that never turns into height, against that of all energy, in linear air."""
    body = draw_body(rng)
    y, dt = draw_state(rng, body), (body.radius / body.gravity) ** 0.5
    R = rotation(y)
    if np.any(body.center):  # the air's horizontal force at B turns the coin so
        f, _ = force_and_moment(body, vector(R.T @ y[3:6]), (0.0, 0.0, 0.0))
        y[10:13] = np.cross(body.center, R.T @ (R @ f * [1, 1, 0]))

    def losses(part: float) -> tuple[float, float]:
        """Return both, with a part of that spin."""
        turned = np.array([*y[:10], *part * y[10:13]])
        (dv, dw), (v, _, w) = accelerated(body, turned), motion_of(turned)
        before, after = (  # their difference is exact, of squares
            idle_energy(body, RULES, vector(v + side * dv), vector(w + side * dw))
            for side in (-dt / 2, dt / 2)
        )
        f, m = force_and_moment(body, vector(R.T @ v), w)
        return (before - after) / dt, -(R @ f @ v + np.dot(m, w)) + 1e-12 * (before + after) / dt

    # Of all spins about the axis that which loses least of the rest.
    back, still, on = (np.subtract(*losses(part)) for part in (-1.0, 0.0, 1.0))
    bend = back + on - 2 * still
    yield losses((back - on) / (2 * bend) if bend < 0 else 1.0)


def losses_to_come(rng: Draws) -> Pairs:
    """What a coin will lose whose loss in each doubling grows no faster than it did."""
    growth = np.sort(rng.uniform(0.2, 1.3) * rng.uniform(0.8, 1, 20) ** rng.integers(2))[::-1]
    losses = rng.uniform(0, 1) * np.cumprod(growth)
    yield losses[6:].sum(), loss_to_come(1e3 - np.cumsum(losses, dtype=np.float64)[:6], 1e-12, 14.0)


def steps_to_a_kink(rng: Draws) -> Pairs:
    """The change with which an impact is differentiated, against where it is not smooth."""
    body = draw_body(rng)
    y, rules = draw_state(rng, body), draw_floor(rng)._replace(law=ContactLaw.COULOMB, friction=0.3)
    v, up, w = motion_of(y)
    v_A = contact_velocity(body, state_of(y).R, v, w, lowest_point(body, up, w)[0])
    if elastic_speed(rules) > 0:  # near to which it is drawn
        near = abs(v_A[2]) * (1 + power_of_ten(rng, -9, 0)) / elastic_speed(rules)
        rules = rules._replace(restitution_speed=rules.restitution_speed * near)
    part = step_size(body, rules, y, v_A)
    for speed in (v_A[2], np.hypot(v_A[0], v_A[1]), v_A[2] + elastic_speed(rules)):
        yield (part - LEAST_STEP) * speed_scale(body, y), abs(speed)
    yield part - LEAST_STEP, min(abs(up[2]), np.hypot(up[0], up[1]))


def holds(rng: Draws) -> Pairs:
    """How far C and the floor's point part before resistance has taken the energy that it holds."""
    body = draw_body(rng, air=0.0)
    y, axis = draw_state(rng, body), rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    R, weight = rotation(y), body.mass * body.gravity

    def arm(up: np.ndarray) -> np.ndarray:
        """Return the arm of the lowest point from C, body frame."""
        return np.subtract(lowest_point(body, vector(up), (0.0, 0.0, 0.0))[0], body.center)

    lever = float(np.linalg.norm(np.cross(R[2], arm(R[2]))))
    spare, spin = body.radius * 10 ** rng.uniform(-3, 0), 1e-3 * (body.gravity / body.radius) ** 0.5
    y[3:6], y[10:13] = 0.0, spin * axis
    while not is_held(body, lever + spare, 0.0, state_of(y), vector(R @ arm(R[2])), False):
        y[10:13] *= 0.9
    angle = y[10:13] @ body.inertia @ y[10:13] / (weight * spare)
    for turn in np.linspace(0, angle, 5)[1:]:
        up = np.array(rotation_matrix(turn_by(vector(turn * axis)))).T @ R[2]
        yield np.linalg.norm(np.cross(up, arm(up))) - lever, spare / 2


def restoring(rng: Draws) -> Pairs:
    """The mean and the largest force that turns a rocking coin back to its edge."""
    body, rim = draw_body(rng, air=0.0), rng.choice([1.0, -1.0])
    if (most := steady_lean(body)) < 1e-6:
        return
    y = upright_coin(body, rng.uniform(0, 6), *rng.normal(0, (body.gravity / body.radius) ** 0.5, 2))
    contact = held(body, FREE, Mode.SLIDING, y)
    weakest, mean, strongest = turning_back(contact, rim, most, y)
    back = np.array([restoring_acceleration(contact, rim, x, y) for x in np.linspace(TRIAL, most, 17)])
    if weakest > 0:
        yield mean, np.trapezoid(back, dx=1 / 16) * (1 + 1e-3)
        yield back.max(), strongest * (1 + 5e-3)


def closed_touches(rng: Draws) -> Pairs:
    """F of a rim, and its bend, in the time that one evaluation of a balanced coin's flight bounds."""
    body = draw_body(rng, air=0.0, balanced=True)
    y = draw_state(rng, body)
    turning, heights = turning_of(body, state_of(y)), [y[2], y[5], -body.gravity / 2]
    heights[0] += body.radius * 10 ** rng.uniform(-6, -0.5)
    window = 10 ** rng.uniform(-2, 0) / (turning.rate + (body.gravity / body.radius) ** 0.5)
    start, bounds = height_and_tilt(turning, tuple(heights), 0.0), bounds_of(turning, body.gravity, 0.0, 0.0)
    found = touch_bound(body, start, bounds, window)
    for part in np.linspace(0, 1, 9):
        clear, late = (
            height_and_tilt(turning, tuple(heights), part * t) for t in (found.ahead, found.latest)
        )
        for rim in (1.0, -1.0):
            yield -rim_clearance(body, clear, rim)[0], 1e-9 * body.radius**2
        yield rim_clearance(body, late, found.lower)[2], found.rise


BOUNDED: dict[str, tuple[Callable[[Draws], Pairs], int, float]] = {
    "restitution": (restitutions, 300, 0.99),
    "impacts to come": (impacts_to_come, 100, 0.99),
    "air": (forces_of_air, 200, 0.5),
    "motion": (motions, 60, 0.9),
    "acceleration": (accelerations, 120, 0.9),
    "clear time": (clear_times, 60, 0.5),
    "graze": (grazes, 60, 0.1),
    "catch": (catches, 60, 0.5),
    "barrier": (barriers, 100, 0.99),
    "spin": (spins, 100, 0.9),
    "edge": (edges, 300, 0.99),
    "idle energy": (idle_energies, 200, 0.9),
    "losses to come": (losses_to_come, 300, 0.5),
    "kink": (steps_to_a_kink, 300, 1e-3),
    "hold": (holds, 1000, 0.1),
    "restoring": (restoring, 60, 0.9),
    "closed touch": (closed_touches, 100, 0.9),
}
"""What yields values with their bounds, how often it is drawn, and how near to a bound some comes."""


@pytest.mark.parametrize("name", BOUNDED)
def test_no_value_is_beyond_its_bound_and_some_come_near(name):
    pairs_of, draws, near = BOUNDED[name]
    rng = np.random.default_rng(1)
    found = np.array([pair for _ in range(draws) for pair in pairs_of(rng)], dtype=float)
    values, bounds = found.T
    assert found[~(values <= bounds + 1e-9 * np.abs(bounds))].tolist() == []
    assert (values > near * bounds)[(bounds > 0) & (bounds < np.inf)].any()
