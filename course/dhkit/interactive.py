"""Sliders for a drawing, with a static figure wherever widgets do not run."""

from __future__ import annotations

import base64
import math
from importlib.util import find_spec
from io import BytesIO

import matplotlib.pyplot as plt
from IPython.display import Image, display
from matplotlib.transforms import Bbox

from .drawing.style import SHARP, shown_size
from .drawing.view import Frame, held
from .flipbook import flipbook
from .watched import is_for_a_site, is_watched


def explore(draw, **sliders: tuple[float, float, float]) -> None:
    """Show ``draw(**values)`` with one slider per value.

    The figure for the start values goes along as a plain picture. It alone is shown where nobody sits before the notebook
    (nbconvert, the grader), whose page has no kernel to ask, and where ipywidgets is not installed. For a site, some pictures
    more come along: see `dhkit.flipbook`.

    Parameters
    ----------
    draw : function
        Called with one number per slider; returns the Axes it drew on.
    **sliders : (lowest, highest, start)
        Range and start of each value, in the unit that `draw` awaits.
    """
    start = {name: value for name, (_, _, value) in sliders.items()}
    camera = _Camera(draw)
    static = camera.picture(start)
    words = f"sliders: {', '.join(sliders)}"
    if not is_watched() or find_spec("ipywidgets") is None:
        if is_for_a_site():
            pages = {"text/plain": words, "text/html": flipbook(camera.picture, sliders)}
            display(pages | {"image/png": base64.b64encode(static).decode()}, raw=True)
            return
        display(Image(static, **shown_size(static)))
        return
    import ipywidgets

    controls = {
        name: ipywidgets.FloatSlider(
            value, min=low, max=high, step=step_of(low, high, value), description=name, readout_format=".3g"
        )
        for name, (low, high, value) in sliders.items()
    }
    picture = ipywidgets.Image(format="png", layout=ipywidgets.Layout(max_width="100%"))

    def put(png):
        picture.value, picture.width = png, str(shown_size(png)["width"])

    def redraw(_change):
        put(camera.picture({name: control.value for name, control in controls.items()}))

    put(static)
    for control in controls.values():
        control.observe(redraw, names="value")
    box = ipywidgets.VBox([*controls.values(), picture])
    # Written out, as ipywidgets 7, which Google Colab has, would not let the picture come along.
    view = {"version_major": 2, "version_minor": 0, "model_id": box.model_id}
    bundle = {
        "text/plain": words,
        "application/vnd.jupyter.widget-view+json": view,
        "image/png": base64.b64encode(static).decode(),
    }
    display(bundle, metadata={"image/png": shown_size(static)}, raw=True)


def step_of(low: float, high: float, start: float) -> float:
    """A round step, about a hundredth of the range, that both ends, the start and zero are whole numbers of.

    A slider shows only what it can reach: with any other step its number is not the one that is drawn.
    """
    largest = (high - low) / 50
    decade = math.floor(math.log10(largest))
    for tens in (decade, decade - 1, decade - 2):
        for digit in (5, 2, 1):
            step = round(digit * 10.0**tens, max(0, -tens))
            if step <= largest and all(abs(value / step - round(value / step)) < 1e-9 for value in (low, high, start)):
                return step
    return (high - low) / 100


class _Camera:
    """Pictures of a drawing at one scale and in one place: a frame that grows where it must, and never jumps back."""

    def __init__(self, draw):
        self._draw, self._frame, self._boxes = draw, Frame(), {}

    def picture(self, values: dict[str, float]) -> bytes:
        """The drawing for these values, as PNG."""
        with held(self._frame):
            figure = self._draw(**values).figure
        self._frame.hold_planes(figure)
        size = tuple(figure.get_size_inches())
        figure.draw_without_rendering()  # the layout moves what lies outside the axes
        box = figure.get_tightbbox().padded(0.1)
        self._boxes[size] = Bbox.union([box, self._boxes.get(size, box)])
        buffer = BytesIO()
        figure.savefig(buffer, format="png", bbox_inches=self._boxes[size], dpi=90 * SHARP)
        plt.close(figure)
        return buffer.getvalue()
