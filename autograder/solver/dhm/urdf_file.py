"""Robots from and to URDF files: the chain from one link to another, its origins, axes and joint limits."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from .inverse import JointMap
from .tables import DHTable
from .urdf import UrdfJoint, table_from_urdf

_MOST_BYTES = 10_000_000
_MOVING = ("revolute", "continuous", "prismatic")
ENDLESS = (-2000 * np.pi, 2000 * np.pi)
"""The limits of a joint that turns without end where the other joints have limits, radians."""
_LONGEST = 1000.0  # metres that a slide without limits may go, as a URDF must name some


def table_from_urdf_file(path: str | Path, base: str | None = None, tip: str | None = None) -> DHTable:
    """The DHm table of a chain in a URDF file, with its joint limits; see `table_from_urdf`.

    Parameters
    ----------
    path : str or Path
    base, tip : str, optional
        Names of the first and the last link. By default the root of the tree, and of the links without child the
        one that most joints move.

    Returns
    -------
    DHTable
        Its poses are those of the tip seen from the base, radians and metres. Limits where every joint has some;
        a continuous joint counts as unlimited, 1000 turns to either side.

    Raises
    ------
    ValueError
        For a file that is no URDF, is larger than 10 MB, declares entities, has numbers that are none, or links that
        are not there; where the chain forks, naming the links to choose from; and as `table_from_urdf`.
    """
    path = Path(path)
    root = _parsed(path)
    joints = {}
    for element in root.findall("joint"):
        child = _link(element, "child")
        if child in joints:
            raise ValueError(f"link {child} has two parents")
        joints[child] = element
    parents = {child: _link(element, "parent") for child, element in joints.items()}
    base = base if base is not None else _only(sorted(set(parents.values()) - set(parents)), "base", "root")
    if tip is None:
        ends = {end: _chain(joints, base, end) for end in sorted(set(parents) - set(parents.values()))}
        moving = {end: sum(joint.get("type") in _MOVING for joint in chain) for end, chain in ends.items()}
        tip = _only([end for end in ends if moving[end] == max(moving.values())], "tip", "end of the chain")
    chain = _chain(joints, base, tip)
    read = [_joint(element) for element in chain]
    limits = [_limits(element) for element, joint in zip(chain, read) if joint.kind in _MOVING]
    known = [pair for pair in limits if pair is not None]
    name = root.get("name") or path.stem
    return table_from_urdf(read, name, known if len(known) == len(limits) else None)


def urdf_of(table: DHTable) -> str:
    """A URDF file with the joints of a table and their limits, without shapes and masses.

    Links are called base, link_1, ... and tool, joints as in the table. A joint that turns without limits is
    continuous; a slide without limits gets 1 km to either side. Poses are those of the table, metres and radians.

    Raises ValueError where the table holds letters without value, or a joint moves several rows.
    """
    chain = table.chain
    joints = JointMap.of(chain)
    robot = ElementTree.Element("robot", name=table.name or "robot")
    ElementTree.SubElement(robot, "link", name="base")
    parent, before = "base", chain.base
    for i, joint in enumerate(table.joints):
        kind = "prismatic" if chain.prismatic[i] else "continuous" if table.limits is None else "revolute"
        child = f"link_{i + 1}"
        element = _element(robot, str(joint), kind, parent, child, before @ chain.row_matrix(i, chain.offset[i]))
        ElementTree.SubElement(element, "axis", xyz=f"0 0 {int(joints.sign[i])}")
        if kind != "continuous":
            low, high = (-_LONGEST, _LONGEST) if table.limits is None else table.limits[i]
            ends = {"lower": repr(float(low)), "upper": repr(float(high))}
            ElementTree.SubElement(element, "limit", {**ends, "effort": "0", "velocity": "0"})
        parent, before = child, np.eye(4)
    _element(robot, "flange_tool", "fixed", parent, "tool", chain.tail(chain.joints - 1))
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode") + "\n"


def _element(
    robot: ElementTree.Element, name: str, kind: str, parent: str, child: str, origin: np.ndarray
) -> ElementTree.Element:
    """A joint and its child link, added to a robot."""
    ElementTree.SubElement(robot, "link", name=child)
    element = ElementTree.SubElement(robot, "joint", name=name, type=kind)
    ElementTree.SubElement(element, "parent", link=parent)
    ElementTree.SubElement(element, "child", link=child)
    R = origin[:3, :3]
    yaw = np.arctan2(R[1, 0], R[0, 0])
    # Roll follows from yaw whatever that is, so that no error is left where the two turn about one line.
    roll = np.arctan2(np.sin(yaw) * R[0, 2] - np.cos(yaw) * R[1, 2], np.cos(yaw) * R[1, 1] - np.sin(yaw) * R[0, 1])
    pitch = np.arctan2(-R[2, 0], np.hypot(R[0, 0], R[1, 0]))
    texts = [" ".join(repr(float(number) + 0.0) for number in three) for three in (origin[:3, 3], (roll, pitch, yaw))]
    ElementTree.SubElement(element, "origin", xyz=texts[0], rpy=texts[1])
    return element


def _chain(joints: Mapping[str, ElementTree.Element], base: str, tip: str) -> list[ElementTree.Element]:
    """The joints from link base to link tip, of joints by their child links."""
    chain: list[ElementTree.Element] = []
    link = tip
    while link != base:
        if link not in joints or len(chain) > len(joints):
            raise ValueError(f"no chain leads from link {base} to link {tip}: it ends at {link}")
        chain.insert(0, joints[link])
        link = _link(joints[link], "parent")
    return chain


def _parsed(path: Path) -> ElementTree.Element:
    if path.stat().st_size > _MOST_BYTES:
        raise ValueError(f"{path} is larger than {_MOST_BYTES // 10**6} MB")
    text = path.read_text(encoding="utf-8")
    if "<!ENTITY" in text or "<!DOCTYPE" in text:
        raise ValueError(f"{path} declares entities, which a URDF has no use for")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise ValueError(f"{path} is no XML: {error}") from None
    if root.tag != "robot":
        raise ValueError(f"{path} is no URDF: its root is <{root.tag}>, not <robot>")
    return root


def _only(names: list[str], what: str, role: str) -> str:
    if len(names) != 1:
        raise ValueError(f"name the {what}: the file has {len(names)} links for the {role}: {', '.join(names)}")
    return names[0]


def _link(element: ElementTree.Element, role: str) -> str:
    found = element.find(role)
    name = None if found is None else found.get("link")
    if not name:
        raise ValueError(f"joint {element.get('name')} names no {role} link")
    return name


def _joint(element: ElementTree.Element) -> UrdfJoint:
    kind = element.get("type", "")
    if element.find("mimic") is not None:
        raise ValueError(f"joint {element.get('name')} follows another one (mimic), which no table can say")
    if kind not in (*_MOVING, "fixed"):
        raise ValueError(f"joint {element.get('name')}: {kind or 'no'} type, expected {', '.join(_MOVING)} or fixed")
    origin, axis = element.find("origin"), element.find("axis")
    xyz = _three(element, origin, "xyz", (0.0, 0.0, 0.0))
    return UrdfJoint(
        xyz, _three(element, origin, "rpy", (0.0, 0.0, 0.0)), _three(element, axis, "xyz", (1.0, 0.0, 0.0)), kind
    )


def _three(
    joint: ElementTree.Element, element: ElementTree.Element | None, name: str, otherwise: tuple[float, float, float]
) -> tuple[float, float, float]:
    text = None if element is None else element.get(name)
    if text is None:
        return otherwise
    values = [_number(joint, part) for part in text.split()]
    if len(values) != 3:
        raise ValueError(f"joint {joint.get('name')}: {name} has {len(values)} numbers, not 3")
    return values[0], values[1], values[2]


def _limits(joint: ElementTree.Element) -> tuple[float, float] | None:
    if joint.get("type") == "continuous":
        return ENDLESS
    found = joint.find("limit")
    if found is None or found.get("lower") is None or found.get("upper") is None:
        return None
    return _number(joint, found.get("lower") or ""), _number(joint, found.get("upper") or "")


def _number(joint: ElementTree.Element, text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise ValueError(f"joint {joint.get('name')}: expected a number, found {text[:40]!r}")
    return value
