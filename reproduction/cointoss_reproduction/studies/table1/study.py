"""Table 1: where each sequence of three angles is singular, and what that costs near θ = 0."""

from collections.abc import Callable
from functools import partial

import numpy as np
from matplotlib.figure import Figure
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from cointoss import EndingCriteria, Release, Scenario, analytic, coin_mj, load
from cointoss.study import (
    BLUE,
    VERMILION,
    Array,
    Progress,
    Sequence,
    derivative,
    quaternion_from_angles,
    rate_matrix,
    rotation_of,
    singularity,
    state_at_release,
    vector,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared

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
CLASSICAL = Sequence.ZETA_XI_ZETA

LEAST = np.array([0.3 * 10.0**-k for k in range(11)])
"""Smallest θ of the motions [rad]."""
CONE, ACROSS = np.radians(40), 40.0
"""Angle between the normal and the angular momentum; spin across the normal [rad/s]."""
TOLERANCE = 1e-10
"""Relative, of the solver that chooses its steps."""
STEPS = 1000
"""In the turn of the solver that does not."""


def make(progress: Progress) -> Findings:
    """Check the table; fly past θ = 0 in Euler angles, in Euler parameters, and by both engines."""
    vanish = {sequence.value: singularity(sequence) for sequence in Sequence}
    found = Findings(rows=len(PRINTED))
    found.right = sum((at.function, at.sign, at.angle) == PRINTED[name] for name, at in vanish.items())
    rows = []
    for done, least in enumerate(LEAST, start=1):
        rows.append(_fly(least))
        progress(done, len(LEAST))
    angles, parameters, fixed_angles, fixed_parameters, engine, mujoco = np.array(rows).transpose(1, 0, 2)
    found.errors = np.array([angles[:, 0], parameters[:, 0], fixed_angles[:, 0], fixed_parameters[:, 0]])
    found.steps = np.array([angles[:, 1], parameters[:, 1]])
    found.engines = np.array([engine[:, 0].max(), mujoco[:, 0].max()])
    found.spread, found.three_times = np.ptp(parameters[:, 1]), 3 * angles[0, 1]
    found.thousand_times, found.twice = 1e3 * fixed_angles[0, 0], 2 * fixed_parameters[:, 0].min()
    found.data = {
        "least angle": LEAST,
        "angles, fixed steps": fixed_angles[:, 0],
        "parameters, fixed steps": fixed_parameters[:, 0],
        "angles, chosen steps": angles,
        "parameters, chosen steps": parameters,
        "engine": engine[:, 0],
        "MuJoCo": mujoco[:, 0],
    }
    return found


def _fly(least: float) -> list[tuple[float, float]]:
    """Return error [rad] and steps of all ways to fly a turn about the angular momentum past a least θ."""
    case, L, turn = _case(least)
    release = case.release
    J = case.coin.inertia_about_C
    period = 2 * np.pi / turn
    begin = Rotation.from_euler("ZXZ", np.array(release.angles))
    spin = (1 - J[2, 2] / J[0, 0]) * release.angular_velocity[2]
    # The free symmetric top turns about L and, in the body, about its normal.
    end = Rotation.from_rotvec(L * turn * period) * begin * Rotation.from_rotvec([0, 0, spin * period])

    def error_of_angles(y: Array) -> float:
        return (end.inv() * Rotation.from_matrix(rotation_of(CLASSICAL, y[6:9]))).magnitude()

    def error_of_parameters(y: Array) -> float:
        return (end.inv() * Rotation.from_quat(y[6:10], scalar_first=True)).magnitude()

    by_angles = partial(_rate_in_angles, case)
    by_parameters = partial(_rate_in_parameters, case)
    of_parameters = state_at_release(release)
    of_angles = np.array([*of_parameters[:6], *(release.angles or ()), *of_parameters[10:]])
    answers = []
    ways = ((by_angles, of_angles, error_of_angles), (by_parameters, of_parameters, error_of_parameters))
    for rate, start, error in ways:
        found = solve_ivp(
            lambda _, y, rate=rate: rate(y),
            (0, period),
            start,
            method="DOP853",
            rtol=TOLERANCE,
            atol=TOLERANCE,
        )
        answers.append((error(found.y[:, -1]), len(found.t) - 1))
    answers += [(error(_runge_kutta(rate, start, period)), STEPS) for rate, start, error in ways]
    for engine in (analytic.toss, coin_mj.toss):
        e = engine(case).sample(period).quaternion[0]
        answers.append(((end.inv() * Rotation.from_quat(e, scalar_first=True)).magnitude(), np.nan))
    return answers


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


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(8.4, 3.4))
    errors, steps = picture.subplots(1, 2)
    theta = data["least angle"]
    errors.loglog(theta, data["angles, fixed steps"], "o-", color=VERMILION, label="Euler angles")
    errors.loglog(theta, data["parameters, fixed steps"], "o-", color=BLUE, label="Euler parameters")
    errors.set(
        title=f"{STEPS} fixed steps in a turn", xlabel="least θ [rad]", ylabel="error of the attitude [rad]"
    )
    errors.legend()
    steps.loglog(theta, data["angles, chosen steps"][:, 1], "o-", color=VERMILION)
    steps.loglog(theta, data["parameters, chosen steps"][:, 1], "o-", color=BLUE)
    steps.set(title=f"steps chosen to {TOLERANCE:g}", xlabel="least θ [rad]", ylabel="number of steps")
    for axes in (errors, steps):
        axes.invert_xaxis()
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
