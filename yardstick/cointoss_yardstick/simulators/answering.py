"""Who answers for an engine: an object in this process, or a process of its own, each within a time limit."""

import ctypes
import json
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any, BinaryIO, cast

import numpy as np

from cointoss import Scenario, UnsupportedError, UnusableEngineError
from cointoss.study import Array
from cointoss_yardstick.simulators import worker

Message = Mapping[str, Any]


class Called:
    """An object that is called in a thread of this process."""

    def __init__(self, engine: Any, limit: float) -> None:
        """Keep the engine.

        Raises:
            TypeError: for an object that is no engine.
        """
        self._engine, self._limit = engine, limit
        self.about = worker.about(engine)

    def states(self, scenario: Scenario, times: Array, dt: float | None) -> Message:
        """Return the arrays of `States` that the engine gives, by name.

        Raises:
            UnsupportedError: for what the engine says that it can't do.
            UnusableEngineError: where it fails, or takes too long.
        """

        def call() -> Message:
            try:
                return worker.simulated(self._engine, scenario, times, dt)
            except (Exception, SystemExit, KeyboardInterrupt) as error:  # raised again where it is waited for
                return worker.failure(error)

        return _refused(_within(self._limit, call, self.about["name"]), self.about["name"])

    def close(self) -> None:
        """Leave the object to its owner."""


class Served:
    """An engine in a process of its own, by this Python or another; what takes too long is ended."""

    def __init__(self, path: str, limit: float, python: str = sys.executable) -> None:
        """Start it.

        Args:
            path: of the engine, as in "package.module:name", for that Python in this folder.
            limit: of each answer [s].
            python: which runs it; it needs NumPy, and not cointoss.

        Raises:
            UnusableEngineError: for an engine that can't be started.
        """
        self._path, self._limit, self._python = path, limit, python
        self._start()

    def _start(self) -> None:
        self._open = ExitStack()
        self._process, self._said = self._open.enter_context(_started(self._python, self._path))
        try:
            self.about: Message = json.loads(str(_refused(self._answer(), self._path)["about"]))
        except BaseException:
            self.close()
            raise

    def states(self, scenario: Scenario, times: Array, dt: float | None) -> Message:
        """Return the engine's states; see `Called.states`."""
        if self._process.poll() is not None:
            self.close()
            self._start()
        stream = cast("BinaryIO", self._process.stdin)
        told = {
            "tables": scenario.model_dump(mode="json"),
            "moments": scenario.coin.moments,
            "attitude": scenario.release.attitude,
        }
        try:
            worker.write_message(stream, scenario=json.dumps(told), times=times, dt=dt or 0.0)
        except BrokenPipeError:
            raise UnusableEngineError(f"{self.about['name']}: {self._ended()}") from None
        return _refused(self._answer(), self.about["name"])

    def _answer(self) -> Message:
        stream = cast("BinaryIO", self._process.stdout)
        try:
            answer = _within(self._limit, lambda: worker.read_message(stream), self._path)
        except BaseException:
            self.close()
            raise
        if answer is None:
            raise UnusableEngineError(f"{self._path}: {self._ended()}")
        return answer

    def _ended(self) -> str:
        status = self._process.wait()
        said = self._said.read_text(errors="replace").strip().splitlines()
        return f"its process ended with status {status}{f': {said[-1]}' if said else ''}"

    def close(self) -> None:
        """End the process."""
        with suppress(BrokenPipeError):  # of what it did not read
            self._open.close()


Answering = Called | Served
"""Answers for an engine: its `about` has the `name`, the step `dt` [s] or None, and the `settings`."""


@contextmanager
def _started(python: str, path: str) -> Iterator[tuple["subprocess.Popen[bytes]", Path]]:
    """Start the process of an engine, and end it after; yield it, and the file of what it says."""
    with tempfile.TemporaryDirectory() as folder:
        said = Path(folder) / "said"
        command = [python, worker.__file__, path]
        try:
            with (
                said.open("wb") as stream,
                subprocess.Popen(
                    command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=stream
                ) as process,
            ):
                try:
                    yield process, said
                finally:
                    process.kill()
        except (FileNotFoundError, PermissionError, NotADirectoryError) as error:
            why = f"{python}: can't be run ({error.strerror}); accepted: a Python"
            raise UnusableEngineError(why) from None


class _Ended(BaseException):
    """Ends a call that takes too long."""


def _within(limit: float, call: Callable[[], Any], name: str) -> Any:
    """Return what a call returns within a time [s]; end it otherwise.

    Raises:
        UnusableEngineError: for a call that takes longer.
    """
    answers: SimpleQueue[Any] = SimpleQueue()

    def wait() -> None:
        with suppress(_Ended):
            answers.put(call())

    thread = threading.Thread(target=wait, daemon=True)
    thread.start()
    try:
        return answers.get(timeout=limit)
    except Empty:
        # Python's own loops end so; a call into a library goes on until it returns.
        ended = ctypes.py_object(_Ended)
        ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident or 0), ended)
        raise UnusableEngineError(f"{name}: no answer within {limit:g} s; ended") from None


def _refused(answer: Message, name: str) -> Message:
    """Return an answer that is no failure.

    Raises:
        UnsupportedError: for what the engine can't do.
        UnusableEngineError: for what failed.
    """
    if "unsupported" in answer:
        raise UnsupportedError(str(answer["unsupported"]))
    if "failed" in answer:
        raise UnusableEngineError(f"{name}: {np.asarray(answer['failed'])}")
    return answer
