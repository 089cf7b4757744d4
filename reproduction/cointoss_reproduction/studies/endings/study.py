"""How thousands of random tosses end, by coin, floor and air, and how far both engines agree in it."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from cointoss import Engine, Outcome, Scenario
from cointoss.study import GREY, row_of
from cointoss.study import OUTCOMES as COLORS
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.selection import selected
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.ends import OUTCOMES, tally
from cointoss_reproduction.setups.general_coins import AIR, paper_coin

SEED = 2008
ENGINES = tuple(map(str, Engine))
COINS, THICKNESSES, MEDIA = ("ideal", "imperfect"), ("thin", "thick"), ("vacuum", "air")
ENERGETIC = "coulomb, energetic"
"""A floor that MuJoCo does not realise."""
FLOORS = {"smooth": (0.1, 0.95), "coulomb, kinematic": (0.1, 0.7), ENERGETIC: (0.1, 0.95)}
"""Range of the restitution, by the contact law and the kind of its restitution."""
Kind = tuple[str, str, str]
"""The kind of a toss: thickness, floor and medium."""


def draw_toss(rng: np.random.Generator, coin: str) -> tuple[Kind, Scenario]:
    """Draw a toss from a hand's height: thick or thin coin, floor, air, restitution, friction and release."""
    thick, floor, air = bool(rng.integers(2)), list(FLOORS)[rng.integers(3)], bool(rng.integers(2))
    law, _, restitution_kind = floor.partition(", ")
    described: dict[str, Any] = {
        "coin": paper_coin(thick=thick, imperfect=coin == "imperfect"),
        "air": AIR if air else {},
        "floor": {
            "contact": law,
            "restitution": rng.uniform(*FLOORS[floor]),
            "friction": rng.uniform(0.05, 0.8),
            "restitution_kind": restitution_kind or "kinematic",
        },
        "release": _release(rng),
    }
    return (THICKNESSES[thick], floor, MEDIA[air]), Scenario.model_validate(described)


def _release(rng: np.random.Generator) -> dict[str, Any]:
    e = rng.normal(size=4)
    return {
        "position": [0.0, 0.0, rng.uniform(0.05, 0.6)],
        "velocity": rng.uniform(-0.3, 0.3, 3).tolist(),
        "quaternion": (e / np.linalg.norm(e)).tolist(),
        "angular_velocity": rng.uniform(-40, 40, 3).tolist(),
    }


def drawn_for(engine: str, seed: tuple[int, ...], coin: str) -> tuple[Kind, Scenario]:
    """Draw tosses until one is on a floor that an engine realises; see `draw_toss`."""
    rng = np.random.default_rng(seed)
    kind, scenario = draw_toss(rng, coin)
    while engine == Engine.MUJOCO and kind[1] == ENERGETIC:
        kind, scenario = draw_toss(rng, coin)
    return kind, scenario


def ended(
    engine: str, coin: str, by_analytic: int = 10_000, by_mujoco: int = 5000
) -> Iterator[dict[str, Any]]:
    """Toss coins at random by an engine, and return how those of each kind end."""
    count = by_mujoco if engine == Engine.MUJOCO else by_analytic
    key = (SEED + ENGINES.index(engine), COINS.index(coin))
    kinds, cases = zip(*(drawn_for(engine, (*key, number), coin) for number in range(count)), strict=True)
    found = Engine(engine).package.toss_rows(np.array([row_of(case) for case in cases]))
    decided = ~np.isin(found.outcome, (Outcome.UNDECIDED, Outcome.PERPETUAL, Outcome.TRANSIENT))
    for kind in sorted(set(kinds)):
        which = np.array([one == kind for one in kinds])
        yield {
            **dict(zip(("thickness", "floor", "medium"), kind, strict=True)),
            **tally(found.outcome[which]),
            "impacts": int(found.impacts[which & decided].max(initial=0)),
            "seconds": float(found.end_time[which & decided].max(initial=0.0)),
        }


def draw(cells: pd.DataFrame) -> Figure:
    """Draw the shares of the outcomes as bars."""
    rows: Any = selected(cells, {"where": "engine == 'analytic' and tosses > 0"})[::-1]
    names = [
        f"{', '.join(kind)} ({tosses})"
        for *kind, tosses in rows[["coin", "thickness", "floor", "medium", "tosses"]].itertuples(index=False)
    ]
    picture = Figure(figsize=(9, 0.28 * len(names) + 1.2))
    axes, left = picture.subplots(), np.zeros(len(names))
    for outcome in (*Outcome, Outcome.UNDECIDED)[1:]:
        parts = 100 * (rows[OUTCOMES[outcome]] / rows["tosses"]).to_numpy(dtype=float)
        style: Any = {"color": COLORS[outcome], "edgecolor": GREY, "linewidth": 0.4, "label": str(outcome)}
        axes.barh(names, parts, left=left, **style)
        left += parts
    axes.grid(visible=False)
    axes.set(xlim=(0, 100), xlabel="share of the tosses [%]")
    axes.margins(y=0.01)
    picture.legend(loc="outside upper center", ncols=len(Outcome))
    return picture


REPRODUCTION = study(__name__, Cells(ended, {"engine": ENGINES, "coin": COINS}), draw={"endings": draw})
