"""The command line, run in this process or in another that finds this checkout."""

import os
from pathlib import Path

from click.testing import CliRunner, Result

from cointoss.compare.cli import main

HERE = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2]), "PYTHONDONTWRITEBYTECODE": "1"}


def cointoss(*arguments: object) -> Result:
    """Return the answer of `cointoss` to those arguments."""
    return CliRunner().invoke(main, [str(part) for part in arguments], catch_exceptions=False)
