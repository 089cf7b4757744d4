"""Section 4.1: a bouncing bar, as Vulović and Prange and Mizuguchi and Suwashita have it, and a disc."""

from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import analytic, coin_mj
from cointoss.compare.basins.picture import MapAxis, draw_panel
from cointoss.compare.basins.stripes import crossings
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, VERMILION
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.estimates import share
from cointoss.compare.reproduction.paper.fig2 import FASTEST, HIGHEST
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.setups.planar_maps import case
from cointoss.models.records import Array, Face
from cointoss.models.releases import Releases
from cointoss.models.scenario import Scenario

BODIES = {"disc": BLUE, "bar": VERMILION}
SPEEDS = np.array([0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2, 0.225, 0.25])
"""v_0/g of the lines on which stripes are counted [s]; the first is near zero, the last far from it."""
SEED = 41


def make(progress: Progress, points: int = 90, line: int = 2500, tosses_mujoco: int = 200) -> Result:
    """Map the final face of both bodies as Fig. 2 does, and measure their stripes along lines."""
    spins, speeds = _middles(FASTEST, points), _middles(HIGHEST, points)
    over, up = (part.ravel() for part in np.meshgrid(spins, speeds))
    keller = np.abs(over * up - np.round(over * up)) < 0.25
    data: dict[str, NDArray[Any]] = {
        "Keller": np.where(keller, Face.HEADS, Face.TAILS).astype(np.int8).reshape(points, points)
    }
    widths: dict[str, Array] = {}
    fine = _middles(FASTEST, line)
    for body in BODIES:
        scenario = _scenario(body)
        faces = _faces(scenario, over, up)
        data[body] = faces.reshape(points, points)
        progress(2 * len(widths) + 1, 2 * len(BODIES) + 1)
        found = [int(crossings(_faces(scenario, fine, np.full(line, speed)))) for speed in SPEEDS]
        # Keller's boundaries lie at odd quarters of a turn.
        widths[body] = np.floor(2 * FASTEST * SPEEDS + 1 / 2) / np.maximum(found, 1)
        data |= {f"{body}, width": widths[body], f"{body}, boundaries": np.array(found)}
        progress(2 * len(widths), 2 * len(BODIES) + 1)
    few = np.random.default_rng(SEED).choice(len(over), tosses_mujoco, replace=False)
    mujoco = {
        body: coin_mj.toss_many(
            _scenario(body), _releases(_scenario(body), over[few], up[few]), settings=coin_mj.FINE
        )
        for body in BODIES
    }
    same = [int(np.sum(mujoco[body].outcome == data[body].ravel()[few])) for body in BODIES]
    progress(2 * len(BODIES) + 1, 2 * len(BODIES) + 1)
    other = share(data["bar"] != data["disc"], "pixels")
    claims = (
        Claim(
            claim="near zero the regions of a bouncing bar resemble Keller's (section 1)",
            analytic=f"at v_0/g = {SPEEDS[0]:g} s stripes are as wide: {_listed(widths, 0)} of Keller's",
            mujoco=", ".join(
                f"{number} of {tosses_mujoco} pixels of the map as the analytic engine ({body})"
                for number, body in zip(same, BODIES, strict=True)
            ),
            criteria=[
                Criterion(
                    "least width over Keller's, near zero",
                    min(width[0] for width in widths.values()),
                    ">",
                    1 / 3,
                    "of the same size",
                )
            ],
        ),
        Claim(
            claim="far from zero they are narrower",
            analytic=f"at v_0/g = {SPEEDS[-1]:g} s on average {_listed(widths, -1)} of Keller's or less",
            criteria=[
                Criterion(
                    "largest width over Keller's, far from zero",
                    max(width[-1] for width in widths.values()),
                    "<",
                    0.1,
                    "another size",
                )
            ],
        ),
        Claim(
            claim="a bar with J = m l²/12 is no model of a coin with J = m r²/4 (section 4.1)",
            analytic=f"{other.value:.0%} of the pixels show the other face; its stripes are about as wide",
            criteria=[Criterion("share of other faces", other, ">", 0.25, "half of what chance would give")],
        ),
    )
    return Result(claims=claims, data=data)


def _listed(widths: dict[str, Array], line: int) -> str:
    return ", ".join(f"{width[line]:.2g} ({body})" for body, width in widths.items())


def _middles(end: float, count: int) -> Array:
    return (np.arange(count) + 0.5) * end / count


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


def _releases(scenario: Scenario, over: Array, up: Array) -> Releases:
    """Return releases flat, one radius above the floor, with ω_0/π [1/s] and v_0/g [s]."""
    zero = np.zeros_like(over)
    return Releases(
        position=np.column_stack([zero, zero, zero + scenario.coin.radius]),
        velocity=np.column_stack([zero, zero, up * scenario.gravity]),
        quaternion=np.column_stack([zero + 1, zero, zero, zero]),
        angular_velocity=np.column_stack([over * np.pi, zero, zero]),
    )


def _faces(scenario: Scenario, over: Array, up: Array) -> NDArray[np.int8]:
    return analytic.toss_many(scenario, _releases(scenario, over, up)).outcome


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
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


REPRODUCTION = Reproduction(
    paper="Section 4.1, Vulović and Prange, Mizuguchi and Suwashita",
    title="a bouncing bar and a bouncing disc beside Keller's coin",
    assumed=(
        "Tossed flat, heads up, one radius above the floor, without air, bouncing on a smooth floor with "
        "χ = 0.6 (the restitution of those studies is not given). The bar is as long as the disc is wide. "
        "Keller's coin is caught at the height of release. Widths are lengths of lines over "
        "the boundaries counted on them."
    ),
    seconds=35,
    make=make,
    draw={"figure": _draw},
    quick_seconds=10,
    quick=partial(make, points=30, line=300, tosses_mujoco=20),
)
