"""Laws of one's own: named laws written again, a superball, laws in text, and what a certificate says."""

# ruff: noqa: ARG001

import math
from typing import Any

import numba
import numpy as np

from cointoss.analytic import solve

REFUSED = "the impulse refused"
"""The name of that line of a certificate."""


def smooth(K, v_A, tau, chi, mu):
    return 0.0, 0.0, -(1 + chi) * v_A[2] / K[2][2]


def perfectly_rough(K, v_A, tau, chi, mu):
    return solve(K, (0.0 - v_A[0], 0.0 - v_A[1], -chi * v_A[2] - v_A[2]))


def sharp_edge(K, v_A, tau, chi, mu):
    along = v_A[0] * tau[0] + v_A[1] * tau[1] + v_A[2] * tau[2]
    return solve(K, (along * tau[0] - v_A[0], along * tau[1] - v_A[1], -chi * v_A[2] - v_A[2]))


def sliding_friction(K, v_A, tau, chi, mu):
    slip = (v_A[0] * v_A[0] + v_A[1] * v_A[1]) ** 0.5 or 1.0
    x, y = -mu * v_A[0] / slip, -mu * v_A[1] / slip
    gained = K[2][0] * x + K[2][1] * y + K[2][2] * 1.0
    if gained <= 0:
        return 0.0, 0.0, 0.0
    size = -(1 + chi) * v_A[2] / gained
    return size * x, size * y, size


def superball(along, up):
    """The law v_At' = -along v_At, v_Az' = -up v_Az."""

    def law(K, v_A, tau, chi, mu):
        return solve(K, (-(1 + along) * v_A[0], -(1 + along) * v_A[1], -(1 + up) * v_A[2]))

    return law


def errs(K, v_A, tau, chi, mu):
    """As a law that integrates: a part of 1e-9 too much."""
    return 0.0, 0.0, -(1 + 1e-9) * (1 + chi) * v_A[2] / K[2][2]


def written(text: str) -> Any:
    """Return the law whose definition is this text after "def "."""
    found = {
        **{"math": math, "np": np, "solve": solve, "calls": [0.0]},
        **{"decorated": numba.njit(lambda chi: 1 + chi), "not_decorated": lambda chi: 1 + chi},
    }
    exec(f"def {text}", found)
    return found["law"]


def of(toss, name) -> Any:
    """What a certificate says under a name."""
    return next(line.value for line in toss.certificate if line.name == name)


FREE = {"may_add_energy": True, "may_pull": True}
