"""`cointoss explore`: a map in the browser."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import click

from cointoss.compare.commands.common import ReadPlace, plain_errors
from cointoss.compare.commands.options import options_of, without
from cointoss.compare.commands.served import ServedPage, serve
from cointoss.compare.output.accepted import Form, Written
from cointoss.models.devices import Device


@dataclass(frozen=True, kw_only=True)
class Page(ServedPage):
    """How the map is shown."""

    device: Device = Device.CPU
    """Device that computes a finer map: the CPU, an NVIDIA card, or the card where it is faster."""
    static: Annotated[Path | None, Written((".html",)), Form("FILE.html")] = None
    """Write one page with some pixels tossed, at most 10 MB, that needs no server; and end."""


@click.command()
@click.argument(
    "map_path",
    metavar="MAP.zarr",
    is_eager=True,
    type=ReadPlace("a map that cointoss basin made", "folder"),
)
@options_of(Page, without("static", "device", "port", "no_browser"))
def explore(map_path: Path, asked: Page) -> None:
    """Show a map in the browser: click a pixel, see both engines toss it.

    MAP.zarr is a map that cointoss basin made, whole or in part. It is opened in the lab, whose sliders
    change it. The page is served to this machine alone, until Ctrl-C.
    """
    with plain_errors(str(map_path)):
        if asked.static is not None:
            from cointoss.compare.lab.static import write_static

            write_static(map_path, asked.static)
            click.echo(asked.static)
            return
        from cointoss.compare.lab.served import ServedLab

        serve(ServedLab(map_path, asked.port or 0, asked.device), asked)
