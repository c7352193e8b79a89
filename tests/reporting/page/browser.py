"""A Chromium without a window, asked over a pipe (Chrome DevTools Protocol): it loads pages, presses keys, measures."""

import base64
import json
import os
import select
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
FOUND = next((found for name in NAMES if (found := shutil.which(name))), None)
SCRIPTS = Path(__file__).with_name("examine.js")
"""What is asked of each page: see there."""

# A child of this process has the pipe's ends as 3 and 4, where the browser looks for them.
LAUNCH = (
    "import os, sys; os.dup2(int(sys.argv[1]), 3); os.dup2(int(sys.argv[2]), 4); os.execv(sys.argv[3], sys.argv[3:])"
)

PATIENCE = 120.0
"""Seconds without an answer after which the browser counts as hung."""


class BrowserUnavailableError(Exception):
    """The browser does not start or does not answer."""


@dataclass
class Browser:
    """One page at a time; `errors`: what its console said, `requests`: what it asked for beside itself."""

    profile: Path
    errors: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def __enter__(self) -> "Browser":
        reads, self._to = os.pipe()
        self._from, writes = os.pipe()
        for end in (reads, writes):
            os.set_inheritable(end, True)
        self._process = subprocess.Popen(
            [sys.executable, "-c", LAUNCH, str(reads), str(writes), str(FOUND), "--headless=new", "--no-sandbox",
             "--disable-gpu", "--disable-dev-shm-usage", "--disable-background-networking", "--no-first-run",
             "--remote-debugging-pipe",
             f"--user-data-dir={self.profile}", "about:blank"],
            pass_fds=(reads, writes), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        os.close(reads)
        os.close(writes)
        self._buffer, self._count, self._session = b"", 0, None
        try:
            target = self._ask("Target.createTarget", url="about:blank")["targetId"]
            self._session = self._ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
            self._ask("Emulation.setScrollbarsHidden", hidden=True)
            for domain in ("Page", "Runtime", "Log", "Network"):
                self._ask(f"{domain}.enable")
        except BrowserUnavailableError:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        for end in (self._to, self._from):
            os.close(end)
        self._process.kill()
        self._process.wait()

    def load(self, file: Path) -> None:
        """A page, until it stands; forgets what others said."""
        self.errors.clear()
        self.requests.clear()
        self.seen(1600)
        self.value("window.former = true")
        self._ask("Page.navigate", url=file.as_uri())
        self._settled("document.readyState === 'complete' && location.protocol === 'file:' && !window.former")
        self.value(SCRIPTS.read_text("utf-8"))
        self.value("document.querySelectorAll('details').forEach((each) => { each.open = true; })")

    def seen(self, width: int, *, dark: bool = False, paper: bool = False) -> None:
        """From now on so many pixels wide, in a theme, or as on paper."""
        self._ask("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        theme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self._ask("Emulation.setEmulatedMedia", media="print" if paper else "screen", features=[theme])
        # The window and its page are processes of their own: under load the page learns of it later.
        media = f"matchMedia('{'print' if paper else 'screen'}').matches"
        self._settled(f"innerWidth === {width} && {media} && matchMedia('({theme['name']}: {theme['value']})').matches")

    def _settled(self, condition: str) -> None:
        """Returns once a condition holds; a page that is being replaced answers with an error."""
        end = time.monotonic() + PATIENCE
        while True:
            try:
                if self.value(condition):
                    return
            except AssertionError:
                if time.monotonic() > end:
                    raise
            if time.monotonic() > end:
                raise BrowserUnavailableError(f"not within {PATIENCE:g} s: {condition}")
            time.sleep(0.02)

    def value(self, expression: str) -> Any:
        """Of what the page computes; what it throws is raised."""
        found = self._ask("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in found:
            raise AssertionError(found["exceptionDetails"])
        return found["result"].get("value")

    def press(self, key: str) -> None:
        """A key down and up."""
        text = {"text": key} if len(key) == 1 else {}
        codes = {"Tab": 9, " ": 32, "End": 35, "Home": 36, "ArrowRight": 39, "ArrowLeft": 37}
        for kind in ("keyDown", "keyUp"):
            self._ask("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=codes[key], **text)

    def pdf(self) -> bytes:
        """The page on A4."""
        self._ask("Emulation.setEmulatedMedia", media="", features=[])
        return base64.b64decode(self._ask("Page.printToPDF", preferCSSPageSize=True, printBackground=True)["data"])

    def picture(self, file: Path) -> None:
        """The whole page as PNG."""
        size = self._ask("Page.getLayoutMetrics")["cssContentSize"]
        clip = {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}
        shot = self._ask("Page.captureScreenshot", captureBeyondViewport=True, clip=clip)
        file.write_bytes(base64.b64decode(shot["data"]))

    def _ask(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._count += 1
        message = {"id": self._count, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        try:
            os.write(self._to, json.dumps(message).encode() + b"\0")
        except BrokenPipeError as problem:
            raise BrowserUnavailableError("it has ended") from problem
        while True:
            answer = self._next()
            if answer.get("id") == self._count:
                if "error" in answer:
                    raise AssertionError(f"{method}: {answer['error']}")
                return dict(answer["result"])
            self._noted(answer)

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self._buffer:
            if not select.select([self._from], [], [], PATIENCE)[0]:
                raise BrowserUnavailableError(f"no answer within {PATIENCE:g} s")
            piece = os.read(self._from, 2**16)
            if not piece:
                raise BrowserUnavailableError("it has ended")
            self._buffer += piece
        line, _, self._buffer = self._buffer.partition(b"\0")
        return dict(json.loads(line))

    def _noted(self, event: dict[str, Any]) -> None:
        told = event.get("params", {})
        match event.get("method"):
            case "Runtime.exceptionThrown":
                self.errors.append(str(told["exceptionDetails"]))
            case "Runtime.consoleAPICalled" if told["type"] in ("error", "warning", "assert"):
                self.errors.append(str(told["args"]))
            case "Log.entryAdded" if told["entry"]["level"] in ("error", "warning"):
                self.errors.append(str(told["entry"]))
            case "Network.requestWillBeSent":
                self.requests.append(told["request"]["url"])
