"""A small map to explore, and its server."""

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cointoss.compare.explorer.server import Explorer
from tests.helpers import basin_runs
from tests.helpers.command_line import cointoss
from tests.helpers.processes import HANGS

SCENARIO = basin_runs.SCENARIO.replace("= 0\n", '= "2 mm"\n') + "[ending]\nmax_impacts = 4\n"
FIELDS = "release.angular_velocity.eta", "release.position.z"


def small_map(folder: Path, *more: str, size: tuple[int, int] = (24, 18), text: str = SCENARIO) -> Path:
    """Make a map in a folder, with more options and of another scenario where they are given."""
    (folder / "coin.toml").write_text(text)
    axes = ("--x", f"{FIELDS[0]}=20:60:{size[0]}", "--y", f"{FIELDS[1]}=0.2:0.6:{size[1]}")
    options = (*axes, "--after", "1", *more, "--out", folder / "map.zarr")
    made = cointoss("basin", folder / "coin.toml", *options)
    assert made.exit_code == 0, made.stderr
    return folder / "map.zarr"


@contextmanager
def serving(path: Path) -> Iterator[Explorer]:
    """Serve a map until the `with` statement ends."""
    with Explorer(path, 0) as explorer:
        thread = threading.Thread(target=explorer.serve_forever, args=(0.05,))
        thread.start()
        try:
            yield explorer
        finally:
            explorer.shutdown()
            thread.join()


def sent(port: int, request: bytes) -> tuple[int, dict[str, str], bytes]:
    """Send bytes to a server; return its answer's status, headers and body."""
    with socket.create_connection(("127.0.0.1", port), timeout=HANGS) as connection:
        connection.sendall(request)
        connection.shutdown(socket.SHUT_WR)
        answer = b"".join(iter(lambda: connection.recv(1 << 16), b""))
    head, _, body = answer.partition(b"\r\n\r\n")
    first, *lines = head.decode("latin-1").split("\r\n")
    headers = {name.lower(): value for name, value in (line.split(": ", 1) for line in lines)}
    return int(first.split()[1]), headers, body


def got(port: int, target: str, *more: str, method: str = "GET", host: str | None = None):
    """Ask a server for a target; return its answer's status, headers and body."""
    lines = [f"{method} {target} HTTP/1.1", f"Host: {host or f'127.0.0.1:{port}'}", *more, "", ""]
    return sent(port, "\r\n".join(lines).encode("latin-1"))
