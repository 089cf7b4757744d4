"""The files of the explorer's page."""

from importlib import resources

from cointoss.compare.web.scripts import shared_files


def page_files() -> dict[str, bytes]:
    """Return the files by their names."""
    page = resources.files("cointoss.compare.explorer") / "page"
    return shared_files() | {entry.name: entry.read_bytes() for entry in page.iterdir()}
