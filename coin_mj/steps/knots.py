"""Knots of the path of MuJoCo's coin: the states before its steps."""

from enum import IntEnum

from cointoss.coin_mj.model.memory import numbers_at
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.state import motion_of
from cointoss.models.kernel.compiled import compiled

Knot = tuple[
    float, float, float, float, float, float, float, float, float, float, float, float, float, float, float
]
"""Time, `Step`, qpos and qvel."""


class Step(IntEnum):
    """What kind of step starts at a knot."""

    FLIGHT = 0
    IMPACT = 1
    CONTACT = 2
    """Of a sustained contact."""


@compiled
def add_knot(coin: MujocoCoin, time: float, step: Step, knots: list[Knot]) -> None:
    """Add the present state to the path, and set MuJoCo's time.

    Args:
        coin: MuJoCo's.
        time: now [s].
        step: the `Step` that starts there.
        knots: the path so far, (time, step, qpos, qvel) each; empty where the path is not kept.
    """
    numbers_at(coin.address.time, (1,))[0] = time
    if len(knots) > 0:
        knots.append(knot_of(coin, time, step))


@compiled
def knot_of(coin: MujocoCoin, time: float, step: Step) -> Knot:
    """Return the present state as a knot, (15,); see `add_knot`."""
    when = (time, float(step.value))
    return when + motion_of(coin)
