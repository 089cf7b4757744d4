"""Work that a signal, such as Ctrl-C, may interrupt while compiled code runs."""

import contextvars
import threading
from collections.abc import Callable, Iterable
from concurrent.futures import Future, wait
from typing import Any, TypeVar

Result = TypeVar("Result")
HEEDED = 0.25
"""After how long a signal is heeded at the latest while the main thread waits [s]."""


def interruptible(work: Callable[[], Result]) -> Result:
    """Return what `work` returns; raise what it raises.

    Python handles signals on the main thread alone, between two of its own instructions, so not while
    compiled code runs there. The work is done on another thread instead, for which the main thread waits.
    Where a signal's handler raises, the wait ends at once; the work goes on unheeded until it or the process
    ends.
    """
    if threading.current_thread() is not threading.main_thread():
        return work()
    future = begun(work)
    await_all([future])
    return future.result()


def await_all(futures: Iterable[Future[Any]]) -> None:
    """Wait until all are done; a signal is heeded meanwhile, on Windows too, where it ends no single wait."""
    while wait(futures, timeout=HEEDED).not_done:
        pass


def begun(work: Callable[[], Result]) -> Future[Result]:
    """Return the future result of `work`, begun on a thread that does not keep the process from ending."""
    future: Future[Result] = Future()
    # numpy's treatment of errors, and in later Pythons that of warnings, belongs to the context.
    context = contextvars.copy_context()

    def run() -> None:
        try:
            future.set_result(context.run(work))
        except BaseException as error:
            future.set_exception(error)

    threading.Thread(target=run, daemon=True).start()
    return future
