"""A toss as it is filmed: on beyond its ending, until the coin lies still."""

import warnings
from dataclasses import dataclass

from cointoss.compare.engines import Engine, EngineSettings, is_own
from cointoss.models.records import ApproximationWarning, Array, Ending, Toss
from cointoss.models.stages import stage

FOLLOWED_FOR = 2.0
"""A coin that does not come to lie is followed so long after its face is settled [s]."""
_GOES_ON = (Ending.SETTLED, Ending.PAPER, Ending.PAPER_SMOOTH)


@dataclass(frozen=True, kw_only=True, eq=False)
class Filmed:
    """A toss, and the motion that a film of it shows."""

    toss: Toss
    """How it ended, and when."""
    motion: Toss
    """The same toss, which ends later where the coin goes on when its face is settled."""

    @property
    def longest(self) -> Toss:
        """The one of both whose path goes on further."""
        return self.motion if self.motion.end_time > self.toss.path_end else self.toss

    @property
    def later_times(self) -> Array:
        """The times of the touches of its path after the toss, (n,) [s]."""
        later = self.motion.impacts.time[len(self.toss.impacts) :]
        return later if self.longest is self.motion else self.toss.later_times


def goes_on(toss: Toss) -> bool:
    """Return whether a film goes on beyond the ending of a toss: its face is settled, and its coin moves.

    The toss of an engine that is none of ours is filmed as it is.
    """
    return is_own(toss.engine) and toss.ending in _GOES_ON


def followed(toss: Toss, settings: EngineSettings | None = None) -> Filmed:
    """Follow a toss until its coin lies still, at most `FOLLOWED_FOR` beyond its ending.

    The coin is tossed again, and waited for: up to its ending it does the same, bit for bit.

    Args:
        toss: by any engine.
        settings: of its engine, by default those of one toss.
    """
    if not goes_on(toss):
        return Filmed(toss=toss, motion=toss)
    engine, until = Engine(toss.engine).package, toss.end_time + FOLLOWED_FOR
    waiting = toss.scenario.replace("ending.test", "lying", "ending.max_time", until)
    with warnings.catch_warnings(), stage("following the coin until it lies still"):
        warnings.simplefilter("ignore", ApproximationWarning)
        motion = engine.toss(waiting, settings=settings or engine.FINE)
    return Filmed(toss=toss, motion=motion if motion.end_time > toss.end_time else toss)
