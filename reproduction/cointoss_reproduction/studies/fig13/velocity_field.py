"""The velocities of a coin's surface, and the parts of them on which the air acts: data of Figs 13-15."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cointoss.study import Array, Body


@dataclass(frozen=True, kw_only=True, eq=False)
class VelocityField:
    """Points of one surface and their velocities, body frame."""

    point: Array
    """The points of the surface from B, (n, 3) [m]; eqs (60), (62), (64)."""
    normal: Array
    """The outward unit normals, (n, 3); eq. (57)."""
    velocity: Array
    """The velocities of the points, (n, 3) [m/s]; Fig. 14(a)."""
    outward: Array
    """The normal part of the velocity where it points outwards, else 0, (n, 3) [m/s]; there pressure acts,
    eq. (58), Figs 14(c), 15(a)."""
    tangential: Array
    """The tangential part of the velocity, on which friction acts everywhere, (n, 3) [m/s]; Figs 14(d),
    15(b)."""

    @property
    def moves_outwards(self) -> np.ndarray:
        """Where the surface moves outwards, (n,): s_i of eqs (67)-(71); velocities there are Fig. 14(b)."""
        return np.sum(self.velocity * self.normal, axis=1) > 0


class SurfaceFields(NamedTuple):
    """The velocities of a whole coin, surface by surface."""

    upper: VelocityField
    """The face ζ = +h/2, of A_1."""
    lower: VelocityField
    """The face ζ = -h/2, of A_2; for a thin coin its velocities are those of the upper face, eq. (75)."""
    wall: VelocityField
    """The wall, of A_3; without points for a thin coin."""


def velocity_fields(
    body: Body,
    v: Sequence[float],
    w: Sequence[float],
    *,
    rings: int = 6,
    spokes: int = 24,
    levels: int = 5,
) -> SurfaceFields:
    """Return the velocities of points spread over a moving coin; Strzalko et al. 2008, eqs (59)-(65), (75).

    Args:
        body: the coin.
        v: velocity of C, body frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        rings: circles of points on each face, the outermost on the rim.
        spokes: points on each circle.
        levels: circles of points on the wall, from rim to rim.
    """
    angle = 2 * np.pi * np.arange(spokes) / spokes
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros(spokes)], axis=1)
    rho = body.radius * np.arange(1, rings + 1) / rings
    face = (rho[:, None, None] * ring).reshape(-1, 3)
    up, half = np.array([0.0, 0.0, 1.0]), body.thickness / 2
    z = np.linspace(-half, half, levels if half > 0 else 0)
    wall = (body.radius * ring + z[:, None, None] * up).reshape(-1, 3)
    return SurfaceFields(
        upper=_field(body, v, w, face + half * up, np.tile(up, (len(face), 1))),
        lower=_field(body, v, w, face - half * up, np.tile(-up, (len(face), 1))),
        wall=_field(body, v, w, wall, np.tile(ring, (len(z), 1))),
    )


def _field(body: Body, v: Sequence[float], w: Sequence[float], point: Array, normal: Array) -> VelocityField:
    velocity = np.array(v) + np.cross(w, point - np.array(body.center))
    speed = np.sum(velocity * normal, axis=1, keepdims=True)
    return VelocityField(
        point=point,
        normal=normal,
        velocity=velocity,
        outward=np.maximum(speed, 0) * normal,
        tangential=velocity - speed * normal,
    )
