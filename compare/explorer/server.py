"""The explorer's HTTP server: one page, its files, and tosses, for this machine alone."""

import errno
import json
import re
import sys
import threading
from collections.abc import Callable, Sequence
from http.server import BaseHTTPRequestHandler
from io import BytesIO
from pathlib import Path
from socketserver import ThreadingTCPServer
from typing import Any
from urllib.parse import parse_qsl

from cointoss.compare.engines import Engine
from cointoss.compare.explorer.finer import toss_tile
from cointoss.compare.explorer.page_files import page_files
from cointoss.compare.explorer.page_map import MOST_SHOWN, page_map
from cointoss.compare.explorer.tosses import require_inside, toss_pixel
from cointoss.compare.explorer.turns import Client, in_turn
from cointoss.compare.output.files import UnwritableError
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.reading import tossed_map_at
from cointoss.models.errors import ScenarioError
from cointoss.models.records import UnsupportedError

ADDRESS = "127.0.0.1"
LONGEST_TARGET = 1000
"""The longest target of a request, in characters."""
_KINDS = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
_NUMBER = re.compile(r"[+-]?([0-9]{1,40}(\.[0-9]{0,40})?|\.[0-9]{1,40})([eE][+-]?[0-9]{1,3})?", re.ASCII)
_COUNT = re.compile(r"[0-9]{1,12}", re.ASCII)
_HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
}

Query = dict[str, str]


class Explorer(ThreadingTCPServer):
    """Serves a map on this machine until it is closed."""

    daemon_threads = True
    allow_reuse_address = True
    request_queue_size = 64

    def __init__(self, path: Path, port: int) -> None:
        """Listen.

        Args:
            path: of the map.
            port: 0 for a free one.

        Raises:
            MapError, ScenarioError: for what is no map.
            UnwritableError: for a port that can't be had.
        """
        self.path = path
        self.sweep = tossed_map_at(path, most=MOST_SHOWN).sweep
        self.files = {f"/{name}": content for name, content in page_files().items()}
        self.turns = {path: threading.Lock() for path in ("/map", "/toss", "/tile")}
        try:
            super().__init__((ADDRESS, port), Request)
        except OSError as error:
            why = "another program listens there" if error.errno == errno.EADDRINUSE else error.strerror
            accepted = "accepted: another port, or no `port` for one that is free"
            raise UnwritableError(f"`port` {port}: {why}; {accepted}") from None
        self.port: int = self.server_address[1]
        self.hosts = {f"{name}:{self.port}" for name in (ADDRESS, "localhost")}
        if self.port == 80:
            self.hosts |= {ADDRESS, "localhost"}

    @property
    def url(self) -> str:
        """Where the page is."""
        return f"http://{ADDRESS}:{self.port}/"

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Pass over a browser that has gone; report other errors."""
        if not isinstance(sys.exception(), OSError):
            super().handle_error(request, client_address)


class Request(BaseHTTPRequestHandler):
    """One request."""

    server: Explorer  # pyright: ignore[reportIncompatibleVariableOverride]
    server_version, sys_version = "cointoss", ""
    timeout = 30
    """The longest that a client may take to send its request [s]."""

    def setup(self) -> None:
        """Know the client."""
        super().setup()
        self._client = Client(self.connection, self.protocol_version.encode())

    def parse_request(self) -> bool:
        """Return whether the request is one to be answered; what is not is refused here."""
        if not super().parse_request():
            return False
        if self.command != "GET":
            self._refuse(405, f"{self.command[:20]}: accepted: GET")
        elif self.headers.get_all("Host", []) not in [[host] for host in self.server.hosts]:
            self._refuse(403, f"Host: accepted: {ADDRESS}:{self.server.port}")
        elif self.headers.get("Sec-Fetch-Site", "none") not in ("none", "same-origin"):
            self._refuse(403, "accepted: requests of this page alone")
        elif len(self.path) > LONGEST_TARGET:
            self._refuse(414, f"accepted: at most {LONGEST_TARGET} characters")
        else:
            return True
        return False

    def do_GET(self) -> None:
        """Answer."""
        path, mark, query = self.path.partition("?")
        answers: dict[str, Callable[[str], Any]] = {
            "/map": self._map,
            "/toss": self._toss,
            "/tile": self._tile,
        }
        name = "/index.html" if path == "/" else path
        try:
            if path in answers:
                with in_turn(self.server.turns[path], self._client):
                    answer = answers[path](query)
                body = answer if isinstance(answer, bytes) else json.dumps(answer, allow_nan=False).encode()
                kind = "application/octet-stream" if isinstance(answer, bytes) else "application/json"
                self._send(200, kind, body)
            elif name in self.server.files and not mark:
                self._send(200, _KINDS.get(Path(name).suffix, "text/plain"), self.server.files[name])
            else:
                self._refuse(404, "accepted: /")
        except (SweepError, ScenarioError, UnsupportedError) as error:
            self._refuse(400, str(error))

    def _map(self, query: str) -> Any:
        _query(query)
        return page_map(tossed_map_at(self.server.path, most=MOST_SHOWN))

    def _toss(self, query: str) -> Any:
        given = _query(query, "x", "y", also="engine")
        x, y = map(float, _read(given, ("x", "y"), _NUMBER, "a number"))
        require_inside(self.server.sweep, x, y)
        chosen = given.get("engine")
        if chosen is not None and chosen not in list(Engine):
            raise SweepError(f"engine: accepted: {' or '.join(Engine)}")
        engines = list(Engine) if chosen is None else [Engine(chosen)]
        return [toss_pixel(self.server.sweep, x, y, engine) for engine in engines]

    def _tile(self, query: str) -> bytes:
        names = ("level", "column", "row")
        level, column, row = map(int, _read(_query(query, *names), names, _COUNT, "a whole number"))
        return toss_tile(self.server.sweep, level, column, row).tobytes()

    def _refuse(self, status: int, message: str) -> None:
        self._send(status, "text/plain", f"{message}\n".encode())

    def _send(self, status: int, kind: str, body: bytes) -> None:
        self.close_connection = True
        self.send_response(status)
        for name, value in _HEADERS.items():
            self.send_header(name, value)
        if status == 405:
            self.send_header("Allow", "GET")
        self.send_header("Content-Type", f"{kind}; charset=utf-8" if kind.startswith("text/") else kind)
        self.send_header("Content-Length", str(len(body)))
        to_client, self.wfile = self.wfile, BytesIO()
        self.end_headers()
        head, self.wfile = self.wfile.getvalue(), to_client
        self.wfile.write(self._client.left_of(head) + body)

    def send_error(self, code: int, *_: object, **__: object) -> None:
        """Refuse what is no HTTP, in one line."""
        self._refuse(int(code), "accepted: a GET request")

    def log_message(self, *_: object, **__: object) -> None:
        """Log nothing: the terminal is the user's."""


def _query(text: str, *names: str, also: str = "") -> Query:
    """Return what a query says, which has each of these names once, and perhaps one more."""
    try:
        pairs = parse_qsl(text, keep_blank_values=True, strict_parsing=bool(text), max_num_fields=8)
    except ValueError:
        raise SweepError("accepted: NAME=VALUE&NAME=VALUE") from None
    query = dict(pairs)
    if len(query) < len(pairs):
        raise SweepError("accepted: each name once")
    if not set(names) <= set(query) <= {*names, also}:
        raise SweepError(f"accepted: {', '.join(names) or 'no query'}")
    return query


def _read(query: Query, names: Sequence[str], form: re.Pattern[str], accepted: str) -> list[str]:
    for name in names:
        if not form.fullmatch(query[name]):
            raise SweepError(f"{name}: accepted: {accepted}")
    return [query[name] for name in names]
