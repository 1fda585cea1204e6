"""One style for all drawings of the course: colours, dashes, shades, and Matplotlib settings."""

from __future__ import annotations

from functools import cache, wraps

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patheffects import withStroke

from ..watched import is_watched

INK = "#222222"
SOFT = "#8c8c8c"
FAINT = "#d4d4d4"
WANTED = "#E69F00"
"""A curve that is to be drawn."""
# Okabe-Ito colours: told apart with any common colour-blindness, and of different lightness in grey print.
AXIS_COLOURS = {"x": "#D55E00", "y": "#009E73", "z": "#0072B2"}
AXIS_DASHES = {"x": "-", "y": (0, (5, 1.5)), "z": (0, (6, 1.5, 1.2, 1.5))}
POSTURE_SHADES = ("#e9e9e9", "#a9a9a9", "#cfcfcf", "#8e8e8e")
CENTRE_LINE = (0, (9, 3, 2, 3))
DASHED = (0, (3, 2))
LIMIT_DASHES = (0, (5, 2))
HALO = [withStroke(linewidth=3.2, foreground="white")]  # keeps a label readable on top of lines

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 10,
    "mathtext.fontset": "cm",
    "axes.edgecolor": SOFT,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 11,
    "axes.axisbelow": True,
    "xtick.color": INK,
    "ytick.color": INK,
    "text.color": INK,
    "grid.color": "#ececec",
    "figure.dpi": 110,
    "savefig.dpi": 160,
    "savefig.bbox": "tight",
    "legend.frameon": False,
}


# Pixels of a picture for each one that it takes on a page: sharp screens have them, and paper has more.
SHARP = 2


def shown_size(png: bytes) -> dict[str, int]:
    """Width and height that a picture with `SHARP` pixels for one takes on a page, as a notebook's metadata has them."""
    return {side: int.from_bytes(png[at : at + 4]) // SHARP for side, at in (("width", 16), ("height", 20))}


@cache
def sharpen() -> None:
    """From now on, figures of a notebook that somebody watches have `SHARP` pixels for one."""
    if is_watched():
        from IPython import get_ipython
        from IPython.core.pylabtools import select_figure_formats

        select_figure_formats(get_ipython(), {"retina"})


def styled(draw):
    """Run a drawing function in the style of the course, leaving the reader's own settings alone."""

    @wraps(draw)
    def in_style(*args, **kwargs):
        # Not rc_context: it would also undo the interactive mode that Jupyter's backend sets when the first figure
        # loads it, and no later figure would be shown.
        kept = {name: plt.rcParams[name] for name in STYLE}
        plt.rcParams.update(STYLE)
        try:
            return draw(*args, **kwargs)
        finally:
            plt.rcParams.update(kept)
            sharpen()  # not before: the first figure loads Jupyter's backend, which chooses a format too

    return in_style


def in_degrees(angle: float) -> str:
    """An angle in radians as text in whole degrees, with a proper minus sign."""
    return f"{np.degrees(angle):.0f}°".replace("-", "\N{MINUS SIGN}")
