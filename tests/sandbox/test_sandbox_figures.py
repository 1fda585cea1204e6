"""Figures wait in the kernel: who ran the notebook says at its end which of them are drawn."""

import base64
import inspect

import pytest

from autograder import sandbox

pytestmark = pytest.mark.sandbox

LINE = "import matplotlib.pyplot as plt\nplt.plot([1, 2]);"
WAITING = "application/vnd.autograder.figure+json"


@pytest.fixture(params=["bwrap", "none"])
def either(request, run_cells):
    """run_cells in both modes."""
    if request.param == "bwrap":
        request.getfixturevalue("needs_sandbox")
    return lambda *sources, **options: run_cells(*sources, mode=request.param, **options)


def pictures(run, index):
    found = [output.data for output in run.cells[index].outputs if output.output_type == "display_data"]
    return ["image/png" in data for data in found if WAITING in data]


def test_only_those_are_drawn_that_somebody_will_look_at(either):
    run = either(LINE, f"{LINE}\nplt.figure()\n{LINE}", "1", LINE, looked=lambda run: {1, 2})
    assert [pictures(run, index) for index in range(4)] == [[False], [True, True], [], [False]]
    assert "not drawn here" in run.cells[0].outputs[0].data["text/plain"]
    assert base64.b64decode(run.cells[1].outputs[0].data["image/png"]).startswith(b"\x89PNG")


def test_without_a_choice_all_are_drawn_in_their_places(either):
    run = either(f"print('before')\n{LINE}\nplt.show()\nprint('after')", "fig, ax = plt.subplots()\ndisplay(fig)\nfig")
    kinds = [output.get("name", "picture") for output in run.cells[0].outputs]
    assert kinds == ["stdout", "picture", "stdout"]
    assert pictures(run, 0) == [True] and all(pictures(run, 1)) and len(pictures(run, 1)) >= 2


def test_the_choice_sees_what_came_of_every_cell(either):
    seen = []
    either(LINE, "1 / 0", looked=lambda run: seen.append([run.cells[k].status for k in (0, 1)]) or ())
    assert seen == [["ok", "error"]]


def test_a_kernel_that_is_lost_on_the_way_costs_no_picture(either):
    run = either(LINE, "import os; os._exit(3)", f"plt.figure()\n{LINE}")
    assert pictures(run, 0) == [True] and pictures(run, 2) == [True]


def test_a_kernel_that_is_lost_at_the_end_leaves_words(either):
    run = either(LINE, "import os; os._exit(3)")
    assert pictures(run, 0) == [False] and run.message is None


def test_after_the_first_no_figure_is_drawn_at_the_end_of_its_cell(either):
    count = """
    import matplotlib.figure
    drawn, plain = [], matplotlib.figure.Figure.draw
    matplotlib.figure.Figure.draw = lambda self, renderer: (drawn.append(self), plain(self, renderer))
    """
    run = either(LINE, inspect.cleandoc(count), LINE, "print(len(drawn))", looked=lambda run: ())
    assert run.cells[3].outputs[0].text == "0\n"


def test_too_many_are_drawn_at_once(either):
    run = either(f"{LINE}\nfor _ in range(66): display(plt.gcf())", looked=lambda run: ())
    drawn = ["image/png" in output.data for output in run.cells[0].outputs]
    assert drawn.count(False) == 64 and drawn.count(True) >= 2


def test_what_takes_much_memory_does_not_wait(either):
    big = "import numpy as np\nfig, ax = plt.subplots()\nax.plot([1, 2])\nfig.big = np.ones(20_000_000);"
    run = either(LINE, big, big, big, limits=sandbox.Limits(memory=800 << 20), looked=lambda run: ())
    drawn = ["image/png" in run.cells[k].outputs[-1].data for k in range(4)]
    assert not drawn[0] and drawn[2:] == [True, True] and run.cells[3].status == "ok"


def test_what_cannot_be_drawn_costs_nothing(either):
    broken = (
        "class Broken(plt.Figure):\n    def draw(self, *_): raise ValueError('no')\nplt.figure(FigureClass=Broken);"
    )
    hanging = (
        "import time\nclass Slow(plt.Figure):\n    def draw(self, *_): time.sleep(1000)\nplt.figure(FigureClass=Slow);"
    )
    limits = sandbox.Limits(cell_seconds=2, notebook_seconds=60)
    run = either(LINE, broken, hanging, "print('said')", limits=limits)
    assert [run.cells[k].status for k in range(4)] == ["ok"] * 4 and run.message is None and run.doubt is None
    assert pictures(run, 0) == [True] and pictures(run, 1) == [False] and pictures(run, 2) == [False]


@pytest.mark.parametrize("number", ["-1", "10**9", "'0'", "True", "[0]", "0.0"])
def test_a_number_that_no_figure_has_is_no_figure(either, number):
    run = either(f"display({{'{WAITING}': {number}, 'text/plain': 'x'}}, raw=True)", "print('said')")
    assert run.cells[0].outputs[0].data["text/plain"] == "x" and run.message is None


def test_what_a_notebook_does_to_the_drawing_is_its_own_loss(either):
    run = either(LINE, "get_ipython().draw_figures = lambda *n: 1 / 0", "get_ipython = None")
    assert pictures(run, 0) == [False] and run.message is None
