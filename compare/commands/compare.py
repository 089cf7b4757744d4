"""`cointoss compare`: one toss by both engines, and its report."""

from pathlib import Path

import click

from compare.commands.common import SCENARIO_HELP, plain_errors
from compare.commands.names import scenario_argument


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@click.option(
    "--out", type=click.Path(path_type=Path), required=True, help="Folder of the report; made if missing."
)
@click.option("--no-video", is_flag=True, help="Draw no video, which takes longest.")
def compare(scenario: str, out: Path, no_video: bool) -> None:
    """Toss one coin by both engines and write a report.

    The report shows both tosses side by side, with a video. The page is there before the video is drawn.
    """
    with plain_errors(scenario):
        from compare.report.contents import require_folder
        from models.reading import parse, scenario_text
        from models.stages import stage

        text = scenario_text(scenario)
        described = parse(text, scenario)
        require_folder(out, scenario)

        with stage("getting ready"):  # what is imported takes long on a busy machine
            from compare.film.back_end import drawing_problem

            problem = "None was asked for; cointoss video draws one." if no_video else drawing_problem()

            from compare.report.folder import write_report

        click.echo(write_report(described, text, Path(scenario).stem, out, problem))
