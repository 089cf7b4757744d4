"""Many tosses cut into tiles, made on all cores."""

from collections import deque
from collections.abc import Callable
from concurrent.futures import wait

from cointoss.models.cores import cores_used
from cointoss.models.interruptible import await_all, begun

PARTS = 4
"""Tiles that each of several threads has at least, of tosses enough: all end at about the same time."""
PATIENCE = 1.0
"""How long an interruption waits for the tiles under way [s]."""


def in_tiles(n: int, most: int, work: Callable[[slice], None], workers: int | None = None) -> None:
    """Do work on n rows, tile by tile, on several threads.

    A signal's handler that raises ends it: what was begun goes on unheeded for its tile, and no other begins.

    Args:
        n: number of rows.
        most: rows of a tile, at most.
        work: done on each tile's rows; it should not hold Python's lock.
        workers: number of threads, by default that of `cores_used`.
    """
    threads = workers or cores_used()
    tile = min(most, max(1, n // (PARTS * threads))) if threads > 1 else most
    left = deque(range(0, n, tile))

    def work_on_what_is_left() -> None:
        while True:
            try:
                first = left.popleft()
            except IndexError:
                return
            try:
                work(slice(first, min(first + tile, n)))
            except BaseException:
                left.clear()
                raise

    working = [begun(work_on_what_is_left) for _ in range(min(len(left), threads))]
    try:
        await_all(working)
    except KeyboardInterrupt:
        left.clear()
        wait(working, timeout=PATIENCE)
        raise
    finally:
        left.clear()
    for each in working:
        each.result()
