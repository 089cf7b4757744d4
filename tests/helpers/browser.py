"""A headless Chromium, driven over its DevTools pipe."""

import json
import os
import select
import shutil
import subprocess
import time
from base64 import b64decode
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Self

from tests.helpers.processes import HANGS, started

OPTIONS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--remote-debugging-pipe",
)
# Chromium reads its orders from descriptor 3, and answers to 4.
LAUNCH = "import os, sys; r, w, *c = sys.argv[1:]; os.dup2(int(r), 3); os.dup2(int(w), 4); os.execv(c[0], c)"
READY = "document.body?.dataset.ready === 'true'"
"""A page of the lab says that it is ready."""


@contextmanager
def browser(profile: Path) -> Iterator["Browser"]:
    """Start Chromium with a profile of its own; `make test` installs it."""
    import fcntl  # other tests run on Windows too

    found = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    assert found, "the tests of the pages need Chromium; on Debian or Ubuntu: apt-get install chromium"
    orders, ordered = os.pipe()
    answered, answers = os.pipe()
    theirs = [fcntl.fcntl(each, fcntl.F_DUPFD, 10) for each in (orders, answers)]
    command = [found, *OPTIONS, f"--user-data-dir={profile}", "about:blank"]
    launch = ("-S", "-E", "-c", LAUNCH, *theirs, *command)
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with started(*launch, pass_fds=theirs, **quiet) as process:
        for each in (orders, answers, *theirs):
            os.close(each)
        try:
            yield Browser(ordered, answered)
        finally:
            os.close(ordered)  # its end ends the browser
            with suppress(subprocess.TimeoutExpired):
                process.wait(timeout=HANGS)
            os.close(answered)


class Browser:
    """Speaks the DevTools protocol over a pipe: messages of JSON, each ended by a zero byte."""

    def __init__(self, ordered: int, answered: int) -> None:
        self._ordered, self._answered = ordered, answered
        self._number, self._read = 0, b""
        self.events: list[dict[str, Any]] = []

    def call(self, method: str, session: str | None = None, **arguments: Any) -> dict[str, Any]:
        """Return the result of a method."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": arguments}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self._ordered, data) :]
        while True:
            answer = self._next()
            if answer.get("id") == self._number:
                assert "error" not in answer, (method, answer["error"])
                return answer["result"]
            self.events.append(answer)

    def _next(self) -> dict[str, Any]:
        deadline = time.monotonic() + HANGS
        while b"\0" not in self._read:
            assert select.select([self._answered], [], [], max(deadline - time.monotonic(), 0))[0], (
                "no answer"
            )
            part = os.read(self._answered, 1 << 20)
            assert part, "Chromium has ended"
            self._read += part
        message, _, self._read = self._read.partition(b"\0")
        return json.loads(message)


class Page:
    """A tab."""

    def __init__(self, browser: Browser) -> None:
        self._browser = browser
        self._target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        attached = browser.call("Target.attachToTarget", targetId=self._target, flatten=True)
        self._listen(attached["sessionId"])

    def _listen(self, session: str) -> None:
        self._session = session
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._browser.call("Target.closeTarget", targetId=self._target)

    def call(self, method: str, **arguments: Any) -> dict[str, Any]:
        """Return the result of a method of this tab."""
        return self._browser.call(method, self._session, **arguments)

    def open(
        self,
        url: str,
        *,
        width: int = 1280,
        height: int = 900,
        scheme: str = "light",
        moving: bool = False,
        ready: str = READY,
    ) -> None:
        """Load an address in a window of a size, in light or dark, with motion or the least of it.

        It is loaded when the expression `ready` is true, by default when a page of the lab says so.
        """
        self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )
        self._prefer(scheme, moving)
        # A new fragment alone would not load the page again.
        self.call("Page.navigate", url="about:blank")
        self.call("Page.navigate", url=url)
        self.wait_for(ready)

    def _prefer(self, scheme: str, moving: bool) -> None:
        motion = "no-preference" if moving else "reduce"
        media = {"prefers-color-scheme": scheme, "prefers-reduced-motion": motion}
        features = [{"name": name, "value": value} for name, value in media.items()]
        self.call("Emulation.setEmulatedMedia", features=features)

    def open_frames(
        self, url: str, count: int, *, scheme: str = "light", moving: bool = False, **size: int
    ) -> list["Page"]:
        """Load an address; return the frames in it that have origins of their own, once they are ready."""
        self.call("Target.setAutoAttach", autoAttach=True, waitForDebuggerOnStart=True, flatten=True)
        loaded = "document.readyState !== 'loading' && location.protocol !== 'about:'"
        self.open(url, ready=loaded, scheme=scheme, moving=moving, **size)
        deadline = time.monotonic() + HANGS
        while len(found := self._told("Target.attachedToTarget")) < count:
            assert time.monotonic() < deadline, f"{len(found)} frames"
            self.value("1")
        sessions, frames = [each["sessionId"] for each in found], [Page.__new__(Page) for _ in found]
        for frame, session in zip(frames, sessions, strict=True):
            frame._browser = self._browser
            frame._listen(session)
            frame._prefer(scheme, moving)
            frame.call("Runtime.runIfWaitingForDebugger")
        for frame in frames:
            frame.wait_for(READY)
        return frames

    def _told(self, method: str) -> list[dict[str, Any]]:
        """Return what the events of this tab of a method say."""
        return [
            event["params"]
            for event in self._browser.events
            if event["method"] == method and event.get("sessionId") == self._session
        ]

    def value(self, expression: str) -> Any:
        """Return the value of an expression of JavaScript, a promise's when it is kept."""
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def wait_for(self, expression: str) -> None:
        """Wait until an expression is true."""
        deadline = time.monotonic() + HANGS
        while not self.value(expression):
            failed = time.monotonic() > deadline or any("SyntaxError" in one for one in self.complaints())
            assert not failed, f"never: {expression}; {self.complaints()}"
            time.sleep(0.05)

    def text(self, id_: str) -> str:
        """Return the text of an element."""
        return self.value(f"document.getElementById({json.dumps(id_)}).textContent")

    def press(self, key: str, *, shift: bool = False) -> None:
        """Press a key."""
        shown = {"text": key} if len(key) == 1 else {}
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, modifiers=8 * shift, **shown)

    def mouse(self, kind: str, x: float, y: float, **more: Any) -> None:
        """Move the mouse, press or release its button, or turn its wheel."""
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, x: float, y: float) -> None:
        """Click at a place."""
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", buttons=1, clickCount=1)

    def complaints(self) -> list[str]:
        """Return what the browser has complained of in this tab: errors and warnings."""
        thrown = [told["exceptionDetails"] for told in self._told("Runtime.exceptionThrown")]
        found = [details.get("exception", {}).get("description", details["text"]) for details in thrown]
        entries = [told["entry"] for told in self._told("Log.entryAdded")]
        found += [entry["text"] for entry in entries if entry["level"] in ("error", "warning")]
        for told in self._told("Runtime.consoleAPICalled"):
            if told["type"] in ("error", "warning"):
                found.append(
                    " ".join(str(part.get("value", part.get("description"))) for part in told["args"])
                )
        # Of the software renderer, where a picture is taken.
        return [text for text in found if "GL Driver Message" not in text]

    def asked(self) -> list[str]:
        """Return the addresses that this tab has asked the network for."""
        return [told["request"]["url"] for told in self._told("Network.requestWillBeSent")]

    def screenshot(self, path: Path, *, whole: bool = False) -> None:
        """Write a picture of the window, or of the whole page."""
        shot = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        path.write_bytes(b64decode(shot["data"]))
