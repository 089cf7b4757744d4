"""One contact of MuJoCo's coin with the floor, from first touch to release."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from typing import NamedTuple

import mujoco
import numpy as np

from coin_mj.contact import Friction, Realisation
from coin_mj.friction import coulomb_force, grip_of
from coin_mj.machine import TOUCH_STEP, Knot, Machine
from models.attitude import rotation_matrix
from models.records import Array

LASTING = 20
"""A contact that goes on for so many times its proper duration is no impact."""
FLAT = 1e-8
"""A sine of the tilt that no contact can tell from flat: over the whole coin it is 1e-8 of its width."""


class Contact(NamedTuple):
    """One contact, from first touch to release."""

    start: float
    end: float
    impulse: Array
    """Integral of the floor's force, space frame, (3,) [N s]."""
    lasts: bool
    """Whether it went on for `LASTING` times its proper duration, and was left there."""


def press(machine: Machine) -> Contact | None:
    """Follow a contact from the touch to the release of all rim points; None where nothing was pressed.

    On a coin that lands flat there is no Coulomb force: its impulse goes through C, as in the paper's
    mechanics.
    """
    level = _turned_level(machine)
    if level is None:
        return _press(machine, has_friction=True)
    first = len(machine.knots)
    contact = _press(machine, has_friction=False)
    for number in range(first, len(machine.knots)):
        machine.knots[number] = _turned_back(machine.knots[number], level)
    machine.keep()
    end = _turned_back(machine.knots.pop(), level)
    machine.data.qpos[:], machine.data.qvel[:] = end.qpos, end.qvel
    if contact is None:
        return None
    impulse = np.zeros(3)
    mujoco.mju_rotVecQuat(impulse, contact.impulse, level.turn)
    return contact._replace(impulse=impulse)


class Level(NamedTuple):
    """How a coin that landed flat was turned for its contact."""

    time: float
    turn: Array
    """Euler parameters of the turn back, (4,)."""
    spin: float
    """ω_ζ, taken out during the contact [rad/s]."""


def _turned_level(machine: Machine) -> Level | None:
    """Turn a coin that is flat within `FLAT` about the vertical until its axes are MuJoCo's; stop its spin.

    MuJoCo's plane-cylinder routine finds the lowest rim point from the tilt, and where that is nothing but
    rounding it takes the radius for the height. With the axes of the world it finds the tilt to be exactly
    nothing. The floor and the cylinder are round: neither the turn nor the spin about ζ changes the contact.
    """
    qpos, qvel = machine.data.qpos, machine.data.qvel
    up = rotation_matrix(qpos[3:])[2]
    if np.hypot(up[0], up[1]) > FLAT:
        return None
    flat = np.array([1.0, 0, 0, 0]) if up[2] > 0 else np.array([0, 1.0, 0, 0])
    turn, back = np.zeros(4), np.zeros(4)
    mujoco.mju_negQuat(back, flat)
    mujoco.mju_mulQuat(turn, qpos[3:].copy(), back)
    mujoco.mju_negQuat(back, turn)
    velocity = np.zeros(3)
    mujoco.mju_rotVecQuat(velocity, qvel[:3].copy(), back)
    level = Level(machine.data.time, turn, float(qvel[5]))
    qpos[3:], qvel[:3], qvel[5] = flat, velocity, 0.0
    return level


def _turned_back(knot: Knot, level: Level) -> Knot:
    """Turn a state back, and give it its spin and the angle that it would have spun."""
    angle = level.spin * (knot.time - level.time)
    spun, turned, velocity = np.zeros(4), np.zeros(4), np.zeros(3)
    mujoco.mju_mulQuat(turned, level.turn, knot.qpos[3:])
    mujoco.mju_mulQuat(spun, turned, np.array([np.cos(angle / 2), 0, 0, np.sin(angle / 2)]))
    mujoco.mju_rotVecQuat(velocity, knot.qvel[:3], level.turn)
    w = knot.qvel[3:] + np.array([0, 0, level.spin])
    return knot._replace(qpos=np.array([*knot.qpos[:3], *spun]), qvel=np.array([*velocity, *w]))


def _press(machine: Machine, has_friction: bool) -> Contact | None:
    data, one_step = machine.data, machine.settings.realisation == Realisation.ONE_STEP
    explicit = has_friction and machine.friction > 0 and machine.settings.friction == Friction.EXPLICIT
    start, momentum, other = data.time, _momentum(machine), np.zeros(3)
    pressed = False
    while data.time - start <= LASTING * machine.rebound.duration:
        force = machine.forward()
        if force == 0:
            if pressed:
                break
            if machine.outlook().speed >= 0:
                return None
        # Tiny steps up to the onset, so that it falls between two steps, not into one.
        dt = machine.rebound.step * (1.0 if force > 0 else TOUCH_STEP)
        pressed = pressed or force > 0
        other += dt * _other_force(machine)
        machine.keep(pressed=True)
        if force > 0 and explicit:
            _push_and_rub(machine, dt)
        else:
            machine.push(dt)
        if pressed and one_step:
            data.qpos[2] -= min(machine.outlook().height, 0.0)
            break
    else:
        return Contact(start, data.time, _momentum(machine) - momentum - other, lasts=True)
    return Contact(start, data.time, _momentum(machine) - momentum - other, lasts=False)


def _push_and_rub(machine: Machine, dt: float) -> None:
    """Advance by dt [s] with Coulomb's force in a frictionless contact.

    The step is made without friction, to measure the normal force, and made again with it.
    """
    model, data, start = machine.model, machine.data, machine.knots[-1]
    grip, other = grip_of(model, data), _other_force(machine)[2]
    slip, momentum = grip.jacobian[:2] @ data.qvel, _momentum(machine)[2]
    machine.push(dt)
    normal = (_momentum(machine)[2] - momentum) / dt - other
    slip_free = grip.jacobian[:2] @ data.qvel
    K = grip.mobility
    x, y = coulomb_force(K, machine.friction, normal, slip, slip_free, dt)
    # What the friction takes from the normal force goes with it: MuJoCo, which lets the share 1 - solimp of
    # any other push through its contact, has nothing left to do.
    taken = (K[0, 2] * x + K[1, 2] * y) / K[2, 2]
    machine.return_to(start)
    data.qfrc_applied[:] = np.array([x, y, -taken]) @ grip.jacobian
    machine.forward()
    machine.push(dt)
    data.qfrc_applied[:] = 0


def _momentum(machine: Machine) -> Array:
    v = machine.state()[1]
    return machine.body.mass * np.array(v)


def _other_force(machine: Machine) -> Array:
    """Weight and drag on the coin, space frame, (3,) [N]."""
    weight = np.array([0.0, 0.0, -machine.body.mass * machine.body.gravity])
    return weight + machine.data.qfrc_actuator[:3] + machine.data.qfrc_passive[:3]
