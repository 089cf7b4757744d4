"""How Ctrl-C, SIGTERM and their like end the command: within a second, with one line, nothing half-made."""

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import NoReturn

from cointoss.compare.output.language import in_options
from cointoss.models.stages import at_work, clear_line

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
SIGNALS: tuple[signal.Signals, ...] = tuple(getattr(signal, name) for name in _NAMES if hasattr(signal, name))
"""The signals that this system has; Ctrl-Break is Windows' own."""
SOON = 0.1
"""How long after a child process stopped the signal that stopped it may be heeded here [s]."""
PATIENCE = 0.3
"""How long the main thread may take to end, before another thread ends the process [s]."""

_pending: list[Callable[[], None]] = []
"""What is to be undone where the process ends."""


class Interruption(SystemExit):
    """A signal that asks the command to end."""

    def __init__(self, number: int) -> None:
        """Keep the exit status and what to say: how far the innermost stage is that can say so."""
        super().__init__(128 + number)
        self.status = 128 + number
        self.name = f"interrupted by {signal.Signals(number).name}"
        self.message = ": ".join([self.name, *[said for each in at_work if (said := each.detail())][-1:]])


@contextmanager
def undoing(undo: Callable[[], None]) -> Iterator[None]:
    """Call `undo` when the `with` statement ends, also where a signal ends the process within it.

    Args:
        undo: may be called twice, and on another thread.
    """
    _pending.append(undo)
    try:
        yield
    finally:
        undo()
        _pending.remove(undo)


@contextmanager
def saying(say: Callable[[str], str]) -> Iterator[None]:
    """Let an interruption within the `with` statement say what `say` returns of its name."""
    try:
        yield
    except Interruption as interruption:
        interruption.message = say(interruption.name)
        raise


def arisen_from(error: BaseException) -> Iterator[BaseException]:
    """Yield an error, and those from which it arose."""
    behind: BaseException | None = error
    while behind is not None:
        yield behind
        behind = behind.__context__


def raise_interruption_behind(error: BaseException) -> None:
    """Raise the interruption that an error arose from; return where there is none.

    Ctrl-C ends a child process too, and its complaint may come before the signal is heeded here.
    """
    for behind in arisen_from(error):
        if isinstance(behind, KeyboardInterrupt | SystemExit):
            raise behind from None
    try:
        time.sleep(SOON)
    except (KeyboardInterrupt, SystemExit) as interruption:
        raise interruption from None


def run_to_exit(command: Callable[[], object]) -> NoReturn:
    """Run a command; where a signal comes, let it clean up, and end the process.

    A command ends by raising SystemExit. The signal raises `Interruption` on the main thread. A thread of its
    own learns of it too, even while the main thread is in a long call of compiled code, and ends the process
    if the main thread does not within `PATIENCE`. A signal that is ignored, as under nohup, stays so.
    """
    heeded = [number for number in SIGNALS if signal.getsignal(number) != signal.SIG_IGN]
    ending = _Ending()
    try:
        try:
            for number in heeded:
                signal.signal(number, ending.interrupt)
            reading, writing = os.pipe()
            if sys.platform != "win32":  # there a pipe that blocks will do
                os.set_blocking(writing, False)
            signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
            threading.Thread(target=ending.watch, args=(reading,), daemon=True).start()
            command()
        finally:
            if ending.interruption is None:
                for number in heeded:
                    signal.signal(number, signal.SIG_DFL)
    finally:
        # What a signal raised may have become another error on its way, or been lost in a call from C.
        if ending.interruption is not None:
            ending.leave(ending.interruption)
    sys.exit()


class _Ending:
    """The end of a process by a signal."""

    def __init__(self) -> None:
        self.interruption: Interruption | None = None
        self._leaving = threading.Lock()

    def interrupt(self, number: int, _frame: object) -> NoReturn:
        """Raise the interruption; it is the handler of the signals, of which the first counts."""
        for each in SIGNALS:
            signal.signal(each, signal.SIG_IGN)
        # A call from C prints what is raised in it, and goes on: `run_to_exit` ends the process all the same.
        sys.unraisablehook = lambda _: None
        self.interruption = Interruption(number)
        raise self.interruption

    def watch(self, reading: int) -> None:
        """End the process some time after the first of the signals, whose numbers come through a pipe."""
        number = 0
        while number not in SIGNALS:
            number = os.read(reading, 1)[0]
        time.sleep(PATIENCE)
        self.leave(self.interruption or Interruption(number))

    def leave(self, interruption: Interruption) -> NoReturn:
        """Undo what is half-made, say what ends the process, and end it, whatever its threads are at."""
        if self._leaving.acquire(blocking=False):
            for undo in reversed(_pending):
                with suppress(Exception):
                    undo()
            with suppress(Exception):
                clear_line()
                print(f"cointoss: {in_options(interruption.message)}", file=sys.stderr, flush=True)
            with suppress(Exception):
                sys.stdout.flush()
        else:
            time.sleep(PATIENCE)  # for the other thread, which is at it
        os._exit(interruption.status)
