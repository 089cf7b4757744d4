"""A small map to explore, and servers of pages."""

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cointoss.compare.lab.served import ServedLab
from cointoss.compare.web.server import PageServer
from tests.helpers import basin_runs
from tests.helpers.command_line import printed
from tests.helpers.processes import HANGS

SCENARIO = basin_runs.SCENARIO.replace("= 0\n", '= "2 mm"\n') + "[ending]\nmax_impacts = 4\n"
FIELDS = "release.angular_velocity.eta", "release.position.z"


def small_map(folder: Path, *more: str, size: tuple[int, int] = (24, 18), text: str = SCENARIO) -> Path:
    """Make a map in a folder, with more options and of another scenario where they are given."""
    (folder / "coin.toml").write_text(text)
    axes = ("--x", f"{FIELDS[0]}=20:60:{size[0]}", "--y", f"{FIELDS[1]}=0.2:0.6:{size[1]}")
    options = (*axes, "--after", "1", *more, "--out", folder / "map.zarr")
    printed("basin", folder / "coin.toml", *options)
    return folder / "map.zarr"


@contextmanager
def serving(shown: Path | PageServer) -> Iterator[PageServer]:
    """Serve a map, or another page, until the `with` statement ends."""
    with shown if isinstance(shown, PageServer) else ServedLab(shown, 0) as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.05,))
        thread.start()
        try:
            yield server
        finally:
            server.shutdown()
            thread.join()


def asked(port: int, target: str) -> socket.socket:
    """Return a connection on which a target was asked for."""
    connection = socket.create_connection(("127.0.0.1", port))
    connection.sendall(f"GET {target} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
    return connection


def sent(port: int, request: bytes) -> tuple[int, dict[str, str], bytes]:
    """Send bytes to a server; return its answer's status, headers and body."""
    with socket.create_connection(("127.0.0.1", port), timeout=HANGS) as connection:
        connection.sendall(request)
        answer = b"".join(iter(lambda: connection.recv(1 << 16), b""))
    head, _, body = answer.partition(b"\r\n\r\n")
    first, *lines = head.decode("latin-1").split("\r\n")
    headers = {name.lower(): value for name, value in (line.split(": ", 1) for line in lines)}
    return int(first.split()[1]), headers, body


def got(port: int, target: str, *more: str, method: str = "GET", host: str | None = None):
    """Ask a server for a target; return its answer's status, headers and body."""
    lines = [f"{method} {target} HTTP/1.1", f"Host: {host or f'127.0.0.1:{port}'}", *more, "", ""]
    return sent(port, "\r\n".join(lines).encode("latin-1"))
