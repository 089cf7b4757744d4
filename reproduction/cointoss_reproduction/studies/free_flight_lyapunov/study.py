"""Section 5.1: the transient Lyapunov exponents of free fall, by the tangent map of the flight."""

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.figure import Figure

from cointoss import Scenario, Toss, analytic, coin_mj, load
from cointoss.study import (
    FINE,
    Array,
    Body,
    Progress,
    by_numba,
    flight_tangent,
    sample,
    state_at_release,
    state_of,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.free_fall import MEDIA, MODELS

flight_tangent = by_numba(flight_tangent)
sample = by_numba(sample)

LONGEST = {"vacuum": 100.0, "air": 2000.0}
"""How long the coins fall [s]; in air the last turning is slow to end."""
SAMPLES = 40
SHORT, CHANGE = 0.6, 1e-6
"""Time of two nearby tosses by both engines [s], and how far apart they start, relative to the spin."""
SPIN = 40.0
"""About the middle axis [rad/s]."""


def make(progress: Progress) -> Findings:
    """Follow all small changes of the four coins' flights, without and with air."""
    found = Findings()
    spectra: dict[str, Array] = {}
    for medium, air in MEDIA.items():
        times = np.geomspace(0.1, LONGEST[medium], SAMPLES)
        for name, (file, _) in MODELS.items():
            case = load(file).replace("air", air)
            spectra[f"{medium}, {name}"] = _exponents(case, times)
            progress(len(spectra), len(MEDIA) * len(MODELS) + 1)
    last = {medium: np.array([spectra[f"{medium}, {name}"][-1] for name in MODELS]) for medium in MEDIA}
    found.last, found.power = (
        last,
        {
            medium: np.array([_power(spectra[f"{medium}, {name}"], LONGEST[medium]) for name in MODELS])
            for medium in MEDIA
        },
    )
    case = load(MODELS["3D imperfect"][0]).replace("air", MEDIA["air"])
    found.nearby = [
        _growth_of_difference(engine, case, np.ones(3)) for engine in (analytic.toss, coin_mj.toss)
    ]
    middle, direction, found.rate = _about_the_middle_axis()
    found.nearby_middle = [
        _growth_of_difference(engine, middle, direction) for engine in (analytic.toss, coin_mj.toss)
    ]
    found.tangent = _growth_of_tangent(middle, direction)
    progress(len(MEDIA) * len(MODELS) + 1, len(MEDIA) * len(MODELS) + 1)
    found.largest, found.smallest = (
        {medium: _span(end(exponents, axis=1)) for medium, exponents in last.items()}
        for end in (np.max, np.min)
    )
    found.size, found.mujoco_off = np.abs(last["vacuum"]).max(), abs(found.nearby[1] - found.nearby[0])
    found.fold = np.exp(found.nearby_middle[0] * SHORT)
    found.middle = max(found.tangent, *found.nearby_middle)
    found.data = {
        f"{medium}, time": np.geomspace(0.1, LONGEST[medium], SAMPLES) for medium in MEDIA
    } | spectra
    return found


def _span(numbers: Array) -> str:
    return f"{np.min(numbers):.2g} to {np.max(numbers):.2g}"


def _sizes(body: Body) -> Array:
    """Return the scales of a state: r, √(g r), 1, √(g/r), (13,)."""
    r, g = body.radius, body.gravity
    return np.array([r] * 3 + [(g * r) ** 0.5] * 3 + [1.0] * 4 + [(g / r) ** 0.5] * 3)


def _exponents(case: Scenario, times: Array) -> Array:
    """Return the twelve transient Lyapunov exponents (1/t) ln of the growth, (n, 12) [1/s].

    Changes of the state, on the coin's scales, are carried by the tangent map and made orthogonal again at
    each of `times` (Benettin and others). They keep the quaternion's norm.
    """
    body, (release, *states) = case.body, _flown(case, [0.0, *times])
    e0, e1, e2, e3 = release[6:10]
    basis = np.delete(np.eye(13), 9, axis=0)
    basis[6:9, 6:10] = [[-e1, e0, e3, -e2], [-e2, -e3, e0, e1], [-e3, e2, -e1, e0]]
    # Turned at random, so that each direction has a part of the fastest.
    Q = np.linalg.qr(np.random.default_rng(51).normal(size=(12, 12)))[0] @ basis
    growth, before, start, rows = np.zeros(12), 0.0, release, []
    for t, end in zip(times, states, strict=True):
        changes = np.ascontiguousarray(Q * _sizes(body))
        flight_tangent(body, state_of(start), state_of(end), t - before, FINE, changes)
        orthogonal, R = np.linalg.qr((changes / _sizes(body)).T)
        growth += np.log(np.abs(np.diag(R)))
        Q, before, start = orthogonal.T, t, end
        rows.append(growth / t)
    return np.array(rows)


def _flown(case: Scenario, times: Sequence[float]) -> Array:
    """Return the states of a flight without a floor at these times [s], (n, 13)."""
    states = np.empty((len(times), 13))
    sample(case.body, state_at_release(case.release), 0.0, np.array(times), states)
    return states


def _power(exponents: Array, longest: float) -> float:
    """Return p of a growth like t^p over the last nine tenths of the time: the slope of λ t over ln t."""
    t = np.geomspace(0.1, longest, SAMPLES)
    late = t > longest / 10
    return float(np.polyfit(np.log(t[late]), (exponents.max(axis=1) * t)[late], 1)[0])


def _growth_of_difference(engine: Callable[[Scenario], Toss], case: Scenario, direction: Array) -> float:
    """Return (1/t) ln of the growth of a small change of ω in one direction, from two tosses [1/s]."""
    w = np.array(case.release.angular_velocity)
    change = CHANGE * np.linalg.norm(w) * direction / np.linalg.norm(direction)
    spins = []
    for sign in (1, -1):
        toss = engine(case.replace("release.angular_velocity", w + sign * change))
        spins.append(toss.sample(SHORT).angular_velocity[0])
    return float(np.log(np.linalg.norm(spins[0] - spins[1]) / np.linalg.norm(2 * change)) / SHORT)


def _growth_of_tangent(case: Scenario, direction: Array) -> float:
    """Return the same by the tangent map."""
    changes = np.zeros((1, 13))
    changes[0, 10:] = direction
    start, end = map(state_of, _flown(case, [0.0, SHORT]))
    flight_tangent(case.body, start, end, SHORT, FINE, changes)
    return float(np.log(np.linalg.norm(changes[0, 10:]) / np.linalg.norm(direction)) / SHORT)


def _about_the_middle_axis() -> tuple[Scenario, Array, float]:
    """Return a toss of the thick imperfect coin about its middle axis, and how a change of its spin grows.

    Returns:
        The toss, the change that grows, and its rate, Ω √((J_2 - J_1)(J_3 - J_2)/(J_1 J_3)) [1/s].
    """
    case = load(MODELS["3D imperfect"][0])
    J, axes = np.linalg.eigh(case.coin.inertia_about_C)
    rate = SPIN * np.sqrt((J[1] - J[0]) * (J[2] - J[1]) / (J[0] * J[2]))
    # J_1 ω̇_1 = (J_2 - J_3) Ω ω_3 in axes of the right hand.
    hand = np.linalg.det(axes)
    direction = axes[:, 0] + rate * J[0] / ((J[1] - J[2]) * SPIN) * hand * axes[:, 2]
    return case.replace("release.angular_velocity", SPIN * axes[:, 1]), direction, float(rate)


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 3.6))
    for axes, medium in zip(picture.subplots(1, 2, sharey=True), MEDIA, strict=True):
        t = data[f"{medium}, time"]
        for name, (_, color) in MODELS.items():
            exponents = data[f"{medium}, {name}"]
            axes.semilogx(t, exponents.max(axis=1), color=color, label=name)
            axes.semilogx(t, exponents.min(axis=1), "--", color=color)
        axes.set(title=f"in {medium}", xlabel="time [s]", xlim=(0.5, None), ylim=(-3, 5))
    picture.axes[0].set_ylabel("largest and smallest (dashed) exponent [1/s]")
    picture.axes[0].legend()
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
