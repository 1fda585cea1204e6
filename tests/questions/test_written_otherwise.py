"""Right answers in every form a student may give them, for every question: right for the judge, in the form at home."""

import numpy as np
import pytest
import sympy
from answers import STUDENT, entries, evidence, right, verdict

from autograder.judge import Evidence, judge
from autograder.judge.almost import ASSUMED, TURNED
from autograder.questions import exercises
from dhkit import wire
from dhkit.forms.classic_table import CLASSIC_COLUMNS
from dhkit.forms.dh_table import DH_COLUMNS

QUESTIONS = [question for questions in exercises().values() for question in questions]
DATA = [question for question in QUESTIONS if question.form.kind != "function"]
FUNCTIONS = [question for question in QUESTIONS if question.form.kind == "function"]
SYMBOLIC = [question for question in DATA if question.form.symbols]
of_kind = lambda *kinds: [question for question in DATA if question.form.kind in kinds]  # noqa: E731
by_id = lambda question: question.id  # noqa: E731


def is_right(question, answer):
    """Right for the judge and in the form at home; made twice, as a generator is used up."""
    node = wire.encode(answer())
    assert question.form.complaint(node) is None, answer()
    found = judge(question, Evidence(wire.packet(question.id, answer=node)), STUDENT)
    assert (found.note, found.share) == ("right", 1.0), (node, found)


@pytest.mark.parametrize("question", of_kind("choice"), ids=by_id)
def test_choices(question):
    letter = right(question)
    wide = chr(ord(letter) + 0xFEE0)
    for form in (
        letter,
        letter.lower(),
        f"({letter})",
        f"{letter}.",
        f" {letter} )",
        wide,
        f"({wide.lower()})",
        f"'{letter}'",
    ):
        for given in (form, [form], (form,), {form}, np.array([form]), sympy.Symbol(form)):
            is_right(question, lambda given=given: given)


@pytest.mark.parametrize("question", of_kind("joint_solutions", "point_cloud"), ids=by_id)
def test_rows(question):
    rows = np.array(right(question), dtype=float).tolist()
    columns = list(zip(*rows, strict=True))
    is_right(question, lambda: (tuple(row) for row in rows))
    is_right(question, lambda: zip(*columns, strict=True))
    is_right(question, lambda: map(np.array, rows))
    is_right(question, lambda: dict(enumerate(rows)).values())
    is_right(question, lambda: {tuple(row) for row in rows})
    is_right(question, lambda: rows[::-1])
    if question.form.kind == "joint_solutions":
        joints = question.form.joints
        is_right(question, lambda: dict(zip(joints, columns, strict=True)))
        is_right(question, lambda: dict(zip(map(sympy.Symbol, joints), map(np.array, columns), strict=True)))
        is_right(question, lambda: [sympy.Dict(dict(zip(sympy.symbols(joints), row))) for row in rows])
        is_right(question, lambda: sympy.FiniteSet(*(sympy.Tuple(*row) for row in rows)))
        found = verdict(question, np.array(columns))
        assert found.note in (TURNED, "right") if len(rows) == len(joints) else "not a column" in found.feedback, found
    else:
        assert "not a column" in verdict(question, np.array(columns)).feedback


@pytest.mark.parametrize("question", of_kind("dh_table", "classic_table"), ids=by_id)
def test_tables(question):
    table = entries(right(question)).tolist()
    columns = DH_COLUMNS if question.form.kind == "dh_table" else CLASSIC_COLUMNS
    is_right(question, lambda: (row for row in table))
    is_right(question, lambda: zip(*zip(*table, strict=True), strict=True))
    is_right(question, lambda: dict(zip(columns, zip(*table, strict=True), strict=True)))
    turned = [
        [cell + 2 * sympy.pi if name in ("alpha", "theta") else cell for name, cell in zip(columns, row)]
        for row in table
    ]
    is_right(question, lambda: turned)


@pytest.mark.parametrize("question", of_kind("vector", "direction", "orientation"), ids=by_id)
def test_vectors(question):
    vector = entries(right(question)).tolist()
    is_right(question, lambda: sympy.Matrix(vector))
    is_right(question, lambda: sympy.Matrix([vector]))
    is_right(question, lambda: (entry for entry in vector))
    is_right(question, lambda: dict(enumerate(vector)).values())
    is_right(question, lambda: [sympy.Eq(sympy.Symbol("left"), entry, evaluate=False) for entry in vector])
    if question.form.names:
        is_right(question, lambda: dict(zip(map(sympy.Symbol, question.form.names), vector)))
    if question.form.unordered:
        is_right(question, lambda: set(right(question)))
        is_right(question, lambda: right(question)[::-1])


@pytest.mark.parametrize("question", of_kind("number", "expression"), ids=by_id)
def test_single_values(question):
    value = sympy.sympify(right(question))
    for one in (
        value,
        [value],
        {value},
        np.array([value]),
        sympy.Matrix([value]),
        [(value,)],
        {"value": value},
        [{sympy.Symbol("v"): value}],
    ):
        is_right(question, lambda one=one: one)
    is_right(question, lambda: sympy.Eq(sympy.Symbol("left"), value))


@pytest.mark.parametrize("question", SYMBOLIC, ids=by_id)
def test_symbols_of_other_kinds(question):
    answer = entries(right(question))
    time, names = sympy.Symbol("t"), question.form.symbols
    of_time = {sympy.Symbol(name): sympy.Function(name)(time) for name in names}
    real = {sympy.Symbol(name): sympy.Symbol(name, real=True) for name in names}
    change = lambda replaced: np.vectorize(lambda e: e.xreplace(replaced), otypes=[object])(answer)  # noqa: E731
    for replaced in (of_time, real):
        changed = change(replaced)
        is_right(question, lambda changed=changed: changed.tolist())
    cut = np.vectorize(
        lambda e: sympy.Piecewise((e, sympy.Symbol(names[0]) > 0.1), (e + 0, True), evaluate=False), otypes=[object]
    )
    if question.form.kind != "dh_table":
        is_right(question, lambda: cut(answer).tolist())


@pytest.mark.parametrize("question", SYMBOLIC, ids=by_id)
def test_symbols_declared_positive(question):
    """Lengths are; where SymPy has simplified with it what is right for both signs, the student is told of it."""
    answer = entries(right(question))
    positive = {sympy.Symbol(name): sympy.Symbol(name, positive=True) for name in question.form.symbols}
    changed = np.vectorize(lambda e: e.xreplace(positive).doit(), otypes=[object])(answer)
    node, assumed = wire.encode_with_assumptions(changed.tolist())
    found = judge(question, Evidence(wire.packet(question.id, answer=node, assumed=assumed)), STUDENT)
    assert found.share == 1 or (found.note, found.share) == (ASSUMED, 0.8), found
    if found.note == ASSUMED:
        assert "positive" in found.feedback and "loses the quadrant" not in found.feedback


@pytest.mark.parametrize("question", FUNCTIONS, ids=by_id)
def test_what_functions_return(question):
    function = question.answer(STUDENT)
    plain = lambda *args: np.array(getattr(found := function(*args), "solutions", found), dtype=float)  # noqa: E731
    forms = {
        "matrix": lambda *args: sympy.Matrix(plain(*args).tolist()),
        "array": plain,
        "tuple": lambda *args: tuple(plain(*args)),
    }
    if question.returns.kind == "number":
        forms = {
            "array": plain,
            "list": lambda *args: [plain(*args)],
            "matrix": lambda *args: sympy.Matrix([float(plain(*args))]),
        }
    if question.returns.kind == "joint_solutions":
        joints = len(question.returns.joints)
        rows = lambda *args: plain(*args).reshape(-1, joints)  # noqa: E731
        forms = {
            "empty array": rows,
            "generator": lambda *args: (tuple(row) for row in rows(*args)),
            "set": lambda *args: set(map(tuple, rows(*args).tolist())),
            "zip": lambda *args: zip(*rows(*args).T, strict=True),
            "column": lambda *args: sympy.Matrix(found[0].tolist()) if len(found := rows(*args)) == 1 else found,
            "dictionaries": lambda *args: [dict(zip(question.returns.joints, row)) for row in rows(*args)],
        }
    for name, form in forms.items():
        found = judge(question, evidence(question, form), STUDENT)
        assert found.share == 1, (name, found)
