"""Drawings of serial robots: frames where the table says, every frame named once, bad input refused in words."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.transforms import Bbox
from mpl_toolkits.mplot3d import proj3d
from sympy import Matrix, pi, symbols

from dhkit.drawing import chain_frames, draw_chain, labels
from dhkit.drawing.view import to_pixels

t1, t2, t3, t4, t5, t6, a2, a3, d2, d4 = symbols("t1 t2 t3 t4 t5 t6 a2 a3 d2 d4")

RX90 = [
    [0, 0, 0, 0, t1],
    [0, 0, pi / 2, 0, t2],
    [0, a3, 0, 0, t3],
    [0, 0, -pi / 2, d4, t4],
    [0, 0, pi / 2, 0, t5],
    [0, 0, -pi / 2, 0, t6],
]
RX90_AT = {"t1": 0.3, "t2": 1.2, "t3": -0.4, "t4": 0.2, "t5": -0.7, "t6": 0.3, "a3": 0.45, "d4": 0.45}
KR210 = [
    [0, 0, 0, 0.75, 0],
    [0, 0.35, -np.pi / 2, 0, -np.pi / 2],
    [0, 1.25, 0, 0, 0],
    [0, -0.054, -np.pi / 2, 1.5, 0],
    [0, 0, np.pi / 2, 0, 0],
    [0, 0, -np.pi / 2, 0, 0],
    [0, 0, 0, 0.303, 0],
]
SCARA = [[0, 0, 0, 0, t1], [0, a2, 0, 0, t2], [1, a3, 0, -d2, 0], [0, 0, 0, 0, t4]]
SCARA_AT = {"t1": -0.4, "t2": 1.0, "d2": 0.2, "t4": -0.9, "a2": 0.4, "a3": 0.3}
WRIST = [[0, 0, 0, 0, 0.4], [0, 0, -np.pi / 2, 0, 0.6], [0, 0, np.pi / 2, 0, 0.7]]
PLANAR = [[0, 0, 0, 0, t1], [0, a2, 0, 0, t2], [0, a3, 0, 0, 0]]

ROBOTS = {
    "rx90": (RX90, RX90_AT, False),
    "kr210": (KR210, None, True),
    "scara": (SCARA, SCARA_AT, False),
    "scara_quill_up": (SCARA, SCARA_AT | {"d2": 0}, False),
    "wrist": (WRIST, None, False),
    "planar": (PLANAR, {"t1": 0.1, "t2": 1.0, "a2": 0.5, "a3": 0.4}, True),
    "one_prismatic": ([[1, 0, 0, 0.3, 0]], None, False),
}

pytestmark = pytest.mark.filterwarnings("error")


def texts(ax) -> list[str]:
    return [text.get_text() for text in ax.texts]


def boxes(ax) -> dict[str, Bbox]:
    """Where each label is on paper, in pixels."""
    ax.figure.canvas.draw()
    found = {}
    for text in ax.texts:
        x, y, _ = proj3d.proj_transform(*text.get_position_3d(), ax.get_proj())
        centre, size = ax.transData.transform((x, y)), text.get_window_extent().size
        found[text.get_text()] = Bbox([centre - size / 2, centre + size / 2])
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS)
def test_every_frame_is_named_and_every_label_lies_inside_the_figure(name):
    rows, values, tool = ROBOTS[name]
    ax = draw_chain(rows, values, tool=tool)
    named = "".join(texts(ax))
    last = "E" if tool else len(rows)
    assert all(f"{letter}_{{{i}}}" in named for letter in "XYZ" for i in [*range(len(rows)), last])
    for text, box in boxes(ax).items():
        assert ax.figure.bbox.contains(box.x0, box.y0) and ax.figure.bbox.contains(box.x1, box.y1), text


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS)
def test_scale_is_equal_on_the_three_axes(name):
    rows, values, tool = ROBOTS[name]
    ax = draw_chain(rows, values, tool=tool)
    spans = [np.ptp(limits) for limits in (ax.get_xlim(), ax.get_ylim(), ax.get_zlim())]
    ratio = ax._box_aspect / spans
    assert ratio == pytest.approx(np.full(3, ratio[0]))


def test_frames_follow_the_table():
    frames = chain_frames(KR210)
    assert frames.shape == (8, 4, 4)
    assert frames[-1, :3, 3] == pytest.approx([2.153, 0, 1.946])
    scara = chain_frames(Matrix(SCARA), SCARA_AT)
    assert scara[4, :3, 3] == pytest.approx(
        [0.4 * np.cos(0.4) + 0.3 * np.cos(0.6), -0.4 * np.sin(0.4) + 0.3 * np.sin(0.6), -0.2]
    )


def test_the_path_of_a_wrong_table_looks_different():
    right = draw_chain(KR210, tool=True, frames=())
    wrong = draw_chain([[0, 0, 0, 0.75, 0], [0, 0.35, np.pi / 2, 0, -np.pi / 2], *KR210[2:]], tool=True, frames=())
    assert np.ptp(right.get_zlim()) != pytest.approx(np.ptp(wrong.get_zlim()))


def test_one_can_choose_the_frames():
    assert not [text for text in texts(draw_chain(RX90, RX90_AT, frames=())) if "X" in text]
    shown = "".join(texts(draw_chain(RX90, RX90_AT, frames=(0, 3), axes=False)))
    assert "X_{3}" in shown and "X_{2}" not in shown and "Z_{2}" not in shown


def test_hidden_frames_leave_their_axis_a_name():
    assert {"$Z_{1}$", "$Z_{2}$", "$Z_{3}$"} <= set(texts(draw_chain(RX90, RX90_AT, frames=())))
    assert "$Z_{3}, Z_{4}$" in texts(draw_chain(SCARA, SCARA_AT, frames=()))


@pytest.mark.slow
def test_normals_carry_the_names_of_the_table_or_their_values():
    assert {"$a_{2}$", "$a_{3}$", "$- d_{2}$"} <= set(texts(draw_chain(SCARA, SCARA_AT, frames=(), normals=True)))
    numbers = texts(draw_chain(KR210, tool=True, frames=(), normals=True))
    assert {"$a_{2} = 1.25$", "$a_{3} = \N{MINUS SIGN}0.054$", "$d_{E} = 0.303$"} <= set(numbers)


def test_labels_of_a_posed_robot_keep_clear_of_each_other():
    ax = draw_chain(RX90, RX90_AT, frames=(0, 2, 3, 4))
    found = list(boxes(ax).items())
    for k, (text, box) in enumerate(found):
        for other, its in found[k + 1 :]:
            width = min(box.x1, its.x1) - max(box.x0, its.x0)
            height = min(box.y1, its.y1) - max(box.y0, its.y0)
            assert (
                width < 2 or height < 2 or width * height < 0.2 * min(box.width * box.height, its.width * its.height)
            ), (
                text,
                other,
            )


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda: draw_chain(SCARA, {"t1": 0}), "values: expected a number for a2, a3, d2, t2, t4, found none"),
        (lambda: draw_chain([[0, 1, 2, 3]]), "table with rows .* expected n x 5 numbers, found 1 x 4"),
        (lambda: draw_chain([[2, 0, 0, 0, 0]]), "sigma: expected 0"),
        (lambda: draw_chain([[0, ..., 0, 0, 0]]), "table with rows"),
        (lambda: draw_chain(...), "table: expected rows"),
        (lambda: draw_chain([]), "table"),
        (lambda: draw_chain(KR210, tool=True, frames=(9,)), "frames: expected indices from 0 to 7, found 9"),
        (lambda: draw_chain(WRIST, names=("0", "1")), "names: expected 4"),
    ],
)
def test_bad_input_is_refused_in_words(draw, message):
    with pytest.raises(ValueError, match=message):
        draw()
    assert not plt.get_fignums()


def test_a_robot_can_be_drawn_into_given_axes():
    figure = plt.figure()
    ax = figure.add_subplot(projection="3d")
    assert draw_chain(RX90, RX90_AT, ax) is ax
    x, y, _ = proj3d.proj_transform(0, 0, 0, ax.get_proj())
    assert np.isfinite([x, y]).all()


SHOULDER_UP = {f"t{i}": angle for i, angle in enumerate(np.radians([-20, 55, -30, 20, 60, 0]), 1)} | {
    "a3": 0.45,
    "d4": 0.45,
}
NAMED = {
    "rx90": (RX90, SHOULDER_UP, {"frames": ()}),
    "rx90 with lengths": (RX90, SHOULDER_UP, {"frames": (), "normals": True}),
    "rx90 with frames": (RX90, SHOULDER_UP, {"frames": (0, 3, 6)}),
    "planar": (PLANAR, {"t1": 0.5, "t2": 0.7, "a2": 0.5, "a3": 0.4}, {"tool": True, "normals": True}),
}


@pytest.mark.parametrize("name", NAMED)
def test_a_label_stands_nearest_to_what_it_names(name, monkeypatch):
    rows, values, options = NAMED[name]
    asked = []
    ask = labels.Labels.ask
    monkeypatch.setattr(
        labels.Labels, "ask", lambda self, at, *rest, **more: asked.append(at) or ask(self, at, *rest, **more)
    )
    ax = draw_chain(rows, values, **options)
    anchors, places = to_pixels(ax, asked), to_pixels(ax, [text.get_position_3d() for text in ax.texts])
    for k, (text, place) in enumerate(zip(ax.texts, places, strict=True)):
        away = np.linalg.norm(anchors - place, axis=1)
        assert away[k] <= away.min() + 1, (
            f"{text.get_text()} stands at the place of {ax.texts[int(away.argmin())].get_text()}"
        )
