"""`cointoss compare`: one toss by several engines, and its report."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import click

from cointoss.compare.commands.common import SCENARIO_HELP
from cointoss.compare.commands.names import scenario_argument
from cointoss.compare.commands.options import options_of
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.output.accepted import Written
from cointoss.compare.sweep.asked import Source


@dataclass(frozen=True, kw_only=True)
class Report:
    """The report that is asked for."""

    out: Annotated[Path | None, Written(kind="folder")] = None
    """Folder of the report, made if missing; by default NAME-report, as in fig24a-report."""
    engine: tuple[str, ...] = ()
    """Engine to compare with the analytic one, by default mujoco; may be given several times."""
    no_video: bool = False
    """Draw no video, which takes longest."""


@click.command(epilog=SCENARIO_HELP)
@scenario_argument
@set_option
@options_of(Report)
@with_scenario
def compare(source: Source, asked: Report) -> None:
    """Toss one coin by several engines and write a report.

    The report shows the tosses side by side, with a video. The page is there before the video is drawn.
    """
    from cointoss.compare.report.contents import NOT_ASKED, require_folder
    from cointoss.models.stages import stage

    folder = asked.out or Path(f"{source.stem}-report")
    require_folder(folder, source.name)

    with stage("getting ready"):  # what is imported takes long on a busy machine
        from cointoss.compare.film.back_end import drawing_problem

        problem = NOT_ASKED if asked.no_video else drawing_problem()

        from cointoss.compare.report.comparison import BOTH, compared
        from cointoss.compare.report.folder import write_report

    found = compared(source.scenario, source.text, source.stem, asked.engine or BOTH)
    require_folder(folder, source.name, [toss.engine for toss in found.tosses])
    click.echo(write_report(found, folder, problem))
