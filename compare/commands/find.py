"""`cointoss find`: a toss that shows a sequence of faces or an outcome."""

import sys
from pathlib import Path

import click

from cointoss.compare.commands.common import SCENARIO_HELP, CountType, Place, plain_errors, print_json
from cointoss.compare.commands.names import scenario_argument, varied, vary_option


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@vary_option
@click.option("--sequence", default="", metavar="FACES", help="Faces up at the first touches, such as HTTH.")
@click.option(
    "--outcome",
    type=click.Choice(["heads", "tails", "edge", "perpetual", "transient", "undecided"]),
    help="How the coin is to end.",
)
@click.option(
    "--tosses",
    type=CountType(1, 1 << 30),
    default=1 << 16,
    show_default=True,
    help="Over the window, at most; fewer where many show it.",
)
@click.option("--seed", type=CountType(0, 2**32), default=0, show_default=True, help="Of the points tossed.")
@click.option(
    "--out",
    type=Place(),
    metavar="FILE.toml",
    help="Write the scenario of the toss; without it, it is printed.",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, in full precision.")
def find(
    scenario: str,
    vary: tuple[str, ...],
    sequence: str,
    outcome: str | None,
    tosses: int,
    seed: int,
    out: Path | None,
    as_json: bool,
) -> None:
    """Find a toss that shows a sequence of faces, or ends on its edge.

    The fields of --vary may have any value between START and STOP, in SI or with a unit; all else is as the
    scenario says. FIELD is a dotted path into the scenario, such as release.position.z. H and T are the faces
    up at the first, second, ... touch of the floor.

    \b
        cointoss find fig24a --sequence HTTH --vary release.position.z=0.2:0.6 --out htth.toml
        cointoss toss htth.toml

    Of the tosses found it is the one farthest from others that show something else: its margins say how far
    each field may change alone. What is printed is a scenario file that both engines toss, with what was
    found in its comments. The exit status is 1 where no toss shows it.
    """
    with plain_errors(scenario):
        from cointoss.compare.find import find as finding
        from cointoss.compare.output.files import require_file, write_text
        from cointoss.models.reading import load

        if not (sequence or outcome):
            raise click.UsageError("--sequence, --outcome: none; accepted: one of them, or both")
        described = load(scenario)
        if out is not None:
            require_file(out, ".toml", scenario)
        found = finding.find(
            described, varied(vary), sequence=sequence, outcome=outcome, tosses=tosses, seed=seed
        )
        if out is not None and found:
            write_text(out, found.to_toml())
        if as_json:
            print_json({"scenario": scenario, "seed": seed, **found.as_json()}, "analytic")
        elif found and out is None:
            click.echo(found.to_toml(), nl=False)
        else:
            click.echo("\n".join([*found.lines, *([f"scenario: {out}"] if found else [])]))
    sys.exit(0 if found else 1)
