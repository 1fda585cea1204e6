"""How many of the mistakes that everybody knows get a name, or at least a place: over all questions, none of which lists them.

Each mistake is made here with SymPy or NumPy on the right answer, without the judge's own catalogue.
"""

from itertools import combinations, islice

import numpy as np
import pytest
import sympy
from answers import STUDENT, right, verdict

from autograder.judge.tree import UNEXPLAINED
from autograder.questions import exercises
from dhkit.forms.joint_solutions import JointSolutions

pytestmark = pytest.mark.slow

QUESTIONS = [q for qs in exercises().values() for q in qs if q.form.kind not in ("choice", "point_cloud", "direction")]
SIGMA, A, ALPHA, D, THETA = range(5)
PLACES = (
    "row ",
    "entry ",
    "entries",
    "differ",
    " = 0 it is right",
    "right at some",
    "missing",
    "wrong for",
    "off by up to",
    "miss",
    "column",
)


# ---------------------------------------------------------------- mistakes


def constant(cell):
    cell = sympy.sympify(cell)
    return cell.subs(dict.fromkeys(cell.free_symbols & set(sympy.symbols("t1:7 q1:7")), 0))


def tables(rows):
    """Whole columns, then single cells of a table [sigma, a, alpha, d, theta]."""
    change = lambda places: [[places.get((i, k), cell) for k, cell in enumerate(row)] for i, row in enumerate(rows)]  # noqa: E731
    yield "classic", [[r[0], *n[1:3], *r[3:]] for r, n in zip(rows, [*rows[1:], [0] * 5])]
    yield (
        "degrees",
        [[s, a, al * 180 / sympy.pi, d, th + constant(th) * (180 / sympy.pi - 1)] for s, a, al, d, th in rows],
    )
    for i, k in combinations((A, ALPHA, D, THETA), 2):
        order = [k if j == i else i if j == k else j for j in range(5)]
        yield f"columns {i} {k}", [[row[j] for j in order] for row in rows]
    yield "order", [[row[j] for j in (0, 2, 1, 4, 3)] for row in rows]
    yield "sigma", [[1 - row[0], *row[1:]] for row in rows]
    for i, row in enumerate(rows):
        for k in (A, ALPHA, D):
            if row[k] != 0:
                yield f"sign {i} {k}", change({(i, k): -row[k]})
                if sympy.sympify(row[k]).is_number and k != ALPHA:
                    yield f"decimal {i} {k}", change({(i, k): row[k] * 10})
                for j in (i - 1, i + 1):
                    if 0 <= j < len(rows) and rows[j][k] == 0:
                        yield f"row {i} to {j} {k}", change({(i, k): 0, (j, k): row[k]})
        for k, m in ((A, D), (D, A), (ALPHA, A)):
            if row[k] != 0 and row[m] == 0:
                yield f"column {k} to {m} {i}", change({(i, k): 0, (i, m): row[k]})
        offset = constant(row[THETA])
        if offset != 0:
            yield f"offset {i}", change({(i, THETA): row[THETA] - offset})
            for j in (i - 1, i + 1):
                if 0 <= j < len(rows):
                    yield (
                        f"offset {i} in {j}",
                        change({(i, THETA): row[THETA] - offset, (j, THETA): rows[j][THETA] + offset}),
                    )
        yield f"theta {i}", change({(i, THETA): -row[THETA]})


def two_slips(rows, rng):
    """Two single slips in one table, at different places."""
    single = [(name, made) for name, made in tables(rows) if name[-1].isdigit() and not name.startswith("columns")]
    while len(single) > 1:
        (first, one), (second, other) = (single[k] for k in rng.choice(len(single), 2, replace=False))
        both = [[o if o != r else e for e, o, r in zip(*each)] for each in zip(one, other, rows)]
        touched = [
            {(i, k) for i, row in enumerate(made) for k, cell in enumerate(row) if cell != rows[i][k]}
            for made in (one, other)
        ]
        if not touched[0] & touched[1]:
            yield f"{first} + {second}", both


def is_angle(symbol):
    return str(symbol).startswith(("t", "alpha", "phi", "psi", "q")) and str(symbol) != "tj"


def expressions(answer):
    """On an expression, a list of them, or a matrix: symbols, signs, functions, factors."""

    def mapped(change):
        return (
            answer.applyfunc(change)
            if isinstance(answer, sympy.MatrixBase)
            else [change(e) for e in answer]
            if isinstance(answer, list)
            else change(answer)
        )

    symbols = (
        sorted(sympy.Matrix(sympy.flatten(answer) if isinstance(answer, list) else [answer]).free_symbols, key=str)
        if not isinstance(answer, sympy.MatrixBase)
        else sorted(answer.free_symbols, key=str)
    )
    exchange = lambda pairs: mapped(lambda e: sympy.sympify(e).subs(pairs, simultaneous=True))  # noqa: E731
    angles = [symbol for symbol in symbols if is_angle(symbol)]
    yield "factor 2", mapped(lambda e: 2 * e)
    if not isinstance(answer, sympy.MatrixBase):
        yield "sign", mapped(lambda e: -e)
    if angles:
        yield "degrees", exchange({symbol: symbol * sympy.pi / 180 for symbol in angles})
        yield (
            "sine for cosine",
            mapped(
                lambda e: (
                    sympy.sympify(e)
                    .replace(sympy.sin, lambda x: sympy.Function("S")(x))
                    .replace(sympy.cos, sympy.sin)
                    .replace(sympy.Function("S"), sympy.cos)
                )
            ),
        )
        yield "rot_axis", exchange({symbol: -symbol for symbol in angles})
    for symbol in symbols:
        yield f"sign of {symbol}", exchange({symbol: -symbol})
    for first, second in combinations(symbols, 2):
        if is_angle(first) == is_angle(second):
            yield f"{first} and {second}", exchange({first: second, second: first})
    if isinstance(answer, sympy.MatrixBase) and answer.rows == answer.cols:
        yield "transposed", answer.T
        rotation = answer[:-1, :-1].T if answer.rows == 4 else answer.T
        yield (
            "inverse",
            rotation.row_join(-rotation * answer[:-1, -1]).col_join(answer[-1, :]) if answer.rows == 4 else rotation,
        )
        for i in range(answer.rows - 1):
            for k in range(answer.cols):
                if not answer[i, k].is_number:
                    changed = answer.copy()
                    changed[i, k] = -changed[i, k]
                    yield f"sign of ({i}, {k})", changed
    if isinstance(answer, list):
        for i, k in combinations(range(len(answer)), 2):
            yield f"entries {i} {k}", [answer[k if j == i else i if j == k else j] for j in range(len(answer))]
        for i, _entry in enumerate(answer):
            yield f"sign of entry {i}", [-e if j == i else e for j, e in enumerate(answer)]
            yield f"entry {i} by two", [2 * e if j == i else e for j, e in enumerate(answer)]
    if isinstance(answer, sympy.Expr):
        for term in answer.args if answer.is_Add else ():
            yield f"sign of {term}", answer - 2 * term
            yield f"without {term}", answer - term


def solutions(rows, angles):
    rows = np.array(rows, dtype=float)
    in_degrees, negated = rows.copy(), -rows
    in_degrees[:, angles] = np.degrees(rows[:, angles])
    yield "degrees", in_degrees
    yield "negated", negated
    for k in range(rows.shape[1]):
        turned = rows.copy()
        turned[:, k] *= -1
        yield f"sign of {k}", turned
    if len(rows) > 1:
        yield "first", rows[:1]
        yield "half", rows[::2]


def says_something(function, question):
    """Whether a function finds anything where it is asked: from nothing, or from an error, nobody can tell what went wrong."""
    try:
        found = [np.size(function(*args)) for args in question.probes(STUDENT, 7)]
    except (ArithmeticError, ValueError, IndexError):
        return False
    return np.count_nonzero(found) > len(found) / 2 or not isinstance(question.returns, JointSolutions)


def functions(question):
    reference = question.answer(STUDENT)
    plain = lambda *args: getattr(found := reference(*args), "solutions", found)  # noqa: E731
    args = question.probes(STUDENT, 7)[0]
    numbers = [k for k, arg in enumerate(args) if isinstance(arg, float)]
    for i, k in list(combinations(numbers, 2))[:6]:
        exchanged = lambda *a, i=i, k=k: plain(*[a[k] if j == i else a[i] if j == k else x for j, x in enumerate(a)])  # noqa: E731
        if says_something(exchanged, question):
            yield f"arguments {i} {k}", exchanged
    array = lambda *a: np.array(plain(*a), dtype=float)  # noqa: E731
    kind, angles = question.returns.kind, list(question.angles)
    if kind == "joint_solutions":

        def on(change):
            return lambda *a: change(array(*a)).tolist() if array(*a).size else []

        yield "degrees", on(lambda rows: np.where([k in angles for k in range(rows.shape[-1])], np.degrees(rows), rows))
        yield "first only", on(lambda rows: rows[:1])
        yield "last only", on(lambda rows: rows[-1:])
        for k in range(len(question.returns.joints)):
            yield f"sign of {k}", on(lambda rows, k=k: rows * np.where(np.arange(rows.shape[-1]) == k, -1, 1))
    elif kind in ("matrix", "transform"):
        yield "transposed", lambda *a: array(*a).T
        if question.returns.shape == (4, 4):
            yield "inverse", lambda *a: np.linalg.inv(array(*a))
    elif kind == "vector":
        count = question.returns.shape[0]
        yield "negated", lambda *a: -array(*a)
        yield "factor 2", lambda *a: 2 * array(*a)
        for k in range(count):
            yield f"sign of {k}", lambda *a, k=k: array(*a) * np.where(np.arange(count) == k, -1, 1)
        for i, k in combinations(range(count), 2):
            yield (
                f"entries {i} {k}",
                lambda *a, i=i, k=k: array(*a)[[k if j == i else i if j == k else j for j in range(count)]],
            )


def known_mistakes(question):
    form = question.form
    if form.kind == "function":
        yield from functions(question)
        return
    answer = right(question)
    if form.kind == "dh_table":
        rows = sympy.Matrix(answer).tolist()
        yield from tables(rows)
        yield from islice(two_slips(rows, np.random.default_rng(3)), 30)
    elif form.kind == "joint_solutions":
        yield from solutions(answer, list(question.angles))
    elif form.kind != "orientation" and form.symbols and len(form.shape) < 3:
        if len(form.shape) == 2:
            answer = sympy.Matrix(np.array(answer).tolist() if not isinstance(answer, sympy.MatrixBase) else answer)
        elif form.shape:
            answer = [sympy.sympify(entry) for entry in answer]
        yield from expressions(answer)
    elif form.kind in ("number", "vector", "transform") and not form.symbols:
        numbers = np.array(
            sympy.Matrix(answer).tolist() if isinstance(answer, sympy.MatrixBase) else answer, dtype=float
        )
        if (numbers != numbers.round()).any():  # no counts, no marks
            yield from own_numbers(numbers, list(question.angles))


def own_numbers(answer, angles):
    """On a number, a vector or a transform of the student's own numbers."""
    if answer.ndim == 2:
        yield "transposed", answer.T
        yield "inverse", np.linalg.inv(answer)
        return
    yield "sign", -answer
    yield "factor 2", 2 * answer
    if answer.ndim == 1:
        for k, entry in enumerate(answer):
            if entry:
                yield f"sign of {k}", answer * np.where(np.arange(len(answer)) == k, -1, 1)
        for i, k in combinations(range(len(answer)), 2):
            yield f"entries {i} {k}", answer[[k if j == i else i if j == k else j for j in range(len(answer))]]
        for k in angles:
            yield f"degrees {k}", np.where(np.arange(len(answer)) == k, np.degrees(answer), answer)
    else:
        yield "decimal", 10 * answer


def judged(question):
    """What every known mistake gets, where it is wrong at all."""
    for name, answer in known_mistakes(question):
        answer = answer.tolist() if isinstance(answer, np.ndarray) else answer
        found = verdict(question, answer)
        if found.share < 1:
            yield name, found


def is_named(found):
    return found.note not in UNEXPLAINED


def is_located(found):
    return is_named(found) or any(word in found.feedback for word in PLACES)


@pytest.mark.slow
def test_most_known_mistakes_have_a_name_and_nearly_all_a_place():
    found = [(question.id, name, each) for question in QUESTIONS for name, each in judged(question)]
    unnamed = [f"{id}: {name}" for id, name, each in found if not is_named(each)]
    nowhere = [f"{id}: {name}" for id, name, each in found if not is_located(each)]
    assert len(found) > 1500
    assert len(unnamed) <= 0.10 * len(found), unnamed
    assert len(nowhere) <= 0.02 * len(found), nowhere


FEW = [
    q
    for q in QUESTIONS
    if q.id in ("tables.arm", "direct_models.U2", "planar_2r.model", "planar_2r.inverse", "inverse_models.own_point")
]


@pytest.mark.parametrize("question", FEW, ids=lambda question: question.id)
def test_known_mistakes_have_a_name(question):
    found = list(islice(judged(question), 40))
    assert sum(is_named(each) for _, each in found) >= 0.85 * len(found), [
        name for name, each in found if not is_named(each)
    ]
    assert all(is_located(each) for _, each in found)
