"""A map tossed on a Dask cluster is that tossed here, even where a worker is lost."""

import importlib
import json
import socket
import subprocess
import sys
import threading

import distributed
import pytest
from distributed.comm.core import CommClosedError

from cointoss.compare.sweep.cluster import naming_loss
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.distribution import DISTRIBUTION
from tests.helpers.basin_runs import (
    AXES,
    assert_same,
    basin,
    begun,
    pixels,
    wait_for,
    whole_tiles,
)
from tests.helpers.processes import HANGS, answered, started, wait_until


@pytest.fixture
def cluster(tmp_path):
    """A scheduler and two workers as processes; gives its address and the workers."""
    address = tmp_path / "scheduler.json"
    local = ("--scheduler-file", address, "--no-dashboard")
    worker = ("worker", *local, "--nthreads", "1", "--no-nanny", "--local-directory", tmp_path)
    with _started("scheduler", *local, "--host", "127.0.0.1", "--port", "0") as scheduler:
        wait_until(scheduler, lambda: address.exists() and address.read_text().endswith("}"))
        with _started(*worker) as one, _started(*worker) as other:
            where = json.loads(address.read_text())["address"]
            with distributed.Client(where, set_as_default=False) as client:
                client.wait_for_workers(2, timeout=HANGS)
            yield where, (one, other)


def _started(part, *arguments):
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return started("-m", f"distributed.cli.dask_{part}", *arguments, **quiet)


@pytest.mark.long
def test_a_worker_that_is_lost_on_the_way_changes_no_pixel(cluster, coin, tmp_path):
    (address, workers), out = cluster, tmp_path / "map.zarr"
    with begun(coin, out, "--scheduler", address) as process:
        wait_for(process, out, 4)
        workers[0].kill()
        at_the_loss = whole_tiles(out)
        _, said = answered(process)
    assert process.returncode == 0, said
    assert at_the_loss < whole_tiles(out)
    assert workers[1].poll() is None
    assert basin(coin, *AXES, "--out", tmp_path / "here.zarr").exit_code == 0
    assert_same(out, pixels(tmp_path / "here.zarr"))


@pytest.fixture
def silent():
    """The address of a server that lets everyone connect and answers nothing."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield f"tcp://127.0.0.1:{server.getsockname()[1]}"


@pytest.mark.parametrize("address", ["nonsense", "tcp://127.0.0.1:1", "127.0.0.1:x", "silent"])
def test_a_scheduler_that_cannot_be_reached_is_one_line_and_leaves_no_thread(
    coin, tmp_path, monkeypatch, silent, address
):
    address = silent if address == "silent" else address
    monkeypatch.setattr(importlib.import_module("cointoss.compare.sweep.cluster"), "PATIENCE", 0.5)
    threads = set(threading.enumerate())
    answered = basin(coin, *AXES, "--out", tmp_path / "map.zarr", "--scheduler", address)
    assert answered.exit_code == 2
    asked, refused = answered.stderr.splitlines()
    assert asked.endswith(f"--scheduler {address}: connecting, for up to 0.5 s")
    assert f"--scheduler {address}: accepted: the address of a running Dask scheduler" in refused
    assert set(threading.enumerate()) <= threads
    assert not (tmp_path / "map.zarr").exists()


def test_without_dask_the_extra_is_named(coin, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    answered = basin(coin, *AXES, "--out", tmp_path / "map.zarr", "--scheduler", "tcp://h:1")
    assert answered.exit_code == 2
    assert f'pip install "{DISTRIBUTION}[cluster]"' in answered.stderr
    assert not (tmp_path / "map.zarr").exists()


@pytest.mark.parametrize(
    "lost",
    [
        CommClosedError("in <TCP>: Stream is closed"),
        OSError("Timed out trying to connect"),
        TimeoutError(),
        distributed.CancelledError("future"),
    ],
)
def test_a_connection_that_is_lost_is_named_with_the_way_on(lost):
    why = str(lost) or "TimeoutError"
    with pytest.raises(SweepError) as raised, naming_loss("tcp://h:1", "`resume` goes on"):
        raise lost
    assert str(raised.value) == (
        f"`scheduler` tcp://h:1: the cluster was lost, or a part there ({why}); `resume` goes on"
    )
