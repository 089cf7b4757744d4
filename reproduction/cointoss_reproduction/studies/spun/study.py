"""Which side does a coin show that was spun on its edge? By edge, mass centre, friction and spin."""

from typing import Any

import numpy as np
from scipy.special import ndtr

from cointoss import Engine, Hand, Scenario
from cointoss.study import Array, Body
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.ends import ends_of
from cointoss_reproduction.setups.general_coins import cent

SEED = 80
AXES = {
    "edge": {"1.52 mm": 1.52e-3, "0.4 mm": 0.4e-3},
    "scatter": {"± 1°": 1.0, "± 10°": 10.0},
    "offset": (0.0, 1e-5, 5e-5, 1e-4),
    "friction": (0.0, 0.02, 0.1, 0.3, 1.0),
    "spin": (30.0, 60.0, 90.0, 120.0),
    "engine": (str(Engine.ANALYTIC), str(Engine.MUJOCO)),
}
"""Thickness of the coin, a cent's and as broad as the part of a rounded edge on which it stands [m]; standard
deviation of its normal from the horizontal [deg]; offset of its mass centre towards heads [m]; μ; angular
velocity about the vertical [rad/s]: √(2 g/r) is 45 rad/s, and 2 √(g/r) is 64 rad/s."""
USUAL, FAR = (0.3, 120.0), (1.0, 1e-4)
"""Friction and spin at which every scatter and offset is tried; scatter and offset of all the rest."""
SPINS = {1.0: 1000, 10.0: 2000}
"""How often each coin is spun, by the scatter."""


def spun(
    edge: float,
    scatter: float,
    offset: float,
    friction: float,
    spin: float,
    engine: str,
    parts: int = 1,
    by_mujoco: int = 200,
) -> dict[str, Any] | None:
    """Spin a cent 1/`parts` of `SPINS` times; by MuJoCo `by_mujoco` times, only with care and far off.

    It `turns` by Ω² h/(6 μ g) until friction, μ m g, has stopped the slip of a rim's lowest point [rad];
    without friction, `stays` is the share that leans by less than the `balance` of either rim.
    """
    is_far, is_mujoco, lean = (scatter, offset) == FAR, engine == Engine.MUJOCO, float(np.radians(scatter))
    if not is_far and (is_mujoco or (friction, spin) != USUAL):
        return None
    contact = "coulomb" if friction else "smooth"
    scenario = Scenario.model_validate(cent(edge, offset=offset, contact=contact, friction=friction))
    rims = balance(scenario.body, edge / 2 + offset * np.array([-1, 1]), spin)
    return {
        "turns": spin**2 * edge / (6 * friction * scenario.gravity) if friction else None,
        "stays": None if friction else float(np.sum(ndtr(rims / lean)) - 1),
        **ends_of(
            scenario,
            Hand(spun=True, spin=spin, psi_scatter=lean, up="either"),
            by_mujoco if is_mujoco else SPINS[scatter] // parts,
            engine=engine,
            seed=SEED + AXES["offset"].index(offset),
        ),
    }


def balance(body: Body, a: Array, spin: float) -> Array:
    """Return the lean from which a coin on a smooth floor leans out further, (n,) [rad].

    Where it is turned about the vertical it spins at -Ω sin φ about its normal, and
    J_ξ d²φ/dt² = ((J_ζ - J_ξ) Ω² + m g r) φ - m g a for small φ and a.

    Args:
        body: the coin.
        a: from C to the rim's lowest point along the normal, (n,) [m].
        spin: Ω [rad/s].
    """
    gyroscopic = (body.inertia[2][2] - body.inertia[0][0]) * spin**2 / (body.mass * body.gravity)
    return a / (body.radius + gyroscopic)


REPRODUCTION = study(__name__, Cells(spun, AXES))
