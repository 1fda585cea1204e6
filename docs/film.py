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

from test_scene_in_browser import Tab  # noqa: E402

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


def circle(count=72):
    """Joint values that lead the hand round a circle, its orientation kept."""
    pose, q, path = RX90.forward(REACH), REACH, []
    for angle in np.linspace(0, 2 * np.pi, count):
        aim = pose.copy()
        aim[:3, 3] += 0.2 * np.array([0.3 * np.sin(angle), np.sin(angle), np.cos(angle) - 1])
        q = RX90.nearest(aim, q).q
        path.append(q)
    return path


def open_tab(scene, folder):
    scene.save(folder / "arm.html")
    tab = Tab(folder / "profile", WIDTH, HEIGHT)
    tab.tell("Page.navigate", url=(folder / "arm.html").as_uri())
    tab.until("!!root?.querySelector('.label')")
    tab.ask(f"root.querySelector('.frame').style.height = '{HEIGHT - 26}px'")
    return tab


def frame(tab):
    tab.picture()
    data = tab.tell("Page.captureScreenshot", format="png")["data"]
    return Image.open(BytesIO(base64.b64decode(data))).convert("RGB")


def seek(tab, share):
    tab.ask(
        "(() => { const time = root.querySelector('[aria-label=path] input');"
        f" time.value = {share}; time.dispatchEvent(new Event('input')); }})()"
    )


def turn(tab, key):
    tab.ask(f"root.querySelector('canvas').dispatchEvent(new KeyboardEvent('keydown', {{ key: '{key}' }}))")


def film():
    """The hand on its circle while the view turns, then all postures of the last pose."""
    scene = Scene(ROWS, RX90.table.values, title="RX-90")
    postures = RX90.inverse(RX90.forward(REACH)).q
    tour = [(1 - s) * postures[i] + s * postures[j] for i, j in ((0, 2), (2, 6)) for s in np.linspace(0, 1, 10)]
    for path, ghosts, steps, turning in ((circle(), [], 30, True), (tour, postures, 20, False)):
        with tempfile.TemporaryDirectory() as folder:
            tab = open_tab(scene.ghosts(ghosts).play(path), Path(folder))
            for k in range(steps):
                seek(tab, round(k / (steps - 1), 2))
                if turning and k % 3 == 0:
                    turn(tab, "ArrowLeft")
                yield frame(tab)
            tab.close()


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
