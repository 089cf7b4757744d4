"""MuJoCo's coin in motion: steps chosen by the gap in flight, every contact resolved in time.

RK4 throughout: of fourth order in a free joint's position and attitude.
"""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import dataclass, field
from typing import NamedTuple

import mujoco
import numpy as np

from coin_mj.contact import Spring, spring_of
from coin_mj.scene import build, floor_height
from coin_mj.state import of_release, to_mass_center
from coin_mj.stepping import Outlook, outlook
from models.attitude import rotation_matrix
from models.body import Body
from models.records import Array, States
from models.scenario import Scenario

STEPS_PER_CONTACT = 160
"""Steps in half a period of the contact's spring."""
TOUCH_STEP = 1e-3
"""A touch is located to within this part of a contact step."""
LASTING = 20
"""A contact that lasts so many half periods of the spring is no impact."""


FLAT = 1e-8
"""A sine of the tilt that no contact can tell from flat: over the whole coin it is 1e-8 of its width."""


class Knot(NamedTuple):
    """A state on the way, from which the path is stepped again where it is asked for."""

    time: float
    qpos: Array
    qvel: Array
    pressed: bool
    """Whether the coin was in contact."""


@dataclass(kw_only=True, eq=False)
class Machine:
    """MuJoCo's model and data of one coin; it moves, and keeps the knots of its path."""

    model: mujoco.MjModel
    data: mujoco.MjData
    body: Body
    shape: Body
    """The body with the thickness of its shape."""
    floor: float
    """Height of MuJoCo's floor [m]."""
    spring: Spring
    knots: list[Knot] = field(default_factory=list)

    def forward(self) -> float:
        """Compute the accelerations of the present state; give the floor's force along z [N]."""
        mujoco.mj_forward(self.model, self.data)
        return float(self.data.qfrc_constraint[2])

    def step(self, dt: float, pressed: bool = False) -> None:
        """Advance by dt [s] with RK4, after `forward`, and keep the knot left behind."""
        self.keep(pressed)
        _advance(self.model, self.data, dt)

    def set_contacts(self, on: bool) -> None:
        """Let MuJoCo look for contacts, or not."""
        flag = int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
        flags = self.model.opt.disableflags
        self.model.opt.disableflags = flags & ~flag if on else flags | flag

    def keep(self, pressed: bool = False) -> None:
        """Keep the present state as a knot of the path."""
        self.knots.append(Knot(self.data.time, self.data.qpos.copy(), self.data.qvel.copy(), pressed))

    def state(self) -> tuple[Array, Array, Array, Array]:
        """Give position and velocity of C (space), Euler parameters and angular velocity (body)."""
        return to_mass_center(self.body, self.data.qpos, self.data.qvel)

    def outlook(self) -> Outlook:
        """Look at the present state."""
        return outlook(self.shape, self.floor, self.data.qpos, self.data.qvel)

    @property
    def contact_step(self) -> float:
        """Length of a step in contact [s]."""
        return self.spring.duration / STEPS_PER_CONTACT


@dataclass(frozen=True, kw_only=True, eq=False)
class Knots:
    """The path of a toss: the states before all steps.

    In flight they are stepped again by MuJoCo to the times asked for; in contact, where they stand closer
    than a hundredth of a microsecond, they are interpolated.
    """

    model: mujoco.MjModel
    body: Body
    knots: tuple[Knot, ...]

    def sample(self, times: Array) -> States:
        """Give the states at `times` [s], in the order of `times`; at an impact, that at first touch."""
        data = mujoco.MjData(self.model)
        before = np.searchsorted([knot.time for knot in self.knots], times, side="right") - 1
        rows = np.empty((len(times), 13))
        for row, time, number in zip(rows, times, before, strict=True):
            knot = self.knots[number]
            data.qpos[:], data.qvel[:] = knot.qpos, knot.qvel
            if time > knot.time and knot.pressed:
                after = self.knots[number + 1]
                part = (time - knot.time) / (after.time - knot.time)
                data.qpos[:] += part * (after.qpos - knot.qpos)
                data.qvel[:] += part * (after.qvel - knot.qvel)
                mujoco.mju_normalize4(data.qpos[3:])
            elif time > knot.time:
                mujoco.mj_forward(self.model, data)
                _advance(self.model, data, time - knot.time)
            row[:] = np.concatenate(to_mass_center(self.body, data.qpos, data.qvel))
        x, v, e, w = (part.copy() for part in np.split(rows, (3, 6, 10), axis=1))
        return States(time=times.copy(), position=x, velocity=v, quaternion=e, angular_velocity=w)


def machine_of(scenario: Scenario, stiffness: float, thickness: float) -> Machine:
    """Build the MuJoCo coin of a scenario, with the thickness of its shape [m], and put it at its release."""
    spring, body = spring_of(scenario.floor.restitution, stiffness), scenario.body
    model = build(scenario, spring, thickness)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = of_release(body, scenario.release)
    shape = body._replace(thickness=thickness)
    floor = floor_height(scenario, thickness)
    return Machine(model=model, data=data, body=body, shape=shape, floor=floor, spring=spring)


def _advance(model: mujoco.MjModel, data: mujoco.MjData, dt: float) -> None:
    """Advance by dt [s] with RK4, after mj_forward."""
    model.opt.timestep = dt
    mujoco.mj_RungeKutta(model, data, 4)


def fly(machine: Machine, max_time: float) -> bool:
    """Fly until the coin touches the floor; tell whether it does before max_time [s]."""
    data = machine.data
    smallest = TOUCH_STEP * machine.contact_step
    # The steps end before the touch. MuJoCo's own contacts are off meanwhile: of a coin that is flat within
    # rounding its plane-cylinder routine may take the radius for the height.
    machine.set_contacts(False)
    while data.time < max_time:
        machine.forward()
        look = machine.outlook()
        if look.clear < smallest and look.speed < 0:
            machine.set_contacts(True)
            return True
        machine.step(min(max(look.clear, smallest), max_time - data.time))
    return False


class Contact(NamedTuple):
    """One contact, from first touch to release."""

    start: float
    end: float
    impulse: Array
    """Integral of the floor's force, space frame, (3,) [N s]."""
    lasts: bool
    """Whether it went on for `LASTING` half periods of the spring, and was left there."""


def press(machine: Machine) -> Contact | None:
    """Follow a contact from the touch to the release of all rim points; None where nothing was pressed."""
    level = _turned_level(machine)
    if level is None:
        return _press(machine)
    first = len(machine.knots)
    contact = _press(machine)
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


def _press(machine: Machine) -> Contact | None:
    data = machine.data
    start, momentum, other = data.time, _momentum(machine), np.zeros(3)
    pressed = False
    while data.time - start <= LASTING * machine.spring.duration:
        force = machine.forward()
        if force == 0:
            if pressed:
                return Contact(start, data.time, _momentum(machine) - momentum - other, lasts=False)
            if machine.outlook().speed >= 0:
                return None
        # Tiny steps up to the spring's onset, so that it falls between two steps, not into one.
        dt = machine.contact_step * (1.0 if force > 0 else TOUCH_STEP)
        pressed = pressed or force > 0
        other += dt * _other_force(machine)
        machine.step(dt, pressed=True)
    return Contact(start, data.time, _momentum(machine) - momentum - other, lasts=True)


def _momentum(machine: Machine) -> Array:
    v = machine.state()[1]
    return machine.body.mass * np.array(v)


def _other_force(machine: Machine) -> Array:
    """Weight and drag on the coin, space frame, (3,) [N]."""
    weight = np.array([0.0, 0.0, -machine.body.mass * machine.body.gravity])
    return weight + machine.data.qfrc_actuator[:3]
