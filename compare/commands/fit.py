"""`cointoss fit`: what was seen of a coin to the fields that explain it."""

import sys
from pathlib import Path

import click

from cointoss.compare.commands.common import (
    SCENARIO_HELP,
    CountType,
    Place,
    naming_options,
    plain_errors,
    print_json,
)
from cointoss.compare.commands.names import scenario_argument, span_option, varied


@click.command(
    epilog="OBSERVED.csv has a column t (time) with a row for each touch, or t and z (height) or tilt with a "
    "row for each frame; units in brackets, as in t (ms). Exports of phyphox and of Tracker are read, too. "
    + SCENARIO_HELP
)
@click.argument("observed", metavar="OBSERVED.csv", type=Place())
@scenario_argument
@span_option("--vary", "A field to be found, and where it is looked for; may be given several times.")
@click.option(
    "--sd-time",
    metavar="QUANTITY",
    help="Standard deviation of the times of touches, such as '1 ms'; needed without a column sd_t.",
)
@click.option("--sd-height", metavar="QUANTITY", help="Likewise of heights, such as '2 mm'.")
@click.option("--sd-attitude", metavar="QUANTITY", help="Likewise of tilts and attitudes, such as '2 deg'.")
@click.option(
    "--starts",
    type=CountType(1, 1 << 20),
    default=2048,
    show_default=True,
    help="Values that are tried first, spread evenly over the spans; more for more or wider ones.",
)
@click.option("--seed", type=CountType(0, 2**32), default=0, show_default=True, help="Of the starts.")
@click.option("--out", type=Place(), help="Also write the scenario with the values found to this .toml file.")
@click.option("--png", type=Place(), help="Also draw the fit to this .png file.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
def fit(
    observed: Path,
    scenario: str,
    vary: tuple[str, ...],
    sd_time: str | None,
    sd_height: str | None,
    sd_attitude: str | None,
    starts: int,
    seed: int,
    out: Path | None,
    png: Path | None,
    as_json: bool,
) -> None:
    """Find the values of a scenario's fields that explain what was seen of a coin, or that none do.

    Seen are the times of its touches, as a microphone hears them, faces up, or heights and attitudes, as a
    film shows them. FIELD is a dotted path into the scenario, such as floor.restitution or
    release.position.z, or its last part; START and STOP are in SI or carry a unit. The FIELD clock is the
    time that your clock shows at the release; without it your clock begins then. All other fields stay as the
    scenario has them.

    Printed are the values with their 99 % intervals, whether this model can do what was seen at all, other
    values that would explain it too, and each touch. Where it cannot, there are no intervals, and the exit
    status is 1.
    """
    with plain_errors(scenario):
        from cointoss.compare.fitting.table import read_observed
        from cointoss.compare.output.files import require_file, write_text, written_whole
        from cointoss.models.reading import load
        from cointoss.models.stages import stage

        described = load(scenario)
        for path, suffix in ((out, ".toml"), (png, ".png")):
            if path is not None:
                require_file(path, suffix, scenario, observed)
        sd = {"time": sd_time, "height": sd_height, "attitude": sd_attitude}
        given = {name: text for name, text in sd.items() if text is not None}
        options = {f"sd.{name}": (f"--sd-{name}", text) for name, text in given.items()}
        with plain_errors(str(observed)), naming_options(options):
            seen = read_observed(observed, given)
        with stage("getting ready"):  # what is imported takes long on a busy machine
            from cointoss.compare.fitting import fit as fitting
            from cointoss.compare.fitting.answer import as_lines

        found = fitting.fit(seen, described, varied(vary), starts=starts, seed=seed)
        if out is not None:
            write_text(out, found.scenario.to_toml())
        if png is not None:
            from cointoss.compare.fitting.picture import draw_fit

            with written_whole(png) as aside:
                draw_fit(found).savefig(aside, dpi=150, format="png")
        if as_json:
            print_json({**found.as_dict(), "seed": seed, "starts": starts}, "analytic")
        else:
            click.echo(as_lines(found))
            for name, path in (("scenario", out), ("picture", png)):
                if path is not None:
                    click.echo(f"\n{name:11} {path}")
    sys.exit(0 if found.is_possible else 1)
