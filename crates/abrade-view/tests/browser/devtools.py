"""A headless Chromium, driven through its pipe by the DevTools protocol; the standard library is
enough. Knows nothing of abrade."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

BROWSERS = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"]
INSTALL = "apt-get install --yes chromium-headless-shell"
# WebGL by software, so that pictures do not depend on a graphics card.
FLAGS = ["--headless", "--no-sandbox", "--remote-debugging-pipe", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--hide-scrollbars", "--no-first-run",
         "--disable-background-networking", "--disable-component-update"]
PATIENCE = 120.0


class NoBrowser(Exception):
    """No browser is installed."""


def browser_path():
    """The browser to use: that of ABRADE_BROWSER, or the first that is installed."""
    named = os.environ.get("ABRADE_BROWSER")
    found = [named] if named else [path for path in map(shutil.which, BROWSERS) if path]
    if not found:
        raise NoBrowser(f"no browser: none of {', '.join(BROWSERS)} is installed. "
                        f"On Debian: {INSTALL}. Another one is taken from ABRADE_BROWSER")
    return found[0]


class Browser:
    """A page in a browser. `requests` are the addresses it asked for, `complaints` what it wrote to
    its console and what it threw."""

    def __init__(self, flags=FLAGS):
        self.profile = tempfile.mkdtemp(prefix="abrade-browser-")
        to_browser, self.out = os.pipe()
        self.into, from_browser = os.pipe()
        command = ["bash", "-c", 'exec "$@" 3<&%d 4>&%d' % (to_browser, from_browser), "browser",
                   browser_path(), f"--user-data-dir={self.profile}", *flags, "about:blank"]
        self.process = subprocess.Popen(command, pass_fds=[to_browser, from_browser],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.pending, self.number, self.session = b"", 0, None
        self.requests, self.complaints, self.loaded = [], [], False
        target = next(t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        attached = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)
        self.session = attached["sessionId"]
        for domain in ["Page", "Runtime", "Network", "Log"]:
            self.call(f"{domain}.enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()
        os.close(self.out)
        os.close(self.into)
        shutil.rmtree(self.profile, ignore_errors=True)

    def call(self, method, **parameters):
        """Calls a method and gives its result."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.out, data):]
        number, end = self.number, time.monotonic() + PATIENCE
        while True:
            answer = self.receive(end)
            if answer.get("id") == number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def receive(self, end):
        """The next message; events are noted as they pass."""
        while b"\0" not in self.pending:
            ready, _, _ = select.select([self.into], [], [], max(0.0, end - time.monotonic()))
            read = os.read(self.into, 1 << 20) if ready else b""
            if not read:
                raise RuntimeError("the browser does not answer" if ready == [] else "the browser has ended")
            self.pending += read
        text, self.pending = self.pending.split(b"\0", 1)
        message = json.loads(text)
        self.note(message.get("method"), message.get("params", {}))
        return message

    def note(self, event, said):
        if event == "Network.requestWillBeSent":
            self.requests.append(said["request"]["url"])
        elif event == "Runtime.exceptionThrown":
            details = said["exceptionDetails"]
            self.complaints.append(details.get("exception", {}).get("description", details["text"]))
        elif event == "Runtime.consoleAPICalled":
            words = [str(a.get("value", a.get("description"))) for a in said["args"]]
            self.complaints.append(f"console.{said['type']}: {' '.join(words)}")
        elif event == "Log.entryAdded" and said["entry"]["level"] in ("error", "warning"):
            self.complaints.append(f"log: {said['entry']['text']}")
        elif event == "Page.loadEventFired":
            self.loaded = True

    def resize(self, width, height, scale=1, mobile=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=scale, mobile=mobile)

    def dark(self, dark):
        features = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
        self.call("Emulation.setEmulatedMedia", features=features)

    def open(self, path, ready):
        """Opens a file from disk and waits until the expression `ready` holds."""
        self.loaded = False
        self.call("Page.navigate", url="file://" + os.path.abspath(path))
        self.wait(ready)

    def wait(self, expression):
        end = time.monotonic() + PATIENCE
        while not self.value(f"Boolean({expression})"):
            if time.monotonic() > end:
                raise RuntimeError(f"{expression} never held; complaints: {self.complaints}")
            time.sleep(0.05)
        self.value("new Promise(go => requestAnimationFrame(() => requestAnimationFrame(go)))")

    def value(self, expression):
        """The value of an expression in the page."""
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def box(self, selector):
        """Left, top, width and height of an element [CSS pixels]."""
        rect = f"document.querySelector({json.dumps(selector)}).getBoundingClientRect()"
        return [self.value(f"{rect}.{side}") for side in ("left", "top", "width", "height")]

    def mouse(self, kind, x, y, button="left"):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, clickCount=1,
                  buttons=1 if kind == "mouseMoved" and button == "left" else 0)

    def click(self, selector):
        left, top, width, height = self.box(selector)
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, left + width / 2, top + height / 2)

    def press(self, key, code=None, count=1):
        for _ in range(count):
            for kind in ("keyDown", "keyUp"):
                self.call("Input.dispatchKeyEvent", type=kind, key=key, code=code or key,
                          windowsVirtualKeyCode=KEYS.get(key, 0))
        self.value("new Promise(go => requestAnimationFrame(() => requestAnimationFrame(go)))")

    def picture(self, clip=None, whole=False):
        """A PNG of the window, of the box `clip`, or of the whole page."""
        more = {}
        if clip:
            left, top, width, height = clip
            more["clip"] = {"x": left, "y": top, "width": width, "height": height, "scale": 1}
        answer = self.call("Page.captureScreenshot", captureBeyondViewport=whole, **more)
        return base64.b64decode(answer["data"])


KEYS = {"ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "Home": 36, "End": 35}
