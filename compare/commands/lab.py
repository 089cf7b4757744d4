"""`cointoss lab`: a page in which one tosses coins."""

from pathlib import Path

import click

from cointoss.compare.commands.common import SCENARIO_HELP, Place, say
from cointoss.compare.commands.names import spared_scenario_argument
from cointoss.compare.commands.settings import set_option, with_scenario
from cointoss.compare.sweep.asked import Source


@click.command(epilog=SCENARIO_HELP)
@spared_scenario_argument
@set_option
@click.option(
    "--out", type=Place(), metavar="FILE.html", help="Write the page, at most 2 MB, instead of opening it."
)
@with_scenario
def lab(source: Source, out: Path | None) -> None:
    """Toss coins in the browser: a map that follows sliders, and each of its tosses.

    The page is one file with the analytic engine in it; it needs no server and no network. It begins with
    SCENARIO, by default fig24a.
    """
    import tempfile
    import webbrowser

    from cointoss.compare.lab.lab import lab_page
    from cointoss.compare.output.files import require_file, write_text

    require_file(out, ".html", source.name)
    page = lab_page(source.scenario)
    target = out or Path(tempfile.mkdtemp(prefix="cointoss-")) / "lab.html"
    write_text(target, page)
    click.echo(target)
    if out is None and not webbrowser.open(target.as_uri()):
        say("no browser was found; open the file above in one")
