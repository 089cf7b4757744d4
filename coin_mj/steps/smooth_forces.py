"""The forces on MuJoCo's coin that know no floor: those of its own motion, weight and air."""

import numpy as np

from cointoss.coin_mj.model.addresses import numbers_at
from cointoss.coin_mj.model.air import air_force
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of, run
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import is_linear
from cointoss.models.kernel.address import call_c
from cointoss.models.kernel.arrays import copy_into, four, three
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import apply, apply_transposed, dot, scale


@compiled
def write_smooth_forces(coin: MujocoCoin, feels_air: bool) -> None:
    """Write qfrc_bias, qfrc_passive and qfrc_actuator of a placed coin, as `mj_forward` does.

    Without `feels_air` the force of air with b > 0 stays what it was.

    MuJoCo's own stages for passive forces and actuators take the most time of a step: they look for springs,
    tendons, fluids and every kind of actuator. `_write_linear_drag` writes what they find of linear air.
    """
    run(coin, coin.mujoco.mj_comVel)
    at = coin.address
    call_c(coin.mujoco.mj_rne, (at.model, at.data, np.int32(0), coin.joint.qfrc_bias))
    if is_linear(coin.body.air):
        _write_linear_drag(coin)
    elif feels_air:
        _write_air(coin)


@compiled
def _write_linear_drag(coin: MujocoCoin) -> None:
    """Write the forces of the free joint's damping and of the actuator along the coin's normal."""
    drag, joint = coin.body.drag, joint_of(coin)
    v = joint.qvel
    R = numbers_at(coin.address.xmat, (3, 3))
    normal = (R[0, 2], R[1, 2], R[2, 2])
    along = (drag.force_tangential - drag.force_normal) * dot(normal, three(v, 0))
    copy_into(joint.qfrc_actuator[:3], scale(along, normal))
    slowed = scale(-drag.force_tangential, three(v, 0))
    across, about = -drag.moment_tangential, -drag.moment_normal
    copy_into(joint.qfrc_passive, (*slowed, across * v[3], across * v[4], about * v[5]))


@compiled
def _write_air(coin: MujocoCoin) -> None:
    """Write the force and the moment of air with b > 0, which MuJoCo lacks."""
    body, joint = coin.body, joint_of(coin)
    qpos, v = joint.qpos, joint.qvel
    R = rotation_matrix(four(qpos, 3))
    of_B, w = apply_transposed(R, three(v, 0)), three(v, 3)
    f, m = air_force(body.radius, body.thickness, body.air, of_B, w)
    copy_into(joint.qfrc_passive, apply(R, f) + m)
