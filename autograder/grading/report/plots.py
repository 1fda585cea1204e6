"""The pictures of the class report, each as a data URI: the course's colours, told apart by hatching in grey print."""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from autograder.judge.clusters import is_unexplained
from dhkit.drawing.style import AXIS_COLOURS, FAINT, INK, SOFT, STYLE

from .statistics import NOTHING_CAME, RIGHT, TELLS, TELLS_WELL, ClassReport, QuestionReport

_STYLE: dict[Any, Any] = {**STYLE, "hatch.linewidth": 0.8, "text.parse_math": False}
_NO_METADATA = {"Creator": None, "Date": None, "Format": None, "Type": None}
_MOST_NOTES = 9


def overview(report: ClassReport) -> str:
    """Total points; then, question by question, the mean share of the points and the discrimination."""
    with matplotlib.rc_context(_STYLE):
        rows = len(report.questions)
        figure = Figure(figsize=(10, 1.3 + 0.34 * max(rows, 5)), layout="constrained")
        total, share, tells = figure.subplots(1, 3, width_ratios=(3, 3.4, 3))
        _histogram(total, report.totals, report.max_score)
        total.set_title("total points", loc="left")
        names = [question.question.partition(".")[2] or question.question for question in report.questions]
        means = [question.mean / question.max_score for question in report.questions]
        share.barh(names, means, color=AXIS_COLOURS["z"], height=0.62)
        share.barh(names, [1] * rows, fill=False, edgecolor=SOFT, lw=0.7, height=0.62)
        for row, mean in enumerate(means):
            inside = mean > 0.2
            share.text(
                mean + (-0.02 if inside else 0.02), row, f"{mean:.0%}", va="center",
                ha="right" if inside else "left", color="white" if inside else INK,
            )  # fmt: skip
        share.set(xlim=(0, 1.02), ylim=(rows - 0.5, -0.5), xticks=())
        share.set_title("mean share of the points", loc="left")
        share.spines[["left", "bottom"]].set_visible(False)
        share.tick_params(left=False)
        _discriminations(tells, report.questions)
        return _as_uri(figure)


def question_plot(question: QuestionReport) -> str:
    """Bars of the score distribution, and bars of the answer notes by falling frequency."""
    with matplotlib.rc_context(_STYLE):
        notes = question.notes.most_common()
        shown, rest = notes[:_MOST_NOTES], notes[_MOST_NOTES:]
        if rest:
            shown.append((f"{len(rest)} more notes", sum(count for _, count in rest)))
        figure = Figure(figsize=(10, 1.0 + 0.3 * max(len(shown), 5)), layout="constrained")
        left, right = figure.subplots(1, 2, width_ratios=(3, 4))
        _histogram(left, question.scores, question.max_score)
        left.set_title("points", loc="left")
        bars = right.barh([note for note, _ in shown], [count for _, count in shown], height=0.66)
        for bar, (note, _) in zip(bars, shown):
            bar.set(**_look(note))
        right.bar_label(bars, padding=3)
        right.set(xticks=(), ylim=(max(len(shown), 5) - 0.4, -0.6))
        right.set_title("answer notes", loc="left")
        right.spines["bottom"].set_visible(False)
        right.tick_params(left=False)
        return _as_uri(figure)


def _histogram(ax: Axes, scores: Sequence[float], most: float) -> None:
    """No points, the quarters between, all points: six bars with their counts."""
    edges = [most * quarter / 4 for quarter in range(1, 4)]
    counts = [0] * 6
    for score in scores:
        place = 0 if score <= 0 else 5 if score >= most else 1 + sum(score > edge for edge in edges)
        counts[place] += 1
    labels = ["0", *(f"to {edge:g}" for edge in edges), f"< {most:g}", f"{most:g}"]
    bars = ax.bar(labels, counts, color=[SOFT, *4 * [FAINT], AXIS_COLOURS["y"]], edgecolor=INK, lw=0.7, width=0.8)
    ax.bar_label(bars, [count or "" for count in counts], padding=2)
    ax.set(yticks=(), ylim=(0, 1.15 * max(1, *counts)))
    ax.spines["left"].set_visible(False)
    ax.tick_params(bottom=False)


def _discriminations(ax: Axes, questions: Sequence[QuestionReport]) -> None:
    values = [question.discrimination for question in questions]
    for row, value in enumerate(values):
        if value is None:
            ax.text(0.03, row, "says nothing", va="center", color=SOFT, fontstyle="italic")
            continue
        tells, side = value >= TELLS, 1 if value >= 0 else -1
        colour = AXIS_COLOURS["z" if tells else "x"]
        ax.plot([0, value], [row, row], color=colour, lw=2)
        ax.plot(value, row, "o" if tells else "D", color=colour, ms=7)
        ax.text(value + 0.07 * side, row, _signed(value), va="center", ha="left" if side > 0 else "right")
    lowest = min([0, *(value for value in values if value is not None)])
    ticks = (0, TELLS, TELLS_WELL, 1)
    ax.axvline(0, color=SOFT, lw=0.8)
    ax.set(xlim=(min(-0.1, lowest - 0.35), 1.25), ylim=(len(questions) - 0.5, -0.5), yticks=())
    ax.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    ax.set_title("discrimination", loc="left")
    ax.grid(axis="x")
    ax.spines["left"].set_visible(False)


def _signed(value: float) -> str:
    return f"{value:.2f}".replace("-", "\N{MINUS SIGN}")


def _look(note: str) -> dict:
    """Colour and hatch of the bar of a note."""
    if note in RIGHT:
        return {"color": AXIS_COLOURS["y"]}
    if is_unexplained(note):
        return {"facecolor": "white", "edgecolor": AXIS_COLOURS["x"], "hatch": "////"}
    if note in NOTHING_CAME:
        return {"facecolor": FAINT, "edgecolor": SOFT}
    return {"color": AXIS_COLOURS["z"]}


def _as_uri(figure: Figure) -> str:
    file = io.BytesIO()
    figure.savefig(file, format="svg", metadata=_NO_METADATA)
    return f"data:image/svg+xml;base64,{base64.b64encode(file.getvalue()).decode()}"
