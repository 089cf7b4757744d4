"""The lab served to this machine: its page, and its map, tossed on all cores or on a card."""

import math
import re
from dataclasses import replace

import numpy as np

from cointoss.compare.engines import Engine
from cointoss.compare.lab.lab import SERVED_POLICY, lab_page
from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.basin import MOST_AFTER
from cointoss.compare.sweep.batch import Batch
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.layout import trust_layer
from cointoss.compare.sweep.maps import asked
from cointoss.compare.sweep.pieces import How, pieces
from cointoss.compare.web.query import COUNT, Query, query_of, texts_in
from cointoss.compare.web.server import PageServer
from cointoss.compare.web.turns import Client
from cointoss.models.answers import NOT_TOSSED
from cointoss.models.batch import scenario_of_row
from cointoss.models.devices import Device
from cointoss.models.fields import FIELDS, UNITS
from cointoss.models.kernel.arrays import Array
from cointoss.models.processor import Processor
from cointoss.models.rows import row_of
from cointoss.models.scenario import Scenario

MOST_PIXELS = 4096
"""The most pixels along each axis of the map."""
NAMES = ("numbers", "x", "y", "columns", "rows", "after", "trust")
"""What a query for a map says: the numbers of the scenario's row and of both axes' ends, as the octets of
doubles in hexadecimal; the fields and counts of the axes; the impacts before the touch that is mapped, or
"final"; and whether trust is found, 1 or 0."""
_NUMBERS = re.compile(f"[0-9a-f]{{{16 * (len(FIELDS) + 4)}}}", re.ASCII)
_AFTER = re.compile("final|[0-9]{1,6}", re.ASCII)
_TRUST = re.compile("[01]", re.ASCII)


class ServedLab(PageServer):
    """Serves the lab on this machine until it is closed."""

    refusals = (*PageServer.refusals, SweepError)

    def __init__(self, scenario: Scenario, port: int, device: Device, *, is_tour: bool = False) -> None:
        """Listen.

        Args:
            scenario: with which the page begins.
            is_tour: whether it begins with its tour instead.
            port: 0 for a free one.
            device: that tosses the map.

        Raises:
            UnusableEngineError: where the engine for a browser was not built.
            UnsupportedError, DeviceError: for a device that can't be used, or not for such a scenario.
            UnwritableError: for a port that can't be had.
        """
        Engine.ANALYTIC.package.require_rows(row_of(scenario)[np.newaxis], device=Processor(device))
        self.device = device
        page = lab_page(scenario, is_tour=is_tour, is_served=True)
        super().__init__(port, {"index.html": page.encode()}, {"/map": self._map}, SERVED_POLICY)

    def _map(self, query: str, client: Client) -> bytes:
        """Return the codes of a map and then whether each is trusted, a signed octet each, row by row."""
        batch, how = map_asked(query_of(query, *NAMES), self.device)
        codes, trusted = np.full((2, len(batch)), NOT_TOSSED, dtype=np.int8)
        for numbers, found in pieces(batch, replace(how, keeps=True)):
            client.require_there()
            codes[numbers] = found["outcome"]
            if how.trust:
                trusted[numbers] = found[trust_layer(how.after)] > (how.after or 0)
        return codes.tobytes() + (trusted.tobytes() if how.trust else b"")


def map_asked(query: Query, device: Device) -> tuple[Batch, How]:
    """Return the tosses of the map that a page asks for, and how they are tossed.

    Raises:
        QueryError, SweepError, ScenarioError: naming what is wrong and what is accepted.
    """
    (text,) = texts_in(query, ["numbers"], _NUMBERS, f"{len(FIELDS) + 4} numbers of 16 hexadecimal digits")
    row, *ends = np.split(np.frombuffer(bytes.fromhex(text), "<f8"), [len(FIELDS), len(FIELDS) + 2])
    counts = map(int, texts_in(query, ["columns", "rows"], COUNT, f"a whole number from 2 to {MOST_PIXELS}"))
    (after,) = texts_in(query, ["after"], _AFTER, f"final, or a whole number from 0 to {MOST_AFTER}")
    (trust,) = texts_in(query, ["trust"], _TRUST, "0 or 1")
    x, y = (_axis(query[name], span, count) for name, span, count in zip("xy", ends, counts, strict=True))
    return asked(
        scenario_of_row(row),
        x,
        y,
        after=None if after == "final" else int(after),
        trust=trust == "1",
        device=device,
    )


def _axis(field: str, span: Array, count: int) -> Axis:
    start, stop = span.tolist()
    if field not in UNITS:
        raise SweepError("x, y: accepted: a field of a scenario that is a number")
    if not math.isfinite(stop - start):
        raise SweepError(f"{field}: from {start} to {stop}, accepted: finite numbers")
    if not 2 <= count <= MOST_PIXELS:
        raise SweepError(f"columns, rows: accepted: a whole number from 2 to {MOST_PIXELS}")
    return Axis(field=field, unit=UNITS[field], start=start, stop=stop, count=count)
