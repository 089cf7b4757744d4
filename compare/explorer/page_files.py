"""The files of the explorer's page."""

from cointoss.compare.web.scripts import files_of
from cointoss.compare.web.wasm.carried import engine_scripts


def page_files() -> dict[str, bytes]:
    """Return the files by their names."""
    return {**files_of("cointoss.compare.explorer"), **engine_scripts()}
