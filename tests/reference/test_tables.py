"""DHTable: entries, transforms, recursion, conversions, rendering, messages."""

import subprocess
import sys

import numpy as np
import pytest
import sympy as sp

from autograder.reference import DHRow, DHTable, UrdfJoint, robots, table_from_urdf
from dhm.transforms import (
    classic_dh,
    exact_angle,
    modified_dh,
    modified_dh_inverse,
    rigid_inverse,
    rot_x,
    rot_z,
    trans_x,
    trans_z,
)

a, alpha, d, theta = sp.symbols("a alpha d theta")
t1, t2, t3 = sp.symbols("t1:4")


def test_modified_and_classic_are_the_products_of_their_elementary_steps():
    x_steps, z_steps = trans_x(a) * rot_x(alpha), trans_z(d) * rot_z(theta)
    assert sp.expand(modified_dh(a, alpha, d, theta) - x_steps * z_steps) == sp.zeros(4)
    assert sp.expand(classic_dh(a, alpha, d, theta) - z_steps * x_steps) == sp.zeros(4)


def test_inverses():
    forth, back = modified_dh(a, alpha, d, theta), modified_dh_inverse(a, alpha, d, theta)
    assert sp.simplify(forth * back) == sp.eye(4)
    assert sp.simplify(rigid_inverse(forth) - back) == sp.zeros(4)
    table = robots.SCARA.table
    assert sp.simplify(table.inverse_transform() * table.symbolic_forward()) == sp.eye(4)
    assert [sp.simplify(f * b) for f, b in zip(table.transforms(), table.inverse_transforms())] == [sp.eye(4)] * 4


@pytest.mark.parametrize(
    "angle, exact",
    [
        (np.pi / 2, sp.pi / 2),
        (-np.pi, -sp.pi),
        (np.radians(15), sp.pi / 12),
        (t1 - np.pi / 2, t1 - sp.pi / 2),
        (0.0, 0),
        (0.3, 0.3),
    ],
)
def test_round_float_angles_are_made_exact(angle, exact):
    assert exact_angle(angle) == exact


def test_recursion_is_the_running_product_from_the_tip():
    table = robots.RX90.table
    below = table.recursion()
    assert len(below) == 7 and below[6] == sp.eye(4)
    values = {s: 0.3 + 0.1 * k for k, s in enumerate(sorted(below[0].free_symbols, key=str))}
    for transform, lower, upper in zip(table.transforms(), below[1:], below):
        np.testing.assert_allclose(
            np.array((transform * lower).subs(values), dtype=float),
            np.array(upper.subs(values), dtype=float),
            atol=1e-15,
        )


@pytest.mark.parametrize("name", robots.names())
def test_symbolic_forward_is_the_naive_product_and_the_numeric_model(name):
    table = getattr(robots, name).table
    q = np.random.default_rng(0).uniform(-2, 2, len(table.joints))
    values = {sp.Symbol(letter): number for letter, number in table.values.items()}
    values |= dict(zip(table.joints, q))
    numeric = table.forward(q)
    for symbolic in (table.symbolic_forward(), table.product()):
        np.testing.assert_allclose(np.array(symbolic.subs(values), dtype=float), numeric, atol=1e-14)


@pytest.mark.parametrize("name", robots.names())
def test_classic_and_back(name):
    table = getattr(robots, name).table
    classic = table.to_classic()
    product = sp.Matrix(classic.base)
    for row in classic.rows:
        product = product * classic_dh(*row.parameters)
    q = np.random.default_rng(1).uniform(-2, 2, len(table.joints))
    values = {sp.Symbol(letter): number for letter, number in table.values.items()}
    values |= dict(zip(table.joints, q))
    numeric = np.array((product * classic.tool).subs(values), dtype=float)
    np.testing.assert_allclose(numeric, table.forward(q), atol=1e-14)
    np.testing.assert_allclose(classic.to_modified().forward(q), table.forward(q), atol=1e-14)


def test_classic_rows_of_the_s600_tutorial():
    """The robot's data sheet program lists classic parameters: the column a moves up a row."""
    rows = robots.ADEPT_S600.table.to_classic().rows
    d2, d3, r3, r30 = sp.symbols("d2 d3 r3 r30")
    assert [row.parameters[:3] for row in rows] == [(d2, 0, 0), (d3, 0, 0), (0, sp.pi, r3 + r30), (0, 0, 0)]


def test_joints_offsets_and_coupling():
    table = DHTable(
        [(0, 0, 0, 0, t1), (1, 1, 0, -sp.Symbol("d2") + 0.5, 0), (0, 0, 0, 0, t2 - t1)],
        joints=(t1, sp.Symbol("d2"), t2),
    )
    np.testing.assert_allclose(table.forward([0.3, 0.2, 0.7])[:3, 3], [np.cos(0.3), np.sin(0.3), 0.3])
    heading = table.forward([0.3, 0.2, 0.7])[:2, 0]
    np.testing.assert_allclose(heading, [np.cos(0.7), np.sin(0.7)])
    assert DHTable([(0, 0, 0, 0, None), (1, 0, 0, None, 0)]).joints == tuple(
        sp.Symbol(f"q{i}", real=True) for i in (1, 2)
    )


def test_values_make_a_symbolic_table_numeric():
    table = robots.planar_2r(1.0, 0.5).table
    assert table.symbolic_forward().free_symbols == {t1, t2, *sp.symbols("L1 L2")}
    np.testing.assert_allclose(table.forward([0, 0])[0, 3], 1.5)
    np.testing.assert_allclose(table.at({"L1": 2}).forward([0, 0])[0, 3], 2.5)
    with pytest.raises(ValueError, match="no symbol L7"):
        table.at({"L7": 2})


def test_rendering_follows_the_slides():
    markdown = robots.SCARA.table.to_markdown().splitlines()
    assert markdown[0] == r"| $i$ | $\sigma_i$ | $a_{i-1}$ | $\alpha_{i-1}$ | $d_i$ | $\theta_i$ |"
    assert markdown[4] == "| 3 | 1 | $a_{3}$ | $0$ | $- d_{2}$ | $0$ |"
    assert markdown[5] == r"| 4 | 0 | $0$ | $0$ | $0$ | $\theta_4$ |"
    latex = robots.RX90.table.to_latex().splitlines()
    assert latex[1] == r"i & \sigma_i & a_{i-1} & \alpha_{i-1} & d_i & \theta_i \\ \hline"
    assert latex[3] == r"2 & 0 & 0 & \frac{\pi}{2} & 0 & \theta_2 \\"


@pytest.mark.parametrize(
    "rows, message",
    [
        ([(0, 0, 0, t1)], "row 1: expected 5 columns .*, found 4"),
        ([(0, 0, 0, 0, t1), (2, 0, 0, 0, t2)], "row 2: sigma must be 0 .revolute. or 1 .prismatic., found 2"),
        ([(True, 0, 0, 0, t1)], "sigma must be 0"),
        ([(0, "0.3", 0, 0, t1)], "row 1: a must be a real number or a sympy expression, found '0.3'"),
        ([(0, 0, np.nan, 0, t1)], "row 1: alpha must be"),
        ([(0, 0, 0, np.inf, t1)], "row 1: d must be"),
        ([(0, 0, 0, 1j, t1)], "row 1: d must be"),
        ([(0, 0, 0, True, t1)], "row 1: d must be"),
        ([(0, 0, 0, 0, t1 + t2)], "row 1: which of the symbols in t1 . t2"),
        ([(0, 0, 0, 0, t1), (0, 0, 0, 0, t1)], "stands in two rows"),
        ([(0, 0, 0, 0, t1**2)], "row 1: the joint entry t1..2 must be a sum"),
        ([], "at least one row"),
        (["abcde"], "row 1: expected sigma"),
    ],
)
def test_bad_rows_are_refused_in_words(rows, message):
    with pytest.raises(ValueError, match=message):
        DHTable(rows)


def test_other_bad_input_is_refused_in_words():
    rows = [(0, 0, 0, 0, t1)]
    with pytest.raises(ValueError, match="base must be a 4x4 transform"):
        DHTable(rows, base=sp.eye(3))
    with pytest.raises(ValueError, match="expected 1 pairs of joint limits, found 2"):
        DHTable(rows, limits=[(0, 1), (0, 1)])
    with pytest.raises(ValueError, match="limits of t1: lower 1.0 is above upper 0.0"):
        DHTable(rows, limits=[(1, 0)])
    with pytest.raises(ValueError, match="give numbers for a first"):
        DHTable([(0, a, 0, 0, t1)]).forward([0.0])
    with pytest.raises(ValueError, match=r"expected q of shape \(..., 1\), found \(2,\)"):
        DHTable(rows).forward([0.0, 1.0])
    with pytest.raises(ValueError, match="finite"):
        DHTable(rows).forward([np.nan])
    with pytest.raises(ValueError, match="sigma must be"):
        DHRow(-1, 0, 0, 0, 0)


def test_kr210_list_becomes_the_dhm_table_of_the_slides():
    table = table_from_urdf(robots.KR210_JOINTS)
    expected = robots.KR210.table.at(robots.KR210.table.values)
    for row, wanted in zip(table.rows, expected.rows, strict=True):
        assert row.sigma == wanted.sigma
        for entry, target in zip(row.parameters, wanted.parameters):
            assert sp.Abs(sp.N(entry - target)) < 1e-12
    np.testing.assert_allclose(np.array(table.tool, dtype=float), np.array(expected.tool, dtype=float), atol=1e-12)


@pytest.mark.parametrize("seed", range(8))
def test_any_urdf_chain_keeps_its_direct_model(seed):
    """Joint frames multiplied as URDF defines them, against the DHm table made from them."""
    rng = np.random.default_rng(seed)
    kinds = rng.choice(["revolute", "prismatic", "continuous", "fixed"], 6, p=[0.5, 0.2, 0.2, 0.1])
    kinds[0] = "revolute"
    axes = [rng.normal(size=3) if rng.random() < 0.5 else np.eye(3)[rng.integers(3)] for _ in kinds]
    rpys = rng.uniform(-3, 3, (6, 3)) * (rng.random((6, 1)) < 0.5)
    joints = [
        UrdfJoint(tuple(rng.uniform(-1, 1, 3) * rng.integers(0, 2, 3)), tuple(rpy), tuple(axis), kind)
        for rpy, axis, kind in zip(rpys, axes, kinds)
    ]
    table = table_from_urdf(joints)
    q = rng.uniform(-2, 2, len(table.joints))
    pose, values = np.eye(4), iter(q)
    for joint in joints:
        pose = pose @ joint.origin()
        axis = np.asarray(joint.axis) / np.linalg.norm(joint.axis)
        motion = np.eye(4)
        if joint.kind == "prismatic":
            motion[:3, 3] = next(values) * axis
        elif joint.kind != "fixed":
            angle = next(values)
            cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
            motion[:3, :3] = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
        pose = pose @ motion
    np.testing.assert_allclose(table.forward(q), pose, atol=1e-12)


def test_bad_urdf_chains_are_refused_in_words():
    with pytest.raises(ValueError, match="no moving joint"):
        table_from_urdf([UrdfJoint((0, 0, 1), kind="fixed")])
    with pytest.raises(ValueError, match="joint 1: the axis is the zero vector"):
        table_from_urdf([UrdfJoint((0, 0, 1), axis=(0, 0, 0))])
    with pytest.raises(ValueError, match="joint 1: unknown kind 'floating'"):
        table_from_urdf([UrdfJoint((0, 0, 1), kind="floating")])


def test_importing_the_solver_loads_numpy_and_sympy_only():
    """Keeps the import light: no symbolic work, no plotting, no other numeric library."""
    code = (
        "import sys, numpy, sympy; before = set(sys.modules); import autograder.reference; "
        "print(*sorted({m.split('.')[0] for m in set(sys.modules) - before}))"
    )
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert "autograder" in loaded
    assert not {"scipy", "matplotlib", "pandas", "IPython", "pinocchio", "eaik"} & set(loaded)


def test_joint_limits_survive_classic_and_back():
    table = robots.planar_2r(limits=[(-1, 1), (0, 2)]).table
    assert table.to_classic().to_modified().limits == ((-1, 1), (0, 2))
