"""Machines with rails, cranks and rams: drawn as they are, in a working mode that their table names; pictures of own results."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest

from dhkit.drawing.machines import draw_machine
from dhkit.drawing.parallel import platform_points
from dhkit.machines import MACHINES, machine_of, ways_of
from dhkit.pictures import machines as pictures

pytestmark = pytest.mark.filterwarnings("error")

MINE = {"machine": "press", "order": "512340"}
POSE = (0.42, 0.58, -0.3)


@pytest.fixture(autouse=True)
def no_figure_is_left():
    yield
    plt.close("all")


@pytest.mark.parametrize("name", MACHINES)
def test_at_home_every_rod_fits_and_is_built_as_the_table_says(name):
    machine = MACHINES[name]
    for leg, q, joint in zip(machine.legs, machine.drives, platform_points(machine.platform, machine.home)):
        anchor, driven = np.array(leg.anchor), leg.driven(q)
        if leg.kind == "ram":
            assert np.hypot(*(joint - anchor)) == pytest.approx(q, abs=1e-4)
            continue
        assert np.hypot(*(joint - driven)) == pytest.approx(leg.rod, abs=2e-4)
        way, begun = joint - anchor, driven - anchor
        along = np.array([np.cos(np.radians(leg.rail)), np.sin(np.radians(leg.rail))])
        built = q - way @ along if leg.kind == "rail" else way[0] * begun[1] - way[1] * begun[0]
        assert np.sign(built) == leg.side


@pytest.mark.parametrize("name", MACHINES)
def test_a_machine_is_said_in_words_and_drawn_with_each_drive(name):
    machine = machine_of({"machine": name})
    assert machine._repr_markdown_().count("\n| ") == 3
    seen = " ".join(text.get_text() for text in draw_machine(machine).texts)
    assert all(f"${letter}_{i}$" in seen for letter in "AqB" for i in (1, 2, 3))


def test_the_ways_come_in_the_students_own_order():
    assert ways_of(MINE)[0] == MACHINES["press"].ways[5]
    assert sorted(ways_of(MINE)) == sorted(MACHINES["press"].ways)


SHOWN = {
    "drives": lambda answer: pictures.show_drives(answer, MACHINES["press"], POSE),
    "rates": lambda answer: pictures.show_rates(answer, lambda *pose: list(pose), POSE),
    "singular": lambda answer: pictures.show_singular_machine(answer, lambda *pose: [0.1, 0.2, 0.3], MACHINES["press"]),
    "ways": lambda answer: pictures.show_ways(answer, MINE),
}
RIGHT = {
    "drives": lambda *pose: [0.1, 0.4, 0.6],
    "rates": lambda *pose: np.eye(3),
    "singular": 0.5,
    "ways": lambda *way: 2,
}


def said(ax):
    return [text.get_text() for text in ax.texts]


@pytest.mark.slow
@pytest.mark.parametrize("name", SHOWN)
def test_answers_are_drawn_and_blanks_say_so(name):
    ax = SHOWN[name](RIGHT[name])
    ax.figure.canvas.draw()
    assert ax.patches
    assert said(SHOWN[name]((lambda *args: None) if callable(RIGHT[name]) else ...)) == ["not attempted yet"]
    assert "cannot be drawn" in said(SHOWN[name]("seven"))[0]


def test_a_rod_that_does_not_fit_is_named():
    machine = MACHINES["press"]
    fits = pictures.show_drives(lambda *pose: machine.drives, machine, machine.home)
    assert fits.get_title() == "every rod fits"
    wrong = pictures.show_drives(lambda *pose: [machine.drives[0] + 0.3, *machine.drives[1:]], machine, machine.home)
    assert "leg 1 by" in wrong.get_title() and "leg 3" not in wrong.get_title()


def test_the_rates_stand_beside_differences_of_the_drives():
    ax = SHOWN["rates"](RIGHT["rates"])
    heights = [bar.get_height() for bar in ax.patches]
    assert heights[:3] == pytest.approx(heights[3:], abs=1e-6)
