"""Figs 13-15: the velocities of a coin's surface, and the parts of it where the air presses."""

import math
from functools import partial

import numpy as np
from matplotlib.figure import Figure

from cointoss import Scenario, load
from cointoss.coin_mj import MujocoSettings
from cointoss.study import (
    BLUE,
    GREEN,
    ORANGE,
    PALE,
    Array,
    Progress,
    force_and_moment,
    forward,
    machine_of,
    shape_thickness,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.studies.fig13.velocity_field import SurfaceFields, velocity_fields

FINE = {"rings": 100, "spokes": 240, "levels": 41}
"""How many points the sums have."""
COARSE = {"rings": 3, "spokes": 12, "levels": 3}
"""How many points the picture has."""
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
"""For each panel: the coin, the part of its velocities, and the title."""
COLORS = (BLUE, ORANGE, GREEN)
"""The colours of the faces ζ = +h/2 and -h/2, and of the wall."""


def make(progress: Progress) -> Findings:
    """Sum the air over the fields of a thick coin, and compare with the integrals of both engines."""
    thick = load("fig13")
    thin = thick.replace("coin.thickness", 0.0, "coin.center_of_mass", (-1e-3, -1e-3, 0.0))
    fields, of_thin = _fields(thick, FINE), _fields(thin, FINE)
    progress(1, 2)
    sums, integrals = (
        [f(b) for b in (0.0, 1.0)] for f in (partial(_sum, thick, fields), partial(_integral, thick))
    )
    progress(2, 2)
    return Findings(
        data={
            f"{coin}, {surface}, {part}": array
            for coin, scenario in (("thick", thick), ("thin", thin))
            for surface, field in zip(SurfaceFields._fields, _fields(scenario, COARSE), strict=True)
            for part, array in (
                ("point", field.point),
                ("velocity", field.velocity),
                ("velocity outwards", field.velocity * field.moves_outwards[:, None]),
                ("outward", field.outward),
                ("tangential", field.tangential),
            )
        },
        outwards=[field.moves_outwards for field in fields],
        off=np.array([_apart(sums[0], other) for other in (integrals[0], _by_mujoco(thick))]),
        one_outwards=[
            np.mean(of.upper.moves_outwards != of.lower.moves_outwards) for of in (of_thin, fields)
        ],
        faces_apart=np.abs(of_thin.upper.velocity - of_thin.lower.velocity).max(),
        off_at_1=[_apart(one, integrals[1]) for one in sums],
    )


def _fields(case: Scenario, points: dict[str, int]) -> SurfaceFields:
    # Released flat: body and space frame are one.
    return velocity_fields(case.body, case.release.velocity, case.release.angular_velocity, **points)


def _sum(case: Scenario, fields: SurfaceFields, b: float) -> Array:
    """Sum -λ |v|^b v dA over the points of the fields.

    Returns:
        The air's force [N] and its moment about B [N m], body frame, (2, 3).
    """
    total = np.zeros((2, 3))
    for field, area in zip(fields, _areas(case), strict=True):
        pressure, friction = (
            -coefficient * np.linalg.norm(v, axis=1, keepdims=True) ** b * v * area[:, None]
            for coefficient, v in (
                (case.air.normal, field.outward),
                (case.air.tangential, field.tangential),
            )
        )
        force = pressure + friction
        total += np.sum([force, np.cross(field.point, force)], axis=1)
    return total


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


def _integral(case: Scenario, b: float) -> Array:
    """Return force and moment by the integral of the analytic engine, (2, 3)."""
    body = case.replace("air.exponent", b).body
    f, m_C = force_and_moment(body, case.release.velocity, case.release.angular_velocity)
    return np.array([f, m_C + np.cross(body.center, f)])


def _by_mujoco(case: Scenario) -> Array:
    """Return force and moment of MuJoCo's actuators and its damping on the released coin, (2, 3)."""
    machine = machine_of(case, MujocoSettings(), shape_thickness(case))
    forward(machine.coin)
    return (machine.data.qfrc_actuator + machine.data.qfrc_passive).reshape(2, 3)


def _apart(a: Array, b: Array) -> float:
    """Return the largest difference of forces and of moments, each relative to b's size."""
    return float(np.max(np.linalg.norm(a - b, axis=1) / np.linalg.norm(b, axis=1)))


def _draw(data: Data) -> Figure:
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


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
