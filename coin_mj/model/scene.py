"""The MuJoCo model of a scenario: coin.xml with the scenario's numbers."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from importlib import resources

import mujoco
import numpy as np

from cointoss.coin_mj.model.settings import NO_DAMPING, Rebound
from cointoss.models.scenario import Scenario

THIN_SHAPE = 1e-6
"""Thickness of the shape of a thin coin (h = 0), in radii; its inertia stays the scenario's."""
_Disable = mujoco.mjtDisableBit
# MuJoCo's compiler makes a step, in which a callback written in Python fails for want of a model.
_UNCALLED = int(_Disable.mjDSBL_SPRING | _Disable.mjDSBL_DAMPER | _Disable.mjDSBL_ACTUATION)
# A thin coin's inertia lies on the triangle equality, which MuJoCo refuses where rounding breaks it.
INERTIA_WIDENED = 1e-12


def shape_thickness(scenario: Scenario) -> float:
    """Return the thickness of the coin's shape [m]."""
    return scenario.coin.thickness or THIN_SHAPE * scenario.coin.radius


def floor_height(scenario: Scenario, thickness: float) -> float:
    """Return the height of MuJoCo's floor [m], for a shape of `thickness` [m].

    It lies lower by what the shape of a thin coin adds below it: a coin that is above the scenario's floor
    is above MuJoCo's, and a thin coin that lies flat on the one lies flat on the other.
    """
    return (scenario.coin.thickness - thickness) / 2


def build(scenario: Scenario, rebound: Rebound, friction: float, thickness: float) -> mujoco.MjModel:
    """Build the MuJoCo model of a scenario.

    Args:
        scenario: what to toss.
        rebound: of the contact.
        friction: coefficient of MuJoCo's own friction; 0 for a frictionless contact.
        thickness: of the coin's shape [m].
    """
    spec = described(scenario, thickness)
    # What is only drawn goes; textures take most of the time in which a model is compiled.
    for geom in spec.geoms:
        geom.material = ""
    for drawn in (*spec.textures, *spec.materials, *spec.lights):
        spec.delete(drawn)
    spec.geom("floor").pos = (0.0, 0.0, floor_height(scenario, thickness))
    coin = spec.geom("coin")
    coin.solref = (-rebound.stiffness, -rebound.damping)
    if friction > 0:
        # Only a pair has a damping of its own for friction; where it is 0 MuJoCo takes the normal's.
        spec.add_pair(
            geomname1="floor",
            geomname2="coin",
            condim=3,
            friction=(friction, friction, 0.0, 0.0, 0.0),
            solref=coin.solref,
            solreffriction=(0.0, -max(rebound.slip_damping, NO_DAMPING)),
            solimp=coin.solimp,
        )
    flags = int(spec.option.disableflags)
    spec.option.disableflags = flags | _UNCALLED
    model = spec.compile()
    # What a description cannot tell.
    model.opt.disableflags = flags
    # MuJoCo's compiler takes two frames less than a micrometre apart for one.
    apart = mujoco.mjtSameFrame.mjSAMEFRAME_NONE
    model.geom("floor").sameframe[:] = apart
    model.body("coin").sameframe[:] = apart
    if scenario.body.air.exponent is None:
        # The rest of linear air is damping of the free joint, whose turning is told in body axes.
        drag = scenario.body.drag
        model.dof_damping[:3] = drag.force_tangential
        model.dof_damping[3:] = (drag.moment_tangential, drag.moment_tangential, drag.moment_normal)
    return model


def described(scenario: Scenario, thickness: float) -> mujoco.MjSpec:
    """Describe the coin over a floor whose contact is still that of coin.xml; see `build`.

    Args:
        scenario: what to toss.
        thickness: of the coin's shape [m].
    """
    spec = mujoco.MjSpec.from_string(
        (resources.files("cointoss.models") / "coin.xml").read_text(encoding="utf-8")
    )
    spec.option.gravity = (scenario.body.downhill, 0.0, -scenario.body.gravity)
    coin, body = scenario.coin, spec.body("coin")
    J = coin.inertia_about_C
    J = J + INERTIA_WIDENED * np.trace(J) * np.eye(3)
    body.mass = coin.mass
    body.ipos = coin.center_of_mass
    body.fullinertia = (J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2])
    spec.geom("coin").size = (coin.radius, thickness / 2, 0.0)
    if scenario.body.air.exponent is None:
        # The rest of the force of linear air, which is larger along the normal, is set by `build`.
        drag = scenario.body.drag
        spec.actuator("drag").biasprm[2] = drag.force_tangential - drag.force_normal
    return spec
