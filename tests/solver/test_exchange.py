"""To and from Robotics Toolbox, spatialmath and Pinocchio, of which the first two are installed by hand only."""

import importlib.util
import os
import warnings
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pinocchio
import pytest

from autograder.reference import robots
from dhm import Robot, exchange, jacobian, table_from_urdf_file

FAR_AND_WIDE = ("PLANAR_3R", "SCARA", "ADEPT_S600", "RX90", "KR210", "EPFL_ARM", "PUMA")


def anywhere(robot, count=5):
    return np.random.default_rng(0).uniform(-2, 2, (count, robot.table.chain.joints))


@pytest.mark.parametrize("name", FAR_AND_WIDE)
def test_a_jacobian_and_a_pose_hold_the_whole_arm(name):
    robot = getattr(robots, name)
    zero = np.zeros(robot.table.chain.joints)
    table = exchange.table_at_home(robot.forward(zero), robot.jacobian(zero))
    q = anywhere(robot)
    np.testing.assert_allclose(table.forward(q), robot.forward(q), atol=1e-14)


def test_a_joint_that_does_nothing_is_named():
    with pytest.raises(ValueError, match="joint 2 does not move the tool"):
        exchange.table_at_home(np.eye(4), np.eye(6)[:, [5, 5]] * [1, 0])


@pytest.mark.parametrize("name", FAR_AND_WIDE)
def test_pinocchio_and_back(name):
    robot = getattr(robots, name)
    model = robot.to_pinocchio()
    q = anywhere(robot, 1)[0]
    data = model.createData()
    full = pinocchio.neutral(model)
    for joint, value in zip(list(model.joints)[1:], q):
        place = slice(joint.idx_q, joint.idx_q + joint.nq)
        full[place] = (np.cos(value), np.sin(value)) if joint.nq == 2 else value
    pinocchio.framesForwardKinematics(model, data, full)
    np.testing.assert_allclose(data.oMf[model.getFrameId("tool")].homogeneous, robot.forward(q), atol=1e-14)
    back = Robot.from_pinocchio(model)
    np.testing.assert_allclose(back.forward(q), robot.forward(q), atol=1e-12)
    np.testing.assert_allclose(back.jacobian(q), robot.jacobian(q), atol=1e-12)
    np.testing.assert_array_equal(robot.table.forward(q), exchange.as_poses(pinocchio.SE3(robot.forward(q))))


def test_frames_of_pinocchio_that_make_no_chain():
    model = robots.RX90.to_pinocchio()
    with pytest.raises(ValueError, match="no frame hand: there are universe"):
        Robot.from_pinocchio(model, "hand")
    assert Robot.from_pinocchio(model, "link_3").table.chain.joints == 3
    floating = pinocchio.buildSampleModelManipulator()
    floating.addJoint(0, pinocchio.JointModelFreeFlyer(), pinocchio.SE3.Identity(), "boat")
    floating.addFrame(
        pinocchio.Frame("deck", floating.getJointId("boat"), pinocchio.SE3.Identity(), pinocchio.OP_FRAME)
    )
    with pytest.raises(ValueError, match="joint boat has 6 freedoms, not 1"):
        Robot.from_pinocchio(floating)


@pytest.mark.parametrize("name", FAR_AND_WIDE)
def test_the_toolbox_and_back(name):
    pytest.importorskip("roboticstoolbox", reason="pip install roboticstoolbox-python to try this")
    robot = getattr(robots, name)
    model = robot.to_roboticstoolbox()
    q = anywhere(robot)
    np.testing.assert_allclose([model.fkine(each).A for each in q], robot.forward(q), atol=1e-14)
    back = Robot.from_roboticstoolbox(model)
    np.testing.assert_allclose(back.forward(q), robot.forward(q), atol=1e-14)


def test_all_models_of_the_toolbox():
    rtb = pytest.importorskip("roboticstoolbox", reason="pip install roboticstoolbox-python to try this")
    models = [each() for each in vars(rtb.models.DH).values() if isinstance(each, type)]
    for model in models:
        robot = Robot.from_roboticstoolbox(model)
        q = anywhere(robot)
        np.testing.assert_allclose([model.fkine(each).A for each in q], robot.forward(q), atol=1e-9, err_msg=model.name)
    panda = rtb.models.Panda()
    robot = Robot.from_roboticstoolbox(panda)
    q = anywhere(robot)
    np.testing.assert_allclose(robot.forward(q), [panda.ets().fkine(each).A for each in q], atol=1e-9)


def test_poses_of_spatialmath():
    spatialmath = pytest.importorskip("spatialmath", reason="pip install spatialmath-python to try this")
    poses = robots.RX90.forward(anywhere(robots.RX90))
    wrapped = exchange.to_spatialmath(poses)
    assert isinstance(wrapped, spatialmath.SE3) and len(wrapped) == len(poses)
    assert len(robots.RX90.inverse(wrapped[0])) == len(robots.RX90.inverse(poses[0]))
    assert robots.RX90.inverse_batch(wrapped).count.tolist() == robots.RX90.inverse_batch(poses).count.tolist()


def test_a_library_that_is_missing_is_named(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "roboticstoolbox", None)
    with pytest.raises(ModuleNotFoundError, match="pip install roboticstoolbox-python"):
        robots.RX90.to_roboticstoolbox()


def public_urdfs():
    """Arms in packages of URDFs, as far as they are installed."""
    specs = map(importlib.util.find_spec, ("rtbdata", "pybullet_data", "ssik"))
    roots = [Path(place) for spec in specs if spec for place in spec.submodule_search_locations or ()]
    roots += [Path(pinocchio.__file__).parents[4] / "share/example-robot-data"]
    found = {os.path.realpath(path) for root in roots for path in root.rglob("*.urdf")}
    arms = ("ur5", "ur10", "panda", "puma", "irb", "kr", "xarm", "iiwa", "z1", "al5d", "so10", "kinova")
    return sorted(path for path in found if Path(path).name.lower().startswith(arms))


def test_urdfs_of_public_arms():
    files = public_urdfs()
    if not files:
        pytest.skip("pip install rtb-data example-robot-data to try this")
    for file in files:
        joints = {each.find("child").get("link"): each for each in ElementTree.parse(file).getroot().findall("joint")}
        parents = {child: each.find("parent").get("link") for child, each in joints.items()}

        def chain(link, joints=joints, parents=parents):
            return [*chain(parents[link]), joints[link]] if link in parents else []

        ends = [end for end in set(parents) - set(parents.values()) if all(j.find("mimic") is None for j in chain(end))]
        if not ends:
            continue  # all its fingers follow another one
        tip = max(sorted(ends), key=lambda end, chain=chain: sum(j.get("type") != "fixed" for j in chain(end)))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # many have 1.5708 in them
            table = table_from_urdf_file(file, tip=tip)
        model = pinocchio.buildModelFromUrdf(file)
        q = np.random.default_rng(0).uniform(-1, 1, len(table.joints))
        full = pinocchio.neutral(model)
        for name, value in zip([each.get("name") for each in chain(tip) if each.get("type") != "fixed"], q):
            joint = model.joints[model.getJointId(name)]
            full[joint.idx_q : joint.idx_q + joint.nq] = (np.cos(value), np.sin(value)) if joint.nq == 2 else value
        data = model.createData()
        pinocchio.framesForwardKinematics(model, data, full)
        np.testing.assert_allclose(
            table.forward(q), data.oMf[model.getFrameId(tip)].homogeneous, atol=1e-4, err_msg=file
        )
        assert jacobian(table, q).shape == (6, len(q))
