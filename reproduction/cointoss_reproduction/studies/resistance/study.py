"""What resistance to rolling and pivoting does: stopping distances, Euler's disk, and a nickel's edge."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pandas as pd

from cointoss import Ending, Outcome, Scenario, States, analytic
from cointoss.study import (
    Array,
    FloorFriction,
    Mode,
    energies,
    quaternion_from_angles,
    sample_piece,
    turned,
)
from cointoss_reproduction.frame.cells import Cells, Row, Rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.edge_classes import (
    AS_SAID,
    FREE,
    PUBLISHED,
    RESISTING,
    WOBBLING,
    nickel,
)
from cointoss_reproduction.setups.ends import tally

NICKELS = {"0": FREE, "0.1": AS_SAID, "1": RESISTING}
"""δ = p on a nickel's floor [mm], and what the edge study calls that floor."""
LEAST = PUBLISHED
"""The least share of nickels on edge."""
SPEED, ROLLING = 0.3, 1e-3
"""The speed of the disc and the hoop that roll upright [m/s], and their δ [m]."""
SPIN, PIVOTING, SLIDING = 80.0, 1e-3, 0.3
"""The spin of the coins that pivot upright [rad/s], their p [m], and the μ of the thick coin."""
TILT, SAMPLES, SMALL = 0.3, 300, (2e-4, 1e-2)
"""Euler's disk starts from this tilt [rad]; its fall is sampled so often, and fitted between these tilts."""
DISKS = {"rolling": (2e-5, 17.8), "pivoting": (1e-4, 3.0)}
"""δ, or p, on the floor of Euler's disk [m], and how long it is followed [s]."""
MASS, RADIUS = 2e-3, 1.25e-2
"""Mass and radius of all coins but the nickel [kg, m]."""


def rolling_stop(share_of_inertia: float) -> Row:
    """Return how a disc, or a hoop, that rolls upright stops, beside the closed forms.

    Args:
        share_of_inertia: J_ζ/(m r²).
    """
    inertia = np.diag([share_of_inertia / 2, share_of_inertia / 2, share_of_inertia]) * MASS * RADIUS * RADIUS
    motion = {"velocity": [SPEED, 0, 0], "angular_velocity": [0, 0, -SPEED / RADIUS]}
    case, time, end = _stopped({"thickness": 0.0, "inertia": inertia.tolist()}, motion, ROLLING)
    slowing = ROLLING * case.gravity / (RADIUS * (1 + share_of_inertia))
    way, closed = float(end[0]), SPEED**2 / (2 * slowing)
    return {**_beside(time, SPEED / slowing, abs(way / closed - 1)), "way": way, "closed_way": closed}


def pivoting_stop(thickness: float) -> Row:
    """Return how a coin that pivots upright stops: both rims of a thick one slip, h/2 from the axis."""
    case, time, _ = _stopped({"thickness": thickness}, {"angular_velocity": [0, SPIN, 0]}, PIVOTING)
    lever = PIVOTING + SLIDING * thickness / 2
    return _beside(time, SPIN / (lever * MASS * case.gravity / case.body.inertia[1][1]))


def _beside(time: float, closed: float, off: float = 0.0) -> Row:
    """Return a time beside its closed form, and how far both are apart, more than `off`, relative to it."""
    return {"of": "stop", "time": time, "closed": closed, "off": abs(time / closed - 1) + off}


def _stopped(coin: Row, motion: Row, size: float) -> tuple[Scenario, float, Array]:
    """Return the toss of an upright coin that stops, when it does [s], and where its C is then."""
    slips = {"contact": "coulomb", "friction": SLIDING} if coin["thickness"] else {}
    case = _upright(coin, motion, rolling_friction=size, pivoting_friction=size, **slips)
    tossed = analytic.toss(case)
    if tossed.ending != Ending.AT_REST:
        raise RuntimeError(f"a coin that is upright ended {tossed.ending}; expected: at_rest")
    return case, tossed.end_time, tossed.path.sample(np.array([tossed.end_time])).position[0]


def _upright(coin: Row, motion: Row, **floor: Any) -> Scenario:
    """Return an upright coin on a perfectly rough floor without rebound, but where said, in vacuum."""
    described = {
        "coin": {"mass": MASS, "radius": RADIUS, **coin},
        "floor": {"contact": "perfectly_rough", "restitution": 0.0, **floor},
        "release": {"position": [0, 0, RADIUS], "angles": [0.0, np.pi / 2, 0.0], **motion},
        "ending": {"test": "lying"},
    }
    return Scenario.model_validate(described)


STOPS = {
    "disc rolls": lambda: rolling_stop(0.5),
    "hoop rolls": lambda: rolling_stop(1.0),
    "disc pivots": lambda: pivoting_stop(0.0),
    "thick coin pivots": lambda: pivoting_stop(2e-3),
}


def upright(stop: Callable[[], Row]) -> Row:
    """Return how an upright coin stops."""
    return stop()


def disk(resistance: str) -> Iterator[Rows]:
    """Return how Euler's disk falls, from a tilt at which it rolls round its mass centre; then samples."""
    size, longest = DISKS[resistance]
    friction = FloorFriction(1e4, *((size, 0.0) if resistance == "rolling" else (0.0, size)))
    body = _upright({"thickness": 0.0}, {}).body
    place, turning = [0, 0, RADIUS * np.sin(TILT)], 2 * (body.gravity * np.sin(TILT) / RADIUS) ** 0.5
    start = np.array([*place, 0, 0, 0, *quaternion_from_angles((0.0, TILT, 0.0)), 0, turning, 0])
    times, rows = np.linspace(0.0, longest, SAMPLES), np.empty((SAMPLES, len(start)))
    tolerance = analytic.AnalyticSettings().contact_tolerance
    sample_piece(body, friction, tolerance, Mode.STICKING.value, start, 0.0, times, rows)
    parts = dict(
        zip(("position", "velocity", "quaternion"), np.split(rows[:, :10], [3, 6], axis=1), strict=True)
    )
    states = States(time=times, **parts, angular_velocity=rows[:, 10:13])
    tilts = np.arcsin(np.minimum(np.hypot(*states.normal[:, :2].T), 1.0))
    energy = energies(body, states) / (MASS * body.gravity * RADIUS)
    pivots = turned(states.quaternion, states.angular_velocity)[:, 2]
    tenth = SAMPLES // 10
    early, late = (part[0] - part[-1] for part in (energy[:tenth], energy[-tenth:]))
    ends = {"energy": energy[0], "left": energy[-1], "pivot": pivots[0], "last_pivot": pivots[-1]}
    yield {"of": "disk", "seconds": longest, "slowing": late / early, **ends}
    drawn = {resistance: tilts}
    if resistance == "rolling":
        yield {"of": "power law", **power_law(times, tilts)}
        chosen = tilts > SMALL[0]
        root = np.polyval(np.polyfit(times[chosen], tilts[chosen] ** 0.5, 1), times)
        drawn["(t₀ - t)²"] = np.maximum(root, 0) ** 2
    for line, fall in drawn.items():
        yield pd.DataFrame({"of": "fall", "line": line, "time": times, "tilt": fall})


def power_law(times: Array, tilts: Array) -> dict[str, float]:
    """Return n of α ~ (t₀ - t)ⁿ, and -dα/dt over (4/3) √(g/r) (δ/r) √α, at small tilts."""
    falls = -np.gradient(tilts, times)
    chosen = (tilts > SMALL[0]) & (tilts < SMALL[1])
    slope = np.polyfit(np.log(tilts[chosen]), np.log(falls[chosen]), 1)[0]
    closed = 4 / 3 * (9.81 / RADIUS) ** 0.5 * DISKS["rolling"][0] / RADIUS * tilts[chosen] ** 0.5
    return {"exponent": float(1 / (1 - slope)), "rate": float(np.median(falls[chosen] / closed))}


def on_edge(floor: str, count: int = 1000) -> Iterator[Rows]:
    """Toss people's nickels; return how many have each outcome, and how many of each outcome end how."""
    ended = nickel(WOBBLING, floor).tossed(count)
    rolls = int(np.sum(ended.ending == Ending.ROLLING))
    yield {"of": "nickel", "resists": floor != FREE, "still_rolling": rolls, **tally(ended.outcome)}
    kinds, numbers = np.unique(np.stack([ended.outcome, ended.ending]), axis=1, return_counts=True)
    endings = [f"{Outcome(outcome)}, {Ending(ending)}" for outcome, ending in kinds.T]
    yield pd.DataFrame({"of": "ending", "ending": endings, "number": numbers})


REPRODUCTION = study(
    __name__,
    Cells(upright, {"stop": STOPS}),
    Cells(disk, {"resistance": tuple(DISKS)}),
    Cells(on_edge, {"floor": NICKELS}),
)
