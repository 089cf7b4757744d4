"""One toss in MuJoCo: RK4 throughout, steps chosen by the gap, every contact resolved in time."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import dataclass, field
from typing import NamedTuple

import mujoco
import numpy as np

from coin_mj.contact import STIFFNESS, Spring, spring_of
from coin_mj.scene import build, shape_thickness
from coin_mj.state import of_release, to_mass_center
from coin_mj.stepping import FLIGHT_ANGLE, outlook
from models.attitude import rotation_matrix
from models.body import Body, Rules, body_of, rules_of
from models.ending import energy, face_up, judge
from models.geometry import contact_velocity, lowest_point
from models.laws import ContactLaw
from models.records import (
    IMPACT_ROW,
    Array,
    Ending,
    Impacts,
    Outcome,
    Setting,
    States,
    Toss,
    UnsupportedError,
)
from models.scenario import Scenario

STEPS_PER_CONTACT = 160
"""Steps in half a period of the contact's spring."""
TOUCH_STEP = 1e-3
"""A touch is located to within this part of a contact step."""
LASTING = 20
"""A contact that lasts so many half periods of the spring is no impact."""
HEAVY = 10
"""A touch-down is no impact when gravity alone gives its speed in so many half periods of the spring."""


class Knot(NamedTuple):
    """A state on the way, from which the path is stepped again where it is asked for."""

    time: float
    qpos: Array
    qvel: Array


@dataclass(frozen=True, kw_only=True, eq=False)
class Machine:
    """MuJoCo's model and data of one coin, with the knots of its path so far."""

    model: mujoco.MjModel
    data: mujoco.MjData
    body: Body
    shape: Body
    """The body with the thickness of its shape."""
    spring: Spring
    knots: list[Knot] = field(default_factory=list)

    def forward(self) -> float:
        """Compute the accelerations of the present state; give the floor's force along z [N]."""
        mujoco.mj_forward(self.model, self.data)
        return float(self.data.qfrc_constraint[2])

    def step(self, dt: float) -> None:
        """Advance by dt [s] with RK4, after `forward`, and keep the knot left behind."""
        self.keep()
        self.advance(dt)

    def advance(self, dt: float) -> None:
        """Advance by dt [s] with RK4, after `forward`."""
        self.model.opt.timestep = dt
        mujoco.mj_RungeKutta(self.model, self.data, 4)

    def keep(self) -> None:
        """Keep the present state as a knot of the path."""
        self.knots.append(Knot(self.data.time, self.data.qpos.copy(), self.data.qvel.copy()))

    def state(self) -> tuple[Array, Array, Array, Array]:
        """Give position and velocity of C (space), Euler parameters and angular velocity (body)."""
        return to_mass_center(self.body, self.data.qpos, self.data.qvel)

    @property
    def contact_step(self) -> float:
        """Length of a step in contact [s]."""
        return self.spring.duration / STEPS_PER_CONTACT


def fly(machine: Machine, max_time: float) -> bool:
    """Fly until the coin touches the floor; tell whether it does before max_time [s]."""
    data = machine.data
    smallest = TOUCH_STEP * machine.contact_step
    while data.time < max_time:
        if machine.forward() > 0:
            return True
        look = outlook(machine.shape, data.qpos, data.qvel)
        if look.clear < smallest and look.speed < 0:
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
    data = machine.data
    start, momentum, other = data.time, _momentum(machine), np.zeros(3)
    pressed = False
    while data.time - start <= LASTING * machine.spring.duration:
        force = machine.forward()
        if force == 0:
            if pressed:
                return Contact(start, data.time, _momentum(machine) - momentum - other, lasts=False)
            if outlook(machine.shape, data.qpos, data.qvel).speed >= 0:
                return None
        # Tiny steps up to the spring's onset, so that it falls between two steps, not into one.
        dt = machine.contact_step * (1.0 if force > 0 else TOUCH_STEP)
        pressed = pressed or force > 0
        other += dt * _other_force(machine)
        machine.step(dt)
    return Contact(start, data.time, _momentum(machine) - momentum - other, lasts=True)


def _momentum(machine: Machine) -> Array:
    v = machine.state()[1]
    return machine.body.mass * np.array(v)


def _other_force(machine: Machine) -> Array:
    """Weight and drag on the coin, space frame, (3,) [N]."""
    weight = np.array([0.0, 0.0, -machine.body.mass * machine.body.gravity])
    return weight + machine.data.qfrc_actuator[:3]


class Run(NamedTuple):
    """What the event loop gives for one toss."""

    rows: np.ndarray
    """Impacts, (n,) of `IMPACT_ROW`."""
    contacts: list[tuple[float, float]]
    """Contacts that last [s]."""
    outcome: Outcome
    ending: Ending


def run(machine: Machine, rules: Rules) -> Run:
    """Toss the coin from its present state until the toss is decided."""
    body, rows = machine.body, []
    contacts: list[tuple[float, float]] = []
    outcome, ending = Outcome.UNDECIDED, Ending.NONE
    heavy = HEAVY * body.gravity * machine.spring.duration
    while ending == Ending.NONE:
        if len(rows) == rules.max_impacts:
            ending = Ending.MAX_IMPACTS
        elif not fly(machine, rules.max_time):
            ending = Ending.MAX_TIME
        elif -outlook(machine.shape, machine.data.qpos, machine.data.qvel).speed < heavy:
            ending = Ending.CHATTER
        else:
            touch = machine.state()
            contact = press(machine)
            if contact is None:
                continue
            if contact.lasts:
                contacts.append((contact.start, contact.end))
                ending = Ending.CHATTER
                continue
            rows.append(_row(machine, contact, touch))
            x, v, e, w = machine.state()
            outcome, ending = judge(body, rules, x[2], v, rotation_matrix(e)[2], w)
    return Run(
        np.concatenate(rows) if rows else np.zeros(0, IMPACT_ROW), contacts, Outcome(outcome), Ending(ending)
    )


def _row(machine: Machine, contact: Contact, touch: tuple[Array, Array, Array, Array]) -> np.ndarray:
    """Record an impact: the state at first touch, the velocities at release, the impulse in between."""
    body = machine.body
    x, v, e, w = touch
    x_after, v_after, e_after, w_after = machine.state()
    R, R_after = rotation_matrix(e), rotation_matrix(e_after)
    point, _ = lowest_point(body, R[2], w)
    E_before, E_after = energy(body, x[2], v, w), energy(body, x_after[2], v_after, w_after)
    row = np.zeros(1, IMPACT_ROW)
    row["time"] = contact.start
    row["face"] = face_up(R[2][2])
    row["impulse"] = contact.impulse
    row["point"] = point
    row["position"], row["quaternion"] = x, e
    row["velocity_before"], row["velocity_after"] = v, v_after
    row["angular_velocity_before"], row["angular_velocity_after"] = w, w_after
    row["contact_velocity_before"] = contact_velocity(body, R, v, w, point)
    row["contact_velocity_after"] = contact_velocity(body, R_after, v_after, w_after, point)
    row["energy"], row["energy_change"] = E_after, E_after - E_before
    return row


@dataclass(frozen=True, kw_only=True, eq=False)
class Knots:
    """The path of a toss: the states before all steps, stepped again by MuJoCo to the times asked for."""

    machine: Machine

    def sample(self, times: Array) -> States:
        """Give the states at `times` [s], in the order of `times`."""
        knots, data = self.machine.knots, self.machine.data
        before = np.searchsorted([knot.time for knot in knots], times, side="right") - 1
        rows = []
        for time, number in zip(times, before, strict=True):
            knot = knots[number]
            data.qpos[:], data.qvel[:], data.time = knot.qpos, knot.qvel, knot.time
            if time > knot.time:
                self.machine.forward()
                self.machine.advance(time - knot.time)
            rows.append(self.machine.state())
        x, v, e, w = (np.array(column) for column in zip(*rows, strict=True))
        return States(time=times.copy(), position=x, velocity=v, quaternion=e, angular_velocity=w)


def machine_of(scenario: Scenario, stiffness: float, thickness: float) -> Machine:
    """Build the MuJoCo coin of a scenario, with the thickness of its shape [m], and put it at its release."""
    spring, body = spring_of(scenario.floor.restitution, stiffness), body_of(scenario)
    model = build(scenario, spring, thickness)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = of_release(body, scenario.release)
    shape = body._replace(thickness=thickness)
    return Machine(model=model, data=data, body=body, shape=shape, spring=spring)


def require_supported(scenario: Scenario) -> None:
    """Refuse what this engine doesn't realise.

    Raises:
        UnsupportedError: naming field, value and what is accepted.
    """
    air, floor = scenario.air, scenario.floor
    if floor.contact != ContactLaw.SMOOTH:
        raise UnsupportedError(
            f'floor.contact = "{floor.contact.label}": accepted by the MuJoCo engine: "smooth"'
        )
    if floor.restitution == 0:
        raise UnsupportedError(
            "floor.restitution = 0: accepted by the MuJoCo engine: a number > 0 (a damped spring rebounds)"
        )
    if air.exponent != 0 and (air.normal > 0 or air.tangential > 0):
        raise UnsupportedError(f"air.exponent = {air.exponent}: accepted by the MuJoCo engine: 0")


def toss(scenario: Scenario, stiffness: float = STIFFNESS) -> Toss:
    """Toss a coin in MuJoCo.

    The contact is a damped spring, solref = "-stiffness -damping", whose damping gives the scenario's
    restitution; it lasts about π/√stiffness, in which the coin turns a little: the impulse differs from
    Newton's by a part that falls with 1/√stiffness.

    `trusted_impacts` counts the leading impacts whose faces stay the same when the contact is ten times
    softer, and that error about three times larger.

    Args:
        scenario: what to toss.
        stiffness: of the contact, per unit of effective mass [1/s²].

    Raises:
        UnsupportedError: for contact laws other than "smooth", restitution 0, or air with b > 0.
    """
    require_supported(scenario)
    rules, machine = rules_of(scenario), machine_of(scenario, stiffness, shape_thickness(scenario))
    answer = run(machine, rules)
    machine.keep()
    impacts = Impacts.from_rows(answer.rows)
    spring = machine.spring
    return Toss(
        engine="mujoco",
        scenario=scenario,
        impacts=impacts,
        contacts=np.array(answer.contacts).reshape(-1, 2),
        outcome=answer.outcome,
        ending=answer.ending,
        end_time=machine.data.time,
        trusted_impacts=_trusted_impacts(scenario, stiffness, impacts),
        certificate=(
            Setting(name="MuJoCo", value=mujoco.__version__),
            Setting(name="integrator", value="RK4"),
            Setting(name="contact stiffness", value=spring.stiffness, unit="1/s²"),
            Setting(name="contact damping", value=spring.damping, unit="1/s"),
            Setting(name="half a period of the contact", value=spring.duration, unit="s"),
            Setting(name="steps in it", value=STEPS_PER_CONTACT),
            Setting(name="largest turn in a step of flight", value=FLIGHT_ANGLE, unit="rad"),
            Setting(name="thickness of the shape", value=machine.shape.thickness, unit="m"),
            Setting(name="steps", value=len(machine.knots) - 1),
        ),
        path=Knots(machine=machine),
    )


def _trusted_impacts(scenario: Scenario, stiffness: float, impacts: Impacts) -> int:
    """Count the leading impacts whose faces a coin shares that is further from the hard limit.

    Its contact is ten times softer, and its shape ten times as thick where a thin coin's is made up.
    """
    if len(impacts) == 0:
        return 0
    rules = rules_of(scenario)._replace(max_impacts=len(impacts))
    thickness = scenario.coin.thickness or 10 * shape_thickness(scenario)
    softer = Impacts.from_rows(run(machine_of(scenario, stiffness / 10, thickness), rules).rows)
    n = min(len(impacts), len(softer))
    same = impacts.face[:n] == softer.face[:n]
    return n if same.all() else int(np.argmin(same))
