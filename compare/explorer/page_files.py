"""The files of the explorer's page."""

from importlib import resources


def page_files() -> dict[str, bytes]:
    """Return the files by their names."""
    page = resources.files("compare.explorer") / "page"
    entries = [entry for folder in (page, page / "three") for entry in folder.iterdir() if entry.is_file()]
    return {entry.name: entry.read_bytes() for entry in entries}
