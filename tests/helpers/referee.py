"""An independent toss, written from the paper with SciPy alone: solve_ivp and quadrature.

It shares no line with the engines. Slow, and only for tests.
"""

from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any, cast

import numpy as np
from scipy.integrate import cubature, solve_ivp

from cointoss.models.scenario import Scenario


def air_on_element(
    ln: float, lt: float, b: float, v: np.ndarray, w: np.ndarray, points: np.ndarray, normals: np.ndarray
) -> np.ndarray:
    """Give the force on surface elements, per area, from eqs (51)-(58) and (73), (..., 3)."""
    velocity = v + points @ _skew(w).T
    normal_speed = np.vecdot(velocity, normals)[..., None]
    along = velocity - normal_speed * normals
    friction = -lt * np.vecdot(along, along)[..., None] ** (b / 2) * along
    return friction - ln * np.maximum(normal_speed, 0) ** (1 + b) * normals


def air_by_cubature(
    r: float, h: float, ln: float, lt: float, b: float, v: np.ndarray, w: np.ndarray, tolerance: float
) -> np.ndarray:
    """Integrate the air's force and moment at B adaptively, surface by surface.

    Args:
        r: radius.
        h: thickness.
        ln: λ_n.
        lt: λ_τ.
        b: exponent.
        v: velocity of B, body frame.
        w: angular velocity, body frame.
        tolerance: error allowed on each surface, of forces and of moments over r.

    Returns:
        Force and moment, (6,).
    """
    sizes = np.array([1, 1, 1, r, r, r])

    def pull_of(points: np.ndarray, normals: np.ndarray) -> np.ndarray:
        force = air_on_element(ln, lt, b, v, w, points, normals)
        return np.concatenate([force, np.cross(points, force)], axis=-1)

    def on_face(side: float) -> Any:
        def pull(x: np.ndarray) -> np.ndarray:
            rho, angle = x[:, 0], x[:, 1]
            points = np.stack([rho * np.cos(angle), rho * np.sin(angle), 0 * rho + side * h / 2], axis=-1)
            return pull_of(points, np.array([0, 0, side])) * rho[:, None] / sizes

        return pull

    def on_wall(x: np.ndarray) -> np.ndarray:
        normals = np.stack([np.cos(x[:, 1]), np.sin(x[:, 1]), 0 * x[:, 1]], axis=-1)
        points = r * normals + x[:, :1] * np.array([0, 0, 1.0])
        return pull_of(points, normals) * r / sizes

    total = np.zeros(6)
    for pull, low, high in ((on_face(1.0), 0.0, r), (on_face(-1.0), 0.0, r), (on_wall, -h / 2, h / 2)):
        # SciPy's own default makes type checkers take the tolerances for integers.
        limits: dict[str, Any] = {"rtol": 0.0, "atol": tolerance, "max_subdivisions": 20_000}
        done = cubature(pull, [low, 0], [high, 2 * np.pi], **limits)
        assert done.status == "converged"
        total += done.estimate * sizes
    return total


def air_on_cylinder(
    r: float,
    h: float,
    ln: float,
    lt: float,
    v: np.ndarray,
    w: np.ndarray,
    b: float = 0.0,
    n: int = 24,
    around: int = 4096,
) -> np.ndarray:
    """Integrate the air's force and moment at B over both faces and the wall, pressure one-sided.

    Eqs (49)-(58) and (72)-(74), in the body frame. Gauss's rule across and along, the rectangle rule around;
    on the wall the sign of the normal velocity is constant between known angles only for h = 0, so there the
    rectangle rule needs many points.

    Returns:
        Force and moment, (6,).
    """
    points, normals, areas = surface(r, h, n, around)
    force = air_on_element(ln, lt, b, v, w, points, normals) * areas[:, None]
    products = points.T @ force
    moment = products - products.T
    return np.array([*force.sum(axis=0), moment[1, 2], moment[2, 0], moment[0, 1]])


@cache
def surface(r: float, h: float, n: int, around: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return points of both faces and the wall, the outward normals there, and the areas they stand for."""
    nodes, weights = np.polynomial.legendre.leggauss(n)
    angle = 2 * np.pi * (np.arange(around) + 0.5) / around
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1)
    up = np.array([0, 0, 1.0])
    rho = r * (nodes[:, None] + 1) / 2
    on_face = np.broadcast_to(rho * (r * weights[:, None] / 2) * (2 * np.pi / around), (n, around))
    parts = [
        (rho[..., None] * ring + side * h / 2 * up, np.broadcast_to(side * up, (n, around, 3)), on_face)
        for side in (1.0, -1.0)
    ]
    if h > 0:
        on_wall = np.broadcast_to(h * weights[:, None] / 2 * r * (2 * np.pi / around), (n, around))
        height = h * nodes[:, None] / 2
        parts.append((r * ring + height[..., None] * up, np.broadcast_to(ring, (n, around, 3)), on_wall))
    points, normals, areas = zip(*parts, strict=True)
    return np.concatenate(points).reshape(-1, 3), np.concatenate(normals).reshape(-1, 3), np.ravel(areas)


def air_matrix(r: float, h: float, ln: float, lt: float) -> np.ndarray:
    """Give the matrix of the linear map from (v_B, w) to force and moment, column by column, (6, 6)."""
    return np.column_stack([air_on_cylinder(r, h, ln, lt, u[:3], u[3:]) for u in np.eye(6)])


@dataclass
class Referee:
    """The coin of a scenario in the referee's own terms."""

    scenario: Scenario

    def __post_init__(self) -> None:
        coin, air = self.scenario.coin, self.scenario.air
        self.m, self.r, self.h = coin.mass, coin.radius, coin.thickness
        self.c = np.array(coin.center_of_mass)
        m, r, h, c = self.m, self.r, self.h, self.c
        J_B = np.diag([m * r**2 / 4 + m * h**2 / 12] * 2 + [m * r**2 / 2])
        self.J = J_B - m * (np.dot(c, c) * np.eye(3) - np.outer(c, c))
        self.J_inverse, self.about_C = np.linalg.inv(self.J), _skew(c)
        self.b, self.ln, self.lt = air.exponent, air.normal, air.tangential

    @cached_property
    def air(self) -> np.ndarray:
        """The matrix of linear air, (6, 6)."""
        return air_matrix(self.r, self.h, self.ln, self.lt) if self.ln or self.lt else np.zeros((6, 6))

    def start(self) -> np.ndarray:
        release = self.scenario.release
        return np.array([*release.position, *release.velocity, *release.attitude, *release.angular_velocity])

    def rotation(self, y: np.ndarray) -> np.ndarray:
        """Give the matrix to the Euler parameters: Rodrigues' formula in their half angle."""
        E = _skew(y[7:10])
        return np.eye(3) + 2 * (y[6] * E + E @ E) / (y[6:10] @ y[6:10])

    def rate(self, _: float, y: np.ndarray) -> np.ndarray:
        R, w, W = self.rotation(y), y[10:13], _skew(y[10:13])
        v_B = y[3:6] @ R + self.about_C @ w
        if self.b == 0:
            f_and_m = self.air @ np.concatenate([v_B, w])
        else:
            f_and_m = air_on_cylinder(self.r, self.h, self.ln, self.lt, v_B, w, self.b, n=12, around=192)
        f, m_B = f_and_m[:3], f_and_m[3:]
        m_C = m_B - self.about_C @ f
        dy = np.empty(13)
        dy[:3], dy[3:6] = y[3:6], R @ f / self.m
        dy[5] -= self.scenario.gravity
        dy[6], dy[7:10] = -(y[7:10] @ w) / 2, (y[6] * w - W @ y[7:10]) / 2
        dy[10:] = self.J_inverse @ (m_C - W @ (self.J @ w))
        return dy

    def gap(self, _: float, y: np.ndarray) -> float:
        up = self.rotation(y)[2]
        return y[2] - up @ self.c - self.h / 2 * abs(up[2]) - self.r * np.hypot(up[0], up[1])

    def fly(self, y: np.ndarray, duration: float, until_touch: bool) -> tuple[float, np.ndarray]:
        """Fly for `duration`, or until the gap, once open, closes."""
        # For b > 0 the quadrature is slow, and its kinks spoil tighter tolerances.
        linear, event = self.b == 0, cast(Any, self.gap)
        event.__func__.terminal, event.__func__.direction = until_touch, -1
        flight = solve_ivp(
            self.rate,
            (0, duration),
            y,
            method="DOP853",
            rtol=1e-13 if linear else 1e-10,
            atol=1e-15 if linear else 1e-12,
            max_step=2e-3 if until_touch else np.inf,
            events=event if until_touch else None,
        )
        assert flight.success
        assert not until_touch or flight.status == 1, "the coin did not touch"
        return flight.t[-1], flight.y[:, -1]

    def hit(self, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Solve eqs (86)-(90) on a smooth floor as one linear system; give velocities and impulse."""
        R, v, w = self.rotation(y), y[3:6], y[10:13]
        down = -R[2, :2] / np.linalg.norm(R[2, :2])
        A = np.array([*(self.r * down), -np.sign(R[2, 2]) * self.h / 2]) - self.c
        # Unknowns: v' (3), w' (3), S (3).
        v_Az = R[2:] @ np.hstack([R.T, -_skew(A), np.zeros((3, 3))])
        rows = [
            np.hstack([self.m * np.eye(3), np.zeros((3, 3)), -np.eye(3)]),
            np.hstack([np.zeros((3, 3)), self.J, -_skew(A) @ R.T]),
            v_Az,
            np.eye(9)[6:8],
        ]
        rebound = -self.scenario.floor.restitution * (v_Az @ [*v, *w, 0, 0, 0])
        solved = np.linalg.solve(np.vstack(rows), np.concatenate([self.m * v, self.J @ w, rebound, [0, 0]]))
        after = y.copy()
        after[3:6], after[10:13] = solved[:3], solved[3:6]
        return after, solved[6:9]


def _skew(a: np.ndarray) -> np.ndarray:
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
