"""`cointoss hands`: a coin tossed many times as a hand does."""

import json
from dataclasses import asdict

import click

from cointoss.compare.commands.common import (
    SCENARIO_HELP,
    Count,
    Given,
    Quantity,
    engine_option,
    naming_options,
    plain_errors,
    refuse,
)
from cointoss.compare.commands.names import scenario_argument


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@click.option("--height", type=Quantity("m"), default="1 m", show_default=True, help="Of the release.")
@click.option("--speed", type=Quantity("m/s"), default="2 m/s", show_default=True, help="Upwards.")
@click.option(
    "--spin",
    type=Quantity("rad/s"),
    default="120 rad/s",
    show_default=True,
    help="Rate at which the coin's normal goes round the angular momentum.",
)
@click.option(
    "--psi",
    type=Quantity("rad"),
    default="90 deg",
    show_default=True,
    help="Angle between normal and angular momentum; less than 90 deg: the coin wobbles.",
)
@click.option("--psi-scatter", type=Quantity("rad"), default="0 deg", show_default=True, help="Its scatter.")
@click.option(
    "--scatter",
    type=Quantity(""),
    default="10 %",
    show_default=True,
    help="Standard deviation of height, speed and spin.",
)
@click.option(
    "--caught",
    type=Quantity("m"),
    help="Height at which a hand catches the coin; by default the scenario's [ending] caught, if it has one.",
)
@click.option("--tosses", type=Count(1, 10_000_000), default=1000, show_default=True, help="How many.")
@click.option("--seed", type=Count(0, 2**32), default=0, show_default=True, help="Of the releases.")
@engine_option
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
def hands(
    scenario: str,
    caught: Given | None,
    tosses: int,
    seed: int,
    engine: str,
    as_json: bool,
    **given: Given,
) -> None:
    """Toss a scenario's coin many times as a hand does, and count the side that was up at first.

    The coin is released flat; the scenario's own release is not used. The side is that at the first touches
    of the floor and at rest, or that in a hand which catches the coin. Intervals are of 99 %.
    """
    with plain_errors(scenario):
        import numpy as np

        from cointoss.compare.engines import Engine
        from cointoss.compare.film.back_end import require_mujoco
        from cointoss.compare.metrics.estimates import share
        from cointoss.compare.metrics.first_side import TOUCHES, caught_side, first_side
        from cointoss.models.errors import ScenarioError
        from cointoss.models.hand import Hand
        from cointoss.models.reading import load
        from cointoss.models.releases import check_releases

        described = load(scenario)
        hand = {name: number.value for name, number in given.items()}
        if caught is not None:
            try:
                described = described.replace("ending.caught", caught.value)
            except ScenarioError as error:
                refuse(f"--caught {caught}: accepted: {str(error).partition('accepted: ')[2]}")
        if engine == Engine.MUJOCO:
            require_mujoco()
        with naming_options(
            {name: (f"--{name.replace('_', '-')}", number) for name, number in given.items()}
        ):
            chosen = Hand(**hand)
        try:
            start = chosen.releases(described.body, np.random.default_rng(seed), tosses)
            check_releases(described, start)
        except ValueError as error:
            refuse(f"{scenario}: {error}")
        if described.ending.caught is not None:
            counted = {"caught": caught_side(described, start, Engine(engine))}
        else:
            found = first_side(described, start, Engine(engine))
            counted = {f"touch {n + 1}": up for n, up in zip(TOUCHES, found.touches, strict=True)}
            counted["at rest"] = found.at_rest
        shares = {name: share(up) for name, up in counted.items() if len(up)}
        if as_json:
            told = {"hand": hand, "caught": described.ending.caught}
            told |= {"tosses": tosses, "seed": seed, "engine": engine}
            click.echo(json.dumps({**told, "same_side": {k: asdict(v) for k, v in shares.items()}}, indent=1))
            return
        for name, one in shares.items():
            click.echo(f"{name:9} {one.value:7.2%} [{one.low:.2%}, {one.high:.2%}] of {one.count:,d} tosses")
        if not len(counted.get("caught", [True])):
            click.echo(f"none of {tosses:,d} tosses was caught")
