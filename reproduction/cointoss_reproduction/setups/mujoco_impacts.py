"""Single impacts from random touches: MuJoCo's contacts beside the paper's laws."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from cointoss import ContactLaw, EndingCriteria, Floor, Impacts, Release, Scenario, analytic, coin_mj
from cointoss.coin_mj import MujocoSettings
from cointoss.study import (
    Array,
    contact_velocity,
    euler_parameters,
    gap,
    lowest_point,
    rotation_matrix,
    vector,
)
from cointoss_reproduction.setups.general_coins import PAPER_OFFSET

CLEARANCE = 1e-9
"""Height of the lowest rim point at release [m]: nothing happens on the way down."""
ALONE = 1e-4
"""No second rim point may land so soon after the first [s]."""
SLOWEST = 0.3
"""The contact point comes down at least so fast [m/s]."""


def touch(
    *,
    attitude: Array,
    velocity: Array,
    spin: Array,
    thickness: float = 2e-3,
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
    restitution: float = 0.8,
) -> Scenario:
    """Return the toss of the paper's 1 zloty coin that touches a smooth floor at once, for one impact.

    Args:
        attitude: Euler parameters of norm 1, body to space, (4,).
        velocity: of C, space frame, (3,) [m/s].
        spin: ω, body frame, (3,) [rad/s].
        thickness: h [m].
        offset: C from B, body frame [m].
        restitution: χ.
    """
    high = Release(
        position=(0.0, 0.0, 1.0),
        velocity=vector(velocity),
        quaternion=euler_parameters(attitude),
        angular_velocity=vector(spin),
    )
    described: dict[str, Any] = {
        "coin": {"mass": 2e-3, "radius": 1.25e-2, "thickness": thickness, "center_of_mass": offset},
        "floor": Floor(restitution=restitution, contact=ContactLaw.SMOOTH),
        "release": high,
        "ending": EndingCriteria(max_impacts=1),
    }
    case = Scenario.model_validate(described)
    z = 1.0 - gap(case.body, 1.0, rotation_matrix(high.attitude)[2]) + CLEARANCE
    return case.replace("release.position.z", z)


def draw_touches(
    rng: np.random.Generator, count: int, restitutions: tuple[float, float], spin: float = 40.0
) -> list[Scenario]:
    """Draw touches of the paper's four coins by one rim point.

    Every attitude is equally likely; of C the speeds are up to 0.3 m/s along the floor and from 1 to 3 m/s
    down.

    Args:
        rng: the source of chance.
        count: how many.
        restitutions: smallest and largest χ.
        spin: largest |ω| about each axis [rad/s].
    """
    cases: list[Scenario] = []
    while len(cases) < count:
        e = rng.normal(size=4)
        thickness = float(rng.choice([0.0, 2e-3]))
        offset = np.array(PAPER_OFFSET) * float(rng.integers(2))
        if thickness == 0:
            offset[2] = 0
        case = touch(
            attitude=e / np.linalg.norm(e),
            velocity=rng.uniform([-0.3, -0.3, -3.0], [0.3, 0.3, -1.0]),
            spin=rng.uniform(-spin, spin, 3),
            thickness=thickness,
            offset=vector(offset),
            restitution=float(rng.uniform(*restitutions)),
        )
        if -velocity_at_touch(case)[2] > SLOWEST and _is_alone(case):
            cases.append(case)
    return cases


def velocity_at_touch(case: Scenario) -> Array:
    """Return the velocity of the lowest point at release, space frame, (3,) [m/s]."""
    release, body = case.release, case.body
    R = rotation_matrix(release.attitude)
    point, _ = lowest_point(body, R[2], release.angular_velocity)
    return np.array(contact_velocity(body, R, release.velocity, release.angular_velocity, point))


def _is_alone(case: Scenario) -> bool:
    times = analytic.toss(case.replace("ending.max_impacts", 2)).impacts.time
    return bool(np.all(np.diff(times) > ALONE))


def on_floor(case: Scenario, law: ContactLaw, friction: float) -> Scenario:
    """Return the same touch of a floor with another law."""
    floor = Floor(restitution=case.floor.restitution, contact=law, friction=friction)
    return case.replace("floor", floor)


def by_law(cases: Iterable[Scenario]) -> list[Impacts]:
    """Return the impacts by the paper's laws."""
    return [analytic.toss(case).impacts for case in cases]


def by_mujoco(cases: Iterable[Scenario], settings: MujocoSettings) -> list[Impacts]:
    """Return the impacts by MuJoCo, whose floor is smooth, or Coulomb's."""
    return [coin_mj.impacts_of(case, settings=settings) for case in cases]


def first(impacts: list[Impacts], column: str) -> Array:
    """Return a column of the first impact of each, infinite where there is none, (n, ...)."""
    empty = np.full(getattr(impacts[0], column).shape[1:], np.inf)
    return np.array([getattr(one, column)[0] if len(one) else empty for one in impacts])


def impulse_errors(cases: Sequence[Scenario], settings: MujocoSettings) -> Array:
    """Return |S_law - S|/|S_law| of MuJoCo's first impulses, (n,)."""
    return relative_errors(first(by_law(cases), "impulse"), first(by_mujoco(cases, settings), "impulse"))


def restitution_errors(cases: Sequence[Scenario], settings: MujocoSettings) -> Array:
    """Return |χ' - χ|, χ' the restitution of MuJoCo's first impacts, (n,)."""
    found = by_mujoco(cases, settings)
    after, before = first(found, "contact_velocity_after"), first(found, "contact_velocity_before")
    return np.abs(-after[:, 2] / before[:, 2] - np.array([case.floor.restitution for case in cases]))


def relative_errors(a: Array, b: Array) -> Array:
    """Return |a - b|/|a| for each row, (n,)."""
    return np.linalg.norm(a - b, axis=1) / np.linalg.norm(a, axis=1)
