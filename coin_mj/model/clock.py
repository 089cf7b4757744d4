"""MuJoCo's clock, which its functions read to time themselves, stopped while coins are tossed."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import ctypes
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from cointoss.coin_mj.model.library import PATH

_clock = ctypes.c_void_p.in_dll(ctypes.CDLL(PATH), "mjcb_time")


class _Users:
    """How many are inside `clock_stopped`, and the clock before the first of them."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.count = 0
        self.before: int | None = None


_users = _Users()


@contextmanager
def clock_stopped() -> Iterator[None]:
    """Stop the clock of this process's MuJoCo: reading it takes up to a quarter of the time of a toss.

    MuJoCo's timers stand still within. The last who leaves puts the clock back.
    """
    with _users.lock:
        if _users.count == 0:
            _users.before, _clock.value = _clock.value, None
        _users.count += 1
    try:
        yield
    finally:
        with _users.lock:
            _users.count -= 1
            if _users.count == 0:
                _clock.value = _users.before
