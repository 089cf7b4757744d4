"""Fig. 29: basins of heads and tails over height and spin, without and with bouncing, in air and not."""

import numpy as np
from matplotlib.figure import Figure

from cointoss import Face, Outcome, Scenario
from cointoss.coin_mj import impacts_of
from cointoss.study import OutcomeCodes, Progress, distance_to_doubt, fractions, share
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.crossings import crossings
from cointoss_reproduction.setups.planar_maps import (
    HEIGHTS,
    MEDIA,
    SPINS,
    Grid,
    case,
    draw_titled,
    faces_after,
    final_faces,
    planar_rows,
    whole_grid,
)

SEED = 29


def make(progress: Progress, points: int = 400, points_mujoco: int = 16, tosses: int = 100_000) -> Findings:
    """Make the four maps, and toss at random in them; MuJoCo tosses a coarser grid to its first touch."""
    grid, coarse = whole_grid(points), whole_grid(points_mujoco)
    landed, settled = {}, {}
    for done, medium in enumerate(MEDIA):
        scenario = case(air=medium == "air")
        landed[medium] = faces_after(grid.rows(scenario), 0).reshape(grid.shape)
        progress(2 * done + 1, 5)
        settled[medium] = final_faces(scenario, grid)
        progress(2 * done + 2, 5)
    away = distance_to_doubt(landed["vacuum"]) > 1
    faces = faces_after(coarse.rows(case(air=True)), 0).reshape(coarse.shape)
    same = _first_touches(case(air=True), coarse) == faces
    lines, lines_landed, stripes = (
        {name: crossings(maps[::every]).mean() for name, maps in of.items()}
        for of, every in ((settled, 20), (landed, 20), (landed, 1))
    )
    rng = np.random.default_rng(SEED)
    random = rng.uniform(*HEIGHTS, tosses), rng.uniform(*SPINS, tosses)
    air, vacuum = (faces_after(planar_rows(case(air=air), *random), 0) for air in (True, False))
    progress(5, 5)
    return Findings(
        data={
            f"{when}, {name}": maps
            for when, of in (("first touch", landed), ("final", settled))
            for name, maps in of.items()
        },
        wrong=int(np.sum((landed["vacuum"] != _closed_form(grid)) & away)),
        pixels=away.sum(),
        same=int(np.sum(same)),
        coarse_pixels=faces.size,
        lines=lines,
        lines_landed=lines_landed,
        stripes=stripes,
        changed=share(air != vacuum, "tosses"),
        undecided=sum(fractions(maps)[Outcome.UNDECIDED] for maps in settled.values()),
        more_stripes=stripes["air"] / stripes["vacuum"] - 1,
        fewest=min(lines.values()),
        ten_times_landed=10 * max(lines_landed.values()),
    )


def _first_touches(scenario: Scenario, grid: Grid) -> OutcomeCodes:
    """Return MuJoCo's map of the face up at the first touch, (y, x)."""
    once = scenario.replace("ending.max_impacts", 1)
    faces = [
        impacts_of(once.replace("release.position.z", z, "release.angular_velocity.xi", w)).face[0]
        for w in grid.spins.tolist()
        for z in grid.heights.tolist()
    ]
    return np.array(faces, dtype=np.int8).reshape(grid.shape)


def _closed_form(grid: Grid) -> OutcomeCodes:
    """Return the face up at the first touch of a planar thin coin in vacuum, (y, x).

    It touches when z_0 - g t²/2 = r |sin ω t| for the first time; heads is up while cos ω t > 0.
    """
    scenario = case(air=False)
    r, g = scenario.coin.radius, scenario.gravity
    z, w = np.meshgrid(grid.heights, grid.spins)
    # The lower rim can't touch before C is at r; from there on in steps of a tenth of a milliradian.
    start = np.sqrt(2 * (z - r) / g)
    t = start.copy()
    falling = np.ones(t.shape, dtype=bool)
    while falling.any():
        t[falling] += 1e-4 / w[falling]
        falling &= z - g * t**2 / 2 > r * np.abs(np.sin(w * t))
    return np.where(np.cos(w * t) > 0, Face.HEADS, Face.TAILS).astype(np.int8)


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(6.4, 5.6))
    for axes, letter, (name, maps) in zip(picture.subplots(2, 2).flat, "abcd", data.items(), strict=True):
        draw_titled(axes, maps, f"({letter}) {name}")
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
