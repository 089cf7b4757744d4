"""A stand-in for NVIDIA's driver: its memory is this process's, its threads run a built queue."""

import ctypes
import threading
from enum import IntEnum
from types import SimpleNamespace
from typing import Any

import numpy as np

from tests.helpers.queues import BuiltQueue


class Result(IntEnum):
    CUDA_SUCCESS = 0
    CUDA_ERROR_OUT_OF_MEMORY = 2
    CUDA_ERROR_NOT_READY = 600
    CUDA_ERROR_ILLEGAL_ADDRESS = 700


DONE = Result.CUDA_SUCCESS
ANSWERS = {
    "cuInit": (),
    "cuDeviceGet": (0,),
    "cuDeviceGetName": (b"NVIDIA Stand-in\0\0",),
    "cuDevicePrimaryCtxRetain": ("context",),
    "cuCtxSetCurrent": (),
    "cuCtxSetLimit": (),
    "cuModuleGetFunction": (b"queue",),
    "cuOccupancyMaxActiveBlocksPerMultiprocessor": (1,),
}
"""What it answers whatever it is told."""
KINDS: tuple[str, ...] = (
    "MULTIPROCESSOR_COUNT",
    "KERNEL_EXEC_TIMEOUT",
    "CLOCK_RATE",
    "COMPUTE_CAPABILITY_MAJOR",
    "COMPUTE_CAPABILITY_MINOR",
)


class Driver:
    """Answers as the driver of a card with one multiprocessor, on which one block of 128 threads fits."""

    CUresult = Result
    CUlimit = SimpleNamespace(CU_LIMIT_STACK_SIZE=0)
    CUjit_option = SimpleNamespace(CU_JIT_MAX_REGISTERS=0)
    CUdevice_attribute = SimpleNamespace(**{f"CU_DEVICE_ATTRIBUTE_{name}": name for name in KINDS})

    def __init__(
        self, queue: BuiltQueue, *, cards: int = 1, free: int = 1 << 34, capability: int = 9, watched: int = 0
    ) -> None:
        self.queue = ctypes.CDLL(str(queue.library)).queue
        self.queue.argtypes = [ctypes.c_void_p, ctypes.c_int64]
        self.cards, self.free = cards, free
        self.attributes = dict(zip(KINDS, (1, watched, 1, capability, 0), strict=True))
        self.launches, self.polls, self.fails = 0, 0, DONE
        self.memory: dict[int, Any] = {}
        self.loaded: list[tuple[Any, ...]] = []

    def __getattr__(self, name: str) -> Any:
        return lambda *_: (DONE, *ANSWERS[name])

    def cuDeviceGetCount(self) -> Any:
        return DONE, self.cards

    def cuDeviceGetAttribute(self, name: str, _device: int) -> Any:
        return DONE, self.attributes[name]

    def cuModuleLoadDataEx(self, *given: Any) -> Any:
        self.loaded.append(given)
        return DONE, "module"

    def cuMemGetInfo(self) -> Any:
        return DONE, self.free, self.free

    def cuMemAlloc(self, size: int) -> Any:
        if size > self.free:
            return Result.CUDA_ERROR_OUT_OF_MEMORY, 0
        room = np.zeros(size // 8 + 1, np.int64)
        self.memory[room.ctypes.data] = room
        return DONE, room.ctypes.data

    def cuMemFree(self, address: int) -> Any:
        del self.memory[address]
        return (DONE,)

    def cuMemcpyHtoD(self, to: int, array: Any, size: int) -> Any:
        ctypes.memmove(to, array.ctypes.data, size)
        return (DONE,)

    def cuMemcpyDtoH(self, array: Any, address: int, size: int) -> Any:
        ctypes.memmove(array.ctypes.data, address, size)
        return (DONE,)

    def cuMemsetD8(self, address: int, value: int, size: int) -> Any:
        ctypes.memset(address, value, size)
        return (DONE,)

    def cuLaunchKernel(self, queue: bytes, blocks: int, _1: int, _2: int, threads: int, *more: Any) -> Any:
        assert (queue, more[:4]) == (b"queue", (1, 1, 0, 0))
        (job,), _ = more[4]
        self.launches += 1
        working = [
            threading.Thread(target=self.queue, args=(job, number)) for number in range(blocks * threads)
        ]
        for thread in working:
            thread.start()
        for thread in working:
            thread.join()
        return (DONE,)

    def cuStreamQuery(self, _: int) -> Any:
        self.polls += 1
        return (Result.CUDA_ERROR_NOT_READY if self.polls % 3 else self.fails,)

    def cuGetErrorString(self, status: Result) -> Any:
        return DONE, status.name.encode()
