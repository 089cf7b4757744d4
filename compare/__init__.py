"""Both engines asked the same question, and the command line; imports the other three packages."""

import sys
from pathlib import Path
from runpy import run_path

try:
    run_path(str(Path(__file__).parents[1] / "models" / "siblings.py"))
except ImportError as error:
    # The command `cointoss` comes here before any code of its own.
    if Path(sys.argv[0]).stem != "cointoss":
        raise
    print(f"cointoss: {error}", file=sys.stderr)
    sys.exit(2)
