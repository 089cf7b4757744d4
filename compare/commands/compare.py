"""`cointoss compare`: one toss by both engines, and its report."""

from pathlib import Path

import click

from cointoss.compare.commands.common import SCENARIO_HELP, Place, no_video_option, plain_errors
from cointoss.compare.commands.names import scenario_argument


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@click.option(
    "--out",
    type=Place(),
    help="Folder of the report, made if missing; by default NAME-report, as in fig24a-report.",
)
@no_video_option
def compare(scenario: str, out: Path | None, no_video: bool) -> None:
    """Toss one coin by both engines and write a report.

    The report shows both tosses side by side, with a video. The page is there before the video is drawn.
    """
    with plain_errors(scenario):
        from cointoss.compare.report.contents import NOT_ASKED, require_folder
        from cointoss.models.reading import parse, scenario_text
        from cointoss.models.stages import stage
        from cointoss.models.unused import warn_of_unused_fields

        text = scenario_text(scenario)
        described = parse(text, scenario)
        warn_of_unused_fields(described.floor, described.air)
        name = Path(scenario).stem
        folder = out or Path(f"{name}-report")
        require_folder(folder, scenario)

        with stage("getting ready"):  # what is imported takes long on a busy machine
            from cointoss.compare.film.back_end import drawing_problem

            problem = NOT_ASKED if no_video else drawing_problem()

            from cointoss.compare.report.comparison import compared
            from cointoss.compare.report.folder import write_report

        click.echo(write_report(compared(described, text, name), folder, problem))
