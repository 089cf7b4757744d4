"""`cointoss explore`: a map in the browser."""

from pathlib import Path

import click

from cointoss.compare.commands.common import CountType, Place, plain_errors, say


@click.command()
@click.argument("map_path", metavar="MAP.zarr", type=Place())
@click.option("--port", type=CountType(1, 65535), help="The port to listen at; by default one that is free.")
@click.option("--no-browser", is_flag=True, help="Only print the address.")
@click.option(
    "--static",
    type=Place(),
    metavar="FILE.html",
    help="Write one page with some pixels tossed, at most 10 MB, that needs no server; and end.",
)
def explore(map_path: Path, port: int | None, no_browser: bool, static: Path | None) -> None:
    """Show a map in the browser: click a pixel, see both engines toss it.

    MAP.zarr is a map that cointoss basin made, whole or in part. The page is served to this machine alone,
    until Ctrl-C.
    """
    if static is not None and (port is not None or no_browser):
        raise click.UsageError("--static: accepted: without --port and --no-browser")
    with plain_errors(str(map_path)):
        if static is not None:
            from cointoss.compare.explorer.static import write_static
            from cointoss.compare.output.files import require_file

            require_file(static, ".html", str(map_path))
            write_static(map_path, static)
            click.echo(static)
            return
        import webbrowser

        from cointoss.compare.explorer.server import Explorer

        with Explorer(map_path, port or 0) as explorer:
            click.echo(explorer.url)
            if not no_browser and not webbrowser.open(explorer.url):
                say("no browser was found; open the address above in one")
            explorer.serve_forever()
