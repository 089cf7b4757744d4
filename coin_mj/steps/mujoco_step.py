"""MuJoCo's own forces and integrators, as a coin in contact needs them."""

from coin_mj.model.library import mj_euler, mj_forward, mj_runge_kutta
from coin_mj.model.memory import numbers_at
from coin_mj.model.scene import NO_DAMPING
from models.kernel.compiled import compiled


@compiled
def forward(coin):
    """Return the floor's force along z [N], with all accelerations of the present state computed."""
    mj_forward(coin.address.model, coin.address.data)
    return coin.joint.qfrc_constraint[2]


@compiled
def other_force(coin):
    """Return weight and drag, space frame, (3,) [N], after `forward`."""
    f, g = coin.joint.qfrc_actuator, coin.joint.qfrc_passive
    return f[0] + g[0], f[1] + g[1], f[2] + g[2] - coin.body.mass * coin.body.gravity


@compiled
def rk4_step(coin, dt):
    """Advance by dt [s] with MuJoCo's RK4, after `forward`."""
    numbers_at(coin.address.timestep, (1,))[0] = dt
    mj_runge_kutta(coin.address.model, coin.address.data, 4)


@compiled
def impact_step(coin, dt):
    """Advance by dt [s] in an impact with the integrator of the realisation, after `forward`."""
    if coin.has_one_step:
        numbers_at(coin.address.timestep, (1,))[0] = dt
        # It takes the forces that `forward` found.
        mj_euler(coin.address.model, coin.address.data)
    else:
        rk4_step(coin, dt)


@compiled
def set_margin(coin, margin):
    """Let a contact be one up to a height [m]."""
    numbers_at(coin.address.margin, (1,))[0] = margin


@compiled
def set_spring(coin, stiffness, damping, slip_damping):
    """Set the contact's stiffness [1/s²] and damping [1/s], and the damping of MuJoCo's friction [1/s]."""
    solref = numbers_at(coin.address.solref, (2,))
    solref[0], solref[1] = -stiffness, -damping
    if coin.address.solreffriction != 0:
        of_slip = numbers_at(coin.address.solreffriction, (2,))
        # A damping of 0 would be that of the normal motion.
        of_slip[0], of_slip[1] = 0.0, -max(slip_damping, NO_DAMPING)
