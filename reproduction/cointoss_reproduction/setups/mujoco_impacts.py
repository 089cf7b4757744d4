"""Single impacts from random touches: MuJoCo's contacts beside the paper's laws."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from cointoss import ContactLaw, Floor, Impacts, Scenario, analytic, coin_mj
from cointoss.coin_mj import MujocoSettings
from cointoss.study import Array, gap, rotation_matrix
from cointoss_reproduction.setups.general_coins import PAPER_OFFSET

CLEARANCE = 1e-9
"""Height of the lowest rim point at release [m]: nothing happens on the way down."""
AT_ONCE = 1e-7
"""The longest time from the release to the touch [s]."""
ALONE = 1e-4
"""The time after the first touch in which no second rim point may land [s]."""
SLOWEST = 0.3
"""The least speed at which the contact point comes down [m/s]."""


def touch(
    release: dict[str, Sequence[float]],
    restitution: float,
    thickness: float = 2e-3,
    offset: Sequence[float] = (0, 0, 0),
) -> Scenario:
    """Return the toss of the paper's 1 zloty coin that touches a smooth floor at once, for one impact.

    Args:
        release: attitude, velocity and spin, as a scenario has them.
        restitution: χ.
        thickness: h [m].
        offset: C from B, body frame, (3,) [m].
    """
    described: dict[str, Any] = {
        "coin": {"mass": 2e-3, "radius": 1.25e-2, "thickness": thickness, "center_of_mass": offset},
        "floor": {"restitution": restitution, "contact": "smooth"},
        "release": {"position": (0, 0, 1), **release},
        "ending": {"max_impacts": 1},
    }
    case = Scenario.model_validate(described)
    z = 1.0 - gap(case.body, 1.0, rotation_matrix(case.release.attitude)[2]) + CLEARANCE
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
        offset = np.array(PAPER_OFFSET) * float(rng.integers(2)) * [1, 1, thickness > 0]
        release = {
            "quaternion": (e / np.linalg.norm(e)).tolist(),
            "velocity": rng.uniform([-0.3, -0.3, -3.0], [0.3, 0.3, -1.0]).tolist(),
            "angular_velocity": rng.uniform(-spin, spin, 3).tolist(),
        }
        case = touch(release, float(rng.uniform(*restitutions)), thickness, offset.tolist())
        if _is_one_touch(case):
            cases.append(case)
    return cases


def _is_one_touch(case: Scenario) -> bool:
    """Return whether the coin touches at once, fast enough, and no second point lands with the first."""
    found = analytic.toss(case.replace("ending.max_impacts", 2)).impacts
    at_once = found.time[0] < AT_ONCE and found.contact_velocity_before[0, 2] < -SLOWEST
    return bool(at_once and np.all(np.diff(found.time) > ALONE))


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


def first(impacts: Sequence[Impacts], column: str) -> Array:
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
    return np.abs(-after[:, 2] / before[:, 2] - [case.floor.restitution for case in cases])


def relative_errors(a: Array, b: Array) -> Array:
    """Return |a - b|/|a| for each row, (n,)."""
    return np.linalg.norm(a - b, axis=1) / np.linalg.norm(a, axis=1)


def spread(errors: Array) -> dict[str, float]:
    """Return the median and the worst of errors, (n,)."""
    return {"median": float(np.median(errors)), "worst": float(errors.max())}
