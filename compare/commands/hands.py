"""`cointoss hands`: a coin tossed many times as a hand does."""

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import click

from cointoss.compare.commands.common import (
    SCENARIO_HELP,
    Count,
    engine_option,
    plain_errors,
    print_json,
    refuse,
)
from cointoss.compare.commands.hand_options import chosen_hand, hand_options
from cointoss.compare.commands.names import scenario_argument

if TYPE_CHECKING:
    from cointoss.compare.engines import Engine
    from cointoss.compare.metrics.estimate import Estimate
    from cointoss.models.releases import Releases
    from cointoss.models.scenario import Scenario


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@hand_options
@click.option("--tosses", type=Count(1, 10_000_000), default=1000, show_default=True, help="How many.")
@engine_option
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
def hands(scenario: str, tosses: int, seed: int, engine: str, as_json: bool, **given: Any) -> None:
    """Toss a scenario's coin many times as a hand does, and count the side that was up at first.

    The coin is released flat, or on its edge with --spun; the scenario's own release is not used. The side is
    that at the first touches of the floor and at rest, or that in a hand which catches the coin. Of a coin
    that is spun all ends are counted. Intervals are of 99 %.
    """
    with plain_errors(scenario):
        import numpy as np

        from cointoss.compare.engines import Engine
        from cointoss.compare.film.back_end import require_mujoco
        from cointoss.compare.metrics.estimates import share_of
        from cointoss.compare.shares.counting import counting
        from cointoss.compare.shares.plan import Plan, check
        from cointoss.models.reading import load
        from cointoss.models.records import Outcome
        from cointoss.models.releases import check_releases

        hand, described = chosen_hand(given, load(scenario))
        if engine == Engine.MUJOCO:
            require_mujoco()
        if hand.spun:
            plan = Plan(
                scenario=described, name="", hand=hand, engines=(Engine(engine),), seed=seed, tosses=tosses
            )
            check(plan)
            *_, counts = counting(plan)
            shares = {str(one): share_of(int(met), tosses) for one in Outcome if (met := counts[0][one])}
        else:
            try:
                start = hand.releases(described.body, np.random.default_rng(seed), tosses)
                check_releases(described, start)
            except ValueError as error:
                refuse(f"{scenario}: {error}")
            shares = first_sides(described, start, Engine(engine))
        caught = shares["caught"].count if "caught" in shares else 0
        not_caught = 0 if hand.spun or described.ending.caught is None else tosses - caught
        if as_json:
            told = {"hand": asdict(hand), "caught": described.ending.caught}
            told |= {"tosses": tosses, "seed": seed, "engine": engine, "not_caught": not_caught}
            kind = "ended" if hand.spun else "same_side"
            print_json({**told, kind: {k: asdict(v) for k, v in shares.items()}}, engine)
            return
        for name, one in shares.items():
            click.echo(f"{name:9} {one.value:7.2%} [{one.low:.2%}, {one.high:.2%}] of {one.count:,d} tosses")
        if not_caught:
            click.echo(f"left out  {not_caught:,d} coins that never came down to the hand")


def first_sides(scenario: "Scenario", start: "Releases", engine: "Engine") -> "dict[str, Estimate]":
    """Return how often the side that was up at first is up in the hand, or at the first touches and at rest.

    Args:
        scenario: that is tossed.
        start: the releases.
        engine: that tosses.
    """
    from cointoss.compare.metrics.estimates import share
    from cointoss.compare.metrics.first_side import TOUCHES, caught_side, first_side

    if scenario.ending.caught is not None:
        sides = {"caught": caught_side(scenario, start, engine)}
    else:
        found = first_side(scenario, start, engine)
        sides = {f"touch {n + 1}": up for n, up in zip(TOUCHES, found.touches, strict=True)}
        sides["at rest"] = found.at_rest
    return {name: share(up) for name, up in sides.items() if len(up)}
