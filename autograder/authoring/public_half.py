"""The public half of the questions on one robot: what is asked, hints, and what can be checked without the answer."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping

from autograder.questions.shared import arm as asked
from autograder.questions.shared.configurations import is_for_point, turning
from autograder.questions.shared.described import Described
from autograder.questions.shared.pool import end_frame
from dhkit.arms import EXTENDED

_UNITS = "lengths in metres, angles in radians"


def public_half(arm: Described, kinds: list[str]) -> str:
    """The file of what is asked: one table for each question."""
    lines = [f"# {arm.title}: what is asked; made by autograder new-exercise."]
    for kind in kinds:
        fields = _WAYS[kind](arm)
        nested = {key: value for key, value in fields.items() if isinstance(value, Mapping)}
        checks = fields.get("public", [])
        plain = {key: value for key, value in fields.items() if key != "public" and key not in nested}
        lines += ["", f"[{kind}]", *_entries(plain)]
        for key, value in nested.items():
            lines += ["", f"[{kind}.{key}]", *_entries(value)]
        for check in checks:
            lines += ["", f"[[{kind}.public]]", *_entries(check)]
    return "\n".join(lines) + "\n"


def _entries(fields: Mapping[str, object]) -> Iterator[str]:
    return (f"{key} = {_value(value)}" for key, value in fields.items())


def _value(value: object) -> str:
    """TOML writes texts, numbers and lists as JSON does, tables in its own way."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(_entries(value)) + " }"
    return json.dumps(value, ensure_ascii=False)


def drawn(arm: Described) -> list[float]:
    """Joint values of the drawing: every turning joint at zero, slides drawn out a little."""
    return [0.0 if i in turning(arm) else EXTENDED for i in range(len(arm.joints))]


def _end_as_drawn(arm: Described) -> list[list[float]]:
    return (arm.table.forward(drawn(arm)).round(9) + 0.0).tolist()


def _rigid() -> dict[str, object]:
    return {"name": "rigid_transform", "says": "the rotation block is a rotation and the last row is 0 0 0 1"}


def _table(arm: Described) -> dict:
    count = len(arm.table.rows)
    return {
        "title": "DHm table",
        "kind": "dh_table",
        "shape": [count, 5],
        "symbols": arm.letters,
        "joints": arm.joints,
        "units": _UNITS,
        "expected": f"{count} rows [sigma, a, alpha, d, theta]",
        "hints": [
            "Fill one column at a time. sigma: which joint slides? alpha: how is each Z axis turned against the one before it?",
            "In row i, a and alpha belong to the link before joint i, along and about X_(i-1); d and theta are counted along and about Z_i.",
        ],
        "minutes": 5 + 2 * count,
    }


def _matrix_fields(arm: Described, letters: list[str]) -> dict:
    return {
        "kind": "transform",
        "shape": [4, 4],
        "symbols": letters,
        "units": _UNITS,
        "expected": f"a 4x4 sympy Matrix in {', '.join(letters)}",
        "public": [_rigid()],
    }


def _matrix(arm: Described) -> dict:
    return {
        "title": "The matrix of joint 2, 1T2",
        **_matrix_fields(arm, arm.letters),
        "hints": [
            "Its third column is Z2 seen from frame 1, its last one O2 seen from frame 1.",
            "Four steps from left to right: along X by a, about X by alpha, along Z by d, about Z by theta.",
        ],
        "minutes": 5,
    }


def _recursion(arm: Described) -> dict:
    return {
        "title": f"The end effector seen from frame 1, 1T{end_frame(arm.table)}",
        **_matrix_fields(arm, arm.letters),
        "hints": [
            "One matrix for each row, the product from left to right, without the first one.",
            "Begin at the end effector: each U is the matrix of its own row times the U behind it.",
        ],
        "minutes": 4 + len(arm.table.rows),
    }


def _transform(arm: Described) -> dict:
    fields = _matrix_fields(arm, arm.letters)
    at = {**dict(zip(arm.joints, drawn(arm))), **dict(arm.table.values)}
    as_drawn = {
        "name": "value_at",
        "at": at,
        "equals": _end_as_drawn(arm),
        "says": "with every turning joint at zero the end effector stands as in the drawing",
    }
    return {
        "title": f"From the base to the end effector, 0T{end_frame(arm.table)}",
        **fields,
        "public": [*fields["public"], as_drawn],
        "hints": [
            "One step is left: 0T1 times what you have.",
            "With every turning joint at zero the last column is the place of the end effector in the drawing.",
        ],
        "minutes": 5,
    }


def _forward(arm: Described) -> dict:
    return {
        "title": "Forward model as a function",
        "kind": "function",
        "units": _UNITS,
        "expected": f"a function forward({', '.join(arm.joints)}) that returns a 4x4 array of numbers",
        "hints": [
            "Multiply numeric matrices, or put numbers into your symbolic matrix; lengths are those of the statement.",
            "sympy.lambdify([q1, ...], matrix) makes a function of numbers; np.array(..., float) makes an array of its result.",
        ],
        "minutes": 10,
        "returns": {"kind": "transform", "decimals": 4, "shape": [4, 4], "expected": "a 4x4 array of numbers"},
        "public": [
            {
                "name": "returns",
                "args": drawn(arm),
                "equals": _end_as_drawn(arm),
                "says": "with every turning joint at zero the end effector stands as in the drawing",
            }
        ],
    }


def _solutions(arm: Described) -> dict:
    family = asked.is_family(arm)
    what = "point" if is_for_point(arm) else "pose"
    count = len(arm.joints)
    free = [
        "Choose a value for the joint that is left over, and solve for the others.",
        "One solution is enough; put it into the direct model before you hand it in.",
    ]
    finite = [
        "Which joints move the point where the last axes meet, or the position, and which only turn the end effector?",
        "A cosine alone leaves two angles, and so does a square root: count the branches before you compute.",
    ]
    return {
        "title": f"{'A way' if family else 'Every way'} to reach a {what}",
        "kind": "joint_solutions",
        "decimals": 3,
        "joints": arm.joints,
        "units": _UNITS,
        "expected": f"a list of {'one or more' if family else 'all'} [{', '.join(arm.joints)}]",
        "hints": free if family else finite,
        "minutes": min(15 + 5 * count, 45),
    }


def _cloud(arm: Described) -> dict:
    return {
        "title": "A part of the workspace",
        "kind": "point_cloud",
        "shape": [3],
        "units": "metres",
        "expected": "an array of at most 5000 points, one row [x, y, z] each",
        "hints": [
            "np.linspace holds both ends of a range. Take every value of one joint with every value of the other: two loops.",
            "About 60 values of each joint are enough; the place is the last column of your forward model.",
        ],
        "minutes": 8,
    }


def _reach(arm: Described) -> dict:
    return {
        "title": "How near, how far",
        "kind": "vector",
        "decimals": 3,
        "shape": [2],
        "names": ["smallest", "largest"],
        "units": "metres",
        "expected": "two numbers [smallest, largest]",
        "hints": [
            "The distance of a point from Z0 does not contain z: np.hypot(x, y).",
            "Look for extremes inside the ranges as well as at their ends; take a fine grid, then a finer one about the best point.",
        ],
        "minutes": 8,
    }


def _ranks(arm: Described) -> dict:
    return {
        "title": "Freedoms that are left",
        "kind": "vector",
        "shape": [4],
        "names": ["A", "B", "C", "D"],
        "expected": "four whole numbers [A, B, C, D]",
        "hints": [
            "Column i of the Jacobian: Z_i x (O_E - O_i) above Z_i for a joint that turns, Z_i above zeros for one that slides.",
            "np.linalg.matrix_rank counts singular values that are not zero. Which axes are aligned where the rank is lower?",
        ],
        "minutes": 12,
    }


def _determinant(arm: Described) -> dict:
    count = len(arm.joints)
    return {
        "title": "Determinant of the Jacobian",
        "kind": "expression",
        "symbols": arm.letters,
        "expected": f"an expression in {', '.join(arm.letters)}",
        "hints": [
            f"Differentiate x, y, z by each joint variable: Matrix([x, y, z]).jacobian([...]){'; the row of the turn is whole numbers' if count == 4 else ''}.",
            "det, then simplify and factor. Turning joint 1 turns the whole picture: the result cannot depend on its angle.",
        ],
        "minutes": 10,
    }


_WAYS = {
    asked.TABLE: _table,
    asked.MATRIX: _matrix,
    asked.RECURSION: _recursion,
    asked.TRANSFORM: _transform,
    asked.FORWARD: _forward,
    asked.SOLUTIONS: _solutions,
    asked.CLOUD: _cloud,
    asked.REACH: _reach,
    asked.RANKS: _ranks,
    asked.DETERMINANT: _determinant,
}
