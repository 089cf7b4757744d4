"""A claim of sections 5.1 and 6: the thin ideal coin is sufficient for a real one."""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss import Coin, ContactLaw, Floor, Outcome, Scenario, analytic, load
from cointoss.study import Answers, Array, Estimate, rows_from_states, run, share
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import difference, jackknife
from cointoss_reproduction.setups.face_changes import changes, share_after_row
from cointoss_reproduction.setups.hands import states_of_hands
from cointoss_reproduction.setups.planar_maps import faces_after, toss_rows_by_mujoco

SEED = 6
ASIDE = 10.0
"""Spins about ξ and ζ, at most [rad/s]."""
COINS = THIN, NEAR, REAL = "thin ideal", "thick, c/10", "thick, c"
"""The paper's model, and its 1 zloty coin with a mass centre as far off as it says and a tenth of that."""
FLOORS = {
    "smooth": Floor(restitution=0.6, contact=ContactLaw.SMOOTH),
    "rough": Floor(restitution=0.6, contact=ContactLaw.COULOMB, friction=0.2),
}
AXES = {"floor": tuple(FLOORS), "coin": COINS}
STEP = 1e-5
"""The difference in height from one toss of Fig. 24 to the next [m]."""


def bounced(floor: str, coin: str, count: int = 20_000, count_real: int = 2000) -> dict[str, Any]:
    """Toss a coin from `count` releases, the real one from fewer, and compare it with the thin one."""
    own, changed = _tossed(coin, floor, count, count_real)
    thin, thin_changed = _tossed(THIN, floor, count, count_real)
    few = len(own.outcome)
    row = {
        "heads": share(own.outcome == Outcome.HEADS),
        "edges": share(own.outcome == Outcome.EDGE),
        "impacts": own.impacts.mean(),
        "uncertain": share(changed),
        "same": Estimate(1, 1, 1, count) if coin == THIN else share(own.outcome == thin.outcome[:few]),
    }
    if coin == THIN:
        return row
    return row | {
        "heads_apart": difference(own.outcome == Outcome.HEADS, thin.outcome == Outcome.HEADS),
        "impacts_over": _ratio_of_means(own.impacts[:count_real], thin.impacts[:count_real]),
        "uncertain_over": _ratio_of_means(changed, thin_changed),
    }


@cache
def _tossed(coin: str, floor: str, count: int, count_real: int) -> tuple[Answers, NDArray[np.bool_]]:
    """Return how a coin's tosses end, and of the first whether `STEP` changes the outcome."""
    scenario, starts = _case(coin, floor), _starts(count)
    ended = analytic.toss_rows(rows_from_states(scenario, starts[: count_real if coin == REAL else count]))
    higher = analytic.toss_rows(rows_from_states(scenario, starts[:count_real] + STEP * np.eye(13)[2]))
    return ended, higher.outcome != ended.outcome[: len(higher.outcome)]


def landed(coin: str, count: int = 20_000, count_real: int = 2000, followed: int = 400) -> dict[str, Any]:
    """Return how often a coin shows the thin one's face at the first touch, and how its face changes."""
    starts = _starts(count)
    own, thin = (_case(one, "smooth") for one in (coin, THIN))
    faces = [faces_after(rows_from_states(one, starts[:count_real]), 0) for one in (own, thin)]
    kinds = [changes(run(own.body, own.rules, state).rows["face"]) for state in starts[:followed]]
    after_row = share_after_row(np.array([[len(kind) for kind in both] for both in kinds]))
    return {"as_thin": share(faces[0] == faces[1]), "after_row": after_row}


def landed_by_mujoco(count: int = 20_000, tosses_mujoco: int = 200) -> dict[str, Any]:
    """Return how many first faces of the real coin MuJoCo finds as the analytic engine does."""
    rows = rows_from_states(_case(REAL, "smooth"), _starts(count)[:tosses_mujoco])
    return {"same_by_mujoco": np.sum(faces_after(rows, 0, toss_rows_by_mujoco) == faces_after(rows, 0))}


def _starts(count: int) -> Array:
    return states_of_hands(np.random.default_rng(SEED), count, aside=ASIDE)


def _case(coin: str, floor: str) -> Scenario:
    """Return the scenario of a coin, one of `COINS`, on one of `FLOORS`."""
    zloty = load("zloty").replace("floor", FLOORS[floor])
    if coin == THIN:
        return zloty.replace("coin", Coin(mass=zloty.coin.mass, radius=zloty.coin.radius, thickness=0.0))
    x, y, z = ((0.1 if coin == NEAR else 1.0) * c for c in zloty.coin.center_of_mass)
    return zloty.replace("coin.center_of_mass", (x, y, z))


def _ratio_of_means(own: NDArray[Any], thin: NDArray[Any]) -> Estimate:
    """Return a mean of a coin's tosses over that of the thin one's, in the same tosses, (n,) each."""
    return jackknife(lambda kept: float(own[kept].mean() / thin[kept].mean()), len(own))


REPRODUCTION = study(
    __name__, Cells(bounced, AXES), Cells(landed, {"coin": COINS}), Cells(landed_by_mujoco, {})
)
