"""URDF files: the chain that is asked for, its limits, and files that are none."""

import numpy as np
import pytest

from autograder.reference import Robot, robots, table_from_urdf, table_from_urdf_file

pytestmark = pytest.mark.filterwarnings("error")


def joint(name, parent, child, origin, axis=None, kind="revolute", limit='<limit lower="-2" upper="2.5" effort="1"/>'):
    xyz, rpy = origin
    turn = "" if axis is None else f'<axis xyz="{axis}"/>'
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}<origin xyz="{xyz}" rpy="{rpy}"/>{turn}{limit}</joint>'


def kr210(extra="", limit='<limit lower="-2" upper="2.5"/>'):
    """The joint list of the KR210 as a file."""
    text, parent = "", "base_link"
    for i, each in enumerate(robots.KR210_JOINTS, start=1):
        numbers = [" ".join(str(value) for value in values) for values in (each.xyz, each.rpy, each.axis)]
        text += joint(f"joint_{i}", parent, f"link_{i}", numbers[:2], numbers[2], each.kind, limit)
        parent = f"link_{i}"
    return f'<robot name="kr210"><link name="base_link"/>{text}{extra}</robot>'


@pytest.fixture
def written(tmp_path):
    def write(text):
        path = tmp_path / "robot.urdf"
        path.write_text(text)
        return path

    return write


def test_a_file_is_the_table_of_its_joints(written):
    table = table_from_urdf_file(written(kr210()))
    assert table.name == "kr210" and table.limits == ((-2.0, 2.5),) * 6
    q = np.random.default_rng(0).uniform(-2, 2, (5, 6))
    np.testing.assert_allclose(table.forward(q), table_from_urdf(robots.KR210_JOINTS).forward(q), atol=1e-12)
    robot = Robot(table)
    assert len(robot.inverse(robot.forward(q[0]), limits=True)) >= 1


def test_limits_that_are_not_there_and_endless_joints(written):
    assert table_from_urdf_file(written(kr210(limit=""))).limits is None
    endless = kr210().replace('type="revolute"', 'type="continuous"', 1)
    assert table_from_urdf_file(written(endless)).limits[0][1] > 6000


def test_a_fork_asks_which_way(written):
    path = written(kr210(joint("finger", "link_7", "left", ("0 0 0", "0 0 0"), kind="fixed")))
    assert table_from_urdf_file(path).chain.joints == 6
    ros = joint("base_link-base", "base_link", "base", ("0 0 0", "0 0 0"), kind="fixed")
    assert table_from_urdf_file(written(kr210(ros))).chain.joints == 6
    fork = joint("a", "link_7", "left", ("0 0 0", "0 0 0"), kind="fixed")
    fork += joint("b", "link_7", "right", ("0 0.1 0", "0 0 0"), kind="fixed")
    path = written(kr210(fork))
    with pytest.raises(ValueError, match="name the tip: the file has 2 links for the end of the chain: left, right"):
        table_from_urdf_file(path)
    assert table_from_urdf_file(path, tip="right").chain.joints == 6
    assert table_from_urdf_file(path, base="link_1", tip="link_3").chain.joints == 2
    with pytest.raises(ValueError, match="no chain leads from link link_3 to link link_1: it ends at base_link"):
        table_from_urdf_file(path, base="link_3", tip="link_1")


@pytest.mark.parametrize(
    "text, message",
    [
        ("<robot", "is no XML"),
        ("<sdf/>", "its root is <sdf>, not <robot>"),
        ('<!DOCTYPE r [<!ENTITY a "aa">]><robot/>', "declares entities"),
        (kr210().replace("0.33", "a third"), "joint_1: xyz has 4 numbers|expected a number, found 'a'"),
        (kr210().replace("0.33", "nan"), "joint joint_1: expected a number, found 'nan'"),
        (kr210().replace('type="revolute"', 'type="floating"', 1), "joint joint_1: floating type, expected revolute"),
        (kr210().replace("<axis", '<mimic joint="joint_1"/><axis', 1), "joint_1 follows another one"),
        (kr210(joint("x", "base_link", "link_2", ("0 0 0", "0 0 0"))), "link link_2 has two parents"),
    ],
)
def test_what_is_no_robot_is_refused(written, text, message):
    with pytest.raises(ValueError, match=message):
        table_from_urdf_file(written(text))
