"""What resistance to rolling and pivoting does: stopping distances, Euler's disk, and a nickel's edge."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cointoss import Ending, Outcome, Scenario, States, analytic
from cointoss.study import (
    BLUE,
    GREY,
    ORANGE,
    Array,
    FloorFriction,
    Mode,
    Progress,
    energies,
    in_words,
    paragraphs,
    quaternion_from_angles,
    sample_piece,
    stepping,
    table,
    turned,
)
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.setups.edge_classes import PUBLISHED, WOBBLING
from cointoss_reproduction.setups.edge_record import FREE, nickel
from cointoss_reproduction.setups.edge_touches import endings_of
from cointoss_reproduction.setups.ends import Ends, ended_as, on_edge

COUNT = 1000
"""People's tosses of a nickel for each size of the resistance."""
NICKELS = {"0": FREE, "0.0001": "as said", "0.001": "δ = p = 1 mm"}
"""δ = p on a nickel's floor [m], and what the edge study calls that floor."""
SPEED, ROLLING = 0.3, 1e-3
"""Of the disc and the hoop that roll upright [m/s], and their δ [m]."""
SPIN, PIVOTING, SLIDING = 80.0, 1e-3, 0.3
"""Of the coins that pivot upright [rad/s], their p [m], and the μ of the thick one."""
TILT, SAMPLES, SMALL = 0.3, 300, (2e-4, 1e-2)
"""Euler's disk starts from this tilt [rad]; its fall is sampled so often, and fitted between these tilts."""
DISKS = {"rolling": (2e-5, 17.8), "pivoting": (1e-4, 3.0)}
"""δ, or p, on the floor of Euler's disk [m], and how long it is followed [s]."""
_DISC = {"mass": 2e-3, "radius": 1.25e-2, "thickness": 0.0}
_THICK = {**_DISC, "thickness": 2e-3}
_UPRIGHT = [0.0, np.pi / 2, 0.0]


@dataclass(frozen=True)
class Stop:
    """How long a coin took to stop, and how far it came, beside the closed forms."""

    time: float
    expected_time: float
    distance: float
    expected_distance: float


@dataclass(frozen=True)
class EulersDisk:
    """The fall of Euler's disk under one resistance, in samples over time."""

    times: list[float]
    """[s]."""
    tilts: list[float]
    """[rad]."""
    energies: list[float]
    """Over m g r."""
    pivots: list[float]
    """ω_z [rad/s]."""


@dataclass(frozen=True)
class ResistanceRecord:
    """What the study found."""

    stops: dict[str, Stop]
    disks: dict[str, EulersDisk]
    nickel: dict[str, Ends]
    """By δ."""


def on_floor(coin: dict, release: dict, floor: dict, ending: dict | None = None) -> Scenario:
    """Return a scenario on a perfectly rough floor without rebound, in vacuum, with such a resistance."""
    rough = {"contact": "perfectly_rough", "restitution": 0.0, **floor}
    parts = {"coin": coin, "floor": rough, "release": release, "ending": ending or {}}
    return Scenario.model_validate(parts)


def rolling_stop(share_of_inertia: float) -> Stop:
    """Return how a disc, or a hoop, that rolls upright stops.

    Args:
        share_of_inertia: J_ζ/(m r²).
    """
    m, r = _DISC["mass"], _DISC["radius"]
    inertia = np.diag([share_of_inertia / 2, share_of_inertia / 2, share_of_inertia]) * m * r * r
    motion = {"velocity": [SPEED, 0, 0], "angular_velocity": [0, 0, -SPEED / r]}
    case, end_time, end = _stopped({**_DISC, "inertia": inertia.tolist()}, motion, ROLLING)
    slowing = ROLLING * case.gravity / (r * (1 + share_of_inertia))
    return Stop(end_time, SPEED / slowing, float(end[0]), SPEED**2 / (2 * slowing))


def pivoting_stop(coin: dict) -> Stop:
    """Return how a coin that pivots upright stops: both rims of a thick one slip, h/2 from the axis."""
    case, end_time, _ = _stopped(coin, {"angular_velocity": [0, SPIN, 0]}, PIVOTING)
    lever = PIVOTING + SLIDING * case.body.thickness / 2
    slowing = lever * case.body.mass * case.gravity / case.body.inertia[1][1]
    return Stop(end_time, SPIN / slowing, 0.0, 0.0)


def _stopped(coin: dict, motion: dict, size: float) -> tuple[Scenario, float, Array]:
    """Return the toss of an upright coin that stops, when it does [s], and where its C is then."""
    release = {"position": [0, 0, _DISC["radius"]], "angles": _UPRIGHT, **motion}
    slips = {"contact": "coulomb", "friction": SLIDING} if coin["thickness"] else {}
    floor = {"rolling_friction": size, "pivoting_friction": size, **slips}
    case = on_floor(coin, release, floor, {"test": "lying"})
    tossed = analytic.toss(case)
    if tossed.ending != Ending.AT_REST:
        raise RuntimeError(f"a coin that is upright ended {tossed.ending}; expected: at_rest")
    return case, tossed.end_time, tossed.path.sample(np.array([tossed.end_time])).position[0]


def eulers_disk(resistance: str) -> EulersDisk:
    """Return how Euler's disk falls, from a tilt at which it rolls round its mass centre.

    Args:
        resistance: "rolling" or "pivoting".
    """
    r, g = _DISC["radius"], 9.81
    size, longest = DISKS[resistance]
    friction = FloorFriction(1e4, *((size, 0.0) if resistance == "rolling" else (0.0, size)))
    body = on_floor(_DISC, {"position": [0, 0, r]}, {}).body
    turning = 2 * (g * np.sin(TILT) / r) ** 0.5
    start = np.array(
        [0, 0, r * np.sin(TILT), 0, 0, 0, *quaternion_from_angles((0.0, TILT, 0.0)), 0, turning, 0]
    )
    times, rows = np.linspace(0.0, longest, SAMPLES), np.empty((SAMPLES, len(start)))
    tolerance = analytic.AnalyticSettings().contact_tolerance
    sample_piece(body, friction, tolerance, Mode.STICKING.value, start, 0.0, times, rows)
    states = States(
        time=times,
        position=rows[:, 0:3],
        velocity=rows[:, 3:6],
        quaternion=rows[:, 6:10],
        angular_velocity=rows[:, 10:13],
    )
    tilts = np.arcsin(np.minimum(np.hypot(states.normal[:, 0], states.normal[:, 1]), 1.0))
    return EulersDisk(
        times=times.tolist(),
        tilts=tilts.tolist(),
        energies=(energies(body, states) / (body.mass * g * r)).tolist(),
        pivots=turned(states.quaternion, states.angular_velocity)[:, 2].tolist(),
    )


def power_law(disk: EulersDisk) -> tuple[float, float]:
    """Return n of α ~ (t₀ - t)ⁿ, and -dα/dt over (4/3) √(g/r) (δ/r) √α, at small tilts."""
    times, tilts = np.array(disk.times), np.array(disk.tilts)
    falls = -np.gradient(tilts, times)
    chosen = (tilts > SMALL[0]) & (tilts < SMALL[1])
    slope = np.polyfit(np.log(tilts[chosen]), np.log(falls[chosen]), 1)[0]
    r = _DISC["radius"]
    closed = 4 / 3 * (9.81 / r) ** 0.5 * DISKS["rolling"][0] / r * tilts[chosen] ** 0.5
    return float(1 / (1 - slope)), float(np.median(falls[chosen] / closed))


def compute(progress: Progress, count: int = COUNT) -> ResistanceRecord:
    """Roll, pivot, and toss `count` of people's nickels for each of `NICKELS`."""
    stops = {
        "disc rolls": rolling_stop(0.5),
        "hoop rolls": rolling_stop(1.0),
        "disc pivots": pivoting_stop(_DISC),
        "thick coin pivots": pivoting_stop(_THICK),
    }
    disks = {resistance: eulers_disk(resistance) for resistance in DISKS}
    step = stepping(progress, len(NICKELS))
    nickels = {size: step(endings_of(nickel(WOBBLING, factor), count)) for size, factor in NICKELS.items()}
    return ResistanceRecord(stops, disks, nickels)


def measures(found: ResistanceRecord) -> dict[str, Any]:
    """Return what the claims name."""
    exponent, rate = power_law(found.disks["rolling"])
    energies = found.disks["pivoting"].energies
    tenth = len(energies) // 10
    early, late = (part[0] - part[-1] for part in (energies[:tenth], energies[-tenth:]))
    return {
        "error": max(
            abs(stop.time / stop.expected_time - 1)
            + (abs(stop.distance / stop.expected_distance - 1) if stop.expected_distance else 0.0)
            for stop in found.stops.values()
        ),
        "exponent": exponent - 2,
        "rate": rate - 1,
        "left": energies[-1],
        "slowing": late / early,
        "undecided": sum(
            ended_as(ends, outcome)
            for ends in found.nickel.values()
            for outcome in (Outcome.UNDECIDED, Outcome.PERPETUAL, Outcome.TRANSIENT)
        ),
        "rolling": sum(
            ends.get(f"edge, {Ending.ROLLING}", 0) for size, ends in found.nickel.items() if size != "0"
        ),
        "published": PUBLISHED,
        "least": min(map(on_edge, found.nickel.values()), key=lambda part: part.value),
    }


def tables(found: ResistanceRecord) -> str:
    """Return the tables, in Markdown."""
    stops = [
        [
            name,
            f"{stop.time:.5f}",
            f"{stop.expected_time:.5f}",
            *(f"{d:.6f}" if stop.expected_distance else "-" for d in (stop.distance, stop.expected_distance)),
        ]
        for name, stop in found.stops.items()
    ]
    exponent, rate = power_law(found.disks["rolling"])
    disks = [
        [
            resistance,
            *(f"{disk.energies[i]:.4f}" for i in (0, -1)),
            *(f"{disk.pivots[i]:.3f}" for i in (0, -1)),
            f"{disk.times[-1]:.3f}",
        ]
        for resistance, disk in found.disks.items()
    ]
    endings = sorted({end for ends in found.nickel.values() for end in ends})
    nickel = [
        [
            f"{1e3 * float(size):g}",
            *(str(ends.get(end, 0)) for end in endings),
            in_words(on_edge(ends), ".2f", 100),
        ]
        for size, ends in found.nickel.items()
    ]
    at = "energy at first [m g r] | at last | ω_z at first [rad/s] | at last | after [s]"
    return paragraphs(
        table("a coin upright | stops after [s] | closed form | comes [m] | closed form", stops),
        table(f"Euler's disk, resistance to | {at}", disks),
        f"Under resistance to rolling α ~ (t₀ - t)ⁿ with n = {exponent:.4f} between {SMALL[0]:g} and "
        f"{SMALL[1]:g} rad; -dα/dt is {rate:.4f} of its closed form there.",
        table(["nickel, δ = p [mm]", *endings, "on edge [%]"], nickel),
    )


def draw(found: ResistanceRecord) -> Figure:
    """Draw the tilt of Euler's disk under either resistance, and the power law."""
    picture = Figure(figsize=(7, 3.4))
    axes = picture.subplots()
    for (resistance, disk), color in zip(found.disks.items(), (BLUE, ORANGE), strict=True):
        axes.plot(disk.times, np.degrees(disk.tilts), color=color, label=resistance)
    disk = found.disks["rolling"]
    times, tilts = np.array(disk.times), np.array(disk.tilts)
    chosen = tilts > SMALL[0]
    line = np.polyval(np.polyfit(times[chosen], tilts[chosen] ** 0.5, 1), times)
    axes.plot(times, np.degrees(np.maximum(line, 0) ** 2), color=GREY, linestyle="--", label="(t₀ - t)²")
    axes.set(xlabel="t [s]", ylabel="tilt [deg]")
    axes.legend(title="resistance to")
    return picture


REPRODUCTION = recorded(
    __name__, compute, record=ResistanceRecord, measures=measures, tables=tables, draw={"disk": draw}
)
