"""The solution notebook of an exercise on one robot."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import sympy
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder.questions.shared import arm as asked
from autograder.questions.shared.configurations import is_for_point, robot_of, target, task_rows, turning
from autograder.questions.shared.described import Described
from autograder.questions.shared.pool import direction_of, end_frame, frames_in_space, origin_of, shown
from autograder.questions.shared.singular import configurations, determinant, senses
from autograder.questions.shared.sweep import sweep_of
from autograder.questions.shared.tables import list_rows
from dhkit.arms import arm_from, said_direction, said_point
from dhm import derivation

POINTS = {
    asked.TABLE: 5,
    asked.MATRIX: 2,
    asked.RECURSION: 3,
    asked.TRANSFORM: 3,
    asked.FORWARD: 3,
    asked.SOLUTIONS: 5,
    asked.CLOUD: 2,
    asked.REACH: 2,
    asked.RANKS: 3,
    asked.DETERMINANT: 3,
}

_INTRODUCTION = """\
# Exercise: {title}

**Objective.** From the axes of a robot to its table, its matrices, a working forward model{others}.

**How to work.** Each question has a cell with `...` for your answer, a picture of *your* result to look at, and a `check`
cell that hands it in. Leave the check cells as they are. Stuck? `hint("{name}.table")` helps. What can be told here, `check`
tells at once: right, or which mistake it is. `solution("{name}.table")` unfolds once yours is right.

**Conventions.** Modified Denavit-Hartenberg (Khalil-Kleinfinger). Lengths in metres, angles in radians: {letters}."""

_ROBOT = """\
## The robot

Seen from frame 0, with every turning joint at zero:

{axes}"""

_TABLE = """\
## {number}. The table ({points} points)

Give the DHm table: {count} rows `[sigma, a, alpha, d, theta]`, in the order of the joints. `sigma` is 0 for a revolute and 1 for a
prismatic joint{constant}. Use `{symbols}`; for half a turn write `pi`. The end effector must end as in the drawing; between it and
frame 0 any frames that obey the convention will do."""

_MATRICES = """\
## {number}. The matrix of joint 2 ({points} points)

For this question and the next one we all take the same frames. With every turning joint at zero:

* frame 1: $O_1$ at ${o1}$, $X_1$ along ${x1}$, $Z_1$ along ${z1}$;
* frame 2: $O_2$ at ${o2}$, $X_2$ along ${x2}$, $Z_2$ along ${z2}$.

Give ${{}}^1T_2$ as a 4x4 sympy `Matrix`."""

_STEP = """\
def step(a, alpha, d, theta):
    c, s, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)
    return Matrix([[c, -s, 0, a], [s * ca, c * ca, -sa, -d * sa], [s * sa, c * sa, ca, d * ca], [0, 0, 0, 1]])


T12 = step({row})"""

_NUMERIC_TABLE = """\
def numeric_table({joints}):
    here = lengths | dict(zip({names}, ({joints},)))
    return [[float(entry.subs(here)) if hasattr(entry, "subs") else entry for entry in row] for row in table]"""

_APPROACH = """\
# Newton's method with the forward model alone. It knows no branches, so it starts from many places.
def miss(q):
    pose = forward(*q)
    {miss}


def approach(q):
    for _ in range(60):
        now = miss(q)
        slopes = np.column_stack([(miss(q + move) - now) / 1e-6 for move in 1e-6 * np.eye({count})])
        q = q - np.clip(np.linalg.lstsq(slopes, now, rcond=1e-6)[0], -0.5, 0.5)
        if np.abs(miss(q)).max() < 1e-11:
            break
    return np.where({turns}, np.angle(np.exp(1j * q)), q)


solutions, rng = [], np.random.default_rng(1)
for _ in range({starts}):
    q = approach(rng.uniform({low}, {high}))
    reached = {reached}
    known = any(np.allclose(np.exp(1j * q), np.exp(1j * other), atol=1e-4) for other in solutions)
    if reached and not known:
        solutions.append(q)"""

_IN_CLOSED_FORM = """\
# In closed form, by Paul's method; the derivation stands below.
def inverse_model():
{program}

    return postures


{pose}solutions = inverse_model()({given})
display(Markdown(r\"\"\"{derivation}\"\"\"))"""

_FIRST = """\
    if len(solutions) == 1:
        break  # of infinitely many, one is enough"""

_JACOBIAN = """\
def jacobian(*q):
    frame, joints = np.eye(4), []
    for row, symbols_of_row in zip(numeric_table(*q), table):
        frame = frame @ np.array(step(*row[1:]), float)
        if Matrix([symbols_of_row]).has({joints}):
            joints.append((row[0], frame[:3, 2], frame[:3, 3]))
    end = frame[:3, 3]
    columns = [
        np.r_[z, 0, 0, 0] if slides else np.r_[np.cross(z, end - origin), z]
        for slides, z, origin in joints
    ]
    return np.array(columns).T{rows}


ranks = [int(np.linalg.matrix_rank(jacobian(*q), tol=1e-9)) for q in configurations]"""


@dataclass(frozen=True)
class _Exercise:
    """What the cells of a question are made of."""

    name: str
    arm: Described

    @property
    def joints(self) -> str:
        return ", ".join(self.arm.joints)


def solution_notebook(name: str, arm: Described, kinds: list[str]) -> NotebookNode:
    """The notebook with answers, as `autograder release` takes it."""
    lengths = ", ".join(f"`{letter}` = {value:g} m" for letter, value in arm.table.values.items())
    letters = ", ".join(
        filter(None, [", ".join(f"`{joint}`" for joint in arm.joints) + " are the joint variables", lengths])
    )
    exercise = _Exercise(name, arm)
    robot = arm_from(shown(arm))
    slides = "\n\nSlides are drawn out a little." if len(turning(arm)) < len(arm.joints) else ""
    cells = [
        _text("title", _INTRODUCTION.format(title=arm.title, others=_others(arm, kinds), name=name, letters=letters)),
        _code("imports", "\n".join(_imports(arm, kinds))),
        _text("robot", _ROBOT.format(axes=robot.in_words()) + slides),
        _code("drawing", f'arm = arm_of_exercise("{name}")\ndraw_arm(arm);'),
    ]
    for number, kind in enumerate(kinds, 1):
        cells += _WAYS[kind](exercise, number)
    cells.append(_code("progress", "progress()"))
    python = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    return new_notebook(cells=cells, metadata={**python, "language_info": {"name": "python"}})


def _others(arm: Described, kinds: list[str]) -> str:
    said = {
        asked.SOLUTIONS: "one of the ways to reach a pose" if asked.is_family(arm) else "every way to reach a pose",
        asked.CLOUD: "a part of its workspace",
        asked.RANKS: "its singular configurations",
    }
    parts = [words for kind, words in said.items() if kind in kinds]
    return ", " + " and ".join([", ".join(parts[:-1]), parts[-1]] if parts[1:] else parts) if parts else ""


_PICTURES = {
    asked.TABLE: "show_table",
    asked.MATRIX: "show_seen_from",
    asked.RECURSION: "show_seen_from",
    asked.TRANSFORM: "show_on_arm",
    asked.FORWARD: "show_on_arm",
    asked.SOLUTIONS: "show_all_postures",
    asked.CLOUD: "show_points",
    asked.REACH: "show_distances",
    asked.RANKS: "show_ranks",
    asked.DETERMINANT: "show_zeros",
}


def _imports(arm: Described, kinds: list[str]) -> Iterator[str]:
    yield "from dhkit import check, hint, progress, solution"
    yield ""
    yield "import numpy as np"
    yield "from IPython.display import Markdown, display"
    yield "from sympy import Matrix, cos, eye, factor, lambdify, pi, simplify, sin, sqrt, symbols"
    yield ""
    yield "from dhkit.arms import arm_of_exercise"
    yield "from dhkit.drawing.arms import draw_arm"
    yield "from dhkit.pictures import ("
    yield from (f"    {name}," for name in sorted({_PICTURES[kind] for kind in kinds}))
    yield ")"
    yield ""
    yield f"{', '.join(arm.letters)} = symbols({' '.join(arm.letters)!r})".replace("'", '"')
    yield f"lengths = {dict(arm.table.values)}".replace("'", '"')
    at = {joint: 0.3 if i in turning(arm) else 0.2 for i, joint in enumerate(arm.joints)}
    yield "# Numbers for the pictures."
    yield f"sample = lengths | {at}".replace("'", '"')


def _table(exercise: _Exercise, number: int) -> list[NotebookNode]:
    arm, rows = exercise.arm, list_rows(exercise.arm.table)
    constant = "; a row without a joint variable is constant" if len(rows) > len(arm.joints) else ""
    statement = _TABLE.format(
        number=number,
        points=POINTS[asked.TABLE],
        count=len(rows),
        constant=constant,
        symbols=", ".join(arm.letters),
    )
    stub = "table = [\n" + "    [..., ..., ..., ..., ...],\n" * len(rows) + "]"
    worked = "table = [\n" + "".join(f"    {row},\n" for row in rows) + "]"
    numeric = _NUMERIC_TABLE.format(joints=exercise.joints, names=str(arm.joints).replace("'", '"'))
    return [
        _text("q-table", statement),
        *_answer(exercise, asked.TABLE, stub, worked, f"{numeric}\n\n\nshow_table(table, sample);"),
    ]


def _matrix(exercise: _Exercise, number: int) -> list[NotebookNode]:
    first, second = frames_in_space(exercise.arm.table)[:2]
    places = {
        "o1": said_point(tuple(origin_of(first))),
        "x1": said_direction(tuple(direction_of(first, 0))),
        "z1": said_direction(tuple(direction_of(first, 2))),
        "o2": said_point(tuple(origin_of(second))),
        "x2": said_direction(tuple(direction_of(second, 0))),
        "z2": said_direction(tuple(direction_of(second, 2))),
    }
    statement = _MATRICES.format(number=number, points=POINTS[asked.MATRIX], **places)
    row = ", ".join(str(entry) for entry in list_rows(exercise.arm.table)[1][1:])
    worked = _STEP.format(row=row)
    picture = 'show_seen_from(T12, sample, ("1", "2"));'
    return [
        _text("q-T12", statement),
        *_answer(exercise, asked.MATRIX, "T12 = ...  # 4x4 sympy Matrix", worked, picture),
    ]


def _recursion(exercise: _Exercise, number: int) -> list[NotebookNode]:
    rows, end = list_rows(exercise.arm.table), end_frame(exercise.arm.table)
    statement = (
        f"## {number}. Without the first joint ({POINTS[asked.RECURSION]} points)\n\n"
        f"Give $U_1 = {{}}^1T_{end}$, the end effector seen from frame 1, as a 4x4 sympy `Matrix`: $U_{{j-1}} = {{}}^{{j-1}}T_j\\,U_j$, "
        "from the end effector towards the base. Simplified or not is up to you."
    )
    behind = "\n".join(f"U = (step({', '.join(map(str, row[1:]))}) * U).expand()" for row in rows[:1:-1])
    worked = f"U = eye(4)\n{behind}\nU1 = (T12 * U).expand()"
    picture = f'show_seen_from(U1, sample, ("1", "{end}"));'
    return [
        _text("q-U1", statement),
        *_answer(exercise, asked.RECURSION, "U1 = ...  # 4x4 sympy Matrix", worked, picture),
    ]


def _transform(exercise: _Exercise, number: int) -> list[NotebookNode]:
    rows, end = list_rows(exercise.arm.table), end_frame(exercise.arm.table)
    statement = (
        f"## {number}. From the base ({POINTS[asked.TRANSFORM]} points)\n\n"
        f"Give ${{}}^0T_{end}$ as a 4x4 sympy `Matrix`. Where is the end effector with every turning joint at zero? Compare with "
        "the drawing."
    )
    worked = f"T0E = (step({', '.join(map(str, rows[0][1:]))}) * U1).expand()"
    if not asked.has_second_joint(exercise.arm):
        factors = " * ".join(f"step({', '.join(map(str, row[1:]))})" for row in rows)
        worked = f"{_STEP.partition('T12')[0]}T0E = {factors}"
    return [
        _text("q-T0E", statement),
        *_answer(exercise, asked.TRANSFORM, "T0E = ...  # 4x4 sympy Matrix", worked, "show_on_arm(T0E, arm);"),
    ]


def _forward(exercise: _Exercise, number: int) -> list[NotebookNode]:
    call = f"forward({exercise.joints})"
    statement = (
        f"## {number}. The forward model as a function ({POINTS[asked.FORWARD]} points)\n\n"
        f"Write `{call}` for numbers, with the lengths in `lengths`: it returns the pose as a 4x4 array of numbers."
    )
    stub = f"def {call}:\n    return ..."
    worked = (
        f"pose_of = lambdify([{exercise.joints}], T0E.subs(lengths), cse=True)\n\n\n"
        f"def {call}:\n    return np.array(pose_of({exercise.joints}), float)"
    )
    return [
        _text("q-forward", statement),
        *_answer(exercise, asked.FORWARD, stub, worked, "show_on_arm(forward, arm);"),
    ]


def _solutions(exercise: _Exercise, number: int) -> list[NotebookNode]:
    arm, family = exercise.arm, asked.is_family(exercise.arm)
    pose = np.round(target(arm), 6) + 0.0
    point = is_for_point(arm)
    if point:
        wanted = f"target = np.array({pose[:3, 3].tolist()})"
        what = "The origin of the end effector's frame is to come to the point `target`"
    else:
        rows = ",\n".join(f"    {row}" for row in pose.tolist())
        wanted = f"target = np.array([\n{rows},\n])"
        what = "The end effector is to stand at `target`"
    title = f"{'A way' if family else 'Every way'} to reach a {'point' if point else 'pose'}"
    ask = (
        f"There is no end of ways: a joint is left over. Give one or more `[{exercise.joints}]`"
        if family
        else f"Give all joint values `[{exercise.joints}]`"
    )
    statement = (
        f"## {number}. {title} ({POINTS[asked.SOLUTIONS]} points)\n\n"
        f"{what}, seen from frame 0. {ask} that bring it there, to three decimals; angles may differ by full turns."
    )
    worked = _in_closed_form(arm) or _by_newton(arm)
    return [
        _text("q-solutions", statement),
        _code("target", wanted),
        *_answer(
            exercise,
            asked.SOLUTIONS,
            f"solutions = [...]  # {'one or more' if family else 'all'} [{exercise.joints}]",
            worked,
            "show_all_postures(solutions, numeric_table, target);",
        ),
    ]


def _in_closed_form(arm: Described) -> str | None:
    """The derived inverse model as a program, and what derives it; None where there is no end of solutions, or no closed form."""
    if asked.is_family(arm) or not (found := derivation(robot_of(arm))).steps:
        return None
    point = is_for_point(arm)
    return _IN_CLOSED_FORM.format(
        program=textwrap.indent(found.to_python().strip(), "    "),
        pose="pose = np.eye(4)\npose[:3, 3] = target\n" if point else "",
        given="pose" if point else "target",
        derivation=str(found.to_markdown()).strip().replace("## ", "#### "),  # below the question's own heading
    )


def _by_newton(arm: Described) -> str:
    """A search with the forward model alone."""
    point = is_for_point(arm)
    turns = [i in turning(arm) for i in range(len(arm.joints))]
    worked = _APPROACH.format(
        count=len(arm.joints),
        miss=(
            "return pose[:3, 3] - target"
            if point
            else "turn = np.cross(pose[:3, :3].T, target[:3, :3].T).sum(axis=0) / 2\n    return np.r_[pose[:3, 3] - target[:3, 3], -turn]"
        ),
        reached=("np.allclose(miss(q), 0, atol=1e-5)" if point else "np.allclose(forward(*q), target, atol=1e-5)"),
        turns=turns,
        starts=400,
        low=[-3 if turn else 0 for turn in turns],
        high=[3 if turn else 0.5 for turn in turns],
    )
    if asked.is_family(arm):
        worked += "\n" + _FIRST
    return worked


def _cloud(exercise: _Exercise, number: int) -> list[NotebookNode]:
    arm, sweep = exercise.arm, sweep_of(exercise.arm)
    assert sweep is not None
    names = [arm.joints[i] for i in sweep.joints]
    units = ["rad" if i in turning(arm) else "m" for i in sweep.joints]
    ranges = [
        f"`{name}` from {low:g} to {high:g} {unit}" for name, unit, (low, high) in zip(names, units, sweep.ranges)
    ]
    held = [f"`{joint}` = {sweep.held[i]:g}" for i, joint in enumerate(arm.joints) if i not in sweep.joints]
    statement = (
        f"## {number}. A part of the workspace ({POINTS[asked.CLOUD]} points)\n\n"
        f"Two joints move: {ranges[0]}, {ranges[1]}{'; the others stand still: ' + ', '.join(held) if held else ''}. Where does the origin of "
        "the end effector's frame get? Give points `[x, y, z]` that cover this surface, seen from frame 0, at most 5000."
    )
    values = ", ".join(name if name in names else f"{sweep.held[i]:g}" for i, name in enumerate(arm.joints))
    given = f"ranges = {[list(pair) for pair in sweep.ranges]}  # of {names[0]} and {names[1]}"
    worked = (
        f"def place({', '.join(names)}):\n    return forward({values})[:3, 3]\n\n\n"
        f"first, second = (np.linspace(*limits, 60) for limits in ranges)\n"
        "cloud = np.array([place(one, other) for one in first for other in second])"
    )
    return [
        _text("q-cloud", statement),
        _code("ranges", given),
        *_answer(exercise, asked.CLOUD, "cloud = ...  # rows [x, y, z]", worked, "show_points(cloud, arm);"),
    ]


def _reach(exercise: _Exercise, number: int) -> list[NotebookNode]:
    statement = (
        f"## {number}. How near, how far ({POINTS[asked.REACH]} points)\n\n"
        "While the two joints run over these ranges: how near does the origin of the end effector's frame come to the axis $Z_0$, and "
        "how far from it does it get? Give `[smallest, largest]` in metres; three decimals are enough."
    )
    worked = """\
def distance(one, other):
    return np.hypot(*place(one, other)[:2])


def extreme(sign):
    limits = np.array(ranges)
    for _ in range(4):  # each grid closes in on the best point of the one before
        first, second = (np.linspace(*pair, 31) for pair in limits)
        grid = [(one, other) for one in first for other in second]
        best = np.array(min(grid, key=lambda pair: sign * distance(*pair)))
        width = (limits[:, 1] - limits[:, 0]) / 15
        low, high = np.array(ranges).T
        limits = np.clip([best - width, best + width], low, high).T
    return distance(*best)


reach = [extreme(1), extreme(-1)]"""
    return [
        _text("q-reach", statement),
        *_answer(
            exercise, asked.REACH, "reach = [..., ...]  # smallest, largest", worked, "show_distances(reach, cloud);"
        ),
    ]


def _ranks(exercise: _Exercise, number: int) -> list[NotebookNode]:
    arm = exercise.arm
    what = "of the position, three rows," if task_rows(arm) == 3 else "of six rows"
    statement = (
        f"## {number}. Freedoms that are left ({POINTS[asked.RANKS]} points)\n\n"
        f"How many freedoms does the end effector have in each of the four `configurations`, A to D? It is the rank of the Jacobian {what} "
        "there; where it is lower than elsewhere the configuration is singular. Give `[A, B, C, D]`."
    )
    rows = [", ".join(str(_plain(value)) for value in q) for q in configurations(arm)]
    given = "configurations = [\n" + "".join(f"    [{row}],  # {letter}\n" for row, letter in zip(rows, "ABCD")) + "]"
    worked = _JACOBIAN.format(joints=exercise.joints, rows="[:3]" if task_rows(arm) == 3 else "")
    return [
        _text("q-ranks", statement),
        _code("configurations", given),
        *_answer(
            exercise,
            asked.RANKS,
            "ranks = [..., ..., ..., ...]",
            worked,
            "show_ranks(ranks, configurations, numeric_table);",
        ),
    ]


def _plain(value: sympy.Expr) -> str:
    """A joint value as Python has it, quarter turns by numpy's pi."""
    return str(value).replace("pi", "np.pi") if value.has(sympy.pi) else f"{float(value):g}"


def _determinant(exercise: _Exercise, number: int) -> list[NotebookNode]:
    arm, turns = exercise.arm, senses(exercise.arm)
    fourth = " and, in the fourth row, the rate at which the end effector turns about $Z_0$" if turns else ""
    rates = ",".join(rf"\dot{{{joint}}}" for joint in _typeset(arm.joints))
    statement = (
        f"## {number}. Where the arm is singular ({POINTS[asked.DETERMINANT]} points)\n\n"
        f"Give the determinant of the Jacobian that turns the joint rates $({rates})$ into "
        f"$(\\dot x, \\dot y, \\dot z)$ of the end effector's origin{fourth}. Where does it vanish?"
    )
    row = (
        f"\nJ = J.col_join(Matrix([{list(turns)}]))  # 1 or -1: the sense in which each joint turns about Z0"
        if turns
        else ""
    )
    worked = f"J = T0E[:3, 3].jacobian([{exercise.joints}]){row}\ndeterminant = factor(simplify(J.det()))"
    found = arm.joints[max(turning(arm)[1:] or turning(arm), key=lambda i: _matters(arm, i))]
    return [
        _text("q-determinant", statement),
        *_answer(
            exercise, asked.DETERMINANT, "determinant = ...", worked, f'show_zeros(determinant, sample, "{found}");'
        ),
    ]


def _matters(arm: Described, place: int) -> bool:
    found = determinant(arm)
    return found is not None and found.has(arm.table.joints[place])


def _typeset(joints: list[str]) -> list[str]:
    return [f"{joint.rstrip('0123456789')}_{{{joint[len(joint.rstrip('0123456789')) :]}}}" for joint in joints]


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


def _answer(exercise: _Exercise, kind: str, stub: str, worked: str, picture: str) -> list[NotebookNode]:
    """The cells in which a question is answered, looked at and handed in; the answer has the question's name."""
    name = exercise.name
    marks = {"cell_type": "code", "schema_version": 3, "task": False}
    answer = marks | {"grade": False, "grade_id": f"{name}-{kind}-answer", "locked": False, "solution": True}
    check = marks | {
        "grade": True,
        "grade_id": f"{name}-{kind}",
        "locked": True,
        "points": POINTS[kind],
        "solution": False,
    }
    source = f"{stub}\n### BEGIN SOLUTION\n{worked}\n### END SOLUTION"
    return [
        _code(f"{name}-{kind}-answer", source, answer),
        _text(f"look-{kind}", "What your answer describes:"),
        _code(f"picture-{kind}", picture),
        _code(f"{name}-{kind}", f'check("{name}.{kind}", {kind})', check),
    ]


def _text(id: str, source: str) -> NotebookNode:
    return new_markdown_cell(source, id=id)


def _code(id: str, source: str, marks: dict | None = None) -> NotebookNode:
    return new_code_cell(source, id=id, metadata={"nbgrader": marks} if marks else {})
