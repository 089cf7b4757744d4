"""Fig. 24: a search for the coin, floor, restitution, g and tilt that give the printed sequences."""

from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from numpy.random import Generator

from cointoss.compare.metrics.estimates import share
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import INK, PALE
from cointoss.compare.output.tables import table
from cointoss.compare.reproduction.declared import Data, Findings, declared
from cointoss.compare.reproduction.setups.fig24_readings import (
    APART,
    MARK,
    NEARBY,
    PRINTED,
    clusters_as_printed,
    printed_heights,
    sequences,
    shared_with_marks,
    toss_of,
)
from cointoss.compare.reproduction.setups.fig24_scores import draw_scores
from cointoss.compare.reproduction.threads import all_cores
from cointoss.models.laws import ContactLaw
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario

SEED = 2008
COUNT, HEIGHTS = 4000, 5
"""Settings that are drawn, and random heights at which each is tossed for what chance gives."""
SEARCHES = 4000
"""Searches by chance."""
PRINTED_FACES = sum(len(text.replace(MARK, "")) for text in PRINTED.values())
RESTITUTIONS, FRICTIONS, TILTS = (0.6, 0.9), (0.02, 0.6), (-10.0, 10.0)
"""Ranges of χ, of μ where the law has it, and of θ about the printed 7 or -7 [deg]."""
THICKNESSES, GRAVITIES = (0.0, 1e-3, 2e-3), (9.8, 9.80665, 9.81, 10.0)
_WITH_FRICTION = (ContactLaw.SLIDING_FRICTION, ContactLaw.COULOMB)
SHOWN = 5
"""Of the best settings."""


@dataclass(frozen=True, kw_only=True)
class Fig24Settings:
    """What Fig. 24 may have been computed with; each is as printed, where it is, in half of the draws."""

    thickness: float
    """[m]."""
    offset: float
    """Part of the printed offset of the mass centre."""
    law: ContactLaw
    friction: float
    restitution: float
    gravity: float
    """[m/s²]."""
    tilt: float
    """θ [deg]."""

    @property
    def words(self) -> tuple[str, ...]:
        """The settings as a row of a table."""
        law = str(self.law).replace("_", " ") + (f" {self.friction:.2f}" if self.friction else "")
        return (
            f"{1e3 * self.thickness:g}",
            f"{self.offset:.2f}",
            law,
            f"{self.restitution:.3f}",
            f"{self.gravity:g}",
            f"{self.tilt:.2f}",
        )

    @property
    def scenario(self) -> Scenario:
        """The toss of Fig. 24(a)."""
        tilt = (0.0, np.radians(self.tilt), 0.0)
        toss = toss_of(self.thickness, self.offset, self.law, self.friction)
        floor = ("floor.restitution", self.restitution)
        return toss.replace("gravity", self.gravity, *floor, "release.angles", tilt)


def drawn(rng: Generator) -> Fig24Settings:
    """Draw settings: each quantity as printed in half of the draws, else at random."""
    law = ContactLaw(rng.choice(list(ContactLaw)))
    free_tilt = rng.random() < 0.5
    return Fig24Settings(
        thickness=float(rng.choice(THICKNESSES)),
        offset=float(rng.choice([0.0, 1.0]) if rng.random() < 0.5 else rng.random()),
        law=law,
        friction=float(rng.uniform(*FRICTIONS)) if law in _WITH_FRICTION else 0.0,
        restitution=0.8 if rng.random() < 0.5 else float(rng.uniform(*RESTITUTIONS)),
        gravity=float(rng.choice(GRAVITIES)),
        tilt=float(rng.choice([7.0, -7.0]) if not free_tilt else rng.uniform(*TILTS)),
    )


def make(progress: Progress, count: int = COUNT, heights: int = HEIGHTS) -> Findings:
    """Toss coins of random settings from the printed heights, and from random ones near them."""
    rng = np.random.default_rng(SEED)
    settings = [drawn(rng) for _ in range(count)]
    lows = rng.uniform(*NEARBY, (count, heights))
    rows = []
    with all_cores() as pool:
        for row in pool.map(_scores, settings, lows):
            rows.append(row)
            progress(len(rows), count)
    shared = np.array(rows)
    scores, begins, by_chance = shared[:, 0], shared[:, 1], shared[:, 2:]
    chance = best_by_chance(by_chance, rng)
    order = np.argsort(-scores, kind="stable")[:SHOWN]
    head = ["thickness [mm]", "part of the offset", "law, μ", "χ", "g [m/s²]", "θ [deg]", "faces shared"]
    best = table(head, [[*settings[i].words, f"{scores[i]:.0f}"] for i in order])
    return Findings(
        settings=count,
        best=scores.max(),
        median=np.median(chance),
        beginning=begins.sum(),
        as_good=share(chance >= scores.max(), "searches"),
        data={
            "scores": scores,
            "begins as printed": begins,
            "by chance": by_chance,
            "best by chance": chance,
        },
        tables=f"The best of {count:,d} settings, of {PRINTED_FACES} printed faces:\n\n{best}",
    )


def _scores(settings: Fig24Settings, lows: Array) -> list[float]:
    """Return the faces shared, whether all six begin as printed, and the faces shared from random heights."""
    scenario = settings.scenario
    found = sequences(scenario, printed_heights())
    by_chance = [float(shared_with_marks(sequences(scenario, low + APART))) for low in lows]
    return [float(shared_with_marks(found)), float(clusters_as_printed(found)), *by_chance]


def best_by_chance(scores: Array, rng: Generator) -> Array:
    """Return the best score of searches that take one random height of each setting, (n,).

    Args:
        scores: at random heights, (settings, heights).
        rng: which height is taken.
    """
    rows = np.arange(len(scores))
    return np.array(
        [scores[rows, rng.integers(scores.shape[1], size=len(rows))].max() for _ in range(SEARCHES)]
    )


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(8, 3.6))
    axes = picture.subplots()
    bins = (np.arange(0, PRINTED_FACES + 2, 2) - 0.5).tolist()
    begins, names = data["begins as printed"] == 1, ("all six begin H∘HHH∘", "other settings")
    draw_scores(axes, data["scores"], begins, names, data["by chance"], bins)
    best = np.quantile(data["best by chance"], (0.05, 0.95))
    axes.axvspan(*best, color=PALE, alpha=0.4, linewidth=0, label="best by chance, 90 %")
    axes.axvline(PRINTED_FACES, color=INK, linestyle=":")
    axes.annotate("all printed ", (PRINTED_FACES, 1.5), ha="right", fontsize=9)
    axes.set_yscale("log")
    axes.set(
        xlabel=f"leading faces shared with the printed {PRINTED_FACES}, marks included", ylabel="settings"
    )
    axes.legend(loc="upper center")
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
