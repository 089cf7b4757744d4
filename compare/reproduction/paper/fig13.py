"""Figs 13-15: the velocities of a coin's surface, and the parts of it where the air presses."""

import math
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from cointoss.analytic.air.force import force_and_moment
from cointoss.analytic.air.velocity_field import SurfaceFields, velocity_fields
from cointoss.coin_mj import Settings
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.scene import shape_thickness
from cointoss.coin_mj.steps.constrained_step import forward
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, GREEN, ORANGE, PALE
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.models.reading import load
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario

FINE = {"rings": 100, "spokes": 240, "levels": 41}
"""Points of the sums."""
COARSE = {"rings": 3, "spokes": 12, "levels": 3}
"""Points of the picture."""
ENOUGH = 1e-3
"""A sum over that many points is as near to the integral, relative."""
ARROW = 0.014
"""Length of an arrow of 1 m/s in the picture [m]."""
PANELS = (
    ("thick", "velocity", "Fig. 14(a): velocities"),
    ("thick", "velocity outwards", "(b): where outwards"),
    ("thick", "outward", "(c): normal, outwards: pressure"),
    ("thick", "tangential", "(d): tangential: friction"),
    ("thin", "outward", "Fig. 15(a): normal, outwards"),
    ("thin", "tangential", "(b): tangential"),
)
"""Coin, part of its velocities, and title."""
COLORS = (BLUE, ORANGE, GREEN)
"""Of the faces ζ = +h/2 and -h/2, and the wall."""


class Wrench(NamedTuple):
    """The air's force [N] and its moment about B [N m], body frame, (3,) each."""

    force: Array
    moment: Array


def make(progress: Progress) -> Result:
    """Sum the air over the fields of a thick coin, and compare with the integrals of both engines."""
    thick = load("fig13")
    thin = thick.replace("coin.thickness", 0.0, "coin.center_of_mass", (-1e-3, -1e-3, 0.0))
    fields, of_thin = _fields(thick, FINE), _fields(thin, FINE)
    progress(1, 2)
    upper, lower, wall = fields
    sums = {b: _sum(thick, fields, b) for b in (0.0, 1.0)}
    integrals = {b: _integral(thick, b) for b in (0.0, 1.0)}
    progress(2, 2)
    claims = (
        Claim(
            claim="the air presses where the surface moves outwards, eqs (55), (58)",
            analytic=(
                f"on {upper.moves_outwards.mean():.0%} and {lower.moves_outwards.mean():.0%} of the faces, "
                f"{wall.moves_outwards.mean():.0%} of the wall; the sum over its points is within "
                f"{_apart(sums[0.0], integrals[0.0]):.0e} of force and moment"
            ),
            mujoco=f"{_apart(sums[0.0], _by_mujoco(thick)):.0e}",
            criteria=[
                Criterion(
                    "largest relative difference of sum and integrals",
                    max(_apart(sums[0.0], other) for other in (integrals[0.0], _by_mujoco(thick))),
                    "<",
                    ENOUGH,
                    "what a sum over so many points leaves",
                )
            ],
        ),
        Claim(
            claim="of the faces of a thin coin exactly one moves outwards: s_1 + s_2 = 1, eqs (75)-(79)",
            analytic=(
                f"at {_one_moves_outwards(of_thin):.0%} of its points, and at "
                f"{_one_moves_outwards(fields):.0%} of a thick coin's; both faces of a thin one move alike "
                f"to {np.abs(of_thin.upper.velocity - of_thin.lower.velocity).max():.1g} m/s"
            ),
            criteria=[
                Criterion(
                    "part of the points of a thin coin",
                    _one_moves_outwards(of_thin),
                    "=",
                    1,
                    "the two normals are opposite",
                ),
                Criterion(
                    "difference of both faces' velocities [m/s]",
                    np.abs(of_thin.upper.velocity - of_thin.lower.velocity).max(),
                    "=",
                    0,
                    "they are one face",
                ),
            ],
        ),
        Claim(
            claim="for b = 1 the forces are proportional to the velocities of Fig. 14 (section 4.2, ii)",
            analytic=(
                "summed, they give force and moment at b = 0; at b = 1 they are off by "
                f"{_apart(sums[0.0], integrals[1.0]):.0%}, and those with the square of the speed by "
                f"{_apart(sums[1.0], integrals[1.0]):.0e}"
            ),
            criteria=[
                Criterion(
                    "relative difference at b = 1",
                    _apart(sums[0.0], integrals[1.0]),
                    "<",
                    ENOUGH,
                    "what a sum over so many points leaves",
                )
            ],
            expected=False,
        ),
    )
    drawn = {"thick": _fields(thick, COARSE), "thin": _fields(thin, COARSE)}
    data: dict[str, Array] = {}
    for coin, surfaces in drawn.items():
        for surface, field in zip(SurfaceFields._fields, surfaces, strict=True):
            parts = {
                "point": field.point,
                "velocity": field.velocity,
                "velocity outwards": field.velocity * field.moves_outwards[:, None],
                "outward": field.outward,
                "tangential": field.tangential,
            }
            data |= {f"{coin}, {surface}, {part}": array for part, array in parts.items()}
    return Result(claims=claims, data=data)


def _fields(case: Scenario, points: dict[str, int]) -> SurfaceFields:
    # Released flat: body and space frame are one.
    return velocity_fields(case.body, case.release.velocity, case.release.angular_velocity, **points)


def _one_moves_outwards(fields: SurfaceFields) -> float:
    """Return the part of the points of which exactly one of their two faces moves outwards."""
    return float(np.mean(fields.upper.moves_outwards != fields.lower.moves_outwards))


def _sum(case: Scenario, fields: SurfaceFields, b: float) -> Wrench:
    """Sum -λ |v|^b v dA over the points of the fields."""
    force, moment = np.zeros(3), np.zeros(3)
    for field, area in zip(fields, _areas(case), strict=True):
        pressure, friction = (
            -coefficient * np.linalg.norm(v, axis=1, keepdims=True) ** b * v * area[:, None]
            for coefficient, v in (
                (case.air.normal, field.outward),
                (case.air.tangential, field.tangential),
            )
        )
        force += np.sum(pressure + friction, axis=0)
        moment += np.sum(np.cross(field.point, pressure + friction), axis=0)
    return Wrench(force, moment)


def _areas(case: Scenario) -> tuple[np.ndarray, ...]:
    """Return the areas of the points of `FINE`, by the trapezoidal rule, for each surface [m²]."""
    r, h = case.coin.radius, case.coin.thickness
    rings, spokes, levels = FINE["rings"], FINE["spokes"], FINE["levels"]
    angle, across = 2 * math.pi / spokes, r / rings
    rho = across * np.arange(1, rings + 1)
    face = np.repeat(rho * np.where(rho < r - across / 2, 1, 0.5) * across * angle, spokes)
    end = np.where((np.arange(levels) == 0) | (np.arange(levels) == levels - 1), 0.5, 1)
    wall = np.repeat(end * h / (levels - 1) * r * angle, spokes)
    return face, face, wall


def _integral(case: Scenario, b: float) -> Wrench:
    """Return the integral of the analytic engine."""
    body = case.replace("air.exponent", b).body
    f, m_C = force_and_moment(body, case.release.velocity, case.release.angular_velocity)
    return Wrench(np.array(f), np.array(m_C) + np.cross(body.center, f))


def _by_mujoco(case: Scenario) -> Wrench:
    """Return the forces of MuJoCo's actuators and its damping on the released coin."""
    machine = machine_of(case, Settings(), shape_thickness(case))
    forward(machine.coin)
    force = machine.data.qfrc_actuator + machine.data.qfrc_passive
    return Wrench(force[:3].copy(), force[3:].copy())


def _apart(a: Wrench, b: Wrench) -> float:
    """Return the largest difference of forces and of moments, each relative to b's size."""
    return float(max(np.linalg.norm(x - y) / np.linalg.norm(y) for x, y in zip(a, b, strict=True)))


def _draw(data: dict[str, Array]) -> Figure:
    picture = Figure(figsize=(7.4, 4.4))
    circle = np.linspace(0, 2 * math.pi, 61)
    for number, (coin, part, title) in enumerate(PANELS, start=1):
        axes = picture.add_subplot(2, 3, number, projection="3d")
        rim = data[f"{coin}, upper, point"]
        r, half = 100 * np.abs(rim[:, 0]).max(), 100 * rim[0, 2]
        for z in (-half, half):
            axes.plot(r * np.cos(circle), r * np.sin(circle), z, color=PALE, linewidth=0.8)
        for surface, color in zip(SurfaceFields._fields, COLORS, strict=True):
            points, arrows = data[f"{coin}, {surface}, point"], data[f"{coin}, {surface}, {part}"]
            moving = np.linalg.norm(arrows, axis=1) > 0
            if moving.any():
                axes.quiver(
                    *(100 * points[moving].T),
                    *(100 * ARROW * arrows[moving].T),
                    color=color,
                    linewidth=0.8,
                    arrow_length_ratio=0.2,
                )
        axes.set_title(title, fontsize=9)
        axes.set(xlim=(-1.1, 1.1), ylim=(-1.1, 1.1), zlim=(-0.8, 0.8))
        axes.set_box_aspect((22, 22, 16))
        axes.view_init(elev=22, azim=-60)
        axes.set_axis_off()
    return picture


REPRODUCTION = Reproduction(
    paper="Figs 13-15",
    title="velocities of a coin's surface, and where the air presses on it",
    assumed=(
        "Coin and motion are unsaid; here the imperfect coin of section 5.1, four times as thick so that its "
        "wall is seen."
    ),
    seconds=5,
    make=make,
    draw={"figure": _draw},
)
