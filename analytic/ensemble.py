"""Many tosses by the analytic engine, on all cores."""

import numpy as np

from cointoss.analytic.events import Verdict, started_of, toss_coin
from cointoss.analytic.horizon.certainty import certainty_of
from cointoss.analytic.horizon.horizon import ErrorsMade, find_horizon
from cointoss.analytic.impact.own_law import OwnLaw, rules_by
from cointoss.analytic.settings import MANY, ContactLimits, Settings, contact_limits
from cointoss.models.body import Body, Rules
from cointoss.models.errors import require_type
from cointoss.models.impact_row import FIRST_ROOM
from cointoss.models.kernel.compiled import compiled
from cointoss.models.outcomes import Outcomes
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import IMPACT_ROW
from cointoss.models.releases import Releases, check_releases
from cointoss.models.scenario import keeping_all
from cointoss.models.stages import stage
from cointoss.models.tiles import Tile, toss_in_tiles

TILE, SLOW_TILE = 512, 8
"""Most tosses that a thread makes at a time, in air with b > 0 the second."""


def toss_many(
    scenario: ScenarioSource,
    releases: Releases,
    *,
    settings: Settings = MANY,
    horizon: bool = False,
    certain: bool = False,
    progress: bool | None = None,
    law: OwnLaw | None = None,
) -> Outcomes:
    """Toss the coin once from each release, by the event loop of `toss`: each toss is the same to the bit.

    Args:
        scenario: what to toss, or its path or name; its own release is not used.
        releases: the states at time 0.
        settings: of the engine.
        horizon: whether to find how many impacts of each toss can be trusted, as `toss` does; tosses take
            two to three times as long.
        certain: whether to find that, and whether the outcome of each toss is certain, as `toss` does; tosses
            take two to seven times as long.
        progress: True shows how far it is on standard error wherever that leads, and lets Ctrl-C return the
            tosses that were made by then, with a warning: the others are undecided, with the ending none (see
            `Outcomes.is_done`). False shows nothing; None shows it in a terminal or a notebook.
        law: a contact law of one's own, in place of the scenario's.

    Returns:
        How each toss ended, in the order of `releases`. The paths are not kept.

    Raises:
        ValueError: for a release that a scenario with this coin and air would refuse.
        ScenarioError: for more impacts than can be kept, with `horizon` or `certain`.
        UnsupportedError: for a floor that a law of one's own can't be used with.
    """
    require_type("settings", settings, Settings, "analytic.Settings, such as analytic.MANY")
    require_type("horizon", horizon, bool, "True or False")
    require_type("certain", certain, bool, "True or False")
    described = scenario_of(scenario)
    check_releases(described, releases)
    body, rules = described.body, rules_by(law, described)
    limits = contact_limits(settings)
    most = TILE if body.air.exponent is None else SLOW_TILE
    with stage("tossing by the analytic engine", "tosses", shown=progress) as tell:
        if horizon or certain:
            made, rules = ErrorsMade(), keeping_all(rules, described)
            return toss_in_tiles(
                releases,
                most,
                lambda tile: _trust_each(body, rules, limits, made, certain, tile),
                tell,
                partial=progress is True,
                also=["trusted_impacts", *["outcome_certain"] * certain],
            )
        return toss_in_tiles(
            releases, most, lambda tile: _toss_each(body, rules, limits, tile), tell, partial=progress is True
        )


@compiled
def _toss_each(body: Body, rules: Rules, limits: ContactLimits, tile: Tile) -> None:
    # Two rows: the last impact's, and the work space after it.
    rows = np.zeros(2, IMPACT_ROW)
    for i in range(len(tile.states)):
        n, _, _, outcome, ending, end_time = toss_coin(body, rules, limits, tile.states[i], rows, False)
        tile.outcome[i], tile.ending[i], tile.impacts[i] = outcome.value, ending.value, n
        tile.end_time[i] = end_time
        tile.last_face[i] = rows[(n - 1) % 2]["face"] if n > 0 else 0


@compiled
def _trust_each(
    body: Body, rules: Rules, limits: ContactLimits, made: ErrorsMade, certain: bool, tile: Tile
) -> None:
    room = np.zeros(FIRST_ROOM, IMPACT_ROW)
    for i in range(len(tile.states)):
        n, rows, pieces, outcome, ending, end_time = toss_coin(
            body, rules, limits, tile.states[i], room, True
        )
        tile.outcome[i], tile.ending[i], tile.impacts[i] = outcome.value, ending.value, n
        tile.end_time[i] = end_time
        tile.last_face[i] = rows[n - 1]["face"] if n > 0 else 0
        started, rows = started_of(pieces), rows[:n]
        found = find_horizon(body, rules, rows, started, made)
        tile.trusted_impacts[i] = found.impacts
        if certain:
            verdict = Verdict(outcome, ending)
            tile.outcome_certain[i] = certainty_of(body, rules, rows, started, verdict, found).certain
