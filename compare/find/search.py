"""Search a window for tosses that show a target, and choose the one farthest from tosses that do not.

Low-discrepancy points (scrambled Sobol points) cover the window. Where no point shows the whole of a
sequence, the search goes on around the points that show most of it, in ever smaller boxes, each as wide as
the region that shows as much.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from cointoss.compare.find.window import Target, Window
from cointoss.compare.metrics.margin import FINE, MANY, SearchResolution, changes_both_ways
from cointoss.compare.output.interruption import saying
from cointoss.models.records import Array
from cointoss.models.stages import stage

BLOCK = 1 << 12
"""Points of the window that are tossed together."""
IN_A_BOX = 1 << 8
"""Points of a box that are tossed together."""
ENOUGH, BEST = 64, 2
"""Hits among which the best is chosen, and how many are moved to where their margin is large."""
FIRST, FEW = 1 << 7, 8
"""Points that are tossed at first, and hits that are enough, for an outcome: one of them is moved. A whole
toss may take a thousand times as long as its first faces."""
BEAM = 4
"""How many boxes are searched."""
TRIES = 4
"""How often boxes are searched, each time by twice as many points, before the search ends without a toss."""
ROUNDS = 6
"""The most times that a hit is moved."""
SCANNED, SCANS = 64, 8
"""Changes between a point and its margin that are tried, and how often, each time up to the first that shows
something else."""
LEAST = 1e-12
"""A margin below it, as a part of the window, is not made larger: rounding errors decide it."""
STEPS = (1.0, 0.5, 0.2)
"""Parts of the way to the middle that are tried."""


@dataclass(frozen=True)
class Hit:
    """A point whose toss shows what is wanted."""

    point: Array
    """(fields,), each from 0 to 1."""
    margins: Array
    """The smallest changes downwards and upwards, as parts of the window, that show something else,
    (fields, 2); infinite where none up to the whole window does."""

    @property
    def margin(self) -> float:
        """The smallest of all, and of what is left to the window's ends."""
        return float(np.min(np.minimum(self.margins, 1.0)))


@dataclass(frozen=True)
class Searched:
    """What a search found."""

    hits: tuple[Hit, ...]
    """The hits, the best first; empty where no toss shows the target."""
    tosses: int
    """The number of tosses made over the window, without those in boxes and for margins."""
    refused: int
    """The number of points of the window that make no scenario."""
    longest: int
    """Steps of what is wanted that the best point showed; -1 where no point makes a scenario."""


def search(
    window: Window, target: Target, tosses: int, seed: int, tell: Callable[[str], None] = lambda _: None
) -> Searched:
    """Search a window.

    Args:
        window: where.
        target: for what.
        tosses: over the window, at most.
        seed: of the points.
        tell: called with what was found, in a sentence, before the margins are measured.
    """
    sampler = qmc.Sobol(len(window.spans), rng=np.random.default_rng(seed))
    points, shown = np.empty((0, len(window.spans))), np.empty(0, dtype=np.int64)
    tried = refused = hits = 0
    first, enough, centres = (BLOCK, ENOUGH, BEST) if target.outcome is None else (FIRST, FEW, 1)

    with (
        saying(lambda said: f"{said}: {hits or 'none'} of {tried - refused:,d} tosses show it"),
        stage(
            "searching the window", "tosses", total=tosses, detail=lambda: f"{hits or 'none'} show it"
        ) as progress,
    ):
        while tried < tosses and hits < enough:
            block = sampler.random(min(max(first, tried), BLOCK))[: tosses - tried]
            of_block = target.shown(window, block)
            points, shown = np.concatenate([points, block]), np.concatenate([shown, of_block])
            best = np.argsort(-shown, kind="stable")[:enough]
            points, shown, tried = points[best], shown[best], tried + len(block)
            refused += int(np.sum(of_block < 0))
            hits += int(np.sum(of_block == target.steps))
            progress(tried, tosses)
    made = tried - refused
    longest = int(shown.max())
    points = points[shown == longest]
    if 0 < longest < target.steps:
        points, longest = _in_boxes(window, target, points, longest, seed)
    if longest < target.steps:
        return Searched((), made, refused, longest)
    showing = "1 toss shows" if (count := hits or len(points)) == 1 else f"{count:,d} tosses show"
    tell(f"{showing} {target.in_words}; now measuring how far each field may change")
    with stage("measuring margins"):
        wide = [Hit(*one) for one in zip(points, _margins(window, target, points, target.steps), strict=True)]
        best, *others = sorted(wide, key=lambda hit: -hit.margin)[:centres]
        chosen = [best, *others] if best.margin > LEAST else [best]
        centred = [_centred(window, target, hit) for hit in chosen]
    return Searched(tuple(sorted(centred, key=lambda hit: -hit.margin)), made, refused, longest)


def _in_boxes(window: Window, target: Target, points: Array, shown: int, seed: int) -> tuple[Array, int]:
    """Return points near others that show more of what is wanted, and how many steps they show.

    Args:
        window: where.
        target: what is wanted.
        points: that show the first steps of it, (n, fields).
        shown: how many.
        seed: of the points.
    """
    points, rng, tries = points[:BEAM], np.random.default_rng([seed, 1]), 0
    with stage("searching smaller boxes", "steps", total=target.steps, done=shown) as progress:
        while shown < target.steps and tries < TRIES:
            down, up = np.minimum(_margins(window, target, points, shown), 1.0).transpose(2, 0, 1)
            low, high = np.maximum(points - 2 * down, 0.0), np.minimum(points + 2 * up, 1.0)
            inside = [qmc.Sobol(points.shape[1], rng=rng).random(IN_A_BOX << tries) for _ in points]
            drawn = np.concatenate(low[:, None] + (high - low)[:, None] * np.array(inside))
            now = target.shown(window, drawn)
            tries += 1
            if now.max() > shown:
                tries, shown = 0, int(now.max())
                # The first of each box, then others: from different parts of the window.
                met = np.flatnonzero(now == shown)
                points = drawn[met[np.linspace(0, len(met) - 1, min(BEAM, len(met))).astype(int)]]
                progress(shown, target.steps)
    return points, shown


def _margins(
    window: Window, target: Target, points: Array, steps: int, how: SearchResolution = MANY
) -> Array:
    """Return how far each point is from one that shows fewer steps, (n, fields, 2), as in a `Hit`."""
    found = np.empty((len(points), points.shape[1], 2))
    for i in range(points.shape[1]):
        along = np.eye(points.shape[1])[i]

        def differ(
            rows: NDArray[np.intp], by: Array, along: Array = along
        ) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
            moved = (points[rows][:, None, :] + by[:, :, None] * along).reshape(-1, points.shape[1])
            shown = target.shown(window, moved, steps).reshape(by.shape)
            return (shown < steps) & (shown >= 0), shown >= 0

        up, down = changes_both_ways(len(points), differ, how)
        found[:, i] = np.column_stack([down, up])
    return found


def _scanned(window: Window, target: Target, point: Array) -> Hit:
    """Return the hit at a point, with margins between which evenly spread changes show what is wanted.

    A ladder of changes misses what lies between two rungs.
    """
    margins = _margins(window, target, point[None], target.steps, FINE)[0]
    for i, side in np.ndindex(margins.shape):
        along = (2 * side - 1) * np.eye(len(point))[i]
        for _ in range(SCANS):
            changes = np.linspace(0, min(margins[i, side], 1.0), SCANNED + 2)[1:-1]
            shown = target.shown(window, point + changes[:, None] * along)
            differ = np.flatnonzero((shown < target.steps) & (shown >= 0))
            if not len(differ):
                break
            margins[i, side] = changes[differ[0]]
    return Hit(point, margins)


def _centred(window: Window, target: Target, hit: Hit) -> Hit:
    """Return a hit moved towards the middle of what shows the same, while its margin grows.

    Where what shows the same is a slanted stripe, the whole way would leave it: a part of it is tried too.
    """
    best = _scanned(window, target, hit.point)
    for _ in range(ROUNDS if best.margin > LEAST else 0):
        down, up = np.minimum(best.margins, np.column_stack([best.point, 1 - best.point])).T
        tried = best.point + np.outer(STEPS, (up - down) / 2)
        tried = tried[target.shown(window, tried) == target.steps]
        moved = _scanned(window, target, tried[0]) if len(tried) else best
        if moved.margin <= best.margin:
            break
        best = moved
    return best
