"""`cointoss toss`: one toss, printed."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal

import click

from cointoss.compare.commands.common import SCENARIO_HELP, print_json
from cointoss.compare.commands.names import scenario_argument
from cointoss.compare.commands.options import only_with, options_of, without
from cointoss.compare.commands.served import open_page
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.output.accepted import Form, Within, Written
from cointoss.compare.sweep.asked import Source

MARGINS = (
    "margins   the smallest change found of each quantity of the release, alone, that changes the outcome:"
)


@dataclass(frozen=True, kw_only=True)
class Answer:
    """The toss that is asked for, and what is printed of it."""

    engine: Literal["analytic", "mujoco"] = "analytic"
    """Engine that computes the toss."""
    contact: Literal["spring", "one_step"] | None = None
    """How MuJoCo realises the restitution; by default by a spring."""
    max_impacts: Annotated[int | None, Within(1, 1_000_000)] = None
    """Stop after this number of impacts: short for --set ending.max_impacts=N."""
    contact_steps: Annotated[int | None, Within(1, 1_000_000_000)] = None
    """Stop after this number of steps in and after sustained contact; by default the engine's own limit."""
    flight_steps: Annotated[int | None, Within(1, 1_000_000_000)] = None
    """Stop after this number of steps of flight, in MuJoCo; by default 250,000."""
    all: bool = False
    """Print every impact and contact; without it, of more than 20 impacts the first 8 and the last 2."""
    json: bool = False
    """Print JSON, in full precision."""
    trajectory: Annotated[Path | None, Written((".csv",), "text")] = None
    """Also write the path to this .csv file."""
    gltf: Annotated[Path | None, Written((".glb",)), Form("FILE.glb")] = None
    """Also write the coin, until it lies still, as an animation of glTF, for Blender or a game."""
    png: Annotated[Path | None, Written((".png",)), Form("FILE.png")] = None
    """Also draw height, tilt and energy over time."""
    play: bool = False
    """Also open the lab, which plays this toss and has a slider for each quantity."""
    rest: bool = False
    """Also find where the coin comes to rest; its path goes on up to there."""
    margin: bool = False
    """Also find the smallest changes of the release that change the outcome."""


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@set_option
@options_of(
    Answer,
    without("margin", "engine=mujoco"),
    only_with("contact", "engine=mujoco"),
    only_with("flight_steps", "engine=mujoco"),
    without("play", "engine=mujoco", "contact_steps", "json"),
)
@click.option(
    "-v", "--verbose", is_flag=True, help="Also print the errors that the engine measured of itself."
)
@with_scenario
def toss(source: Source, asked: Answer, verbose: bool) -> None:
    """Toss one coin and print its impacts."""
    from cointoss.models.stages import stage

    with stage("getting ready"):  # what is imported takes long on a busy machine
        from cointoss.compare.engines import Engine
        from cointoss.compare.engines import toss as toss_by
        from cointoss.compare.film.back_end import require_mujoco
        from cointoss.compare.output import answer
        from cointoss.compare.output.files import write_bytes, write_text

        require_mujoco(asked.engine)
        package = Engine(asked.engine).package
    coin, most = source.scenario, asked.max_impacts
    coin = coin if most is None else coin.replace("ending.max_impacts", most)
    chosen = {
        name: value
        for name in ("contact", "contact_steps", "flight_steps")
        if (value := getattr(asked, name)) is not None
    }
    fine = replace(package.FINE, **chosen)
    result = toss_by(coin, asked.engine, settings=fine, rest=asked.rest)
    if asked.trajectory is not None:
        write_text(asked.trajectory, answer.path_csv(result.sample(answer.path_times(result)), coin))
    if asked.gltf is not None:
        from cointoss.compare.film.gltf import write_gltf

        write_gltf(asked.gltf, result, fine)
    if asked.png is not None:
        from cointoss.compare.output.plots import picture_of_toss

        write_bytes(asked.png, picture_of_toss(result, source.stem))
    extra = []
    if asked.margin:
        from cointoss.compare.metrics.margin import margins

        extra = margins(coin, settings=fine)
    if asked.json:
        told = {item.quantity.name: {"change": item.finite, "unit": item.quantity.unit} for item in extra}
        print_json(
            {
                **answer.as_json(result),
                "scenario": coin.as_tables(),
                "settings": fine.as_dict(),
                **({"margin": told} if asked.margin else {}),
            },
            asked.engine,
        )
    else:
        lines = [answer.as_lines(result, whole=asked.all, checked=verbose), *([MARGINS] if extra else [])]
        click.echo("\n".join([*lines, *(one.line for one in extra)]))
    if asked.play:
        from cointoss.compare.lab.lab import lab_page

        open_page(lab_page(coin))
