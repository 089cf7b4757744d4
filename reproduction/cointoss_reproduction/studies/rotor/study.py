"""Why so many tosses stay uncertain: a bouncing rotor, a chain of touches with random phases, its law."""

from collections.abc import Iterator, Mapping, Sequence
from math import inf, log
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from cointoss import Scenario, analytic, load
from cointoss.study import Array, Estimate, rows_from_states, run, share, states_of
from cointoss_reproduction.frame.cells import Cells, estimate, kept_rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import quotient
from cointoss_reproduction.setups.general_coins import CoinClass
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS, case, planar_rows
from cointoss_reproduction.setups.uncertain_shares import (
    ACCURACIES,
    CEILING,
    CHIS,
    SMOOTH,
    case_of,
    share_at,
    slope_between,
)
from cointoss_reproduction.studies.rotor.chain import CONTACTS, COUNTED, NORMAL, above, bounce_all, unknown
from cointoss_reproduction.studies.rotor.law import asked, exponent, logarithm
from cointoss_reproduction.studies.rotor.picture import draw, draw_contact
from cointoss_reproduction.studies.rotor.splitting import coin_of, shares_beyond, started, turned_back

SEED = 54
RUNS = 20
"""The number of runs of the splitting; their scatter gives the intervals."""
MANY = 4
"""How many times the tosses there are at the first level of the splitting."""
DECADES = 91
"""Accuracies at which the law is evaluated, down to 1e-93 m."""
WINDOW = {1e-6: 1e-9, 1e-12: 1e-18, 1e-18: 1e-24}
"""The accuracies between which exponents are compared [m]."""
COMPARED = 1e-9
"""The accuracy at which the claims compare them [m]."""
LEAST = 0.3
"""Restitution from which the counts there are enough."""
UNCOUNTED = "`cointoss reproduce predictability` has not been run into this folder"
FAR = 10
"""Decades over which an exponent is taken there."""
PAIRED = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
"""Accuracies at which tosses of an engine are compared with their neighbours [m]."""
FLAT = (0, 0, 0, 1, 0, 0, 0)
"""At rest, with the attitude of a coin that lies [m/s, Euler parameters]."""
UP = np.eye(13)[2]
"""More height, of a state at release."""
FINER = analytic.AnalyticSettings(contact_tolerance=1e-13)
"""Steps of contact whose error is 10⁴ times smaller than usual."""
WOBBLES = {"flat, in one plane": 0.0, "flat, wobble 3 rad/s": 3.0, "in any attitude": inf}
"""Standard deviation of the spin about the other axes [rad/s]."""
TUMBLERS = {
    f"{'2 mm' if thick else 'thin'}, {'air' if air else 'vacuum'}": CoinClass(
        thick=thick, imperfect=False, air=air, coulomb=False
    )
    for thick in (False, True)
    for air in (True, False)
}
FEW = (0.3, 0.6)
"""Restitutions at which coins other than the first are compared."""
SPACE_ACCURACIES = (1e-3, 1e-6, 1e-9, 1e-12)
"""Accuracies at which coins in space are compared [m]."""
BARRIERS = {
    "below 0.1": (0.0, 0.1),
    "0.1 to 0.3": (0.1, 0.3),
    "0.3 to 0.5": (0.3, 0.5),
    "above 0.5": (0.5, inf),
}
"""Sines of the tilt at which L_z and L_ζ turn back a coin that turns with m g r."""
TABLE = load("table").replace("ending.test", "rigorous")
ON_SMOOTH = TABLE.replace("floor", {"restitution": TABLE.floor.restitution, "contact": "smooth"})
ZLOTY = load("zloty").coin
REAL = {
    "euro, smooth": ON_SMOOTH,
    "euro, μ = 0.03": ON_SMOOTH.replace("floor.contact", "coulomb", "floor.friction", 0.03),
    "euro, μ = 0.3": ON_SMOOTH.replace("floor.contact", "coulomb", "floor.friction", 0.3),
    "euro, μ = 0.3 and resistance (`table`)": TABLE,
    "euro, perfectly rough": ON_SMOOTH.replace("floor.contact", "perfectly_rough"),
    "zloty, smooth": ON_SMOOTH.replace("coin", ZLOTY),
    "zloty, on the floor of `table`": TABLE.replace("coin", ZLOTY),
}
"""Coins and floors of one restitution."""
THICKNESSES = {"2 mm": 2e-3, "7.5 mm": 7.5e-3}


def compare(
    floor: str, chi: float, tosses: int = 4000, levels: int = len(ACCURACIES), out: Path | None = None
) -> Iterator[dict[str, Any]]:
    """Yield f and α of the planar coin at each accuracy, by the chain and as `predictability` has them."""
    if chi not in CHIS[floor]:
        return
    where = f"quantity == 'height' and floor == '{floor}' and chi == {chi}"
    known = {row["accuracy"]: row for row in kept_rows("predictability", out, where)}
    for row in rows_of(by_chain(case_of(floor, chi), levels, tosses)):
        other = known.get(row["accuracy"])
        f, alpha = (other and estimate(other, name) for name in ("share", "alpha"))
        yield with_ratio(row, f) | {"counted_alpha": alpha if row["window"] else None}


def by_chain(scenario: Scenario, levels: int, tosses: int) -> Array:
    """Return the share of tosses that part at each accuracy, a decade apart from 1 mm on, (RUNS, levels)."""
    stretches = log(scenario.coin.radius / ACCURACIES[0]) + log(10) * np.arange(float(levels))
    return np.array(
        [
            shares_beyond(scenario, planar_states(scenario, rng, MANY * tosses), stretches, rng, tosses)
            for rng in np.random.default_rng(SEED).spawn(RUNS)
        ]
    )


def planar_states(scenario: Scenario, rng: np.random.Generator, count: int) -> Array:
    """Draw releases with the heights and spins of the maps, flat and at rest but for the spin, (n, 13)."""
    z, spins = rng.uniform(*HEIGHTS, count), rng.uniform(*SPINS, count)
    return states_of(planar_rows(scenario, z, spins))


def rows_of(shares: Array) -> Iterator[dict[str, Any]]:
    """Yield the predicted share at each accuracy, and the exponent of the window that starts there."""
    whole, accuracies = np.ones_like(shares), ACCURACIES[: shares.shape[1]]
    for level, accuracy in enumerate(accuracies):
        end = WINDOW.get(accuracy)
        slope = slope_between(shares, whole, level, accuracies.index(end)) if end in accuracies else None
        yield {
            "accuracy": accuracy,
            "predicted": share_at(shares, whole, level),
            "window": slope and f"{accuracy:.0e} to {end:.0e}",
            "predicted_alpha": slope,
        }


def with_ratio(row: Mapping[str, Any], counted: Any) -> dict[str, Any]:
    """Return a row with what was counted, and what is predicted over that where its interval excludes 0."""
    met = isinstance(counted, Estimate) and ratio(row["predicted"], counted)
    return {**row, "counted": counted, "ratio": met or None}


def go_on(far: float, tosses: int = 6000, decades: int = DECADES) -> Iterator[dict[str, Any]]:
    """Yield α far below every accuracy that means anything, by the chain and by the law of the limit."""
    scenario = case(air=False, restitution=far)
    coin, radius = coin_of(scenario), scenario.coin.radius
    shares = by_chain(scenario, decades, tosses)
    energy = HEIGHTS[1] / radius + coin.inertia * SPINS[1] ** 2 * radius / scenario.gravity / 2
    for level in range(FAR, decades - FAR, FAR):
        middle = log(radius / ACCURACIES[0]) + log(10) * (level + FAR / 2)
        slope = slope_between(shares, np.ones_like(shares), level, level + FAR)
        law = exponent(far, energy, middle)
        yield {
            "decades": level + 3 + FAR // 2,
            "far_alpha": slope,
            "law": law,
            "off": slope - law,
            "smooth": asked(1.0, far, energy) / log(10),
            "growth": 1 / (2 * logarithm(far, energy)),
        }


def thick(thickness: float, of: float, tosses: int = 5000, pairs: int = 50_000) -> Iterator[dict[str, Any]]:
    """Yield f of a thick planar coin in vacuum, by the chain and as tosses and their neighbours have it."""
    scenario = case(air=False, restitution=of).replace("coin.thickness", thickness)
    states = planar_states(scenario, np.random.default_rng(SEED), pairs)
    for row in rows_of(by_chain(scenario, len(PAIRED), tosses)):
        yield with_ratio(row, share(differ(scenario, states, row["accuracy"])))


def tumbling(
    coin: str, released: float, tossed: float, chained: int = 3000, tumblers: int = 6000
) -> Iterator[dict[str, Any]]:
    """Yield f of a coin that does not keep its plane, split by whether it comes into sustained contact.

    Args:
        coin: one of `TUMBLERS`; the first at every restitution, others at `FEW` out of one plane.
        released: standard deviation of its spin about the other axes; in any attitude where infinite [rad/s].
        tossed: restitution.
        chained: tosses by the chain.
        tumblers: tosses by the engine; a third in vacuum and above `FEW`, where they last longer.
    """
    kind = TUMBLERS[coin]
    if (kind.thick or not kind.air) and (tossed not in FEW or released == 0):
        return
    scenario = kind.scenario.replace("floor.restitution", tossed)
    stretch, held, apart = thrice(scenario, releases(kind, released, chained))
    states = releases(kind, released, tumblers if kind.air and tossed <= max(FEW) else tumblers // 3)
    finer = outcomes(scenario, states, FINER) != outcomes(scenario, states)
    for accuracy, by_engine in counted(scenario, states, SPACE_ACCURACIES):
        parted = stretch > log(scenario.coin.radius / accuracy)
        predicted = {"contact": share(held)} | split(held, parted, apart)
        yield {
            "accuracy": accuracy,
            **{f"predicted_{name}": each for name, each in predicted.items()},
            **by_engine,
            **{f"{name}_ratio": ratio(predicted[name], by_engine[name]) for name in predicted},
            "rounded": share(finer),
        }


def thrice(scenario: Scenario, states: Array) -> tuple[Array, NDArray[np.bool_], NDArray[np.bool_]]:
    """Return how far the chain stretches, whether it comes into contact, and whether three chains part.

    Tosses that part do not forget L_z and L_ζ, which prefer a face. So three chains of one release agree more
    often than fair coins.

    Args:
        scenario: coin, air and floor.
        states: at release, (n, 13).

    Returns:
        Logarithms of the stretch, (n,); of the last of the chains, as what follows, (n,) twice.
    """
    coin, known, ends = coin_of(scenario), unknown(len(states)), []
    for rng in np.random.default_rng(SEED).spawn(3):
        moved, known = started(scenario, states), unknown(len(states))
        bounce_all(coin, moved, known, inf, rng)
        ends.append([0.0 if above(coin, end) > 0 else np.sign(end[NORMAL, 2].real) for end in moved])
    return known[:, COUNTED], known[:, CONTACTS] > 0, np.ptp(ends, axis=0) > 0


def behind(
    barrier: tuple[float, float], dropped: float, chained: int = 3000, tumblers: int = 4000
) -> dict[str, Any]:
    """Return the share of thin coins in air and any attitude that comes into contact, by `turned_back`.

    Args:
        barrier: one of `BARRIERS`.
        dropped: restitution.
        chained: tosses by the chain, of all barriers.
        tumblers: tosses by the engine.
    """
    kind = next(iter(TUMBLERS.values()))
    scenario = kind.scenario.replace("floor.restitution", dropped)
    chain, engine = (
        states[(barrier[0] <= sines) & (sines < barrier[1])]
        for states in (releases(kind, inf, chained), releases(kind, inf, tumblers))
        for sines in [turned_back(coin_of(scenario), started(scenario, states))]
    )
    predicted, held = share(thrice(scenario, chain)[1]), share(in_contact(scenario, engine))
    return {"chained_contact": predicted, "tossed_contact": held, "behind_ratio": ratio(predicted, held)}


def on_floors(real: str, rolled: int = 1000) -> Iterator[dict[str, Any]]:
    """Yield f of a coin on one of `REAL` floors, tossed in one plane and in any attitude.

    Args:
        real: its name.
        rolled: tosses by the engine.
    """
    plane, any_ = (
        counted(REAL[real], releases(TUMBLERS["2 mm, air"], wobble, rolled), SPACE_ACCURACIES[:2])
        for wobble in (0.0, inf)
    )
    for (accuracy, flat), (_, turned) in zip(plane, any_, strict=True):
        in_plane = {f"{name}_in_plane": each for name, each in flat.items()}
        yield {"accuracy": accuracy, **in_plane, **turned, "times": ratio(turned["f"], flat["f"])}


def releases(kind: CoinClass, wobble: float, count: int) -> Array:
    """Return states at release, (count, 13): of the class, or flat with a wobble of this size [rad/s]."""
    states = kind.starts(count)
    if wobble < inf:
        states[:, 3:10] = FLAT
        states[:, [10, 12]] = np.random.default_rng(SEED).normal(0, wobble, (count, 2))
    return states


def outcomes(
    scenario: Scenario, states: Array, settings: analytic.AnalyticSettings = analytic.MANY
) -> NDArray[np.int8]:
    """Return how tosses end, (n,).

    Args:
        scenario: coin, air and floor.
        states: at release, (n, 13).
        settings: of the engine.
    """
    return analytic.toss_rows(rows_from_states(scenario, states), settings=settings).outcome


def counted(
    scenario: Scenario, states: Array, accuracies: Sequence[float]
) -> Iterator[tuple[float, dict[str, Any]]]:
    """Yield each accuracy [m], and the share in contact and `split` of an engine's tosses there.

    Args:
        scenario: coin, air and floor.
        states: at release, (n, 13).
        accuracies: of the height [m].
    """
    held = in_contact(scenario, states)
    for accuracy in accuracies:
        yield accuracy, {"contact": share(held)} | split(held, differ(scenario, states, accuracy))


def in_contact(scenario: Scenario, states: Array) -> NDArray[np.bool_]:
    """Return whether an engine's tosses come into contact before their faces are settled, (n,)."""
    return np.array([len(run(scenario.body, scenario.rules, state).contacts) > 0 for state in states])


def differ(scenario: Scenario, states: Array, step: float) -> NDArray[np.bool_]:
    """Return whether tosses with this much more or less height [m] end with another outcome, (n,)."""
    below, usual, above_ = (outcomes(scenario, states + side * step * UP) for side in (-1, 0, 1))
    return (below != usual) | (above_ != usual)


def split(
    held: NDArray[np.bool_], parted: NDArray[np.bool_], apart: NDArray[np.bool_] | None = None
) -> dict[str, Estimate]:
    """Return f of tosses that never are in contact, of those that are, and of all.

    Args:
        held: whether a toss comes into contact before its face is settled, (n,).
        parted: whether it is uncertain, (n,).
        apart: of a chain, whether three of one release end otherwise, (n,).
    """
    found = {}
    for name, which in (("never", ~held), ("do", held), ("f", np.ones_like(held))):
        found[name] = share(parted[which])
        if apart is not None:
            both = parted & which
            weight = apart[both].mean() / CEILING if both.any() else 1.0
            value, low, high = (float(min(each, CEILING) * weight) for each in found[name].ends)
            found[name] = Estimate(value, low, high, found[name].count, found[name].counted)
    return found


def ratio(predicted: Estimate, counted: Estimate) -> Estimate | None:
    """Return what is predicted over what is counted, where the latter's interval excludes 0."""
    return quotient(predicted, counted) if counted.low > 0 else None


def found(cells: pd.DataFrame) -> dict[str, Any]:
    """Return the predictions over what `predictability` has counted, and whether it has."""
    planar, finest = (ratios(cells, accuracy) for accuracy in (COMPARED, ACCURACIES[-1]))
    values = [ratio.value for ratio in planar.values()]
    return {
        "of_planar": planar,
        "of_finest": finest,
        "range": f"from {min(values):.2f} to {max(values):.2f}" if values else "-",
        "uncounted": "" if planar else UNCOUNTED,
        "unreached": "" if finest else UNCOUNTED,
    }


def ratios(cells: pd.DataFrame, accuracy: float) -> dict[str, Estimate]:
    """Return what is predicted over what was counted at an accuracy [m], by floor and restitution."""
    rows = cells.query(f"accuracy == {accuracy} and chi >= {LEAST}").to_dict("records")
    each = {f"{row['floor']}, {row['chi']:g}": estimate(row, "ratio") for row in rows}
    return {name: ratio for name, ratio in each.items() if isinstance(ratio, Estimate)}


CASES = {"floor": tuple(CHIS), "chi": CHIS[SMOOTH][1:]}
REPRODUCTION = study(
    __name__,
    Cells(compare, CASES),
    Cells(go_on, {"far": (0.3, 0.6, 0.8)}),
    Cells(thick, {"thickness": THICKNESSES, "of": (0.3, 0.6)}),
    Cells(tumbling, {"coin": tuple(TUMBLERS), "released": WOBBLES, "tossed": (0.2, 0.3, 0.6, 0.9)}),
    Cells(behind, {"barrier": BARRIERS, "dropped": FEW}),
    Cells(on_floors, {"real": tuple(REAL)}),
    found=found,
    draw={"rotor": draw, "contact": draw_contact},
)
