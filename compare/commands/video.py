"""`cointoss video`: one toss filmed."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import click

from cointoss.compare.commands.common import SCENARIO_HELP, refuse
from cointoss.compare.commands.names import scenario_argument
from cointoss.compare.commands.options import options_of
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.film.encodings import ENCODINGS
from cointoss.compare.output.accepted import Written
from cointoss.compare.sweep.asked import Source


@dataclass(frozen=True, kw_only=True)
class Film:
    """The film that is asked for."""

    out: Annotated[Path, Written(tuple(ENCODINGS))]
    """The file to write: .mp4, .webm or .gif."""
    engine: Literal["analytic", "mujoco", "both"] = "mujoco"
    """The engine that tosses; both: side by side."""
    camera: Literal["overview", "close-up", "top"] = "close-up"
    """Where the camera is; close-up follows the coin."""
    poster: Annotated[Path | None, Written((".png",))] = None
    """Also write one frame to this .png file."""


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@set_option
@options_of(Film)
@with_scenario
def video(source: Source, asked: Film) -> None:
    """Film one toss, drawn by MuJoCo, until the coin lies still.

    The film slows down around the impacts.
    """
    from cointoss.compare.film.back_end import drawing_problem
    from cointoss.compare.output.files import written_whole
    from cointoss.models.stages import stage

    problem = drawing_problem()
    if problem is not None:
        refuse(problem)

    with stage("getting ready"):  # what is imported takes long on a busy machine
        from PIL import Image

        from cointoss.compare.engines import Engine
        from cointoss.compare.film.drawing import Camera
        from cointoss.compare.film.filmed import followed
        from cointoss.compare.film.video import write_video

    engines = list(Engine) if asked.engine == "both" else [Engine(asked.engine)]
    shown = [followed(each.package.toss(source.scenario)) for each in engines]
    form = ENCODINGS[asked.out.suffix.lower()].form
    with written_whole(asked.out) as aside:
        picture = write_video(shown, Camera(asked.camera), form, aside)
    if asked.poster is not None:
        with written_whole(asked.poster) as aside:
            Image.fromarray(picture).save(aside, format="png")
    click.echo(asked.out)
