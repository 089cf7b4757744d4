"""The rebound of a touch whose restitution depends on its speed of approach."""

import math

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.settings import LEAST_SPRING, Rebound
from cointoss.models.body import Rules
from cointoss.models.kernel.compiled import compiled
from cointoss.models.restitution import elastic_restitution, varies
from cointoss.models.spring import damping_ratio_of

_PLACE = MujocoCoin._fields.index("rebound")
_AFTER = _PLACE + 1


@compiled
def coin_touching(coin: MujocoCoin, rules: Rules, speed: float) -> MujocoCoin:
    """Return the coin with the rebound of a touch at a speed above the threshold [m/s].

    A restitution below `LEAST_SPRING` is realised as that.
    """
    if not varies(rules):
        return coin
    chi = max(elastic_restitution(rules, speed), LEAST_SPRING)
    rebound = rebound_with(coin.rebound, coin.has_one_step, chi)
    return MujocoCoin(*coin[:_PLACE], rebound, *coin[_AFTER:])  # pyright: ignore[reportCallIssue]


@compiled
def rebound_with(rebound: Rebound, has_one_step: bool, chi: float) -> Rebound:
    """Return a rebound of the same length with another restitution χ > 0: only its damping changes."""
    damping = (1 + chi) / rebound.step
    if not has_one_step:
        damping = 2 * damping_ratio_of(chi) * math.sqrt(rebound.stiffness)
    slip_damping = damping if rebound.slip_damping == rebound.damping else rebound.slip_damping
    return Rebound(rebound.stiffness, damping, slip_damping, rebound.step, rebound.duration)
