"""How random tosses end by each engine, in classes of coin, floor and air, and which classes differ."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.stats import norm

from cointoss import Engine, Hand, Outcome, Scenario, analytic, coin_mj
from cointoss.study import (
    GREY,
    INK,
    LEVEL,
    VERMILION,
    Array,
    Estimate,
    in_words,
    rows_from_states,
    scenario_of_row,
    table,
)
from cointoss.study import OUTCOMES as COLORS
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.frame.tables import paragraphs
from cointoss_reproduction.setups.ends import OUTCOMES, tally
from cointoss_reproduction.setups.general_coins import AIR, cent, paper_coin
from cointoss_reproduction.setups.releases import directions, released

SEED, PERMUTATIONS = 2008, 20_000
ENGINES = tuple(map(str, Engine))
HEIGHTS, SPINS = (0.1, 0.5), (5.0, 60.0)
"""Ranges of a release's height [m] and of its angular velocity [rad/s]; see `thrown`."""
Class = dict[str, Any]
"""A coin, its floor and its air, as a scenario describes them."""
SMOOTH, ROUGH, COULOMB = (
    {"restitution": 0.6, "contact": contact, "friction": friction}
    for contact, friction in (("smooth", 0.0), ("perfectly_rough", 0.0), ("coulomb", 0.2))
)


def _class(thickness: float, floor: dict[str, Any], *, imperfect: bool = False, air: bool = False) -> Class:
    coin = paper_coin(thickness, imperfect=imperfect)
    return {"coin": coin, "floor": floor, "air": AIR if air else {}}


CLASSES: dict[str, Class] = {
    "thin, smooth": _class(0.0, SMOOTH),
    "thin, imperfect, smooth": _class(0.0, SMOOTH, imperfect=True),
    "thin, μ = 0.2, air": _class(0.0, COULOMB, air=True),
    "0.4 mm, smooth": _class(4e-4, SMOOTH),
    "0.4 mm, imperfect, μ = 0.2": _class(4e-4, COULOMB, imperfect=True),
    "0.4 mm, μ = 0.2, air": _class(4e-4, COULOMB, air=True),
    "2 mm, smooth": _class(2e-3, SMOOTH),
    "2 mm, μ = 0.2": _class(2e-3, COULOMB),
    "2 mm, imperfect, smooth": _class(2e-3, SMOOTH, imperfect=True),
    "2 mm, imperfect, μ = 0.2": _class(2e-3, COULOMB, imperfect=True),
    "2 mm, imperfect, μ = 0.2, air": _class(2e-3, COULOMB, imperfect=True, air=True),
    "2 mm, rough": _class(2e-3, ROUGH),
    "2 mm, rough, air": _class(2e-3, ROUGH, air=True),
    "2 mm, μ = 0.2, δ = 0.02 mm, p = 0.1 mm": _class(
        2e-3, COULOMB | {"rolling_friction": 2e-5, "pivoting_friction": 1e-4}
    ),
    "2 mm, μ = 0.2, c = 0.02 mm": _class(2e-3, COULOMB | {"contour_friction": 2e-5}),
    "2 mm, smooth, e ~ v^(-1/4), air": _class(
        2e-3, SMOOTH | {"restitution_exponent": 0.25, "restitution_threshold": 0.2}, air=True
    ),
    "2 mm, μ = 0.2, viscous e(v)": _class(2e-3, COULOMB | {"restitution": 1.0, "restitution_viscous": 0.4}),
    "2 mm, smooth, slope of 5°": _class(2e-3, SMOOTH | {"slope": float(np.radians(5))}),
    "2 mm, μ = 0.2, δ = 1 mm, slope of 2°": _class(
        2e-3, COULOMB | {"rolling_friction": 1e-3, "slope": float(np.radians(2))}
    ),
    "10 mm, smooth": _class(1e-2, SMOOTH),
    "10 mm, μ = 0.2": _class(1e-2, COULOMB),
    "10 mm, imperfect, μ = 0.2, air": _class(1e-2, COULOMB, imperfect=True, air=True),
    "h = 2r, smooth": _class(2.5e-2, SMOOTH),
    "h = 2r, μ = 0.2, air": _class(2.5e-2, COULOMB, air=True),
    "cent of 0.4 mm spun at 30 rad/s, smooth, air": cent(4e-4, contact="smooth"),
    "cent of 1.52 mm spun at 60 rad/s, μ = 0.02, air": cent(1.52e-3, contact="coulomb", friction=0.02),
}
"""Coins, floors and air; a coin is ideal and in vacuum unless its name says otherwise."""
SPUN = {
    kind: Hand(spun=True, spin=spin, psi_scatter=float(np.radians(1)), up="either")
    for kind, spin in zip([*CLASSES][-2:], (30.0, 60.0), strict=True)
}
"""The hands that spin the coins of some classes on their edge."""
KNOWN = {
    "0.4 mm, smooth": "open; a step of MuJoCo's errs by about as much as a landing of the other rim takes",
    "2 mm, imperfect, smooth": "that only the analytic engine has a criterion for a coin that rocks on \
its edge, and MuJoCo calls it perpetual: on edge or moving are as many in both",
    "2 mm, rough": "that MuJoCo's steps take energy from a coin that rolls without slip",
    "cent of 1.52 mm spun at 60 rad/s, μ = 0.02, air": "open",
}
"""The classes whose ends are known to differ between the engines, and why; "open" where that is not known."""
SHARES = ("face", "edge", "moving")
"""The shares that are compared; the last is of perpetual, transient and undecided tosses."""


def thrown(rng: np.random.Generator, count: int) -> Array:
    """Draw states at release, at rest but for a spin: with any attitude about any axis, (n, 13)."""
    height, spin = rng.uniform(*HEIGHTS, count), rng.uniform(*SPINS, count)
    attitude, axis = directions(rng, count), directions(rng, count, 3)
    return released(height, attitude=attitude, spin=spin[:, None] * axis)


def drawn(kind: str, number: int, count: int) -> Array:
    """Return random tosses of a class as rows, (count, m); no two numbers share draws."""
    scenario = Scenario.model_validate({"release": {"position": [0, 0, 1]}, **CLASSES[kind]})
    rng = np.random.default_rng((SEED, [*CLASSES].index(kind), number))
    states = SPUN[kind].states(scenario.body, rng, count) if kind in SPUN else thrown(rng, count)
    return rows_from_states(scenario, states)


def ended(kind: str, engine: str, by_analytic: int = 2000, by_mujoco: int = 800) -> dict[str, int]:
    """Return how random tosses of a class end by an engine, which has draws of its own."""
    count = by_mujoco if engine == Engine.MUJOCO else by_analytic
    return tally(Engine(engine).package.toss_rows(drawn(kind, ENGINES.index(engine), count)).outcome)


def one_by_one(kind: str, singles: int = 12) -> dict[str, int]:
    """Return of how many tosses both engines trust all impacts, and how many of these MuJoCo ends otherwise.

    MuJoCo tosses them by `coin_mj.FINE`, and once more by the coarser `coin_mj.MANY`.
    """
    rows = drawn(kind, len(ENGINES), singles)
    found = analytic.toss_rows(rows, trust="impacts")
    whole = np.flatnonzero((found.trusted_impacts == found.impacts) & (found.impacts > 0))
    fine = {i: coin_mj.toss(scenario_of_row(rows[i])) for i in whole}
    both = [i for i, toss in fine.items() if toss.trusted_impacts == len(toss.impacts) > 0]
    many = coin_mj.toss_rows(rows[both]).outcome if both else np.empty(0)
    return {
        "trusted": len(both),
        "otherwise": sum(fine[i].outcome != found.outcome[i] for i in both),
        "kept": np.sum(many == found.outcome[both]),
    }


def chance(counts: NDArray[np.integer]) -> float:
    """Return how probable it is that two samples of one population differ as much as these, by χ².

    Of `PERMUTATIONS` tables with the same sums, the part whose χ² is no smaller; this one is among them.

    Args:
        counts: of each kind, by sample, (2, kinds).
    """
    met = counts[:, counts.any(axis=0)]
    whole, first = met.sum(axis=0), met[0].sum()
    others = np.random.default_rng(SEED).multivariate_hypergeometric(
        whole, first, PERMUTATIONS, method="marginals"
    )
    # Where the sums are the same, χ² grows with this sum over the first sample.
    own, *squares = (np.vstack([met[:1], others]) ** 2 / whole).sum(axis=1)
    return (1 + np.sum(np.array(squares) >= own * (1 - 1e-12))) / (1 + PERMUTATIONS)


def holm(chances: Sequence[float]) -> Array:
    """Return probabilities of several tests, adjusted for their number (Holm, Scand. J. Stat. 6, 1979)."""
    order, left = np.argsort(chances), np.arange(len(chances), 0, -1)
    adjusted = np.maximum.accumulate(np.sort(chances) * left)
    return np.minimum(adjusted, 1)[np.argsort(order)]


def apart(counts: NDArray[np.integer]) -> tuple[str, Estimate, float]:
    """Return which of `SHARES` differs most for its interval, its difference, and a bound of all differences.

    A difference is MuJoCo's share less the analytic engine's. Its interval, of A. Agresti and B. Caffo, Am.
    Stat. 54 (2000) 280, is widened until those of all shares of all classes hold at once.

    Args:
        counts: of tosses by code of `Outcome`, by engine, (2, 6).
    """
    met = np.column_stack([counts[:, of].sum(axis=1) for of in ([1, 2], [3], [0, 4, 5])])
    n = counts.sum(axis=1, keepdims=True)
    p = (met + 1) / (n + 2)
    z = norm.isf((1 - LEVEL) / 2 / len(SHARES) / len(CLASSES))
    half = z * np.sqrt((p * (1 - p) / (n + 2)).sum(axis=0))
    middle, value = np.diff(p, axis=0)[0], np.diff(met / n, axis=0)[0]
    i = int(np.argmax(np.abs(value) / half))
    ends = (float(end[i]) for end in (value, middle - half, middle + half))
    return SHARES[i], Estimate(*ends, count=int(n.min())), float(np.max(np.abs(middle) + half))


def compared(cells: pd.DataFrame) -> pd.DataFrame:
    """Return for each class `p`, `holm`, the `share` most `apart`, a `bound`, and whether it is `refuted`."""
    counts = {
        kind: rows[[*OUTCOMES]].to_numpy(dtype=int)
        for kind, rows in cells.dropna(subset=["tosses"]).groupby("kind", sort=False)
    }
    found = pd.DataFrame([apart(both) for both in counts.values()], [*counts], ["share", "apart", "bound"])
    p = [chance(both) for both in counts.values()]
    return found.assign(p=p, holm=(adjusted := holm(p)), refuted=adjusted < 1 - LEVEL)


def found(cells: pd.DataFrame) -> dict[str, Any]:
    """Return what the claims name, by class, and the table of verdicts."""
    classes = compared(cells)
    rows = [
        [kind, f"{one.p:.2g}", f"{one.holm:.2g}", one.share, in_words(one.apart, ".1f", 100), _verdict(one)]
        for kind, one in classes.iterrows()
    ]
    says = (
        "p is the probability that the engines' ends differ so by chance: of "
        f"{PERMUTATIONS:,d} tables with the same sums, drawn at random, the part whose χ² is no smaller. A "
        f"class is refuted where p, adjusted by Holm for {len(rows)} classes, is below {1 - LEVEL:.0%}. Of "
        "three shares, on a face, on edge and moving (perpetual, transient or undecided), that is shown "
        "which differs most for its interval; classes agree within the farthest end of the three intervals, "
        f"and those of all classes hold at once at {LEVEL:.0%}."
    )
    heads = "class | p | p, by Holm | share | MuJoCo less analytic [%] | verdict"
    return {
        "adjusted": classes["holm"].drop([*KNOWN]).to_dict(),
        "alike": np.sum(~classes["refuted"]),
        "classes": len(classes),
        "known": {kind: {"apart": classes["apart"][kind], "cause": cause} for kind, cause in KNOWN.items()},
        "tables": paragraphs(says, table(heads, rows, words=True)),
    }


def _verdict(one: Any) -> str:
    if one.refuted:
        return f"refuted; why: {KNOWN.get(one.name, 'open')}"
    return f"agrees within ± {100 * one.bound:.1f} %"


def draw(cells: pd.DataFrame) -> Figure:
    """Draw the shares of the outcomes as bars, the analytic engine's over MuJoCo's."""
    refuted = compared(cells)["refuted"]
    picture = Figure(figsize=(10, 0.4 * len(refuted) + 1.4))
    axes = picture.subplots()
    for engine, place in zip(ENGINES, (-0.2, 0.2), strict=True):
        rows = cells[cells["engine"] == engine]
        left, at = np.zeros(len(rows)), np.arange(len(rows)) + place
        for outcome in (*Outcome, Outcome.UNDECIDED)[1:]:
            parts = 100 * np.array(rows[OUTCOMES[outcome]] / rows["tosses"], dtype=float)
            style: Any = {"color": COLORS[outcome], "edgecolor": GREY, "linewidth": 0.4, "height": 0.38}
            axes.barh(at, parts, left=left, label=str(outcome) if engine == ENGINES[0] else None, **style)
            left += parts
    axes.set_yticks(range(len(refuted)), [*map(str, refuted.index)])
    for label, is_refuted in zip(axes.get_yticklabels(), refuted, strict=True):
        label.set_color(VERMILION if is_refuted else INK)
    axes.grid(visible=False)
    axes.set(xlim=(0, 100), xlabel="share of the tosses [%]; upper bar analytic, lower bar MuJoCo")
    axes.margins(y=0.01)
    axes.invert_yaxis()
    picture.legend(loc="outside upper center", ncols=len(Outcome))
    return picture


REPRODUCTION = study(
    __name__,
    Cells(ended, {"kind": tuple(CLASSES), "engine": ENGINES}),
    Cells(one_by_one, {"kind": tuple(CLASSES)}),
    found=found,
    draw={"endings": draw},
)
