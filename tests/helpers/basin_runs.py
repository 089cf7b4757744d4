"""Maps of a coin made in small tiles, here or in another process."""

from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from cointoss.compare.sweep.axes import parse_axis
from cointoss.compare.sweep.batch import Batch
from cointoss.compare.sweep.layout import Layout, layout_of
from cointoss.compare.sweep.maps import asked
from cointoss.compare.sweep.pieces import How
from cointoss.models.reading import parse
from cointoss.models.scenario import Scenario
from tests.helpers.command_line import cointoss
from tests.helpers.draws import AIR, scenario
from tests.helpers.processes import started, wait_until

SCENARIO = """
[coin]
mass = "2 g"
radius = "1.25 cm"
thickness = 0
[floor]
restitution = 0.6
contact = "smooth"
[release]
position = [0, 0, 0.4]
"""
TUMBLING = scenario(
    coin={"center_of_mass": [1e-4, 0, 0]},
    air=AIR,
    floor={"restitution": 0.4},
    release={"angles": [0.1, 0.2, 0.3], "angular_velocity": [1.0, 30.0, 2.0]},
    ending={"max_impacts": 12},
)
"""A coin that tumbles through air, for twelve impacts."""
AXES = ("--x", "release.angular_velocity.eta=20:60:48", "--y", "release.position.z=0.2:0.6:40")
SMALL, TILES = 48, 40
"""Tosses in a tile of these tests, and tiles in a map."""
basin = partial(cointoss, "basin")


def map_asked(x: str, y: str, case: Scenario | str = SCENARIO, **extra: Any) -> tuple[Batch, How]:
    """Return the tosses of a map over two axes of a scenario or of its text, and how they are tossed."""
    case = parse(case, "coin") if isinstance(case, str) else case
    return asked(case, parse_axis(x, case), parse_axis(y, case), **extra)


def map_layout(x: str, y: str, case: str = SCENARIO, *, name: str = "", **extra: Any) -> Layout:
    """Return the layout of such a map."""
    return layout_of(*map_asked(x, y, case, **extra), name=name, scenario_text=case)


def pixels(path):
    with xr.open_dataset(path, engine="zarr") as found:
        return {name: found[name].to_numpy() for name in ("outcome", "impacts")}


def assert_same(path, expected):
    found = pixels(path)
    for name, array in expected.items():
        assert found[name].dtype == array.dtype
        assert np.array_equal(found[name], array)


def whole_tiles(path):
    """Count the tiles of whose two parts the second is there; a renamed file is whole."""
    return len([entry for entry in path.glob("outcome/c/*/*") if entry.suffix == ""])


def begun(coin, out, *extra, most=TILES):
    """Start a process, for a `with` statement, that makes the map in small tiles until `most` are there."""
    script = (
        "import threading, time; from pathlib import Path; from cointoss.compare.engines import Engine\n"
        "from cointoss.compare.sweep import layout, pieces\n"
        f"layout.TILE_TOSSES[Engine.ANALYTIC], known = {SMALL}, pieces.columns_of\n"
        "def columns_of(*tossed):\n"
        f"    made = [entry for entry in Path({str(out)!r}).glob('outcome/c/*/*') if not entry.suffix]\n"
        f"    threading.Event().wait(None if len(made) >= {most} else 0.05)\n"
        "    return known(*tossed)\n"
        "pieces.columns_of = columns_of\n"
        "from cointoss.compare.cli import main; main()"
    )
    return started("-c", script, "basin", coin, *AXES, "--out", out, *extra)


def wait_for(process, out, count):
    wait_until(process, lambda: whole_tiles(out) >= count)
