"""Work on the rows of many scenarios, on all cores, each on MuJoCo's coin of its own."""

import threading
from collections.abc import Callable

import numpy as np

from cointoss.coin_mj.model.machine import Machine, machine_of
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.settings import Budgets, MujocoSettings
from cointoss.models.batch import PLACE, scenario_of_row
from cointoss.models.kernel.arrays import Array
from cointoss.models.tiles import in_tiles

TILE = 8
"""The most tosses that a thread makes at a time."""
_OF_MACHINE = PLACE["release.position.x"]
"""What is before it in a row, MuJoCo's model is made of."""


def on_machines(
    rows: Array,
    settings: MujocoSettings,
    workers: int | None,
    found: Array,
    work: Callable[[MujocoCoin, MujocoCoin, Budgets, Array, Array], None],
    softer: float = 1.0,
) -> None:
    """Do work on rows, those of one coin on its machine.

    Args:
        rows: of the scenarios, (n, m).
        settings: of the machines.
        workers: number of threads, by default one for each core.
        found: what is found of each row, (n, k); written to as it comes.
        work: writes what is found of some rows of one coin into a table of their own; takes MuJoCo's coin,
            the same for plastic touches, the budgets, the rows and the table.
        softer: the part by which the contacts are softened, see `MujocoSettings.softened`.
    """
    # NaN, for a field that is left out, counts as equal to itself here.
    _, coins = np.unique(np.nan_to_num(rows[:, :_OF_MACHINE], nan=np.inf), axis=0, return_inverse=True)
    order, of_thread = np.argsort(coins, kind="stable"), threading.local()

    def machine(row: int) -> Machine:
        """Return the coin of a row, made again where this thread tossed another one before."""
        if getattr(of_thread, "coin", None) != coins[row]:
            of_thread.coin, of_thread.machine = (
                coins[row],
                (machine_of(scenario_of_row(rows[row]), settings, softer=softer)),
            )
        return of_thread.machine

    def work_on(part: slice) -> None:
        mine = order[part]
        for some in np.split(mine, np.flatnonzero(np.diff(coins[mine])) + 1):
            made, written = machine(some[0]), found[some]
            work(made.coin, made.plastic, made.settings.budgets, rows[some], written)
            found[some] = written

    in_tiles(len(rows), TILE, work_on, workers)
