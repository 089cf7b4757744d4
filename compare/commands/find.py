"""`cointoss find`: a toss that shows a sequence of faces or an outcome."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import click

from cointoss.compare.commands.common import SCENARIO_HELP, print_json, say
from cointoss.compare.commands.names import fields_in, scenario_argument, varied
from cointoss.compare.commands.options import options_of
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.find.sequence import sequence_of
from cointoss.compare.output.accepted import Form, Within, Written
from cointoss.compare.sweep.asked import Source
from cointoss.models.devices import Device


@dataclass(frozen=True, kw_only=True)
class SoughtToss:
    """What a toss is to show, where it is looked for, and where it goes."""

    vary: Annotated[tuple[str, ...], Form("FIELD=START:STOP")]
    """Field to search, and the range of its values; may be given several times."""
    sequence: Annotated[str, Form("FACES", sequence_of)] = ""
    """Faces up at the first touches, such as HTTH."""
    outcome: Literal["heads", "tails", "edge", "perpetual", "transient", "undecided"] | None = None
    """How the coin is to end."""
    tosses: Annotated[int, Within(1, 1 << 30)] = 1 << 16
    """Most tosses over the window; the search stops earlier where many tosses show it."""
    seed: Annotated[int, Within(0, 2**32)] = 0
    """Seed of the points tossed."""
    device: Device = Device.CPU
    """Device that computes outcomes; the CPU finds the faces."""
    out: Annotated[Path | None, Written((".toml",)), Form("FILE.toml")] = None
    """Write the scenario of the toss to this file; by default it is printed."""
    gltf: Annotated[Path | None, Written((".glb",)), Form("FILE.glb")] = None
    """Also write the toss, until its coin lies still, as an animation of glTF, for Blender or a game."""
    json: bool = False
    """Print JSON, in full precision."""


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@set_option
@options_of(SoughtToss, completed={"vary": fields_in("cointoss.compare.find.fields")})
@with_scenario
def find(source: Source, asked: SoughtToss) -> None:
    """Find a toss that shows a sequence of faces, or ends on its edge.

    A field of --vary may have any value between START and STOP, in SI or with a unit. Other fields stay as in
    the scenario. FIELD is a dotted path into the scenario, such as release.position.z. H and T are the faces
    up at the first, second, ... touch of the floor.

    \b
        cointoss find fig24a --sequence HTTH --vary release.position.z=0.2:0.6 --out htth.toml
        cointoss toss htth.toml

    Of the tosses that show it, the command takes the one farthest from tosses that show something else. A
    margin says how far one field may change alone. The command prints a scenario file, which both engines
    can toss, with the margins in its comments. The exit status is 1 where no toss shows it.
    """
    from cointoss.compare.find.fields import spans
    from cointoss.compare.output.files import write_text

    if not (asked.sequence or asked.outcome):
        raise click.UsageError("--sequence, --outcome: none; accepted: one of them, or both")
    spans(varied(asked.vary), source.scenario)
    from cointoss.compare.find import find as finding

    found = finding.find_telling(
        say,
        source.scenario,
        varied(asked.vary),
        sequence=asked.sequence,
        outcome=asked.outcome,
        tosses=asked.tosses,
        seed=asked.seed,
        device=asked.device,
    )
    if asked.device != Device.CPU:
        say(f"tossed by {found.target.processor.in_words}")
    if asked.out is not None and found:
        write_text(asked.out, found.to_toml())
    if asked.gltf is not None and found.toss is not None:
        from cointoss.compare.film.gltf import write_gltf

        write_gltf(asked.gltf, found.toss)
    if asked.json:
        print_json({"scenario": source.name, "seed": asked.seed, **found.as_json()}, "analytic")
    elif found and asked.out is None:
        click.echo(found.to_toml(), nl=False)
    else:
        click.echo("\n".join([*found.lines, *([f"scenario: {asked.out}"] if found else [])]))
    sys.exit(0 if found else 1)
