"""Many tosses in MuJoCo, on all cores."""

import threading

from cointoss.coin_mj.entries import toss_tile
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.settings import MANY, Settings
from cointoss.coin_mj.toss import require_supported, warn_of_approximation
from cointoss.models.errors import require_type
from cointoss.models.outcomes import Outcomes
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import UnsupportedError
from cointoss.models.releases import Releases, check_releases
from cointoss.models.stages import stage
from cointoss.models.tiles import Tile, toss_in_tiles

TILE = 8
"""Most tosses that a thread makes at a time."""


def toss_many(
    scenario: ScenarioSource,
    releases: Releases,
    *,
    settings: Settings = MANY,
    horizon: bool = False,
    certain: bool = False,
    progress: bool | None = None,
) -> Outcomes:
    """Toss the coin once from each release, by the event loop of `toss`.

    Each toss is that of `toss` with the same settings, to the bit. By default they are coarser than those of
    one toss: docs/MUJOCO.md says what error they give.

    Args:
        scenario: what to toss, or its path or name; its own release is not used.
        releases: the states at time 0.
        settings: how MuJoCo realises the floor, and how finely it steps.
        horizon: whether to find how many impacts can be trusted; this engine does so for `toss` alone.
        certain: whether to find which outcomes are certain; this engine does not.
        progress: True shows how far it is on standard error wherever that leads, and lets Ctrl-C return the
            tosses that were made by then, with a warning: the others are undecided, with the ending none (see
            `Outcomes.is_done`). False shows nothing; None shows it in a terminal or a notebook.

    Returns:
        How each toss ended, in the order of `releases`. The paths are not kept.

    Raises:
        UnsupportedError: as `toss`; and for a horizon or for certainty.
        ValueError: for a release that a scenario with this coin and air would refuse.

    Warns:
        ApproximationWarning: as `toss`.
    """
    require_type("settings", settings, Settings, "coin_mj.Settings, such as coin_mj.MANY")
    require_type("horizon", horizon, bool, "True or False")
    require_type("certain", certain, bool, "True or False")
    described = scenario_of(scenario)
    require_supported(described, settings=settings)
    if horizon:
        raise UnsupportedError("horizon = True: accepted by the MuJoCo engine: False, or one toss at a time")
    if certain:
        raise UnsupportedError("certain = True: accepted by the MuJoCo engine: False")
    warn_of_approximation(described)
    check_releases(described, releases)
    of_thread, rules = threading.local(), described.rules

    def toss_some(tile: Tile) -> None:
        if not hasattr(of_thread, "machine"):
            of_thread.machine = machine_of(described, settings)
        toss_tile(of_thread.machine.coin, of_thread.machine.plastic, rules, settings.budgets, tile)

    with stage("tossing by MuJoCo", "tosses", shown=progress) as tell:
        return toss_in_tiles(releases, TILE, toss_some, tell, partial=progress is True)
