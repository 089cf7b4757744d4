"""Section 4.1: a bouncing bar, as Vulović and Prange and Mizuguchi and Suwashita have it, and a disc."""

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import Face, Scenario, analytic
from cointoss.study import (
    BLUE,
    VERMILION,
    Array,
    MapAxis,
    Progress,
    crossings,
    draw_panel,
    rows_from_states,
    share,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared, listed
from cointoss_reproduction.setups.kellers_map import FASTEST, HIGHEST, middles, thrown
from cointoss_reproduction.setups.planar_maps import case, toss_rows_by_mujoco

BODIES = {"disc": BLUE, "bar": VERMILION}
SPEEDS = np.array([0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2, 0.225, 0.25])
"""v_0/g of the lines on which stripes are counted [s]; the first is near zero, the last far from it."""
SEED = 41
ALIKE = "pixels of the map as the analytic engine"


def make(progress: Progress, points: int = 90, line: int = 2500, tosses_mujoco: int = 200) -> Findings:
    """Map the final face of both bodies as Fig. 2 does, and measure their stripes along lines."""
    spins, speeds = middles(FASTEST, points), middles(HIGHEST, points)
    over, up = (part.ravel() for part in np.meshgrid(spins, speeds))
    keller = np.abs(over * up - np.round(over * up)) < 0.25
    data: Data = {"Keller": np.where(keller, Face.HEADS, Face.TAILS).astype(np.int8).reshape(points, points)}
    widths: dict[str, Array] = {}
    fine = middles(FASTEST, line)
    for body in BODIES:
        scenario = _scenario(body)
        faces = _faces(scenario, over, up)
        data[body] = faces.reshape(points, points)
        progress(2 * len(widths) + 1, 2 * len(BODIES) + 1)
        along = _faces(scenario, np.tile(fine, len(SPEEDS)), np.repeat(SPEEDS, line))
        lines = crossings(along.reshape(len(SPEEDS), line))
        # Keller's boundaries lie at odd quarters of a turn.
        widths[body] = np.floor(2 * FASTEST * SPEEDS + 1 / 2) / np.maximum(lines, 1)
        data |= {f"{body}, width": widths[body], f"{body}, boundaries": lines}
        progress(2 * len(widths), 2 * len(BODIES) + 1)
    few = np.random.default_rng(SEED).choice(len(over), tosses_mujoco, replace=False)
    rows = np.concatenate([_rows(_scenario(body), over[few], up[few]) for body in BODIES])
    mujoco = toss_rows_by_mujoco(rows).outcome.reshape(len(BODIES), -1)
    same = [int(np.sum(row == data[body].ravel()[few])) for row, body in zip(mujoco, BODIES, strict=True)]
    progress(2 * len(BODIES) + 1, 2 * len(BODIES) + 1)
    by_mujoco = [f"{n} of {tosses_mujoco} {ALIKE} ({body})" for n, body in zip(same, BODIES, strict=True)]
    near, far = ({body: width[at] for body, width in widths.items()} for at in (0, -1))
    return Findings(
        data=data,
        mujoco=", ".join(by_mujoco),
        near=listed(near, ".2g"),
        least_near=min(near.values()),
        far=listed(far, ".2g"),
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


def _rows(scenario: Scenario, over: Array, up: Array) -> Array:
    return rows_from_states(scenario, thrown(scenario, over, up))


def _faces(scenario: Scenario, over: Array, up: Array) -> NDArray[np.int8]:
    return analytic.toss_rows(_rows(scenario, over, up)).outcome


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(11, 3.2))
    *maps, widths = picture.subplots(1, 4)
    x = MapAxis(name="ω₀/π", unit="1/s", start=0.0, stop=FASTEST)
    y = MapAxis(name="v₀/g", unit="s", start=0.0, stop=HIGHEST)
    for axes, name in zip(maps, ("Keller", *BODIES), strict=True):
        draw_panel(axes, data[name], x=x, y=y)
        axes.set_title({"Keller": "Keller: caught"}.get(name, f"{name}, bouncing"))
        axes.grid(visible=False)
        axes.label_outer()
    for body, color in BODIES.items():
        widths.semilogy(SPEEDS, data[f"{body}, width"], "o-", color=color, markersize=3, label=body)
    widths.set(title="mean stripe over Keller's", xlabel="v₀/g [s]", ylim=(3e-3, 2))
    widths.legend()
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
