"""Every sense of every axis: one arm has many tables, and all of them are solved, or refused with what is true of them.

The oracle multiplies elementary motions itself, with SciPy's rotations, and knows nothing of the solver's tables.
"""

import itertools

import numpy as np
import pytest
import sympy as sp
from scipy.spatial.transform import Rotation

from autograder.reference import DHTable, Robot, misfits, robots
from dhm.elbow import WristedArm
from dhm.planar_arms import PlanarArm

pytestmark = pytest.mark.filterwarnings("error")

PI, HALF = np.pi, np.pi / 2


def motion(axis, turn, shift):
    T = np.eye(4)
    T[:3, :3] = Rotation.from_euler(axis, turn).as_matrix()
    T["xyz".index(axis), 3] = shift
    return T


def pose(rows, q, tool=np.eye(4), classic=False):
    """Rows (sigma, a, alpha, d, theta) with numbers, the joint value added to its entry; one motion after the other."""
    T, q = np.eye(4), iter(q)
    for sigma, a, alpha, d, theta in rows:
        value = next(q)
        about_z = motion("z", theta + value * (not sigma), d + value * sigma)
        T = T @ (about_z @ motion("x", alpha, a) if classic else motion("x", alpha, a) @ about_z)
    return T @ tool


def table(rows, tool=None, classic=False, **options):
    joints = sp.symbols(f"q1:{len(rows) + 1}")
    entries = [
        (s, a, alpha, d + joint * s, theta + joint * (1 - s)) for (s, a, alpha, d, theta), joint in zip(rows, joints)
    ]
    made = DHTable.from_classic if classic else DHTable
    return made(entries, tool=None if tool is None else sp.Matrix(tool), joints=joints, **options)


def assert_solved(robot, rows, seed=0, count=20, classic=False, only_point=False, tool=np.eye(4)):
    """Every posture reaches its pose, the one that it was made from is listed, and no two are the same."""
    for q in np.random.default_rng(seed).uniform(-PI, PI, (count, len(rows))):
        T = pose(rows, q, tool, classic)
        answer = robot.inverse(T)
        gap = np.angle(np.exp(1j * (answer.q - q)))
        slides = [i for i, row in enumerate(rows) if row[0]]
        gap[:, slides] = (answer.q - q)[:, slides]
        assert np.abs(gap).max(axis=1).min() < 1e-7
        for found in answer.q:
            error = pose(rows, found, tool, classic) - T
            assert np.abs(error[:3, 3] if only_point else error).max() < 1e-9
        apart = [np.abs(np.exp(1j * a) - np.exp(1j * b)).max() for a, b in itertools.combinations(answer.q, 2)]
        assert min(apart, default=1) > 1e-6


REAL = {
    "FANUC LR Mate 200iD": (
        True,
        [(0, 0.05, -HALF, 0, 0), (0, 0.33, PI, 0, -HALF), (0, 0.035, -HALF, 0, 0)]
        + [(0, 0, HALF, -0.335, 0), (0, 0, -HALF, 0, 0), (0, 0, PI, -0.08, 0)],
    ),
    "Motoman GP8": (
        True,
        [(0, 0.04, -HALF, 0.33, 0), (0, 0.345, PI, 0, -HALF), (0, 0.04, -HALF, 0, 0)]
        + [(0, 0, HALF, -0.34, 0), (0, 0, -HALF, 0, 0), (0, 0, PI, -0.08, 0)],
    ),
    "negative upper arm, last axis turned over": (
        False,
        [(0, 0, 0, 0.4, 0), (0, -0.1, HALF, 0.1, 0), (0, -0.45, PI, 0, HALF)]
        + [(0, -0.02, HALF, 0.48, 0), (0, 0, -HALF, 0, PI), (0, 0, HALF, 0.1, 0)],
    ),
    "Cobra s600, classic": (True, [(0, 0.325, 0, 0.387, 0), (0, 0.275, PI, 0, 0), (1, 0, 0, 0, 0), (0, 0, 0, 0, 0)]),
    "SCARA of the textbooks, quill down": (
        False,
        [(0, 0, 0, 0.4, 0), (0, 0.4, 0, 0.05, 0), (1, 0.3, PI, 0, 0), (0, 0, 0, 0.1, 0)],
    ),
    "SCARA with negative links": (
        False,
        [(0, 0, PI, 0, 0), (0, -0.4, PI, 0, 0), (1, -0.3, 0, 0, HALF), (0, 0, PI, 0.1, 0)],
    ),
    "planar arm, negative links, one axis down": (
        False,
        [(0, 0, 0, 0.1, 0), (0, -0.5, PI, 0.2, 0.3), (0, -0.4, PI, 0.1, 0), (0, 0.3, 0, 0, 0)],
    ),
}


@pytest.mark.parametrize("name", REAL)
def test_real_arms_as_their_data_sheets_write_them(name):
    classic, rows = REAL[name]
    robot = Robot(table(rows, classic=classic, name=name))
    assert robot.has_inverse
    if name.startswith("planar"):  # a family: the member near q is q
        for q in np.random.default_rng(1).uniform(-PI, PI, (20, 4)):
            answer = robot.inverse(pose(rows, q), near=q)
            assert np.abs(np.angle(np.exp(1j * (answer.q - q)))).max(axis=1).min() < 1e-7
            assert all(np.abs(pose(rows, found) - pose(rows, q)).max() < 1e-9 for found in answer.q)
        return
    assert_solved(robot, rows, classic=classic)


def flipped(rows, z_down, x_back):
    """The same arm with some Z_i and X_i between base and tool turned round; joint values change their sense."""
    rows = [list(row) for row in rows]
    for i in range(len(rows) - 1):
        if x_back[i]:
            rows[i][4] += PI
            rows[i + 1][1:3] = -rows[i + 1][1], -rows[i + 1][2]
            rows[i + 1][4] -= PI
        if z_down[i]:
            rows[i][2] += PI
            rows[i][3:] = -rows[i][3], -rows[i][4]
            rows[i + 1][2] -= PI
    return [(sigma, a, np.angle(np.exp(1j * alpha)), d, theta) for sigma, a, alpha, d, theta in rows]


BASIC = {
    "KR210": [(0, 0, 0, 0.75, 0), (0, 0.35, -HALF, 0, -HALF), (0, 1.25, 0, 0, 0)]
    + [(0, -0.054, -HALF, 1.5, 0), (0, 0, HALF, 0, 0), (0, 0, -HALF, 0.3, 0)],
    "PUMA": [(0, 0, 0, 0, 0), (0, 0, -HALF, 0, 0), (0, 0.43, 0, 0.15, 0)]
    + [(0, 0.02, -HALF, 0.43, 0), (0, 0, HALF, 0, 0), (0, 0, -HALF, 0.06, 0)],
    "SCARA": [(0, 0, 0, 0.2, 0), (0, 0.4, 0, 0, 0), (1, 0.3, 0, 0, 0), (0, 0, 0, 0.1, 0)],
    "planar 3R": [(0, 0, 0, 0, 0), (0, 0.5, 0, 0.1, 0), (0, 0.4, 0, 0, 0)],
    "elbow": [(0, 0, 0, 0.1, 0), (0, 0.05, HALF, 0.02, 0), (0, 0.5, 0, 0.03, 0)],
    "wrist": [(0, 0, 0, 0, 0), (0, 0, -HALF, 0, 0), (0, 0, HALF, 0.1, 0)],
}


@pytest.mark.parametrize("name", BASIC)
def test_every_gauge_of_an_arm_has_its_postures(name):
    rows, rng = BASIC[name], np.random.default_rng(3)
    tool = motion("x", 0.0, 0.25)
    plain = Robot(table(rows, tool))
    for case in range(12):
        other = flipped(rows, *rng.integers(0, 2, (2, len(rows) - 1)))
        robot = Robot(table(other, tool, limits=[(-3, 3)] * len(rows)))
        assert_solved(robot, other, seed=case, count=3, only_point=name == "elbow", tool=tool)
        for q in rng.uniform(-2, 2, (2, len(rows))):
            T = pose(other, q, tool)
            assert len(robot.inverse(T)) == len(plain.inverse(T))
            inside = robot.inverse(T, limits=True)
            assert len(inside) and (np.abs(inside.q) <= 3 + 1e-9).all()
            assert np.abs(robot.nearest(T, q).distance) < 1e-6


@pytest.mark.parametrize("signs", [(0, 0), (0, 1), (1, 0), (1, 1)])
def test_the_pen_robot_has_its_family_in_every_gauge(signs):
    rows = [(0, 0, 0, 0.1, 0), (0, 0.3, -HALF, 0.12, -HALF), (0, 0, 0, 0.08, 0)]
    other, tool = flipped(rows, signs, (0, 0)), motion("x", 0.0, 0.5)
    robot, q = Robot(table(other, tool)), np.array([0.4, 0.7, -0.3])
    answer = robot.inverse(pose(other, q, tool), near=q)
    assert np.abs(answer.q - q).max(axis=1).min() < 1e-9
    sense = 1 if "+" in answer.free else -1
    for shift in (-0.8, 0.5):
        member = answer.q[0] + [0, shift, -sense * shift]
        np.testing.assert_allclose(pose(other, member, tool)[:3, 3], pose(other, q, tool)[:3, 3], atol=1e-9)


def test_a_planar_arm_that_holds_its_tool_upside_down():
    rows, tool = [(0, 0, 0, 0, 0), (0, 0.5, 0, 0, 0), (0, 0.4, 0, 0, 0)], motion("x", PI, 0.2)
    assert_solved(Robot(table(rows, tool)), rows, tool=tool)
    answer = Robot(table(rows, tool)).inverse([0.6, 0.3, 0.4])
    T = pose(rows, answer.q[0], tool)
    np.testing.assert_allclose([*T[:2, 3], np.arctan2(T[1, 0], T[0, 0])], [0.6, 0.3, 0.4], atol=1e-12)


UR5 = [(0, 0, 0, 0.09, 0), (0, 0, HALF, 0, 0), (0, -0.42, 0, 0, 0)]
UR5 += [(0, -0.39, 0, 0.11, 0), (0, 0, HALF, 0.09, 0), (0, 0, -HALF, 0.08, 0)]
RX90 = BASIC["PUMA"]


ELBOW_WRIST, POINT, GROUP = "elbow arm with a spherical wrist", "arm of three joints for a point", "decoupled arm"


@pytest.mark.parametrize(
    "rows, kind, message",
    [
        (UR5, ELBOW_WRIST, "axes 4, 5 and 6 do not meet in one point: d_5 = 0.09 m"),
        (
            [*RX90[:2], (0, 0.43, 0.3, 0, 0), *RX90[3:]],
            ELBOW_WRIST,
            "axes 2 and 3 are not parallel: alpha_2 = 17.1887 degrees",
        ),
        ([*RX90[:2], (0, 0.43, PI + 0.3, 0, 0), *RX90[3:]], ELBOW_WRIST, "alpha_2 = -162.811 degrees"),
        (
            [RX90[0], (0, 0, 1.2, 0, 0), *RX90[2:]],
            ELBOW_WRIST,
            "axes 1 and 2 are not at a right angle: alpha_1 = 68.7549 degrees",
        ),
        (
            [*RX90[:4], (0, 0, 1.0, 0, 0), RX90[5]],
            ELBOW_WRIST,
            "axes 4 and 5 are not at a right angle: alpha_4 = 57.2958 degrees",
        ),
        ([*RX90[:2], (1, 0.43, 0, 0, 0), *RX90[3:]], ELBOW_WRIST, "joint 3 is prismatic, not revolute"),
        ([*RX90[:2], (0, 0, 0, 0.15, 0), *RX90[3:]], ELBOW_WRIST, "the upper arm has no length: a_2 = 0"),
        (
            [(0, 0, 0, 0, 0), (0, 0.4, 0, 0, 0), (1, 0.3, 0, 0, 0), (0, -0.1, 0, 0, 0)],
            "SCARA",
            "beside the quill: a_3 = -0.1 m",
        ),
        (
            [(0, 0, 0, 0, 0), (0, 0.4, 0, 0, 0), (0, 0, 0, 0, 0), (0, 0.3, 0, 0, 0)],
            "planar arm",
            "link 2 has no length: a_2 = 0",
        ),
        ([(1, 0, 0, 0, 0), (1, 0, HALF, 0, 0), (1, 0, HALF, 0, 0)], "planar arm", "joint 1 is prismatic, not revolute"),
        (
            [(1, 0, 0, 0, 0), (1, 0, HALF, 0, 0), (1, 0, HALF, 0, 0)],
            POINT,
            "its 3 joints give its point 2 freedoms only",
        ),
        (
            [*UR5[:3], (0, -0.39, 0.2, 0.1, 0), *UR5[4:]],
            GROUP,
            "no three neighbouring axes meet in one point or are parallel",
        ),
        ([*RX90[:2], (0, 0, 0, 0.15, 0), *RX90[3:]], GROUP, "its 6 joints give 5 freedoms only"),
    ],
)
def test_a_class_says_what_it_misses_in_the_table(rows, kind, message):
    assert message in misfits(table(rows))[kind]


@pytest.mark.parametrize(
    "rows, message",
    [
        ([*RX90[:2], (0, 0, 0, 0.15, 0), *RX90[3:]], "its 6 joints give 5 freedoms only, it is no planar arm"),
        ([(0, 0, 0, 0, 0), (0, 0.4, 0, 0, 0), (0, 0, 0, 0, 0), (0, 0.3, 0, 0, 0)], "link 2 has no length: a_2 = 0"),
        ([(1, 0, 0, 0, 0), (1, 0, HALF, 0, 0), (1, 0, HALF, 0, 0)], "it is no arm of three joints for a point"),
    ],
)
def test_a_refusal_tells_what_was_found_in_the_table(rows, message):
    robot = Robot(table(rows, name="arm"))
    assert not robot.has_inverse
    with pytest.raises(ValueError, match=message) as refused:
        robot.inverse(np.eye(4))
    assert str(refused.value).startswith("arm has no inverse model") and "degenerate" not in str(refused.value)


def test_a_table_whose_joints_lose_a_freedom_is_told_so():
    rows = [(0, 0, 0, 0, 0), (1, 0, HALF, 0, 0), (1, 0, 0, 0, 0)]
    with pytest.raises(ValueError, match="this robot has no inverse model: its 3 joints give 2 freedoms only"):
        Robot(table(rows)).inverse([0, 0, 0])


def test_every_class_is_named_with_what_it_misses():
    found = misfits(table(RX90))
    assert found["elbow arm with a spherical wrist"] == ""
    assert found["SCARA"] == "it has 6 joints, not 4"
    assert found["planar arm"] == "axes 1 and 2 are not parallel: alpha_1 = -90 degrees"
    for name in robots.names():
        robot = getattr(robots, name)
        if robot.has_inverse:
            assert [kind for kind, lacking in misfits(robot.table).items() if not lacking], name
            assert isinstance(Robot(robot.table).inverse_model, robot.model)
    with pytest.raises(ValueError, match="give numbers for a"):
        misfits(DHTable([(0, 0, 0, 0, None), (0, sp.Symbol("a"), 0, 0, None)]))


def test_a_class_that_is_named_refuses_what_does_not_fit():
    with pytest.raises(ValueError, match="it has 3 joints, not 6"):
        Robot(table(BASIC["elbow"]), WristedArm).inverse(np.eye(4))
    coupled = DHTable([(0, 0, 0, 0, sp.Symbol("u")), (0, 0.5, 0, 0, sp.Symbol("v") - sp.Symbol("u"))],
                      joints=sp.symbols("u v"), tool=sp.Matrix(motion("x", 0.0, 0.4)))  # fmt: skip
    with pytest.raises(ValueError, match="row 2 is moved by -1 q1 and 1 q2, not by q2 or -q2 alone"):
        Robot(coupled, PlanarArm).inverse([0.5, 0.2])


def test_task_coordinates_of_a_planar_arm_lie_in_its_plane():
    rows = [(0, 0, 0, 0.3, 0), (0, 0.5, PI, 0.1, 0), (0, -0.4, 0, 0, 0), (0, 0.3, PI, 0.05, 0)]
    answer = Robot(table(rows)).inverse([0.6, 0.3, 0.4])
    for q in answer.q:
        T = pose(rows, q)
        np.testing.assert_allclose([*T[:2, 3], np.arctan2(T[1, 0], T[0, 0])], [0.6, 0.3, 0.4], atol=1e-12)
    assert len(answer)
