"""Many tosses of MuJoCo's coin by one thread."""

import numpy as np

from cointoss.coin_mj.events import toss_coin
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.settings import Budgets
from cointoss.coin_mj.model.state import put_at
from cointoss.models.body import Rules
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import IMPACT_ROW
from cointoss.models.tiles import Tile


@compiled
def toss_tile(coin: MujocoCoin, plastic: MujocoCoin, rules: Rules, budgets: Budgets, tile: Tile) -> None:
    """Toss a coin from each start of a tile; see `toss_coin`."""
    rows = np.zeros(1, IMPACT_ROW)
    for i in range(len(tile.states)):
        put_at(coin, tile.states[i])
        n, _, _, _, outcome, ending, end_time = toss_coin(coin, plastic, rules, budgets, rows, False)
        tile.outcome[i], tile.ending[i], tile.impacts[i] = outcome.value, ending.value, n
        tile.end_time[i] = end_time
        tile.last_face[i] = rows[0]["face"] if n > 0 else 0
