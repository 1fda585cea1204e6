"""One style for all drawings of the course: colours, dashes, shades, and Matplotlib settings."""

from __future__ import annotations

from functools import wraps

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patheffects import withStroke

INK = "#222222"
SOFT = "#8c8c8c"
FAINT = "#d4d4d4"
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

    return in_style


def in_degrees(angle: float) -> str:
    """An angle in radians as text in whole degrees, with a proper minus sign."""
    return f"{np.degrees(angle):.0f}°".replace("-", "\N{MINUS SIGN}")
