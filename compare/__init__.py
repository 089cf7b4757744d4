"""Both engines asked the same question, and the command line; imports the other three packages."""

import signal
import sys
from pathlib import Path

# The command, `cointoss` or `python -m cointoss`, comes here before any code of its own.
_is_command = sys.argv[0].endswith(("cointoss", str(Path("cointoss", "__main__.py"))))
if _is_command and signal.getsignal(signal.SIGINT) == signal.default_int_handler:
    # No traceback, until compare.output.interruption has its own handler.
    signal.signal(signal.SIGINT, signal.SIG_DFL)

from runpy import run_path

try:
    run_path(str(Path(__file__).parents[1] / "models" / "siblings.py"))
except ImportError as error:
    if not _is_command:
        raise
    print(f"cointoss: {error}", file=sys.stderr)
    sys.exit(2)
