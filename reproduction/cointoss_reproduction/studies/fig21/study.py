"""Figs 21-22: the scaled thin coin in air: speed, acceleration, tilt, and the vertical force of the air."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from cointoss import Air, Scenario, States, analytic, load
from cointoss.study import Array, distance, force_and_moment, rotation_matrix
from cointoss_reproduction.frame.cells import Cells, Rows, column
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.both_engines import by_both, first_touch

SHOWN, SAMPLES = 6.0, 300
"""How long the picture follows the fall [s], and with how many samples."""
IN_AIR = "in air"
MEDIA = {"without air": 1000, IN_AIR: 2000}
"""How often a fall is sampled."""
COLUMNS = ("speed", "acceleration", "cosine", "force")


def fall(medium: str) -> Iterator[Rows]:
    """Let the coin fall; with air MuJoCo follows it.

    Yields:
        The extremes of its acceleration [m/s²], its last spin [rad/s], when it lands [s], and how far
        MuJoCo is from the analytic engine [m]; the turning points of cos θ [s]; `COLUMNS` over time.
    """
    scenario = load("fig21")
    if medium == IN_AIR:
        tosses = by_both(scenario)
    else:
        scenario = scenario.replace("air", Air())
        tosses = {"analytic": analytic.toss(scenario)}
    # At the touch itself the state is that after the impact.
    t = np.linspace(0, first_touch(tosses), MEDIA[medium] + 1)[:-1]
    path = tosses["analytic"].sample(t)
    columns = _columns(scenario, path)
    yield {
        "least": columns[:, 1].min(),
        "most": columns[:, 1].max(),
        "swing": np.ptp(columns[:, 1]),
        "last": abs(path.angular_velocity[-1, 0]),
        "end": first_touch(tosses),
        "apart": distance(path, tosses["MuJoCo"].sample(t)).max() if medium == IN_AIR else None,
    }
    yield pd.DataFrame({"turn": t[1:-1][np.diff(np.sign(np.diff(columns[:, 2]))) != 0]})
    over_time = pd.DataFrame(np.column_stack([t, columns]), columns=["time", *COLUMNS])
    yield over_time.iloc[: np.searchsorted(t, SHOWN) : MEDIA[medium] // SAMPLES]


def _columns(scenario: Scenario, path: States) -> Array:
    """Return the `COLUMNS` of a path, in SI units, (n, 4)."""
    rows = []
    for v, e, w in zip(path.velocity, path.quaternion, path.angular_velocity, strict=True):
        R = np.array(rotation_matrix(tuple(e)))
        f, _ = force_and_moment(scenario.body, tuple(R.T @ v), tuple(w))
        force = R @ np.array(f)
        a = force / scenario.coin.mass - [0, 0, scenario.gravity]
        rows.append([np.linalg.norm(v), np.linalg.norm(a), R[2, 2], force[2]])
    return np.array(rows)


def _found(cells: pd.DataFrame) -> dict[str, Any]:
    turns = column(cells, "turn", f"medium == '{IN_AIR}'")
    return {"turns": turns, "swings": np.diff(turns), "growth": np.diff(turns, 2)}


REPRODUCTION = study(__name__, Cells(fall, {"medium": tuple(MEDIA)}), found=_found)
