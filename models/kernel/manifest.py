"""The files of engines' libraries: for which systems they are, what each was made of, which are current."""

import json
import os
import platform
import stat
import sys
from pathlib import Path
from typing import NamedTuple

from cointoss.models.kernel.base_folder import is_private
from cointoss.models.kernel.digests import HOME, digest_of

SYSTEM = f"{sys.platform}-{platform.machine()}".lower()
"""This system and processor."""
CUDA = "cuda"
"""In its place, NVIDIA's cards: their library is one file of code in PTX and for some of their kinds."""
BROWSER = "wasm32"
"""Or a browser: its library has the entries that a page calls alone, and gets what a page has to know."""
SUFFIX = ".so"
"""The suffix of a library, on every system."""
MANIFEST = f"{SUFFIX}.json"
"""Suffix of the file beside a library that says what it was made of."""


class Made(NamedTuple):
    """What a library was made of, as its manifest says."""

    module: str
    system: str
    digest: str
    """The digest of the library."""
    sources: dict[str, str]
    """The digests of the project's files that the build has read, by their paths."""
    forms: dict[str, str]
    """The form of each symbol, see `Entry.form`."""

    @classmethod
    def read(cls, file: Path, *, is_carried: bool = False) -> "Made | None":
        """Return what a manifest says, or None where it is none, or another user could have written it.

        Args:
            file: the manifest.
            is_carried: whether it is a wheel's, which whoever installs it may write.
        """
        try:
            described = file.stat()
            if not stat.S_ISREG(described.st_mode) or not (is_carried or is_private(described)):
                return None
            made = cls(**json.loads(file.read_bytes()))
        except (OSError, ValueError, TypeError, RecursionError):
            return None
        is_known = isinstance(made.sources, dict) and isinstance(made.forms, dict)
        return made if is_known and (is_carried or made.sources) else None

    def is_current(self, home: Path = HOME) -> bool:
        """Return whether the sources are those that lie here."""
        return all(digest_of(home / name) == digest for name, digest in self.sources.items())


def current(folder: Path, name: str, system: str = SYSTEM) -> Path | None:
    """Return a library in a folder that is whole, this user's, and made of the sources that lie here."""
    for manifest in folder.glob(f"{name}-{system}-*{MANIFEST}"):
        made, library = Made.read(manifest), manifest.with_suffix("")
        if made is None or not made.is_current() or digest_of(library) != made.digest:
            continue
        if is_private(library.stat()):
            os.utime(manifest)  # what is used is kept
            return library
    return None
