"""When each contact law adds energy, pulls on the coin, leaves the friction cone, or has no solution."""

import math
from collections.abc import Callable
from typing import Any

from matplotlib.figure import Figure

from cointoss.study import BLUE, GREEN, GREY, ORANGE, SKY, VERMILION, paragraphs, table
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.studies.contact_laws.impacts import (
    COINS,
    FRICTIONS_OF_ONSETS,
    FRICTIONS_SUFFICIENT,
    FRICTIONS_WITHOUT_SOLUTION,
    LAWS,
    RESTITUTIONS,
    ContactRecord,
    LawRecord,
    compute,
)

SHOWN = (0.2, 0.5, 0.8, 1.0)
"""Restitutions of the table."""
ROUNDING = 1e-12
SEARCH_ERROR = 1e-7
PASSIVE = ("smooth", "coulomb, energetic")
PULLING = ("sharp_edge", "knurled", "perfectly_rough")
LEAVING = (*PULLING, "slip_preserving")
THIN_ROUGH, THIN_SLIDING = math.sqrt(5) / 3, math.sqrt(5) / 2
_NAMES = {
    law: f"({letter}) {law}"
    for letter, law in zip("abcdef", [name for name in LAWS if "coulomb" not in name], strict=True)
}
_LINES: dict[str, dict[str, Any]] = {
    "sharp_edge": {"color": ORANGE, "marker": "^"},
    "knurled": {"color": GREEN, "marker": "s"},
    "perfectly_rough": {"color": VERMILION, "marker": "v"},
    "slip_preserving": {"color": BLUE, "marker": "D"},
    "smooth": {"color": GREY, "marker": ""},
    "sliding_friction": {"color": SKY, "marker": "o"},
    "coulomb, kinematic": {"color": "#000000", "marker": "P"},
}


def measures(found: ContactRecord) -> dict[str, Any]:
    """Return what the claims name."""
    laws, onsets = found.laws, found.onsets
    gaining = ("knurled", "slip_preserving", "sliding_friction")
    below_onset = [
        share
        for law, onset in (
            ("sharp_edge", onsets.sharp_edge),
            ("perfectly_rough", onsets.perfectly_rough),
            ("coulomb, kinematic", onsets.perfectly_rough),
        )
        for coin, shares in zip(COINS, laws[law].gains_by_coin, strict=True)
        for chi, share in zip(RESTITUTIONS, shares, strict=True)
        if chi < onset[coin]
    ]
    of_closed_forms = [(onsets.coulomb, kane_onset), (onsets.sliding_friction, sliding_onset)]
    return {
        "passive": max(max(laws[law].largest_change) for law in PASSIVE),
        "least_gain": min(max(laws[law].largest_change) for law in laws if law not in PASSIVE),
        "always": min(min(laws[law].gains) for law in gaining),
        "imperfect": max(onsets.sharp_edge[coin] for coin in COINS if "imperfect" in coin),
        "ideal": min(onsets.sharp_edge[coin] for coin in COINS if "imperfect" not in coin),
        "ideal_least": THIN_ROUGH - SEARCH_ERROR,
        "below_onset": max(below_onset),
        "thin_rough": max(
            abs(one["thin ideal"] - THIN_ROUGH) for one in (onsets.sharp_edge, onsets.perfectly_rough)
        ),
        "closed_forms": max(
            abs(chi - closed_form(mu))
            for onset, closed_form in of_closed_forms
            for chi, mu in zip(onset, FRICTIONS_OF_ONSETS, strict=True)
        ),
        "unsolved": abs(onsets.without_solution["thin ideal"] - THIN_SLIDING),
        "pull": _only({law: max(record.pulls) for law, record in laws.items()}, PULLING),
        "leave": _only({law: max(record.leaves_cone) for law, record in laws.items()}, LEAVING),
    }


def _only(shares: dict[str, float], chosen: tuple[str, ...]) -> tuple[float, float]:
    """Return the least share of the chosen laws, and the largest of the others."""
    return min(shares[law] for law in chosen), max(shares[law] for law in shares if law not in chosen)


def kane_onset(mu: float) -> float:
    """Return the least restitution at which coulomb, kinematic, adds energy to the thin ideal coin.

    The coin comes down with the slip that a blow straight up at A would leave it without,
    χ² = 1 - K_zν²/(K_νν K_zz), and must stick once slip has stopped, |K_zν| <= μ K_νν. At a tilt ϑ with
    t = tan ϑ, m K_νν = (1 + 5 t²)/(1 + t²), m K_zz = (5 + t²)/(1 + t²) and m |K_zν| = 4 t/(1 + t²): best is
    t = 1, which sticks for μ >= 2/3, and below that the least t > 1 that does.

    Args:
        mu: coefficient of friction μ > 0.
    """
    t = 1.0 if mu >= 2 / 3 else (2 + math.sqrt(4 - 5 * mu * mu)) / (5 * mu)
    return math.sqrt(1 - (4 * t) ** 2 / ((1 + 5 * t * t) * (5 + t * t)))


def sliding_onset(mu: float) -> float:
    """Return the least restitution at which sliding_friction adds energy to the thin ideal coin.

    Slip that all but rests is driven on: (1 - χ)/(1 + χ) = μ (μ K_νν + |K_zν|)/(K_zz + μ |K_zν|), with K as
    in `kane_onset`, largest at (5 μ² - 1) t² + 12 μ t + 5 - μ² = 0. From μ = 1/√5 on it adds energy at every
    restitution, to a coin that comes down upright.

    Args:
        mu: coefficient of friction μ >= 0.
    """
    left = 1 - 5 * mu * mu
    if left <= 0:
        return 0.0
    t = (6 * mu + math.sqrt(36 * mu * mu + left * (5 - mu * mu))) / left
    ratio = mu * (mu * (1 + 5 * t * t) + 4 * t) / (5 + t * t + 4 * mu * t)
    return (1 - ratio) / (1 + ratio)


def tables(found: ContactRecord) -> str:
    """Return the results as tables, in Markdown."""
    laws, onsets = found.laws, found.onsets
    shown = [RESTITUTIONS.index(chi) for chi in SHOWN]
    at_05, at_08 = shown[1:3]

    def of_laws(cells: Callable[[LawRecord], list[str]]) -> list[list[str]]:
        return [[_NAMES.get(law, law), *cells(record)] for law, record in laws.items()]

    def energy(record: LawRecord) -> list[str]:
        much = record.median_gain[at_08], max(record.largest_change)
        return [*(_percent(record.gains[i]) for i in shown), *map(_number, much)]

    def friction(record: LawRecord) -> list[str]:
        shares = [part[i] for part in (record.pulls, record.leaves_cone) for i in (at_05, at_08)]
        enough = record.friction_for_half, record.friction_for_most
        unsolved = sum(record.without_solution) / len(record.without_solution)
        return [*map(_percent, shares), *map(_number, enough), _percent(unsolved)]

    extremes = [
        [words, *(f"{onset[coin]:.6f}" for coin in COINS)]
        for words, onset in (
            ("sharp_edge adds energy from χ =", onsets.sharp_edge),
            ("perfectly_rough adds energy from χ =", onsets.perfectly_rough),
            ("sliding_friction has no solution from μ =", onsets.without_solution),
        )
    ]
    kane = [
        [words, *(f"{chi:.4f}" for chi in chis)]
        for words, chis in (
            ("sliding_friction, from χ =", onsets.sliding_friction),
            ("the same, closed form", map(sliding_onset, FRICTIONS_OF_ONSETS)),
            ("coulomb, kinematic, from χ =", onsets.coulomb),
            ("the same, closed form", map(kane_onset, FRICTIONS_OF_ONSETS)),
        )
    ]
    unsolved = [["share of impacts", *map(_percent, found.share_without_solution)]]
    pull = "pull, χ = 0.5 | χ = 0.8 | leave cone, χ = 0.5 | χ = 0.8 | μ for half | μ for 95 % | no solution"
    return paragraphs(
        f"{found.count} random impacts for each law and restitution χ, seed {found.seed}.",
        "Impacts that add energy; gains over the kinetic energy before the impact.",
        table(
            ["law", *(f"χ = {chi:g}" for chi in SHOWN), "median gain, χ = 0.8", "largest, any χ"],
            of_laws(energy),
        ),
        "The same by coin, at χ = 0.8.",
        table(["law", *COINS], of_laws(lambda law: [_percent(coin[at_08]) for coin in law.gains_by_coin])),
        "Impacts that pull on the coin (S_z < 0), and that leave the friction cone, μ drawn from 0 to 1. "
        "Over all χ: the μ that would do for a half and for 95 % of the impacts, and the share without a "
        "solution.",
        table(f"law | {pull}", of_laws(friction)),
        "The extremes over all impacts, found by search. "
        f"For the thin ideal coin √5/3 = {THIN_ROUGH:.6f} and √5/2 = {THIN_SLIDING:.6f}.",
        table(["coin", *COINS], extremes),
        "The thin ideal coin gains energy from the floor:",
        table(["law", *(f"μ = {mu:g}" for mu in FRICTIONS_OF_ONSETS)], kane),
        "Impacts in which sliding_friction has no solution: as printed it would pull (S_z < 0).",
        table(["", *(f"μ = {mu:g}" for mu in FRICTIONS_WITHOUT_SOLUTION)], unsolved),
    )


def _percent(share: float) -> str:
    return "0" if share == 0 else f"{100 * share:.2f} %"


def _number(value: float | None) -> str:
    return "none" if value is None else "0" if value == 0 else f"{value:.3g}"


def _energy(found: ContactRecord) -> Figure:
    picture = Figure(figsize=(8.4, 3.8))
    often, much = picture.subplots(1, 2)
    for law, line in _LINES.items():
        record = found.laws[law]
        label = "smooth; coulomb, energetic" if law == "smooth" else law
        often.plot(RESTITUTIONS, [100 * share for share in record.gains], label=label, **line)
        gains = [math.nan if gain is None else 100 * gain for gain in record.median_gain]
        much.plot(RESTITUTIONS, gains, **line)
    often.set_ylabel("impacts that add energy [%]")
    much.set_ylabel("median gain / kinetic energy before [%]")
    much.set_ylim(bottom=0)
    for axes in (often, much):
        axes.set(xlabel="restitution χ", xticks=[0.2, 0.4, 0.6, 0.8, 1.0])
    picture.legend(loc="outside lower center", ncols=4)
    return picture


def _friction(found: ContactRecord) -> Figure:
    picture = Figure(figsize=(6, 3.6))
    axes = picture.subplots()
    for law in ("slip_preserving", "sharp_edge", "perfectly_rough", "knurled"):
        share = [100 * part for part in found.laws[law].friction_sufficient]
        axes.plot(FRICTIONS_SUFFICIENT, share, label=law, markevery=6, **_LINES[law])
    axes.set(xlabel="friction μ of the floor", ylabel="impacts within its cone [%]")
    axes.set(xlim=(0, FRICTIONS_SUFFICIENT[-1]), ylim=(0, 101))
    axes.legend(loc="lower right")
    return picture


def _onset(found: ContactRecord) -> Figure:
    picture = Figure(figsize=(6, 3.6))
    axes = picture.subplots()
    top = FRICTIONS_OF_ONSETS[-1]
    fine = [top * step / 400 for step in range(1, 401)]
    for name, onset, closed_form in (
        ("coulomb, kinematic", found.onsets.coulomb, kane_onset),
        ("sliding_friction", found.onsets.sliding_friction, sliding_onset),
    ):
        line = _LINES[name]
        axes.plot(fine, [closed_form(mu) for mu in fine], color=line["color"])
        axes.plot(FRICTIONS_OF_ONSETS, onset, line["marker"], color=line["color"], label=name, clip_on=False)
    axes.axhline(THIN_ROUGH, color=_LINES["perfectly_rough"]["color"], linestyle="--", linewidth=1.2)
    axes.text(
        top, THIN_ROUGH - 0.015, "perfectly_rough, sharp_edge: √5/3", va="top", ha="right", color=VERMILION
    )
    axes.set(xlabel="friction μ", ylabel="restitution from which\nthe law can add energy")
    axes.set(xlim=(0, top), ylim=(0, 1.02))
    axes.legend(loc="center right")
    return picture


REPRODUCTION = recorded(
    __name__,
    compute,
    record=ContactRecord,
    measures=measures,
    tables=tables,
    draw={"energy": _energy, "friction": _friction, "onset": _onset},
)
