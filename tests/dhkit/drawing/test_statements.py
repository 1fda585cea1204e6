"""Marks stand at their lines, one strip per document."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import pytest

from dhkit.drawing.statements import draw_marks_by_line

pytestmark = pytest.mark.filterwarnings("error")


def test_marks_stand_at_their_lines():
    ax = draw_marks_by_line({"slides": ([3, 7], [5]), "sheet": ([], [2])})
    marks = [line.get_xydata().tolist() for line in ax.lines if line.get_marker() == "o"]
    assert marks == [[[3, 0], [7, 0]], [[5, 0]], [], [[2, 1]]]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["slides\n2 + 1", "sheet\n0 + 1"]
    plt.close("all")


def test_lines_must_be_numbers():
    with pytest.raises(ValueError, match="lines of slides: expected n numbers"):
        draw_marks_by_line({"slides": (["L3"], [])})
