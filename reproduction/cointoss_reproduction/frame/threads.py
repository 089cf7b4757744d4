"""Work on all cores, which an interruption ends soon."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from os import cpu_count


@contextmanager
def all_cores() -> Iterator[ThreadPoolExecutor]:
    """Give a pool of as many threads as there are cores; what it has not begun at its end is given up."""
    pool = ThreadPoolExecutor(cpu_count())
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)
