"""Section 5.1: the transient Lyapunov exponents of free fall, by the tangent map of the flight."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
import pandas as pd

from cointoss import Scenario, Toss, load
from cointoss.study import (
    FINE,
    Array,
    Body,
    by_numba,
    flight_tangent,
    sample,
    state_at_release,
    state_of,
)
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.both_engines import ENGINES
from cointoss_reproduction.setups.free_fall import MEDIA, MODELS

flight_tangent = by_numba(flight_tangent)
sample = by_numba(sample)

LONGEST = {"vacuum": 100.0, "air": 2000.0}
"""How long the coins fall [s]; in air the last turning is slow to end."""
SAMPLES = 40
SHORT, CHANGE = 0.6, 1e-6
"""Time of two nearby tosses by both engines [s], and how far apart they start, relative to the spin."""
SPIN = 40.0
"""The spin about the middle axis [rad/s]."""


def falling(medium: str, model: str) -> Iterator[dict[str, Any]]:
    """Follow all small changes of a coin's flight."""
    longest = LONGEST[medium]
    times = np.geomspace(0.1, longest, SAMPLES)
    exponents = _exponents(load(MODELS[model]).replace("air", MEDIA[medium]), times)
    for t, each in zip(times, exponents, strict=True):
        yield {"end": "largest", "time": t, "exponent": each.max()}
        yield {"end": "smallest", "time": t, "exponent": each.min()}
    end = exponents[-1]
    power = _power(times, exponents.max(axis=1) * times, longest)
    yield {"end_largest": end.max(), "end_smallest": end.min(), "size": np.abs(end).max(), "power": power}


def nearby(engine: Callable[[Scenario], Toss]) -> dict[str, float]:
    """Return how fast two nearby tosses part, in air, and in vacuum about the middle axis [1/s]."""
    case = load(MODELS["3D imperfect"]).replace("air", MEDIA["air"])
    middle, direction, _ = _about_the_middle_axis()
    about_middle = _growth_of_difference(engine, middle, direction)
    return {
        "nearby": _growth_of_difference(engine, case, np.ones(3)),
        "middle": about_middle,
        "fold": float(np.exp(about_middle * SHORT)),
    }


def tangent() -> dict[str, float]:
    """Return how fast a spin about the middle axis parts, by the tangent map and in closed form [1/s]."""
    case, direction, rate = _about_the_middle_axis()
    return {"middle": growth_of_tangent(case, direction), "rate": rate}


def found(cells: pd.DataFrame) -> dict[str, float]:
    """Return how far the engines are apart."""
    rates = cells.set_index("engine").nearby
    return {"mujoco_off": abs(rates["MuJoCo"] - rates["analytic"])}


def _sizes(body: Body) -> Array:
    """Return the scales of a state: r, √(g r), 1, √(g/r), (13,)."""
    r, g = body.radius, body.gravity
    return np.array([r] * 3 + [(g * r) ** 0.5] * 3 + [1.0] * 4 + [(g / r) ** 0.5] * 3)


def _exponents(case: Scenario, times: Array) -> Array:
    """Return the twelve transient Lyapunov exponents (1/t) ln of the growth, (n, 12) [1/s].

    Changes of the state, on the coin's scales, are carried by the tangent map and made orthogonal again at
    each of `times` (Benettin and others). They keep the quaternion's norm.
    """
    body, (release, *states) = case.body, _flown(case, [0.0, *times])
    e0, e1, e2, e3 = release[6:10]
    basis = np.delete(np.eye(13), 9, axis=0)
    basis[6:9, 6:10] = [[-e1, e0, e3, -e2], [-e2, -e3, e0, e1], [-e3, e2, -e1, e0]]
    # Turned at random, so that each direction has a part of the fastest.
    Q = np.linalg.qr(np.random.default_rng(51).normal(size=(12, 12)))[0] @ basis
    growth, before, start, rows = np.zeros(12), 0.0, release, []
    for t, end in zip(times, states, strict=True):
        changes = np.ascontiguousarray(Q * _sizes(body))
        flight_tangent(body, state_of(start), state_of(end), t - before, FINE, changes)
        orthogonal, R = np.linalg.qr((changes / _sizes(body)).T)
        growth += np.log(np.abs(np.diag(R)))
        Q, before, start = orthogonal.T, t, end
        rows.append(growth / t)
    return np.array(rows)


def _flown(case: Scenario, times: Sequence[float]) -> Array:
    """Return the states of a flight without a floor at these times [s], (n, 13)."""
    states = np.empty((len(times), 13))
    sample(case.body, state_at_release(case.release), 0.0, np.array(times), states)
    return states


def _power(times: Array, logarithm: Array, longest: float) -> float:
    """Return p of a growth like t^p over the last nine tenths of the time: the slope of λ t over ln t."""
    late = times > longest / 10
    return float(np.polyfit(np.log(times[late]), logarithm[late], 1)[0])


def _growth_of_difference(engine: Callable[[Scenario], Toss], case: Scenario, direction: Array) -> float:
    """Return (1/t) ln of the growth of a small change of ω in one direction, from two tosses [1/s]."""
    w = np.array(case.release.angular_velocity)
    change = CHANGE * np.linalg.norm(w) * direction / np.linalg.norm(direction)
    one, other = (
        engine(case.replace("release.angular_velocity", w + by)).sample(SHORT).angular_velocity[0]
        for by in (change, -change)
    )
    return float(np.log(np.linalg.norm(one - other) / np.linalg.norm(2 * change)) / SHORT)


def growth_of_tangent(case: Scenario, direction: Array, duration: float = SHORT) -> float:
    """Return the same by the tangent map, over a duration [s]."""
    changes = np.zeros((1, 13))
    changes[0, 10:] = direction
    start, end = map(state_of, _flown(case, [0.0, duration]))
    flight_tangent(case.body, start, end, duration, FINE, changes)
    return float(np.log(np.linalg.norm(changes[0, 10:]) / np.linalg.norm(direction)) / duration)


def _about_the_middle_axis() -> tuple[Scenario, Array, float]:
    """Return a toss of the thick imperfect coin about its middle axis, and how a change of its spin grows.

    Returns:
        The toss, the change that grows, and its rate, Ω √((J_2 - J_1)(J_3 - J_2)/(J_1 J_3)) [1/s].
    """
    case = load(MODELS["3D imperfect"])
    J, axes = np.linalg.eigh(case.coin.inertia_about_C)
    rate = SPIN * np.sqrt((J[1] - J[0]) * (J[2] - J[1]) / (J[0] * J[2]))
    # J_1 ω̇_1 = (J_2 - J_3) Ω ω_3 in axes of the right hand.
    hand = np.linalg.det(axes)
    direction = axes[:, 0] + rate * J[0] / ((J[1] - J[2]) * SPIN) * hand * axes[:, 2]
    return case.replace("release.angular_velocity", SPIN * axes[:, 1]), direction, float(rate)


REPRODUCTION = study(
    __name__,
    Cells(falling, {"medium": tuple(MEDIA), "model": tuple(MODELS)}),
    Cells(nearby, {"engine": ENGINES}),
    Cells(tangent, {}),
    found=found,
)
