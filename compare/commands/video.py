"""`cointoss video`: one toss filmed."""

from pathlib import Path

import click

from cointoss.compare.commands.common import SCENARIO_HELP, Place, plain_errors, refuse
from cointoss.compare.commands.names import scenario_argument


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@click.option("--out", type=Place(), required=True, help="The file to write: .mp4, .webm or .gif.")
@click.option(
    "--engine",
    type=click.Choice(["analytic", "mujoco", "both"]),
    default="mujoco",
    show_default=True,
    help="The engine that tosses; both: side by side.",
)
@click.option(
    "--camera",
    type=click.Choice(["overview", "close-up", "top"]),
    default="close-up",
    show_default=True,
    help="Where the camera is; close-up follows the coin.",
)
@click.option("--poster", type=Place(), help="Also a .png file of one frame, to stand for it.")
def video(scenario: str, out: Path, engine: str, camera: str, poster: Path | None) -> None:
    """Film one toss, drawn by MuJoCo, until the coin lies still.

    The film slows down around the impacts.
    """
    with plain_errors(scenario):
        from cointoss.compare.film.encodings import ENCODINGS
        from cointoss.compare.output.files import require_file, written_whole
        from cointoss.models.reading import load
        from cointoss.models.stages import stage

        described = load(scenario)
        require_file(out, tuple(ENCODINGS), scenario)
        if poster is not None:
            require_file(poster, ".png", scenario)

        from cointoss.compare.film.back_end import drawing_problem

        problem = drawing_problem()
        if problem is not None:
            refuse(problem)

        with stage("getting ready"):  # what is imported takes long on a busy machine
            from PIL import Image

            from cointoss.compare.engines import Engine
            from cointoss.compare.film.drawing import Camera
            from cointoss.compare.film.filmed import followed
            from cointoss.compare.film.video import write_video

        engines = list(Engine) if engine == "both" else [Engine(engine)]
        shown = [followed(each.package.toss(described)) for each in engines]
        form = ENCODINGS[out.suffix.lower()].form
        with written_whole(out) as aside, stage("drawing the film", "frames") as progress:
            picture = write_video(shown, Camera(camera), form, aside, progress)
        if poster is not None:
            with written_whole(poster) as aside:
                Image.fromarray(picture).save(aside, format="png")
        click.echo(out)
