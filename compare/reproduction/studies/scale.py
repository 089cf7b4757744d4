"""What a map of planar coins costs on this machine, and so how long ones of 1e6 to 1e12 tosses would take.

Times are the processor's, of all cores together: whatever else the machine does counts little.
"""

import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

from cointoss.compare.engines import Engine
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.tables import paragraphs, table
from cointoss.compare.reproduction.setups.map_times import map_times
from cointoss.compare.reproduction.setups.study import study
from cointoss.compare.sweep import run as sweep_run
from cointoss.compare.sweep.axes import parse_axis
from cointoss.compare.sweep.grid import Sweep, numbers_in, tiles
from cointoss.compare.sweep.layout import layout_of_map
from cointoss.compare.sweep.pixels import Layers, check
from cointoss.compare.sweep.run import toss_part
from cointoss.compare.sweep.store import opened
from cointoss.models.cores import cores_used
from cointoss.models.reading import parse

COIN = """
[coin]
mass = "2 g"
radius = "1.25 cm"
thickness = {thickness}
[air]
normal = {normal}
tangential = {tangential}
[floor]
restitution = 0.6
contact = "smooth"
[release]
position = [0, 0, 0.4]
angular_velocity = [0, 40, 0]
"""
RELEASE = ("release.angular_velocity.eta=20:60:{}", "release.position.z=0.2:0.6:{}")
FLOOR = ("floor.restitution=0.5:0.7:{}", "gravity=9:10:{}")
"""Axes of which every pixel is another floor, so that no two tosses are made together."""
SIDE = 1000
"""Pixels along a side of the map: 1e6 tosses; every third along each is tossed to time the other kinds."""
MUJOCO_SIDE = 60
TILED_SIDE, TILE_SIDES = 100, (10, 32, 100)
"""Pixels along a side of a map that is cut into tiles, and of these: of 1e2, 1e3, 1e4 tosses."""
TOSS = "toss"
LEAST_SHARE = 0.9
"""Of the time of a map that its tosses take, at least."""


@dataclass(frozen=True, kw_only=True)
class MapCosts:
    """Processor times of maps."""

    cores: int
    """Of this machine that were used."""
    toss: dict[str, float]
    """By the kind of toss [s]."""
    tile: dict[int, float]
    """Of a toss in vacuum, by the tosses in its tile [s]."""
    parts: dict[str, float]
    """Of the whole map in vacuum, by what is done; of the tosses, each core's share [s]."""
    tosses: int
    """In that map."""


def compute(progress: Progress, side: int = SIDE, mujoco_side: int = MUJOCO_SIDE) -> MapCosts:
    """Measure on maps of a thin coin on a smooth floor.

    Args:
        progress: called after each of the measurements.
        side: pixels along a side of the map that is made whole, and of the largest tile.
        mujoco_side: of MuJoCo's map.
    """
    cores = cores_used()
    kinds = {
        "planar thin coin": sweep_of(side),
        "planar thin coin in air": sweep_of(side, normal=0.8, tangential=0.2),
        "planar coin 2 mm thick": sweep_of(side, thickness=2e-3),
        "planar thin coin, each on its own floor": sweep_of(side // 3, axes=FLOOR),
        "planar thin coin by MuJoCo": sweep_of(mujoco_side, engine=Engine.MUJOCO),
    }
    whole = len(kinds) + len(TILE_SIDES) + 1
    toss: dict[str, float] = {}
    for name, sweep in kinds.items():
        numbers = np.arange(sweep.y.count * sweep.x.count).reshape(sweep.shape)
        toss_part(sweep, numbers[0, :1])  # loads the engine
        toss[name] = _cost(sweep, [numbers[::3, ::3].ravel()])
        progress(len(toss), whole)
    tile = {}
    for tile_side in TILE_SIDES:
        cut = tiles((TILED_SIDE, TILED_SIDE), (tile_side, tile_side))
        parts = (numbers_in(part, (TILED_SIDE, TILED_SIDE)).ravel() for part in cut)
        tile[tile_side**2] = _cost(sweep_of(TILED_SIDE), parts)
        progress(len(toss) + len(tile), whole)
    steps = _steps(kinds["planar thin coin"], cores)
    progress(whole, whole)
    return MapCosts(cores=cores, toss=toss, tile=tile, parts=steps, tosses=side * side)


def sweep_of(
    side: int,
    *,
    thickness: float = 0.0,
    normal: float = 0.0,
    tangential: float = 0.0,
    engine: Engine = Engine.ANALYTIC,
    axes: tuple[str, str] = RELEASE,
) -> Sweep:
    """Return the sweep of a coin, by default over spin and height."""
    text = COIN.format(thickness=thickness, normal=normal, tangential=tangential)
    scenario = parse(text, "coin")
    x, y = (parse_axis(axis.format(side), scenario) for axis in axes)
    return Sweep(scenario=scenario, engine=engine, x=x, y=y, settings=engine.package.MANY)


def _cost(sweep: Sweep, parts: Iterable[sweep_run.Numbers]) -> float:
    """Return the time of a toss, made in such parts [s]."""
    start = process_time()
    count = sum(toss_part(sweep, part)["outcome"].size for part in parts)
    return (process_time() - start) / count


def _steps(sweep: Sweep, cores: int) -> dict[str, float]:
    """Make a map as `cointoss basin` does, and give how long each step takes [s]."""
    text = COIN.format(thickness=0, normal=0, tangential=0)
    tossing = 0.0

    def tosser(parts: Iterable[sweep_run.Numbers]) -> Iterator[tuple[sweep_run.Numbers, Layers]]:
        nonlocal tossing
        for numbers in parts:
            start = process_time()
            layers = toss_part(sweep, numbers)
            tossing += process_time() - start
            yield numbers, layers

    marks = [process_time()]
    check(sweep)
    marks.append(process_time())
    with (
        tempfile.TemporaryDirectory() as folder,
        opened(Path(folder) / "map.zarr", layout_of_map(sweep, text), overwrite=False) as map_,
    ):
        marks.append(process_time())
        sweep_run.fill(map_, tosser)
        marks.append(process_time())
        sweep_run.fractions_of(map_)
        marks.append(process_time())
    checking, opening, filling, counting = np.diff(marks).tolist()
    return {
        "check the grid": checking,
        "make the store": opening,
        TOSS: tossing / cores,
        "write the tiles": filling - tossing,
        "count the outcomes": counting,
    }


def measures(costs: MapCosts) -> dict[str, Any]:
    """Return what the claim names."""
    return {"tosses": costs.tosses, "share": costs.parts[TOSS] / sum(costs.parts.values())}


def tables(costs: MapCosts) -> str:
    """Return the tables, in Markdown."""
    whole = sum(costs.parts.values())
    toss = [
        [name, f"{1e3 * cost:.3g}", f"{float(f'{1 / cost:.3g}'):,g}"] for name, cost in costs.toss.items()
    ]
    tile = [[str(count), f"{1e3 * cost:.3g}"] for count, cost in costs.tile.items()]
    parts = [
        [name, f"{seconds:.3g}", f"{100 * seconds / whole:.2g}"] for name, seconds in costs.parts.items()
    ]
    return paragraphs(
        table("toss | on one core [ms] | tosses/s on one core", toss),
        table("tosses in a tile | of a toss, planar thin coin, on one core [ms]", tile),
        table(f"a map of {costs.tosses} tosses on {costs.cores} cores | [s] | [%]", parts),
        map_times(costs.toss),
    )


REPRODUCTION = study(__name__, compute, record=MapCosts, measures=measures, tables=tables, draw={})
