"""Draw the releases of a plan, toss them and count how they end, until enough is known."""

import math
import time
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.estimates import share_of
from cointoss.compare.metrics.release_arrays import joined
from cointoss.compare.shares.plan import Plan
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.run import next_pixels
from cointoss.models.answers import tally
from cointoss.models.records import Outcome
from cointoss.models.stages import stage

BLOCK = {Engine.ANALYTIC: 250, Engine.MUJOCO: 25}
"""Tosses that are drawn from one seed; counting stops after a whole block only, whoever tossed how many."""
Counts = NDArray[np.int64]
"""Numbers of tosses by code of `Outcome`."""


class Part(NamedTuple):
    """Blocks of a setting, one after the other."""

    engine: Engine
    setting: int
    first: int
    blocks: int


class Tossed(NamedTuple):
    """How the tosses of a part ended."""

    counts: Counts
    """Of each block, (blocks, 6)."""
    seconds: float
    """That it took [s]."""


Tosser = Callable[[Plan, list[Part]], Iterable[tuple[Part, Tossed]]]
"""Tosses parts, and yields them in any order."""


def toss_part(plan: Plan, part: Part) -> Tossed:
    """Toss the blocks of a part.

    The seed of a block is that of the plan, with the engine, the setting and the block for its key: no two
    share draws, and none depends on which were tossed before.

    Raises:
        SweepError: for a release that a scenario refuses.
    """
    start, setting, size = time.perf_counter(), plan.setting(part.setting), BLOCK[part.engine]
    sizes = [min(size, plan.tosses - n * size) for n in range(part.first, part.first + part.blocks)]
    try:
        drawn = [
            setting.hand.releases(setting.scenario.body, _draws(plan, part, part.first + n), count)
            for n, count in enumerate(sizes)
        ]
        outcome = part.engine.package.toss_many(setting.scenario, joined(drawn)).outcome
    except ValueError as error:
        raise SweepError(str(error)) from None
    counts = [tally(block) for block in np.split(outcome, np.cumsum(sizes)[:-1])]
    return Tossed(np.array(counts), time.perf_counter() - start)


def _draws(plan: Plan, part: Part, block: int) -> np.random.Generator:
    key = (list(Engine).index(part.engine), part.setting, block)
    return np.random.default_rng(np.random.SeedSequence(plan.seed, spawn_key=key))


def toss_here(plan: Plan, parts: list[Part]) -> Iterator[tuple[Part, Tossed]]:
    """Toss parts one after the other, each on all cores of this machine."""
    return zip(parts, map(partial(toss_part, plan), parts), strict=True)


class Count:
    """How many tosses of a setting ended how, and whether that is enough."""

    def __init__(self, plan: Plan, engine: Engine) -> None:
        """Begin with none."""
        self.plan, self.size = plan, BLOCK[engine]
        self.counts: Counts = np.zeros(len(Outcome), dtype=np.int64)
        self.blocks, self._next = 0, 1

    @property
    def tosses(self) -> int:
        """How many there are."""
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
        """Tosses at which it will be enough, about: an interval shrinks as 1/√n."""
        made = self.tosses
        if self.plan.to is None or (made and math.isinf(self.width)):
            return self.plan.tosses
        tosses, width = (made, self.width) if made else (self.size, _width(self.size // 2, self.size))
        return min(self.plan.tosses, math.ceil(tosses * (width / self.plan.to) ** 2))

    def part(self, engine: Engine, setting: int) -> Part:
        """Return the blocks to toss next: of about a second, and about as many as are needed."""
        left = math.ceil(max(self.needed - self.tosses, 1) / self.size)
        return Part(engine, setting, self.blocks, min(self._next, left))

    def add(self, tossed: Tossed) -> None:
        """Add blocks in their order, until it is enough; blocks beyond are left out."""
        self._next = next_pixels(len(tossed.counts), tossed.seconds)
        for block in tossed.counts:
            if self.is_enough:
                return
            self.counts = self.counts + block
            self.blocks += 1


def _width(met: int, tosses: int) -> float:
    found = share_of(met, tosses)
    return (found.high - found.low) / 2


def counting(plan: Plan, tosser: Tosser = toss_here) -> Iterator[Counts]:
    """Yield the counts so far after each part, (engines, values of each field, 6).

    Every setting has its turn in each round. The counts at the end depend on the plan alone, not on how many
    cores tossed, nor in which order.

    Raises:
        SweepError, UnsupportedError: for a setting that can't be tossed.
    """
    settings = range(math.prod(plan.shape))
    counts = {key: Count(plan, key[0]) for key in product(plan.engines, settings)}
    with stage("shares", "tosses") as progress:
        while wanted := [one.part(*key) for key, one in counts.items() if not one.is_enough]:
            for part, tossed in tosser(plan, wanted):
                counts[part.engine, part.setting].add(tossed)
                progress(*(sum(numbers) for numbers in zip(*map(_made_of, counts.values()), strict=True)))
                table = np.array([one.counts for one in counts.values()])
                yield table.reshape(len(plan.engines), *plan.shape, len(Outcome))


def _made_of(count: Count) -> tuple[int, int]:
    return count.tosses, max(count.needed, count.tosses)
