"""The page of a scene in a real browser: it draws, sliders move the arm, ghosts can be clicked, nothing acts as HTML."""

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
import sympy

from dhkit.scene import Scene

websocket = pytest.importorskip("websocket", reason="websocket-client, which speaks to the browser, is not installed")
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
pytestmark = [pytest.mark.slow, pytest.mark.skipif(CHROMIUM is None, reason="there is no chromium on this machine")]

t1, t2, t4, a2, a3, d2 = sympy.symbols("t1 t2 t4 a2 a3 d2")
SCARA = [[0, 0, 0, 0, t1], [0, a2, 0, 0, t2], [1, a3, 0, -d2, 0], [0, 0, 0, 0, t4]]
BOTH = [[0.2, 1.2, 0.1, 0.0], [1.2, -1.2, 0.1, 1.4]]
HOSTILE = '<img src=x onerror="window.hacked=1"><b>bold</b>'
KEYS = {"ArrowRight": 39, "ArrowLeft": 37, "Home": 36}


class Tab:
    """One tab of a headless browser, told what to do by its DevTools protocol."""

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
        self.numbers = count()
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.tell("Emulation.setDeviceMetricsOverride", **size)

    def tell(self, method, **params):
        number = next(self.numbers)
        self.socket.send(json.dumps({"id": number, "method": method, "params": params}))
        while (message := json.loads(self.socket.recv())).get("id") != number:
            pass
        assert "error" not in message, message
        return message["result"]

    def ask(self, expression):
        """The value of a JavaScript expression, in which `root` is the scene's own tree."""
        found = "document.getElementById('scene')?.shadowRoot"
        code = f"(async () => {{ const root = {found}; return ({expression}); }})()"
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


@pytest.fixture
def show(tmp_path):
    """A function that opens a scene's page in a tab."""
    tabs = []

    def show(scene, width=900, height=620):
        scene.save(tmp_path / "arm.html")
        tabs.append(Tab(tmp_path / "profile", width, height))
        tabs[-1].tell("Page.navigate", url=(tmp_path / "arm.html").as_uri())
        tabs[-1].until("!!root?.querySelector('.label')")
        return tabs[-1]

    yield show
    for tab in tabs:
        tab.close()


def shares(one, other):
    """The share of pixels in which two pictures differ."""
    return (np.abs(one - other).max(axis=2) > 0.1).mean()


READOUTS = "[...root.querySelectorAll('output')].map((output) => output.textContent)"
HAND = "root.querySelector('.hand').textContent"


def test_sliders_move_the_arm_and_ghosts_are_clicked(show):
    tab = show(Scene(SCARA, {"a2": 0.4, "a3": 0.3}, q=BOTH[0]).ghosts(BOTH))
    before = tab.picture()
    assert (before[..., 3] > 0).mean() > 0.05
    assert len(np.unique((before[..., :3] * 16).astype(int).reshape(-1, 3), axis=0)) > 50

    # A slider by its keys: whole degrees.
    hand = tab.ask(HAND)
    tab.ask("root.querySelector('input[type=range]').focus()")
    tab.press("ArrowRight", 30)
    assert tab.ask(READOUTS)[0] == "41°"
    assert tab.ask(HAND) != hand
    assert shares(tab.picture(), before) > 0.01

    # The camera by its keys.
    turned = tab.picture()
    tab.ask("root.querySelector('canvas').focus()")
    tab.press("ArrowLeft", 5)
    assert shares(tab.picture(), turned) > 0.05
    tab.press("Home")

    # A ghost in the picture.
    tab.picture()
    x, y = tab.until("""(() => {
        const canvas = root.querySelector('canvas'), box = canvas.getBoundingClientRect();
        for (let x = 8; x < box.width; x += 8) for (let y = 56; y < box.height; y += 8) {
            canvas.dispatchEvent(new PointerEvent('pointermove', { clientX: box.left + x, clientY: box.top + y }));
            if (canvas.style.cursor === 'pointer') return [box.left + x, box.top + y];
        }
    })()""")
    pressed = (
        "[...root.querySelectorAll('[aria-label=postures] button')].findIndex((one) => one.ariaPressed === 'true')"
    )
    assert tab.ask(pressed) == -1
    tab.click(x, y)
    first = tab.until(f"{pressed} + 1") - 1
    # The other one by its button.
    tab.ask(f"root.querySelectorAll('[aria-label=postures] button')[{1 - first}].click()")
    tab.until(f"{pressed} === {1 - first}")
    assert float(tab.ask(READOUTS)[1].rstrip("°").replace("\N{MINUS SIGN}", "-")) == pytest.approx(
        np.degrees(BOTH[1 - first][1]), abs=0.05
    )
    assert tab.ask("performance.getEntriesByType('resource').length") == 0


def test_a_path_is_played_on_a_phone_and_texts_stay_texts(show):
    scene = Scene([[0, 0, 0, 0, sympy.Symbol(HOSTILE)], [0, a2, 0, 0, t2]], {"a2": 0.4}, names=[HOSTILE, "1", "2"])
    tab = show(scene.play([[0, 0], [1, 1]], seconds=0.5), width=320, height=640)
    tab.until("root.querySelector('[aria-label=path] input').value === '1'")
    assert tab.ask(READOUTS) == ["57.3°", "57.3°"]
    assert tab.ask("document.documentElement.scrollWidth") <= 320
    assert tab.ask("root.querySelector('.joint .name').textContent").startswith("<img")
    assert tab.ask("document.querySelectorAll('b, img').length + root.querySelectorAll('b, img').length") == 0
    assert tab.ask("window.hacked === undefined")
    assert (tab.picture()[..., 3] > 0).mean() > 0.05
