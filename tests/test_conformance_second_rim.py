"""A thick coin that rocks while it rolls: what the landing of its other rim takes, in closed form."""

import numpy as np
import pytest

from cointoss import Engine, Scenario
from cointoss.models.attitude import rotation_matrix

RADIUS, THICKNESS = 12.5e-3, 2e-3
LEAN, TURNING = 0.02, 5.0
"""n_z, and the spin about the normal's horizontal part [rad/s]."""
ABOUT_DIAMETER = RADIUS**2 / 4 + THICKNESS**2 / 12
"""J_ξ/m [m²]."""
KEPT = 1 - THICKNESS**2 / (2 * ABOUT_DIAMETER * (3 + THICKNESS**2 / 4 / ABOUT_DIAMETER))
"""Part of the angular momentum about the vertical that a plastic landing leaves: it stops the slip Ω h."""


def rocking():
    """Return a coin that leans on one rim, which sticks, and turns about the vertical."""
    tilt = np.arccos(LEAN)
    turn = np.array(rotation_matrix((np.cos(tilt / 2), np.sin(tilt / 2), 0.0, 0.0)))
    up = turn[2]
    point = np.array([0.0, -RADIUS * np.sign(up[1]), -THICKNESS / 2])
    spin = TURNING * up
    return Scenario.model_validate(
        {
            "coin": {"mass": 2e-3, "radius": RADIUS, "thickness": THICKNESS},
            "floor": {"contact": "coulomb", "restitution": 0.5, "friction": 0.3},
            "release": {
                "position": [0.0, 0.0, -float((turn @ point)[2])],
                "velocity": (-np.cross(turn @ spin, turn @ point)).tolist(),
                "quaternion": [np.cos(tilt / 2), np.sin(tilt / 2), 0.0, 0.0],
                "angular_velocity": spin.tolist(),
            },
        }
    )


def kept_by_the_first_landing(engine):
    """Return the angular momentum about the vertical after it, at the farthest lean, over that at first."""
    case = rocking()
    path = engine.package.toss(case).path.sample(np.linspace(0, 0.25, 5001))
    up = np.array([rotation_matrix(tuple(e))[2] for e in path.quaternion])
    about_vertical = np.sum(up * (np.diag(case.body.inertia) * path.angular_velocity), axis=1)
    far = np.flatnonzero(up[:, 2] < 0)
    return about_vertical[far[np.argmin(up[far, 2])]] / about_vertical[0]


@pytest.mark.parametrize("engine", list(Engine))
def test_the_landing_of_the_other_rim_stops_the_slip(engine):
    assert kept_by_the_first_landing(engine) == pytest.approx(KEPT, abs=3e-4)
