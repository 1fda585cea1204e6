"""The ways into and out of a robot: data sheets, URDF, letters, and what a notebook shows."""

import warnings

import numpy as np
import pytest
import sympy as sp

from autograder.reference import robots
from dhm import DHTable, Robot, jacobian

SHEET = [
    (0, 0, 0, 0, None),
    (0, 0, -90, 0, None),
    (0, 431.8, 0, 149.09, None),
    (0, 20.32, -90, 433.07, None),
    (0, 0, 90, 0, None),
    (0, 0, -90, 0, None),
]


def sheet(**options):
    return Robot.from_table(SHEET, "PUMA 560", degrees=True, millimetres=True, **options)


def test_a_data_sheet_is_read_in_its_own_units():
    robot = sheet(tool=(0, 0, 56.25), limits=[(-160, 160)] * 6)
    row = robot.table.rows[2]
    assert (row.a, row.d) == (0.4318, 0.14909) and robot.table.rows[1].alpha == -sp.pi / 2
    assert robot.table.tool[2, 3] == 0.05625
    np.testing.assert_allclose(robot.table.limits, np.radians([(-160, 160)] * 6))
    assert len(robot.inverse(robot.forward(np.radians([10, 20, -30, 40, 50, 60])))) == 8


def test_offsets_and_slides_of_a_data_sheet():
    depth, turn = sp.symbols("depth turn")
    rows = [(0, 0, 0, 0, turn + 90), (1, 250, 180, depth + 30, 0)]
    table = Robot.from_table(
        rows, degrees=True, millimetres=True, joints=(turn, depth), limits=[(-90, 90), (0, 200)]
    ).table
    assert sp.simplify(table.rows[0].theta - (turn + sp.pi / 2)) == 0
    assert float(table.rows[1].d.subs(depth, 0)) == 0.03 and table.limits[1] == (0.0, 0.2)


def test_classic_rows_are_those_of_the_classic_table():
    rows = [(0, 500, 0, 0, None), (0, 400, 0, 0, None)]
    classic = Robot.from_table(rows, classic=True, millimetres=True)
    np.testing.assert_allclose(classic.forward([0, np.pi / 2])[:2, 3], [0.5, 0.4])


@pytest.mark.parametrize("rows", [[(0, 0, 0, 0)], [(0, "a", 0, 0, None)], [(2, 0, 0, 0, None)]])
def test_a_sheet_that_is_none_is_refused_by_its_row(rows):
    with pytest.raises(ValueError, match="row 1"):
        Robot.from_table(rows, millimetres=True)


@pytest.mark.parametrize(
    "name", [name for name in robots.names() if not name.startswith("PEN_") or name == "PEN_REPAIRED"]
)
@pytest.mark.filterwarnings("error")
def test_out_to_a_urdf_and_back(name, tmp_path):
    robot = getattr(robots, name)
    path = tmp_path / "robot.urdf"
    path.write_text(robot.to_urdf(), encoding="utf-8")
    back = Robot.from_urdf(path)
    q = np.random.default_rng(0).uniform(-2, 2, (5, robot.table.chain.joints))
    np.testing.assert_allclose(back.forward(q), robot.forward(q), atol=1e-14)
    assert back.name == robot.name


def test_limits_go_along_to_a_urdf(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(robots.scara(limits=[(-1, 1), (-2, 2), (0, 0.15), (-3, 3)]).to_urdf())
    assert Robot.from_urdf(path).table.limits == ((-1, 1), (-2, 2), (0, 0.15), (-3, 3))


def test_a_joint_that_moves_two_rows_has_no_urdf():
    with pytest.raises(ValueError, match="row 2 is moved by -1 q1 and 1 q2"):
        robots.PEN_A.to_urdf()


@pytest.mark.parametrize("name", robots.names())
def test_the_symbolic_jacobian_is_the_numeric_one(name):
    table = getattr(robots, name).table
    table = table.at(table.values)
    q = np.random.default_rng(1).uniform(-2, 2, len(table.joints))
    found = np.array(table.symbolic_jacobian().subs(dict(zip(table.joints, q))), dtype=float)
    np.testing.assert_allclose(found, jacobian(table, q), atol=1e-13)


def test_the_symbolic_jacobian_is_in_textbook_form():
    a3, d3, t2, t3 = sp.symbols("a3 d3 t2 t3")
    J = robots.RX90.symbolic_jacobian()
    assert J[2, 2] == -d3 * sp.sin(t2 + t3) and J[2, 1] == a3 * sp.cos(t2) - d3 * sp.sin(t2 + t3)
    assert J[:3, 3:] == sp.zeros(3, 3)


def test_what_a_notebook_shows():
    robot = sheet()
    shown = robot.to_markdown(degrees=True, millimetres=True)
    assert "**PUMA 560**: RRRRRR, elbow arm with a spherical wrist" in shown
    assert r"| 4 | 0 | $20.32\,\mathrm{mm}$ | $-90^\circ$ | $433.07\,\mathrm{mm}$ | $q_{4}$ |" in shown
    assert r"$- \frac{\pi}{2}$" in robot._repr_markdown_() and "0.4318" in robot._repr_markdown_()
    assert "$a_{3} = 450$ mm" in robots.RX90.to_markdown(millimetres=True)
    kr210 = robots.KR210.table.to_markdown(degrees=True)
    assert r"$q_{2} -90^\circ$" in kr210
    assert repr(robot) == "Robot(PUMA 560: RRRRRR, elbow arm with a spherical wrist)"


def test_postures_in_a_notebook():
    found = robots.SCARA.inverse([0.5, 0.2, -0.1, 0.3])
    shown = found.to_markdown(degrees=True, millimetres=True)
    assert "| $q_{1}$ (°) | $q_{2}$ (°) | $q_{3}$ (mm) | $q_{4}$ (°) | posture |" in shown
    assert shown.count("| 100.00 |") == 2 and shown.count("elbow") == 2
    assert found._repr_markdown_().startswith("**solved**: 2 postures") and "0.1000" in found._repr_markdown_()
    assert len(repr(found).splitlines()) == 3
    far = robots.SCARA.inverse([5, 0, 0, 0])
    assert "|" not in far._repr_markdown_() and "beyond" in repr(far)
    aligned = robots.RX90.inverse(robots.RX90.forward([0.3, 0.4, 0.5, 0.6, 0, 0.7]))
    assert "wrist straight; q4 + q6 = const" in repr(aligned)


def test_poses_may_come_wrapped():
    class Wrapped:
        def __init__(self, pose):
            self.A = pose

    pose = robots.RX90.forward([0.3, 0.4, 0.5, 0.6, 0.7, 0.7])
    np.testing.assert_array_equal(robots.RX90.inverse(Wrapped(pose)).q, robots.RX90.inverse(pose).q)
    assert len(robots.RX90.postures(Wrapped(pose))) == 8


def test_numbers_like_1_5708_in_a_sheet_are_told():
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        Robot.from_table([(0, 0, 0, 0, None), (0, 0.5, 1.5708, 0, None)])
    assert "1.5708" in str(told[0].message)
    assert DHTable([(0, 0, 0, 0, None)]).symbolic_jacobian()[5, 0] == 1
