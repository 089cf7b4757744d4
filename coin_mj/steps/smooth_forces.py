"""The forces on MuJoCo's coin that know no floor: those of its own motion, weight and air."""

from cointoss.coin_mj.model.library import mj_bias, mj_center_velocity, mj_passive
from cointoss.coin_mj.model.memory import numbers_at
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.models.body import is_linear
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import dot


@compiled
def write_smooth_forces(coin: MujocoCoin) -> None:
    """Write qfrc_bias, qfrc_passive and qfrc_actuator of a placed coin, as `mj_forward` does.

    Of linear air MuJoCo's own stages take the most time of a step: they look for springs, tendons, fluids and
    every kind of actuator. `_write_linear_drag` writes what they find.
    """
    mj_center_velocity(coin.address.model, coin.address.data)
    mj_bias(coin.address.model, coin.address.data, 0, coin.joint.qfrc_bias.ctypes)
    if is_linear(coin.body.air):
        _write_linear_drag(coin)
    else:
        mj_passive(coin.address.model, coin.address.data)


@compiled
def _write_linear_drag(coin: MujocoCoin) -> None:
    """Write the forces of the free joint's damping and of the actuator along the coin's normal."""
    drag, v, joint = coin.body.drag, coin.joint.qvel, coin.joint
    R = numbers_at(coin.address.xmat, (3, 3))
    normal = (R[0, 2], R[1, 2], R[2, 2])
    along = (drag.force_tangential - drag.force_normal) * dot(normal, (v[0], v[1], v[2]))
    for i in range(3):
        joint.qfrc_actuator[i] = along * normal[i]
        joint.qfrc_passive[i] = -drag.force_tangential * v[i]
    joint.qfrc_passive[3] = -drag.moment_tangential * v[3]
    joint.qfrc_passive[4] = -drag.moment_tangential * v[4]
    joint.qfrc_passive[5] = -drag.moment_normal * v[5]
