"""Work on all cores, which an interruption ends soon."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from os import cpu_count


@contextmanager
def all_cores() -> Iterator[ThreadPoolExecutor]:
    """Yield a pool with a thread for each core; at its end it cancels the work that it has not begun."""
    pool = ThreadPoolExecutor(cpu_count())
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)
