"""`cointoss flips`: counts of a coin's sides to the wobble of the hand that explains them."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import click

from cointoss.compare.commands.common import SCENARIO_HELP, ReadPlace, plain_errors, print_json
from cointoss.compare.commands.names import optional_scenario_argument
from cointoss.compare.commands.options import options_of
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.output.accepted import Within, Written
from cointoss.compare.sweep.asked import Source
from cointoss.models.devices import Device


@dataclass(frozen=True, kw_only=True)
class SoughtHand:
    """How a hand is found, and where it goes."""

    hand: Annotated[Path | None, ReadPlace("a hand's file in TOML")] = None
    """File of the hand that tosses the scenario's coin; its psi is not used."""
    tosses: Annotated[int, Within(1, 10_000_000)] = 1000
    """Tosses of the scenario's coin at each of 31 psi."""
    seed: Annotated[int, Within(0, 2**32)] = 0
    """Seed of the tosses."""
    device: Device = Device.CPU
    """Device that computes the tosses."""
    out: Annotated[Path | None, Written((".toml",))] = None
    """Also write the hand to this .toml file."""
    json: bool = False
    """Print JSON, in full precision."""


@click.command(
    epilog="COUNTS.csv has a row for each person, and columns same and flips, or heads_to_heads, "
    "heads_to_tails, tails_to_tails and tails_to_heads. " + SCENARIO_HELP
)
@click.argument("counts", metavar="COUNTS.csv", is_eager=True, type=ReadPlace("a CSV file"))
@optional_scenario_argument
@set_option
@options_of(SoughtHand)
@with_scenario
def flips(counts: Path, source: Source | None, asked: SoughtHand) -> None:
    """Find how much people's coins wobble from how often they show the side that was up at first.

    The command prints the psi of each person's hand, and its scatter over people, with 99 % intervals, and
    whether this model can do what was counted at all. Where it cannot, the command prints no intervals, and
    the exit status is 1. Without SCENARIO the coins are caught, and have two equal moments of inertia. With
    it they are tossed onto its floor, or caught where its [ending] says so.
    """
    from cointoss.compare.flips.answer import as_lines
    from cointoss.compare.flips.caught import has_closed_form
    from cointoss.compare.flips.hand_fit import flips as fitted
    from cointoss.compare.output.files import write_text

    options = {name: getattr(asked, name) for name in ("hand", "tosses", "seed", "device")}
    with plain_errors(str(counts)):
        found = fitted(counts, source and source.scenario, **options)
    if asked.out is not None and found.is_possible:
        write_text(asked.out, found.hand_toml())
    if asked.json:
        tosses = None if has_closed_form(found.scenario, asked.hand) else asked.tosses
        print_json({**found.as_dict(), "seed": asked.seed, "tosses": tosses}, "analytic")
    else:
        click.echo(as_lines(found))
        if asked.out is not None:
            so = "" if found.is_possible else " is not written: no hand explains these counts"
            click.echo(f"\nhand        {asked.out}{so}")
    sys.exit(0 if found.is_possible else 1)
