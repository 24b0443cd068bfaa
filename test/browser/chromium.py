"""Drives a headless Chromium through its DevTools protocol over pipes, without other packages."""

import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

WITH_WEBGL = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
WITHOUT_WEBGL = ["--disable-gpu", "--disable-3d-apis"]


class ChromiumError(RuntimeError):
    """The browser did not start, did not answer, or refused a command."""


def is_snap(program):
    """Whether a program is a snap, which cannot read /tmp, or Ubuntu's script that asks for it."""
    real = os.path.realpath(program)
    with open(real, "rb") as file:
        return real == "/usr/bin/snap" or real.startswith("/snap/") or b"/snap/bin/" in file.read(4096)


def find_chromium():
    """The path of an installed Chromium or Chrome, or None."""
    if os.environ.get("CHROMIUM"):
        return os.environ["CHROMIUM"]
    found = map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))
    return next((program for program in found if program and not is_snap(program)), None)


class Chromium:
    """A browser with one page; a context manager that ends it and removes its profile."""

    def __init__(self, flags=(), program=None, timeout_s=60.0):
        self.timeout_s = timeout_s
        self.events = []
        self.on_event = []
        self._next_id = 0
        self._answers = {}
        self._buffer = b""
        program = program or find_chromium()
        if not program:
            raise ChromiumError("no chromium found; install it or set CHROMIUM")
        self._profile = tempfile.mkdtemp(prefix="croon_chromium_")
        # The browser reads commands from descriptor 3 and writes answers to descriptor 4.
        command_read, self._write = self._pipe()
        self._read, answer_write = self._pipe()

        def place_pipes():
            os.dup2(command_read, 3)
            os.dup2(answer_write, 4)

        self._process = subprocess.Popen(
            [program, "--headless=new", "--remote-debugging-pipe", "--no-sandbox",
             "--no-first-run", "--hide-scrollbars", f"--user-data-dir={self._profile}", *flags,
             "about:blank"],
            pass_fds=(3, 4), preexec_fn=place_pipes, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(command_read)
        os.close(answer_write)
        self._session = None
        try:
            self._attach()
        except BaseException:
            self.close()
            raise

    @staticmethod
    def _pipe():
        """A pipe whose descriptors lie above 10, clear of the browser's 3 and 4."""
        ends = os.pipe()
        high = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in ends]
        for end in ends:
            os.close(end)
        return high

    def _attach(self):
        deadline = time.monotonic() + self.timeout_s
        while True:
            targets = self.call("Target.getTargets")["targetInfos"]
            pages = [target for target in targets if target["type"] == "page"]
            if pages:
                break
            if time.monotonic() > deadline:
                raise ChromiumError("the browser opened no page")
            time.sleep(0.05)
        self._session = self.call("Target.attachToTarget",
                                  {"targetId": pages[0]["targetId"], "flatten": True})["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        self.call("Emulation.setFocusEmulationEnabled", {"enabled": True})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Ends the browser; by force if it does not end by itself."""
        try:
            self._send("Browser.close", {}, None)
            self._process.wait(10)
        except (OSError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()
        os.close(self._write)
        os.close(self._read)
        shutil.rmtree(self._profile, ignore_errors=True)

    def _send(self, method, parameters, session):
        self._next_id += 1
        message = {"id": self._next_id, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self._write, data):]
        return self._next_id

    def _receive(self, timeout_s):
        """Reads what has arrived, after waiting for at most `timeout_s`."""
        if not select.select([self._read], [], [], max(0.0, timeout_s))[0]:
            return
        data = os.read(self._read, 1 << 20)
        if not data:
            raise ChromiumError("the browser ended")
        *messages, self._buffer = (self._buffer + data).split(b"\0")
        for message in map(json.loads, messages):
            if "id" in message:
                self._answers[message["id"]] = message
            else:
                self.events.append(message)
                for listener in self.on_event:
                    listener(message)

    def call(self, method, parameters=None, **named):
        """The result of a command; throws ChromiumError if it fails."""
        session = None if method.startswith(("Target.", "Browser.")) else self._session
        number = self._send(method, {**(parameters or {}), **named}, session)
        deadline = time.monotonic() + self.timeout_s
        while number not in self._answers:
            if time.monotonic() > deadline:
                raise ChromiumError(f"{method}: no answer within {self.timeout_s:g} s")
            self._receive(deadline - time.monotonic())
        answer = self._answers.pop(number)
        if "error" in answer:
            raise ChromiumError(f"{method}: {answer['error'].get('message')}")
        return answer["result"]

    def wait_for(self, event, after=0):
        """Waits for an event of that name beyond the first `after` events."""
        deadline = time.monotonic() + self.timeout_s
        while not any(each["method"] == event for each in self.events[after:]):
            if time.monotonic() > deadline:
                raise ChromiumError(f"no {event} within {self.timeout_s:g} s")
            self._receive(deadline - time.monotonic())

    def open(self, url):
        """Loads a page completely."""
        seen = len(self.events)
        self.call("Page.navigate", url=url)
        self.wait_for("Page.loadEventFired", seen)

    def run(self, script):
        """The value of an expression in the page, awaited, with the rights of a user's click."""
        result = self.call("Runtime.evaluate", expression=script, awaitPromise=True,
                           returnByValue=True, userGesture=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise ChromiumError(details.get("exception", {}).get("description", details["text"]))
        return result["result"].get("value")

    def press(self, key, code=0, text="", modifiers=0):
        """Presses and releases a key."""
        common = {"key": key, "code": key, "windowsVirtualKeyCode": code, "modifiers": modifiers}
        self.call("Input.dispatchKeyEvent", type="keyDown", text=text, **common)
        self.call("Input.dispatchKeyEvent", type="keyUp", **common)

    def drag(self, x, y, dx, dy):
        """Drags with the left button."""
        for kind, px, py in (("mousePressed", x, y), ("mouseMoved", x + dx / 2, y + dy / 2),
                             ("mouseMoved", x + dx, y + dy), ("mouseReleased", x + dx, y + dy)):
            self.call("Input.dispatchMouseEvent", type=kind, x=px, y=py, button="left", buttons=1,
                      clickCount=1)

    def resize(self, width, height, is_mobile=False):
        """Sets the size of the page in CSS pixels."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=is_mobile)

    def emulate(self, media="", **features):
        """Sets the medium and features such as prefers_color_scheme="dark"."""
        self.call("Emulation.setEmulatedMedia", media=media, features=[
            {"name": name.replace("_", "-"), "value": value} for name, value in features.items()])

    def screenshot(self, path, whole_page=False):
        """Writes a PNG file of the visible or the whole page."""
        data = self.call("Page.captureScreenshot", captureBeyondViewport=whole_page, **(
            {"clip": self._page_clip()} if whole_page else {}))["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))

    def _page_clip(self):
        size = self.call("Page.getLayoutMetrics")["cssContentSize"]
        return {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}

    def pdf(self):
        """The bytes of the printed page."""
        return base64.b64decode(self.call("Page.printToPDF", printBackground=True)["data"])
