"""Fig. 4 and section 2: the angle between angular momentum and normal, and the faces that it keeps."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from scipy.spatial.transform import Rotation

from cointoss import Air, EndingCriteria, Release, Scenario, coin_mj, load
from cointoss.study import Array, vector
from cointoss_reproduction.frame.cells import Cells, Rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.both_engines import by_both, first_touch
from cointoss_reproduction.setups.kellers_map import flown

CASES = {
    "ideal in vacuum": ("fig4_ideal", Air()),
    "ideal in air": ("fig4_ideal", Air(normal=0.8, tangential=0.2)),
    "imperfect in vacuum": ("fig4_imperfect", Air()),
}
DURATION, SAMPLES = 0.5, 400
"""The duration of a random toss [s], and how often its face is sampled."""
DRAWN = 300
"""The number of random tosses that are drawn."""
MUJOCO_TOSSES = 10
TURNS = 4000
"""Samples of one turn of the normal about the angular momentum."""
TWO_SAMPLES = 2 / TURNS
AT, P = 79.95, 0.51
"""The angle ψ [degrees] and the probability of the first side there, by Diaconis, Holmes, Montgomery 2007."""
PSI = {angle: np.radians(angle) for angle in (*range(40, 80, 4), AT, 80, 84, 88)}


def follow(case: tuple[str, Air]) -> pd.DataFrame:
    """Return γ by both engines until the coin lands, and by how much it changes [degrees]."""
    file, air = case
    scenario = load(file).replace("air", air, "ending", EndingCriteria(max_impacts=1))
    tosses = by_both(scenario)
    # At the touch itself the state is that after the impact.
    t = np.linspace(0, first_touch(tosses), 301)[:-1]
    gamma = {engine: _gamma(scenario, toss.sample(t).angular_velocity) for engine, toss in tosses.items()}
    found = pd.DataFrame({"time": t, **gamma}).melt("time", var_name="engine", value_name="gamma")
    return found.assign(swing=found.groupby("engine")["gamma"].transform(np.ptp)).iloc[::3]


def _gamma(scenario: Scenario, w: Array) -> Array:
    """Return the angle between the angular momentum and the normal, (n,) [degrees]."""
    L = w @ scenario.coin.inertia_about_C
    return np.degrees(np.arctan2(np.hypot(L[:, 0], L[:, 1]), L[:, 2]))


def toss_at_random(count: int = 1000) -> Iterator[Rows]:
    """Toss the ideal coin from flat, and as often from any attitude; γ is up to π/2, the turn to 100 rad/s.

    Yields:
        Of all tosses how many have γ < π/4 and change their face, and how far n_z is from the closed form;
        of some γ [degrees] and the lowest n_z of their first side.
    """
    rng = np.random.default_rng(4)
    scenario = load("fig4_ideal")
    J = np.diag(scenario.coin.inertia_about_C)
    for released in ("flat", "leaning"):
        gamma, turn = rng.uniform(0, np.pi / 2, count), rng.uniform(20, 100, count)
        around = rng.uniform(0, 2 * np.pi, count)
        L = np.stack([np.sin(gamma) * np.cos(around), np.sin(gamma) * np.sin(around), np.cos(gamma)], axis=1)
        w = L * (turn * J[0])[:, None] / J
        any_attitude = released == "leaning"
        attitude = Rotation.random(count, rng=rng) if any_attitude else Rotation.identity(count)
        starts = np.hstack([np.zeros((count, 6)), attitude.as_quat(scalar_first=True), w])
        tossed = attitude.apply([0, 0, 1]), attitude.apply(L), turn
        lowest, apart = np.array([_tossed(scenario, *one) for one in zip(starts, *tossed, strict=True)]).T
        below = gamma < np.pi / 4
        yield {
            "released": released,
            "tosses": count,
            "below": int(below.sum()),
            "changed": int(np.sum((lowest < 0) & below)),
            "apart": apart.max(),
            "foretold": np.mean((np.abs(tossed[1][:, 2]) > np.sin(gamma)) == (lowest > 0)),
            "mujoco_apart": None if any_attitude else _mujoco_apart(scenario, w, *tossed),
        }
        drawn = {"angle": np.degrees(gamma[:DRAWN]), "lowest": lowest[:DRAWN]}
        yield pd.DataFrame({"released": released, **drawn})


def _tossed(scenario: Scenario, start: Array, n: Array, L: Array, turn: float) -> tuple[float, float]:
    """Return the least |n_z| while the first side is up, less than 0 where it turns over, and its error."""
    times = np.linspace(0, DURATION, SAMPLES)
    heights = flown(scenario, start, times)
    apart = np.abs(heights - _closed_form(n, L, turn, times)).max()
    return (np.sign(heights[0]) * heights).min(), apart


def _closed_form(n: Array, L: Array, turn: float, times: Array) -> Array:
    """Return n_z(t) of the ideal coin without air: its normal n turns about L.

    Args:
        n: at time 0, space frame, (3,).
        L: direction of the angular momentum, space frame, (3,).
        turn: |L|/J_ξ [rad/s].
        times: (n,) [s].
    """
    along = (n @ L) * L
    return along[2] + (n - along)[2] * np.cos(turn * times) + np.cross(L, n)[2] * np.sin(turn * times)


def _mujoco_apart(scenario: Scenario, w: Array, n: Array, L: Array, turn: Array) -> float:
    """Return how far n_z by MuJoCo is from the closed form in the first tosses from flat."""
    times, apart = np.linspace(0, DURATION, 50), []
    for i in range(MUJOCO_TOSSES):
        release = Release(position=(0.0, 0.0, 2.0), angular_velocity=vector(w[i]))
        heights = _mujoco_heights(scenario, release, DURATION, times)
        apart.append(np.abs(heights - _closed_form(n[i], L[i], turn[i], times)).max())
    return float(max(apart))


def _mujoco_heights(scenario: Scenario, release: Release, lasts: float, times: Array) -> Array:
    case = scenario.replace("release", release, "ending", EndingCriteria(max_time=lasts))
    return coin_mj.toss(case).sample(times).normal[:, 2]


def turn(psi: float) -> Iterator[dict[str, Any]]:
    """Yield for how much of a turn the first side is up: in closed form, counted, and by MuJoCo.

    The closed form is Diaconis, Holmes and Montgomery 2007, theorem 2: the ideal coin is released flat, and
    caught after a time that leaves every phase of its turn about the angular momentum as likely.

    Args:
        psi: ψ, between normal and angular momentum, from 0 to π/2 [rad].
    """
    scenario, rate = load("fig4_ideal"), 60.0
    J = np.diag(scenario.coin.inertia_about_C)
    # In the middles of equal parts of the turn.
    times = (np.arange(TURNS) + 0.5) / TURNS * 2 * np.pi / rate
    w = rate * J[0] * np.array([0, np.sin(psi), np.cos(psi)]) / J
    heights = flown(scenario, np.array([0, 0, 0, 0, 0, 0, 1.0, 0, 0, 0, *w]), times)
    release = Release(position=(0.0, 0.0, 1.0), velocity=(0.0, 0.0, 2.0), angular_velocity=vector(w))
    mujoco = float(np.mean(_mujoco_heights(scenario, release, 2 * np.pi / rate, times) > 0))
    exact = float(1 / 2 + np.arcsin(np.minimum(1 / np.tan(psi), 1) ** 2) / np.pi)
    counted = float(np.mean(heights > 0))
    yield {"by": "closed form", "p": exact, "off": abs(exact - P)}
    yield {"by": "counted", "p": counted, "off": abs(counted - exact)}
    yield {"by": "MuJoCo", "p": mujoco, "off": abs(mujoco - counted)}


def _found(cells: pd.DataFrame) -> dict[str, Any]:
    swings = cells.groupby(["engine", "case"])["swing"].first().unstack("case")
    return {"swing": swings, "quarter": cells["tosses"].max() / 4}


REPRODUCTION = study(
    __name__,
    Cells(follow, {"case": CASES}),
    Cells(toss_at_random, {}),
    Cells(turn, {"psi": PSI}),
    found=_found,
)
