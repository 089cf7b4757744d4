"""Engines as users write them: one that is right to first order, and some with planted errors."""

import os
import sys
import time
from typing import Any

import numpy as np

from cointoss.study import rotation_matrix
from cointoss_yardstick.simulators.worker import STATE


class Newton:
    """A smooth coin that steps by half-implicit Euler, and rebounds at its lowest point by Newton's law."""

    name = "Newton's steps"

    def __init__(self, *, lean: float = 0.0, dt: float = 1e-3) -> None:
        """Plant an error.

        Args:
            lean: the angle of the impulse from the vertical [rad].
            dt: the step [s].
        """
        self.dt, self.settings = dt, {"integrator": "half-implicit Euler"}
        self.normal = np.array([np.sin(lean), 0.0, np.cos(lean)])

    def simulate(self, scenario: Any, times: Any) -> dict[str, Any]:
        """Return the states at the steps nearest to the times."""
        coin, floor, release = scenario.coin, scenario.floor, scenario.release
        if floor.contact != "smooth":
            raise NotImplementedError(f"floor.contact = {floor.contact}: accepted: smooth")
        if scenario.air.normal or scenario.air.tangential:
            raise NotImplementedError(f"air.normal = {scenario.air.normal}: accepted: 0")
        m, r, half, J = coin.mass, coin.radius, coin.thickness / 2, np.array(coin.moments)
        x, v = np.array(release.position), np.array(release.velocity)
        e, w = np.array(release.attitude), np.array(release.angular_velocity)
        rows, inverse, up = [], np.linalg.inv(J), np.array([0.0, 0.0, 1.0])
        wanted = np.rint(np.asarray(times) / self.dt).astype(int)
        for _ in range(wanted[-1] + 1):
            rows.append((x, e, v, w))
            v = v - scenario.gravity * self.dt * up
            w = w + self.dt * inverse @ np.cross(J @ w, w)
            turn = np.array(rotation_matrix(tuple(e)))
            n = turn[2]
            across = np.hypot(n[0], n[1])
            rim = -r * n[:2] / across if across > 1e-9 else np.zeros(2)
            point = np.array([*rim, -half * np.sign(n[2])])
            reach = x[2] + (turn @ point)[2]
            rate = (v + turn @ np.cross(w, point))[2]
            if reach + rate * self.dt < 0 and rate < 0:
                normal = self.normal
                lever = np.cross(point, turn.T @ normal)
                K = (normal / m + turn @ np.cross(inverse @ lever, point))[2]
                S = -(1 + floor.restitution) * rate / K
                v, w = v + S * normal / m, w + S * inverse @ lever
            x = x + self.dt * v
            e = _turned(e, w * self.dt)
        return dict(zip(STATE, (np.array(column)[wanted] for column in zip(*rows, strict=True)), strict=True))


def _turned(e: Any, by: Any) -> Any:
    angle = np.linalg.norm(by)
    half = 0.5 * np.sinc(angle / 2 / np.pi) * by
    a, b = np.cos(angle / 2), half
    return np.array([a * e[0] - b @ e[1:], *(e[0] * b + a * e[1:] + np.cross(e[1:], b))])


class Hanging:
    """An engine that never answers."""

    def simulate(self, *_: Any) -> dict[str, Any]:
        while True:
            time.sleep(0.01)


class Crashing:
    """An engine that ends its process."""

    def simulate(self, *_: Any) -> dict[str, Any]:
        print("out of luck", file=sys.stderr, flush=True)
        os._exit(3)


right = Newton()
leaning = Newton(lean=0.05)
hanging = Hanging()
crashing = Crashing()
