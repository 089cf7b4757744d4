"""The lab served to this machine: its page, its map on all cores or on a card, and tosses by MuJoCo."""

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from cointoss.compare.engines import Engine, EngineSettings
from cointoss.compare.lab.lab import SERVED_POLICY, lab_page
from cointoss.compare.lab.saved import MOST_SHOWN, made_by, saved_map, scenario_of
from cointoss.compare.lab.tosses import toss_by_mujoco
from cointoss.compare.sweep.axes import NUMBERS, Axis, unit_of
from cointoss.compare.sweep.basin import MOST_AFTER
from cointoss.compare.sweep.batch import Batch
from cointoss.compare.sweep.errors import MapError, SweepError
from cointoss.compare.sweep.layout import trust_layer
from cointoss.compare.sweep.maps import asked
from cointoss.compare.sweep.pieces import How, pieces, require_supported
from cointoss.compare.sweep.reading import read_map
from cointoss.compare.web.server import PageServer, query_of
from cointoss.models.answers import NOT_TOSSED
from cointoss.models.batch import scenario_of_row
from cointoss.models.devices import Device
from cointoss.models.fields import FIELDS
from cointoss.models.kernel.arrays import Array
from cointoss.models.processor import Processor
from cointoss.models.rows import row_of
from cointoss.models.scenario import Scenario

MOST_PIXELS = 4096
"""The most pixels along each axis of the map."""


def _numbers(count: int) -> tuple[str, str]:
    """Return the form of some doubles, as their octets in hexadecimal."""
    return f"[0-9a-f]{{{16 * count}}}", f"{count} numbers of 16 hexadecimal digits"


_FIELD = "|".join(map(re.escape, NUMBERS)), "a field of a scenario that is a number"
_COUNT = "[0-9]{1,4}", f"a whole number from 2 to {MOST_PIXELS}"
MAP = {
    "numbers": _numbers(len(FIELDS) + 4),
    "x": _FIELD,
    "y": _FIELD,
    "columns": _COUNT,
    "rows": _COUNT,
    "after": ("final|[0-9]{1,6}", f"final, or a whole number from 0 to {MOST_AFTER}"),
    "trust": ("[01]", "0 or 1"),
}
"""What a query for a map says: the numbers of the scenario's row and of both axes' ends; the fields and
counts of the axes; the impacts before the touch that is mapped, or "final"; and whether trust is found."""
TOSS = {"numbers": _numbers(len(FIELDS))}
"""What a query for a toss says: the numbers of the scenario's row."""


class ServedLab(PageServer):
    """Serves the lab on this machine until it is closed."""

    refusals = (*PageServer.refusals, MapError, SweepError)

    def __init__(
        self, shown: Scenario | Path, port: int, device: Device = Device.CPU, *, is_tour: bool = False
    ) -> None:
        """Listen.

        Args:
            shown: the scenario with which the page begins, or the path of a map that it opens.
            port: 0 for a free one.
            device: that tosses the map.
            is_tour: whether it begins with its tour instead.

        Raises:
            MapError, ScenarioError: for what is no map.
            UnusableEngineError: where the engine for a browser was not built.
            UnsupportedError, DeviceError: for a device that can't be used, or not for such a scenario.
            UnwritableError: for a port that can't be had.
        """
        answers, engine, settings = {"/map": self._map}, Engine.ANALYTIC, Engine.ANALYTIC.package.MANY
        if isinstance(shown, Path):
            self.path, found = shown, read_map(shown, most=MOST_SHOWN)
            answers |= {"/saved": self._saved, "/toss": self._toss}
            scenario, (engine, settings, self.contact) = scenario_of(found), made_by(found)
        else:
            scenario = shown
        self.device, self.engine, self.settings = device, engine, settings
        engine.package.require_rows(row_of(scenario)[np.newaxis], settings=settings, device=Processor(device))
        page = lab_page(scenario, is_tour=is_tour, is_served=True, saved="/saved" in answers)
        super().__init__(port, page, answers, SERVED_POLICY)

    def _map(self, query: str, require_client: Callable[[], None]) -> bytes:
        """Return the codes of a map and then whether each is trusted, a signed octet each, row by row."""
        batch, how = map_asked(query_of(query, MAP), self.engine, self.settings, self.device)
        how = replace(how, keeps=True)
        require_supported(batch, how)
        codes, trusted = np.full((2, len(batch)), NOT_TOSSED, dtype=np.int8)
        for numbers, found in pieces(batch, how):
            require_client()
            codes[numbers] = found["outcome"]
            if how.trust:
                trusted[numbers] = found[trust_layer(how.after)] > (how.after or 0)
        return codes.tobytes() + (trusted.tobytes() if how.trust else b"")

    def _saved(self, query: str, _: object) -> dict[str, Any]:
        """Return the map as far as it is made by now."""
        query_of(query, {})
        return saved_map(read_map(self.path, most=MOST_SHOWN), self.path.name)

    def _toss(self, query: str, _: object) -> dict[str, Any]:
        """Return the toss of a scenario by MuJoCo."""
        row = np.frombuffer(bytes.fromhex(query_of(query, TOSS)["numbers"]), "<f8")
        return toss_by_mujoco(scenario_of_row(row), self.contact)


def map_asked(
    words: Mapping[str, str], engine: Engine, settings: EngineSettings, device: Device
) -> tuple[Batch, How]:
    """Return the tosses of the map that a page asks for, and how they are tossed.

    Raises:
        SweepError, ScenarioError: naming what is wrong and what is accepted.
    """
    numbers = np.frombuffer(bytes.fromhex(words["numbers"]), "<f8")
    row, *ends = np.split(numbers, [len(FIELDS), len(FIELDS) + 2])
    scenario, counts = scenario_of_row(row), (int(words["columns"]), int(words["rows"]))
    x, y = (
        _axis(words[name], unit_of(words[name], scenario), span, count)
        for name, span, count in zip("xy", ends, counts, strict=True)
    )
    return asked(
        scenario,
        x,
        y,
        engine=engine,
        settings=settings,
        after=None if words["after"] == "final" else int(words["after"]),
        trust=words["trust"] == "1",
        device=device,
    )


def _axis(field: str, unit: str, span: Array, count: int) -> Axis:
    start, stop = span.tolist()
    if not (math.isfinite(stop - start) and 2 <= count <= MOST_PIXELS):
        raise SweepError(f"{field}: {count} from {start} to {stop}, accepted: finite numbers, {_COUNT[1]}")
    return Axis(field=field, unit=unit, start=start, stop=stop, count=count)
