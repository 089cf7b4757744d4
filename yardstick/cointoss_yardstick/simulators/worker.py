"""Serves an engine over standard input and output; needs NumPy alone, so that any Python may run it.

A message is its length, 8 bytes, and an .npz file of arrays without Python objects.
"""

import io
import json
import os
import struct
import sys
import threading
import time
import traceback
from pathlib import Path
from pkgutil import resolve_name
from types import SimpleNamespace
from typing import Any, BinaryIO

import numpy as np

SIZE = struct.Struct("<q")


def read_message(stream: BinaryIO) -> "dict[str, np.ndarray] | None":
    """Return the next message, None at the end of the stream."""
    head = stream.read(SIZE.size)
    if len(head) < SIZE.size:
        return None
    with np.load(io.BytesIO(stream.read(*SIZE.unpack(head))), allow_pickle=False) as arrays:
        return {name: arrays[name] for name in arrays.files}


def write_message(stream: BinaryIO, **arrays: Any) -> None:
    """Write a message."""
    packed = io.BytesIO()
    np.savez(packed, **arrays)
    stream.write(SIZE.pack(packed.tell()) + packed.getvalue())
    stream.flush()


STATE = ("position", "quaternion", "velocity", "angular_velocity")
"""What an engine returns: see `cointoss.States`."""
MORE = ("time", "impact_time", "impact_impulse", "stiffness")
"""What it may return: the times of its states, and of its impacts, (k,), with their impulses, (k, 3); the
stiffness of its contact [N/m]."""


def about(engine: Any) -> "dict[str, Any]":
    """Return what an engine says of itself: `name`, `dt` and `settings`, of which it may lack any.

    Raises:
        TypeError: for an engine without a function `simulate`, or with other values.
    """
    if not callable(getattr(engine, "simulate", None)):
        raise TypeError(f"{_name(engine)}: has no function simulate(scenario, times)")
    dt, settings = getattr(engine, "dt", None), getattr(engine, "settings", {})
    if dt is not None and not (isinstance(dt, (int, float)) and 0 < dt < 1):
        raise TypeError(f"dt = {dt!r}: accepted: a step above 0 and below 1 s, or none")
    if not isinstance(settings, dict):
        raise TypeError(f"settings: of type {type(settings).__name__}, accepted: a dict")
    told = {
        str(key): value if isinstance(value, (int, float)) else str(value) for key, value in settings.items()
    }
    return {"name": str(getattr(engine, "name", _name(engine))), "dt": dt, "settings": told}


def _name(engine: Any) -> str:
    return getattr(engine, "__name__", type(engine).__name__)


def simulated(engine: Any, scenario: Any, times: np.ndarray, dt: "float | None") -> "dict[str, np.ndarray]":
    """Return an engine's states by name, made with a step where it has one, and the `processor_time` [s].

    Raises:
        TypeError: for an answer of another kind.
    """
    kept = getattr(engine, "dt", None)
    if dt is not None:
        engine.dt = dt
    begun = time.process_time()
    try:
        answer = engine.simulate(scenario, times)
    finally:
        if dt is not None:
            engine.dt = kept
    if isinstance(answer, (tuple, list)) and len(answer) == len(STATE):
        answer = dict(zip(STATE, answer, strict=True))
    parts: Any = answer if isinstance(answer, dict) else getattr(answer, "__dict__", {})
    missing = [name for name in STATE if name not in parts]
    if missing:
        raise TypeError(
            f"simulate returned {type(answer).__name__} without {missing[0]}, accepted: {', '.join(STATE)}, "
            "by name or in this order"
        )
    names = [name for name in (*STATE, *MORE) if name in parts]
    columns = {name: np.asarray(parts[name], dtype=float) for name in names}
    return columns | {"processor_time": np.array(time.process_time() - begun)}


def scenario_of(text: str) -> Any:
    """Return the scenario of a message: a `Scenario` of cointoss, or, without cointoss, its fields as
    attributes."""
    told = json.loads(text)
    try:
        from cointoss import Scenario
    except ImportError:
        scenario = json.loads(text, object_hook=lambda table: SimpleNamespace(**table)).tables
        scenario.coin.moments, scenario.release.attitude = told["moments"], told["attitude"]
        return scenario
    return Scenario.checked(told["tables"])


def failure(error: BaseException) -> "dict[str, str]":
    """Return an error as a message: `unsupported` is what the engine can't do, `failed` anything else."""
    kinds = {kind.__name__ for kind in type(error).__mro__}
    if kinds & {"NotImplementedError", "UnsupportedError"}:
        return {"unsupported": str(error)}
    frames = traceback.extract_tb(error.__traceback__)
    where = f" ({Path(frames[-1].filename).name}:{frames[-1].lineno})" if frames else ""
    return {"failed": f"{type(error).__name__}: {error}{where}"}


def end_with(parent: int) -> None:
    """End this process once its parent has ended, however that ends, and whatever an engine does."""
    while os.getppid() == parent:
        time.sleep(0.5)
    os._exit(1)


def serve(path: str) -> None:
    """Answer what is asked of the engine that a path names, until standard input ends."""
    taken, given = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what an engine prints is no message
    threading.Thread(target=end_with, args=(os.getppid(),), daemon=True).start()
    sys.path[0] = str(Path.cwd())
    try:
        engine = resolve_name(path)
        engine = engine() if isinstance(engine, type) else engine
        write_message(given, about=json.dumps(about(engine)))
    except Exception as error:  # told to the one who asks
        write_message(given, **failure(error))
        return
    while (asked := read_message(taken)) is not None:
        try:
            dt = float(asked["dt"])
            answer = simulated(engine, scenario_of(str(asked["scenario"])), asked["times"], dt or None)
        except Exception as error:  # told to the one who asks
            answer = failure(error)
        write_message(given, **answer)


if __name__ == "__main__":
    serve(sys.argv[1])
