"""The files of the explorer's page."""

from importlib import resources

from cointoss.compare.web.scripts import shared_files
from cointoss.compare.web.wasm.carried import engine_scripts


def page_files() -> dict[str, bytes]:
    """Return the files by their names."""
    page = resources.files("cointoss.compare.explorer") / "page"
    own = {entry.name: entry.read_bytes() for entry in page.iterdir()}
    return {**shared_files(), **own, **engine_scripts()}
