"""Which settings of MuJoCo's contact give a restitution, and how exactly: measured on a ball."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from dataclasses import dataclass
from numbers import Integral, Real

import mujoco
import numpy as np

from cointoss.coin_mj.model.settings import Realisation, Settings, rebound_of
from cointoss.models.errors import FieldError
from cointoss.models.records import Array

MODEL = """<mujoco>
  <option timestep="{timestep!r}" integrator="{integrator}">
    <flag diagexact="enable"/>
  </option>
  <worldbody>
    <geom type="plane" size="0 0 1" condim="1"/>
    <body pos="0 0 {height!r}">
      <freejoint/>
      <geom type="sphere" size="{radius!r}" mass="0.01" condim="1" priority="1"
            solref="{solref}" solimp="{solimp}"/>
    </body>
  </worldbody>
</mujoco>"""
"""A ball over a plane."""
RADIUS = 0.01
"""Of the ball [m]."""
HARDEST = "0.9999 0.9999 0.001 0.5 2"
"""The largest impedance MuJoCo takes, as solimp."""
LONGEST = 2000
"""A contact that goes on for more steps is no rebound."""
PHASES = 16
"""Heights of release, spread over the way of one step: a touch falls anywhere between two steps."""
SPRING_STEPS = 40
"""Steps in a contact by a spring, by default."""
LEAST = 0.01
"""Restitution by a spring."""
SPEED = 2.0
"""Of the ball [m/s]."""
GRAVITY = 9.81
"""[m/s²]."""


@dataclass(frozen=True, kw_only=True)
class Bounce:
    """Settings of MuJoCo that give a restitution, and what a ball does with them."""

    restitution: float
    """That asked for, e."""
    timestep: float
    """[s]."""
    integrator: str
    solref: tuple[float, float]
    """0 and -(1 + e)/dt, or -stiffness and -damping."""
    solimp: str
    error: float
    """Largest |e' - e| over `PHASES` touches of a ball without weight, anywhere between two steps."""
    error_with_weight: float
    """That of a ball which touches at `SPEED` under `GRAVITY`; as the contact's length over the speed."""
    depth: float
    """How deep a body goes into the floor at 1 m/s, at most, whatever its mass [m]."""

    @property
    def option(self) -> str:
        """The element <option>."""
        flag = '<flag diagexact="enable"/>'
        return f'<option timestep="{self.timestep!r}" integrator="{self.integrator}">{flag}</option>'

    @property
    def geom(self) -> str:
        """The attributes of one of the two geoms that touch."""
        return f'solref="{_text(self.solref)}" solimp="{self.solimp}" priority="1"'

    @property
    def model(self) -> str:
        """A whole model: a ball that falls from half a metre."""
        return _described(self.solref, self.timestep, self.integrator, self.solimp, 0.5)


def solref(restitution: float, timestep: float, *, spring: bool = False, steps: int = SPRING_STEPS) -> Bounce:
    """Return the settings with which MuJoCo's contacts have a restitution, and their error, measured now.

    By default a contact takes one step, v' = -e v; a spring takes `steps`, in which its force can be seen.
    docs/MUJOCO.md derives both. They hold for every mass, and for every shape that hardly turns in the
    contact, without MuJoCo's own friction.

    Args:
        restitution: e, from 0 to 1; for a spring from 0.01, below which its error is as large.
        timestep: dt of the simulation [s].
        spring: whether a contact is a spring, resolved in time.
        steps: of the simulation in the contact of a spring.

    Raises:
        ValueError: naming the argument, its value and what is accepted.
    """
    numbers = {"restitution": restitution, "timestep": timestep, "steps": steps}
    for name, value in numbers.items():
        _require(name, value, isinstance(value, Real) and not isinstance(value, bool), "a number")
    _require("restitution", restitution, 0 <= restitution <= 1, "a number from 0 to 1")
    _require(
        "restitution",
        restitution,
        restitution >= LEAST or not spring,
        f"a number from {LEAST} to 1 by a spring",
    )
    _require(
        "timestep", timestep, 1e-7 <= timestep <= 0.1, "a number of seconds from 1e-7 to 0.1, such as 0.002"
    )
    whole = isinstance(steps, Integral) and 5 <= steps <= LONGEST // 4
    _require("steps", steps, whole, f"a whole number from 5 to {LONGEST // 4}")
    solref = spring_solref(restitution, timestep, steps) if spring else one_step_solref(restitution, timestep)
    integrator = "RK4" if spring else "implicitfast"
    restitutions, depth = drops_of_a_ball(solref, timestep, integrator)
    with_weight = restitutions_of_a_ball(solref, timestep, integrator, gravity=GRAVITY)
    return Bounce(
        restitution=restitution,
        timestep=timestep,
        integrator=integrator,
        solref=solref,
        solimp=HARDEST,
        error=float(np.abs(restitutions - restitution).max()),
        error_with_weight=float(np.abs(with_weight - restitution).max()),
        depth=depth / SPEED,
    )


def _require(name: str, value: object, holds: bool, accepted: str) -> None:
    if not holds:
        raise FieldError(name, value, accepted)


def one_step_solref(restitution: float, dt: float) -> tuple[float, float]:
    """Return the solref that makes an impact within one step: "0 -(1 + e)/dt"."""
    return _solref_of(restitution, Settings(contact=Realisation.ONE_STEP, step=dt))


def spring_solref(restitution: float, dt: float, steps: int) -> tuple[float, float]:
    """Return the solref of a damped spring that is resolved by so many steps: k = (π/(n dt))², d = 2 ζ √k."""
    return _solref_of(restitution, Settings(stiffness=(math.pi / (steps * dt)) ** 2))


def _solref_of(restitution: float, settings: Settings) -> tuple[float, float]:
    rebound = rebound_of(restitution, settings)
    return -rebound.stiffness, -rebound.damping


def restitutions_of_a_ball(
    solref: tuple[float, float], dt: float, integrator: str, solimp: str = HARDEST, gravity: float = 0.0
) -> Array:
    """Return the restitutions of a ball, as `drops_of_a_ball` does."""
    return drops_of_a_ball(solref, dt, integrator, solimp, gravity)[0]


def drops_of_a_ball(
    solref: tuple[float, float], dt: float, integrator: str, solimp: str = HARDEST, gravity: float = 0.0
) -> tuple[Array, float]:
    """Return the restitutions of a ball that comes down on a plane with `SPEED`, and its greatest depth [m].

    Args:
        solref: of the contact, direct form.
        dt: length of a step [s].
        integrator: of MuJoCo, by its name in a model.
        solimp: of the contact.
        gravity: downward [m/s²]; by default the contact alone acts.

    Returns:
        The speed after over that before, both where the ball meets the floor, for each of the `PHASES` of
        the touch between two steps, (PHASES,); 0 where the ball does not leave the floor.
    """
    restitutions, depth = np.zeros(PHASES), 0.0
    for number in range(PHASES):
        height = RADIUS + SPEED * dt * (2 + (number + 0.5) / PHASES)
        model = mujoco.MjModel.from_xml_string(_described(solref, dt, integrator, solimp, height))
        data = mujoco.MjData(model)
        model.opt.gravity[2] = -gravity
        data.qvel[2] = -SPEED
        before, touched = _speed_at_floor(data, gravity), False
        for _ in range(LONGEST):
            mujoco.mj_step(model, data)
            touched = touched or data.ncon > 0
            depth = max(depth, RADIUS - data.qpos[2])
            if touched and data.ncon == 0 and data.qvel[2] > 0:
                restitutions[number] = _speed_at_floor(data, gravity) / before
                break
    return restitutions, depth


def _speed_at_floor(data: mujoco.MjData, gravity: float) -> float:
    """Return the speed that a ball in free flight has where it meets the floor."""
    return math.sqrt(max(data.qvel[2] ** 2 + 2 * gravity * (data.qpos[2] - RADIUS), 0.0))


def _described(solref: tuple[float, float], dt: float, integrator: str, solimp: str, height: float) -> str:
    return MODEL.format(
        timestep=dt,
        integrator=integrator,
        height=height,
        radius=RADIUS,
        solref=_text(solref),
        solimp=solimp,
    )


def _text(solref: tuple[float, float]) -> str:
    return " ".join(f"{number!r}" if number else "0" for number in solref)
