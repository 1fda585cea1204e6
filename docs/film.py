"""Films the scene for the README, in a headless Chromium: run it from anywhere, it writes scene.gif beside itself."""

import base64
import sys
import tempfile
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image

from autograder.reference import robots
from dhkit.scene import Scene

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "tests/dhkit"))

from browser import GRIP, Tab  # noqa: E402

WIDTH, HEIGHT = 760, 470
RX90 = robots.RX90
ROWS = [[row.sigma, *row.parameters] for row in RX90.table.rows]
REACH = np.radians([20, 40, -30, 50, 60, -70])
ACCENTS = (
    "b0307a",
    "d9a8c4",
    "c94f00",
    "e08a52",
    "00835f",
    "5fb39c",
    "0067a8",
    "6fa3cf",
    "3f5f86",
    "7f9fc4",
    "222222",
    "ffffff",
)


def open_tab(scene, folder):
    scene.save(folder / "arm.html")
    tab = Tab(folder / "profile", WIDTH, HEIGHT)
    tab.open(folder / "arm.html")
    tab.ask(f"root.querySelector('.frame').style.height = '{HEIGHT - 26}px'")
    return tab


def frame(tab):
    tab.picture()
    data = tab.tell("Page.captureScreenshot", format="png")["data"]
    return Image.open(BytesIO(base64.b64decode(data))).convert("RGB")


def follow(tab, places):
    """Drag the hand through places in the picture, in pixels from where it is; a frame at each."""
    x, y = tab.ask(GRIP)
    mouse = {"x": x, "y": y, "button": "left", "clickCount": 1}
    tab.tell("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
    tab.tell("Input.dispatchMouseEvent", **mouse, type="mousePressed")
    for dx, dy in places:
        tab.tell("Input.dispatchMouseEvent", **mouse | {"x": x + dx, "y": y + dy}, type="mouseMoved", buttons=1)
        yield frame(tab)
    tab.tell("Input.dispatchMouseEvent", **mouse | {"x": x + dx, "y": y + dy}, type="mouseReleased")


def film():
    """The hand of the RX-90 is dragged round, and all postures follow; another one is chosen; the wrist is straightened."""
    scene = Scene(ROWS, RX90.table.values, q=REACH, title="RX-90", trace=True)
    around = np.linspace(0, 2 * np.pi, 26)
    with tempfile.TemporaryDirectory() as folder:
        tab = open_tab(scene.ghosts(RX90.inverse(RX90.forward(REACH)).q), Path(folder))
        yield from follow(tab, np.column_stack([90 * np.sin(around), 55 * (1 - np.cos(around))]))
        for posture in (3, 7):
            tab.ask(f"root.querySelectorAll('[aria-label=postures] button')[{posture - 1}].click()")
            for _ in range(5):
                yield frame(tab)
        tab.ask("[...root.querySelectorAll('button')].find((one) => one.textContent === 'speeds').click()")
        for angle in (*range(-60, 0, 10), 0, 0, 0, 0):
            slide(tab, 4, angle)
            yield frame(tab)
        tab.close()


def slide(tab, joint, degrees):
    tab.ask(
        f"(() => {{ const slider = root.querySelectorAll('.joint input')[{joint}];"
        f" slider.value = {degrees}; slider.dispatchEvent(new Event('input')); }})()"
    )


def save(frames):
    sheet = Image.new("RGB", (WIDTH, 6 * HEIGHT))
    for k, each in enumerate(frames[:: len(frames) // 6][:6]):
        sheet.paste(each, (0, k * HEIGHT))
    # The colours that cover little of the picture are those that matter.
    common = sheet.quantize(56).getpalette()[: 3 * 56]
    palette = Image.new("P", (1, 1))
    palette.putpalette([*common, *(value for colour in ACCENTS for value in bytes.fromhex(colour))])
    first, *rest = [each.quantize(palette=palette, dither=Image.Dither.NONE) for each in frames]
    first.save(HERE / "scene.gif", save_all=True, append_images=rest, duration=110, loop=0, optimize=True)


if __name__ == "__main__":
    save(list(film()))
