"""The HTTP server of a page: the page, and answers to what it asks, for this machine alone."""

import errno
import json
import re
import select
import socket
import sys
import threading
from collections.abc import Callable, Mapping
from http.server import BaseHTTPRequestHandler
from socketserver import ThreadingTCPServer
from typing import Any
from urllib.parse import parse_qsl

from cointoss.compare.output.files import UnwritableError
from cointoss.models.devices import DeviceError
from cointoss.models.errors import ScenarioError
from cointoss.models.records import UnsupportedError

ADDRESS = "127.0.0.1"
LONGEST_TARGET = 1500
"""The longest target of a request, in characters: the query for a map of the lab holds a scenario of 54
numbers."""
_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
}

Answer = Callable[[str, Callable[[], None]], Any]
"""Returns what a query asks for, bytes or what JSON has; its second argument gives it up where the client has
hung up meanwhile."""


class QueryError(ValueError):
    """A query that can't be answered; the message says what is accepted."""


def query_of(text: str, forms: Mapping[str, tuple[str, str]]) -> dict[str, str]:
    """Return what a query says, which has each name once, and values of a form.

    Args:
        text: of the query.
        forms: the regular expression of each value and what it accepts in words, by name.

    Raises:
        QueryError: naming what is accepted.
    """
    try:
        pairs = parse_qsl(text, keep_blank_values=True, strict_parsing=bool(text), max_num_fields=8)
    except ValueError:
        raise QueryError("accepted: NAME=VALUE&NAME=VALUE") from None
    if sorted(name for name, _ in pairs) != sorted(forms):
        raise QueryError(f"accepted: {', '.join(forms) or 'no query'}, each name once")
    for name, value in pairs:
        if not re.fullmatch(forms[name][0], value, re.ASCII):
            raise QueryError(f"{name}: accepted: {forms[name][1]}")
    return dict(pairs)


class PageServer(ThreadingTCPServer):
    """Serves a page on this machine until it is closed."""

    daemon_threads = True
    allow_reuse_address = True
    request_queue_size = 64
    refusals: tuple[type[Exception], ...] = (QueryError, ScenarioError, UnsupportedError)
    """What an answer raises for a request that can't be answered."""

    def __init__(self, port: int, page: str, answers: Mapping[str, Answer], policy: str) -> None:
        """Listen.

        Args:
            port: 0 for a free one.
            page: its HTML, which needs no other file.
            answers: by the path that is asked for, such as "/map"; one at a time is made of each.
            policy: the page's Content-Security-Policy.

        Raises:
            UnwritableError: for a port that can't be had.
        """
        self.page, self.answers = page.encode(), dict(answers)
        self.turns = {path: threading.Lock() for path in answers}
        more = "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        self.headers = {"Content-Security-Policy": f"{policy}; {more}", **_HEADERS}
        try:
            super().__init__((ADDRESS, port), PageRequest)
        except OSError as error:
            why = "another program listens there" if error.errno == errno.EADDRINUSE else error.strerror
            accepted = "accepted: another port, or no `port` for one that is free"
            raise UnwritableError(f"`port` {port}: {why}; {accepted}") from None
        self.port: int = self.server_address[1]
        # Browsers leave out the port of HTTP.
        self.hosts = {f"{name}:{self.port}".removesuffix(":80") for name in (ADDRESS, "localhost")}

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
        path, _, query = self.path.partition("?")
        try:
            if path in self.server.answers:
                with self.server.turns[path]:
                    self._require_client()
                    answer = self.server.answers[path](query, self._require_client)
                if isinstance(answer, bytes):
                    self._send(200, "application/octet-stream", answer)
                else:
                    self._send(200, "application/json", json.dumps(answer, allow_nan=False).encode())
            elif self.path in ("/", "/index.html"):
                self._send(200, "text/html; charset=utf-8", self.server.page)
            else:
                self._refuse(404, "accepted: /")
        except self.server.refusals as error:
            self._refuse(400, str(error))
        except DeviceError as error:
            self._refuse(503, str(error))

    def _require_client(self) -> None:
        """Give up what is made for a client that has hung up.

        Raises:
            OSError: where it has.
        """
        if select.select([self.connection], [], [], 0)[0] and not self.connection.recv(1, socket.MSG_PEEK):
            raise ConnectionAbortedError("the client has hung up")

    def _refuse(self, status: int, message: str) -> None:
        self._send(status, "text/plain; charset=utf-8", f"{message}\n".encode())

    def _send(self, status: int, kind: str, body: bytes) -> None:
        self.close_connection = True
        self.send_response(status)
        about = {"Content-Type": kind, "Content-Length": str(len(body)), "Allow": "GET"}
        for name, value in (self.server.headers | about).items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def send_error(self, code: int, *_: object, **__: object) -> None:
        """Refuse what is no HTTP, in one line."""
        self._refuse(int(code), "accepted: a GET request")

    def log_message(self, *_: object, **__: object) -> None:
        """Log nothing: the terminal is the user's."""
