"""A toss as the scripts of a page play it."""

import math
from typing import Any

import numpy as np

from cointoss.coin_mj.model.scene import shape_thickness
from cointoss.compare.output.style import OUTCOMES
from cointoss.models.barriers import barrier
from cointoss.models.certificate import energies
from cointoss.models.records import Array, Toss

SAMPLES = 1200
"""Samples of a path that is played."""
MOST_SYMBOLS = 200
"""The most symbols of a sequence that is shown."""


def shown_outcomes() -> dict[int, dict[str, str]]:
    """Return the word and the colour of each outcome, by its integer."""
    return {int(outcome): {"label": str(outcome), "color": color} for outcome, color in OUTCOMES.items()}


def playable(toss: Toss, samples: int = SAMPLES, most_symbols: int = MOST_SYMBOLS) -> dict[str, Any]:
    """Return a toss as scripts show it: how it ended, its sequence with the horizon of trust, and its path.

    Where the coin is followed after the toss, the path goes on, and `later_times` are those of its touches.

    Args:
        toss: by either engine.
        samples: of the path, roughly.
        most_symbols: of the sequence, and times of its touches.
    """
    is_followed, case = toss.path_end > toss.end_time, toss.scenario
    return {
        "engine": toss.engine,
        "outcome": str(toss.outcome),
        "ending": toss.ending.sentence,
        "end_time": toss.end_time,
        "count": len(toss.impacts),
        "sequence": toss.sequence[:most_symbols],
        "times": rounded(toss.impacts.time[:most_symbols], 7),
        "trusted": toss.trusted_impacts,
        "notes": [],
        "coin": {
            "radius": case.coin.radius,
            "thickness": shape_thickness(case),
            "center": list(case.coin.center_of_mass),
            "barrier": min(barrier(case.body, side) for side in (1.0, -1.0)),
        },
        "path": path_of(toss, samples),
        **({"later_times": rounded(toss.later_times[:most_symbols], 7)} if is_followed else {}),
    }


def path_of(toss: Toss, samples: int, *, with_spin: bool = False) -> dict[str, Any]:
    """Return a path at evenly spread times, and on both sides of its first touches, number after number.

    Args:
        toss: by either engine.
        samples: how many, roughly.
        with_spin: whether the size of the angular velocity and its part along the normal are wanted.

    Returns:
        Times [s], positions of C [m], Euler parameters, energies [J], and spins [rad/s].
    """
    hits = np.concatenate([toss.impacts.time, toss.later_times])[: samples // 4]
    times = np.unique(
        np.concatenate(
            [np.linspace(0, toss.path_end, samples - 2 * len(hits)), hits, np.nextafter(hits, 0)]
        ).clip(0, toss.path_end)
    )
    states = toss.sample(times)
    # Finer than the eye sees: a ten-thousandth of a radius.
    decimals = 4 - math.floor(math.log10(toss.scenario.coin.radius))
    path = {
        "time": rounded(times, 7),
        "position": np.round(states.position, decimals).ravel().tolist(),
        "quaternion": np.round(states.quaternion, 5).ravel().tolist(),
        "energy": rounded(energies(toss.scenario.body, states), 5),
    }
    if not with_spin:
        return path
    spin = np.linalg.norm(states.angular_velocity, axis=1)
    return path | {"spin": rounded(spin, 5), "spin_normal": rounded(states.angular_velocity[:, 2], 5)}


def rounded(numbers: Array, digits: int) -> list[float]:
    """Return numbers with the given number of significant digits."""
    return [float(f"{number:.{digits}g}") for number in numbers.tolist()]
