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
from coin_mj.model.machine import motion_of, set_motion
from coin_mj.steps.runge_kutta import add_rate, end_motion, stage_motion
from models.kernel.compiled import compiled


@compiled
def glide(coin, dt):
    """Advance by dt [s] of free flight with RK4.

    A stage is `mj_forward` without what a free body that touches nothing has none of: half its time.
    """
    start = motion_of(coin)
    rate, total, motion = np.empty(13), np.zeros(13), np.empty(13)
    motion[:] = start
    for stage in range(4):
        if stage > 0:
            stage_motion(start, rate, stage, dt, motion)
            set_motion(coin, motion)
        _feel_nothing(coin)
        add_rate(motion, coin.qacc_free, stage, rate, total)
    set_motion(coin, end_motion(start, total, dt, motion))


@compiled
def _feel_nothing(coin):
    """Compute the accelerations without the floor."""
    place_body(coin)
    mj_velocity(coin.model, coin.data)
    mj_actuation(coin.model, coin.data)
    mj_acceleration(coin.model, coin.data)


@compiled
def place_body(coin):
    """Compute what of MuJoCo's data depends on qpos alone, but for contacts."""
    mj_kinematics(coin.model, coin.data)
    mj_center(coin.model, coin.data)
    mj_make_mass(coin.model, coin.data)
    mj_factor_mass(coin.model, coin.data)
    mj_transmission(coin.model, coin.data)
