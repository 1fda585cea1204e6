"""The solution notebook of an exercise on one robot."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import sympy
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder.questions.shared import arm as asked
from autograder.questions.shared.described import Described
from autograder.questions.shared.tables import list_rows

_POINTS = {asked.TABLE: 5, asked.RECURSION: 3, asked.TRANSFORM: 4, asked.FORWARD: 4, asked.POSTURES: 4}

_INTRODUCTION = """\
# Exercise: {title}

**Objective.** From the axes of a robot to its table, its matrices, a working forward model{inverse}.

**How to work.** Each question has a cell with `...` for your answer, a picture of *your* result to look at, and a `check`
cell that hands it in. Leave the check cells as they are. Stuck? `hint("{name}.table")` helps. What can be told here, `check`
tells at once: right, or which mistake it is. `solution("{name}.table")` unfolds once yours is right.

**Conventions.** Modified Denavit-Hartenberg (Khalil-Kleinfinger). Lengths in metres, angles in radians: {letters}."""

_TABLE = """\
## 1. The table ({points} points)

With all joint variables at zero, seen from frame 0:

{axes}

Frame 0 coincides with frame 1 at zero. The end effector's frame is frame {last}: at zero its origin is at {origin}, its $X$ axis
along {x} and its $Z$ axis along {z}.

Give the DHm table: {count} rows `[sigma, a, alpha, d, theta]`, in the order of the joints. `sigma` is 0 for a revolute and 1 for a
prismatic joint. Use `{symbols}`; for half a turn write `pi`. Any frames that obey the convention will do."""

_STEP = """\
def step(a, alpha, d, theta):
    c, s, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
    return Matrix([[c, -s, 0, a], [s * ca, c * ca, -sa, -d * sa], [s * sa, c * sa, ca, d * ca], [0, 0, 0, 1]])


steps = [step(*row[1:]) for row in table]"""


def solution_notebook(name: str, arm: Described, kinds: list[str]) -> NotebookNode:
    """The notebook with answers, as `autograder release` takes it."""
    inverse = " and every way to reach a pose" if asked.POSTURES in kinds else ""
    lengths = ", ".join(f"`{letter}` = {value:g} m" for letter, value in arm.table.values.items())
    letters = ", ".join(
        filter(None, [", ".join(f"`{joint}`" for joint in arm.joints) + " are the joint variables", lengths])
    )
    cells = [
        _text("title", _INTRODUCTION.format(title=arm.title, inverse=inverse, name=name, letters=letters)),
        _code("imports", "\n".join(_imports(arm, kinds))),
    ]
    for kind in kinds:
        cells += _WAYS[kind](name, arm)
    cells.append(_code("progress", "progress()"))
    python = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    return new_notebook(cells=cells, metadata={**python, "language_info": {"name": "python"}})


def _imports(arm: Described, kinds: list[str]) -> Iterator[str]:
    yield "from dhkit import check, hint, progress, solution"
    yield ""
    yield "import numpy as np"
    yield "from sympy import Matrix, cos, eye, lambdify, pi, simplify, sin, symbols"
    yield ""
    yield f"from dhkit.pictures import {'show_all_postures, ' if asked.POSTURES in kinds else ''}show_table"
    yield ""
    yield f'{", ".join(arm.letters)} = symbols("{" ".join(arm.letters)}")'
    yield f"lengths = {dict(arm.table.values)}"
    at = {joint: 0.3 if i in asked.turning(arm) else 0.2 for i, joint in enumerate(arm.joints)}
    yield f"sample = lengths | {at}  # numbers for the pictures"


def _table(name: str, arm: Described) -> list[NotebookNode]:
    rows = list_rows(arm.table)
    zero = dict.fromkeys(arm.table.joints, 0)
    frames, hand = [], sympy.eye(4)
    for factor in arm.table.transforms():
        hand = sympy.simplify((hand * factor).subs(zero))
        frames.append(hand)
    axes = [
        f"* joint {i} {'slides along' if row[0] else 'turns about'} the axis through {_point(frame[:3, 3])} along {_point(frame[:3, 2])};"
        for i, (row, frame) in enumerate(zip(rows, frames), 1)
    ]
    statement = _TABLE.format(
        points=_POINTS[asked.TABLE],
        axes="\n".join(axes)[:-1] + ".",
        last=len(rows),
        origin=_point(hand[:3, 3]),
        x=_point(hand[:3, 0]),
        z=_point(hand[:3, 2]),
        count=len(rows),
        symbols=", ".join(arm.letters),
    )
    stub = "table = [\n" + "    [..., ..., ..., ..., ...],\n" * len(rows) + "]"
    worked = "table = [\n" + "".join(f"    {row},\n" for row in rows) + "]"
    return [
        _text("q-table", statement),
        *_answer(name, asked.TABLE, stub, worked, "show_table(table, sample);", asked.TABLE),
    ]


def _recursion(name: str, arm: Described) -> list[NotebookNode]:
    count = len(arm.table.rows)
    statement = (
        f"## 2. Without the first joint ({_POINTS[asked.RECURSION]} points)\n\n"
        f"Give ${{}}^1T_{count}$, the end effector seen from frame 1, as a 4x4 sympy `Matrix`. Simplified or not is up to you."
    )
    worked = f"{_STEP}\nU1 = eye(4)\nfor matrix in steps[1:]:\n    U1 = U1 * matrix\nU1 = simplify(U1)"
    return [
        _text("q-U1", statement),
        *_answer(name, asked.RECURSION, "U1 = ...  # 4x4 sympy Matrix", worked, None, "U1"),
    ]


def _transform(name: str, arm: Described) -> list[NotebookNode]:
    count = len(arm.table.rows)
    statement = (
        f"## 3. From the base ({_POINTS[asked.TRANSFORM]} points)\n\n"
        f"Give ${{}}^0T_{count}$ as a 4x4 sympy `Matrix`. Where is the end effector with all joints at zero? Compare with question 1."
    )
    worked = "T0E = simplify(steps[0] * U1)"
    return [
        _text("q-T0E", statement),
        *_answer(name, asked.TRANSFORM, "T0E = ...  # 4x4 sympy Matrix", worked, None, "T0E"),
    ]


def _forward(name: str, arm: Described) -> list[NotebookNode]:
    call = f"forward({', '.join(arm.joints)})"
    statement = (
        f"## 4. The forward model as a function ({_POINTS[asked.FORWARD]} points)\n\n"
        f"Write `{call}` for numbers, with the lengths in `lengths`: it returns the pose as a 4x4 array of numbers."
    )
    stub = f"def {call}:\n    return ..."
    worked = f"pose = lambdify([{', '.join(arm.joints)}], T0E.subs(lengths))\n\n\ndef {call}:\n    return np.array(pose({', '.join(arm.joints)}), float)"
    return [_text("q-forward", statement), *_answer(name, asked.FORWARD, stub, worked, None, "forward")]


def _postures(name: str, arm: Described) -> list[NotebookNode]:
    found = asked.all_postures(arm)
    assert found is not None
    pose = np.round(arm.target, 6) + 0.0
    if asked.is_for_point(arm):
        target = f"target = np.array({pose[:3, 3].tolist()})"
        what = "The origin of the end effector's frame is to come to the point `target`"
    else:
        rows = ",\n".join(f"    {row}" for row in pose.tolist())
        target = f"target = np.array([\n{rows},\n])"
        what = "The end effector is to stand at `target`"
    statement = (
        f"## 5. Every way to reach a {'point' if asked.is_for_point(arm) else 'pose'} ({_POINTS[asked.POSTURES]} points)\n\n"
        f"{what}, seen from frame 0. Give all joint values `[{', '.join(arm.joints)}]` that bring it there, to three decimals; angles "
        "may differ by full turns."
    )
    picture = f"""\
def numeric_table({", ".join(arm.joints)}):
    here = lengths | dict(zip({arm.joints}, ({", ".join(arm.joints)},)))
    return [[entry.subs(here) if hasattr(entry, "subs") else entry for entry in row] for row in table]


show_all_postures(postures, numeric_table, target);"""
    worked = "postures = [\n" + "".join(f"    {[round(value, 4) for value in row]},\n" for row in found) + "]"
    return [
        _text("q-postures", statement),
        _code("target", target),
        *_answer(
            name, asked.POSTURES, f"postures = [...]  # all [{', '.join(arm.joints)}]", worked, picture, "postures"
        ),
    ]


_WAYS = {
    asked.TABLE: _table,
    asked.RECURSION: _recursion,
    asked.TRANSFORM: _transform,
    asked.FORWARD: _forward,
    asked.POSTURES: _postures,
}


def _answer(name: str, kind: str, stub: str, worked: str, picture: str | None, variable: str) -> list[NotebookNode]:
    """The cells in which a question is answered, looked at and handed in."""
    marks = {"cell_type": "code", "schema_version": 3, "task": False}
    answer = marks | {"grade": False, "grade_id": f"{name}-{kind}-answer", "locked": False, "solution": True}
    check = marks | {
        "grade": True,
        "grade_id": f"{name}-{kind}",
        "locked": True,
        "points": _POINTS[kind],
        "solution": False,
    }
    source = f"{stub}\n### BEGIN SOLUTION\n{worked}\n### END SOLUTION"
    return [
        _code(f"{name}-{kind}-answer", source, answer),
        *([_text(f"look-{kind}", "What your answer describes:"), _code(f"picture-{kind}", picture)] if picture else []),
        _code(f"{name}-{kind}", f'check("{name}.{kind}", {variable})', check),
    ]


def _point(vector: sympy.Matrix) -> str:
    return f"$({', '.join(sympy.latex(sympy.nsimplify(entry)) for entry in vector)})$"


def _text(id: str, source: str) -> NotebookNode:
    return new_markdown_cell(source, id=id)


def _code(id: str, source: str, marks: dict | None = None) -> NotebookNode:
    return new_code_cell(source, id=id, metadata={"nbgrader": marks} if marks else {})
