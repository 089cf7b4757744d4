"""The explorer's server: its page, a map, and its tosses."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from cointoss.compare.engines import Engine
from cointoss.compare.explorer.finer import toss_tile
from cointoss.compare.explorer.page_files import page_files
from cointoss.compare.explorer.page_map import MOST_SHOWN, page_map
from cointoss.compare.explorer.tosses import require_inside, toss_pixel
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.maps import asked_of
from cointoss.compare.sweep.pieces import require_supported
from cointoss.compare.sweep.reading import map_at
from cointoss.compare.web.query import COUNT, NUMBER, query_of, texts_in
from cointoss.compare.web.server import PageServer
from cointoss.compare.web.turns import Client
from cointoss.models.devices import Device
from cointoss.models.processor import Processor

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data: blob:"
)
"""The Content-Security-Policy of its page."""


class Explorer(PageServer):
    """Serves a map on this machine until it is closed."""

    refusals = (*PageServer.refusals, SweepError)

    def __init__(self, path: Path, port: int, device: Device = Device.CPU) -> None:
        """Listen.

        Args:
            path: of the map.
            port: 0 for a free one.
            device: that tosses the finer maps.

        Raises:
            MapError, ScenarioError: for what is no map.
            UnsupportedError, DeviceError: for a device that can't be used, or not for such a map.
            UnwritableError: for a port that can't be had.
        """
        self.path, self.device = path, device
        self.found = map_at(path, most=MOST_SHOWN)
        if device is not Device.CPU:
            batch, how = asked_of(self.found)
            require_supported(batch, replace(how, processor=Processor(device)))
        answers = {"/map": self._map, "/toss": self._toss, "/tile": self._tile}
        super().__init__(port, page_files(), answers, POLICY)

    def _map(self, query: str, _: Client) -> Any:
        query_of(query)
        return page_map(map_at(self.path, most=MOST_SHOWN), self.path.name)

    def _toss(self, query: str, _: Client) -> Any:
        given = query_of(query, "x", "y", also="engine")
        x, y = map(float, texts_in(given, ("x", "y"), NUMBER, "a number"))
        require_inside(self.found, x, y)
        chosen = given.get("engine")
        if chosen is not None and chosen not in list(Engine):
            raise SweepError(f"engine: accepted: {' or '.join(Engine)}")
        engines = list(Engine) if chosen is None else [Engine(chosen)]
        return [toss_pixel(self.found, x, y, engine) for engine in engines]

    def _tile(self, query: str, _: Client) -> bytes:
        names = ("level", "column", "row")
        level, column, row = map(int, texts_in(query_of(query, *names), names, COUNT, "a whole number"))
        return toss_tile(self.found, level, column, row, self.device).tobytes()
