"""MuJoCo's coin in motion, and the path that it leaves.

It flies with RK4, of fourth order in a free joint's position and attitude, in steps chosen by the gap.
"""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import dataclass, field
from typing import NamedTuple

import mujoco
import numpy as np

from coin_mj.air_callback import air_of
from coin_mj.contact import ContactSettings, Friction, Realisation, Rebound, friction_of, rebound_of
from coin_mj.scene import build, floor_height
from coin_mj.state import of_release, to_mass_center
from coin_mj.stepping import Outlook, outlook
from models.body import Body
from models.records import Array, States
from models.scenario import Scenario

TOUCH_STEP = 1e-3
"""A touch is located to within this part of a contact step."""


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
    rebound: Rebound
    settings: ContactSettings
    friction: float
    """Coefficient of friction μ of the floor."""
    knots: list[Knot] = field(default_factory=list)

    def forward(self) -> float:
        """Compute the accelerations of the present state; give the floor's force along z [N]."""
        _forward(self.model, self.data)
        return float(self.data.qfrc_constraint[2])

    def step(self, dt: float) -> None:
        """Advance by dt [s] of free flight, after `forward`, and keep the knot left behind."""
        self.keep()
        _advance(self.model, self.data, dt)

    def push(self, dt: float) -> None:
        """Advance by dt [s] in contact with the integrator of the realisation, after `forward`."""
        if self.settings.realisation == Realisation.ONE_STEP:
            self.model.opt.timestep = dt
            # It takes the forces that `forward` found.
            mujoco.mj_Euler(self.model, self.data)
        else:
            _advance(self.model, self.data, dt)

    def return_to(self, knot: Knot) -> None:
        """Go back to a knot of the path."""
        self.data.time, self.data.qpos[:], self.data.qvel[:] = knot.time, knot.qpos, knot.qvel

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
                _forward(self.model, data)
                _advance(self.model, data, time - knot.time)
            row[:] = np.concatenate(to_mass_center(self.body, data.qpos, data.qvel))
        x, v, e, w = (part.copy() for part in np.split(rows, (3, 6, 10), axis=1))
        return States(time=times.copy(), position=x, velocity=v, quaternion=e, angular_velocity=w)


def machine_of(scenario: Scenario, settings: ContactSettings, thickness: float) -> Machine:
    """Build the MuJoCo coin of a scenario, with the thickness of its shape [m], and put it at its release."""
    rebound, body = rebound_of(scenario.floor.restitution, settings), scenario.body
    friction = friction_of(scenario.floor)
    native = friction if settings.friction == Friction.NATIVE else 0.0
    model = build(scenario, rebound, native, thickness)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = of_release(body, scenario.release)
    return Machine(
        model=model,
        data=data,
        body=body,
        shape=body._replace(thickness=thickness),
        floor=floor_height(scenario, thickness),
        rebound=rebound,
        settings=settings,
        friction=friction,
    )


def _forward(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    with air_of(model):
        mujoco.mj_forward(model, data)


def _advance(model: mujoco.MjModel, data: mujoco.MjData, dt: float) -> None:
    """Advance by dt [s] with RK4, after mj_forward."""
    model.opt.timestep = dt
    with air_of(model):
        mujoco.mj_RungeKutta(model, data, 4)


def fly(machine: Machine, max_time: float) -> bool:
    """Fly until the coin touches the floor; tell whether it does before max_time [s]."""
    data = machine.data
    smallest = TOUCH_STEP * machine.rebound.step
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
