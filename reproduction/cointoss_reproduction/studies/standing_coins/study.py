"""Section 5.2: whether general coins on the boundary between heads and tails come to stand on their edge."""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import cycle
from multiprocessing.pool import ThreadPool
from typing import Any

import numpy as np
import pandas as pd
from scipy.spatial.transform import Rotation
from scipy.stats import rankdata

from cointoss import Outcome, Scenario
from cointoss.analytic import AnalyticSettings
from cointoss.study import Array, FloorFriction, Pieces, run, share
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.precision.planar_coin import PlanarRelease, planar_coin, units
from cointoss_reproduction.precision.planar_numbers import spread, toss_many
from cointoss_reproduction.setups.estimates import mean
from cointoss_reproduction.setups.general_coins import CoinClass
from cointoss_reproduction.setups.halving import halved
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS, case
from cointoss_reproduction.studies.standing_coins.standing import Standing, standing

SEED = 522
CHI = 0.3
"""The restitution: so low that doubles resolve most boundaries."""
IN_AIR = {"thin, in air": False, "thick, in air": True}
"""Kinds of coin, and whether they are thick."""
SPANS = {"height": 0.02, "spin": 2.0, "tilt": 0.05}
"""What varies along a line of releases, and how far [m, rad/s, rad]."""
POINTS = 40
"""Points on a line."""
SETTINGS = AnalyticSettings(contact_steps=20_000)
STANDS = 1e-3
"""A coin that lacks no more than this comes to stand [m g r]."""
AT_REST = 0.01
"""A coin stands at rest if its energy is this near to that of the upright coin [m g r]."""
STAYS = {"thin, in air": True, "thick, in air": None}
"""Whether coins are known to stay so long: one thick coin of 68 stays five times as long."""
NEAR, FAR = 2.0**8, 2.0**14
"""Distances from a boundary, in last digits, at which the time that a coin stands is measured."""
FALLEN = 0.1
"""A coin has fallen when it leans this much further than at the top [rad]."""
AFTER, SAMPLED = 1.0, 1e-3
"""How long a coin is followed after its face is settled, and the steps in which its state is sampled [s]."""
BESIDE = Fraction(1, 10**12)
"""The distance from a release that lands flat to the neighbours that are tossed [m]."""
_HEADS_AND_TAILS = {int(Outcome.HEADS), int(Outcome.TAILS)}


@dataclass(frozen=True, kw_only=True)
class Boundary:
    """Two releases as near to each other as doubles are, with different outcomes."""

    scenario: Scenario
    start: Array
    """State from which the line of releases starts, (13,)."""
    quantity: str
    """What varies along it: one of `SPANS`."""
    places: tuple[float, float]
    """The places of the two releases on the line."""
    outcomes: tuple[int, int]


def sides(kind: bool, lines: int = 120) -> list[Mapping[str, Any]]:
    """Return what the coins at both sides of each boundary in air do, on random lines of releases."""
    with ThreadPool() as pool:
        found = pool.starmap(_sides, _lines(lines, thick=kind, air=True), chunksize=1)
    rows = [row for row in found if row is not None]
    part = rankdata([row["lack"] for row in rows]) / len(rows)
    return [{**row, "below": below} for row, below in zip(rows, part, strict=True)]


def in_vacuum(lines: int = 120) -> list[dict[str, bool]]:
    """Return of the boundaries of a thin coin in vacuum, on random lines, whether heads meet tails there."""
    with ThreadPool() as pool:
        found = pool.starmap(boundary_on, _lines(lines, thick=False, air=False), chunksize=1)
    return [{"meets": set(one.outcomes) == _HEADS_AND_TAILS} for one in found if one is not None]


def _lines(count: int, *, thick: bool, air: bool) -> list[tuple[Scenario, Array, str]]:
    """Return scenario, state and quantity that varies, of random lines of releases."""
    kind = CoinClass(thick=thick, imperfect=False, air=air, coulomb=False)
    scenario = kind.scenario.replace("floor.restitution", CHI)
    return [(scenario, *line) for line in zip(kind.starts(count), cycle(SPANS), strict=False)]


def at(start: Array, quantity: str, place: float) -> Array:
    """Return the state at a place of a line of releases, (13,)."""
    y = start.copy()
    if quantity == "height":
        y[2] = place
    elif quantity == "spin":
        y[11] = place
    else:
        attitude = Rotation.from_quat(start[6:10], scalar_first=True)
        y[6:10] = (Rotation.from_rotvec([place, 0, 0]) * attitude).as_quat(scalar_first=True)
    return y


def boundary_on(scenario: Scenario, start: Array, quantity: str) -> Boundary | None:
    """Return the middle one of the boundaries between heads and tails on a line, to the last digit.

    Args:
        scenario: coin, air and floor.
        start: state from which the line starts, (13,).
        quantity: what varies along it.

    Returns:
        The boundary, which in the end may have another outcome on one side; None without any.
    """
    body, rules = scenario.body, scenario.rules

    def outcome(place: float) -> int:
        return int(run(body, rules, at(start, quantity, place), SETTINGS).outcome)

    first = {"height": start[2], "spin": start[11], "tilt": 1.0}[quantity]
    places = np.linspace(first, first + SPANS[quantity], POINTS)
    found = [outcome(place) for place in places]
    changes = [i for i in range(POINTS - 1) if set(found[i : i + 2]) == _HEADS_AND_TAILS]
    if not changes:
        return None
    i = changes[len(changes) // 2]
    low, high = halved(float(places[i]), float(places[i + 1]), outcome)
    return Boundary(
        scenario=scenario,
        start=start,
        quantity=quantity,
        places=(low, high),
        outcomes=(outcome(low), outcome(high)),
    )


def _sides(scenario: Scenario, start: Array, quantity: str) -> Mapping[str, Any] | None:
    """Return what the coins at both sides of a line's boundary do; None where it has none.

    Returns:
        Their largest lack, how far they lean [deg], their energy [m g r], and by how much longer the coin
        stands at `NEAR` than at `FAR`, times the rate at which it falls, over ln(`FAR`/`NEAR`).
    """
    found = boundary_on(scenario, start, quantity)
    if found is None:
        return None
    lack, lean, E = max(
        (nearest(*followed(found, place)) for place in found.places), key=lambda side: side[0]
    )
    digit = np.spacing(max(np.abs(found.places)))
    stays = [
        _stay(*(followed(found, place + sign * digits * digit) for digits in (NEAR, FAR)))
        for place, sign in zip(found.places, (-1, 1), strict=True)
    ]
    return {"lack": lack, "lean": np.degrees(np.abs(lean)), "energy": E, "ratio": np.mean(stays)}


def followed(found: Boundary, place: float) -> tuple[Array, Standing]:
    """Return the times of a toss in contact [s], beyond that when it is settled, and how near it stands."""
    y = at(found.start, found.quantity, place)
    scenario = found.scenario
    end = run(scenario.body, scenario.rules, y, SETTINGS).end_time + AFTER
    # The paper's test counts all energies, those that lift no coin too: it ends the toss later.
    later = scenario.replace("ending.test", "paper", "ending.max_time", end)
    body, log = later.body, run(later.body, later.rules, y, SETTINGS)
    path = Pieces(
        body=body,
        friction=FloorFriction(0.0),
        contact_tolerance=SETTINGS.contact_tolerance,
        started=log.started,
    )
    times = np.concatenate([np.arange(start, stop, SAMPLED) for start, stop in log.contacts] or [np.empty(0)])
    states = path.sample(times)
    rows = [states.position, states.velocity, states.quaternion, states.angular_velocity]
    return times, standing(body, np.hstack(rows))


def nearest(times: Array, near: Standing) -> Array:
    """Return lack, lean [rad] and energy of a coin where it comes nearest to standing, (3,)."""
    if len(times) == 0:
        return np.array([np.inf, np.nan, np.nan])
    i = int(np.argmin(near.lack))
    return np.array([near.lack[i], near.lean[i], near.energy[i]])


def _stay(one: tuple[Array, Standing], other: tuple[Array, Standing]) -> float:
    """Return by how much longer the one coin stands, times its rate, over ln(`FAR`/`NEAR`)."""
    first, last = falls(*other), falls(*one)
    times, near = one
    meanwhile = (times >= first) & (times <= last)
    if not meanwhile.any():
        return np.nan
    return float((last - first) * near.rate[meanwhile].mean() / np.log(FAR / NEAR))


def falls(times: Array, near: Standing) -> float:
    """Return when a coin that came nearest to standing has fallen by `FALLEN`, or NaN [s]."""
    if len(times) == 0:
        return np.nan
    first = int(np.argmin(near.lack))
    off = np.abs(near.angle - near.lean)[first:]
    beyond = np.flatnonzero(off > FALLEN)
    if len(beyond) == 0 or beyond[0] == 0:
        return np.nan
    last = slice(beyond[0] - 1, beyond[0] + 1)
    return float(np.interp(np.log(FALLEN), np.log(off[last]), times[first:][last]))


def beside_flat_landings(flat: int = 2000) -> list[dict[str, Any]]:
    """Toss planar coins beside `flat` releases whose first touch is exactly flat, in vacuum, in 128 bits.

    Returns:
        Whether the outcomes at the two sides differ, and how near to standing the nearer one comes, of those
        that are decided.
    """
    scenario = case(air=False)
    coin, own, rng = planar_coin(scenario), units(scenario), np.random.default_rng(SEED)
    found = []
    while len(found) < flat:
        spin, half_turns = Fraction(rng.uniform(*SPINS)), int(rng.integers(1, 10))
        height = own.gravity / 2 * (half_turns * _PI / spin) ** 2
        if HEIGHTS[0] < height < HEIGHTS[1]:
            both = spread(PlanarRelease(height - BESIDE, spin), "height", 2 * BESIDE, 2)
            found.append(toss_many(coin, own, both, to_contact=True))
    return [
        {"differs": one.outcome != other.outcome, "off": min(one.from_upright, other.from_upright)}
        for one, other in found
        if Outcome.UNDECIDED not in (one.outcome, other.outcome)
    ]


_PI = Fraction("3.14159265358979323846264338327950288419716939937510582097494")


def found(cells: pd.DataFrame) -> dict[str, Any]:
    """Return what the claims name: how coins in air stand, by their kind, and the other boundaries."""
    meets, beside = cells.meets.dropna().astype(bool), cells[cells.differs.notna()]
    differs = beside.differs.astype(bool)
    return {
        "coins": {kind: _stands(rows) for kind, rows in cells.groupby("kind", sort=False)},
        "boundaries_in_vacuum": len(meets),
        "beside": float(BESIDE),
        "meeting": meets.sum(),
        "meets": share(meets, "boundaries"),
        "landings": len(beside),
        "differing": differs.sum(),
        "off": beside.off[differs].median(),
        "differ": share(differs, "releases"),
    }


def _stands(rows: pd.DataFrame) -> dict[str, Any]:
    """Return how coins of one kind stand in air."""
    stands = rows.lack < STANDS
    standing = rows[stands]
    return {
        "boundaries": len(rows),
        "lack": (rows.lack.median(), rows.lack.max()),
        "stands": share(stands, "boundaries"),
        "lean": standing.lean.max(),
        "energy": standing.energy,
        "median": standing.energy.median(),
        "at_rest": share(np.abs(standing.energy - 1) < AT_REST, "boundaries"),
        "ratio": mean(standing.ratio.dropna(), "boundaries"),
    }


REPRODUCTION = study(
    __name__,
    Cells(sides, {"kind": IN_AIR}),
    Cells(in_vacuum, {}),
    Cells(beside_flat_landings, {}),
    found=found,
)
