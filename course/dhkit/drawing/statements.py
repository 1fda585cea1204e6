"""A drawing of where, in a document, something was marked."""

from __future__ import annotations

from matplotlib.lines import Line2D

from .inputs import as_numbers
from .strokes import new_axes
from .style import FAINT, INK, styled


@styled
def draw_marks_by_line(marks, ax=None, *, kinds=("error", "ambiguity")):
    """Draw one strip per document with a mark at every line where something stands, full or open by its kind.

    Parameters
    ----------
    marks : dict
        For each document's name, a pair of sequences of line numbers, one per kind.
    kinds : pair of texts
        What the two sequences are, for the legend.

    Returns
    -------
    matplotlib Axes
    """
    lines = {
        name: [as_numbers(list(part), f"lines of {name}", (None,)) for part in parts] for name, parts in marks.items()
    }
    ax = ax or new_axes((8.6, 0.55 * len(lines) + 1.3))
    styles = (
        {"marker": "o", "ms": 6, "mfc": INK, "mec": INK},
        {"marker": "o", "ms": 6, "mfc": "white", "mec": INK, "mew": 1.4},
    )
    for height, parts in enumerate(lines.values()):
        ax.axhline(height, color=FAINT, lw=1, zorder=1)
        for part, style in zip(parts, styles):
            ax.plot(part, [height] * len(part), ls="none", zorder=3, **style)
    ax.set_yticks(
        range(len(lines)), [f"{name}\n{len(first)} + {len(second)}" for name, (first, second) in lines.items()]
    )
    ax.tick_params(axis="y", length=0)
    ax.invert_yaxis()
    ax.set_xlabel("line of the text")
    ax.spines["left"].set_visible(False)
    handles = [Line2D([], [], ls="none", **style) for style in styles]
    ax.legend(handles, kinds, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    return ax
