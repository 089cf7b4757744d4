"""A headless Firefox, driven over Marionette: messages of JSON, each after its length and a colon."""

import json
import shutil
import socket
import subprocess
from base64 import b64decode
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from tests.helpers.processes import HANGS, wait_until


@contextmanager
def firefox(profile: Path) -> Iterator["Firefox"]:
    """Start Firefox with a profile of its own; `make docs` installs it."""
    found = shutil.which("firefox-esr") or shutil.which("firefox")
    assert found, "the tests of the site need Firefox; on Debian: apt-get install firefox-esr"
    (profile / "user.js").write_text('user_pref("marionette.port", 0);\n')
    words = [found, "--headless", "--no-remote", "--marionette", "--profile", str(profile)]
    quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with subprocess.Popen([*words, "--width=1280", "--height=900"], **quiet) as process:
        try:
            port = profile / "MarionetteActivePort"
            wait_until(process, lambda: port.is_file() and port.read_text())
            with socket.create_connection(("127.0.0.1", int(port.read_text())), HANGS) as link:
                yield Firefox(link)
        finally:
            process.terminate()
            with suppress(subprocess.TimeoutExpired):
                process.wait(timeout=HANGS)


class Firefox:
    """A tab."""

    def __init__(self, link: socket.socket) -> None:
        self._link, self._read, self._number = link, link.makefile("rb"), 0
        self._next()  # it says its name
        self.call("WebDriver:NewSession")

    def call(self, command: str, **given: Any) -> Any:
        """Return what a command answers."""
        self._number += 1
        message = json.dumps([0, self._number, command, given]).encode()
        self._link.sendall(b"%d:%s" % (len(message), message))
        _, _, error, answer = self._next()
        assert error is None, error
        return answer["value"] if set(answer) == {"value"} else answer

    def _next(self) -> Any:
        length = b""
        while (digit := self._read.read(1)) != b":":
            assert digit, "Firefox has ended"
            length += digit
        return json.loads(self._read.read(int(length)))

    def screenshot(self) -> bytes:
        """Return a picture of the window as PNG."""
        return b64decode(self.call("WebDriver:TakeScreenshot", full=False))
