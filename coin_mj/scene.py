"""The MuJoCo model of a scenario: coin.xml with the scenario's numbers."""

from importlib import resources

import mujoco
import numpy as np

from coin_mj.contact import Spring
from models.drag import linear_drag
from models.scenario import Scenario

THIN_SHAPE = 1e-4
"""Thickness of the shape of a thin coin (h = 0), in radii; its inertia stays the scenario's."""
# A thin coin's inertia lies on the triangle equality, which MuJoCo refuses where rounding breaks it.
INERTIA_WIDENED = 1e-12


def shape_thickness(scenario: Scenario) -> float:
    """Give the thickness of the coin's shape [m]."""
    return scenario.coin.thickness or THIN_SHAPE * scenario.coin.radius


def build(scenario: Scenario, spring: Spring) -> mujoco.MjModel:
    """Build the MuJoCo model of a scenario.

    Args:
        scenario: what to toss.
        spring: the contact.

    Returns:
        The model, with RK4 and a frictionless contact.
    """
    spec = mujoco.MjSpec.from_string((resources.files("models") / "coin.xml").read_text(encoding="utf-8"))
    spec.option.gravity = (0.0, 0.0, -scenario.gravity)
    coin, body = scenario.coin, spec.body("coin")
    J = coin.inertia_about_C
    J = J + INERTIA_WIDENED * np.trace(J) * np.eye(3)
    body.mass = coin.mass
    body.ipos = coin.center_of_mass
    body.fullinertia = (J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2])
    geom = spec.geom("coin")
    geom.size = (coin.radius, shape_thickness(scenario) / 2, 0.0)
    geom.solref = (-spring.stiffness, -spring.damping)
    _set_drag(spec, scenario)
    return spec.compile()


def _set_drag(spec: mujoco.MjSpec, scenario: Scenario) -> None:
    coin, air = scenario.coin, scenario.air
    drag = linear_drag(coin.radius, coin.thickness, air.normal, air.tangential)
    coefficients = {
        "drag_xi": drag.force_tangential,
        "drag_eta": drag.force_tangential,
        "drag_zeta": drag.force_normal,
        "turn_drag_xi": drag.moment_tangential,
        "turn_drag_eta": drag.moment_tangential,
        "turn_drag_zeta": drag.moment_normal,
    }
    for name, coefficient in coefficients.items():
        spec.actuator(name).biasprm[2] = -coefficient
