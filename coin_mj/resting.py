"""Where MuJoCo's coins come to rest."""

from cointoss.coin_mj.entries import rest_each
from cointoss.coin_mj.model.settings import MANY, MujocoSettings
from cointoss.coin_mj.on_machines import on_machines
from cointoss.models.kernel.arrays import Array
from cointoss.models.rests import with_errors

SOFTER, NEAR = 10.0, 1e-5
"""The factor by which the contacts of a neighbour of a toss are softer, which makes their error three times
as large, or their one step longer; and by which it is released faster and higher, relative, as the steps of
a sustained contact may err."""


def rest_rows(rows: Array, *, settings: MujocoSettings = MANY, workers: int | None = None) -> Array:
    """Return where the coins of many scenarios come to rest, by the columns of `REST`, (n, 7).

    Each toss is made and followed twice: the second time for an estimate of the
    error, by `SOFTER` contacts and a release changed by `NEAR`.

    Args:
        rows: as of `toss_rows`.
        settings: how MuJoCo realises the floor, and how finely it steps.
        workers: number of threads, by default one for each core.
    """

    def follow(rows: Array, rests: Array, is_near: bool) -> None:
        on_machines(rows, settings, workers, rests, rest_each, SOFTER if is_near else 1.0)

    return with_errors(rows, follow, NEAR)
