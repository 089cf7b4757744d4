"""How much was compiled in this process and how long it took, for those who wait."""

import math
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from cointoss.models.kernel.sources import part_of

LINKING = 0.5
"""Time to make machine code of functions, in times that it takes to compile them: from both engines."""
SHARED = "models"
"""The part of the project whose functions all others call."""
NAMES = {
    SHARED: "functions of both engines",
    "analytic": "the analytic engine",
    "coin_mj": "the MuJoCo engine",
    "compare": "the proofs and studies",
}
"""What the functions of a package are called."""


class Compiling:
    """Counts under numba's lock: one thread compiles at a time."""

    def __init__(self, clock: Callable[[], float] = time.perf_counter) -> None:
        """Count nothing yet."""
        self.declared: Counter[str] = Counter()
        """Functions that can be compiled, by module."""
        self.begun = 0
        """Functions that were compiled, or begun."""
        self.total = 0
        """Functions that will have been compiled, about: some never are, some for two kinds of arguments."""
        self.package = ""
        """The package that is compiled, or was last."""
        self.waits = False
        """Whether another process compiles the same function, and is waited for."""
        self._clock, self._depth = clock, 0
        self._since = self._done = self._linking_since = self._linked = 0.0

    @property
    def now(self) -> bool:
        """Whether something is being compiled."""
        return self._depth > 0

    @property
    def what(self) -> str:
        """What is compiled, in words."""
        return NAMES.get(self.package, "functions")

    @property
    def seconds(self) -> float:
        """Time spent with it up to now [s]."""
        return self._done + (self._clock() - self._since if self.now else 0.0)

    @property
    def working_time(self) -> float:
        """A clock that stands still while something is compiled [s]."""
        return self._clock() - self.seconds

    @property
    def seconds_left(self) -> float:
        """Time that the rest will take if its functions are like those before [s]."""
        linked = self._linked + (self._clock() - self._linking_since if self._linking_since else 0.0)
        each = (self.seconds - linked) / max(1, self.begun)
        return (self.total - self.begun) * each + max(0.0, LINKING * self.total * each - linked)

    @contextmanager
    def one(self, module: str, kept: Callable[[str], int]) -> Iterator[None]:
        """Count what is compiled within as one function.

        Args:
            module: of the function.
            kept: returns how many functions of a module are on disk, compiled.
        """
        if self._depth == 0:
            self._expect(part_of(module), kept)
        self.begun += 1
        self.total = max(self.total, self.begun)
        with self._timed():
            yield

    @contextmanager
    def waiting(self) -> Iterator[None]:
        """Take what passes within for time to compile, by another process."""
        self.waits = True
        try:
            with self._timed():
                yield
        finally:
            self.waits = False

    @contextmanager
    def _timed(self) -> Iterator[None]:
        if self._depth == 0:
            self._since = self._clock()
        self._depth += 1
        try:
            yield
        finally:
            self._depth -= 1
            if self._depth == 0:
                self._done += self._clock() - self._since

    def _expect(self, package: str, kept: Callable[[str], int]) -> None:
        """Count what a package lacks, and that which it calls."""
        packages = {module: part_of(module) for module in self.declared}
        callers = sorted(set(packages.values()) - {SHARED})
        if package == SHARED:
            package = self.package or (callers[0] if len(callers) == 1 else SHARED)
        missing = (
            max(0, count - kept(module))
            for module, count in self.declared.items()
            if packages[module] in (package, SHARED)
        )
        # What no toss needs is not compiled, however often it is counted.
        most = self.total if package == self.package else math.inf
        self.package, self.total = package, int(min(self.begun + sum(missing), most))

    @contextmanager
    def linking(self) -> Iterator[None]:
        """Measure how long it takes within to make machine code of compiled functions."""
        self._linking_since = self._clock()
        try:
            yield
        finally:
            self._linked += self._clock() - self._linking_since
            self._linking_since = 0.0


compiling = Compiling()
"""Of this process."""
