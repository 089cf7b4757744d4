"""A step of free flight: those parts of MuJoCo that a coin without contacts needs."""

import numpy as np

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin, joint_of, run
from cointoss.coin_mj.model.state import Motion, motion_of, set_motion
from cointoss.coin_mj.steps.runge_kutta import (
    TSITOURAS,
    TSITOURAS_NODES,
    end_motion,
    stage_motion,
    write_rate,
)
from cointoss.coin_mj.steps.smooth_forces import write_smooth_forces
from cointoss.coin_mj.steps.turning_frame import frame_of, to_motion, turn_after, write_slow_rate
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled


@compiled
def free_step(coin: MujocoCoin, dt: float) -> None:
    """Advance by dt [s] of free flight.

    A stage leaves out those parts of `mj_forward` that concern contacts and joints: it takes half the time.
    """
    rates = rates_of_step()
    free_rate(coin, rates[0], False)
    free_step_from(coin, motion_of(coin), rates, dt)


@compiled
def rates_of_step() -> Array:
    """Return room for the rate at the start of a step, and those of its stages, (7, 13)."""
    return np.empty((len(TSITOURAS), 13))


@compiled
def free_step_from(coin: MujocoCoin, start: Motion, rates: Array, dt: float) -> None:
    """Put the coin dt [s] after a state, in free flight; the stages are those of its `TurningFrame`.

    Args:
        coin: MuJoCo's, in any state.
        start: qpos and qvel, (13,).
        rates: their rate in its first row; the others are written, see `rates_of_step`.
        dt: length of the step, of either sign [s].
    """
    frame, motion, slow = frame_of(start, rates[0]), np.empty(13), np.empty(13)
    of_stages = rates[1:]
    write_slow_rate(frame, turn_after(frame, 0.0), start, rates[0, 7:], of_stages[0])
    for stage in range(1, len(TSITOURAS) - 1):
        turn = turn_after(frame, TSITOURAS_NODES[stage] * dt)
        stage_motion(start, of_stages, TSITOURAS, stage, dt, slow)
        to_motion(turn, slow, motion)
        set_motion(coin, motion)
        place_body(coin, True)
        _find_acceleration(coin)
        write_slow_rate(frame, turn, slow, joint_of(coin).qacc_smooth, of_stages[stage])
    to_motion(turn_after(frame, dt), end_motion(start, of_stages, TSITOURAS, dt, slow), motion)
    set_motion(coin, motion)


@compiled
def free_rate(coin: MujocoCoin, rate: Array, again: bool) -> None:
    """Write the rate of change of the present state without the floor, (13,); see `place_body`."""
    place_body(coin, again)
    _find_acceleration(coin)
    write_rate(motion_of(coin), joint_of(coin).qacc_smooth, rate)


@compiled
def nudge(coin: MujocoCoin, dt: float) -> None:
    """Advance by a time dt in which the coin hardly turns [s], of either sign, at a constant rate."""
    rate, motion = np.empty(13), np.array(motion_of(coin))
    free_rate(coin, rate, True)
    set_motion(coin, motion + dt * rate)


@compiled
def _find_acceleration(coin: MujocoCoin) -> None:
    write_smooth_forces(coin, True)
    run(coin, coin.mujoco.mj_fwdAcceleration)


@compiled
def place_body(coin: MujocoCoin, again: bool) -> None:
    """Compute what of MuJoCo's data depends on qpos alone, but for contacts.

    Args:
        coin: MuJoCo's.
        again: whether once more after a motion: the mass matrix of a balanced coin is what it was.
    """
    run(coin, coin.mujoco.mj_kinematics)
    run(coin, coin.mujoco.mj_comPos)
    if not (again and coin.is_balanced):
        run(coin, coin.mujoco.mj_makeM)
        run(coin, coin.mujoco.mj_factorM)
