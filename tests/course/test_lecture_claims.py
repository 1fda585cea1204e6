"""What the lectures say of their own functions and drawings, where it once was not so."""

import ast
from functools import cache
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import nbformat
import numpy as np
import pytest

pytestmark = pytest.mark.slow

LECTURES = Path(__file__).parents[2] / "course"


@cache
def lecture(name: str) -> dict:
    """The names that a lecture defines; what only shows something is left out."""
    (path,) = LECTURES.glob(f"??_{name}.ipynb")
    names: dict = {}
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "code":
            tree = ast.parse(cell.source)
            tree.body = [line for line in tree.body if not isinstance(line, (ast.Expr, ast.For))]
            exec(compile(tree, cell.id, "exec"), names)
    return names


@pytest.mark.parametrize("phi", [np.pi, np.pi - 1e-7, np.pi - 1e-11, np.radians(179.9), 0.0, 1.2])
def test_parallel_robots_the_direct_model_of_the_3rpr_loses_no_pose(phi):
    names = lecture("parallel_robots")
    for x, y in np.random.default_rng(3).uniform((0.3, 0.3), (0.9, 0.9), (40, 2)):
        lengths = names["leg_lengths"](x, y, phi)
        poses = np.array(names["direct"](lengths))
        turned = abs(np.exp(1j * poses[:, 2]) - np.exp(1j * phi))
        assert np.min(np.hypot(*(poses[:, :2] - (x, y)).T) + turned) < 1e-5
        assert len(poses) % 2 == 0, "modes come and go in pairs"
        assert all(np.allclose(names["leg_lengths"](*pose), lengths, atol=1e-6) for pose in poses)


def test_parallel_robots_with_legs_1_and_2_locked_the_platform_has_two_loops():
    names = lecture("parallel_robots")
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
def test_parallel_robots_counts_of_modes_for_the_third_leg(q3, count):
    assert len(lecture("parallel_robots")["direct"]((1.0, 0.5, q3))) == count


def test_singularities_on_the_cylinder_both_shoulders_of_the_puma_merge():
    names = lecture("singularities")
    draw = np.random.default_rng(4).uniform(-np.pi, np.pi, (60, 6))
    for t1, _, t3, *wrist in draw:
        # the forearm bends back so far that the wrist centre is beside axis 1: a2 C2 + f cos(t2 + t3 + delta) = 0
        f, delta = np.hypot(0.02, 0.43), np.arctan2(0.43, 0.02)
        t2 = np.arctan2(0.43 + f * np.cos(t3 + delta), f * np.sin(t3 + delta))
        pose = names["pose"](names["puma"](t1, t2, t3, *wrist))
        postures = names["inverse_puma"](pose)
        assert len(postures) == len(distinct(postures)) == 4
        assert all(abs(names["pose"](names["puma"](*q)) - pose).max() < 1e-6 for q in postures)


def test_singularities_inside_the_cylinder_the_puma_finds_nothing():
    names = lecture("singularities")
    pose = np.eye(4)
    pose[:3, 3] = 0.1, 0.05, 0.5 + 0.06
    assert names["inverse_puma"](pose) == []


def test_inverse_models_a_hand_on_axis_1_leaves_two_representatives_of_the_elbow_arm():
    names = lecture("inverse_models")
    postures = names["inverse_elbow"](0, 0, 0.6)
    assert len(postures) == len(distinct(postures)) == 2 and {q[0] for q in postures} == {0.0}
    assert all(np.allclose(names["pose"](names["elbow"](*q))[:3, 3], (0, 0, 0.6)) for q in postures)


@pytest.mark.parametrize(
    "r, count", [(0.09, 8), (0.11, 4), (0.59, 4), (0.61, 8), (2.39, 8), (2.41, 4), (3.09, 4), (3.11, 0)]
)
def test_singularities_postures_of_the_kr210_at_the_height_of_axis_2(r, count):
    names = lecture("singularities")
    pose = names["pose"](names["kr210"](*np.radians([25, -40, 30, 15, 50, -20])))
    pose[:3, 3] = (r, 0, 0.75) + 0.303 * pose[:3, 2]
    assert len(names["inverse_kr210"](pose)) == count


def test_transforms_the_sliders_reach_what_is_asked():
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


def test_workspace_two_arms_reach_the_start_of_the_slider():
    from dhkit.drawing.workspace import count_postures

    names = lecture("workspace")
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


def test_parameters_the_slide_leaves_the_normal_alone_and_the_turn_only_lifts_it():
    feet = lecture("parameters")["feet"]
    for slide in (-0.3, 0.4):
        for turn in np.radians([-50, 1, 10, 70]):
            along = np.array([0, -np.sin(turn), np.cos(turn)])
            foot, other = feet((0, 0, 0.5), (0, 0, 1), (1, 0.3, 0.4) + slide * along, along)
            assert np.allclose(foot, (0, 0, 0.4 + 0.3 / np.tan(turn))) and np.hypot(
                *(other - foot)[:2]
            ) == pytest.approx(1)
    with pytest.raises(np.linalg.LinAlgError, match="Singular"):
        feet((0, 0, 0), (0, 0, 1), (0.3, 0.4, 0.9), (0, 0, 1))


def test_tables_the_printed_wrist_has_two_freedoms_and_the_repaired_one_three():
    names = lecture("tables")
    freedoms, wrist, posed = names["freedoms"], names["wrist"], names["posed"]
    assert [freedoms(names["wrist_printed"], posed), freedoms(wrist, posed), freedoms(wrist, posed | {"t5": 0})] == [
        2,
        3,
        2,
    ]


def test_scara_with_axes_3_and_4_down_three_signs_turn():
    names = lecture("scara")
    T, a3, d2, t4 = (names[name] for name in ("dhm", "a3", "d2", "t4"))
    half_turn = names["rot_x"](names["pi"])
    down = T(a3, names["pi"], d2, 0) * T(0, 0, 0, -t4)
    assert names["simplify"](down - T(a3, 0, -d2, 0) * T(0, 0, 0, t4) * half_turn) == names["zeros"](4)


@pytest.mark.parametrize("distance, height, count", [(0.3, 0.5, 8), (0.54, 0.72, 4), (0.74, 0.5, 8), (0.76, 0.5, 0)])
def test_inverse_models_postures_of_the_rx90_inside_on_and_outside_its_sphere(distance, height, count):
    names = lecture("inverse_models")
    pose = names["U"].copy()
    pose[:3, 3] = distance * np.cos(0.35), distance * np.sin(0.35), height
    assert len(names["inverse_rx90"](pose)) == count


def test_pen_robot_what_the_pen_does_in_the_tries():
    names = lecture("pen_robot")
    pen_tip, sizes = names["pen_tip"], names["PEN_SIZES"]
    for turn in (-90, 0, 100):
        assert np.allclose(pen_tip(np.radians([-25, 30 + turn, 75 - turn])), (0.557, -0.017, 0.243), atol=5e-4)
    special = sizes | {"L1": 0.0}
    point = pen_tip(np.radians([35, 20, 45]), special)
    found = names["inverse"](*point, sizes=special)
    assert np.allclose(np.degrees(found), [(35, 65), (-49.373, -65)], atol=1e-3)
    assert all(np.allclose(pen_tip([theta1, phi, 0], special), point) for theta1, phi in found)
    right = names["follow"](names["eight"])
    for wrong, low, high in ((right + (np.radians(1), 0, 0), 9.2, 9.9), (right * (1, 1, -1), 240, 388)):
        miss = 1000 * np.linalg.norm(pen_tip(wrong) - names["eight"], axis=1)
        assert low < miss.min() and miss.max() < high
    assert np.hypot(sizes["h2"] + sizes["L2"], sizes["L1"]) == pytest.approx(0.372, abs=5e-4)
    assert sizes["h1"] - sizes["p1"] == pytest.approx(0.08)


def test_parallel_robots_what_the_legs_notice_in_the_tries():
    names = lecture("parallel_robots")
    legs, start, modes = names["leg_lengths"], np.array([0.55, 0.6, 0.35]), names["modes"]
    assert np.allclose(legs(*(start + (0, 0, 0.1))) - legs(*start), (0.014, 0.021, -0.020), atol=5e-4)
    one_motor = legs(*(start + (0, 0.0057, -0.0277))) - legs(*start)
    assert abs(one_motor[:2]).max() < 0.3e-3 and one_motor[2] == pytest.approx(0.010, abs=2e-4)
    C = names["meeting_point"](modes[2])
    wide, narrow = (legs(*names["turned_about"](modes[2], C, angle)) - legs(*modes[2]) for angle in (0.02, 0.01))
    assert np.allclose(wide / narrow, (4, 4, 2), atol=0.01)


def test_scara_s600_with_axis_3_down_the_last_angle_keeps_its_sign():
    names = lecture("scara_s600")
    T, r, t4 = names["dhm"], names["r3"] + names["r30"], names["t4"]
    down = T(names["d3"], names["sympy"].pi, -r, 0) * T(0, 0, 0, t4)
    assert names["simplify"](down - names["T24"]) == names["sympy"].zeros(4)
    at_start = [np.degrees(q[3]) for q in names["mgi"](0.33, 0.43, -0.1, np.radians(60))]
    assert sorted(at_start) == pytest.approx([-35.3, 20.3], abs=0.05)
    assert [len(names["mgi"](x, y, 0, 0)) for x, y in ((0.36, 0.48), (0.03, 0.04))] == [1, 1]
