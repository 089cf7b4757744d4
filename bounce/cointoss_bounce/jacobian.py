"""The Jacobian of a point of a body."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from cointoss_bounce.arrays import Array


def jacobian_of(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    point: Array,
    body: int,
    function: Callable[..., Any] = mujoco.mj_jac,
) -> Array:
    """Return the Jacobian of a point's velocity, or by mj_jacDot its rate of change, (3, nv).

    Args:
        model: of MuJoCo.
        data: its state.
        point: in the space frame, (3,) [m].
        body: with which the point moves.
        function: of MuJoCo that gives it.
    """
    jacobian = np.zeros((3, model.nv))
    function(model, data, jacobian, None, point, body)
    return jacobian
