"""What commands share that serve a page: their options, and serving until Ctrl-C."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import click

from cointoss.compare.commands.common import say
from cointoss.compare.output.accepted import Within

if TYPE_CHECKING:
    from cointoss.compare.web.server import PageServer


@dataclass(frozen=True, kw_only=True)
class ServedPage:
    """How a page is served to this machine."""

    port: Annotated[int | None, Within(1, 65535)] = None
    """The port to listen at; by default one that is free."""
    no_browser: bool = False
    """Only print the address."""


def open_page(page: str) -> None:
    """Write a page to a file of its own, print where that is, and open it."""
    import tempfile
    import webbrowser

    from cointoss.compare.output.files import write_text

    write_text(target := Path(tempfile.mkdtemp(prefix="cointoss-")) / "lab.html", page)
    click.echo(target)
    if not webbrowser.open(target.as_uri()):
        say("no browser was found; open the file above in one")


def serve(server: "PageServer", asked: ServedPage) -> None:
    """Print where a page is, open it, and serve it until Ctrl-C."""
    import webbrowser

    with server:
        click.echo(server.url)
        if not asked.no_browser and not webbrowser.open(server.url):
            say("no browser was found; open the address above in one")
        server.serve_forever()
