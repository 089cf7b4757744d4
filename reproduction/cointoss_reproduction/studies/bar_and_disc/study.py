"""Section 4.1: a bouncing bar, as Vulović and Prange and Mizuguchi and Suwashita have it, and a disc."""

from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import Face, Scenario, analytic
from cointoss.study import (
    Answers,
    Array,
    MapAxis,
    Progress,
    rows_from_states,
    share,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.crossings import crossings
from cointoss_reproduction.setups.kellers_map import FASTEST, HIGHEST, middles, thrown
from cointoss_reproduction.setups.planar_maps import case, draw_titled, toss_rows_by_mujoco

BODIES = ("disc", "bar")
SPEEDS = np.array([0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2, 0.225, 0.25])
"""v_0/g of the lines on which stripes are counted [s]; the first is near zero, the last far from it."""
SEED = 41


def make(progress: Progress, points: int = 90, line: int = 2500, tosses_mujoco: int = 200) -> Findings:
    """Map the final face of both bodies as Fig. 2 does, and measure their stripes along lines."""
    x, y = (part.ravel() for part in np.meshgrid(middles(FASTEST, points), middles(HIGHEST, points)))
    keller = np.abs(x * y - np.round(x * y)) < 0.25
    data: Data = {"Keller": np.where(keller, Face.HEADS, Face.TAILS).astype(np.int8).reshape(points, points)}
    few = np.random.default_rng(SEED).choice(len(x), tosses_mujoco, replace=False)
    lines = np.tile(middles(FASTEST, line), len(SPEEDS)), np.repeat(SPEEDS, line)
    same = {}
    for done, body in enumerate(BODIES, start=1):
        scenario = _scenario(body)
        faces, along = (_faces(scenario, *tossed) for tossed in ((x, y), lines))
        crossed = crossings(along.reshape(len(SPEEDS), line))
        # Keller's boundaries lie at odd quarters of a turn.
        width = np.floor(2 * FASTEST * SPEEDS + 1 / 2) / np.maximum(crossed, 1)
        data |= {body: faces.reshape(points, points), f"{body}, width": width, f"{body}, boundaries": crossed}
        same[body] = np.sum(_faces(scenario, x[few], y[few], toss_rows_by_mujoco) == faces[few])
        progress(done, len(BODIES))
    near, far = ({body: data[f"{body}, width"][at] for body in BODIES} for at in (0, -1))
    return Findings(
        data=data,
        same=same,
        near=near,
        least_near=min(near.values()),
        far=far,
        most_far=max(far.values()),
        other=share(data["bar"] != data["disc"], "pixels"),
    )


def _scenario(body: str) -> Scenario:
    """Return the scenario of a thin disc, or of a bar as long as it is wide, in vacuum."""
    scenario = case(air=False)
    if body == "disc":
        return scenario
    m, r = scenario.coin.mass, scenario.coin.radius
    # In plane motion J_ξ alone counts; the paper sets J_η to the same.
    J = m * (2 * r) ** 2 / 12
    inertia = ((J, 0.0, 0.0), (0.0, J, 0.0), (0.0, 0.0, m * r**2 / 2))
    return scenario.replace("coin.inertia", inertia)


def _faces(
    scenario: Scenario,
    over: Array,
    up: Array,
    toss_rows: Callable[[Array], Answers] = analytic.toss_rows,
) -> NDArray[np.int8]:
    return toss_rows(rows_from_states(scenario, thrown(scenario, over, up))).outcome


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(11, 3.2))
    *maps, widths = picture.subplots(1, 4)
    x = MapAxis(name="ω₀/π", unit="1/s", start=0.0, stop=FASTEST)
    y = MapAxis(name="v₀/g", unit="s", start=0.0, stop=HIGHEST)
    titles = {"Keller": "Keller: caught", **{body: f"{body}, bouncing" for body in BODIES}}
    for axes, (name, title) in zip(maps, titles.items(), strict=True):
        draw_titled(axes, data[name], title, x=x, y=y)
        axes.label_outer()
    for body in BODIES:
        widths.semilogy(SPEEDS, data[f"{body}, width"], "o-", label=body)
    widths.set(title="mean stripe over Keller's", xlabel="v₀/g [s]", ylim=(3e-3, 2))
    widths.legend()
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
