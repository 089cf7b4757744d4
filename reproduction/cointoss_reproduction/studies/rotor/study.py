"""Why so many tosses stay uncertain: a bouncing rotor, a chain of touches with random phases, its law."""

from collections.abc import Callable, Iterator, Mapping
from math import log
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from cointoss import Scenario, analytic
from cointoss.study import Array, Estimate, rows_from_states, share
from cointoss_reproduction.frame.cells import Cells, estimate, kept_rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import quotient
from cointoss_reproduction.setups.general_coins import CoinClass
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS, case, planar_rows
from cointoss_reproduction.setups.uncertain_shares import (
    ACCURACIES,
    CHIS,
    SMOOTH,
    case_of,
    share_at,
    slope_between,
)
from cointoss_reproduction.studies.rotor.law import asked, exponent, logarithm
from cointoss_reproduction.studies.rotor.picture import draw
from cointoss_reproduction.studies.rotor.splitting import coin_of, shares_beyond

SEED = 54
RUNS = 20
"""The number of runs of the splitting; their scatter gives the intervals."""
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
WOBBLES = {"flat, in one plane": 0.0, "flat, with a wobble": 3.0}
"""Standard deviation of the spin about the other axes [rad/s]."""
THICKNESSES = {"2 mm": 2e-3, "7.5 mm": 7.5e-3}


def compare(
    floor: str, chi: float, tosses: int = 20_000, levels: int = len(ACCURACIES), out: Path | None = None
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
    runs = np.random.default_rng(SEED).spawn(RUNS)
    return np.array([shares_beyond(scenario, stretches, rng, tosses) for rng in runs])


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
    met = isinstance(counted, Estimate) and counted.low > 0
    return {**row, "counted": counted, "ratio": quotient(row["predicted"], counted) if met else None}


def go_on(far: float, tosses: int = 20_000, decades: int = DECADES) -> Iterator[dict[str, Any]]:
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


def thick(
    thickness: float, of: float, tosses: int = 20_000, pairs: int = 100_000
) -> Iterator[dict[str, Any]]:
    """Yield f of a thick planar coin in vacuum, by the chain and as tosses and their neighbours have it."""
    scenario = case(air=False, restitution=of).replace("coin.thickness", thickness)
    rng = np.random.default_rng(SEED)
    z, spin = rng.uniform(*HEIGHTS, pairs), rng.uniform(*SPINS, pairs)
    yield from paired(scenario, lambda step: planar_rows(scenario, z + step, spin), tosses)


def tumbling(
    released: str, tossed: float, tosses: int = 20_000, tumblers: int = 10_000
) -> Iterator[dict[str, Any]]:
    """Yield f of a thin coin that does not keep its plane, in air, beside the chain of the planar one."""
    planar = case(air=True, restitution=tossed)
    kind = CoinClass(thick=False, imperfect=False, air=True, coulomb=False)
    states, scenario = kind.starts(tumblers), kind.scenario.replace("floor.restitution", tossed)
    if released in WOBBLES:
        states[:, 3:10] = FLAT
        states[:, [10, 12]] = np.random.default_rng(SEED).normal(0, WOBBLES[released], (tumblers, 2))
    higher = np.eye(states.shape[1])[2]
    yield from paired(planar, lambda step: rows_from_states(scenario, states + step * higher), tosses)


def paired(scenario: Scenario, rows: Callable[[float], Array], tosses: int) -> Iterator[dict[str, Any]]:
    """Yield what the chain predicts at each of `PAIRED`, and the share of tosses that ε more or less changes.

    Args:
        scenario: of the chain.
        rows: the tosses of the analytic engine with so much more height.
        tosses: of the chain, at each level.
    """
    outcome = analytic.toss_rows(rows(0.0)).outcome
    predicted = by_chain(scenario, len(PAIRED), tosses)
    for row in rows_of(predicted):
        sides = [
            analytic.toss_rows(rows(step)).outcome != outcome for step in (-row["accuracy"], row["accuracy"])
        ]
        yield with_ratio(row, share(sides[0] | sides[1]))


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
    Cells(tumbling, {"released": (*WOBBLES, "in any attitude"), "tossed": (0.3, 0.6)}),
    found=found,
    draw={"rotor": draw},
)
