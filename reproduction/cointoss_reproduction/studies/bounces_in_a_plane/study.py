"""Section 1, after Zeng-Yuan and Bin: a coin that bounces in air in a plane, and what spin in space adds."""

from collections.abc import Iterator

import numpy as np
import pandas as pd

from cointoss import Outcome, analytic
from cointoss.coin_mj import impacts_of
from cointoss.study import PLACE, run, scenario_of_row, share, states_of
from cointoss_reproduction.frame.cells import Cells, Rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.planar_maps import (
    HEIGHTS,
    SPINS,
    case,
    faces_after,
    planar_rows,
    toss_rows_by_mujoco,
)

SEED = 71
ASIDE = (0.0, 0.01, 0.1, 1.0, 3.0, 10.0, 20.0)
"""Spins about ζ that are added to that about ξ, first none [rad/s]."""
NONE, LITTLE, SHOWN = "0", "0.01", "10"
"""The spins of `ASIDE` whose effect is shown."""
HEIGHTS_OF_DROP = (0.015, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0)
"""The heights from which coins spin with `DROP_SPINS` [m]."""
LOWEST, MIDDLE, HIGHEST = "0.015", "0.2", "1"
"""The heights of drop that are shown."""
DROP_SPINS = (2.0, 20.0)
"""The spins of the coins that are dropped [rad/s]."""
FOLLOWED, IMPACTS = 6, 3
"""How many tosses are compared with MuJoCo's in position, and through how many impacts."""
ACCURACY = 1e-6
"""The difference in height of nearby tosses [m]."""


def tossed(count: int = 2000, tosses_mujoco: int = 200) -> Iterator[Rows]:
    """Toss in a plane; add spin about the normal; drop from ever greater heights."""
    scenario, rng = case(air=True), np.random.default_rng(SEED)
    flat = planar_rows(scenario, rng.uniform(*HEIGHTS, count), rng.uniform(*SPINS, count))
    for row, state in zip(flat[:FOLLOWED], states_of(flat[:FOLLOWED]), strict=True):
        one = scenario_of_row(row)
        places = run(one.body, one.rules, state).rows["position"]
        by_mujoco = impacts_of(one.replace("ending.max_impacts", IMPACTS)).position
        off, aside = np.abs(places[:, :2]).max(axis=0)
        between = np.abs(by_mujoco[: len(places)] - places[: len(by_mujoco)]).max()
        yield {"off": off, "pushed": aside, "between": between, "off_mujoco": np.abs(by_mujoco[:, 0]).max()}
    first_ended, first_touched = analytic.toss_rows(flat).outcome, faces_after(flat, 0)
    for aside in ASIDE:
        turned = flat.copy()
        turned[:, PLACE["release.angular_velocity.zeta"]] = aside
        ended, touched = analytic.toss_rows(turned).outcome, faces_after(turned, 0)
        kinds = {
            "outcomes changed": ended != first_ended,
            "first touches changed": touched != first_touched,
            "heads": ended == Outcome.HEADS,
        }
        parts = [share(met) for met in kinds.values()]
        yield pd.DataFrame({"kind": [*kinds], "aside": aside, "part": parts})
        if f"{aside:g}" == SHOWN:
            yield {"by_mujoco": np.mean(toss_rows_by_mujoco(turned[:tosses_mujoco]).outcome == Outcome.HEADS)}
    spins = rng.uniform(*DROP_SPINS, count)
    for height in HEIGHTS_OF_DROP:
        one, other = (
            analytic.toss_rows(planar_rows(scenario, np.full(count, height + step), spins)).outcome
            for step in (0.0, ACCURACY)
        )
        yield {"kind": "bounced", "height": height, "uncertain": share(one != other)}


REPRODUCTION = study(__name__, Cells(tossed, {}))
