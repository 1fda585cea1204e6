"""A headless browser that tests drive by its DevTools protocol, and what they read in a scene."""

import base64
import json
import shutil
import subprocess
import urllib.request
from io import BytesIO
from itertools import count
from time import sleep

import matplotlib.pyplot as plt
import numpy as np
import pytest

try:
    import websocket
except ImportError:
    websocket = None

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
without_browser = pytest.mark.skipif(
    CHROMIUM is None or websocket is None, reason="chromium, or websocket-client, which speaks to it, is not installed"
)
KEYS = {"ArrowRight": 39, "ArrowLeft": 37, "ArrowUp": 38, "ArrowDown": 40, "Home": 36}


class Tab:
    """One tab of a headless browser, told what to do by its DevTools protocol.

    `root` is JavaScript for the tree of the scene that is looked at; `events` is what the browser has told by itself, of
    what was asked for with such methods as ``Log.enable``.
    """

    root = "document.getElementById('scene')?.shadowRoot"

    def __init__(self, folder, width, height):
        options = ["--headless=new", "--no-sandbox", "--remote-debugging-port=0", f"--user-data-dir={folder}"]
        drawing = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars"]
        command = [CHROMIUM, *options, *drawing, f"--window-size={width},{height}", "about:blank"]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        told = folder / "DevToolsActivePort"
        for _ in range(300):
            if told.exists() and len(told.read_text().split()) == 2:
                break
            sleep(0.1)
        with urllib.request.urlopen(f"http://127.0.0.1:{told.read_text().split()[0]}/json/list") as answer:
            page = next(target for target in json.load(answer) if target["type"] == "page")
        self.socket = websocket.create_connection(page["webSocketDebuggerUrl"], suppress_origin=True, timeout=120)
        self.numbers, self.events = count(), []
        self.tell("Emulation.setFocusEmulationEnabled", enabled=True)  # else the address bar may have it
        self.resize(width, height)

    def resize(self, width, height):
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.tell("Emulation.setDeviceMetricsOverride", **size)

    def prefer(self, scheme):
        self.tell("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def open(self, page):
        """Show a page with a scene, a file or a URL, once it has been drawn."""
        url = page if isinstance(page, str) else page.as_uri()
        self.tell("Page.navigate", url=url)
        self.until(f"location.href === '{url}' && !!root?.querySelector('.label')")

    def tell(self, method, **params):
        number = next(self.numbers)
        self.socket.send(json.dumps({"id": number, "method": method, "params": params}))
        while (message := json.loads(self.socket.recv())).get("id") != number:
            self.events.append(message)
        assert "error" not in message, message
        return message["result"]

    def ask(self, expression):
        """The value of a JavaScript expression, in which `root` is the scene's own tree."""
        code = f"(async () => {{ const root = {self.root}; return ({expression}); }})()"
        result = self.tell("Runtime.evaluate", expression=code, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    def until(self, expression):
        for _ in range(300):
            if value := self.ask(expression):
                return value
            sleep(0.1)
        raise AssertionError(f"it did not come about: {expression}")

    def press(self, key, times=1):
        for _ in range(times):
            for kind in ("rawKeyDown", "keyUp"):
                self.tell("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=KEYS[key])

    def click(self, x, y):
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            button = "none" if kind == "mouseMoved" else "left"
            self.tell("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, clickCount=1)

    def drag(self, x, y, by, steps=10):
        """Press the mouse at (x, y), move it in steps, and release it."""
        mouse = {"x": x, "y": y, "button": "left", "clickCount": 1}
        self.tell("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
        self.tell("Input.dispatchMouseEvent", **mouse, type="mousePressed")
        for k in range(1, steps + 1):
            there = {"x": x + by[0] * k / steps, "y": y + by[1] * k / steps}
            self.tell("Input.dispatchMouseEvent", **mouse | there, type="mouseMoved", buttons=1)
        self.tell("Input.dispatchMouseEvent", **mouse | there, type="mouseReleased")

    def picture(self):
        """What the canvas shows, (height, width, 4); the scene draws at the next frame of the screen."""
        url = self.ask(
            "await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),"
            " root.querySelector('canvas').toDataURL()"
        )
        return plt.imread(BytesIO(base64.b64decode(url.split(",")[1])))

    def close(self):
        self.socket.close()
        self.process.terminate()
        self.process.wait()


def shares(one, other):
    """The share of pixels in which two pictures differ."""
    return (np.abs(one - other).max(axis=2) > 0.1).mean()


def numbers(texts):
    """Readouts as numbers, in degrees or metres."""
    return [float(text.rstrip("°m ").replace("\N{MINUS SIGN}", "-")) for text in texts]


GRIP = "(() => { const box = root.querySelector('.grip').getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; })()"
READOUTS = "[...root.querySelectorAll('output')].map((output) => output.textContent)"
HAND = "root.querySelector('.hand').textContent"
