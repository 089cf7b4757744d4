"""The files of a run: claims, data, and pictures drawn from the data."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from PIL import Image

from cointoss.study import STYLE
from cointoss_reproduction.frame.claim import to_json
from cointoss_reproduction.frame.files import CLAIMS, TABLE
from cointoss_reproduction.frame.result import Result

_COLORS = 128


def save(folder: Path, result: Result, draw: Mapping[str, Callable[[Any], Figure]]) -> None:
    """Write the claims, the data and the pictures into a folder that exists."""
    (folder / CLAIMS).write_text(to_json(result.claims), encoding="utf-8")
    data = result.data
    if isinstance(data, pd.DataFrame):
        data.to_csv(folder / TABLE, index=False, lineterminator="\n")
    else:
        np.savez_compressed(folder / "data.npz", allow_pickle=False, **data)
    for name, picture in draw.items():
        path = folder / f"{name}.png"
        with mpl.rc_context(STYLE):
            picture(data).savefig(path, dpi=110)
        # A map's fine stripes would make a large file in full colour.
        with Image.open(path) as drawn:
            few = drawn.convert("RGB").quantize(_COLORS)
        few.save(path, optimize=True)
