"""Progress of long work on standard error, by tqdm: a line that is rewritten, or lines in a log."""

import os
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import KW_ONLY, dataclass
from time import perf_counter
from typing import Any, TypeVar

Item = TypeVar("Item")
Progress = Callable[[int, int], None]
"""Called after each part of a job with the number of parts done so far and of all."""
AFTER = 3.0
"""What takes longer is shown, and a stage within another when it has run for as long [s]."""
REWRITTEN, LOGGED = 0.25, 10.0
"""A terminal or a notebook is told so often, and a log [s]."""
TELLING_PART, TELLING_TIME = 0.05, 60.0
"""The time that is left is estimated once this part of the work is done, or after this time [s]."""
WIDTH = 100
"""Columns of a line where the terminal has no width."""


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

    def __post_init__(self) -> None:
        """Begin."""
        self._before, self._begun = self.done, perf_counter()
        self._first: tuple[int, float] | None = None

    def progress(self, done: int, total: int) -> None:
        """Set how many are done, of how many."""
        if self._first is None and done > self._before:
            self._first = done, self.seconds
        self.done, self.total = done, total

    @property
    def seconds(self) -> float:
        """For how long it has run [s]."""
        return perf_counter() - self._begun

    @property
    def rate(self) -> float | None:
        """How many are done in a second; None while too little is done to tell.

        The first report is left out: what has to be loaded or compiled delays it alone.
        """
        if self._first is None or self.total is None:
            return None
        first, delay = self._first
        enough = self.done - self._before >= TELLING_PART * (self.total - self._before)
        # The first parts of several workers are reported together.
        bursts = self.done <= first or self.seconds - delay < delay / 10
        if bursts or not (enough or self.seconds >= TELLING_TIME):
            return None
        return (self.done - first) / (self.seconds - delay)

    def line(self, width: int) -> str:
        """Return how far it is, with a bar if there is room for one in a line of that width."""
        if self.total is None:
            said = self.detail()
            return f"{self.name}: {self.seconds:.0f} s" + (f", {said}" if said else "")
        from tqdm import tqdm  # takes longer to import than the command line

        return tqdm.format_meter(
            self.done,
            self.total,
            self.seconds,
            ncols=width,
            prefix=self.name,
            unit=self.unit,
            rate=self.rate,
            initial=self.done,  # without a rate tqdm finds one of what is done since then
        )


at_work: list[Stage] = []
"""The stages of this process, the outermost first."""
_showing = threading.Lock()
"""Held while stages are shown: one line is enough."""
_shown: "list[ProgressLine]" = []
"""The line that shows them, if any does."""


def line_of(opened: Sequence[Stage], width: int) -> str:
    """Return what the stages are at, in one line of at most a width; 0 for a line without a bar."""
    if not opened or opened[0].seconds <= AFTER:
        return ""
    running = [each for number, each in enumerate(opened) if number == 0 or each.seconds > AFTER]
    # What only waits for another says nothing.
    shown = [each for each in running if each.total is not None or each is running[-1]]
    line = "; ".join(each.line(width if len(shown) == 1 else 0) for each in shown)
    return line[:width] if width else line


class ProgressLine:
    """What a stream shows: one line that is rewritten, or line by line."""

    def __init__(self, stream: Any) -> None:
        """Show nothing yet."""
        self.stream, self.rewrites = stream, _rewrites(stream)
        self._drawn, self._lock = "", threading.Lock()

    def draw(self, line: str) -> None:
        """Write a line; an empty one removes what is shown."""
        # Nobody may read it any more, which stops no work.
        with self._lock, suppress(OSError, ValueError):
            if self.rewrites and line != self._drawn:
                self.stream.write(f"\r{line:{len(self._drawn)}}" + ("" if line else "\r"))
                self._drawn = line
            elif line and not self.rewrites:
                self.stream.write(f"cointoss: {line}\n")
            self.stream.flush()

    def keep_drawing(self, over: threading.Event) -> None:
        """Draw what is at work until it is over."""
        while not over.wait(REWRITTEN if self.rewrites else LOGGED):
            # Other threads open and end stages.
            self.draw(line_of(list(at_work), _width(self.stream) - 1 if self.rewrites else 0))


def clear_line() -> None:
    """Remove the line that is shown, so that other text can be written; it comes again."""
    for line in _shown:
        line.draw("")


@contextmanager
def progress_shown(*, in_logs: bool) -> Iterator[None]:
    """Show on standard error what this process is at within.

    Args:
        in_logs: whether it is shown too where that is no terminal and no notebook.
    """
    line, over = ProgressLine(sys.stderr), threading.Event()
    is_wanted = line.rewrites or (in_logs and sys.stderr is not None)
    if os.environ.get("TQDM_DISABLE") or not is_wanted or not _showing.acquire(blocking=False):
        yield
        return
    shower = threading.Thread(target=line.keep_drawing, args=(over,), daemon=True)
    shower.start()
    _shown.append(line)
    try:
        yield
    finally:
        over.set()
        shower.join()
        clear_line()
        _shown.clear()
        _showing.release()


def _rewrites(stream: Any) -> bool:
    """Return whether a stream is a terminal's or a notebook's."""
    if stream is None or stream.closed:
        return False
    return stream.isatty() or type(stream).__module__.startswith("ipykernel.")


def _width(stream: Any) -> int:
    try:
        return os.get_terminal_size(stream.fileno()).columns or WIDTH
    except (OSError, ValueError, AttributeError):  # a notebook, or a window of Python's own
        return WIDTH


@contextmanager
def stage(
    name: str,
    unit: str = "",
    *,
    total: int | None = None,
    done: int = 0,
    detail: Callable[[], str] = str,
    shown: bool | None = None,
) -> Iterator[Progress]:
    """Return a function to be called with how many are done, of how many; the stage ends with the `with`.

    The arguments are those of a `Stage`, and whether it is shown: True everywhere, None where someone is
    likely to look.

    Raises:
        TypeError: for a progress that is none of these.
    """
    if not (shown is None or isinstance(shown, bool)):
        raise TypeError(f"progress: {shown!r}, accepted: True, False, or None to show it in a terminal alone")
    own = Stage(name, unit, total=total, done=done, detail=detail)
    is_asked = shown or (shown is None and not at_work)
    at_work.append(own)
    try:
        with progress_shown(in_logs=shown is True) if is_asked else nullcontext():
            yield own.progress
    finally:
        at_work.remove(own)


def reached(impacts: int, time: float) -> str:
    """Return how far a toss is, in words; the time is the coin's [s]."""
    return f"{impacts:,} impact{'s' * (impacts != 1)} in {time:.3g} s of the coin's time"


def counted(name: str, unit: str, items: Sequence[Item]) -> Iterator[Item]:
    """Yield items one after the other; with the last, the stage of that name ends."""
    with stage(name, unit, total=len(items)) as progress:
        for number, item in enumerate(items, start=1):
            yield item
            progress(number, len(items))
