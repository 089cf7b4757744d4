"""The stages of the long work that this process is at, for those who wait for it."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import TypeVar

from cointoss.models.kernel.compiling import compiling

Item = TypeVar("Item")


class Stage:
    """A part of the work: for how long it has run, and how far it is, where that is counted."""

    def __init__(
        self,
        name: str,
        unit: str = "",
        *,
        total: int | None = None,
        done: int = 0,
        detail: Callable[[], str] | None = None,
        clock: Callable[[], float] = lambda: compiling.working_time,
    ) -> None:
        """Begin.

        Args:
            name: what is done.
            unit: what is counted, as in "frames".
            total: how many there are; None where nothing is counted, or not yet.
            done: how many there were before, which say nothing of the speed.
            detail: returns how far it is, in words.
            clock: one that stands still while something is compiled [s].
        """
        self.name, self.unit, self.total, self.done, self.before = name, unit, total, done, done
        self._detail, self._clock, self._begun = detail, clock, clock()

    def progress(self, done: int, total: int) -> None:
        """Set how many are done, of how many."""
        self.done, self.total = done, total

    @property
    def seconds(self) -> float:
        """For how long it has run [s]."""
        return self._clock() - self._begun

    @property
    def rate(self) -> float | None:
        """How many are done in a second; None where none was yet."""
        new = self.done - self.before
        return new / self.seconds if new > 0 and self.seconds > 0 else None

    @property
    def seconds_left(self) -> float | None:
        """How long it will run on at this rate [s]; None where that is not known."""
        return None if self.rate is None or self.total is None else (self.total - self.done) / self.rate

    @property
    def detail(self) -> str:
        """How far it is, in words; empty where none are known."""
        return "" if self._detail is None else self._detail()


class Stages:
    """The stages of this process, the outermost first."""

    def __init__(self) -> None:
        """Begin with none."""
        self.open: list[Stage] = []
        self.shown: Callable[[], AbstractContextManager[None]] = nullcontext
        """Shows the stages while the outermost is open; set by what can."""
        self.ended: list[Callable[[Stage], None]] = []
        """Called with each stage that ends."""


stages = Stages()
"""Of this process."""


@contextmanager
def stage(
    name: str,
    unit: str = "",
    *,
    total: int | None = None,
    done: int = 0,
    detail: Callable[[], str] | None = None,
) -> Iterator[Callable[[int, int], None]]:
    """Return a function to be called with how many are done, of how many; the stage ends with the `with`.

    Args:
        name: as of a `Stage`, like the others.
        unit: as of a `Stage`.
        total: as of a `Stage`.
        done: as of a `Stage`.
        detail: as of a `Stage`.
    """
    own = Stage(name, unit, total=total, done=done, detail=detail)
    is_outermost = not stages.open
    stages.open.append(own)
    try:
        with stages.shown() if is_outermost else nullcontext():
            yield own.progress
            for ended in stages.ended:
                ended(own)
    finally:
        stages.open.remove(own)


def counted(name: str, unit: str, items: Sequence[Item]) -> Iterator[Item]:
    """Yield items one after the other; with the last, the stage of that name ends."""
    with stage(name, unit, total=len(items)) as progress:
        for number, item in enumerate(items, start=1):
            yield item
            progress(number, len(items))
