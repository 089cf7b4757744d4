"""A map that was made, as the lab's page shows it."""

import json
from base64 import b64encode
from typing import TYPE_CHECKING, Any

from cointoss.compare.engines import Engine, EngineSettings
from cointoss.compare.sweep.maps import field_along, outcomes_in, settings_of
from cointoss.compare.sweep.words import in_codes
from cointoss.models.reading import parse
from cointoss.models.scenario import Scenario
from cointoss.models.title import title_of_toss
from cointoss.models.units import printed_unit

if TYPE_CHECKING:
    import xarray as xr

MOST_SHOWN = 4_000_000
"""Pixels on the page: of a larger map every second, third, ..."""
MOST_IMPACTS = 20_000
"""The page follows a toss up to this number of impacts."""
_KINDS = {
    "outcome": "<i1",
    "impacts": "<i4",
    "margin": "<f4",
    "trusted_impacts": "<i4",
    "outcome_certain": "<i1",
}


def scenario_of(found: "xr.Dataset") -> Scenario:
    """Return the scenario of a map, as the page tosses it."""
    scenario = parse(found.attrs["scenario"], "attribute scenario")
    return scenario.replace("ending.max_impacts", min(MOST_IMPACTS, scenario.rules.max_impacts))


def made_by(found: "xr.Dataset") -> tuple[Engine, EngineSettings, str | None]:
    """Return the engine that made a map, its settings, and the contact among them that MuJoCo's have."""
    engine, given = Engine(found.attrs["engine"]), json.loads(found.attrs["engine_settings"])
    return engine, settings_of(engine, given), given["contact"] if engine == Engine.MUJOCO else None


def saved_map(found: "xr.Dataset", name: str) -> dict[str, Any]:
    """Return a map as JSON, both axes upwards; arrays row by row in base64, little-endian.

    Args:
        found: as of `cointoss.read_map`.
        name: of its folder.

    Raises:
        ValueError: for an outcome's code that is none.
    """
    about, fields = found.attrs, [field_along(found, dim) for dim in ("x", "y")]
    coded = in_codes(found).assign(outcome=(found["outcome"].dims, outcomes_in(found))).sortby(fields)
    return {
        "name": name,
        "title": title_of_toss(scenario_of(found), about["name"], varied=fields),
        "engine": about["engine"],
        "after": None if about["after"] == "" else int(about["after"]),
        "stride": int(about["stride"]),
        "axes": [_axis(coded[field]) for field in fields],
        "margin": [about["margin_along"], coded["margin"].attrs["units"]] if "margin" in coded else None,
        "arrays": {
            layer: b64encode(coded[layer].values.astype(kind).tobytes()).decode("ascii")
            for layer, kind in _KINDS.items()
            if layer in coded
        },
    }


def _axis(coordinate: "xr.DataArray") -> dict[str, Any]:
    word, unit = coordinate.attrs["long_name"], printed_unit(coordinate.attrs["units"])
    values = coordinate.values.astype(int if coordinate.name == "ending.max_impacts" else float).tolist()
    return {"field": coordinate.name, "word": word, "unit": unit, "values": values}
