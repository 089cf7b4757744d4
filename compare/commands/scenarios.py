"""`cointoss scenarios`: the scenarios that come with the package, and their files."""

import os
from pathlib import Path

import click

from cointoss.compare.commands.common import WrittenPlace, refuse
from cointoss.compare.commands.names import named_scenario_argument
from cointoss.compare.output.accepted import Written


@click.command()
@named_scenario_argument
@click.option(
    "--copy",
    "copied",
    type=WrittenPlace(Written((".toml",))),
    metavar="FILE.toml",
    help="Write the file of NAME to a new file, to be changed.",
)
def scenarios(name: str | None, copied: Path | None) -> None:
    """List the scenarios that come with the package, or print the file of one.

    \b
        cointoss scenarios table --copy mine.toml
        cointoss toss mine.toml
    """
    from cointoss.models.errors import meant
    from cointoss.models.sources import named_scenarios, named_text, title_of

    names = named_scenarios()
    if name is None:
        if copied is not None:
            raise click.UsageError(f"--copy {copied}: accepted: only with a NAME")
        width = max(map(len, names)) + 2
        click.echo("\n".join(f"{each:{width}}{title_of(each)}" for each in names))
        return
    if name not in names:
        refuse(
            f"{name}: no such scenario; {meant(name, names)}accepted: a name that cointoss scenarios lists"
        )
    if copied is None:
        click.echo(named_text(name), nl=False)
        return
    if os.path.lexists(copied):
        refuse(f"{copied}: exists; accepted: a new name")
    from cointoss.compare.output.files import write_text

    write_text(copied, named_text(name))
    click.echo(copied)
