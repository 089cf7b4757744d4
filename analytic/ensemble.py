"""Many tosses by the analytic engine, on all cores."""

from cointoss.analytic.entries import toss_tile, trust_tile
from cointoss.analytic.horizon.horizon import ErrorsMade
from cointoss.analytic.impact.own_law import OwnLaw, rules_by
from cointoss.analytic.settings import MANY, Settings, contact_limits
from cointoss.models.errors import require_type
from cointoss.models.outcomes import Outcomes
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.releases import Releases, check_releases
from cointoss.models.scenario import keeping_all
from cointoss.models.stages import stage
from cointoss.models.tiles import toss_in_tiles

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
                lambda tile: trust_tile(body, rules, limits, made, certain, tile),
                tell,
                partial=progress is True,
                also=["trusted_impacts", *["outcome_certain"] * certain],
            )
        return toss_in_tiles(
            releases, most, lambda tile: toss_tile(body, rules, limits, tile), tell, partial=progress is True
        )
