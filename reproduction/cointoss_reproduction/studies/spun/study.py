"""Which side does a coin show that was spun on its edge? Its faces along the offset of its mass centre."""

from typing import Any

import numpy as np

from cointoss import Engine, Hand, Scenario
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.ends import ends_of

SEED = 80
AXES = {
    "edge": {"1.52 mm": 1.52e-3, "0.4 mm": 0.4e-3},
    "scatter": {"± 1°": 1.0, "± 10°": 10.0},
    "offset": (0.0, 1e-5, 5e-5, 1e-4),
    "engine": (str(Engine.ANALYTIC), str(Engine.MUJOCO)),
}
"""Thickness of the coin, a cent's and as broad as the part of a rounded edge on which it stands [m]; standard
deviation of its normal from the horizontal [deg]; offset of its mass centre towards heads [m]."""
SPINS = {1.0: 1000, 10.0: 2000}
"""Of each coin, by the scatter."""
COIN: dict[str, Any] = {
    "coin": {"mass": 2.5e-3, "radius": 9.525e-3},
    "air": {"normal": 0.8, "tangential": 0.2},
    "floor": {
        "contact": "coulomb",
        "restitution": 0.3,
        "friction": 0.3,
        "rolling_friction": 2e-5,
        "pivoting_friction": 1e-4,
    },
    "release": {"position": [0, 0, 1]},
    "ending": {"max_time": 120.0},
}
"""A cent on its floor, but for thickness and mass centre."""


def spun(
    edge: float, scatter: float, offset: float, engine: str, parts: int = 1, by_mujoco: int = 400
) -> dict[str, int] | None:
    """Spin a cent 1/`parts` of `SPINS` times; by MuJoCo `by_mujoco` times, only with care and far off."""
    is_mujoco = engine == Engine.MUJOCO
    if is_mujoco and (scatter, offset) != (1.0, 1e-4):
        return None
    coin = {**COIN["coin"], "thickness": edge, "center_of_mass": [0.0, 0.0, offset]}
    return ends_of(
        Scenario.model_validate({**COIN, "coin": coin}),
        Hand(spun=True, psi_scatter=float(np.radians(scatter)), up="either"),
        by_mujoco if is_mujoco else SPINS[scatter] // parts,
        engine=engine,
        seed=SEED + AXES["offset"].index(offset),
    )


REPRODUCTION = study(__name__, Cells(spun, AXES))
