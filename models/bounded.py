"""Files of a bounded size."""

import errno
import os
import stat
from pathlib import Path


class TooLargeError(ValueError):
    """A file that is larger than what is accepted."""


def read_bounded(path: Path, most: int) -> bytes:
    """Return the bytes of a file, of which at most `most` + 1 are read: a device may have no end.

    Raises:
        TooLargeError: if there are more.
        OSError: if it can't be read, or is a pipe that nobody writes to.
    """

    def at_once(name: str, flags: int) -> int:
        if not hasattr(os, "O_NONBLOCK"):  # Windows, which has no such pipes
            return os.open(name, flags)
        number = os.open(name, flags | os.O_NONBLOCK)
        os.set_blocking(number, True)
        return number

    with open(path, "rb", opener=at_once) as file:
        content = file.read(most + 1)
        if not content and stat.S_ISFIFO(os.fstat(file.fileno()).st_mode):
            raise OSError(errno.EINVAL, "a pipe that nobody writes to")
    if len(content) > most:
        raise TooLargeError(f"more than {most} bytes")
    return content
