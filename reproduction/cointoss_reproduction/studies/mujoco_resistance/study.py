"""MuJoCo's own torsional and rolling friction, condim 4 and 6, against moments applied explicitly."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import mujoco
import numpy as np
from matplotlib.figure import Figure

from cointoss import Scenario, coin_mj
from cointoss.study import (
    BLUE,
    DEFAULT,
    GREEN,
    GREY,
    HARDEST,
    INK,
    ORANGE,
    VERMILION,
    Progress,
    paragraphs,
    table,
)
from cointoss_reproduction.frame.recorded import recorded

MASS, RADIUS, GRAVITY = 2e-3, 1.25e-2, 9.81
"""Of all bodies [kg], [m], and on them [m/s²]."""
THIN = 1e-5
"""Thickness of the shapes of disc and hoop [m]: the friction of two contacts apart would resist turning."""
SIZE = 1e-3
"""δ and p [m]; μ is 1."""
SPEED, SPIN = 0.3, 40.0
"""At the start: of what rolls [m/s], and of what turns about the vertical [rad/s]."""
LEFT = 1e-2
"""A motion has ended when this part of it is left."""
STEP, STEPS = 5e-4, (2e-3, 5e-4, 1e-4)
"""Of `mj_step`, and those over which the largest error of a setting is compared [s]."""
SETTLING, LONGEST = 0.5, 10.0
"""A body rests so long before it is set going, and is followed so long [s]."""
SAMPLED = 20
"""Of so many steps one is drawn."""
INERTIA = {"disc": (0.25, 0.5), "hoop": (0.5, 1.0), "ball": (0.4, 0.4)}
"""Moments of inertia about a diameter, and about the axis that is level, over m r²."""


@dataclass(frozen=True)
class Start:
    """A body and how it is set going, upright."""

    body: str
    speed: float
    """Of rolling [m/s]."""
    spin: float
    """About the vertical [rad/s]."""


STARTS = {
    "hoop rolls": Start("hoop", SPEED, 0.0),
    "ball rolls": Start("ball", SPEED, 0.0),
    "disc turns": Start("disc", 0.0, SPIN),
    "ball turns": Start("ball", 0.0, SPIN),
    "ball does both": Start("ball", SPEED, SPIN),
}


@dataclass(frozen=True)
class NativeFriction:
    """Settings of MuJoCo's own friction."""

    cone: str
    solimp: str = DEFAULT
    impratio: float = 1.0


CONTACTS = {
    "MuJoCo's default: pyramidal": NativeFriction("pyramidal"),
    "pyramidal, solimp 0.9999": NativeFriction("pyramidal", HARDEST),
    "elliptic": NativeFriction("elliptic"),
    "elliptic, impratio 100": NativeFriction("elliptic", DEFAULT, 100.0),
    "elliptic, solimp 0.9999": NativeFriction("elliptic", HARDEST),
}


@dataclass(frozen=True)
class Stopped:
    """How a body stopped; what it did not do is 0."""

    distance: float
    """That it rolled [m]."""
    duration: float
    """Of its turning about the vertical [s]."""
    hop: float = 0.0
    """Greatest height above the floor on its way [m]."""


@dataclass(frozen=True)
class Run:
    """A body's motion over time, with its end."""

    times: list[float]
    """[s]."""
    rolling: list[float]
    """Speed of rolling, r times the level part of ω [m/s]."""
    stopped: Stopped


@dataclass(frozen=True)
class NativeResistance:
    """What the study found, by contact and by start; "explicit" for coins alone."""

    closed: dict[str, Stopped]
    explicit: dict[str, Stopped]
    native: dict[str, dict[str, Stopped]]
    by_step: dict[str, list[float]]
    """Distance of the ball that rolls for each of `STEPS` [m], by contact."""
    balls: dict[str, Run]
    """The ball that rolls, by contact."""


def closed_form(start: Start) -> Stopped:
    """Return how moments -δ N against the roll and -p N against the turning stop a body.

    v falls by δ g/(r (1 + J/(m r²))) a second and ω_z by p m g/J; `LEFT` of either is left.
    """
    across, axial = INERTIA[start.body]
    slowing = SIZE * GRAVITY / (RADIUS * (1 + axial))
    return Stopped(
        distance=start.speed**2 / (2 * slowing) * (1 - LEFT**2),
        duration=start.spin * across * RADIUS**2 / (SIZE * GRAVITY) * (1 - LEFT),
    )


def explicit(start: Start) -> Stopped:
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
    rolling, turning = np.abs(states.angular_velocity[:, 2]), np.abs(states.angular_velocity[:, 1])
    return _stopped(start, states.time, rolling * RADIUS, turning, states.position[:, 0])


def _stopped(start: Start, times, rolling, turning, way) -> Stopped:
    """Return where a body stopped, from samples of its motion."""
    distance = duration = 0.0
    if start.speed > 0:
        distance = float(way[int(np.argmax(rolling < LEFT * start.speed))])
    if start.spin > 0:
        duration = float(times[int(np.argmax(turning < LEFT * start.spin))])
    return Stopped(distance, duration)


def native(start: Start, contact: NativeFriction, step: float = STEP) -> Run:
    """Return how MuJoCo's own friction stops a body, stepped by `mj_step`."""
    model = mujoco.MjModel.from_xml_string(described(start.body, contact, step))
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
    times, rolling, turning, way, height = np.array(rows).T
    stopped = replace(_stopped(start, times, rolling, turning, way), hop=max(float(height.max()), 0.0))
    return Run(times[::SAMPLED].tolist(), rolling[::SAMPLED].tolist(), stopped)


def described(body: str, contact: NativeFriction, step: float) -> str:
    """Return the model of a body on a plane, upright, as XML."""
    across, axial = INERTIA[body]
    inertia = " ".join(repr(part * MASS * RADIUS**2) for part in (across, across, axial))
    shape = (
        f'type="sphere" size="{RADIUS}"' if body == "ball" else f'type="cylinder" size="{RADIUS} {THIN / 2}"'
    )
    return f"""<mujoco>
  <option timestep="{step}" integrator="implicitfast" cone="{contact.cone}" impratio="{contact.impratio}"/>
  <worldbody>
    <geom type="plane" size="0 0 1"/>
    <body name="body" pos="0 0 {RADIUS}" euler="90 0 0">
      <freejoint/>
      <inertial pos="0 0 0" mass="{MASS}" diaginertia="{inertia}"/>
      <geom {shape} condim="6" friction="1 {SIZE} {SIZE}" priority="1" solimp="{contact.solimp}"/>
    </body>
  </worldbody>
</mujoco>"""


def compute(progress: Progress) -> NativeResistance:
    """Let every body stop by every contact."""
    found, balls = {}, {}
    for done, (name, contact) in enumerate(CONTACTS.items(), start=1):
        runs = {label: native(start, contact) for label, start in STARTS.items()}
        found[name], balls[name] = {label: run.stopped for label, run in runs.items()}, runs["ball rolls"]
        progress(done, len(CONTACTS) + 1)
    rolls = STARTS["ball rolls"]
    by_step = {
        name: [native(rolls, contact, step).stopped.distance for step in STEPS]
        for name, contact in CONTACTS.items()
    }
    progress(len(CONTACTS) + 1, len(CONTACTS) + 1)
    return NativeResistance(
        closed={label: closed_form(start) for label, start in STARTS.items()},
        explicit={label: explicit(start) for label, start in STARTS.items() if start.body != "ball"},
        native=found,
        by_step=by_step,
        balls=balls,
    )


def errors(found: NativeResistance, stopped: dict[str, Stopped]) -> dict[str, tuple[float, float]]:
    """Return the relative errors of distance and duration by start; 0 for what a body did not do."""

    def off(value: float, expected: float) -> float:
        return value / expected - 1 if expected else 0.0

    return {
        label: (
            off(each.distance, found.closed[label].distance),
            off(each.duration, found.closed[label].duration),
        )
        for label, each in stopped.items()
    }


def measures(found: NativeResistance) -> dict[str, Any]:
    """Return what the claims name."""
    by_contact = {name: errors(found, each) for name, each in found.native.items()}
    hard, default = by_contact["elliptic, solimp 0.9999"], by_contact["MuJoCo's default: pyramidal"]
    return {
        "explicit": max(abs(part) for pair in errors(found, found.explicit).values() for part in pair),
        "alone": max(abs(part) for label, pair in hard.items() if label != "ball does both" for part in pair),
        "further": 1 + default["ball rolls"][0],
        "longer": 1 + hard["ball does both"][1],
        "change": max(
            abs(fine / coarse - 1) for runs in found.by_step.values() for coarse, fine in pairwise(runs)
        ),
    }


def tables(found: NativeResistance) -> str:
    """Return the tables, in Markdown."""

    def row(name: str, stopped: dict[str, Stopped]) -> list[str]:
        cells = []
        for label, start in STARTS.items():
            each = stopped.get(label, Stopped(0.0, 0.0))
            parts = [each.distance] * (start.speed > 0) + [each.duration] * (start.spin > 0)
            cells.append(", ".join(f"{part:.4f}" for part in parts) if label in stopped else "-")
        return [name, *cells, f"{1e6 * max(each.hop for each in stopped.values()):.0f}"]

    stopped = {"closed form": found.closed, "explicit moments": found.explicit, **found.native}
    steps = [[name, *(f"{way:.4f}" for way in ways)] for name, ways in found.by_step.items()]
    return paragraphs(
        f"A body of {1e3 * MASS:g} g and r = {1e3 * RADIUS:g} mm, upright on a floor with μ = 1 and "
        f"δ = p = {1e3 * SIZE:g} mm, that rolls at {SPEED:g} m/s or turns about the vertical at "
        f"{SPIN:g} rad/s, until {LEFT:.0%} of that is left; `mj_step` with implicitfast and steps of "
        f"{1e3 * STEP:g} ms:",
        table(
            " | hoop rolls [m] | ball rolls [m] | disc turns [s] | ball turns [s] | ball does both [m, s] | "
            "highest hop [µm]",
            [row(name, each) for name, each in stopped.items()],
        ),
        table(["the ball that rolls comes [m], steps of", *(f"{1e3 * step:g} ms" for step in STEPS)], steps),
    )


def draw(found: NativeResistance) -> Figure:
    """Draw the speed of the ball that rolls."""
    picture = Figure(figsize=(7, 3.4))
    axes = picture.subplots()
    for (name, run), color in zip(found.balls.items(), (VERMILION, ORANGE, BLUE, GREEN, GREY), strict=True):
        axes.plot(run.times, run.rolling, color=color, label=name)
    slowing = SIZE * GRAVITY / (RADIUS * (1 + INERTIA["ball"][1]))
    axes.plot([0, SPEED / slowing], [SPEED, 0], color=INK, linestyle=":", label="closed form")
    axes.set(xlabel="t [s]", ylabel="speed of the ball [m/s]")
    axes.legend()
    return picture


REPRODUCTION = recorded(
    __name__, compute, record=NativeResistance, measures=measures, tables=tables, draw={"ball": draw}
)
