"""An NVIDIA card whose threads work on a queue of rows; NVIDIA's own package is imported here alone."""

import ctypes
import threading
import time
from contextlib import ExitStack, nullcontext
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.models.interruptible import interruptible
from cointoss.models.kernel.arrays import Array
from cointoss.models.stages import stage

PER_BLOCK = 128
"""Threads of a block."""
REGISTERS = 128
"""Registers of a thread. With 168 or 255 of them ptxas 13 makes code that writes where it should not."""
KINDS = {"sm_90": (9, 0)}
"""The kinds of cards whose machine code a library has, Hopper's, and their capabilities.

For any other the driver compiles the library's PTX when it is first loaded, and keeps what it made.
"""
STACK = 16 << 10
"""Bytes of a thread's stack."""
MOST_ROWS = 1 << 22
"""Rows that are on the card at a time, at most."""
POLL = 2e-4
"""How often it is asked whether the threads have ended [s]; Ctrl-C is heeded between."""
SHORT, LONG = (0.5, 1.5), (5.0, 20.0)
"""How long threads take rows, and after how long what they still work on is left [s].

The first where a display's watchdog ends what runs for longer.
"""


class QueueJob(NamedTuple):
    """What the threads of a queue share; the numbers that the entry is given for a row follow it."""

    there: int
    """How many rows there are."""
    next: int
    """Number of the row that is taken next; the threads count it up."""
    rows: int
    """Their address."""
    row_size: int
    answers: int
    answer_size: int
    spaces: int
    """The address of the threads' work spaces."""
    space_size: int
    takes_for: int
    """For how many ticks of its clock a thread takes rows."""
    closes_after: int
    """After how many ticks a thread's work space is closed."""
    given: int
    """How many numbers the entry is given."""

    def with_numbers(self, numbers: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the numbers of the job, and what the entry is given."""
        return np.array([*self, *numbers.tolist()], dtype=np.int64)


class CardError(RuntimeError):
    """There is no card that can be used, or it has failed; the message says why."""


class GraphicsCard:
    """The first card that CUDA shows, with one queue at a time."""

    def __init__(self) -> None:
        """Open the card.

        Raises:
            ModuleNotFoundError: without NVIDIA's package.
            CardError: without its driver, or a card.
        """
        self._cuda = _driver()
        self._lock = threading.Lock()
        self._queues: dict[Path, Any] = {}
        self._done("the driver", self._cuda.cuInit(0))
        count = self._done("the driver", self._cuda.cuDeviceGetCount())
        if count == 0:
            raise CardError("CUDA shows no card")
        self._device = self._done("the card", self._cuda.cuDeviceGet(0))
        name = self._done("the card", self._cuda.cuDeviceGetName(100, self._device))
        self.name: str = name.split(b"\0")[0].decode()
        self._context = self._done("the card", self._cuda.cuDevicePrimaryCtxRetain(self._device))
        kinds = self._cuda.CUdevice_attribute
        self._multiprocessors = self._attribute(kinds.CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT)
        is_watched = self._attribute(kinds.CU_DEVICE_ATTRIBUTE_KERNEL_EXEC_TIMEOUT)
        ticks = self._attribute(kinds.CU_DEVICE_ATTRIBUTE_CLOCK_RATE) * 1000
        self._takes_for, self._closes_after = (int(ticks * each) for each in (SHORT if is_watched else LONG))
        self._has_code = (
            self._attribute(kinds.CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR),
            self._attribute(kinds.CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR),
        ) in KINDS.values()

    def work(self, file: Path, numbers: NDArray[np.int64], rows: Array, answers: Array, space: int) -> None:
        """Have an engine's queue work on rows; NaN is left in the first answer of those that it can't do.

        Args:
            file: the engine's code for cards.
            numbers: what the entry is given for one row.
            rows: (n, m).
            answers: where its answers go, (n, k).
            space: bytes of a thread's work space.

        Raises:
            CardError: where the card fails; whole answers may have been written by then.
        """
        with self._lock:
            self._done("the card", self._cuda.cuCtxSetCurrent(self._context))
            queue = self._queue(file)
            with ExitStack() as taken:
                blocks = self._blocks(queue, space)
                spaces = self._memory(blocks * PER_BLOCK * space, taken)
                most = self._most_rows(rows.itemsize * (rows.shape[1] + answers.shape[1]))
                there = min(most, len(rows))
                at_rows = self._memory(there * rows[0].nbytes, taken)
                at_answers = self._memory(there * answers[0].nbytes, taken)
                at_job = self._memory(8 * (len(QueueJob._fields) + len(numbers)), taken)
                for first in range(0, len(rows), there):
                    some = slice(first, min(first + there, len(rows)))
                    job = QueueJob(
                        there=some.stop - first,
                        next=0,
                        rows=at_rows,
                        row_size=rows[0].nbytes,
                        answers=at_answers,
                        answer_size=answers[0].nbytes,
                        spaces=spaces,
                        space_size=space,
                        takes_for=self._takes_for,
                        closes_after=self._closes_after,
                        given=len(numbers),
                    )
                    self._work_on(queue, blocks, at_job, job, numbers, rows[some], answers[some])

    def _work_on(
        self,
        queue: Any,
        blocks: int,
        at: int,
        job: QueueJob,
        numbers: NDArray[np.int64],
        rows: Array,
        answers: Array,
    ) -> None:
        cuda, shared = self._cuda, job.with_numbers(numbers)
        self._done("its memory", cuda.cuMemcpyHtoD(job.rows, rows, rows.nbytes))
        self._done("its memory", cuda.cuMemsetD8(job.answers, 0xFF, answers.nbytes))  # numbers that are none
        self._done("its memory", cuda.cuMemcpyHtoD(at, shared, shared.nbytes))
        while shared[1] < job.there:
            given = ((at,), (ctypes.c_void_p,))
            launched = cuda.cuLaunchKernel(queue, blocks, 1, 1, PER_BLOCK, 1, 1, 0, 0, given, 0)
            self._done("its threads", launched)
            while (state := cuda.cuStreamQuery(0))[0] == cuda.CUresult.CUDA_ERROR_NOT_READY:
                time.sleep(POLL)
            self._done("its threads", state)
            self._done("its memory", cuda.cuMemcpyDtoH(shared, at, shared.nbytes))
        self._done("its memory", cuda.cuMemcpyDtoH(answers, job.answers, answers.nbytes))

    def _queue(self, file: Path) -> Any:
        """Return the queue of a library, loaded at its first use."""
        if file not in self._queues:
            cuda, loading = self._cuda, f"loading {file.name}"
            self._done(loading, cuda.cuCtxSetLimit(cuda.CUlimit.CU_LIMIT_STACK_SIZE, STACK))
            options = [cuda.CUjit_option.CU_JIT_MAX_REGISTERS], [REGISTERS]
            compiling = f"NVIDIA's driver compiles the engine for {self.name}, once"

            def load() -> Any:
                self._done("the card", cuda.cuCtxSetCurrent(self._context))  # of each thread its own
                return self._done(loading, cuda.cuModuleLoadDataEx(file.read_bytes(), 1, *options))

            with nullcontext() if self._has_code else stage(compiling, shown=True):
                module = interruptible(load)
            self._queues[file] = self._done(loading, cuda.cuModuleGetFunction(module, b"queue"))
        return self._queues[file]

    def _blocks(self, queue: Any, space: int) -> int:
        """Return how many blocks of threads work at a time; half of the free memory has room for them."""
        at_once = self._done(
            "its threads", self._cuda.cuOccupancyMaxActiveBlocksPerMultiprocessor(queue, PER_BLOCK, 0)
        )
        fitting = self._free() // 2 // (PER_BLOCK * space)
        if (blocks := min(at_once * self._multiprocessors, fitting)) < 1:
            raise CardError(f"{self.name}: too little memory is free, {self._free() >> 20} MiB")
        return blocks

    def _most_rows(self, size: int) -> int:
        return max(1, min(MOST_ROWS, self._free() // 2 // size))

    def _memory(self, size: int, taken: ExitStack) -> int:
        """Return the address of so many bytes, given back with all that is taken.

        What a card that has failed says then is not asked.
        """
        address = self._done("its memory", self._cuda.cuMemAlloc(size))
        taken.callback(self._cuda.cuMemFree, address)
        return int(address)

    def _free(self) -> int:
        return self._done("its memory", self._cuda.cuMemGetInfo())[0]

    def _attribute(self, kind: Any) -> int:
        return self._done("the card", self._cuda.cuDeviceGetAttribute(kind, self._device))

    def _done(self, what: str, answer: tuple[Any, ...]) -> Any:
        """Return what a call of the driver returns.

        Raises:
            CardError: where it failed.
        """
        status, *values = answer
        if status != self._cuda.CUresult.CUDA_SUCCESS:
            text = self._cuda.cuGetErrorString(status)[1]
            raise CardError(f"{what}: {text.decode() if text else status}")
        return values[0] if len(values) == 1 else tuple(values)


@cache
def card() -> GraphicsCard:
    """Return the first card that CUDA shows, opened once.

    Raises:
        ModuleNotFoundError: without NVIDIA's package.
        CardError: where there is none that can be used.
    """
    return GraphicsCard()


def _driver() -> Any:
    """Return the functions of NVIDIA's driver.

    Raises:
        ModuleNotFoundError: without NVIDIA's package.
        CardError: without the driver.
    """
    driver: Any = import_module("cuda.bindings.driver")
    try:
        driver.cuInit(0)
    except RuntimeError:
        raise CardError("there is no driver of NVIDIA's") from None
    return driver
