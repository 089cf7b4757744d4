"""The stages of the long work that this process is at, for those who wait for it."""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import KW_ONLY, dataclass
from typing import TypeVar

Item = TypeVar("Item")
TELLING_PART, TELLING_TIME = 0.05, 60.0
"""The time that is left is estimated once this part of the work is done, or after this time [s]."""


@dataclass(eq=False)
class Stage:
    """A part of the work: for how long it has run, and how far it is, where that is counted."""

    name: str
    """What is done."""
    unit: str = ""
    """What is counted, as in "frames"."""
    _: KW_ONLY
    total: int | None = None
    """How many there are; None where nothing is counted, or not yet."""
    done: int = 0
    """How many there are so far; those at the beginning say nothing of the speed."""
    detail: Callable[[], str] = str
    """Returns how far it is, in words; empty where none are known."""
    clock: Callable[[], float] = time.perf_counter
    """The clock of the wall [s]."""

    def __post_init__(self) -> None:
        """Begin."""
        self._before, self._begun = self.done, self.clock()
        self._first: tuple[int, float] | None = None

    def progress(self, done: int, total: int) -> None:
        """Set how many are done, of how many."""
        if self._first is None and done > self._before:
            self._first = done, self.seconds
        self.done, self.total = done, total

    @property
    def seconds(self) -> float:
        """For how long it has run [s]."""
        return self.clock() - self._begun

    @property
    def rate(self) -> float | None:
        """How many are done in a second; None where none was yet."""
        new = self.done - self._before
        return new / self.seconds if new > 0 and self.seconds > 0 else None

    @property
    def seconds_left(self) -> float | None:
        """An estimate of how long it will still run [s]; None while too little is done.

        The first report is left out of the rate: what has to be loaded or compiled delays it alone.
        """
        if self._first is None or self.total is None:
            return None
        first, delay = self._first
        enough = self.done - self._before >= TELLING_PART * (self.total - self._before)
        # The first parts of several workers are reported together.
        bursts = self.done <= first or self.seconds - delay < delay / 10
        if bursts or not (enough or self.seconds >= TELLING_TIME):
            return None
        return (self.total - self.done) * (self.seconds - delay) / (self.done - first)


class Stages:
    """The stages of this process, the outermost first."""

    def __init__(self) -> None:
        """Begin with none."""
        self.open: list[Stage] = []
        self.shown: Callable[[bool | None], AbstractContextManager[None]] = lambda _: nullcontext()
        """Shows the stages while the outermost is open, if it is asked to; set by what can."""
        self.ended: list[Callable[[Stage], None]] = []
        """Called with each stage that ends."""


stages = Stages()
"""The stages of this process."""


@contextmanager
def stage(
    name: str,
    unit: str = "",
    *,
    total: int | None = None,
    done: int = 0,
    detail: Callable[[], str] = str,
    shown: bool | None = None,
) -> Iterator[Callable[[int, int], None]]:
    """Return a function to be called with how many are done, of how many; the stage ends with the `with`.

    The arguments are those of a `Stage`, and whether it is shown: True everywhere, None where someone is
    likely to look.

    Raises:
        TypeError: for a progress that is none of these.
    """
    if not (shown is None or isinstance(shown, bool)):
        raise TypeError(f"progress: {shown!r}, accepted: True, False, or None to show it in a terminal alone")
    own = Stage(name, unit, total=total, done=done, detail=detail)
    is_outermost = not stages.open
    stages.open.append(own)
    try:
        with stages.shown(shown) if is_outermost else nullcontext():
            yield own.progress
            for ended in stages.ended:
                ended(own)
    finally:
        stages.open.remove(own)


def reached(impacts: int, time: float) -> str:
    """Return how far a toss is, in words; the time is the coin's [s]."""
    return f"{impacts:,} impact{'s' * (impacts != 1)} in {time:.3g} s of the coin's time"


def counted(name: str, unit: str, items: Sequence[Item]) -> Iterator[Item]:
    """Yield items one after the other; with the last, the stage of that name ends."""
    with stage(name, unit, total=len(items)) as progress:
        for number, item in enumerate(items, start=1):
            yield item
            progress(number, len(items))
