"""MuJoCo's own forces, its Euler step and the settings of its contact."""

from cointoss.coin_mj.model.addresses import numbers_at
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of, run
from cointoss.coin_mj.model.settings import NO_DAMPING
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector


@compiled
def other_force(coin: MujocoCoin) -> Vector:
    """Return weight and drag, space frame, (3,) [N], after `forward`."""
    f, g = joint_of(coin).qfrc_actuator, joint_of(coin).qfrc_passive
    m = coin.body.mass
    return (
        f[0] + g[0] + m * coin.body.downhill,
        f[1] + g[1],
        f[2] + g[2] - m * coin.body.gravity,
    )


@compiled
def euler_step(coin: MujocoCoin, dt: float) -> None:
    """Advance by dt [s] with MuJoCo's semi-implicit Euler, by the accelerations that `forward` found."""
    numbers_at(coin.address.timestep, (1,))[0] = dt
    run(coin, coin.mujoco.mj_Euler)


@compiled
def set_margin(coin: MujocoCoin, margin: float) -> None:
    """Let a contact be one up to a height [m]."""
    numbers_at(coin.address.margin, (1,))[0] = margin


@compiled
def set_spring(coin: MujocoCoin, stiffness: float, damping: float, slip_damping: float) -> None:
    """Set the contact's stiffness [1/s²] and damping [1/s], and the damping of MuJoCo's friction [1/s]."""
    solref = numbers_at(coin.address.solref, (2,))
    solref[0], solref[1] = -stiffness, -damping
    if coin.address.solreffriction != 0:
        of_slip = numbers_at(coin.address.solreffriction, (2,))
        # A damping of 0 would be that of the normal motion.
        of_slip[0], of_slip[1] = 0.0, -max(slip_damping, NO_DAMPING)
