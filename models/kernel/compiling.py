"""How much was compiled in this process and how long it took, for those who wait."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager


class _Compiling:
    """Counts under numba's lock: one thread compiles at a time."""

    def __init__(self) -> None:
        self.declared = 0
        """Functions that can be compiled; most are, if one is."""
        self.begun = 0
        """Functions that were compiled, or begun."""
        self.watchers: list[Callable[[], None]] = []
        """Called when a function is begun, and when the last of several is done."""
        self._depth, self._since, self._done = 0, 0.0, 0.0

    @property
    def now(self) -> bool:
        """Whether something is being compiled."""
        return self._depth > 0

    @property
    def seconds(self) -> float:
        """Time spent with it up to now [s]."""
        return self._done + (time.perf_counter() - self._since if self.now else 0.0)

    @contextmanager
    def one(self) -> Iterator[None]:
        """Count what is compiled within as one function."""
        if self._depth == 0:
            self._since = time.perf_counter()
        self._depth += 1
        self.begun += 1
        self._tell()
        try:
            yield
        finally:
            self._depth -= 1
            if self._depth == 0:
                self._done += time.perf_counter() - self._since
                self._tell()

    def _tell(self) -> None:
        for watcher in self.watchers:
            watcher()


compiling = _Compiling()
"""Of this process."""
