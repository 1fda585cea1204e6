"""Drawings of printed tables: both readings of the planar table, joint origins from the side."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest

from dhkit.drawing import tables

pytestmark = pytest.mark.filterwarnings("error")
AXES = ["z", "y", "x", ""]
ORIGINS = [(0, 0, 0.3), (0.2, 0, 0.8), (1.0, 0, 0.7), (1.2, 0, 0.7)]


def place(ax, text) -> np.ndarray:
    return np.array(next(t for t in ax.texts if t.get_text() == text).get_position())


def test_second_angle_moves_the_arm_only_in_the_classic_reading():
    def ends(q):
        return [place(ax, "$O_2$") for ax in tables.draw_two_readings((0.5, 0.4), q)]

    (classic, modified), (bent_classic, bent_modified) = ends((0.6, 0.2)), ends((0.6, 1.2))
    assert np.linalg.norm(classic - bent_classic) > 0.2
    assert modified == pytest.approx(bent_modified)


def test_each_joint_origin_is_marked_where_it_is():
    ax = tables.draw_joint_origins(ORIGINS, AXES)
    marked = {
        tuple(np.ravel(line.get_data()))
        for line in ax.lines
        if line.get_marker() in "oD" and len(line.get_xdata()) == 1
    }
    assert marked == {(x, z) for x, _, z in ORIGINS}


def test_frames_are_drawn_in_the_plane_of_x_and_z():
    frame = np.eye(4)
    frame[:3, :3] = [[0, 0, 1], [0, -1, 0], [1, 0, 0]]  # X up, Z forward
    frame[:3, 3] = 0.5, 0, 0.5
    ax = tables.draw_joint_origins(ORIGINS, AXES, frames=[np.eye(4), frame], size=0.2)
    up, forward = place(ax, "$X_1$") - 0.5, place(ax, "$Z_1$") - 0.5
    assert up[1] > 0.15 and abs(up[0]) < 0.1
    assert forward[0] > 0.15 and abs(forward[1]) < 0.1


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda: tables.draw_two_readings((0.5, -0.4)), "lengths must be positive"),
        (lambda: tables.draw_joint_origins(ORIGINS, ["z", "y"]), "axes: expected 4 of x, y, z, found"),
        (lambda: tables.draw_joint_origins(ORIGINS, AXES, frames=np.eye(4)), "frames: expected n x 4 x 4 numbers"),
    ],
)
def test_bad_input_is_refused_in_words(draw, message):
    with pytest.raises(ValueError, match=message):
        draw()
