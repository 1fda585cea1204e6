"""The drawings run headless, hold what they promise, and refuse bad input in words."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.patches import Circle
from mpl_toolkits.mplot3d import proj3d

from dhkit import drawing
from dhkit.drawing.style import styled

Q = (0.6, 0.9)
LENGTHS = (0.5, 0.4)

pytestmark = pytest.mark.filterwarnings("error")


def texts(ax) -> list[str]:
    return [text.get_text() for text in ax.texts]


def legend(ax) -> list[str]:
    return [text.get_text() for text in ax.get_legend().get_texts()]


DRAWINGS = {
    "planar_arm": lambda ax: drawing.draw_planar_arm(LENGTHS, Q, ax=ax),
    "postures": lambda ax: drawing.draw_postures(LENGTHS, [(0.1, 1.0), (0.9, -1.0)], (0.5, 0.4), ax=ax),
    "no_posture": lambda ax: drawing.draw_postures(LENGTHS, [], (2.0, 0.4), ax=ax),
    "workspace": lambda ax: drawing.draw_workspace_2r(LENGTHS, [(-1, 2), (0, 2.5)], ax=ax),
    "triangle": lambda ax: drawing.draw_triangle_2r(LENGTHS, Q, ax=ax),
    "scara_side": lambda ax: drawing.draw_scara_side(ax=ax),
    "scara_top": lambda ax: drawing.draw_scara_top(ax=ax),
    "scara_projections": lambda ax: drawing.draw_scara_projections(ax=ax),
}
DRAWINGS_3D = {
    "frames": lambda ax: drawing.draw_frames_3d([np.eye(4), drawing.scara_frames((1, 2, 0.1, 3), 0.4, 0.3)[4]], ax=ax),
    "scara": lambda ax: drawing.draw_scara_3d(ax=ax),
    "scara_quill_up": lambda ax: drawing.draw_scara_3d((0.1, 0.2, 0.0, 0.3), ax=ax),
    "dh_parameters": lambda ax: drawing.draw_dh_parameters(ax=ax),
}


@pytest.mark.parametrize("name", DRAWINGS)
def test_plane_drawing_uses_the_given_axes_and_equal_scale(name):
    ax = plt.subplots()[1]
    assert DRAWINGS[name](ax) is ax
    assert ax.get_aspect() == 1
    ax.figure.canvas.draw()


@pytest.mark.slow
@pytest.mark.parametrize("name", [*DRAWINGS, *DRAWINGS_3D])
def test_drawing_makes_one_figure_of_its_own(name):
    ax = (DRAWINGS | DRAWINGS_3D)[name](None)
    assert plt.get_fignums() == [ax.figure.number]
    ax.figure.canvas.draw()


@pytest.mark.parametrize("name", DRAWINGS_3D)
def test_space_drawing_has_equal_scale_on_its_three_axes(name):
    ax = DRAWINGS_3D[name](None)
    spans = [np.ptp(limits) for limits in (ax.get_xlim(), ax.get_ylim(), ax.get_zlim())]
    ratio = ax._box_aspect / spans
    assert ratio == pytest.approx(np.full(3, ratio[0]))


@pytest.mark.slow
@pytest.mark.parametrize("name", DRAWINGS_3D)
def test_every_label_of_a_space_drawing_lies_inside_its_figure(name):
    ax = DRAWINGS_3D[name](None)
    ax.figure.canvas.draw()
    for text in ax.texts:
        x, y, _ = proj3d.proj_transform(*text.get_position_3d(), ax.get_proj())
        across, up = ax.transData.transform((x, y)) / ax.figure.bbox.size
        assert 0.02 < across < 0.98 and 0.02 < up < 0.98, text.get_text()


def test_drawing_leaves_the_readers_settings_alone():
    before = dict(plt.rcParams)
    drawing.draw_scara_side()
    assert dict(plt.rcParams) == before


def test_drawing_keeps_the_interactive_mode_that_a_backend_sets_meanwhile():
    @styled
    def load_backend():
        plt.ion()

    try:
        load_backend()
        assert plt.isinteractive()
    finally:
        plt.ioff()


def test_planar_arm_names_every_angle_and_length():
    assert {r"$\theta_1$", r"$\theta_2$", "$L_1$", "$L_2$", "$P$", "$x_0$", "$y_0$"} <= set(
        texts(drawing.draw_planar_arm(LENGTHS, Q))
    )


@pytest.mark.parametrize("count", [1, 2, 4])
def test_postures_have_one_legend_entry_and_one_number_each(count):
    ax = drawing.draw_postures(LENGTHS, [(0.3 * k, 1.0) for k in range(count)])
    assert len(legend(ax)) == count
    assert [text for text in texts(ax) if text.isdigit()] == [str(k + 1) for k in range(count)]


def test_workspace_draws_both_limits_and_no_hole_for_equal_links():
    def radii(lengths):
        circles = [patch for patch in drawing.draw_workspace_2r(lengths).patches if isinstance(patch, Circle)]
        return sorted(circle.get_radius() for circle in circles)

    assert radii((0.5, 0.4)) == pytest.approx([0.1, 0.9])
    assert radii((0.3, 0.5)) == pytest.approx([0.2, 0.8])
    assert radii((0.4, 0.4)) == pytest.approx([0.8])


def test_scara_side_view_shows_all_frames_and_dimensions():
    shown = set(texts(drawing.draw_scara_side()))
    assert {"$a_2$", "$a_3$", "$d_2$", "$Z_0, Z_1$", "$Z_2$", "$Z_3, Z_4$", "$X_0, X_1$", "$X_3, X_4$"} <= shown


def test_scara_frames_follow_the_slides():
    frames = drawing.scara_frames((np.pi / 2, -np.pi / 2, 0.1, 0.3), 0.4, 0.3)
    assert frames[4][:3, 3] == pytest.approx([0.3, 0.4, -0.1])
    assert frames[4][:2, 0] == pytest.approx([np.cos(0.3), np.sin(0.3)])
    assert np.linalg.det(frames[:, :3, :3]) == pytest.approx(np.ones(5))


def test_coinciding_axes_share_one_label():
    ax = drawing.draw_frames_3d([np.eye(4), np.eye(4)])
    assert sorted(texts(ax)) == ["$X_{0}, X_{1}$", "$Y_{0}, Y_{1}$", "$Z_{0}, Z_{1}$"]


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda: drawing.draw_planar_arm(LENGTHS, [1, 2, 3]), "joint angles: expected 2 numbers, found 3"),
        (lambda: drawing.draw_planar_arm((0.5, -0.4), Q), "lengths must be positive"),
        (lambda: drawing.draw_planar_arm("long", Q), "expected n numbers, found 'long'"),
        (lambda: drawing.draw_planar_arm(LENGTHS, (1, float("nan"))), "not a finite number"),
        (lambda: drawing.draw_postures(LENGTHS, [(1, 2, 3)]), "solutions: expected n x 2 numbers, found 1 x 3"),
        (lambda: drawing.draw_workspace_2r(LENGTHS, [(0, 1)]), "limits: expected 2 x 2 numbers, found 1 x 2"),
        (lambda: drawing.draw_frames_3d([np.eye(3)]), "transforms: expected n x 4 x 4 numbers"),
        (lambda: drawing.draw_frames_3d([np.eye(4)], ["0", "1"]), "names: expected 1, found 2"),
        (lambda: drawing.draw_scara_3d((1, 2, 3)), "t1, t2, d2, t4: expected 4 numbers, found 3"),
    ],
)
def test_bad_input_is_refused_in_words(draw, message):
    with pytest.raises(ValueError, match=message):
        draw()
    assert not plt.get_fignums()
