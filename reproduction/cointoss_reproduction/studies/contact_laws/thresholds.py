"""Where a contact law first fails: the least restitution that adds energy, the least friction unsolved."""

import math
from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq, minimize

from cointoss.study import Array, Body, Rules, quaternion_from_angles
from cointoss_reproduction.setups.halving import halved
from cointoss_reproduction.studies.contact_laws.single_impacts import strike

MOST_FRICTION = 100.0
_TRIED_PER_UNKNOWN, _REFINED = 40, 5
_SLIP_EXPONENTS = (-8.0, 1.0)
"""Slip before an impact, as powers of ten of the normal speed."""


def touching_state(
    tilt: float, slip_exponent: float, direction: float = math.pi / 2, place: float = 0.0
) -> Array:
    """Return a state of a coin that comes down on its rim without turning, (13,).

    What an impact does depends on the attitude and on the velocity of the contact point alone, and the
    velocity of C gives the latter any value.

    Args:
        tilt: of the coin from lying [rad].
        slip_exponent: decimal logarithm of the slip over the normal speed.
        direction: of the slip, from the coin's edge at A [rad].
        place: of A on the rim [rad].
    """
    slip = 10 ** float(np.clip(slip_exponent, *_SLIP_EXPONENTS))
    v = (slip * math.cos(direction), slip * math.sin(direction), -1.0)
    return np.array([0, 0, 0, *v, *quaternion_from_angles((0.0, tilt, place)), 0, 0, 0])


def onset_of_gain(body: Body, rules: Rules, friction: float, seed: int) -> float:
    """Return the least restitution at which some impact adds energy; 1 or more where none does.

    Args:
        body: the coin. If it is ideal, slip across its edge is searched; else all slip.
        rules: with the contact law.
        friction: μ.
        seed: of the first guesses.
    """

    def gain(chi: float, state: Array) -> float:
        impacts, _ = strike(body, rules, state[None], restitution=chi, friction=friction)
        return float(impacts.energy_change[0] / (impacts.energy[0] - impacts.energy_change[0]))

    def onset(state: Array) -> float:
        most = gain(1.0, state)
        if most <= 0:
            return 1 - most
        if gain(0.0, state) >= 0:
            return 0.0
        return float(brentq(gain, 0.0, 1.0, args=(state,), xtol=1e-12))  # pyright: ignore[reportArgumentType]

    return _least(onset, body, seed)


def onset_without_solution(body: Body, rules: Rules, seed: int) -> float:
    """Return the least friction with which the law has no solution in some impact.

    Args:
        body: the coin. If it is ideal, slip across its edge is searched; else all slip.
        rules: with the contact law.
        seed: of the first guesses.
    """

    def onset(state: Array) -> float:
        def is_solved(friction: float) -> bool:
            return bool(strike(body, rules, state[None], restitution=1.0, friction=friction)[1][0])

        return MOST_FRICTION if is_solved(MOST_FRICTION) else halved(0.0, MOST_FRICTION, is_solved)[1]

    return _least(onset, body, seed)


def _least(onset: Callable[[Array], float], body: Body, seed: int) -> float:
    """Minimise over the states of a touching coin: of random guesses the best few are refined."""
    ideal = body.center == (0.0, 0.0, 0.0)
    ranges = [(0.0, math.pi), _SLIP_EXPONENTS, *([] if ideal else 2 * [(0.0, 2 * math.pi)])]
    low, high = zip(*ranges, strict=True)
    guesses = np.random.default_rng(seed).uniform(low, high, (_TRIED_PER_UNKNOWN * len(ranges), len(ranges)))

    def onset_at(unknowns: Array) -> float:
        return onset(touching_state(*unknowns))

    best = sorted(guesses, key=onset_at)[:_REFINED]
    options = {"xatol": 1e-7, "fatol": 1e-12}
    return min(float(minimize(onset_at, guess, method="Nelder-Mead", options=options).fun) for guess in best)
