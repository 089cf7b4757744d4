"""A step of free flight: those parts of MuJoCo that a coin without contacts needs."""

import numpy as np

from coin_mj.model.library import (
    mj_acceleration,
    mj_actuation,
    mj_center,
    mj_factor_mass,
    mj_kinematics,
    mj_make_mass,
    mj_transmission,
    mj_velocity,
)
from coin_mj.model.state import motion_of, set_motion
from coin_mj.steps.runge_kutta import add_rate, end_motion, stage_motion
from models.kernel.arrays import copy_into
from models.kernel.compiled import compiled


@compiled
def free_step(coin, dt):
    """Advance by dt [s] of free flight with RK4.

    A stage leaves out those parts of `mj_forward` that concern contacts and joints: it takes half the time.
    """
    start = motion_of(coin)
    rate, total, motion = np.empty(13), np.zeros(13), np.empty(13)
    copy_into(motion, start)
    for stage in range(4):
        if stage > 0:
            stage_motion(start, rate, stage, dt, motion)
            set_motion(coin, motion)
        _free_forward(coin)
        add_rate(motion, coin.joint.qacc_smooth, stage, rate, total)
    set_motion(coin, end_motion(start, total, dt, motion))


@compiled
def _free_forward(coin):
    """Compute the accelerations without the floor."""
    place_body(coin)
    mj_velocity(coin.address.model, coin.address.data)
    mj_actuation(coin.address.model, coin.address.data)
    mj_acceleration(coin.address.model, coin.address.data)


@compiled
def place_body(coin):
    """Compute what of MuJoCo's data depends on qpos alone, but for contacts."""
    mj_kinematics(coin.address.model, coin.address.data)
    mj_center(coin.address.model, coin.address.data)
    mj_make_mass(coin.address.model, coin.address.data)
    mj_factor_mass(coin.address.model, coin.address.data)
    mj_transmission(coin.address.model, coin.address.data)
