"""Walks from frame to frame: they end where the product of the four matrices says, and are drawn there."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from mpl_toolkits.mplot3d import proj3d

from dhkit.drawing import transforms

A, ALPHA, D, THETA = 0.7, 0.6, 1.1, 0.9
WALK = [("trans_x", A), ("rot_x", ALPHA), ("trans_z", D), ("rot_z", THETA)]

pytestmark = pytest.mark.filterwarnings("error")


def texts(ax) -> dict:
    return {text.get_text(): text for text in ax.texts}


def test_a_walk_ends_on_the_modified_dh_frame():
    c, s, ca, sa = np.cos(THETA), np.sin(THETA), np.cos(ALPHA), np.sin(ALPHA)
    expected = [[c, -s, 0, A], [s * ca, c * ca, -sa, -D * sa], [s * sa, c * sa, ca, D * ca], [0, 0, 0, 1]]
    assert transforms.walk_frames(WALK)[-1] == pytest.approx(np.array(expected))


def test_axes_of_the_last_frame_are_labelled_where_the_walk_ends():
    ax = transforms.draw_walk(WALK, size=0.5)
    frame = transforms.walk_frames(WALK)[-1]
    for letter, axis in zip("XYZ", frame[:3, :3].T):
        at = texts(ax)[f"${letter}_{{i}}$"].get_position_3d()
        assert at == pytest.approx(frame[:3, 3] + 1.28 * 0.5 * axis)


def test_progress_stops_on_the_way_and_keeps_the_view():
    halfway = transforms.draw_walk(WALK, progress=1)
    at = texts(halfway)["$X_{i}$"].get_position_3d()
    assert at == pytest.approx((A + 1.28 * 0.5, 0, 0))
    assert not {r"$\theta$", "$d$"} & set(texts(halfway))
    assert halfway.get_xlim() == transforms.draw_walk(WALK).get_xlim()


def test_both_orders_end_at_different_places():
    left, right = (texts(ax)["$X_{B}$"].get_position_3d() for ax in transforms.draw_two_orders())
    assert np.linalg.norm(np.subtract(left, right)) > 0.5


def test_point_is_drawn_where_its_transform_sends_it():
    ax = transforms.draw_point_in_two_frames((1, 2), np.pi / 2, (0.5, 0.25))
    point = [line for line in ax.lines if line.get_marker() == "o" and line.get_markersize() == 7]
    assert np.ravel(point[0].get_data()) == pytest.approx((0.75, 2.5))


def test_conventions_put_frame_i_on_joint_i_or_on_the_next():
    modified, classic = (texts(ax) for ax in transforms.draw_conventions())
    for joint, panel in (("i", modified), ("i+1", classic)):
        axis = panel[f"axis of joint ${joint}$"].get_position()[0]
        assert panel["$z_i$"].get_position()[0] == pytest.approx(axis, abs=0.1)


@pytest.mark.parametrize("draw", [lambda: transforms.draw_walk(WALK), transforms.draw_elementary_moves])
def test_every_label_lies_inside_its_figure(draw):
    drawn = draw()
    for ax in drawn if isinstance(drawn, list) else [drawn]:
        ax.figure.canvas.draw()
        for text in ax.texts:
            x, y, _ = proj3d.proj_transform(*text.get_position_3d(), ax.get_proj())
            across, up = ax.transData.transform((x, y)) / ax.figure.bbox.size
            assert 0.01 < across < 0.99 and 0.01 < up < 0.99, text.get_text()


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (
            lambda: transforms.draw_walk([("rot_y", 1.0)]),
            "moves: expected one of trans_x, rot_x, trans_z, rot_z, found 'rot_y'",
        ),
        (lambda: transforms.draw_walk([("rot_x", "a")]), "rot_x: expected"),
        (lambda: transforms.draw_walk(WALK, labels=["a"]), "labels: expected 4, found 1"),
        (lambda: transforms.draw_point_in_two_frames((1, 2, 3)), "shift: expected 2 numbers, found 3"),
    ],
)
def test_bad_input_is_refused_in_words(draw, message):
    with pytest.raises(ValueError, match=message):
        draw()
    assert not plt.get_fignums()
