"""Progress on standard error: a line that is rewritten on a terminal or in a notebook, lines in a log."""

import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from itertools import count
from typing import Any

from cointoss.models.stages import Stage, Stages, stages

Progress = Callable[[int, int], None]
"""Called after each part of a job with the number of parts done so far and of all."""
AFTER = 3.0
"""What takes longer is shown on a terminal [s]."""
FIRST, EVERY = 5.0, 10.0
"""A log has a line when nothing was said of a stage for as long, and then of each stage as often [s]."""
INNER = 3.0
"""A stage within another is named when it has run for as long [s]."""
WIDTH = 100
"""Columns of a line where the terminal has no width."""


def stepping(progress: Progress, whole: int) -> Callable[[Any], Any]:
    """Return what counts a part of a job, of `whole` parts, and returns the result that it is given."""
    done = count(1)

    def step(result: Any) -> Any:
        progress(next(done), whole)
        return result

    return step


class Display:
    """Shows on a stream what this process is at, whenever `tick` is called."""

    def __init__(
        self,
        stream: Any,
        *,
        rewrites: bool,
        work: Stages = stages,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Show nothing yet.

        Args:
            stream: where to write.
            rewrites: whether one line is written again and again, as on a terminal; else lines now and then.
            work: whose stages are shown.
            clock: of the wall [s].
        """
        self._stream, self._rewrites, self._work = stream, rewrites, work
        self._clock, self._lock = clock, threading.Lock()
        self._last_line, self._named = clock(), None
        self._drawn, self._drawn_stage = "", None

    def tick(self) -> None:
        """Show what is due."""
        with self._lock:
            opened = list(self._work.open)  # other threads open and end them
            if not opened or opened[0].seconds < 1:
                self._draw("")
                return
            visible = [opened[0], *(each for each in opened[1:] if each.seconds > INNER)]
            subject = visible[-1] if opened[0].total is None else opened[0]
            if not self._rewrites:
                if self._clock() - self._last_line > (EVERY if subject is self._named else FIRST):
                    self._named, self._last_line = subject, self._clock()
                    self._write(f"cointoss: {'; '.join(map(_phrase, visible))}\n")
            elif opened[0].seconds > AFTER or self._drawn:
                self._draw(self._bar(visible))
                self._drawn_stage = opened[0]

    def ended(self, stage: Stage) -> None:
        """Leave the bar of a stage whose parts were counted; remove the line of another."""
        with self._lock:
            if stage is not self._drawn_stage:
                return
            if stage.total is None:
                self._draw("")
            else:
                self._draw(self._bar([stage]))
                self._write("\n")
            self._drawn, self._drawn_stage = "", None

    def close(self) -> None:
        """Leave nothing half-written."""
        with self._lock:
            self._draw("")

    def _bar(self, visible: list[Stage]) -> str:
        """Return the bar of the innermost stage that is counted, those around it before it, others after."""
        counted = max((i for i, each in enumerate(visible) if each.total is not None), default=None)
        if counted is None:
            return "; ".join(map(_phrase, visible))
        before, own, after = visible[:counted], visible[counted], visible[counted + 1 :]
        name = ", ".join([*(f"{each.name}{_counted(each)}" for each in before), own.name])
        rate = "" if own.rate is None else f", {own.rate:.3g} {own.unit}/s"
        also = rate + "".join(f"; {_phrase(each)}" for each in after)
        from tqdm import tqdm  # takes longer to import than the command line

        left = "?" if own.seconds_left is None else tqdm.format_interval(own.seconds_left)
        clocks = f"{tqdm.format_interval(own.seconds)}<{left}"
        counts = f"{own.done:,}/{own.total or 0:,} {own.unit} [{clocks}{also}]"
        return tqdm.format_meter(
            own.done,
            own.total or 0,
            own.seconds,
            ncols=_width(self._stream) - 1,
            prefix=name,
            bar_format="{l_bar}{bar}| " + counts.replace("{", "{{").replace("}", "}}"),
        )

    def _draw(self, text: str) -> None:
        """Write the one line again, or remove it."""
        if self._rewrites and text != self._drawn:
            text = text[: _width(self._stream) - 1]
            self._write("\r" + text.ljust(len(self._drawn)) + ("" if text else "\r"))
            self._drawn = text

    def _write(self, text: str) -> None:
        with suppress(OSError, ValueError):  # nobody reads it any more, which stops no work
            self._stream.write(text)
            self._stream.flush()


def _phrase(stage: Stage) -> str:
    """Return a stage in words: how far it is, or for how long it has run."""
    said = stage.detail()
    detail = f", {said}" if said else ""
    if stage.total is None:
        return f"{stage.name}: {_duration(stage.seconds)}{detail}"
    return f"{stage.name}:{_counted(stage)} {stage.unit}{_about(stage.seconds_left)}{detail}"


def _counted(stage: Stage) -> str:
    return "" if stage.total is None else f" {stage.done:,} of {stage.total:,}"


def _about(seconds: float | None) -> str:
    """Return the time that is left, in words; empty where it is not known."""
    return "" if seconds is None else f", about {_duration(seconds)} left"


def _duration(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 100 else f"{minutes / 60:.1f} h"


def _width(stream: Any) -> int:
    try:
        return os.get_terminal_size(stream.fileno()).columns or WIDTH
    except (OSError, ValueError, AttributeError):  # a notebook, or a window of Python's own
        return WIDTH


_shown = threading.Lock()
"""Held while something is shown: one display is enough."""
_displays: list[Display] = []
"""The display that is shown, if any."""


def clear_line() -> None:
    """Remove the line that is shown, so that other text can be written; the next tick shows it again."""
    for display in _displays:
        display.close()


@contextmanager
def progress_shown(*, in_logs: bool) -> Iterator[None]:
    """Show on standard error what this process is at within.

    Args:
        in_logs: whether it is shown too where that is no terminal and no notebook.
    """
    rewrites = _rewrites(sys.stderr)
    is_wanted = rewrites or (in_logs and sys.stderr is not None)
    if os.environ.get("TQDM_DISABLE") or not is_wanted or not _shown.acquire(blocking=False):
        yield
        return
    display, over = Display(sys.stderr, rewrites=rewrites), threading.Event()

    def keep_showing() -> None:
        while not over.wait(0.25 if rewrites else 1.0):
            display.tick()

    shower = threading.Thread(target=keep_showing, daemon=True)
    shower.start()
    stages.ended.append(display.ended)
    _displays.append(display)
    try:
        yield
    finally:
        _displays.remove(display)
        stages.ended.remove(display.ended)
        over.set()
        shower.join()
        display.close()
        _shown.release()


def _rewrites(stream: Any) -> bool:
    """Return whether a stream is a terminal's or a notebook's."""
    if stream is None or stream.closed:
        return False
    return stream.isatty() or type(stream).__module__.startswith("ipykernel.")


def shown_in_python(asked: bool | None) -> AbstractContextManager[None]:
    """Show what takes long: everywhere, nowhere, or by default in a terminal or a notebook alone."""
    return nullcontext() if asked is False else progress_shown(in_logs=asked is True)


stages.shown = shown_in_python
