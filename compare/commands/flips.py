"""`cointoss flips`: counts of a coin's sides to its fairness, its mass centre, or the wobble of a hand."""

import math
import sys
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated

import click

from cointoss.compare.commands.common import SCENARIO_HELP, ReadPlace, plain_errors, print_json
from cointoss.compare.commands.names import optional_scenario_argument
from cointoss.compare.commands.options import Typed, only_with, options_of
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.output.accepted import Within, Written
from cointoss.compare.sweep.asked import Source
from cointoss.models.devices import Device


@dataclass(frozen=True, kw_only=True)
class SoughtHand:
    """How a hand is found, and where it goes."""

    heads: Annotated[int | None, Within(0, 1_000_000_000)] = None
    """Flips that showed heads, instead of COUNTS.csv."""
    tails: Annotated[int | None, Within(0, 1_000_000_000)] = None
    """Flips that showed tails."""
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


def _counted_once(given: Typed) -> str | None:
    """Return what is wrong where counts are neither in a file nor typed, or both."""
    counts = click.get_current_context().params["counts"]
    if (counts is None) == ("heads" in given):
        return None
    return (
        f"COUNTS.csv: {counts or 'missing'}; accepted: "
        "a CSV file with counts of flips, or --heads and --tails"
    )


@click.command(
    epilog="COUNTS.csv has a row for each person or coin, and columns heads and tails; same and flips; or "
    "heads_to_heads, heads_to_tails, tails_to_tails and tails_to_heads. Or it has the sides of one coin's "
    "flips, as HTTH or 0110, where 1 is heads. " + SCENARIO_HELP
)
@click.argument("counts", metavar="[COUNTS.csv]", required=False, is_eager=True, type=ReadPlace("a CSV file"))
@optional_scenario_argument
@set_option
@options_of(SoughtHand, only_with("heads", "tails"), only_with("tails", "heads"), _counted_once)
@with_scenario
def flips(counts: Path | None, source: Source | None, asked: SoughtHand) -> None:
    """Say whether a coin is fair, and how much a hand wobbles, from counts of flips.

    Of heads and tails the command prints the share of heads, and whether a fair coin can do this; with
    SCENARIO also the offset of its mass centre that explains it, for a hand that tosses or spins.

    Where the side that was up at first is known, it prints the psi of each person's hand, and its scatter
    over people. Without SCENARIO the coins are caught, and have two equal moments of inertia. With it they
    are tossed onto its floor, or caught where its [ending] says so.

    Intervals are of 99 %. Where the model cannot do what was counted, there are none, and the exit status
    is 1; a coin that is not fair is no reason for this.
    """
    from cointoss.compare.flips.answer import as_lines, sides_as_lines
    from cointoss.compare.flips.caught import has_closed_form
    from cointoss.compare.flips.hand_fit import HandFit
    from cointoss.compare.flips.hand_fit import flips as fitted
    from cointoss.compare.flips.offset import offset
    from cointoss.compare.flips.sides import Sides, together
    from cointoss.compare.flips.table import Table, read_table
    from cointoss.compare.metrics.estimate import Estimate
    from cointoss.compare.output.files import write_text
    from cointoss.compare.sweep.errors import SweepError
    from cointoss.models.hand import load_hand

    options = {name: getattr(asked, name) for name in ("hand", "tosses", "seed", "device")}
    found = None
    with plain_errors(str(counts or "cointoss")):
        table = (
            Table(None, {"1": Sides(heads=asked.heads or 0, tails=asked.tails or 0)})
            if counts is None
            else read_table(counts)
        )
        is_offset = source and table.sides and asked.hand is not None and load_hand(asked.hand).spun
        if table.flips and not is_offset:
            found = fitted(table.flips, source and source.scenario, **options)
        elif asked.out or (
            not source and (asked.hand, asked.tosses, asked.device) != (None, 1000, Device.CPU)
        ):
            raise SweepError(
                "`hand`, `tosses`, `device` and `out`: accepted: only with a SCENARIO, and `out` only "
                "with the side at the release"
            )
        elif source:
            found = offset(together(table.sides.values()), source.scenario, **options)
    hand = found if isinstance(found, HandFit) else None
    if asked.out is not None and hand and hand.is_possible:
        write_text(asked.out, hand.hand_toml())
    if asked.json:
        is_tossed = source and not (hand and has_closed_form(source.scenario, asked.hand))
        answer = {
            "sides": {name: one.as_dict() for name, one in table.sides.items()},
            **(hand.as_dict() if hand else {"offset": found and asdict(found)}),
            "seed": asked.seed,
            "tosses": asked.tosses if is_tossed else None,
        }
        print_json(answer, "analytic")
    else:
        shown = (sides_as_lines(table.sides) if table.sides else "", as_lines(found) if found else "")
        click.echo("\n\n".join(filter(None, shown)))
        if asked.out is not None and hand:
            so = "" if hand.is_possible else " is not written: no hand explains these counts"
            click.echo(f"\nhand        {asked.out}{so}")
    is_explained = hand.is_possible if hand else not (isinstance(found, Estimate) and math.isnan(found.low))
    sys.exit(0 if is_explained else 1)
