"""Bars that show on the terminal how far a job is."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Progress = Callable[[int, int], None]
"""Called after each part of a job with the number of parts done so far and of all."""


@contextmanager
def bar(name: str, unit: str, *, done: int = 0) -> Iterator[Progress]:
    """Return a function that shows progress as a bar on standard error, if that is a terminal.

    Args:
        name: of the job.
        unit: what its parts are.
        done: parts that were done before, which say nothing of its speed.
    """
    from tqdm import tqdm  # takes longer to import than the command line

    shown: tqdm | None = None

    def progress(done_now: int, whole: int) -> None:
        nonlocal shown
        if shown is None:
            shown = tqdm(desc=name, initial=done, total=whole, unit=f" {unit}", unit_scale=True, disable=None)
        shown.update(done_now - shown.n)

    try:
        yield progress
    finally:
        if shown is not None:
            shown.close()
