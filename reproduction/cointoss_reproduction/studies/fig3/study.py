"""Fig. 3: coins dropped from 186 cm flat and at 45 degrees keep their attitude, if they are ideal."""

from typing import Any

import numpy as np
import pandas as pd

from cointoss import load
from cointoss.study import attitude_angle
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.both_engines import by_both, first_touch

DROPS = {
    "ideal, flat": "fig3_flat",
    "ideal, at 45°": "fig3_tilted",
    "imperfect, flat": "fig3_flat_imperfect",
    "imperfect, at 45°": "fig3_tilted_imperfect",
}
KNOWN = {"missing": "", "expected": True}
UNKNOWN = {
    "missing": "the text does not say where the mass centre of the dropped coin is, and the photographs were "
    "not seen",
    "expected": None,
}
"""What the text leaves unknown about an imperfect coin."""


def fall(drop: str) -> pd.DataFrame:
    """Return how far a coin has turned from its release until it lands, by both engines [degrees]."""
    tosses = by_both(load(drop))
    t = np.linspace(0, first_touch(tosses), 101)
    turned = {
        engine: np.degrees(attitude_angle(toss.sample(t), toss.sample(0 * t)))
        for engine, toss in tosses.items()
    }
    return pd.DataFrame({"time": t, **turned}).melt("time", var_name="engine", value_name="turned")


def _found(cells: pd.DataFrame) -> dict[str, Any]:
    return {
        "drops": {
            name: {
                "turned": of.groupby("engine")["turned"].max(),
                "time": of["time"].max(),
                **(KNOWN if str(name).startswith("ideal") else UNKNOWN),
            }
            for name, of in cells.groupby("drop", sort=False)
        }
    }


REPRODUCTION = study(__name__, Cells(fall, {"drop": DROPS}), found=_found)
