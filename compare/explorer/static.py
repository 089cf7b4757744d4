"""The explorer as one file: the page, its map, and the tosses of some pixels; it needs no server."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cointoss.compare.engines import Engine
from cointoss.compare.explorer.page_files import page_files
from cointoss.compare.explorer.page_map import page_map
from cointoss.compare.explorer.tosses import MOST_IMPACTS, toss_pixel
from cointoss.compare.output.files import write_text
from cointoss.compare.sweep.maps import asked_of, axes_of, name_of, thinned, title_of
from cointoss.compare.sweep.reading import map_at
from cointoss.compare.web.scripts import ENGINE_POLICY, POLICY, one_file
from cointoss.compare.web.wasm.carried import engine_data
from cointoss.models.fields import FIELDS
from cointoss.models.notebook import Frame
from cointoss.models.stages import counted

if TYPE_CHECKING:
    import xarray as xr

MOST_BYTES = 10_000_000
"""The largest size of the file."""
MOST_PIXELS = 200_000
"""The most pixels of the map in it."""
TOSSED = 12, 9
"""Columns and rows of the pixels that are tossed, at most."""
TOSSED_IN_FRAME = 8, 6
"""The most columns and rows in a notebook, whose user waits for the tosses and saves them with the
notebook."""
SAMPLES = 300
"""Samples of the path of each toss."""
HEIGHT = 860
"""Height of its frame in a notebook [px]."""


def write_static(map_path: Path, out: Path) -> None:
    """Write a page with a map and the tosses of a grid of its pixels, by both engines.

    Where the package carries the engine for a browser, and that engine can toss such a map, the page itself
    tosses any other pixel.

    Raises:
        MapError, ScenarioError: for what is no map.
        UnwritableError: naming the file and why.
    """
    write_text(out, _page(map_at(map_path, most=MOST_PIXELS), map_path.name, TOSSED))


def explore(found: "xr.Dataset") -> Frame:
    """Return a frame with that page of a map, for a notebook."""
    page = _page(thinned(found, MOST_PIXELS), name_of(found), TOSSED_IN_FRAME)
    return Frame(f"map of {title_of(found)}", page, HEIGHT)


def _page(shown: "xr.Dataset", name: str, tossed: tuple[int, int]) -> str:
    """Return the page of a map, with at most `most` columns and rows of its pixels tossed."""
    held: dict[str, Any] = {"map": page_map(shown, name), "engine": _engine(shown), "tosses": {}}
    y, x = (axis.values for axis in axes_of(shown))
    columns, rows = (_spread(len(one), most) for one, most in zip((x, y), tossed, strict=True))
    pixels = [(column, row) for row in rows for column in columns]
    for column, row in counted("tossing by both engines", "pixels", pixels):
        at = float(x[column]), float(y[row])
        held["tosses"][f"{column},{row}"] = [
            toss_pixel(shown, *at, engine, samples=SAMPLES, most_symbols=SAMPLES // 4) for engine in Engine
        ]
    policy = ENGINE_POLICY if held["engine"] else POLICY
    return one_file(page_files(), {**held, "columns": columns, "rows": rows}, policy)


def _engine(found: "xr.Dataset") -> dict[str, object] | None:
    """Return what the page needs to toss any pixel itself, or None where it cannot."""
    batch, _ = asked_of(found)
    if not {one.field for one in batch.varied} <= set(FIELDS):  # such as a spin, which the page does not know
        return None
    most, last = MOST_IMPACTS[Engine.ANALYTIC], batch.scenario.rules.max_impacts
    engine = engine_data(batch.scenario.replace("ending.max_impacts", min(most, last)))
    return engine and {**engine, "samples": SAMPLES, "most": most if most < last else None}


def _spread(count: int, most: int) -> list[int]:
    """Return the indices of at most `most` pixels of an axis, evenly spread, none of them twice."""
    number = min(count, most)
    return ((np.arange(number) + 0.5) * count / number).astype(int).tolist()
