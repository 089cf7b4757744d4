"""The right values of the suite's cases, by closed forms written apart from the engines."""

from typing import Any

import numpy as np
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation
from scipy.special import ellipk

import cointoss
from cointoss_yardstick.suite.case import Case

G = 9.81


def moments(case: Case) -> tuple[float, float, float, float, float]:
    """Return m, r, h, J_ξ and J_ζ of an ideal coin."""
    m, r, h = case.scenario.coin.mass, case.scenario.coin.radius, case.scenario.coin.thickness
    return m, r, h, m * (r * r / 4 + h * h / 12), m * r * r / 2


def precession(case: Case) -> Any:
    """R(t) = R(0) exp(t L/J_ξ) exp(t (1 - J_ζ/J_ξ) ω_ζ ζ), L in the body frame at the release."""
    *_, J_xi, J_zeta = moments(case)
    w = np.array(case.scenario.release.angular_velocity)
    turning, about_axis = w * [1, 1, J_zeta / J_xi], w * [0, 0, 1 - J_zeta / J_xi]
    t = np.array([[case.until / 2], [case.until]])
    released = Rotation.from_quat(case.scenario.release.attitude, scalar_first=True)
    turned = released * Rotation.from_rotvec(t * turning) * Rotation.from_rotvec(t * about_axis)
    e = turned.as_quat(scalar_first=True)
    return np.concatenate([each * np.sign(each[np.argmax(np.abs(each))]) for each in e])


def dzhanibekov(case: Case) -> list[float]:
    """Landau and Lifshitz, Mechanics, § 37: where L² < 2 E J_2, ω_2 has the period 4 K(k)/λ."""
    a, b, c = np.diag(case.scenario.coin.moments)
    w = np.array(case.scenario.release.angular_velocity)
    E2, L2 = float(w**2 @ [a, b, c]), float((w * [a, b, c]) @ (w * [a, b, c]))
    assert L2 < E2 * b, "it turns about the first axis"
    # The axes in the other order: the formula is for the third.
    a, c = c, a
    rate = ((c - b) * (L2 - E2 * a) / (a * b * c)) ** 0.5
    k2 = (b - a) * (E2 * c - L2) / ((c - b) * (L2 - E2 * a))
    return [4 * float(ellipk(k2)) / rate]


def terminal_speed(case: Case) -> list[float]:
    m, r, h, *_ = moments(case)
    air = case.scenario.air
    c = np.pi * r * r * air.normal + 2 * np.pi * r * h * air.tangential
    return [0.0, 0.0, -m * G / c * (1 - np.exp(-c * case.until / m))]


def smooth_spin(case: Case, tilt: float, w: float, speed: float) -> float:
    """Return the rate of tilt after a smooth impact of the lower rim: the tilt is against the floor."""
    m, r, h, J, _ = moments(case)
    arm = r * np.cos(tilt) - h / 2 * np.sin(tilt)
    S = (1 + case.scenario.floor.restitution) * speed / (1 / m + arm * arm / J)
    return w - arm * S / J


def tilted_spin(case: Case) -> list[float]:
    tilt = np.pi / 4
    _, r, h, *_ = moments(case)
    fall = case.scenario.release.position[2] - r * np.sin(tilt) - h / 2 * np.cos(tilt)
    return [smooth_spin(case, tilt, 0.0, (2 * G * fall) ** 0.5), 0.0, 0.0]


def touch_spin(case: Case) -> list[float]:
    """Return the spin after the touch of a coin that turns about η, which stays where it is."""
    m, r, h, J, J_zeta = moments(case)
    release: Any = case.scenario.release
    theta, w = release.angles[1], release.angular_velocity[1]

    def up_at(t: float) -> Any:
        return (Rotation.from_rotvec([theta, 0, 0]) * Rotation.from_rotvec([0, w * t, 0])).as_matrix()[2]

    def gap(t: float) -> float:
        up = up_at(t)
        return release.position[2] - G * t * t / 2 - h / 2 * abs(up[2]) - r * np.hypot(up[0], up[1])

    times = np.linspace(0, case.until, 4000)
    first = next(i for i in range(1, len(times)) if gap(times[i]) < 0)
    t: Any = brentq(gap, times[first - 1], times[first], xtol=1e-15)
    up = up_at(t)
    across = np.hypot(up[0], up[1])
    A = np.array([-r * up[0] / across, -r * up[1] / across, -h / 2 * np.sign(up[2])])
    spin = np.array([0.0, w, 0.0])
    inertia = np.array([J, J, J_zeta])
    speed = -G * t + np.cross(spin, A) @ up
    lever = np.cross(A, up)
    S = -(1 + case.scenario.floor.restitution) * speed / (1 / m + lever @ (lever / inertia))
    return (spin + S * lever / inertia).tolist()


def coulomb(case: Case) -> list[float]:
    """Routh's planar impact: the impulse grows with the normal part; slip has friction until it stops."""
    m, r, h, J, _ = moments(case)
    release, floor = case.scenario.release, case.scenario.floor
    tilt = np.pi / 4
    fall = release.position[2] - r * np.sin(tilt) - h / 2 * np.cos(tilt)
    # The coin is tilted about x: the lower rim is at y = -r cos, with the lower face's edge.
    a = np.array([-r * np.cos(tilt) + h / 2 * np.sin(tilt), -r * np.sin(tilt) - h / 2 * np.cos(tilt)])
    # Velocity per impulse at the point, in (y, z): K = 1/m + (a_z, -a_y)(a_z, -a_y)ᵀ/J.
    lever = np.array([-a[1], a[0]])
    K = np.eye(2) / m + np.outer(lever, lever) / J
    v = np.array([release.velocity[1], -((2 * G * fall) ** 0.5)])
    target = -floor.restitution * v[1]
    slipping = np.array([-floor.friction * np.sign(v[0]), 1.0])
    rate = K @ slipping
    S = min(-v[0] / rate[0] if v[0] * rate[0] < 0 else np.inf, (target - v[1]) / rate[1]) * slipping
    # Then it sticks, or slips the other way where that takes more friction than there is.
    after = np.array([np.clip(-K[0, 1] / K[0, 0], -floor.friction, floor.friction), 1.0])
    S = S + (target - v[1] - K[1] @ S) / (K[1] @ after) * after
    return [0.0, *S.tolist()]


def critical_speed(case: Case) -> list[float]:
    m, r, _, J_xi, J_zeta = moments(case)
    turning = case.scenario.release.angular_velocity[2]
    squared = ((J_zeta + m * r * r) * J_zeta * turning**2 / J_xi - m * G * r) / (J_xi + m * r * r)
    return [2 * np.pi / squared**0.5]


def zeno(case: Case) -> list[float]:
    """Return when the last bounce above a thousandth of the height comes down to it."""
    _, _, h, *_ = moments(case)
    chi, fall = case.scenario.floor.restitution, case.scenario.release.position[2] - h / 2
    level, first = fall / 1000, (2 * fall / G) ** 0.5
    n = int(np.floor(np.log(1e-3) / (2 * np.log(chi))))
    assert chi ** (2 * n) * fall > level >= chi ** (2 * n + 2) * fall
    begun = first * (1 + 2 * sum(chi**k for k in range(1, n)))
    up = chi**n * G * first
    return [begun + (up + (up * up - 2 * G * level) ** 0.5) / G]


def ten_bounces(case: Case) -> list[float]:
    return [case.scenario.floor.restitution**20]


def shares(case: Case) -> list[float]:
    from cointoss_yardstick.suite.running import HAND

    tosses = cointoss.toss_many(case.scenario, HAND.releases(case.scenario, case.tosses))
    return [float((tosses.outcome == "heads").mean())]


RIGHT = {
    "precession": precession,
    "dzhanibekov": dzhanibekov,
    "terminal_speed": terminal_speed,
    "tilted_spin": tilted_spin,
    "coulomb_slip": coulomb,
    "coulomb_stick": coulomb,
    "coulomb_reversal": coulomb,
    "touch_spin": touch_spin,
    "critical_speed": critical_speed,
    "zeno": zeno,
    "ten_bounces_1": ten_bounces,
    "ten_bounces_80": ten_bounces,
    "shares": shares,
}
"""Functions of a case that return its right value, where cases.toml has more than a plain number."""
