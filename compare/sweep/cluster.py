"""Toss on the workers of a Dask cluster."""

import asyncio
import logging
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from itertools import islice
from typing import Any, TypeVar

from cointoss.compare.engines import Engine
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.distribution import DISTRIBUTION

Part = TypeVar("Part")
Tossed = TypeVar("Tossed")
AHEAD = 2
"""Parts that each thread of a worker gets at a time: one to toss, and one that waits."""
PATIENCE, PATIENCE_FOR_WORKERS = 10, 60
"""How long to wait for the scheduler, and for a first worker [s]."""


Workers = Callable[[Callable[[Part], Tossed], Iterable[Part], Engine], Iterator[tuple[Part, Tossed]]]
"""Has the workers of a cluster toss parts of a job by an engine; yields the parts, in any order, with what is
tossed of each."""


@contextmanager
def cluster(address: str | None, say: Callable[[str], None], way_on: str) -> Iterator[Workers | None]:
    """Yield what lets the workers of a cluster toss; None without an address.

    The workers keep nothing: a part lost with its worker is tossed again by another. A worker tosses on all
    its cores, so one thread for each is enough.

    Args:
        address: of the Dask scheduler, such as tcp://10.0.0.1:8786; None to toss here.
        say: called with what is waited for.
        way_on: what the user can do if the cluster is lost, as the error says it.

    Raises:
        SweepError: if dask.distributed is not installed, or the cluster can't be reached or has no worker;
            while tossing, if the cluster is lost, or a worker has other versions of what makes a toss.
    """
    if address is None:
        yield None
        return
    try:
        import distributed
    except ImportError:
        raise SweepError(
            f'`scheduler` {address}: needs dask.distributed; accepted: pip install "{DISTRIBUTION}[cluster]"'
        ) from None
    say(f"`scheduler` {address}: connecting, for up to {PATIENCE} s")
    try:
        asyncio.run(_reach(address))
        client: Any = distributed.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        why = str(error) or f"no answer within {PATIENCE} s"
        raise SweepError(
            f"`scheduler` {address}: accepted: the address of a running Dask scheduler ({why})"
        ) from None
    # cointoss reports a lost scheduler itself, in one line.
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    with client:
        if not client.nthreads():
            say(f"`scheduler` {address}: waiting for a first worker, for up to {PATIENCE_FOR_WORKERS} s")
        try:
            client.wait_for_workers(1, timeout=PATIENCE_FOR_WORKERS)
        except TimeoutError:
            raise SweepError(f"`scheduler` {address}: accepted: a cluster with a worker") from None

        def toss_there(
            toss: Callable[[Part], Tossed], parts: Iterable[Part], engine: Engine
        ) -> Iterator[tuple[Part, Tossed]]:
            here, waiting = engine.versions, iter(parts)
            running = distributed.as_completed(loop=client.loop)

            def give_out(count: int) -> None:
                for part in islice(waiting, count):
                    running.add(client.submit(_toss_there, toss, part, engine, here, pure=False))

            with naming_loss(address, way_on):
                give_out(_room(client))
            for future in running:
                with naming_loss(address, way_on):
                    # Workers may have come since.
                    give_out(max(1, _room(client) - running.count()))
                    tossed = future.result()
                yield tossed

        yield toss_there


@contextmanager
def naming_loss(address: str, way_on: str) -> Iterator[None]:
    """Raise an error that names the cluster, and the way on, where the cluster is lost or fails."""
    from distributed import CancelledError, KilledWorker

    try:
        yield
    except (CancelledError, KilledWorker, OSError) as error:
        why = str(error) or type(error).__name__
        raise SweepError(
            f"`scheduler` {address}: the cluster was lost, or a part there ({why}); {way_on}"
        ) from None


async def _reach(address: str) -> None:
    """Connect to the scheduler once, and let go.

    A `Client` that can't connect leaves its thread behind, or is closed when Python collects it, which fails
    on a busy machine; and it waits for ever where something else answers nothing.
    """
    from distributed import Security
    from distributed.comm.core import connect

    async with asyncio.timeout(PATIENCE):
        allowed = Security().get_connection_args("client")
        comm: Any = await connect(address, timeout=PATIENCE, **allowed)
        await comm.close()


def _room(client: Any) -> int:
    """Return how many parts may be with the workers at a time."""
    return max(1, AHEAD * sum(client.nthreads().values()))


def _toss_there(
    toss: Callable[[Part], Tossed], part: Part, engine: Engine, expected: dict[str, str]
) -> tuple[Part, Tossed]:
    there = engine.versions
    if there != expected:
        raise SweepError(f"`scheduler`: a worker has {there}; accepted: {expected}, as here")
    return part, toss(part)
