"""A step of free flight: those parts of MuJoCo that a coin without contacts needs."""

import numpy as np

from coin_mj.model.library import (
    mj_acceleration,
    mj_center,
    mj_factor_mass,
    mj_kinematics,
    mj_make_mass,
)
from coin_mj.model.state import motion_of, set_motion
from coin_mj.steps.runge_kutta import TSITOURAS, end_motion, stage_motion, write_rate
from coin_mj.steps.smooth_forces import write_smooth_forces
from models.kernel.compiled import compiled


@compiled
def free_step(coin, dt):
    """Advance by dt [s] of free flight.

    A stage leaves out those parts of `mj_forward` that concern contacts and joints: it takes half the time.
    """
    rates = rates_of_step()
    free_rate(coin, rates[0])
    free_step_from(coin, motion_of(coin), rates, dt)


@compiled
def rates_of_step():
    """Return room for the rates of the stages of a step, (6, 13)."""
    return np.empty((len(TSITOURAS) - 1, 13))


@compiled
def free_step_from(coin, start, rates, dt):
    """Put the coin dt [s] after a state, in free flight.

    Args:
        coin: MuJoCo's, in any state.
        start: qpos and qvel, (13,).
        rates: their rate in its first row; the others are written, see `rates_of_step`.
        dt: length of the step, of either sign [s].
    """
    motion = np.empty(13)
    for stage in range(1, len(TSITOURAS) - 1):
        stage_motion(start, rates, TSITOURAS, stage, dt, motion)
        set_motion(coin, motion)
        place_body_again(coin)
        _write_rate(coin, rates[stage])
    set_motion(coin, end_motion(start, rates, TSITOURAS, dt, motion))


@compiled
def free_rate(coin, rate):
    """Write the rate of change of the present state without the floor, (13,)."""
    place_body(coin)
    _write_rate(coin, rate)


@compiled
def _write_rate(coin, rate):
    write_smooth_forces(coin)
    mj_acceleration(coin.address.model, coin.address.data)
    write_rate(motion_of(coin), coin.joint.qacc_smooth, rate)


@compiled
def place_body(coin):
    """Compute what of MuJoCo's data depends on qpos alone, but for contacts."""
    mj_kinematics(coin.address.model, coin.address.data)
    mj_center(coin.address.model, coin.address.data)
    mj_make_mass(coin.address.model, coin.address.data)
    mj_factor_mass(coin.address.model, coin.address.data)


@compiled
def place_body_again(coin):
    """Compute the same once more after a motion; the mass matrix of a balanced coin is what it was."""
    if not coin.is_balanced:
        place_body(coin)
        return
    mj_kinematics(coin.address.model, coin.address.data)
    mj_center(coin.address.model, coin.address.data)
