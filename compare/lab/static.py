"""The lab's page of a map as one file, with the tosses of some pixels by MuJoCo; it needs no server."""

from html import escape
from pathlib import Path

import numpy as np
import xarray as xr

from cointoss.compare.lab.lab import lab_page
from cointoss.compare.lab.saved import made_by, saved_map, scenario_of
from cointoss.compare.lab.tosses import toss_by_mujoco
from cointoss.compare.output.files import write_text
from cointoss.compare.sweep.maps import name_of, thinned
from cointoss.compare.sweep.reading import read_map
from cointoss.models.notebook import Frame
from cointoss.models.stages import counted

MOST_BYTES = 10_000_000
"""The largest size of the file."""
MOST_PIXELS = 200_000
"""The most pixels of the map in it."""
TOSSED = 12, 9
"""Columns and rows of the pixels that MuJoCo tosses, at most."""
TOSSED_IN_FRAME = 8, 6
"""The most columns and rows in a notebook, whose user waits for the tosses and saves them with the
notebook."""
SAMPLES = 300
"""Samples of the path of each toss."""
TITLE = "<title>Is a coin toss random? The coin lab"
"""The lab's; a map's page has its own before any script runs, too."""


def write_static(path: Path, out: Path) -> None:
    """Write a page with a map, that tosses any pixel, and with the tosses of a grid of its pixels by MuJoCo.

    Raises:
        MapError, ScenarioError: for what is no map.
        UnusableEngineError: where the engine for a browser was not built.
        UnwritableError: naming the file and why.
    """
    write_text(out, _page(read_map(path, most=MOST_PIXELS), path.name, TOSSED))


def explore(found: xr.Dataset) -> Frame:
    """Return a frame with that page of a map, for a notebook.

    Raises:
        UnusableEngineError: where the engine for a browser was not built.
    """
    shown, name = thinned(found, MOST_PIXELS), name_of(found)
    return Frame(f"map of {saved_map(shown, name)['title']}", _page(shown, name, TOSSED_IN_FRAME))


def _page(found: xr.Dataset, name: str, most: tuple[int, int]) -> str:
    """Return the page of a map, with at most `most` columns and rows of its pixels tossed by MuJoCo."""
    scenario, saved = scenario_of(found), saved_map(found, name)
    *_, contact = made_by(found)
    x, y = saved["axes"]
    grid = [_spread(axis["values"], count) for axis, count in zip((x, y), most, strict=True)]
    lab_page(scenario)  # an engine that is missing is told before all tosses
    tosses = [
        {
            "place": (u, v),
            "toss": toss_by_mujoco(
                scenario.replace(x["field"], u, y["field"], v),
                contact,
                samples=SAMPLES,
                most_symbols=SAMPLES // 4,
            ),
        }
        for u, v in counted("tossing by MuJoCo", "pixels", [(u, v) for v in grid[1] for u in grid[0]])
    ]
    return lab_page(scenario, saved=saved, tosses=tosses).replace(
        TITLE, f"<title>{escape(saved['title'])}: the coin lab", 1
    )


def _spread(values: list[float], most: int) -> list[float]:
    """Return at most `most` values of an axis, evenly spread, none of them twice."""
    number = min(len(values), most)
    return [values[int(at)] for at in (np.arange(number) + 0.5) * len(values) / number]
