"""To and from the objects of other libraries: Robotics Toolbox, spatialmath, Pinocchio. None of them is needed here.

Each function asks for its library when it is called, and says how to install one that is missing.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from .inverse import JointMap
from .tables import DHTable
from .urdf import straightened, table_from_axes
from .urdf_file import ENDLESS, urdf_of

_STILL = 1e-12  # of a column of a Jacobian, under which the joint does not move the tool


def as_poses(T: Any) -> ArrayLike:
    """Poses as numbers: what spatialmath (SE3) and Pinocchio (SE3) wrap, everything else as it is."""
    for wrapped in ("A", "homogeneous"):
        if hasattr(T, wrapped):
            return getattr(T, wrapped)
    return T


def to_spatialmath(T: ArrayLike) -> Any:
    """`spatialmath.SE3` of a pose (4, 4), or one object that holds N poses (N, 4, 4)."""
    poses = np.asarray(T, dtype=float)
    se3 = _library("spatialmath", "spatialmath-python").SE3
    return se3(poses if poses.ndim == 2 else list(poses), check=False)


def to_roboticstoolbox(table: DHTable) -> Any:
    """`roboticstoolbox.DHRobot` of a table, in modified DH, with its joint limits; joints in radians and metres.

    Constant rows at the end become part of its tool. Raises ValueError where the table holds letters without value, or a
    joint moves several rows; ModuleNotFoundError without the toolbox.
    """
    rtb = _library("roboticstoolbox", "roboticstoolbox-python")
    chain, links = table.chain, []
    joints = JointMap.of(chain)
    for i in range(chain.joints):
        kind, constant = (rtb.PrismaticMDH, "theta") if chain.prismatic[i] else (rtb.RevoluteMDH, "d")
        own = {constant: chain.fixed[i], "flip": bool(joints.sign[i] < 0)}
        limits = {} if table.limits is None else {"qlim": list(table.limits[i])}
        alpha = float(np.arctan2(chain.sin_alpha[i], chain.cos_alpha[i]))
        links.append(kind(a=chain.a[i], alpha=alpha, offset=chain.offset[i], **own, **limits))
    ends = {"base": to_spatialmath(chain.base), "tool": to_spatialmath(chain.tail(chain.joints - 1))}
    return rtb.DHRobot(links, name=table.name, **ends)


def from_roboticstoolbox(model: Any) -> DHTable:
    """The table of a robot of the toolbox: of a DHRobot its own rows, modified or classic, of any other its axes at q = 0.

    Where such a one has several ends, of the chain to the first.
    """
    if not hasattr(model, "mdh"):
        path = model.ets()
        q = np.zeros(path.n)
        return table_at_home(path.fkine(q).A, path.jacob0(q), model.name, _limits(path.joints()))
    rows: list[tuple] = []
    joints = sp.symbols(f"q1:{model.n + 1}")
    for joint, link in zip(joints, model.links):
        variable = (-joint if link.isflip else joint) + float(link.offset)
        d, theta = (variable, float(link.theta)) if link.isprismatic else (float(link.d), variable)
        rows.append((int(link.isprismatic), float(link.a), float(link.alpha), d, theta))
    made = DHTable if model.mdh else DHTable.from_classic
    ends = {"base": sp.Matrix(model.base.A), "tool": sp.Matrix(model.tool.A)}
    return made(rows, name=model.name, joints=joints, limits=_limits(model.links), **ends)


def to_pinocchio(table: DHTable) -> Any:
    """`pinocchio.Model` of a table; the frame ``tool`` is the end. Raises as `urdf_of`, and without Pinocchio."""
    return _library("pinocchio", "pin").buildModelFromXML(urdf_of(table))


def from_pinocchio(model: Any, frame: str | None = None) -> DHTable:
    """The table of the chain from the world to a frame of a `pinocchio.Model`, by default its last frame.

    Raises ValueError for a frame that is not there, or where a joint of more than one freedom moves it.
    """
    pin = _library("pinocchio", "pin")
    index = model.nframes - 1 if frame is None else model.getFrameId(frame)
    if index >= model.nframes:
        raise ValueError(f"no frame {frame}: there are {', '.join(each.name for each in model.frames)}")
    data, q = model.createData(), pin.neutral(model)
    moving = [model.joints[i] for i in model.supports[model.frames[index].parentJoint] if i]
    for joint in moving:
        if joint.nv != 1:
            raise ValueError(f"joint {model.names[joint.id]} has {joint.nv} freedoms, not 1")
    J = pin.computeFrameJacobian(model, data, q, index, pin.LOCAL_WORLD_ALIGNED)
    home = pin.updateFramePlacement(model, data, index).homogeneous
    ends = (model.lowerPositionLimit, model.upperPositionLimit)
    limits = [ENDLESS if each.nq == 2 else (ends[0][each.idx_q], ends[1][each.idx_q]) for each in moving]
    return table_at_home(home, J[:, [each.idx_v for each in moving]], model.name, _finite(limits))


def table_at_home(
    home: ArrayLike, jacobian: ArrayLike, name: str = "", limits: Sequence[tuple[float, float]] | None = None
) -> DHTable:
    """The table of a robot of which the pose and the Jacobian at q = 0 are known: they hold all its axes.

    Parameters
    ----------
    home : (4, 4) array_like
    jacobian : (6, n) array_like
        Geometric, of the tool point in the base's axes: m/s, then rad/s, per unit of each joint's speed.
    name, limits
        As for `DHTable`.

    Raises ValueError for a joint that does not move the tool at q = 0.
    """
    home, J = np.asarray(home, dtype=float), np.asarray(jacobian, dtype=float)
    points, axes, sigmas = [], [], []
    for i, (v, w) in enumerate(zip(J[:3].T, J[3:].T), start=1):
        turns = np.linalg.norm(w) > _STILL
        axis = w if turns else v
        if np.linalg.norm(axis) <= _STILL:
            raise ValueError(f"joint {i} does not move the tool at q = 0")
        points.append(home[:3, 3] + np.cross(w, v))
        axes.append(axis / np.linalg.norm(axis))
        sigmas.append(int(not turns))
    return table_from_axes(points, straightened(axes), sigmas, home, name, limits)


def _limits(joints: Sequence[Any]) -> Sequence[tuple[float, float]] | None:
    """(lower, upper) of each joint of the toolbox, None where one has none."""
    pairs = [each.qlim for each in joints]
    return None if any(pair is None for pair in pairs) else _finite([(float(low), float(high)) for low, high in pairs])


def _finite(limits: Sequence[tuple[float, float]]) -> Sequence[tuple[float, float]] | None:
    return limits if np.isfinite(np.array(limits, dtype=float)).all() else None


def _library(name: str, package: str) -> Any:
    try:
        return import_module(name)
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(f"{name} is not installed: pip install {package}", name=name) from error
