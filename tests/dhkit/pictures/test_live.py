"""Pictures of a student's own result have a live scene beside them where somebody watches, and nowhere else."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
import sympy

from dhkit.pictures import inverse_models, live, parallel_robots, planar, tables
from dhkit.scene import ParallelScene, Scene

t1, t2, a2 = sympy.symbols("t1 t2 a2")
PLANAR = [[0, 0, 0, 0, t1], [0, a2, 0, 0, t2], [0, 0.4, 0, 0, 0]]
VALUES = {"t1": 0.3, "t2": 0.9, "a2": 0.5}
BASE, PLATFORM = [[0, 0], [1, 0], [0.3, 0.6]], [[-0.2, -0.2], [0.2, -0.2], [0.1, 0.3]]


def arm(t1, t2, l1=0.5, l2=0.4):
    return [[0, 0, 0, 0, t1], [0, l1, 0, 0, t2], [0, l2, 0, 0, 0]]


def elbows(hand):
    x, y = hand[:2, 3]
    cosine = (x**2 + y**2 - 0.41) / 0.4
    bend = np.arccos(np.clip(cosine, -1, 1))
    return (
        []
        if abs(cosine) > 1
        else [(np.arctan2(y, x) - np.arctan2(0.4 * np.sin(t), 0.5 + 0.4 * np.cos(t)), t) for t in (bend, -bend)]
    )


HAND = Scene(PLANAR, VALUES).arm.hands(np.array([0.3, 0.9]))


def in_the_plane(x, y, l1, l2):
    return elbows(np.array([[0, 0, 0, x], [0, 0, 0, y]]))


SHOWN = {
    "table": lambda: tables.show_table(PLANAR, VALUES, tool=True),
    "chain": lambda: tables.show_chain(PLANAR, VALUES, tool=True),
    "postures": lambda: inverse_models.show_all_postures([[0.3, 0.9]], arm, HAND),
    "inverse": lambda: inverse_models.show_inverse_of_pose(elbows, arm, HAND),
    "planar": lambda: planar.show_postures([[0.3, 0.9]], (0.5, 0.4), HAND[:2, 3]),
    "everywhere": lambda: planar.show_inverse(in_the_plane, (0.5, 0.4)),
    "modes": lambda: parallel_robots.show_modes([(0.55, 0.6, 0.35)], BASE, PLATFORM, (0.55, 0.52, 0.4)),
}


@pytest.fixture
def shown(monkeypatch):
    seen = []
    monkeypatch.setattr(live, "display", seen.append)
    yield seen
    plt.close("all")


@pytest.mark.parametrize("name", SHOWN)
def test_a_result_can_be_turned_where_somebody_watches(name, shown, monkeypatch):
    monkeypatch.setattr(live, "is_watched", lambda: True)
    SHOWN[name]()
    (scene,) = shown
    assert isinstance(scene, ParallelScene if name == "modes" else Scene)
    state = scene.state()
    if name in ("table", "chain"):
        assert scene.q == [0.3, 0.9]
    if name in ("inverse", "everywhere"):
        assert len(state["ghosts"]) == 2


def test_where_nobody_watches_there_is_the_picture_alone(shown):
    SHOWN["inverse"]()
    assert not shown


def test_a_result_of_which_no_scene_can_be_made_has_its_picture(shown, monkeypatch):
    monkeypatch.setattr(live, "is_watched", lambda: True)
    assert tables.show_chain([[0, 0, 0, 0, sympy.sin(t1)], [0, 0.5, 0, 0, t2]], VALUES).lines
    assert not shown
