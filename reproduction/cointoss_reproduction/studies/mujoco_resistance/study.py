"""MuJoCo's own torsional and rolling friction, condim 4 and 6, against moments applied explicitly."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
import pandas as pd

from cointoss import Scenario, coin_mj
from cointoss.study import Array
from cointoss_bounce.contact import DEFAULT, HARDEST
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study

MASS, RADIUS, GRAVITY = 2e-3, 1.25e-2, 9.81
"""Mass [kg] and radius [m] of all bodies, and gravity [m/s²]."""
THIN = 1e-5
"""Thickness of the shapes of disc and hoop [m]: the friction of two contacts apart would resist turning."""
SIZE = 1e-3
"""δ and p [m]; μ is 1."""
SPEED, SPIN = 0.3, 40.0
"""At the start, the speed of a body that rolls [m/s], and the spin of one that turns about the vertical
[rad/s]."""
LEFT = 1e-2
"""A motion has ended when this part of it is left."""
STEP, STEPS = 5e-4, (2e-3, 5e-4, 1e-4)
"""The step of `mj_step`, and the steps over which the largest error of a setting is compared [s]."""
SETTLING, LONGEST = 0.5, 10.0
"""How long a body rests before it is set going, and how long it is followed at most [s]."""
SAMPLED = 20
"""One in this many steps is drawn."""
INERTIA = {"disc": (0.25, 0.5), "hoop": (0.5, 1.0), "ball": (0.4, 0.4)}
"""Moments of inertia about a diameter, and about the axis that is level, over m r²."""


@dataclass(frozen=True)
class Start:
    """A body and how it is set going, upright."""

    body: str
    speed: float
    """The speed of rolling [m/s]."""
    spin: float
    """The spin about the vertical [rad/s]."""

    @property
    def motions(self) -> list[str]:
        """What the body does."""
        return [name for name, speed in (("rolls", self.speed), ("turns", self.spin)) if speed]

    @property
    def slowing(self) -> tuple[float, float]:
        """How much of either a second takes by moments -δ N against the roll and -p N against the turning."""
        across, axial = INERTIA[self.body]
        return SIZE * GRAVITY / (RADIUS * (1 + axial)), SIZE * GRAVITY / (across * RADIUS**2)


STARTS = {
    "hoop rolls": Start("hoop", SPEED, 0.0),
    "ball rolls": Start("ball", SPEED, 0.0),
    "disc turns": Start("disc", 0.0, SPIN),
    "ball turns": Start("ball", 0.0, SPIN),
    "ball does both": Start("ball", SPEED, SPIN),
}
BALL = STARTS["ball rolls"]
CONTACTS = {
    "pyramidal, by default": ("pyramidal", DEFAULT, 1.0),
    "pyramidal, solimp 0.9999": ("pyramidal", HARDEST, 1.0),
    "elliptic": ("elliptic", DEFAULT, 1.0),
    "elliptic, impratio 100": ("elliptic", DEFAULT, 100.0),
    "elliptic, solimp 0.9999": ("elliptic", HARDEST, 1.0),
}
"""Cone, solimp and impratio of MuJoCo's own friction."""


def ends(start: Start, motion: Array) -> dict[str, float]:
    """Return how far a body rolls [m] and how long it turns [s], until `LEFT` of either is left, and its hop.

    Args:
        start: how the body was set going.
        motion: its time [s], r times the level part of ω [m/s], ω about the vertical [rad/s], way [m] and
            height above the floor [m], (5, n).
    """
    times, rolling, turning, way, height = motion
    after, late = np.argmax(rolling < LEFT * start.speed), np.argmax(turning < LEFT * start.spin)
    return {"rolls": float(way[after]), "turns": float(times[late]), "hop": max(float(height.max()), 0.0)}


def closed_form(start: Start) -> dict[str, float]:
    """Return how far a body rolls [m] and how long it turns [s], until `LEFT` of either is left."""
    rolling, turning = start.slowing
    return {
        "rolls": start.speed**2 / (2 * rolling) * (1 - LEFT**2),
        "turns": start.spin / turning * (1 - LEFT),
    }


def explicit(start: Start) -> dict[str, float]:
    """Return how the moments of `coin_mj` stop a disc or a hoop."""
    across, axial = INERTIA[start.body]
    inertia = np.diag([across, across, axial]) * MASS * RADIUS**2
    case = Scenario.model_validate(
        {
            "coin": {"mass": MASS, "radius": RADIUS, "thickness": 0.0, "inertia": inertia.tolist()},
            "floor": {
                "contact": "coulomb",
                "friction": 1.0,
                "restitution": 0.5,
                "rolling_friction": SIZE,
                "pivoting_friction": SIZE,
            },
            "release": {
                "position": [0, 0, RADIUS],
                "velocity": [start.speed, 0, 0],
                "angles": [0.0, np.pi / 2, 0.0],
                "angular_velocity": [0, start.spin, -start.speed / RADIUS],
            },
        }
    )
    tossed = coin_mj.toss(case)
    states = tossed.sample(np.linspace(0, tossed.end_time, 4001))
    _, turning, rolling = np.abs(states.angular_velocity).T
    x, _, z = states.position.T
    return ends(start, np.array([states.time, rolling * RADIUS, turning, x, z - RADIUS]))


def native(start: Start, cone: str, solimp: str, impratio: float, step: float = STEP) -> Array:
    """Return the motion of a body that MuJoCo's own friction stops, stepped by `mj_step`, see `ends`."""
    model = mujoco.MjModel.from_xml_string(_described(start.body, cone, solimp, impratio, step))
    data = mujoco.MjData(model)
    while data.time < SETTLING:
        mujoco.mj_step(model, data)
    to_body = data.body("body").xmat.reshape(3, 3).T
    data.qvel[0] = start.speed
    data.qvel[3:] = to_body @ [0.0, start.speed / RADIUS, start.spin]
    begin, rows = data.time, []
    while data.time < begin + LONGEST:
        w = data.body("body").xmat.reshape(3, 3) @ data.qvel[3:]
        rolling, turning = np.hypot(w[0], w[1]) * RADIUS, abs(w[2])
        rows.append((data.time - begin, rolling, turning, data.qpos[0], data.qpos[2] - RADIUS))
        if (rolling < LEFT * start.speed or not start.speed) and (
            turning < LEFT * start.spin or not start.spin
        ):
            break
        mujoco.mj_step(model, data)
        mujoco.mj_kinematics(model, data)
    return np.array(rows).T


def _described(body: str, cone: str, solimp: str, impratio: float, step: float) -> str:
    """Return the model of a body on a plane, upright, as XML."""
    across, axial = INERTIA[body]
    inertia = " ".join(repr(part * MASS * RADIUS**2) for part in (across, across, axial))
    shape = (
        f'type="sphere" size="{RADIUS}"' if body == "ball" else f'type="cylinder" size="{RADIUS} {THIN / 2}"'
    )
    return f"""<mujoco>
  <option timestep="{step}" integrator="implicitfast" cone="{cone}" impratio="{impratio}"/>
  <worldbody>
    <geom type="plane" size="0 0 1"/>
    <body name="body" pos="0 0 {RADIUS}" euler="90 0 0">
      <freejoint/>
      <inertial pos="0 0 0" mass="{MASS}" diaginertia="{inertia}"/>
      <geom {shape} condim="6" friction="1 {SIZE} {SIZE}" priority="1" solimp="{solimp}"/>
    </body>
  </worldbody>
</mujoco>"""


BY: dict[str, Callable[[Start], dict[str, float]]] = {
    "closed form": closed_form,
    "explicit moments": explicit,
    **{
        name: lambda start, contact=contact: ends(start, native(start, *contact))
        for name, contact in CONTACTS.items()
    },
}


def stopped(start: Start, by: Callable[[Start], dict[str, float]]) -> Iterator[dict[str, Any]]:
    """Let a body stop; explicit moments stop coins alone."""
    if by is explicit and start.body == "ball":
        return
    found, expected = by(start), closed_form(start)
    for motion in start.motions:
        error = found[motion] / expected[motion] - 1
        yield {"motion": motion, "until": found[motion], "error": error, "hop": found.get("hop")}


def stepped(stepped: tuple[str, str, float]) -> Iterator[dict[str, float | None]]:
    """Let a ball roll in longer and shorter steps, each with its change from the one before."""
    before = None
    for step in STEPS:
        way = ends(BALL, native(BALL, *stepped, step))["rolls"]
        yield {"step": step, "way": way, "change": way / before - 1 if before else None}
        before = way


def drawn(drawn: tuple[str, str, float] | None) -> pd.DataFrame:
    """Let a ball roll, and look at its speed from time to time; by the closed form at both ends."""
    times, speeds = np.array([0, BALL.speed / BALL.slowing[0]]), np.array([BALL.speed, 0])
    if drawn is not None:
        times, speeds, *_ = native(BALL, *drawn)[:, ::SAMPLED]
    return pd.DataFrame({"time": times, "speed": speeds})


REPRODUCTION = study(
    __name__,
    Cells(stopped, {"start": STARTS, "by": BY}),
    Cells(stepped, {"stepped": CONTACTS}),
    Cells(drawn, {"drawn": {**CONTACTS, "closed form": None}}),
)
