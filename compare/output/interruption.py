"""How Ctrl-C, SIGTERM and their like end the command: within a second, with one line, nothing half-made."""

import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import NoReturn

from cointoss.compare.output.language import in_options
from cointoss.models.stages import at_work, clear_line

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
SIGNALS: tuple[signal.Signals, ...] = tuple(getattr(signal, name) for name in _NAMES if hasattr(signal, name))
"""The signals that this system has; Ctrl-Break is Windows' own."""


class Interruption(SystemExit):
    """A signal that asks the command to end."""

    def __init__(self, number: int) -> None:
        """Keep the exit status and what to say: how far the innermost stage is that can say so."""
        super().__init__(128 + number)
        self.status = 128 + number
        self.name = f"interrupted by {signal.Signals(number).name}"
        self.message = ": ".join([self.name, *[said for each in at_work if (said := each.detail())][-1:]])


@contextmanager
def saying(say: Callable[[str], str]) -> Iterator[None]:
    """Let an interruption within the `with` statement say what `say` returns of its name."""
    try:
        yield
    except Interruption as interruption:
        interruption.message = say(interruption.name)
        raise


def run_to_exit(command: Callable[[], object]) -> NoReturn:
    """Run a command; where a signal comes, let it clean up, and end the process.

    A command ends by raising SystemExit. The first signal raises `Interruption` on the main thread, which
    leaves long compiled code to another, see `cointoss.models.interruptible`; later signals are ignored.
    A signal that is ignored before, as under nohup, stays so.
    """
    raised: list[Interruption] = []

    def interrupt(number: int, _frame: object) -> NoReturn:
        for each in SIGNALS:
            signal.signal(each, signal.SIG_IGN)
        # A call from C prints what is raised in it, and goes on: the process ends all the same.
        sys.unraisablehook = lambda _: None
        raised.append(Interruption(number))
        raise raised[0]

    heeded = [number for number in SIGNALS if signal.getsignal(number) != signal.SIG_IGN]
    for number in heeded:
        signal.signal(number, interrupt)
    try:
        command()
    finally:
        # What a signal raised may have become another error on its way, or been lost in a call from C.
        if raised:
            _leave(raised[0])
        for number in heeded:
            signal.signal(number, signal.SIG_DFL)
    sys.exit()


def _leave(interruption: Interruption) -> NoReturn:
    """Say what ends the process, and end it, whatever its other threads are at."""
    with suppress(Exception):  # where nobody reads it any more
        clear_line()
        print(f"cointoss: {in_options(interruption.message)}", file=sys.stderr, flush=True)
    with suppress(Exception):
        sys.stdout.flush()
    os._exit(interruption.status)
