"""What the lectures say of their own functions and drawings, where it once was not so."""

import ast
from functools import cache
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import nbformat
import numpy as np
import pytest

LECTURES = Path(__file__).parents[2] / "course"


@cache
def lecture(number: str) -> dict:
    """The names that a lecture defines; what only shows something is left out."""
    (path,) = LECTURES.glob(f"{number}_*.ipynb")
    names: dict = {}
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "code":
            tree = ast.parse(cell.source)
            tree.body = [line for line in tree.body if not isinstance(line, (ast.Expr, ast.For))]
            exec(compile(tree, cell.id, "exec"), names)
    return names


@pytest.mark.parametrize("phi", [np.pi, np.pi - 1e-7, np.pi - 1e-11, np.radians(179.9), 0.0, 1.2])
def test_11_the_direct_model_of_the_3rpr_loses_no_pose(phi):
    names = lecture("11")
    for x, y in np.random.default_rng(3).uniform((0.3, 0.3), (0.9, 0.9), (40, 2)):
        lengths = names["leg_lengths"](x, y, phi)
        poses = np.array(names["direct"](lengths))
        turned = abs(np.exp(1j * poses[:, 2]) - np.exp(1j * phi))
        assert np.min(np.hypot(*(poses[:, :2] - (x, y)).T) + turned) < 1e-5
        assert len(poses) % 2 == 0, "modes come and go in pairs"
        assert all(np.allclose(names["leg_lengths"](*pose), lengths, atol=1e-6) for pose in poses)


def test_11_with_legs_1_and_2_locked_the_platform_has_two_loops():
    names = lecture("11")
    A, b, (q1, q2, _) = names["A"], names["b"], names["lengths"]
    sides = []
    for angle in np.linspace(-np.pi, np.pi, 181):
        apart = np.hypot(*(A[1] - A[0] - rotation(angle) @ (b[1] - b[0])))
        assert abs(q1 - q2) < 0.6 - 1e-9 <= apart <= 1.4 + 1e-9 < q1 + q2
    for x, y, phi in names["modes"]:
        centre, first = A[1] - A[0] - rotation(phi) @ (b[1] - b[0]), (x, y) + rotation(phi) @ b[0] - A[0]
        sides.append(centre[0] * first[1] - centre[1] * first[0] > 0)
    assert sorted([sides.count(True), sides.count(False)]) == [2, 4]


def rotation(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


@pytest.mark.parametrize("q3, count", [(0.25, 0), (0.5, 2), (0.84, 4), (0.9, 6), (0.99, 4), (1.3, 2), (1.59, 0)])
def test_11_counts_of_modes_for_the_third_leg(q3, count):
    assert len(lecture("11")["direct"]((1.0, 0.5, q3))) == count


def test_08_on_the_cylinder_both_shoulders_of_the_puma_merge():
    names = lecture("08")
    draw = np.random.default_rng(4).uniform(-np.pi, np.pi, (60, 6))
    for t1, _, t3, *wrist in draw:
        # the forearm bends back so far that the wrist centre is beside axis 1: a2 C2 + f cos(t2 + t3 + delta) = 0
        f, delta = np.hypot(0.02, 0.43), np.arctan2(0.43, 0.02)
        t2 = np.arctan2(0.43 + f * np.cos(t3 + delta), f * np.sin(t3 + delta))
        pose = names["pose"](names["puma"](t1, t2, t3, *wrist))
        postures = names["inverse_puma"](pose)
        assert len(postures) == len(distinct(postures)) == 4
        assert all(abs(names["pose"](names["puma"](*q)) - pose).max() < 1e-6 for q in postures)


def test_08_inside_the_cylinder_the_puma_finds_nothing():
    names = lecture("08")
    pose = np.eye(4)
    pose[:3, 3] = 0.1, 0.05, 0.5 + 0.06
    assert names["inverse_puma"](pose) == []


def test_08_a_hand_on_axis_1_leaves_two_representatives_of_the_elbow_arm():
    names = lecture("08")
    postures = names["inverse_elbow"](0, 0, 0.6)
    assert len(postures) == len(distinct(postures)) == 2 and {q[0] for q in postures} == {0.0}
    assert all(np.allclose(names["pose"](names["elbow"](*q))[:3, 3], (0, 0, 0.6)) for q in postures)


@pytest.mark.parametrize(
    "r, count", [(0.09, 8), (0.11, 4), (0.59, 4), (0.61, 8), (2.39, 8), (2.41, 4), (3.09, 4), (3.11, 0)]
)
def test_08_postures_of_the_kr210_at_the_height_of_axis_2(r, count):
    names = lecture("08")
    pose = names["pose"](names["kr210"](*np.radians([25, -40, 30, 15, 50, -20])))
    pose[:3, 3] = (r, 0, 0.75) + 0.303 * pose[:3, 2]
    assert len(names["inverse_kr210"](pose)) == count


def test_02_the_sliders_reach_what_is_asked():
    from dhkit.interactive import step_of

    cell = next(
        c for c in nbformat.read(LECTURES / "02_transforms.ipynb", as_version=4).cells if c.id == "frame-sliders"
    )
    call = ast.parse(cell.source).body[-1].value
    ranges = {word.arg: ast.literal_eval(word.value) for word in call.keywords}
    for low, high, start in ranges.values():
        assert low <= 0 <= high and round(low / step_of(low, high, start), 6) % 1 == 0
    turn, x, y = np.radians(60), 0.53, -0.33  # another way, by a turn about the point itself
    assert np.allclose(rotation(turn) @ (0.55, 0.3) + (x, y), (0.55, 0.3), atol=0.01)
    assert all(low <= value <= high for value, (low, high, _) in zip((60, x, y), ranges.values()))


def test_09_two_arms_reach_the_start_of_the_slider():
    from dhkit.drawing.workspace import count_postures

    names = lecture("09")
    counts = count_postures(
        np.array(names["lengths"]), np.array(names["both_ways"]), np.array([[0.36, 0.64], [0.36, 0.56]])
    )
    assert list(counts) == [2, 1]


def distinct(postures, tolerance=1e-6) -> list:
    kept: list = []
    for q in postures:
        if not any(abs(np.exp(1j * np.array(q)) - np.exp(1j * np.array(other))).max() < tolerance for other in kept):
            kept.append(q)
    return kept
