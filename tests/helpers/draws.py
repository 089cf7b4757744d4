"""Random scenarios for tests, drawn from a seeded generator."""

from typing import Any

import numpy as np

from cointoss.models.laws import ContactLaw
from cointoss.models.scenario import Scenario

ZLOTY: dict[str, Any] = {"mass": 2e-3, "radius": 1.25e-2, "thickness": 2e-3}
THIN = {**ZLOTY, "thickness": 0.0}
PAPER_OFFSET = [-1e-3, -1e-3, -2e-4]
IMPERFECT = {**ZLOTY, "center_of_mass": PAPER_OFFSET}
AIR = {"normal": 0.8, "tangential": 0.2}
PAPER_LAWS = [law for law in ContactLaw if law != ContactLaw.COULOMB]


def scenario(**parts: Any) -> Scenario:
    """Make a scenario from plain parts; what is left out is the zloty coin on a smooth floor in vacuum."""
    described: dict[str, Any] = {
        "coin": ZLOTY,
        "floor": {"restitution": 0.8, "contact": "smooth"},
        "release": {"position": [0.0, 0.0, 0.4]},
    }
    for name, part in parts.items():
        described[name] = {**described.get(name, {}), **part} if isinstance(part, dict) else part
    return Scenario.model_validate(described)


def on_floor(case: Scenario, floor: dict[str, Any]) -> Scenario:
    """Return a scenario with other values of fields of its floor."""
    for field, value in floor.items():
        case = case.replace(f"floor.{field}", value)
    return case


def draw_quaternion(rng: np.random.Generator) -> list[float]:
    """Draw an attitude, uniformly."""
    e = rng.normal(size=4)
    return (e / np.linalg.norm(e)).tolist()


def draw_release(rng: np.random.Generator, spin: float = 40.0) -> dict[str, Any]:
    """Draw a release from a hand's height with spins up to `spin` [rad/s]."""
    return {
        "position": [0.0, 0.0, rng.uniform(0.05, 0.6)],
        "velocity": rng.uniform(-0.3, 0.3, 3).tolist(),
        "quaternion": draw_quaternion(rng),
        "angular_velocity": rng.uniform(-spin, spin, 3).tolist(),
    }


def draw_coin(rng: np.random.Generator) -> dict[str, Any]:
    """Draw one of the paper's four coins: thick or thin, ideal or imperfect."""
    thickness = float(rng.choice([0.0, 2e-3]))
    offset = np.array(PAPER_OFFSET) * rng.integers(2)
    if thickness == 0:
        offset[2] = 0
    return {**ZLOTY, "thickness": thickness, "center_of_mass": offset.tolist()}


LONG_TRANSIENT = {
    "coin": {**THIN, "center_of_mass": [-1e-3, -1e-3, 0.0]},
    "floor": {"restitution": 0.6},
    "release": {
        "position": [0.0, 0.0, 0.2232571941864725],
        "velocity": [-0.2630916079086049, 0.15813628124371526, 0.10461872176262133],
        "quaternion": [-0.5416058674183087, 0.7483481242755854, 0.07912657268055014, 0.37466939395566323],
        "angular_velocity": [-39.24772830057279, -31.306858394604482, -33.19446810360156],
    },
}
"""A coin in vacuum that loses energy for long; the analytic engine settles it after 53 s."""
