"""numba's compiler, changed by its private members: for the tested versions of numba alone."""

import re
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path

TESTED = ("0.68",)
"""The minor versions of numba that have these members as they are used here."""


@cache
def numba_version() -> str:
    """Return the version of numba, read from its files: to import it takes longer than a toss."""
    if "numba" not in sys.modules:
        found = find_spec("numba")
        if found is not None and found.origin is not None:
            text = Path(found.origin).with_name("_version.py").read_text()
            written = re.search(r'"version": "([^"]+)"', text)
            if written is not None:
                return written[1]
    import numba

    return numba.__version__
