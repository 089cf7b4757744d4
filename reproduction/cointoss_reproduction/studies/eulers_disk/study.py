"""How Euler's disk stops: one loss at a time beside its closed form, and the toy with friction and air."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

import cointoss
from cointoss import Scenario, Toss, analytic
from cointoss_reproduction.frame.cells import Cells, Rows
from cointoss_reproduction.frame.study import study

MASS, RADIUS, GRAVITY = 2e-3, 1.25e-2, 9.81
"""Mass and radius of the thin disc, and g [kg, m, m/s²]."""
RATE = (GRAVITY / RADIUS) ** 0.5
LOSSES = {
    "contour friction": ("floor.contour_friction", 2e-5 * RADIUS, 0.1, 2 / 3, 2 * 2e-5),
    "contour viscosity": ("floor.contour_viscosity", 2e-7 * RADIUS / RATE, 0.02, 1 / 2, 16 / 3 * 2e-7),
    "air": ("air.viscosity", 1e-8 * MASS * RATE / RADIUS, 0.03, 1 / 3, 2 * np.pi * 1e-8),
}
"""The field, its value, the first tilt [rad], and n and k of α^(1/n) = k √(g/r) (t₀ - t)."""
FROM, TO, LAST, SAMPLES = 0.5, 1e-2, 1e-4, 120
"""The parts of the time left between which the exponent is fitted, that of the last sample, and how many."""
TOYS = {"friction and air": (), "friction alone": ("air.viscosity", 0.0)}
EARLY, LATE = (0.05, 0.15), (7e-3, 2e-2)
"""Tilts between which the toy's exponent is fitted [rad]."""


def disc(field: str, size: float, tilt: float) -> Scenario:
    """Return a thin disc that rolls round its resting mass centre: Ω² sin α = 4 g/r, |ω| = Ω sin α."""
    described = {
        "coin": {"mass": MASS, "radius": RADIUS, "thickness": 0.0},
        "floor": {"contact": "perfectly_rough", "restitution": 0.0},
        "release": {
            "position": [0.0, 0.0, RADIUS * np.sin(tilt)],
            "angles": [0.0, tilt, 0.0],
            "angular_velocity": [0.0, 2 * RATE * np.sin(tilt) ** 0.5, 0.0],
        },
        "ending": {"until": "rest"},
    }
    return Scenario.model_validate(described).replace(field, size)


def fall(tossed: Toss) -> tuple[np.ndarray, np.ndarray]:
    """Return the times left until a disk lies, from the first, and the tilts then [s, rad]."""
    left = tossed.path_end * np.geomspace(1.0, LAST, SAMPLES)
    normal = tossed.sample(tossed.path_end - left).normal
    return left, np.arcsin(np.minimum(np.hypot(*normal[:, :2].T), 1.0))


def exponent(left: np.ndarray, tilts: np.ndarray) -> float:
    """Return n of α ~ (t₀ - t)ⁿ."""
    return float(np.polyfit(np.log(left), np.log(tilts), 1)[0])


def alone(loss: tuple[str, float, float, float, float]) -> Iterator[Rows]:
    """Return how a thin disc falls under one loss beside the closed form; then samples of the fall."""
    field, size, tilt, closed, slope = loss
    tossed = analytic.toss(disc(field, size, tilt))
    left, tilts = fall(tossed)
    fitted = (left < FROM * left[0]) & (left > TO * left[0])
    steady = np.polyfit(left[fitted], tilts[fitted] ** (1 / closed), 1)[0] / (slope * RATE)
    ends = {"first": tilts[fitted][0], "last": tilts[fitted][-1], "seconds": tossed.path_end}
    yield {"of": "law", "closed": closed, "n": exponent(left[fitted], tilts[fitted]), "rate": steady, **ends}
    yield pd.DataFrame({"of": "fall", "left": left, "tilt": tilts})


def toy(losses: tuple[Any, ...]) -> Iterator[Rows]:
    """Return when the toy stops, and its exponents at large and at small tilts; then samples of the fall."""
    case = cointoss.load("euler_disk")
    tossed = analytic.toss(case.replace(*losses, "ending.until", "rest"))
    left, tilts = fall(tossed)
    found = {
        name: exponent(left[(tilts > least) & (tilts < most)], tilts[(tilts > least) & (tilts < most)])
        for name, (least, most) in {"early": EARLY, "late": LATE}.items()
    }
    yield {"of": "toy", "seconds": tossed.path_end, **found}
    yield pd.DataFrame({"of": "toy's fall", "left": left, "tilt": tilts})


REPRODUCTION = study(__name__, Cells(alone, {"loss": LOSSES}), Cells(toy, {"losses": TOYS}))
