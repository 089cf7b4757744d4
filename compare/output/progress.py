"""Bars that show on the terminal how far a job is."""

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from models.kernel.compiling import compiling

Progress = Callable[[int, int], None]
"""Called after each part of a job with the number of parts done so far and of all."""
STILL_TOSSING = "still tossing; Ctrl-C ends it"


@contextmanager
def bar(name: str, unit: str, *, done: int = 0) -> Iterator[Progress]:
    """Return a function that shows progress as a bar on standard error, if that is a terminal.

    Args:
        name: of the job.
        unit: what its parts are.
        done: parts that were done before, which say nothing of its speed; nor does the time to compile.
    """
    from tqdm import tqdm  # takes longer to import than the command line

    shown: tqdm | None = None
    compiled, over = compiling.seconds, threading.Event()

    def keep_time() -> None:
        while not over.wait(1.0):
            if shown is not None:
                shown.refresh()

    def progress(done_now: int, whole: int) -> None:
        nonlocal shown, compiled
        if shown is None:
            shown = tqdm(desc=name, initial=done, total=whole, unit=f" {unit}", unit_scale=True, disable=None)
        elif not shown.disable:
            shown.start_t += compiling.seconds - compiled
            shown.last_print_t += compiling.seconds - compiled
        compiled = compiling.seconds
        shown.update(done_now - shown.n)

    if _shows():
        threading.Thread(target=keep_time, daemon=True).start()
    try:
        yield progress
    finally:
        over.set()
        if shown is not None:
            shown.close()


@contextmanager
def elapsed_time(name: str, after: float = 5.0) -> Iterator[None]:
    """Show within, on standard error if that is a terminal, for how long a job has run.

    Args:
        name: of the job.
        after: as soon as it takes longer than this [s].
    """
    if not _shows():
        yield
        return
    over = threading.Event()

    def show() -> None:
        if over.wait(after):
            return
        from tqdm import tqdm

        with tqdm(desc=name, bar_format="{desc}: {elapsed}", leave=False, delay=after) as shown:
            shown.start_t -= after
            while not over.wait(1.0):
                shown.refresh()

    shower = threading.Thread(target=show, daemon=True)
    shower.start()
    try:
        yield
    finally:
        over.set()
        shower.join()


@contextmanager
def compile_bar(after: float = 1.0) -> Iterator[None]:
    """Say within, on standard error if that is a terminal, that functions are compiled, and how many.

    Args:
        after: as soon as it takes longer than this [s].
    """
    shown: Any = None
    said = False

    def watch() -> None:
        nonlocal shown, said
        if not compiling.now:
            if shown is not None:
                shown.close()
            shown = None
        elif shown is not None:
            shown.update(compiling.begun - shown.n)
        elif compiling.seconds > after:
            from tqdm import tqdm

            if not said:
                tqdm.write("cointoss: compiling, once and for up to a minute", file=sys.stderr)
            said = True
            shown = tqdm(
                desc="compiling",
                initial=compiling.begun,
                total=max(compiling.declared, compiling.begun),
                unit=" functions",
                leave=False,
            )

    if not _shows():
        yield
        return
    compiling.watchers.append(watch)
    try:
        yield
    finally:
        compiling.watchers.remove(watch)
        if shown is not None:
            shown.close()


def _shows() -> bool:
    """Return whether standard error is a terminal."""
    return sys.stderr is not None and not sys.stderr.closed and sys.stderr.isatty()
