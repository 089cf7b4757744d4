"""What the edge study shows: shares with their intervals, tables and the figure."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss import Outcome
from cointoss.study import (
    BLUE,
    GREEN,
    GREY,
    INK,
    LEVEL,
    ORANGE,
    VERMILION,
    Estimate,
    in_words,
    paragraphs,
    percent,
    table,
)
from cointoss_reproduction.setups.edge_classes import (
    DIAMETER,
    DIAMETRAL,
    HANDS,
    NICKEL,
    PUBLISHED,
    SEED,
    WOBBLING,
    corner,
    edge_by_angle,
    edge_by_solid_angle,
    edge_of_die,
    three_way,
)
from cointoss_reproduction.setups.edge_record import ANGLE, LAWS, SOLID_ANGLE, EdgeRecord
from cointoss_reproduction.setups.edge_thrown import QUOTED, THROWS, fitted_floor, quoted
from cointoss_reproduction.setups.ends import alike, ended_as, on_edge, tosses

DRAWS = 2000
"""Samples by which the intervals of the fair coin are found."""
COLORS = (INK, BLUE, GREEN, ORANGE, VERMILION)
FLOOR, LEAST_SCATTER = 5e-5, 0.03
"""The least share that is drawn, and where no scatter of ψ is [deg]."""


def fair(found: EdgeRecord, wobble: str, chi: str) -> Estimate:
    """Return the h/D of the coin that ends on its edge in a third of the tosses.

    Its interval is of samples drawn from the shares found; where one has no such coin, it is open.
    """
    curve = found.curves[wobble][chi]
    aspects = np.array([float(aspect) for aspect in curve])
    edges = np.array([ended_as(ends, Outcome.EDGE) for ends in curve.values()])
    counts = np.array([tosses(ends) for ends in curve.values()])
    value, drawn = three_way(aspects, edges, counts, np.random.default_rng(SEED), DRAWS)
    low, high = np.quantile(np.where(np.isnan(drawn), np.inf, drawn), [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
    return Estimate(value, float(low), float(high), int(counts.sum()))


def tables(found: EdgeRecord) -> str:
    """Return the tables, in Markdown."""
    nickel = [
        [factor, *(percent(on_edge(found.nickel[wobble][factor])) for wobble in HANDS)]
        for factor in found.nickel[DIAMETRAL]
    ]
    wobbles = [[f"{scatter}°", percent(on_edge(ends))] for scatter, ends in found.wobbles.items()]
    touches = []
    for turned, touch in found.touches.items():
        aspect, law, formula = LAWS[turned]
        parts = [percent(part) for part in (touch.touched, touch.let_go)]
        touches.append(
            [turned, f"{aspect:.3f}", f"{formula} = {law(aspect):.3f}", *parts, f"{touch.energy:.1f}"]
        )
    fairest = [
        [f"χ = {chi}", *(_fair(found, wobble, chi) for wobble in HANDS)] for chi in found.curves[DIAMETRAL]
    ]
    engines = [
        [
            name,
            *(percent(on_edge(ends)) for ends in counts.values()),
            *(str(ended_as(ends, Outcome.UNDECIDED)) for ends in counts.values()),
            f"{alike(counts.values()):.2g}",
        ]
        for name, counts in found.engines.items()
    ]
    touched = "h/D | its law | C on the edge's side | let go at rest | energy left"
    by_both = "on edge, analytic | MuJoCo | undecided, analytic | MuJoCo | probability by chance"
    return paragraphs(
        "Shares are of tosses that end on edge, in brackets their 99 % intervals.",
        table(["the nickel", *HANDS], nickel),
        table("the nickel, scatter of ψ | on edge", wobbles),
        _tipping(),
        _ways(found),
        table(f"at the first touch, turned | {touched}", touches),
        _curves(found, DIAMETRAL),
        _die(found),
        _curves(found, WOBBLING),
        table(["h/D of the coin that is fair three ways", *HANDS], fairest),
        table(f"by both engines | {by_both}", engines),
        _thrown(found),
    )


def _thrown(found: EdgeRecord) -> str:
    """Return the shares of thrown coins, by floor and as they are quoted."""
    chi, chance = fitted_floor(found.thrown)
    rows = [
        [f"quoted of {THROWS:,d} throws each", *(percent(quoted(aspect)) for aspect in QUOTED)],
        *(
            [floor, *(percent(on_edge(each)) for each in ends.values())]
            for floor, ends in found.thrown.items()
        ),
    ]
    return paragraphs(
        table(
            ["thrown as people do, but where said", *(f"h/D = {float(aspect):.3f}" for aspect in QUOTED)],
            rows,
        ),
        f"One restitution for both coins, μ = 0.3: χ = {in_words(chi, '.2f')}. By chance shares differ as "
        f"much from the model's with a probability of {chance:.2g}.",
    )


def _tipping() -> str:
    """Return what tips a nickel that stands on its edge."""
    r, h = DIAMETER / 2, NICKEL * DIAMETER
    rise = np.hypot(r, h / 2) - r
    lean, push = np.degrees(corner(NICKEL)), 1e3 * (2 * 9.81 * rise) ** 0.5
    return (
        f"A nickel that stands on its edge falls when it leans by more than {lean:.1f}°; to tip it C must "
        f"rise by {1e3 * rise:.3f} mm, as a push of {push:.0f} mm/s does."
    )


def _ways(found: EdgeRecord) -> str:
    if not found.times:
        return "No nickel tossed as people do came to rest on its edge."
    quartiles = [np.quantile(values, (0.25, 0.5, 0.75)) for values in (found.times, found.ways)]
    times, ways = ([f"{value:.2f}" for value in values] for values in quartiles)
    return (
        f"Of people's tosses {len(found.times)} nickels on edge were followed: from the last impact to rest "
        f"they took {times[1]} s in the median (quartiles {times[0]} and {times[2]} s), and came {ways[1]} m "
        f"far ({ways[0]} and {ways[2]} m), as the crow flies."
    )


def _curves(found: EdgeRecord, wobble: str) -> str:
    by_chi = found.curves[wobble]
    return table(
        [f"tossed {wobble}: h/D", *(f"χ = {chi}" for chi in by_chi)],
        [
            [f"{float(aspect):.3g}", *(percent(on_edge(curve[aspect])) for curve in by_chi.values())]
            for aspect in next(iter(by_chi.values()))
        ],
    )


def _die(found: EdgeRecord) -> str:
    """Return the share on edge of a planar die, and where it is within the interval of the coin's."""
    by_chi = found.curves[DIAMETRAL]
    rows = []
    for aspect in next(iter(by_chi.values())):
        share = edge_of_die(float(aspect))
        held = [chi for chi, curve in by_chi.items() if holds(on_edge(curve[aspect]), share)]
        rows.append([f"{float(aspect):.3g}", f"{100 * share:.3g} %", ", ".join(held) or "none"])
    return table("a planar die: h/D | on edge | within the coin's interval at χ =", rows)


def holds(estimate: Estimate, value: float) -> bool:
    """Return whether a value is within the interval of an estimate."""
    return estimate.low <= value <= estimate.high


def _fair(found: EdgeRecord, wobble: str, chi: str) -> str:
    one = fair(found, wobble, chi)
    return in_words(one, ".3f") if np.isfinite(one.value) else "none"


def draw(found: EdgeRecord) -> Figure:
    """Draw the share on edge over h/D, and the coin that is fair three ways over χ."""
    picture = Figure(figsize=(9.5, 7))
    (plain, people), (fairest, wobbling) = picture.subplots(2, 2)
    for axes, wobble in ((plain, DIAMETRAL), (people, WOBBLING)):
        _draw_curves(axes, found, wobble)
    for wobble, color in zip(HANDS, (BLUE, VERMILION), strict=True):
        ones = [(float(chi), fair(found, wobble, chi)) for chi in found.curves[wobble]]
        known = [(chi, one) for chi, one in ones if np.isfinite([one.value, one.low, one.high]).all()]
        for chi, one in known:
            fairest.plot([chi, chi], [one.low, one.high], color=color)
        fairest.plot(
            [chi for chi, _ in known], [one.value for _, one in known], "o-", color=color, label=wobble
        )
    for aspect, label in ((ANGLE, "angle, 0.577"), (SOLID_ANGLE, "solid angle, 0.354")):
        fairest.axhline(aspect, color=GREY, linestyle="--", linewidth=0.9)
        fairest.annotate(label, (0.02, aspect), xycoords=("axes fraction", "data"), va="bottom")
    fairest.set(title="fair three ways", xlabel="χ", ylabel="h/D", ylim=(0, None))
    fairest.legend(loc="lower left")
    scattered = {0.0: found.nickel[DIAMETRAL]["as said"], 10.0: found.nickel[WOBBLING]["as said"]}
    scattered |= {float(scatter): ends for scatter, ends in found.wobbles.items()}
    for scatter, ends in sorted(scattered.items()):
        part, at = on_edge(ends), max(scatter, LEAST_SCATTER)
        wobbling.plot([at, at], [max(part.low, FLOOR), part.high], color=INK, linewidth=1)
        wobbling.plot(at, max(part.value, FLOOR), "o", color=INK, markersize=4)
    wobbling.axhline(PUBLISHED, color=GREY, linestyle="--", linewidth=0.9)
    wobbling.annotate(
        "1 in 6,000", (0.98, PUBLISHED), xycoords=("axes fraction", "data"), ha="right", va="bottom"
    )
    wobbling.set(title="the nickel", xlabel="scatter of ψ [deg] (leftmost: none)", ylabel="share on edge")
    wobbling.set(xscale="log", yscale="log", ylim=(FLOOR, 1))
    return picture


def _draw_curves(axes: Axes, found: EdgeRecord, wobble: str) -> None:
    for (chi, curve), color in zip(found.curves[wobble].items(), COLORS, strict=False):
        aspects, parts = [float(aspect) for aspect in curve], [on_edge(ends) for ends in curve.values()]
        axes.fill_between(
            aspects, [p.low for p in parts], [p.high for p in parts], color=color, alpha=0.15, linewidth=0
        )
        axes.plot(aspects, [p.value for p in parts], "o-", color=color, markersize=2.5, label=f"χ = {chi}")
    x = np.geomspace(0.05, 4, 100)
    axes.plot(x, edge_by_angle(x), "--", color=GREY, linewidth=0.9, label="by angle")
    axes.plot(x, edge_by_solid_angle(x), ":", color=GREY, linewidth=0.9, label="by solid angle")
    if wobble == DIAMETRAL:
        axes.plot(x, edge_of_die(x), "-.", color=GREY, linewidth=0.9, label="die in a plane")
    else:
        throws = [(float(aspect), quoted(aspect)) for aspect in QUOTED]
        spans = [[one.value - one.low for _, one in throws], [one.high - one.value for _, one in throws]]
        values = [one.value for _, one in throws]
        axes.errorbar([x for x, _ in throws], values, spans, fmt="kx", capsize=3, label="thrown", zorder=3)
    axes.axhline(1 / 3, color=GREY, linewidth=0.6)
    axes.set(
        title=f"tossed {wobble}",
        xlabel="h/D",
        ylabel="share on edge",
        xscale="log",
        xlim=(0.05, 4),
        ylim=(0, 1),
    )
    axes.legend(loc="upper left")
