"""Sustained contact a step at a time, at the tolerance of flights, and coins upright on the floor."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from cointoss.analytic.contact.automaton import (
    Event,
    Mode,
    contact_at,
    margin_event,
    mode_after,
    project,
)
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.integrator import ContactStep, contact_work, step_contact
from cointoss.analytic.contact.resets import stop_slip, tip_over
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.numerics.tolerances import STEP_ERROR
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.body import Body
from cointoss.models.geometry import evaluate_gap
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.records import Array
from tests.helpers.draws import ZLOTY

step_contact = by_numba(step_contact)

SMOOTH = FloorFriction(0.0)


def held(body: Body, friction: FloorFriction, mode: int, y: Array) -> SustainedContact:
    """Return the contact of a coin in the state y; see `cointoss.analytic.contact.automaton.contact_at`."""
    return contact_at(body, friction, int(mode), y)


def put_on_floor(body: Body, friction: FloorFriction, mode: int, y: Array) -> None:
    """Project y onto the floor, as its mode allows; see `cointoss.analytic.contact.automaton.project`."""
    project(held(body, friction, mode, y), y)


def end_mode(body: Body, friction: FloorFriction, mode: int, y: Array) -> Event:
    """Return the event of a mode whose margin is zero, past `TOUCHING`, and apply its reset to y."""
    contact = held(body, friction, mode, y)
    event = margin_event(contact, y)
    if event == Event.TIPS_OVER:
        tip_over(body, friction, y)
        return end_mode(body, friction, Mode.TOUCHING, y)
    if event in {Event.SLIP_STARTS, Event.SLIP_STOPS}:
        stop_slip(contact, mode_after(int(mode), event), y)
    return event


def follow_step(body: Body, friction: FloorFriction, mode: int, y: Array, dt: float) -> ContactStep:
    """Advance y by one step in contact, or to its end; see `cointoss.analytic.contact.integrator`."""
    contact = held(body, friction, mode, y)
    return step_contact(contact, y, dt, STEP_ERROR, contact_work(contact, y))


def follow_for(body: Body, friction: FloorFriction, mode: int, y: Array, time: float) -> tuple[Array, Array]:
    """Return the states and times after every step of a contact that goes on so long."""
    y, states, times, dt = y.copy(), [y.copy()], [0.0], np.inf
    stages = contact_work(held(body, friction, mode, y), y)
    while times[-1] < time:
        step = step_contact(held(body, friction, mode, y), y, min(dt, time - times[-1]), STEP_ERROR, stages)
        assert not step.is_over
        dt = step.next_dt
        states.append(y.copy())
        times.append(times[-1] + step.elapsed)
    return np.array(states), np.array(times)


def tilts_of(y: Array) -> Array:
    """Return the tilts of coins up to 90 degrees, (..., 13) to (...) [rad]."""
    e = y[..., 6:10]
    return np.arcsin(np.minimum(2 * np.hypot(e[..., 0], e[..., 3]) * np.hypot(e[..., 1], e[..., 2]), 1.0))


def set_upright(
    coin: Mapping[str, Any] = ZLOTY, speed: float = 0.0, spin: Sequence[float] = (0.0, 0.0, 0.0)
) -> Array:
    """Return the state of a balanced coin upright on the floor; ζ is along -y, and η upwards."""
    attitude = quaternion_from_angles((0.0, np.pi / 2, 0.0))
    return np.array([0, 0, coin["radius"], speed, 0, 0, *attitude, *spin])


def touching(body: Body, speed: float) -> Array:
    """Return a tilted coin whose lowest point touches the floor at this speed."""
    y = np.array([0, 0, 0, 0.2, 0.1, 0, *quaternion_from_angles((0.0, 0.6, 0.0)), 1.0, 0.5, 0.3])
    height, falling = evaluate_gap(body, state_of(y))
    y[2] -= height
    y[5] -= falling + speed
    return y


def upright_coin(body: Body, phase: float, turn_rate: float, roll_rate: float) -> Array:
    """Return a coin upright on the floor that turns about the vertical and rolls [rad/s]."""
    y = np.array([0, 0, 0, 0.1, -0.2, 0, *quaternion_from_angles((0.3, np.pi / 2, phase)), 0, 0, roll_rate])
    up = rotation_matrix(tuple(y[6:10]))[2]
    y[10:13] += turn_rate * np.array(up)
    put_on_floor(body, SMOOTH, Mode.UPRIGHT, y)
    return y
