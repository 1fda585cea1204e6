"""Pictures of a student's transforms: a right result lies on what it should, a wrong one beside it, a blank says so."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
import sympy

from dhkit.drawing.style import SOFT
from dhkit.drawing.transforms import walk_frames
from dhkit.geometry import modified_dh, rigid_transform, rotation
from dhkit.pictures import transforms as pictures

SYMBOLS = a, alpha, d, theta = sympy.symbols("a alpha d theta")
VALUES = {"a": 1.0, "alpha": 0.7, "d": 1.1, "theta": 1.2}
WALK = ("rot_x", "trans_x", "rot_z", "trans_z")
MATRIX = walk_frames([("trans_x", 1.0), ("rot_x", 0.7), ("trans_z", 1.1), ("rot_z", 1.2)])[-1]
CLASSIC = walk_frames([("rot_z", 1.2), ("trans_z", 1.1), ("trans_x", 1.0), ("rot_x", 0.7)])[-1]

CELL = {
    "cx": 0.7, "cy": 0.2, "cz": 1.3, "u": -0.1, "v": 0.1, "w": 1.0, "psi": 30, "a": 0.4, "alpha": 130, "d": -0.3, "theta": 40,
}  # fmt: skip

pytestmark = pytest.mark.filterwarnings("error")


def shadow(ax) -> np.ndarray:
    """Origin of the grey frame."""
    lines = [line for line in ax.lines if line.get_color() == SOFT and line.get_linewidth() == 7]
    assert len(lines) == 3
    return np.array([line.get_data_3d() for line in lines])[0, :, 0]


def drawn_origin(ax, name) -> np.ndarray:
    """Origin of a coloured frame, from the labels of its axes."""
    labels = {text.get_text(): np.array(text.get_position_3d()) for text in ax.texts}
    x, y, z = (labels[f"${letter}_{{{name}}}$"] for letter in "XYZ")
    frame = np.array([x, y, z])
    return frame.mean(axis=0) - 1.28 * pictures.SIZE * MATRIX[:3, :3].sum(axis=1) / 3


def read_out(T):
    T = np.array(T)
    return [T[0, 3], np.arctan2(-T[1, 2], T[2, 2]), T[:3, 3] @ T[:3, 2], np.arctan2(-T[0, 1], T[0, 0])]


def test_a_right_walk_ends_on_the_shadow_and_the_misprint_beside_it():
    right = pictures.show_walk([alpha, a, theta, d], WALK, VALUES)
    assert drawn_origin(right, "i") == pytest.approx(shadow(right))
    printed = pictures.show_walk([alpha, alpha, theta, d], WALK, VALUES)
    assert np.linalg.norm(drawn_origin(printed, "i") - shadow(printed)) > 0.2


def test_a_right_transform_leads_from_the_gripper_to_the_part():
    camera = rigid_transform([[0, 1, 0], [1, 0, 0], [0, 0, -1]], [CELL[name] for name in ("cx", "cy", "cz")])
    part = camera @ rigid_transform(rotation("z", np.pi / 6), [CELL[name] for name in "uvw"])
    gripper = modified_dh(CELL["a"], np.radians(CELL["alpha"]), CELL["d"], np.radians(CELL["theta"]))
    right = pictures.show_way_to_part(np.linalg.inv(gripper) @ part, CELL)
    assert shadow(right) == pytest.approx(part[:3, 3])
    assert np.linalg.norm(shadow(pictures.show_way_to_part(gripper @ part, CELL)) - part[:3, 3]) > 0.2


@pytest.mark.parametrize(("row", "q"), [([0, 1.0, 0.7, 1.1, 0.5], 0.7), ([1, 1.0, 0.7, 0.4, 1.2], 0.7)])
def test_a_right_function_of_a_row_ends_on_the_walk(row, q):
    right = pictures.show_own_dhm(lambda row, q: MATRIX, row, q)
    assert drawn_origin(right, "i") == pytest.approx(shadow(right))
    wrong = pictures.show_own_dhm(lambda row, q: CLASSIC, row, q)
    assert np.linalg.norm(drawn_origin(wrong, "i") - shadow(wrong)) > 0.2


def test_the_shadow_of_a_classic_matrix_is_its_own_frame():
    assert shadow(pictures.show_classic_matrix(CLASSIC, VALUES)) == pytest.approx(CLASSIC[:3, 3])
    assert shadow(pictures.show_classic_matrix(MATRIX, VALUES)) == pytest.approx(MATRIX[:3, 3])


def test_numbers_read_out_of_a_matrix_walk_to_its_frame():
    ax = pictures.show_parameters(read_out, VALUES)
    assert drawn_origin(ax, "i") == pytest.approx(shadow(ax))


def test_the_cross_stands_at_the_coordinates_given():
    ax = pictures.show_point([0.2, 0.9], (0.7, 0.3), 0.5, (0.4, 0.2))
    cross = next(line for line in ax.lines if line.get_marker() == "x")
    assert np.ravel(cross.get_data()) == pytest.approx([0.2, 0.9])


@pytest.mark.parametrize(
    ("picture", "says"),
    [
        (lambda: pictures.show_point([..., ...], (0.7, 0.3), 0.5, (0.4, 0.2)), "not attempted yet"),
        (lambda: pictures.show_walk([...] * 4, WALK, VALUES), "not attempted yet"),
        (lambda: pictures.show_way_to_part(..., CELL), "not attempted yet"),
        (lambda: pictures.show_own_dhm(lambda row, q: None, [0] * 5, 0), "not attempted yet"),
        (lambda: pictures.show_classic_matrix(..., VALUES), "not attempted yet"),
        (lambda: pictures.show_parameters(lambda T: None, VALUES), "not attempted yet"),
        (lambda: pictures.show_parameters(lambda T: 1 / 0, VALUES), "division by zero"),
        (lambda: pictures.show_walk([alpha, sympy.Symbol("b"), theta, d], WALK, VALUES), "the symbol b"),
        (lambda: pictures.show_way_to_part([[1, 2], [3, 4]], CELL), "expected 4 x 4"),
    ],
)
def test_what_cannot_be_drawn_is_said_on_a_card(picture, says):
    assert says in picture().texts[0].get_text()
