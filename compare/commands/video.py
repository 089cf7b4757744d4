"""`cointoss video`: one toss filmed."""

from pathlib import Path

import click

from compare.commands.common import SCENARIO_HELP, plain_errors, refuse
from compare.commands.names import scenario_argument


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@click.option("--out", type=click.Path(path_type=Path), required=True, help="The .mp4 file to write.")
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
def video(scenario: str, out: Path, engine: str, camera: str) -> None:
    """Film one toss, drawn by MuJoCo.

    The film slows down around the impacts.
    """
    with plain_errors(scenario):
        from compare.output.files import require_file, written_whole
        from models.reading import load

        described = load(scenario)
        require_file(out, ".mp4", scenario)

        from compare.film.back_end import drawing_problem

        problem = drawing_problem()
        if problem is not None:
            refuse(problem)

        from compare.engines import Engine
        from compare.film.drawing import Camera
        from compare.film.video import FULL, write_video
        from compare.output.progress import bar

        engines = list(Engine) if engine == "both" else [Engine(engine)]
        tosses = [each.package.toss(described) for each in engines]
        with written_whole(out) as aside, bar("video", "frames") as progress:
            write_video(tosses, Camera(camera), FULL, aside, progress)
        click.echo(out)
