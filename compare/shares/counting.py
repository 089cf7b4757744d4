"""Draw the releases of a plan, toss them and count how they end, until enough is known."""

import itertools
import math
import time
from collections.abc import Callable, Iterator
from functools import partial
from itertools import chain, islice, zip_longest
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.estimates import wilson
from cointoss.compare.shares.plan import Plan, rows_of_releases
from cointoss.compare.sweep.cluster import Workers
from cointoss.models.answers import tally
from cointoss.models.records import Outcome
from cointoss.models.stages import stage

BLOCK = {Engine.ANALYTIC: 250, Engine.MUJOCO: 25}
"""Tosses drawn from one seed. Counting stops only after a whole block, on any number of cores."""
GROWTH, SECOND, MOST = 8, 1.0, 512
"""Blocks that are tossed together: the factor by which their number may grow, the time that they should take
[s], and their largest number."""
IN_A_PART = 8
"""Blocks that a worker of a cluster tosses at a time."""
Counts = NDArray[np.int64]
"""Numbers of tosses by code of `Outcome`."""


class Block(NamedTuple):
    """Tosses of a setting that are drawn from one seed."""

    setting: int
    number: int


Part = tuple[Block, ...]
"""Blocks that are tossed together, of any settings."""
Tosser = Callable[[Plan, Engine, Iterator[Block]], Iterator[tuple[Part, Counts]]]
"""Tosses blocks, and yields them in parts, in any order, with their counts, (blocks, 6)."""


def toss_blocks(plan: Plan, engine: Engine, blocks: Part) -> Counts:
    """Toss blocks together, and count how each ends, (blocks, 6).

    The seed of a block is that of the plan, with the engine, the setting and the block for its key: no two
    share draws, and none depends on which were tossed before.

    Raises:
        SweepError: for a release that a scenario refuses.
    """
    size, rows = BLOCK[engine], []
    for one in blocks:
        setting, count = plan.setting(one.setting), min(size, plan.tosses - one.number * size)
        rows.append(rows_of_releases(setting, setting.states(draws(plan, engine, one), count)))
    outcome = engine.package.toss_rows(np.concatenate(rows), device=plan.processor).outcome
    return np.array([tally(part) for part in np.split(outcome, np.cumsum([*map(len, rows)])[:-1])])


def draws(plan: Plan, engine: Engine, block: Block) -> np.random.Generator:
    """Return what draws the releases of a block."""
    key = (list(Engine).index(engine), *block)
    return np.random.default_rng(np.random.SeedSequence(plan.seed, spawn_key=key))


def toss_here(plan: Plan, engine: Engine, blocks: Iterator[Block]) -> Iterator[tuple[Part, Counts]]:
    """Toss blocks on all cores of this machine, in parts of about a second."""
    size = 1
    while part := tuple(islice(blocks, size)):
        start = time.perf_counter()
        counts = toss_blocks(plan, engine, part)
        seconds = max(time.perf_counter() - start, 1e-9)
        size = min(max(1, int(len(part) * min(GROWTH, SECOND / seconds))), MOST)
        yield part, counts


def toss_there(
    workers: Workers, plan: Plan, engine: Engine, blocks: Iterator[Block]
) -> Iterator[tuple[Part, Counts]]:
    """Toss blocks on the workers of a cluster."""
    parts = iter(lambda: tuple(islice(blocks, IN_A_PART)), ())
    return workers(partial(toss_blocks, plan, engine), parts, engine)


class Count:
    """How many tosses of a setting ended in each way, and whether that is enough."""

    def __init__(self, plan: Plan, engine: Engine) -> None:
        """Begin with none."""
        self.plan, self.size = plan, BLOCK[engine]
        self.counts: Counts = np.zeros(len(Outcome), dtype=np.int64)
        self.blocks, self._waiting = 0, dict[int, Counts]()

    @property
    def tosses(self) -> int:
        """How many tosses there are."""
        return int(self.counts.sum())

    @property
    def width(self) -> float:
        """Half the width of the widest interval, of the share nearest to 1/2; infinite without tosses."""
        counts = self.plan.counted(self.counts)
        if not (tosses := int(counts.sum())):
            return math.inf
        return _width(int(counts[np.argmin(np.abs(counts - tosses / 2))]), tosses)

    @property
    def is_enough(self) -> bool:
        """Whether all tosses are made, or the widest interval is narrow enough."""
        narrow = self.plan.to is not None and self.width <= self.plan.to
        return narrow or self.tosses >= self.plan.tosses

    @property
    def needed(self) -> int:
        """About how many tosses will be enough: an interval shrinks as 1/√n."""
        made = self.tosses
        if self.plan.to is None or (made and math.isinf(self.width)):
            return self.plan.tosses
        tosses, width = (made, self.width) if made else (self.size, _width(self.size // 2, self.size))
        return max(made, min(self.plan.tosses, math.ceil(tosses * (width / self.plan.to) ** 2)))

    def add(self, number: int, counts: Counts) -> None:
        """Add a block, in the order of the blocks, until the count is enough; later blocks are left out."""
        self._waiting[number] = counts
        while not self.is_enough and (block := self._waiting.pop(self.blocks, None)) is not None:
            self.counts = self.counts + block
            self.blocks += 1


def _width(met: int, tosses: int) -> float:
    _, low, high = wilson(met, tosses)
    return float(high - low) / 2


def wanted(counts: list[Count]) -> Iterator[Block]:
    """Yield the blocks to toss next, those with the lowest number first, until about enough are tossed."""
    begun = {one: (setting, one.blocks) for setting, one in enumerate(counts) if not one.is_enough}
    for number in itertools.count(min((blocks for _, blocks in begun.values()), default=0)):
        left = [
            setting
            for one, (setting, blocks) in begun.items()
            if number >= blocks and not one.is_enough and number * one.size < max(one.needed, one.tosses + 1)
        ]
        if not left:
            return
        yield from (Block(setting, number) for setting in left)


def counting(plan: Plan, tosser: Tosser = toss_here) -> Iterator[Counts]:
    """Yield the counts so far after each part, (engines, values of each field, 6).

    All settings go on together, and both engines by turns. The counts at the end depend on the plan alone,
    not on how many cores tossed, nor in which order.

    Raises:
        SweepError, UnsupportedError: for a setting that can't be tossed.
    """
    counts = {engine: [Count(plan, engine) for _ in range(math.prod(plan.shape))] for engine in plan.engines}
    table = np.zeros((len(plan.engines), math.prod(plan.shape), len(Outcome)), dtype=np.int64)
    needed = np.array([[one.needed for one in several] for several in counts.values()])

    def found() -> str:
        shares = plan.counted(table).sum(axis=(0, 1)) / max(1, int(plan.counted(table).sum()))
        return ", ".join(f"{share:.1%} {one}" for one, share in zip(Outcome, shares, strict=True) if share)

    def tossed(row: int, engine: Engine) -> Iterator[None]:
        for part, several in tosser(plan, engine, wanted(counts[engine])):
            for block, of_block in zip(part, several, strict=True):
                one = counts[engine][block.setting]
                one.add(block.number, of_block)
                table[row, block.setting], needed[row, block.setting] = one.counts, one.needed
            yield

    plan.processor.expect(int(needed.sum()))
    with stage("counting", "tosses", detail=found) as progress:
        while not all(one.is_enough for several in counts.values() for one in several):
            for _ in chain.from_iterable(zip_longest(*(tossed(*one) for one in enumerate(plan.engines)))):
                progress(int(table.sum()), int(needed.sum()))
                yield table.reshape(len(plan.engines), *plan.shape, len(Outcome)).copy()
