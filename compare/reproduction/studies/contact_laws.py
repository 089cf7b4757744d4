"""When each contact law adds energy, pulls on the coin, leaves the friction cone, or has no solution."""

import math
from typing import Any

from matplotlib.figure import Figure

from cointoss.compare.output.style import BLUE, GREEN, GREY, ORANGE, SKY, VERMILION
from cointoss.compare.output.tables import table
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.saving import read_numbers
from cointoss.compare.reproduction.setups.contact_study import (
    COINS,
    FRICTIONS_OF_ONSETS,
    FRICTIONS_SUFFICIENT,
    FRICTIONS_WITHOUT_SOLUTION,
    LAWS,
    RESTITUTIONS,
    ContactRecord,
    compute,
)

COUNT, SEED = 20_000, 2008
SHOWN = (0.2, 0.5, 0.8, 1.0)
"""Restitutions of the table."""
ROUNDING = 1e-12
SEARCH_ERROR = 1e-7
PASSIVE = ("smooth", "coulomb, energetic")
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


def result(found: ContactRecord) -> Result:
    """Return the study's tables and claims."""
    return Result(claims=claims(found), data=found, tables=tables(found))


def claims(found: ContactRecord) -> tuple[Claim, ...]:
    """Return the claims of the study."""
    laws, onsets, every = found.laws, found.onsets, range(len(RESTITUTIONS))
    gaining = ("knurled", "slip_preserving", "sliding_friction")
    pulling = ("sharp_edge", "knurled", "perfectly_rough")
    leaving = (*pulling, "slip_preserving")
    below_onset = [
        laws[law].gains_by_coin[number][i]
        for law, onset in (
            ("sharp_edge", onsets.sharp_edge),
            ("perfectly_rough", onsets.perfectly_rough),
            ("coulomb, kinematic", onsets.perfectly_rough),
        )
        for number, coin in enumerate(COINS)
        for i in every
        if RESTITUTIONS[i] < onset[coin]
    ]
    return (
        Claim(
            claim="smooth and coulomb with energetic restitution never add energy",
            criteria=[
                _largest("change of the energy", [max(laws[law].largest_change) for law in PASSIVE], ROUNDING)
            ],
        ),
        Claim(
            claim="every other law does",
            criteria=[
                Criterion(
                    "largest gain of the law that gains least",
                    min(max(laws[law].largest_change) for law in laws if law not in PASSIVE),
                    ">",
                    0.1,
                    "a tenth of the kinetic energy is seen",
                )
            ],
        ),
        Claim(
            claim="knurled, slip_preserving and sliding_friction do at every restitution",
            criteria=[
                Criterion(
                    "least share of impacts that gain energy",
                    min(laws[law].gains[i] for law in gaining for i in every),
                    ">",
                    0,
                    "some do",
                )
            ],
        ),
        Claim(
            claim="sharp_edge does so at every restitution to the imperfect coins, and only to them",
            criteria=[
                Criterion(
                    "largest onset of the imperfect coins",
                    max(onsets.sharp_edge[coin] for coin in COINS if "imperfect" in coin),
                    "=",
                    0,
                    "at every restitution",
                ),
                Criterion(
                    "least of the ideal ones",
                    min(onsets.sharp_edge[coin] for coin in COINS if "imperfect" not in coin),
                    "≥",
                    THIN_ROUGH - SEARCH_ERROR,
                    "√5/3, less the error of the search",
                ),
            ],
        ),
        Claim(
            claim="no random impact of sharp_edge, perfectly_rough or coulomb adds energy below its onset",
            criteria=[Criterion("largest share that does", max(below_onset), "=", 0, "none")],
        ),
        Claim(
            claim="for the thin ideal coin sharp_edge and perfectly_rough begin at χ = √5/3",
            criteria=[
                _largest(
                    "difference from it",
                    [
                        abs(one["thin ideal"] - THIN_ROUGH)
                        for one in (onsets.sharp_edge, onsets.perfectly_rough)
                    ],
                )
            ],
        ),
        Claim(
            claim="for the thin ideal coin coulomb and sliding_friction begin where the closed forms say",
            criteria=[
                _largest(
                    "difference from them",
                    [
                        abs(chi - closed_form(mu))
                        for onset, closed_form in (
                            (onsets.coulomb, kane_onset),
                            (onsets.sliding_friction, sliding_onset),
                        )
                        for chi, mu in zip(onset, FRICTIONS_OF_ONSETS, strict=True)
                    ],
                )
            ],
        ),
        Claim(
            claim="for the thin ideal coin sliding_friction has a solution up to μ = √5/2",
            criteria=[
                _largest("difference from it", [abs(onsets.without_solution["thin ideal"] - THIN_SLIDING)])
            ],
        ),
        Claim(
            claim="sharp_edge, knurled and perfectly_rough pull in some impacts, and no other law",
            criteria=_only({law: max(record.pulls) for law, record in laws.items()}, pulling),
        ),
        Claim(
            claim="smooth, sliding_friction and coulomb stay in the friction cone, the others do not",
            criteria=_only({law: max(record.leaves_cone) for law, record in laws.items()}, leaving),
        ),
    )


def _largest(quantity: str, values: list[float], threshold: float = SEARCH_ERROR) -> Criterion:
    reason = "rounding" if threshold == ROUNDING else "the error of the search"
    return Criterion(f"largest {quantity}", max(values), "<", threshold, reason)


def _only(shares: dict[str, float], chosen: tuple[str, ...]) -> list[Criterion]:
    """Return as criteria that the chosen laws do it in some impacts, the others in none."""
    least, most = min(shares[law] for law in chosen), max(shares[law] for law in shares if law not in chosen)
    return [
        Criterion("least of their largest shares", least, ">", 0, "some impacts"),
        Criterion("largest share of the others", most, "=", 0, "no impact"),
    ]


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
    frictions = [f"μ = {mu:g}" for mu in FRICTIONS_OF_ONSETS]
    energy = [
        [
            _NAMES.get(law, law),
            *(_percent(record.gains[i]) for i in shown),
            _number(record.median_gain[shown[2]]),
            _number(max(record.largest_change)),
        ]
        for law, record in laws.items()
    ]
    coins = [
        [_NAMES.get(law, law), *(_percent(of_coin[shown[2]]) for of_coin in record.gains_by_coin)]
        for law, record in laws.items()
    ]
    friction = [
        [
            _NAMES.get(law, law),
            *(_percent(record.pulls[shown[i]]) for i in (1, 2)),
            *(_percent(record.leaves_cone[shown[i]]) for i in (1, 2)),
            *(_number(mu) for mu in (record.friction_for_half, record.friction_for_most)),
            _percent(_mean(record.without_solution)),
        ]
        for law, record in laws.items()
    ]
    extremes = [
        ["sharp_edge adds energy from χ =", *(f"{onsets.sharp_edge[coin]:.6f}" for coin in COINS)],
        ["perfectly_rough adds energy from χ =", *(f"{onsets.perfectly_rough[coin]:.6f}" for coin in COINS)],
        ["sliding_friction has no solution from μ =", *(f"{onsets.without_solution[c]:.6f}" for c in COINS)],
    ]
    kane = [
        ["sliding_friction, from χ =", *(f"{chi:.4f}" for chi in onsets.sliding_friction)],
        ["the same, closed form", *(f"{sliding_onset(mu):.4f}" for mu in FRICTIONS_OF_ONSETS)],
        ["coulomb, kinematic, from χ =", *(f"{chi:.4f}" for chi in onsets.coulomb)],
        ["the same, closed form", *(f"{kane_onset(mu):.4f}" for mu in FRICTIONS_OF_ONSETS)],
    ]
    unsolved = [["share of impacts", *(_percent(share) for share in found.share_without_solution)]]
    return "\n\n".join(
        [
            f"{found.count} random impacts for each law and restitution χ, seed {found.seed}.",
            "Impacts that add energy; gains over the kinetic energy before the impact.",
            table(
                ["law", *(f"χ = {chi:g}" for chi in SHOWN), "median gain, χ = 0.8", "largest, any χ"],
                energy,
            ),
            "The same by coin, at χ = 0.8.",
            table(["law", *COINS], coins),
            "Impacts that pull on the coin (S_z < 0), and that leave the friction cone, μ drawn from 0 to 1. "
            "Over all χ: the μ that would do for a half and for 95 % of the impacts, and the share without a "
            "solution.",
            table(
                [
                    "law",
                    "pull, χ = 0.5",
                    "χ = 0.8",
                    "leave cone, χ = 0.5",
                    "χ = 0.8",
                    "μ for half",
                    "μ for 95 %",
                    "no solution",
                ],
                friction,
            ),
            "The extremes over all impacts, found by search. "
            f"For the thin ideal coin √5/3 = {THIN_ROUGH:.6f} and √5/2 = {THIN_SLIDING:.6f}.",
            table(["coin", *COINS], extremes),
            "The thin ideal coin gains energy from the floor:",
            table(["law", *frictions], kane),
            "Impacts in which sliding_friction has no solution: as printed it would pull (S_z < 0).",
            table(["", *(f"μ = {mu:g}" for mu in FRICTIONS_WITHOUT_SOLUTION)], unsolved),
        ]
    )


def _percent(share: float) -> str:
    return "0" if share == 0 else f"{100 * share:.2f} %"


def _number(value: float | None) -> str:
    return "none" if value is None else "0" if value == 0 else f"{value:.3g}"


def _mean(values: list[float]) -> float:
    return sum(values) / len(values)


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
        axes.set_xlabel("restitution χ")
        axes.set_xticks([0.2, 0.4, 0.6, 0.8, 1.0])
    picture.legend(loc="outside lower center", ncols=4)
    return picture


def _friction(found: ContactRecord) -> Figure:
    picture = Figure(figsize=(6, 3.6))
    axes = picture.subplots()
    for law in ("slip_preserving", "sharp_edge", "perfectly_rough", "knurled"):
        share = [100 * part for part in found.laws[law].friction_sufficient]
        axes.plot(FRICTIONS_SUFFICIENT, share, label=law, markevery=6, **_LINES[law])
    axes.set_xlabel("friction μ of the floor")
    axes.set_ylabel("impacts within its cone [%]")
    axes.set_xlim(0, FRICTIONS_SUFFICIENT[-1])
    axes.set_ylim(0, 101)
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
    axes.set_xlabel("friction μ")
    axes.set_ylabel("restitution from which\nthe law can add energy")
    axes.set_xlim(0, top)
    axes.set_ylim(0, 1.02)
    axes.legend(loc="center right")
    return picture


REPRODUCTION = Reproduction(
    title="when each contact law adds energy, pulls, leaves the friction cone, or has no solution",
    seconds=60,
    make=lambda progress: result(compute(COUNT, SEED, progress)),
    read=lambda folder: result(read_numbers(folder, ContactRecord)),
    draw={"energy": _energy, "friction": _friction, "onset": _onset},
)
