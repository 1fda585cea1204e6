"""Home and judge agree: ``check`` says that a form is right exactly where the judge does not call the answer malformed."""

import json
import re
from decimal import Decimal
from fractions import Fraction
from functools import cache
from importlib import import_module

import numpy as np
import pytest
import sympy
from answers import STUDENT, other_forms, right, verdict
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.judge import kinds
from autograder.judge.decode import Malformed, decode_answer
from autograder.questions import exercises
from dhkit import check, wire
from dhkit.public_checks import Returns, ValueAt

pytestmark = pytest.mark.slow

QUESTIONS = [question for questions in exercises().values() for question in questions]
DATA = [question for question in QUESTIONS if question.form.kind != "function"]
FUNCTIONS = [question for question in QUESTIONS if question.form.kind == "function"]
FORMS = {question.id: question.form for question in DATA} | {f"{q.id}()": q.returns for q in FUNCTIONS}
ids = lambda questions: [question.id for question in questions]  # noqa: E731

t1, t2, q = sympy.symbols("t1 t2 q")


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """Away from the sealed verdicts, which cost time and are tried in ``tests/sealing``."""
    monkeypatch.chdir(tmp_path)


class Odd:
    """An object that fails whatever it is asked."""

    def __getattr__(self, name):
        raise RuntimeError(name)

    __str__ = __repr__ = __len__ = __iter__ = __float__ = __bool__ = lambda self: 1 / 0


class OddMapping(dict):
    def items(self):
        raise RuntimeError("no items")


def endless():
    value = []
    value.append(value)
    return value


def doubled(times):
    """An expression of few objects that is very long when written out."""
    expression = t1
    for _ in range(times):
        expression = sympy.Mul(expression + 1, expression + 2, evaluate=False)
    return expression


ENTRIES = [
    0, 1, -1, True, False, 0.5, -0.0, 1e308, 5e-324, 2**53 + 1, -(10**60), 10**400, Fraction(1, 3), Decimal("0.5"), 1j, 1 + 0j,
    complex("nan+1j"), float("nan"), float("inf"), float("-inf"), np.float32(0.5), np.int8(3), np.bool_(True),
    np.complex64(1), np.float64("nan"), np.array(0.5), np.datetime64("2020-01-01"), None, ..., "", "0.5", " 1e-3 ", "t1", "pi/2",
    "A", "b", "\ud800", "x" * 2000, b"bytes", sympy.pi, sympy.E, sympy.I, sympy.sqrt(2), sympy.Rational(1, 3), sympy.Float("1e400"),
    sympy.Integer(10) ** 400, sympy.Rational(1, 10**400), sympy.oo, sympy.zoo, sympy.nan, sympy.true, t1, q, sympy.cos(t1), sympy.exp(sympy.I * t1),
    sympy.exp(2), sympy.Pow(0, -1, evaluate=False), sympy.log(0, evaluate=False), sympy.sqrt(-2), sympy.asin(2), sympy.atan2(t1, 1),
    sympy.Max(t1, 1), sympy.Mod(t1, 2), sympy.Piecewise((t1, t1 > 0), (0, True)), sympy.sin(sympy.Piecewise((t1, t1 > 0), (0, True))),
    sympy.Function("f")(t1), sympy.Function("sin")(t1, t1), sympy.Function("Max")(sympy.Tuple(1, 2)), sympy.Function("f"), sympy.sinc(t1),
    sympy.re(t1), sympy.Sum(t1, (t1, 1, 3)), sympy.Eq(t1, 1), t1 > 0, sympy.Symbol("x" * 3000), sympy.Symbol("\ud800"), sympy.Dummy("t1"),
    sympy.UnevaluatedExpr(t1), sympy.MatrixSymbol("A", 2, 2), sympy.Derivative(sympy.cos(t1), t1, evaluate=False), sympy.Lambda(t1, t1),
    Odd(), Odd, OddMapping(t1=1), object(), len, np.sin, lambda x: x, {}, {"t1": 1}, {t1: 1}, {1: 2}, [], (), [[]], {1, 2}, range(3),
    (i for i in (1, 2)), [1, [2]], [1, 2], sympy.Matrix([1, 2]), sympy.Tuple(1, 2),
]  # fmt: skip

ANSWERS = [
    *ENTRIES, endless(), doubled(40), sympy.Matrix([[1, 2], [3, 4]]), sympy.zeros(0, 2), sympy.zeros(3, 0), np.zeros((0, 2)), np.zeros((0, 6)),
    np.zeros((2, 0)), np.zeros(0), [[0.1, 0.2]], [[0.1], [0.2]], np.eye(3), np.eye(4), sympy.eye(4), sympy.Array([[1, 2], [3, 4]]),
    np.matrix([[1, 2]]), np.ma.masked_array([1.0, 2.0], [False, True]), np.array([{}, None], dtype=object), sympy.MatrixSymbol("A", 10**4, 10**4),
    sympy.MatrixSymbol("A", sympy.Symbol("n"), 2), sympy.MatMul(sympy.eye(2), sympy.Matrix([1, 2])), np.zeros((200, 200)), np.zeros(30_000),
    [[0.1, 0.2]] * 101, [[0.1, 0.2]] * 5001, [[...] * 2] * 2, [..., [1, 2]], {"x": 1, "y": 2}, {"x": ..., "y": ...}, [{"x": 1, "y": 2}],
    {(0.1, 0.2), (0.3, 0.4)}, frozenset({(0.1, 0.2)}), "no solution", "A", "a ", "E",
]  # fmt: skip


@cache
def encoded(answers):
    """The nodes of a whole list of answers, made once."""
    return [wire.encode(answer) for answer in {"entries": ENTRIES, "answers": ANSWERS}[answers]]


def shaped(form, node):
    """Answers near the form, with `node` in one place or in all."""
    rows = {"joint_solutions": (2, len(getattr(form, "joints", ()))), "point_cloud": (3, *form.shape)}
    shape = rows.get(form.kind, form.shape)
    filled = lambda sizes, entry: [filled(sizes[1:], entry) for _ in range(sizes[0])] if sizes else entry  # noqa: E731
    yield filled(shape, node)
    whole = filled(shape, 0.25)
    place = whole
    for _ in shape[:-1]:
        place = place[-1]
    if shape:
        place[-1] = node
        yield whole
        yield whole[-1]
    if len(shape) == 1:
        yield [[entry] for entry in whole]
        yield [whole]
        yield [whole, whole]


def keyed(form):
    """Answers with names for their parts: of the entries, of the columns, of each row; a name too few; a name twice."""
    names = getattr(form, "names", ()) or getattr(form, "joints", ()) or ("t1", "t2")
    columns = ("sigma", "a", "alpha", "d", "theta") if form.kind == "dh_table" else names
    count = form.shape[0] if form.kind == "dh_table" else 2
    for keys in (columns, names, columns[::-1], columns[1:]):
        for key in (str, sympy.Symbol):
            yield {key(name): 0.5 for name in keys}
            yield [{key(name): 0.5 for name in keys} for _ in range(count)]
            yield {key(name): [0.5] * count for name in keys}
            yield {key(name): [0.5] * (1 + i % 2) for i, name in enumerate(keys)}
            yield {key(name): ... for name in keys}
    yield {"t1": 1, t1: 2, **dict.fromkeys(columns[1:], 0)}


def agree(form, node):
    """Whether the form is right, at home and for the judge."""
    home = form.complaint(node)
    packet = json.loads(json.dumps(wire.packet("a.b", answer=node), allow_nan=False).encode("utf-8"))
    try:
        kinds.read(form, decode_answer(packet, "a.b"))
    except Malformed as fault:
        assert home is not None, (node, str(fault))
        assert str(fault) == home or "inside an expression" in str(fault), "home says what the judge says"
        return False
    assert home is None, (node, home)
    return True


@pytest.mark.parametrize("id", FORMS)
def test_a_form_is_right_at_home_where_it_is_for_the_judge(id):
    form, found = FORMS[id], 0
    for node in encoded("answers"):
        found += agree(form, node)
    for node in encoded("entries"):
        found += sum(agree(form, answer) for answer in shaped(form, node))
    for answer in keyed(form):
        found += agree(form, wire.encode(answer))
    assert found > 2, "some answer is in the form"


@pytest.mark.parametrize("question", DATA, ids=ids(DATA))
def test_right_answers_are_in_the_form_however_they_are_written(question):
    for answer in (right(question), *other_forms(question, right(question)).values()):
        assert agree(question.form, wire.encode(answer))


# Hypothesis prints what it draws: not these.
UNPRINTABLE = (Odd, OddMapping)
PRINTABLE = [entry for entry in ENTRIES if type(entry) not in UNPRINTABLE and "\ud800" not in str(entry)]
SCALARS = st.sampled_from(PRINTABLE) | st.floats() | st.integers() | st.text(max_size=5) | st.complex_numbers()
OBJECTS = st.recursive(
    SCALARS,
    lambda inner: (
        st.lists(inner, max_size=6)
        | st.lists(inner, max_size=4).map(tuple)
        | st.dictionaries(st.sampled_from(["t1", "t2", "x", "y", "sigma", t1]), inner, max_size=5)
        | st.builds(lambda rows, row: [row] * rows, st.integers(0, 6), st.lists(inner, max_size=6))
    ),
    max_leaves=40,
)


@pytest.mark.slow
@settings(max_examples=300, deadline=None)
@given(st.sampled_from(sorted(FORMS)), OBJECTS)
def test_home_and_judge_agree_on_any_object(id, answer):
    agree(FORMS[id], wire.encode(answer))


@pytest.mark.parametrize("nodes", [wire.MAX_NODES, wire.MAX_NODES + 1])
@pytest.mark.parametrize("kind", ["list", "sum", "complex", "fraction"])
def test_they_agree_at_the_bounds(kind, nodes):
    form = FORMS["planar_2r.model"]
    make = {
        "list": lambda: [[0.0] * (nodes - 1), 0.0],
        "sum": lambda: [sympy.Add(*[t1] * (nodes - 3), evaluate=False), 0.0],
        "complex": lambda: [1j] * ((nodes - 1) // 3) + [0.0],
        "fraction": lambda: [Fraction(1, 3)] * ((nodes - 1) // 3) + [0.0],
    }[kind]
    assert agree(form, wire.encode(make())) is (kind == "sum" and nodes <= wire.MAX_NODES)


@pytest.mark.parametrize("levels", [wire.MAX_DEPTH, wire.MAX_DEPTH + 1])
def test_they_agree_at_the_deepest_level(levels):
    expression = t1
    for _ in range(levels - 1):
        expression = sympy.sin(expression, evaluate=False)
    assert agree(FORMS["planar_2r.theta1"], wire.encode(sympy.sin(sympy.Symbol("x")))) is True
    assert agree(FORMS["planar_2r.model"], wire.encode([expression, 0])) is (levels <= wire.MAX_DEPTH)


# ---------------------------------------------------------------- check itself, and full verdicts


def said(capsys, question, answer):
    check(question.id, answer)
    return capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize(
    "id", ["planar_2r.table", "planar_2r.model", "planar_2r.T0E", "planar_2r.postures", "planar_2r.centre"]
)
def test_what_check_shows_is_what_the_verdict_says(id, capsys):
    question = next(question for question in QUESTIONS if question.id == id)
    for answer in (*ANSWERS, *keyed(question.form)):
        note, shown = verdict(question, answer).note, said(capsys, question, answer)
        assert ("not in the form asked for" in shown) is (note == "malformed"), (answer, shown)
        assert ("not attempted yet" in shown) is (note == "not_attempted"), (answer, shown)


@pytest.mark.parametrize("question", [*DATA[::7], *FUNCTIONS[::4]], ids=lambda question: question.id)
def test_check_hands_in_whatever_it_is_given(question, monkeypatch):
    shown = []
    display = lambda notice, data: shown.append(json.dumps([notice.text(), notice.html(), data]).encode("utf-8"))  # noqa: E731
    monkeypatch.setattr(import_module("dhkit.check"), "show", display)
    for answer in (*ANSWERS, lambda *args: exit(3), lambda *args: Odd(), lambda *args: endless()):
        check(question.id, answer)
    assert len(shown) == len(ANSWERS) + 3


def failed(capsys, question, answer):
    return re.findall("\N{BALLOT X} .*", said(capsys, question, answer))


@pytest.mark.parametrize("question", [q for q in DATA if q.public.public], ids=lambda question: question.id)
def test_no_public_check_fails_on_a_right_answer(question, capsys):
    for name, answer in {"as it is": right(question), **other_forms(question, right(question))}.items():
        assert not failed(capsys, question, answer), name


@pytest.mark.parametrize("digits", [2, 3, 4, 6])
@pytest.mark.parametrize(
    "question", [q for q in DATA if q.public.public and not q.form.symbols], ids=lambda question: question.id
)
def test_no_public_check_fails_on_what_the_judge_takes_as_rounded(question, digits, capsys):
    answer = np.round(np.array(right(question), dtype=float), digits)
    assert verdict(question, answer).note != "right" or not failed(capsys, question, answer)


@pytest.mark.parametrize("question", [q for q in FUNCTIONS if q.public.public], ids=lambda question: question.id)
def test_no_public_check_fails_on_a_right_function(question, capsys):
    function = question.answer(STUDENT)
    plain = lambda *args: getattr(answer := function(*args), "solutions", answer)  # noqa: E731
    forms = {
        "as it is": plain,
        "array": lambda *args: np.array(plain(*args)),
        "sympy": lambda *args: sympy.sympify(np.array(plain(*args)).tolist()),
    }
    if question.returns.kind == "joint_solutions":
        joints = question.returns.joints
        rows = lambda *args: np.array(plain(*args), dtype=float).reshape(-1, len(joints))  # noqa: E731
        angles = [i in question.angles for i in range(len(joints))]
        forms |= {
            "empty array": rows,
            "set": lambda *args: {tuple(row) for row in rows(*args).tolist()},
            "twice": lambda *args: np.vstack([rows(*args)] * 2),
            "a turn further": lambda *args: rows(*args) + 2 * np.pi * np.array(angles),
            "other order": lambda *args: rows(*args)[::-1],
            "by name": lambda *args: [dict(zip(joints, row)) for row in rows(*args)],
            "by symbol": lambda *args: [dict(zip(sympy.symbols(joints), row)) for row in rows(*args)],
            "flat": lambda *args: rows(*args)[0] if len(rows(*args)) == 1 else rows(*args),
        }
    elif question.returns.kind == "vector":
        forms["column"] = lambda *args: sympy.Matrix(np.array(plain(*args), dtype=float).tolist())
    for name, form in forms.items():
        assert not failed(capsys, question, form), name


@pytest.mark.parametrize("digits", [3, 4, 6])
@pytest.mark.parametrize("question", [q for q in FUNCTIONS if q.public.public], ids=lambda question: question.id)
def test_no_public_check_fails_on_a_function_that_rounds_as_the_judge_takes_it(question, digits, capsys):
    function = question.answer(STUDENT)
    rounded = lambda *args: np.round(np.array(getattr(found := function(*args), "solutions", found), float), digits)  # noqa: E731
    assert verdict(question, rounded).note != "right" or not failed(capsys, question, rounded)


@pytest.mark.parametrize("question", [q for q in QUESTIONS if q.public.public], ids=lambda question: question.id)
def test_a_public_check_knows_the_same_angles_as_the_judge(question):
    for one in question.public.public:
        if isinstance(one, (ValueAt, Returns)) and question.form.kind != "dh_table":
            form = question.form if isinstance(one, ValueAt) else question.returns
            assert form.kind == "joint_solutions" or one.angles == question.angles


def test_angles_a_turn_further_pass_at_home(capsys):
    found = 0
    for question in DATA:
        if question.public.public and question.angles and question.form.kind in ("vector", "expression"):
            entries = np.atleast_1d(np.array(right(question), dtype=object)).copy()
            entries[list(question.angles)] += 2 * sympy.pi
            found += 1
            assert not failed(capsys, question, entries.tolist() if question.form.kind == "vector" else entries[0])
    assert found >= 2
