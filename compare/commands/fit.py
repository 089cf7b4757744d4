"""`cointoss fit`: what was seen of a coin to the fields that explain it."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import click

from cointoss.compare.commands.common import (
    SCENARIO_HELP,
    ReadPlace,
    naming_options,
    plain_errors,
    print_json,
)
from cointoss.compare.commands.names import fields_in, optional_scenario_argument, varied
from cointoss.compare.commands.options import options_of
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.output.accepted import Form, Within, Written
from cointoss.compare.sweep.asked import Source
from cointoss.models.devices import Device


@dataclass(frozen=True, kw_only=True)
class SoughtValues:
    """The fields whose values are to be found, how, and where they go."""

    vary: Annotated[tuple[str, ...], Form("FIELD=START:STOP")] = ()
    """Field to find, and the range to search; may be given several times."""
    sd_time: Annotated[str | None, Form("QUANTITY")] = None
    """Standard deviation of the times of touches, such as '1 ms'; needed without a column sd_t."""
    sd_height: Annotated[str | None, Form("QUANTITY")] = None
    """Standard deviation of heights, such as '2 mm'."""
    sd_attitude: Annotated[str | None, Form("QUANTITY")] = None
    """Standard deviation of tilts and attitudes, such as '2 deg'."""
    starts: Annotated[int, Within(1, 1 << 20)] = 2048
    """Starting points, spread evenly over the ranges; take more for more or wider ranges."""
    seed: Annotated[int, Within(0, 2**32)] = 0
    """Seed of the starts."""
    device: Device = Device.CPU
    """Device that computes the tosses; auto is the CPU, which fits a single toss."""
    out: Annotated[Path | None, Written((".toml",))] = None
    """Also write the scenario with the values found to this .toml file."""
    png: Annotated[Path | None, Written((".png",))] = None
    """Also draw the fit to this .png file."""
    json: bool = False
    """Print JSON, in full precision."""


@click.command(
    epilog="OBSERVED.csv has a column t (time) with a row for each touch, or t and z (height) or tilt with a "
    "row for each frame; units in brackets, as in t (ms). Exports of phyphox and of Tracker are read, too. "
    + SCENARIO_HELP
)
@click.argument("observed", metavar="OBSERVED.csv", is_eager=True, type=ReadPlace("a CSV file"))
@optional_scenario_argument
@set_option
@options_of(SoughtValues, completed={"vary": fields_in("cointoss.compare.fitting.fields")})
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
    """
    from cointoss.compare.fitting.fields import spans_given
    from cointoss.compare.fitting.table import read_seen
    from cointoss.compare.output.files import write_bytes, write_text
    from cointoss.models.stages import stage

    sd = {"time": asked.sd_time, "height": asked.sd_height, "attitude": asked.sd_attitude}
    given = {name: text for name, text in sd.items() if text is not None}
    options = {f"sd.{name}": (f"--sd-{name}", text) for name, text in given.items()}
    with plain_errors(str(observed)), naming_options(options):
        seen = read_seen(observed, given)
    context = click.get_current_context()
    for name, value in (("scenario", source), ("vary", asked.vary)):
        if not value:
            raise click.MissingParameter(
                ctx=context, param=next(one for one in context.command.params if one.name == name)
            )
    assert source is not None
    with stage("getting ready"):  # what is imported takes long on a busy machine
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
        from cointoss.compare.fitting.figure import draw_fit
        from cointoss.compare.output.plots import picture_bytes

        write_bytes(asked.png, picture_bytes(draw_fit(found)))
    if asked.json:
        print_json({**found.as_dict(), "seed": asked.seed, "starts": asked.starts}, "analytic")
    else:
        click.echo(as_lines(found))
        for name, path in (("scenario", asked.out), ("picture", asked.png)):
            if path is not None:
                click.echo(f"\n{name:11} {path}")
    sys.exit(0 if found.is_possible else 1)
