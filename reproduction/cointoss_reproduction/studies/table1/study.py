"""Table 1: where each sequence of three angles is singular, and what that costs near θ = 0."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from cointoss import EndingCriteria, Release, Scenario, load
from cointoss.study import Array, derivative, quaternion_from_angles, state_at_release, vector
from cointoss_reproduction.frame.cells import Cells, column
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.both_engines import ENGINES, by_both
from cointoss_reproduction.studies.table1.euler_angles import rate_matrix, rotation_of, singularity

PRINTED = {
    "121": ("sin", -1, 0.0),
    "123": ("cos", +1, np.pi / 2),
    "131": ("sin", -1, 0.0),
    "132": ("cos", -1, np.pi / 2),
    "212": ("sin", -1, 0.0),
    "213": ("cos", -1, np.pi / 2),
    "231": ("cos", +1, np.pi / 2),
    "232": ("sin", -1, 0.0),
    "312": ("cos", +1, np.pi / 2),
    "313": ("sin", -1, 0.0),
    "321": ("cos", -1, np.pi / 2),
    "323": ("sin", -1, 0.0),
}
"""Table 1: the function of φ_2 that vanishes, its sign, and the first angle where it does [rad]."""
ROWS = len(PRINTED)
CLASSICAL = "313"

LEAST = tuple(0.3 * 10.0**-k for k in range(11))
"""Smallest θ of the motions [rad]."""
CONE, ACROSS = np.radians(40), 40.0
"""Angle between the normal and the angular momentum; spin across the normal [rad/s]."""
TOLERANCE = 1e-10
"""The relative tolerance of the solver that chooses its steps."""
STEPS = 1000
"""The number of steps in the turn of the solver with fixed steps."""


def follow(sequence: str) -> dict[str, int]:
    """Return whether a row of the table follows from det B."""
    return {"follows": int(singularity(sequence) == PRINTED[sequence])}


def fly(least: float) -> Iterator[dict[str, Any]]:
    """Yield error [rad] and steps of all ways to fly a turn about the angular momentum past a least θ."""
    case, L, turn = _case(least)
    release = case.release
    J = case.coin.inertia_about_C
    period = 2 * np.pi / turn
    begin = Rotation.from_euler("ZXZ", np.array(release.angles))
    spin = (1 - J[2, 2] / J[0, 0]) * release.angular_velocity[2]
    # The free symmetric top turns about L and, in the body, about its normal.
    end = Rotation.from_rotvec(L * turn * period) * begin * Rotation.from_rotvec([0, 0, spin * period])
    of_parameters = state_at_release(release)
    of_angles = np.array([*of_parameters[:6], *(release.angles or ()), *of_parameters[10:]])
    ways = {
        "angles": (
            partial(_rate_in_angles, case),
            of_angles,
            lambda y: Rotation.from_matrix(rotation_of(CLASSICAL, y[6:9])),
        ),
        "parameters": (
            partial(_rate_in_parameters, case),
            of_parameters,
            lambda y: Rotation.from_quat(y[6:10], scalar_first=True),
        ),
    }
    for way, (rate, start, attitude) in ways.items():
        found = solve_ivp(
            lambda _, y, rate=rate: rate(y),
            (0, period),
            start,
            method="DOP853",
            rtol=TOLERANCE,
            atol=TOLERANCE,
        )
        fixed = _runge_kutta(rate, start, period)
        for steps, y, many in (("chosen", found.y[:, -1], len(found.t) - 1), ("fixed", fixed, STEPS)):
            error = (end.inv() * attitude(y)).magnitude()
            yield {"way": f"{way}, {steps} steps", "error": error, "steps": many}
    for engine, toss in by_both(case).items():
        e = toss.sample(period).quaternion[0]
        yield {"way": engine, "error": (end.inv() * Rotation.from_quat(e, scalar_first=True)).magnitude()}


def _case(least: float) -> tuple[Scenario, Array, float]:
    """Return a toss whose normal passes the vertical at a least θ, the direction of its angular momentum in
    space, and the rate at which it turns about that [rad/s]."""
    scenario = load("fig18_3d_ideal")
    J = np.diag(scenario.coin.inertia_about_C)
    lean, psi = CONE + least, 0.3
    angles = np.array([psi, lean + CONE, 0.0])
    away = np.array([np.sin(psi), -np.cos(psi), 0])
    L = np.sin(lean) * away + np.cos(lean) * np.array([0, 0, 1.0])
    turn = ACROSS / np.sin(CONE)
    w = rotation_of(CLASSICAL, angles).T @ L * turn * J[0] / J
    release = Release(
        position=(0.0, 0.0, 1.0), velocity=(0.1, 0.05, 2.0), angles=vector(angles), angular_velocity=vector(w)
    )
    ending = EndingCriteria(max_time=1.01 * 2 * np.pi / turn)
    return scenario.replace("release", release, "ending", ending), L, turn


def _rate_in_parameters(case: Scenario, y: Array) -> Array:
    rate = np.empty(13)
    derivative(case.body, y, rate)
    return rate


def _rate_in_angles(case: Scenario, y: Array) -> Array:
    """Return the same equations of motion with ψ, θ, φ for the attitude: φ̇ = B⁻¹ ω, section 3.2."""
    e = quaternion_from_angles(vector(y[6:9]))
    rate = _rate_in_parameters(case, np.array([*y[:6], *e, *y[9:]]))
    of_angles = np.linalg.solve(rate_matrix(CLASSICAL, y[6:9]), y[9:])
    return np.array([*rate[:6], *of_angles, *rate[10:]])


def _runge_kutta(rate: Callable[[Array], Array], y: Array, duration: float) -> Array:
    """Return the state after `STEPS` equal steps of the classical method of order 4."""
    dt = duration / STEPS
    for _ in range(STEPS):
        k_1 = rate(y)
        k_2 = rate(y + dt / 2 * k_1)
        k_3 = rate(y + dt / 2 * k_2)
        k_4 = rate(y + dt * k_3)
        y = y + dt / 6 * (k_1 + 2 * k_2 + 2 * k_3 + k_4)
    return y


def _found(cells: pd.DataFrame) -> dict[str, Any]:
    errors, steps = (
        {str(way): of[column].to_numpy() for way, of in cells.groupby("way")} for column in ("error", "steps")
    )
    return {
        "errors": errors,
        "steps": steps,
        "right": int(column(cells, "follows").sum()),
        "engines": np.array([errors[engine].max() for engine in ENGINES]),
        "spread": np.ptp(steps["parameters, chosen steps"]),
        "three_times": 3 * steps["angles, chosen steps"][0],
        "thousand_times": 1e3 * errors["angles, fixed steps"][0],
        "twice": 2 * errors["parameters, fixed steps"].min(),
    }


REPRODUCTION = study(
    __name__, Cells(follow, {"sequence": tuple(PRINTED)}), Cells(fly, {"least": LEAST}), found=_found
)
