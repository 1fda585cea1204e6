"""Drawings of an inverse model's answers: every posture is there, at its place, and bad input is refused in words."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from mpl_toolkits.mplot3d import proj3d

from dhkit.drawing import postures

H = np.pi / 2
ELBOW = [(0.3, 0.2, 1.2), (0.3 + np.pi, np.pi - 0.2, -1.2)]

pytestmark = pytest.mark.filterwarnings("error")


def rx90(t1, t2, t3, t4, t5, t6):
    return [
        [0, 0, 0, 0, t1],
        [0, 0, H, 0, t2],
        [0, 0.45, 0, 0, t3],
        [0, 0, -H, 0.45, t4],
        [0, 0, H, 0, t5],
        [0, 0, -H, 0, t6],
    ]


TABLES = [rx90(0.3, 0.6, -0.4, 0.2 * k, 0.9, 0.1) for k in range(5)]
IN_SPACE = {
    "gallery": lambda ax=None: postures.draw_posture_gallery(TABLES, ax=ax),
    "gallery_of_short_arms": lambda ax=None: postures.draw_posture_gallery([TABLES[0][:3]], ["one"], ax=ax),
    "family": lambda ax=None: postures.draw_posture_family(TABLES, ax=ax),
    "wrist": lambda ax=None: postures.draw_aligned_wrist([-0.5, 0.5], 1.0, ax=ax),
}
IN_PLANE = {
    "arm_plane": lambda ax=None: postures.draw_arm_plane((0.5, 0.4), ELBOW, ax=ax),
    "no_posture": lambda ax=None: postures.draw_arm_plane((0.5, 0.4), [], (2.0, 0.0, 0.1), ax=ax),
    "shoulder": lambda ax=None: postures.draw_shoulder_top(0.15, (0.4, 0.2), ax=ax),
    "planar_family": lambda ax=None: postures.draw_planar_family((0.4, 0.3, 0.2), [(0.1, 0.2, 0.3)], (0.4, 0.3), ax=ax),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", IN_PLANE)
def test_plane_drawing_uses_the_given_axes_and_equal_scale(name):
    ax = plt.subplots()[1]
    assert IN_PLANE[name](ax) is ax and ax.get_aspect() == 1
    ax.figure.canvas.draw()


@pytest.mark.parametrize("name", IN_SPACE)
def test_labels_of_a_space_drawing_lie_inside_its_figure(name):
    ax = IN_SPACE[name]()
    ax.figure.canvas.draw()
    for text in ax.texts:
        x, y, _ = proj3d.proj_transform(*text.get_position_3d(), ax.get_proj())
        across, up = ax.transData.transform((x, y)) / ax.figure.bbox.size
        assert 0.02 < across < 0.98 and 0.02 < up < 0.98, text.get_text()


def test_gallery_names_every_posture_below_it():
    ax = postures.draw_posture_gallery(TABLES, list("abcde"), columns=2)
    ax.figure.canvas.draw()
    seen = {text.get_text(): proj3d.proj_transform(*text.get_position_3d(), ax.get_proj())[:2] for text in ax.texts}
    assert list(seen) == list("abcde")
    assert seen["a"][0] < seen["b"][0] and seen["a"][1] > seen["c"][1]
    assert seen["a"][0] == pytest.approx(seen["c"][0]) and seen["a"][1] == pytest.approx(seen["b"][1])


def test_both_elbow_postures_end_on_one_target():
    ax = postures.draw_arm_plane((0.5, 0.4), ELBOW)
    reach = 0.5 * np.cos(0.2) + 0.4 * np.cos(1.4), 0.5 * np.sin(0.2) + 0.4 * np.sin(1.4)
    marks = [line for line in ax.lines if line.get_marker() == "+"]
    assert np.ravel([marks[0].get_xdata(), marks[0].get_ydata()]) == pytest.approx(reach)
    ends = [np.array(line.get_xydata())[-1] for line in ax.lines if len(line.get_xdata()) == 2]
    assert sum(np.allclose(end, reach) for end in ends) == 4  # outline and fill of both forearms
    assert "1, 2" in [text.get_text() for text in ax.texts]


def test_both_shoulders_keep_their_distance_from_the_axis():
    ax = postures.draw_shoulder_top(0.15, (0.4, 0.2))
    pairs = [line.get_xydata() for line in ax.lines if len(line.get_xydata()) == 2]
    for foot in {tuple(end) for start, end in pairs if np.allclose(start, 0) and np.isclose(np.hypot(*end), 0.15)}:
        fore = [end for start, end in pairs if np.allclose(start, foot) and np.allclose(end, (0.4, 0.2))]
        assert fore and np.dot(foot, fore[0] - foot) == pytest.approx(0)
    assert len({tuple(end) for start, end in pairs if np.isclose(np.hypot(*end), 0.15)}) == 2


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda: postures.draw_posture_gallery([]), "tables: expected at least one table"),
        (lambda: postures.draw_posture_gallery([[[0, 1, 2]]]), "table 1: expected n x 5 numbers, found 1 x 3"),
        (lambda: postures.draw_posture_gallery(TABLES, ["one"]), "names: expected 5, found 1"),
        (lambda: postures.draw_arm_plane((0.5, 0.4), []), "target: expected 3 numbers"),
        (lambda: postures.draw_arm_plane((0.5, 0.4), [(1, 2)]), "solutions: expected n x 3 numbers"),
        (lambda: postures.draw_shoulder_top(0.15, (0.1, 0.0)), "outside the circle of radius 0.15"),
        (lambda: postures.draw_aligned_wrist([]), "at least one value of t4"),
    ],
)
def test_bad_input_is_refused_in_words(draw, message):
    with pytest.raises(ValueError, match=message):
        draw()
    assert not plt.get_fignums()
