"""An independent toss in 113-bit arithmetic: heyoka's Taylor series and its guaranteed event detection.

It shares no line with the engines; only for tests. Needs a heyoka built with quadruple precision.
"""

from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple

import heyoka as hy
import numpy as np

from cointoss.models.scenario import Scenario

Q = hy.real128
PI = Q("3.14159265358979323846264338327950288")
# Mass, radius, thickness and gravity; c; J_C and its inverse, row by row; drag across and along the normal.
_M, _R, _H, _G, _C, _J, _J_INVERSE, _DRAG, _COUNT = 0, 1, 2, 3, 4, 7, 16, 25, 29


class ExtendedTouch(NamedTuple):
    """An impact, rounded to double precision."""

    time: float
    heads: bool
    """Whether n_z > 0."""
    impulse: np.ndarray
    """(3,) [N s]."""


def _dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Any, b: Any) -> list[Any]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _rotation(e: Any) -> list[list[Any]]:
    """Give R(e) in its homogeneous form, body to space."""
    a, b, c, d = e
    return [
        [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
        [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
        [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
    ]


@cache
def integrator(number: Any, with_floor: bool, lanes: int = 0) -> Any:
    """Compile the motion of (z, v, e, w) and, for each face, the event that its rim reaches the floor.

    Args:
        number: type to compute with.
        with_floor: whether the events are looked for; each ends the flight.
        lanes: how many coins fly at once, in heyoka's batch mode; 0 without it.
    """
    z, *rest = hy.make_vars("z", "vx", "vy", "vz", "e0", "e1", "e2", "e3", "wx", "wy", "wz")
    v, e, w = rest[0:3], rest[3:7], rest[7:10]
    par = [hy.par[i] for i in range(_COUNT)]
    c, J, J_inverse = par[_C:_J], par[_J:_J_INVERSE], par[_J_INVERSE:_DRAG]
    force, moment = par[_DRAG : _DRAG + 2], par[_DRAG + 2 : _COUNT]
    R = _rotation(e)
    columns = [[R[i][j] for i in range(3)] for j in range(3)]
    wind = [_dot(columns[j], v) - _cross(w, c)[j] for j in range(3)]
    f = [-force[j // 2] * wind[j] for j in range(3)]
    about_B = [-moment[j // 2] * w[j] for j in range(3)]
    about_C = [about_B[j] - _cross(c, f)[j] for j in range(3)]
    spin = _cross(w, [_dot(J[3 * j : 3 * j + 3], w) for j in range(3)])
    torque = [about_C[j] - spin[j] for j in range(3)]
    a = [_dot(R[i], f) / par[_M] for i in range(3)]
    rates = [
        v[2],
        a[0],
        a[1],
        a[2] - par[_G],
        -_dot(e[1:], w) / 2,
        *[(e[0] * w[i] + _cross(e[1:], w)[i]) / 2 for i in range(3)],
        *[_dot(J_inverse[3 * j : 3 * j + 3], torque) for j in range(3)],
    ]
    up = R[2]
    events = []
    for side in (-1, 1):
        q = z - _dot(up, c) + side * par[_H] / 2 * up[2]
        rim = q * q - par[_R] * par[_R] * (up[0] * up[0] + up[1] * up[1])
        falling = hy.event_direction.negative
        event = hy.t_event_batch if lanes else hy.t_event
        events.append(event(rim, direction=falling, cooldown=number(0), fp_type=number))
    system = list(zip([z, *v, *e, *w], rates, strict=True))
    adaptive = hy.taylor_adaptive_batch if lanes else hy.taylor_adaptive
    batch = (lanes,) if lanes else ()
    return adaptive(
        system,
        np.full((11, *batch), number(0)),
        pars=np.full((_COUNT, *batch), number(0)),
        t_events=events if with_floor else [],
        fp_type=number,
        compact_mode=True,
    )


def _inverse(matrix: np.ndarray) -> np.ndarray:
    """Return the inverse of a matrix, (3, 3), by cross products; NumPy's own knows no 113-bit numbers."""
    a, b, c = matrix
    columns = np.array([_cross(b, c), _cross(c, a), _cross(a, b)], dtype=Q)
    return np.ascontiguousarray(columns.T) / _dot(a, columns[0])


def _numbers(values: Any) -> np.ndarray:
    return np.array(values, dtype=float).astype(Q)


def _skew(a: np.ndarray) -> np.ndarray:
    o = Q(0)
    return np.array([[o, -a[2], a[1]], [a[2], o, -a[0]], [-a[1], a[0], o]], dtype=Q)


class Extended:
    """The coin of a scenario in 113-bit arithmetic."""

    def __init__(self, scenario: Scenario) -> None:
        coin, air, self.floor = scenario.coin, scenario.air, scenario.floor
        self.m, self.r, self.h = Q(coin.mass), Q(coin.radius), Q(coin.thickness)
        self.c = _numbers(coin.center_of_mass)
        m, r, h, c = self.m, self.r, self.h, self.c
        across = m * r * r / 4 + m * h * h / 12
        self.J = np.array(
            [[(across if i < 2 else m * r * r / 2) if i == j else Q(0) for j in range(3)] for i in range(3)],
            dtype=Q,
        ) + m * np.array(
            [[c[i] * c[j] - (_dot(c, c) if i == j else Q(0)) for j in range(3)] for i in range(3)], dtype=Q
        )
        self.J_inverse = _inverse(self.J)
        ln, lt = Q(air.normal), Q(air.tangential)
        drag = [
            PI * (2 * r * r * lt + r * h * lt + r * h * ln / 2),
            PI * (r * r * ln + 2 * r * h * lt),
            PI * (r**4 * ln / 4 + (r * r * h * h / 2 + r**3 * h + r * h**3 / 12) * lt + r * h**3 * ln / 24),
            PI * (r**4 + 2 * r**3 * h) * lt,
        ]
        self.parameters = np.array(
            [m, r, h, Q(scenario.gravity), *c, *self.J.ravel(), *self.J_inverse.ravel(), *drag], dtype=Q
        )
        release = scenario.release
        e = _numbers(release.attitude)
        e = e / np.sqrt(np.sum(e * e))
        self.start = np.concatenate(
            [
                _numbers([release.position[2]]),
                _numbers(release.velocity),
                e,
                _numbers(release.angular_velocity),
            ]
        )

    def toss(self) -> Iterator[ExtendedTouch]:
        """Give one impact after the other.

        Raises:
            RuntimeError: if the coin sinks into the floor, where a touch went unseen.
        """
        free, coin = integrator(Q, False), integrator(Q, True)
        for flight in (free, coin):
            flight.pars[:] = self.parameters
        coin.state[:], coin.time = self.start, Q(0)
        while True:
            outcome = int(coin.step()[0])
            if not outcome < 0 or outcome < -2:
                if self._gap(coin.state) < 0:
                    raise RuntimeError("a touch went unseen")
                continue
            S, n_z, lift = self._hit(coin.state)
            if not S[2] > 0 and str(self.floor.contact) == "sliding_friction":
                return
            yield ExtendedTouch(float(coin.time), bool(n_z > 0), S.astype(float))
            if not lift > 0:
                return
            # At the zero that the lift-off itself is, the isolation of roots may fail: first clear it.
            free.state[:], free.time = coin.state, coin.time
            w, v = coin.state[8:11], coin.state[1:4]
            pull = 10 + 10 * np.sum(w * w) * self.r + np.sqrt(np.sum(v * v)) * 10
            free.propagate_for(lift / pull / 1000)
            if self._gap(free.state) <= 0:
                raise RuntimeError("the coin touches again at once")
            coin.state[:], coin.time = free.state, free.time

    def _gap(self, y: np.ndarray) -> Any:
        up = _rotation(y[4:8])[2]
        sine = np.sqrt(up[0] * up[0] + up[1] * up[1])
        return y[0] - _dot(up, self.c) - self.h / 2 * abs(up[2]) - self.r * sine

    def _hit(self, y: np.ndarray) -> tuple[np.ndarray, Any, Any]:
        """Let the floor act by eqs (86)-(92); y becomes the state after the impact.

        Returns:
            Impulse, n_z, and the velocity with which the contact point leaves.
        """
        y[4:8] /= np.sqrt(np.sum(y[4:8] * y[4:8]))
        R = np.array(_rotation(y[4:8]), dtype=Q)
        v, w, up = y[1:4].copy(), y[8:11].copy(), R[2]
        sine = np.sqrt(up[0] * up[0] + up[1] * up[1])
        side = Q(-1) if up[2] > 0 else Q(1)
        a = np.array([-self.r * up[0] / sine, -self.r * up[1] / sine, side * self.h / 2], dtype=Q) - self.c
        moves = np.concatenate([_numbers(np.eye(3)), -_times(R, _skew(a))], axis=1)
        v_A = _times(moves, np.concatenate([v, w])[:, None])[:, 0]
        tau = _times(R, np.array([[up[1] / sine], [-up[0] / sine], [Q(0)]], dtype=Q))[:, 0]
        # v_A' is given along z by Newton, along tau and nu by the law; v_A' = v_A + K S.
        K = moves[:, :3] / self.m + _times(
            moves[:, 3:], _times(self.J_inverse, np.ascontiguousarray(moves[:, 3:].T))
        )
        x_unit, y_unit = _numbers([1, 0, 0]), _numbers([0, 1, 0])
        tau[2] = Q(0)
        nu = np.array([-tau[1], tau[0], Q(0)], dtype=Q)
        stop = {
            "sharp_edge": [(nu, 0), (tau, 1)],
            "knurled": [(nu, 1), (tau, 0)],
            "perfectly_rough": [(nu, 0), (tau, 0)],
            "slip_preserving": [(nu, 1), (tau, 1)],
        }
        label = str(self.floor.contact)
        rows, right = [K[2]], [-(1 + Q(self.floor.restitution)) * v_A[2]]
        if label in stop:
            for direction, kept in stop[label]:
                rows.append(_times(direction[None], K)[0])
                right.append((kept - 1) * _dot(direction, v_A))
        else:
            mu = Q(self.floor.friction) if label == "sliding_friction" else Q(0)
            slip = np.sqrt(v_A[0] * v_A[0] + v_A[1] * v_A[1])
            for unit, part in ((x_unit, v_A[0]), (y_unit, v_A[1])):
                row = unit.copy()
                row[2] = mu * part / slip if slip > 0 else Q(0)
                rows.append(row)
                right.append(Q(0))
        S = _times(_inverse(np.array(rows, dtype=Q)), np.array(right, dtype=Q)[:, None])[:, 0]
        y[1:4] = v + S / self.m
        turned = _times(np.ascontiguousarray(moves[:, 3:].T), S[:, None])
        y[8:11] = w + _times(self.J_inverse, turned)[:, 0]
        return S, up[2], -Q(self.floor.restitution) * v_A[2]


def _times(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Multiply matrices; NumPy's own product knows no 113-bit numbers."""
    return np.sum(a[:, :, None] * b[None, :, :], axis=1)
