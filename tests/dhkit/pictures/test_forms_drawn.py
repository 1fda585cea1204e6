"""What `check` takes as an answer can be drawn: dictionaries in any order, tables of columns, sets, truth values."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
import sympy

from dhkit import pictures
from dhkit.attitudes import Camera
from dhkit.pictures.own_result import laid_out
from dhkit.public import questions

NAMED = {
    question.id: names
    for question in questions().values()
    if (names := getattr(question.form, "names", ()) or getattr(question.form, "joints", ()))
}


@pytest.mark.parametrize("id", NAMED)
def test_names_in_any_order_are_put_in_the_order_of_the_question(id):
    names = NAMED[id]
    given = dict(zip(names, range(len(names))))
    backwards = dict(reversed(given.items()))
    symbols = {sympy.Symbol(name): value for name, value in backwards.items()}
    assert laid_out(backwards) == laid_out(symbols) == list(range(len(names)))
    columns = {name: [value, value + 10] for name, value in backwards.items()}
    assert laid_out(columns) == [[*range(len(names))], [*range(10, 10 + len(names))]]


def test_truth_values_are_zero_and_one():
    marks = np.zeros((1, 2, 2), bool)
    marks[0, 1, 0] = True
    assert laid_out(marks) == laid_out([[[False, False], [sympy.true, False]]]) == [[[0, 0], [1, 0]]]


def drawn(ax) -> bool:
    """Whether this is a picture, not a card that says why there is none."""
    found = not any("cannot be drawn" in text.get_text() for text in np.ravel(ax)[0].texts)
    plt.close("all")
    return found


@pytest.mark.parametrize(
    "picture",
    [
        lambda: pictures.show_parallel_axes({"z1": 0.5, "a1": 0.4}, 0.3, 0.2, 0.6),
        lambda: pictures.show_postures(
            [{"t2": 1.2, "t1": 0.4, "d2": 0.1, "t4": -0.6}], (0.4, 0.3), (0.35, 0.45), 1.0
        ),
        lambda: pictures.show_section({"z": 0.2, "rho": 0.8}, {"t2": 0.3, "t3": 0.4, "L1": 0.5, "L2": 0.3}),
        lambda: pictures.show_marks([[[True] + [False] * 3] * 4], {"U": sympy.eye(4)}),
        lambda: pictures.show_drone({"yaw": 0.1, "roll": 0.2, "pitch": 0.3}, Camera("looks ahead", np.eye(3))),
        lambda: pictures.show_table(
            [{"theta": 0.3, "sigma": 0, "a": 0, "alpha": 0, "d": 0.2}, {"theta": 0.1, "sigma": 0, "a": 1, "alpha": 0, "d": 0}],
            {},
        ),
    ],
)  # fmt: skip
def test_such_an_answer_is_drawn(picture):
    assert drawn(picture())
