"""`cointoss fit`: what was seen of a coin to the fields that explain it."""

import sys
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import click

from cointoss.compare.commands.common import (
    SCENARIO_HELP,
    ReadPlace,
    naming_options,
    plain_errors,
    print_json,
)
from cointoss.compare.commands.names import fitted, optional_scenario_argument, varied
from cointoss.compare.commands.options import options_of
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.output.accepted import Form, Within, Written
from cointoss.compare.output.language import option_of
from cointoss.compare.sweep.asked import Source
from cointoss.models.devices import Device

if TYPE_CHECKING:
    from cointoss.compare.fitting.flips import Flips
    from cointoss.compare.fitting.observed import Observed


@dataclass(frozen=True, kw_only=True)
class SoughtValues:
    """The fields whose values are to be found, how, and where they go."""

    vary: Annotated[tuple[str, ...], Form("FIELD=START:STOP")] = ()
    """Field to find, and the range to search; may be given several times; not for flips."""
    sd_time: Annotated[str | None, Form("QUANTITY")] = None
    """Standard deviation of the times of touches, such as '1 ms'; needed without a column sd_t."""
    sd_height: Annotated[str | None, Form("QUANTITY")] = None
    """Standard deviation of heights, such as '2 mm'."""
    sd_attitude: Annotated[str | None, Form("QUANTITY")] = None
    """Standard deviation of tilts and attitudes, such as '2 deg'."""
    starts: Annotated[int, Within(1, 1 << 20)] = 2048
    """Starting points, spread evenly over the ranges; take more for more or wider ranges."""
    hand: Annotated[Path | None, ReadPlace("a hand's file in TOML")] = None
    """For counts: file of the hand that tosses the scenario's coin; its psi is not used."""
    tosses: Annotated[int, Within(1, 10_000_000)] = 1000
    """For counts: tosses of the coin at each of 31 psi."""
    seed: Annotated[int, Within(0, 2**32)] = 0
    """Seed of the starts, or of the tosses."""
    device: Device = Device.CPU
    """Device that computes the tosses; the CPU fits a single toss, so auto is the CPU there."""
    out: Annotated[Path | None, Written((".toml",))] = None
    """Also write the scenario with the values found, or for counts the hand, to this .toml file."""
    png: Annotated[Path | None, Written((".png",))] = None
    """Also draw the fit to this .png file; not for counts."""
    json: bool = False
    """Print JSON, in full precision."""


_OF_A_TOSS = ("vary", "starts", "png")
_OF_COUNTS = ("hand", "tosses")
"""Options that are of use for the one, and not for the other."""


@click.command(
    epilog="OBSERVED.csv has a column t (time) with a row for each touch, or t and z (height) or tilt with a "
    "row for each frame; units in brackets, as in t (ms). Exports of phyphox and of Tracker are read, too. "
    "Counts have a row for each person, and columns same and flips, or heads_to_heads, heads_to_tails, "
    "tails_to_tails and tails_to_heads. " + SCENARIO_HELP
)
@click.argument("observed", metavar="OBSERVED.csv", is_eager=True, type=ReadPlace("a CSV file"))
@optional_scenario_argument
@set_option
@options_of(SoughtValues, completed={"vary": fitted})
@with_scenario
def fit(observed: Path, source: Source | None, asked: SoughtValues) -> None:
    """Find the values of a scenario's fields that explain what was seen of a coin, or that none do.

    OBSERVED.csv has the times of touches, as a microphone hears them, faces up, or heights and attitudes, as
    a film shows them. FIELD is a dotted path into the scenario, such as floor.restitution or
    release.position.z, or its last part; START and STOP are in SI or carry a unit. The FIELD clock is the
    time that your clock shows at the release; without it your clock begins then. All other fields stay as the
    scenario has them.

    The command prints the values with their 99 % intervals, whether this model can do what was seen at all,
    other values that would explain it too, and each touch. Where the model cannot do it, the command prints
    no intervals, and the exit status is 1.

    Counts of flips say how often the side came up that was up at the release. From them the command finds the
    psi of each person's hand, and its scatter over people. Without SCENARIO the coins are caught; with it
    they are tossed onto its floor.
    """
    from cointoss.compare.fitting.flips import Flips
    from cointoss.compare.fitting.table import read_seen

    sd = {"time": asked.sd_time, "height": asked.sd_height, "attitude": asked.sd_attitude}
    given = {name: text for name, text in sd.items() if text is not None}
    options = {f"sd.{name}": (f"--sd-{name}", text) for name, text in given.items()}
    with plain_errors(str(observed)), naming_options(options):
        seen = read_seen(observed, given)
    context = click.get_current_context()
    if isinstance(seen, Flips):
        _refuse_options(_OF_A_TOSS, asked, "only with the times of touches or frames of a film")
        if source is None:
            _refuse_options((*_OF_COUNTS, "device"), asked, "only with a SCENARIO")
        is_possible = _fit_hand(seen, source, asked)
    else:
        _refuse_options(_OF_COUNTS, asked, "only with counts")
        for name, value in (("scenario", source), ("vary", asked.vary)):
            if not value:
                raise click.MissingParameter(
                    ctx=context, param=next(one for one in context.command.params if one.name == name)
                )
        assert source is not None
        is_possible = _fit_toss(seen, source, asked)
    sys.exit(0 if is_possible else 1)


def _refuse_options(names: tuple[str, ...], asked: SoughtValues, accepted: str) -> None:
    """Refuse options of no use, where they are not as by default."""
    for item in fields(asked):
        if item.name in names and (value := getattr(asked, item.name)) != item.default:
            shown = value[0] if isinstance(value, tuple) else value
            raise click.UsageError(f"{option_of(item.name)} {shown}: accepted: {accepted}")


def _fit_hand(flips: "Flips", source: Source | None, asked: SoughtValues) -> bool:
    """Print the hand that explains counts, and return whether one does."""
    from cointoss.compare.fitting import fit as fitting
    from cointoss.compare.fitting.hand_answer import as_lines
    from cointoss.compare.output.files import write_text
    from cointoss.models.hand import load_hand

    found = fitting.fit(
        flips,
        source and source.scenario,
        hand=None if asked.hand is None else load_hand(asked.hand),
        tosses=asked.tosses,
        seed=asked.seed,
        device=asked.device,
    )
    if asked.out is not None and found.is_possible:
        write_text(asked.out, found.hand_toml())
    if asked.json:
        print_json({**found.as_dict(), "seed": asked.seed, "tosses": source and asked.tosses}, "analytic")
    else:
        click.echo(as_lines(found))
        if found.is_possible:
            _echo_files(asked, "hand")
        elif asked.out is not None:
            click.echo(f"\nhand        {asked.out} is not written: no hand explains these counts")
    return found.is_possible


def _fit_toss(seen: "Observed", source: Source, asked: SoughtValues) -> bool:
    """Print the values that explain what was seen of a toss, and return whether any do."""
    from cointoss.compare.output.files import write_bytes, write_text
    from cointoss.models.stages import stage

    with stage("getting ready"):  # what is imported takes long on a busy machine
        from cointoss.compare.fitting.fields import spans_given

        spans_given(varied(asked.vary), source.scenario)
        from cointoss.compare.fitting import fit as fitting
        from cointoss.compare.fitting.answer import as_lines

    found = fitting.fit(
        seen,
        source.scenario,
        varied(asked.vary),
        starts=asked.starts,
        seed=asked.seed,
        device=asked.device,
    )
    if asked.out is not None:
        write_text(asked.out, found.scenario.to_toml())
    if asked.png is not None:
        from cointoss.compare.fitting.picture import draw_fit
        from cointoss.compare.output.plots import picture_bytes

        write_bytes(asked.png, picture_bytes(draw_fit(found)))
    if asked.json:
        print_json({**found.as_dict(), "seed": asked.seed, "starts": asked.starts}, "analytic")
    else:
        click.echo(as_lines(found))
        _echo_files(asked, "scenario")
    return found.is_possible


def _echo_files(asked: SoughtValues, what: str) -> None:
    """Print which files were written."""
    for name, path in ((what, asked.out), ("picture", asked.png)):
        if path is not None:
            click.echo(f"\n{name:11} {path}")
