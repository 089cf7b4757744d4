"""The HTTP server of a page: its files, and answers to what it asks, for this machine alone."""

import errno
import json
import sys
import threading
from collections.abc import Callable, Mapping
from http.server import BaseHTTPRequestHandler
from io import BytesIO
from pathlib import Path
from socketserver import ThreadingTCPServer
from typing import Any

from cointoss.compare.output.files import UnwritableError
from cointoss.compare.web.query import QueryError
from cointoss.compare.web.turns import Client, in_turn
from cointoss.models.devices import DeviceError
from cointoss.models.errors import ScenarioError
from cointoss.models.records import UnsupportedError

ADDRESS = "127.0.0.1"
LONGEST_TARGET = 1500
"""The longest target of a request, in characters: the query for a map of the lab holds a scenario of 54
numbers."""
_KINDS = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
}

Answer = Callable[[str, Client], Any]
"""Returns what a query asks for, bytes or what JSON has; the client may go meanwhile."""


class PageServer(ThreadingTCPServer):
    """Serves a page on this machine until it is closed."""

    daemon_threads = True
    allow_reuse_address = True
    request_queue_size = 64
    refusals: tuple[type[Exception], ...] = (QueryError, ScenarioError, UnsupportedError)
    """What an answer raises for a request that can't be answered."""

    def __init__(
        self, port: int, files: Mapping[str, bytes], answers: Mapping[str, Answer], policy: str
    ) -> None:
        """Listen.

        Args:
            port: 0 for a free one.
            files: of the page, by their names.
            answers: by the path that is asked for, such as "/map"; one at a time is made of each.
            policy: the page's Content-Security-Policy.

        Raises:
            UnwritableError: for a port that can't be had.
        """
        self.files = {f"/{name}": content for name, content in files.items()}
        self.answers, self.turns = dict(answers), {path: threading.Lock() for path in answers}
        more = "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        self.headers = {"Content-Security-Policy": f"{policy}; {more}", **_HEADERS}
        try:
            super().__init__((ADDRESS, port), PageRequest)
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


class PageRequest(BaseHTTPRequestHandler):
    """One request."""

    server: PageServer  # pyright: ignore[reportIncompatibleVariableOverride]
    server_version, sys_version = "cointoss", ""
    timeout = 30
    """The longest that a client may take to send its request [s]."""

    def setup(self) -> None:
        """Know the client."""
        super().setup()
        self._client = Client(self.connection, self.protocol_version.encode())

    def parse_request(self) -> bool:
        """Return whether the request can be answered; if not, refuse it here."""
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
        name = "/index.html" if path == "/" else path
        try:
            if path in self.server.answers:
                with in_turn(self.server.turns[path], self._client):
                    answer = self.server.answers[path](query, self._client)
                body = answer if isinstance(answer, bytes) else json.dumps(answer, allow_nan=False).encode()
                kind = "application/octet-stream" if isinstance(answer, bytes) else "application/json"
                self._send(200, kind, body)
            elif name in self.server.files and not mark:
                self._send(200, _KINDS.get(Path(name).suffix, "text/plain"), self.server.files[name])
            else:
                self._refuse(404, "accepted: /")
        except self.server.refusals as error:
            self._refuse(400, str(error))
        except DeviceError as error:
            self._refuse(503, str(error))

    def _refuse(self, status: int, message: str) -> None:
        self._send(status, "text/plain", f"{message}\n".encode())

    def _send(self, status: int, kind: str, body: bytes) -> None:
        self.close_connection = True
        self.send_response(status)
        for name, value in self.server.headers.items():
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
