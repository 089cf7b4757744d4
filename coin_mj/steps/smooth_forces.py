"""The forces on MuJoCo's coin that know no floor: those of its own motion, weight and air."""

import numpy as np

from cointoss.coin_mj.model.addresses import call_at, numbers_at
from cointoss.coin_mj.model.air import PowerLaw, air_force
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of, run
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import is_linear
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import apply, apply_transposed, dot


@compiled
def write_smooth_forces(coin: MujocoCoin, feels_air: bool) -> None:
    """Write qfrc_bias, qfrc_passive and qfrc_actuator of a placed coin, as `mj_forward` does.

    Without `feels_air` the force of air with b > 0 stays what it was.

    MuJoCo's own stages for passive forces and actuators take the most time of a step: they look for springs,
    tendons, fluids and every kind of actuator. `_write_linear_drag` writes what they find of linear air.
    """
    run(coin, coin.mujoco.mj_comVel)
    at = coin.address
    call_at(coin.mujoco.mj_rne, (at.model, at.data, np.int32(0), coin.joint.qfrc_bias))
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
    along = (drag.force_tangential - drag.force_normal) * dot(normal, (v[0], v[1], v[2]))
    for i in range(3):
        joint.qfrc_actuator[i] = along * normal[i]
        joint.qfrc_passive[i] = -drag.force_tangential * v[i]
    joint.qfrc_passive[3] = -drag.moment_tangential * v[3]
    joint.qfrc_passive[4] = -drag.moment_tangential * v[4]
    joint.qfrc_passive[5] = -drag.moment_normal * v[5]


@compiled
def _write_air(coin: MujocoCoin) -> None:
    """Write the force and the moment of air with b > 0, which MuJoCo lacks."""
    body, joint = coin.body, joint_of(coin)
    qpos, v, passive = joint.qpos, joint.qvel, joint.qfrc_passive
    R = rotation_matrix((qpos[3], qpos[4], qpos[5], qpos[6]))
    of_B, w = apply_transposed(R, (v[0], v[1], v[2])), (v[3], v[4], v[5])
    law = PowerLaw(body.air.normal, body.air.tangential, body.air.exponent or 0.0)
    f, m = air_force(body.radius, body.thickness, law, of_B, w)
    f = apply(R, f)
    for i in range(3):
        passive[i], passive[3 + i] = f[i], m[i]
