"""What a threshold of restitution does: how many impacts it leaves of a rattle, and the odds of the faces."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from cointoss import analytic
from cointoss.compare.metrics.estimates import difference, in_words, share
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.tables import paragraphs, table
from cointoss.compare.reproduction.setups.hands import states_of_hands
from cointoss.compare.reproduction.setups.study import study
from cointoss.models.batch import PLACE, rows_from_states
from cointoss.models.reading import load
from cointoss.models.records import Outcome

COUNT, SEED = 1000, 5460
"""Hand tosses of the zloty for each threshold, and the seed."""
THRESHOLD = "floor.restitution_threshold"
THRESHOLDS = (0.0, 1e-3, 1e-2, 3e-2, 1e-1)
"""Speeds up to which a touch is plastic [m/s]."""
MODERATE = 1e-2
"""The threshold of the claims [m/s]; a fall from 5 µm reaches it."""


@dataclass(frozen=True)
class OneToss:
    """How the zloty's own toss ended."""

    impacts: int
    contacts: int
    end_time: float
    end: str


@dataclass(frozen=True)
class HandTosses:
    """How hand tosses of the zloty ended."""

    impacts: list[int]
    """Of each toss."""
    outcomes: list[int]
    """`Outcome` of each toss."""


@dataclass(frozen=True)
class PlasticTouchesRecord:
    """What the study found, by threshold."""

    zloty: dict[str, OneToss]
    hands: dict[str, HandTosses]


def one_toss(threshold: float) -> OneToss:
    """Toss the zloty as its scenario says."""
    tossed = analytic.toss(load("zloty").replace(THRESHOLD, threshold))
    end = f"{tossed.outcome}, {tossed.ending}"
    return OneToss(len(tossed.impacts), len(tossed.contacts), tossed.end_time, end)


def hand_tosses(count: int, seed: int) -> list[HandTosses]:
    """Toss the zloty by hand from the same releases for each of `THRESHOLDS`."""
    starts = states_of_hands(np.random.default_rng(seed), count, aside=10.0)
    rows = np.tile(rows_from_states(load("zloty"), starts), (len(THRESHOLDS), 1))
    rows[:, PLACE[THRESHOLD]] = np.repeat(THRESHOLDS, count)
    ended = analytic.toss_rows(rows)
    both = (column.reshape(len(THRESHOLDS), count).tolist() for column in (ended.impacts, ended.outcome))
    return [HandTosses(*one) for one in zip(*both, strict=True)]


def compute(progress: Progress, count: int = COUNT, seed: int = SEED) -> PlasticTouchesRecord:
    """Toss the zloty once, and by `count` hands, for each of `THRESHOLDS`."""
    names = [f"{threshold:g}" for threshold in THRESHOLDS]
    alone = [one_toss(threshold) for threshold in THRESHOLDS]
    progress(1, 2)
    hands = hand_tosses(count, seed)
    progress(2, 2)
    return PlasticTouchesRecord(
        zloty=dict(zip(names, alone, strict=True)), hands=dict(zip(names, hands, strict=True))
    )


def ended(tosses: HandTosses, outcome: Outcome) -> list[bool]:
    """Return which tosses ended so."""
    return [found == outcome for found in tosses.outcomes]


def measures(found: PlasticTouchesRecord) -> dict[str, Any]:
    """Return what the claims name: the share of impacts left, and the change of the share of heads."""
    name = f"{MODERATE:g}"
    cut, free = (ended(found.hands[one], Outcome.HEADS) for one in (name, "0"))
    return {
        "kept": found.zloty[name].impacts / found.zloty["0"].impacts,
        "moved": difference(cut, free),
    }


def tables(found: PlasticTouchesRecord) -> str:
    """Return the tables, in Markdown."""
    alone = [
        [f"{1e3 * float(name):g}", str(toss.impacts), str(toss.contacts), f"{toss.end_time:.3f}", toss.end]
        for name, toss in found.zloty.items()
    ]
    hands = [
        [
            f"{1e3 * float(name):g}",
            f"{np.median(tosses.impacts):g}",
            str(max(tosses.impacts)),
            f"{100 * np.equal(tosses.outcomes, found.hands['0'].outcomes).mean():.1f}",
            *(in_words(share(ended(tosses, end)), ".1f", 100) for end in (Outcome.HEADS, Outcome.EDGE)),
        ]
        for name, tosses in found.hands.items()
    ]
    heads = "impacts, median | at most | outcome as without [%] | heads [%] | edge [%]"
    return paragraphs(
        table("`zloty`, plastic up to [mm/s] | impacts | contacts | ends at [s] | as", alone),
        table(f"hand tosses, plastic up to [mm/s] | {heads}", hands),
    )


REPRODUCTION = study(
    __name__, compute, record=PlasticTouchesRecord, measures=measures, tables=tables, draw={}
)
