"""MuJoCo's coin as compiled code sees it."""

from typing import Any, NamedTuple

import numpy as np

from cointoss.coin_mj.model.settings import Rebound
from cointoss.models.body import Body

ADDRESSES = np.dtype(
    [
        (name, np.int64)
        for name in (
            "model",
            "data",
            "time",  # of mjData, for those who wait [s]; no step reads it
            "timestep",
            "solref",  # of the normal force: minus the contact's stiffness [1/s²] and damping [1/s]
            "solreffriction",  # of MuJoCo's own friction, likewise; 0 where that is not asked for
            "margin",  # height up to which a contact is one [m]
            "xmat",  # of the coin: its rotation matrix, (3, 3)
            "nefc",  # number of constraint rows
            "efc_J",  # where the arrays of these rows are now, each an address
            "efc_pos",
            "efc_D",
            "efc_R",
            "efc_aref",
            "air",  # the compiled force of the air with b > 0, see `compiled_air`; 0 of other air
        )
    ]
)
"""Where an mjModel, an mjData, and some of their fields lie."""


class MujocoCoin(NamedTuple):
    """A coin as compiled code sees it: MuJoCo's memory, and the numbers of coin, floor and steps."""

    address: Any
    """A record of `ADDRESSES`."""
    joint: Any
    """See `joint_arrays`."""
    body: Body
    shape: Body
    """The body with the thickness of its shape, and bounds of its inertia for its flight, see `shape_of`."""
    floor_height: float
    """Of MuJoCo's floor [m]."""
    rebound: Rebound
    friction: float
    """Coefficient of friction μ of the floor."""
    rolling_friction: float
    """δ of the floor [m]."""
    pivoting_friction: float
    """p of the floor [m]."""
    is_balanced: bool
    """Whether C is B: then the free joint's mass matrix never changes."""
    has_explicit_friction: bool
    """Whether the friction is Coulomb's force."""
    resists: bool
    """Whether the floor resists rolling or pivoting."""
    has_one_step: bool
    """Whether a contact is one step."""
    flight_angle: float
    """Largest turn in a step of flight [rad]."""
