"""Who hands in what the lectures hold, and no thought, earns a third of no exercise and a quarter of no course.

The copier runs the lectures before an exercise, in the syllabus' order, and hands in for every question, through the real
judge, whatever of its form is found there:

* every value of the code cells, and its parts: blocks, rows, columns and entries of a matrix, runs of rows of a table;
* with the symbols renamed to those of the question: by their plain names, t1 for q1, the rest in every order;
* with the student's own numbers put in for symbols of their names;
* every function as it stands, and what it returns for the student's numbers and the question's symbols of its arguments' names;
* every choice: the text of a lecture nearly always tells it, and nobody has to read the text to count it as found.

What stays out: numbers typed in the place of other numbers, and lines of a lecture put together anew. That is a beginning.
"""

import ast
import contextlib
import inspect
import io
import itertools
import re
import signal
import tomllib
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import nbformat
import numpy as np
import pytest
import sympy
from answers import STUDENT, evidence

from autograder.grading.release import points
from autograder.judge import Question, judge
from autograder.questions import exercises
from dhkit import wire
from dhkit.variants import numbers

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
OF_AN_EXERCISE, OF_THE_COURSE = 1 / 3, 1 / 4
SECONDS = 1
"""Of processor time, for one call of a lecture's function with arguments that are not its own."""
MOST_ORDERS = 24
"""Orders in which symbols are tried; more of them nobody would try by hand."""
MOST_JUDGED = 40
"""Answers in symbols to one question: those that agree most with the right one."""
MOST_ENTRIES = 64
"""Of a list or matrix; clouds of points may have more."""

LIBRARIES = {"sympy", "numpy", "matplotlib", "collections"}

Nested = object
"""An expression or a number, or nested lists of them."""


@dataclass(frozen=True)
class Find:
    """Something that a lecture holds, and where."""

    value: object
    where: str


# ---------------------------------------------------------------- what the lectures hold


@cache
def lectures_before() -> dict[str, list[str]]:
    """The lectures that stand before each exercise, and after the exercise before it."""
    found, waiting = {}, []
    for lecture in tomllib.loads((ROOT / "docs/syllabus.toml").read_text())["lecture"]:
        waiting.append(lecture["notebook"])
        if "exercise" in lecture:
            found[lecture["exercise"]], waiting = waiting, []
    return found


def nothing(*args, **kwargs) -> list:
    """In place of what shows and hands in: it leaves no values behind, and takes most of the time."""
    return [None] * 4


def run(cell: str, namespace: dict) -> None:
    """Run a cell; what its last line shows becomes the value ``_``. A Try that is not filled in may fail."""
    tree = ast.parse(cell)
    shown = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    with contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(Exception):
        exec(compile(tree, "cell", "exec"), namespace)
        for name, value in namespace.items():
            if callable(value) and re.match(r"(draw|mark|explore|check|display)(_|$)", name):
                namespace[name] = nothing
        if shown is not None:
            namespace["_"] = eval(compile(ast.Expression(shown.value), "cell", "eval"), namespace)


@cache
def finds(lecture: str) -> tuple[Find, ...]:
    """Every value that a lecture's cells leave in its namespace, also those that a later cell replaces."""
    namespace, found = {"display": nothing, "__name__": "lecture"}, {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for cell in nbformat.read(ROOT / f"course/{lecture}.ipynb", as_version=4).cells:
            if cell.cell_type == "code":
                run(cell.source, namespace)
                for name, value in namespace.items():
                    if not name.startswith("__") and value is not nothing and not inspect.ismodule(value):
                        found[name, id(value)] = Find(value, f"{lecture}: {name}")
    return tuple(found.values())


def is_function(value: object) -> bool:
    """Whether a value is a function that a lecture or the kit has written, and not a library."""
    return inspect.isfunction(value) and (value.__module__ or "").partition(".")[0] not in LIBRARIES


# ---------------------------------------------------------------- values and their parts


def nested(value: object) -> Nested | None:
    """A value as nested lists of expressions and numbers; None for anything else."""
    if isinstance(value, sympy.MatrixBase):
        return value.tolist()
    if isinstance(value, np.ndarray):
        return value.tolist() if value.dtype.kind in "iuf" else nested(value.tolist())
    if isinstance(value, bool) or not isinstance(value, (list, tuple, set, int, float, np.number, sympy.Expr)):
        return None
    if isinstance(value, (list, tuple, set)):
        items = [nested(item) for item in value]
        return None if any(item is None for item in items) else items
    return value


def shape_of(value: Nested) -> tuple[int, ...] | None:
    """The shape of nested lists, () of a single entry; None where they are ragged."""
    try:
        return np.shape(value)
    except ValueError:
        return None


def parts(value: object) -> Iterator[Nested]:
    """A value and what somebody would type of it."""
    if isinstance(value, Mapping):
        for item in value.values():
            yield from parts(item)
        return
    whole = nested(value)
    if whole is None:
        if isinstance(value, (list, tuple)) and len(value) <= MOST_ENTRIES:
            for item in value:
                yield from parts(item)
        return
    yield whole
    shape = shape_of(whole)
    if not shape:
        return
    if shape is None or np.prod(shape) > MOST_ENTRIES:
        if len(whole) <= 8:
            for item in whole:
                yield from parts(item)
        return
    if len(shape) > 1:
        yield from parts_of_matrix(whole, *shape[:2]) if len(shape) == 2 else itertools.chain(*map(parts, whole))
    yield from flat(whole)


def parts_of_matrix(rows: list[list], height: int, width: int) -> Iterator[Nested]:
    columns = [list(column) for column in zip(*rows)]
    yield from rows
    yield from columns
    yield [[entry] for entry in columns[-1]]
    if (height, width) == (4, 4):
        yield [row[:3] for row in rows[:3]]
        yield from (column[:size] for column in columns for size in (2, 3))
    if width in (4, 5):  # tables: rows of joints alone, of a wrist alone; with sigma or without it
        for first, last in itertools.combinations(range(height + 1), 2):
            run_of_rows = rows[first:last]
            yield run_of_rows
            yield [row[1:] for row in run_of_rows] if width == 5 else [[0, *row] for row in run_of_rows]


def flat(value: Nested) -> list:
    return [entry for item in value for entry in flat(item)] if isinstance(value, list) else [value]


def change(value: Nested, mapping: Mapping) -> Nested:
    """Symbols of nested lists replaced."""
    if isinstance(value, list):
        return [change(item, mapping) for item in value]
    return value.xreplace(mapping) if isinstance(value, sympy.Basic) else value


def names_in(value: Nested) -> set[str]:
    return {symbol.name for entry in flat(value) if isinstance(entry, sympy.Basic) for symbol in entry.free_symbols}


# ---------------------------------------------------------------- renamed, and with numbers put in


def plain(name: str) -> str:
    """theta_1 and t_1 are t1."""
    return re.sub(r"^theta_?(?=\d)", "t", name).replace("_", "")


def renamings(names: set[str], wanted: tuple[str, ...]) -> Iterator[dict[str, str]]:
    """New names for some symbols: their plain ones, joints by their number, the rest in every order."""
    known = {}
    for name in sorted(names):
        letter, number = plain(name)[:1], plain(name)[1:]
        same = [plain(name), *(other + number for other in "tq" if letter in "tq" and number.isdigit())]
        known[name] = next((other for other in same if other in wanted), None)
    rest = [name for name, other in known.items() if other is None]
    free = [name for name in wanted if name not in known.values()]
    for chosen in itertools.islice(itertools.permutations(free, len(rest)), MOST_ORDERS):
        yield {**known, **dict(zip(rest, chosen))}


def typed(value: Nested, form, mine: Mapping[str, float]) -> Iterator[Nested]:
    """What the copier types of a value: in the question's symbols, with own numbers where there are any."""
    names = names_in(value)
    own = {name: mine[plain(name)] for name in names if isinstance(mine.get(plain(name)), float | int)}
    for put_in in ({}, own) if own else ({},):
        left = change(value, {symbol: sympy.Float(put_in[symbol.name]) for symbol in symbols_in(value, put_in)})
        for renaming in renamings(names - set(put_in), form.symbols):
            yield change(left, {symbol: sympy.Symbol(renaming[symbol.name]) for symbol in symbols_in(left, renaming)})


def symbols_in(value: Nested, names: Mapping) -> set[sympy.Symbol]:
    entries = [entry for entry in flat(value) if isinstance(entry, sympy.Basic)]
    return {symbol for entry in entries for symbol in entry.free_symbols if symbol.name in names}


# ---------------------------------------------------------------- functions


class TooLong(Exception):
    pass


def called(function: Callable, *args, **kwargs) -> object:
    """What a function returns for arguments that may not fit it; None where it fails, or takes too long."""

    def stop(*_):
        raise TooLong

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"), contextlib.redirect_stdout(io.StringIO()):
            warnings.simplefilter("ignore")
            return function(*args, **kwargs)
    except (Exception, TooLong):
        return None
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def with_own_arguments(function: Callable, form, mine: Mapping[str, float]) -> Iterator[object]:
    """What a function returns for own numbers, and for the question's symbols, of its arguments' names."""
    own = {name: value for name, value in mine.items() if isinstance(value, float | int)}
    asked = {name: sympy.Symbol(name) for name in form.symbols}
    arguments = inspect.signature(function).parameters.values()
    needed = {one.name for one in arguments if one.default is one.empty and one.kind is one.POSITIONAL_OR_KEYWORD}
    for known in ({**own, **asked}, {**asked, **own}):
        given = {one.name: known[plain(one.name)] for one in arguments if plain(one.name) in known}
        if needed and needed <= set(given):
            yield called(function, **given)


def fits(question: Question, function: Callable) -> bool:
    """Whether a function returns something of the form that is asked for, for the first call."""
    result = nested(called(function, *question.probes(STUDENT, 7)[0]))
    with contextlib.suppress(Exception):
        return result is not None and question.returns.complaint(wire.encode(result)) is None
    return False


# ---------------------------------------------------------------- what it earns


def wanted_shape(form, shape: tuple[int, ...] | None) -> bool:
    """Whether nested lists of this shape can be in a form at all."""
    if shape is None:
        return False
    if form.kind == "joint_solutions":
        return shape[-1:] == (len(form.joints),)
    if form.kind == "point_cloud":
        return shape[1:] == form.shape
    if form.kind == "orientation":
        return shape[-1:] == (3,)
    return shape == form.shape


def handed_in(question: Question, found: tuple[Find, ...]) -> Iterator[tuple[object, str]]:
    """Everything that the copier hands in for a question, each once, and where it is from."""
    form = question.form
    seen: set[object] = set()
    if form.kind == "function":
        for one in found:
            if is_function(one.value) and id(one.value) not in seen and fits(question, one.value):
                seen.add(id(one.value))
                yield lambda *args, f=one.value: called(f, *args), one.where
        return
    mine = numbers(question.exercise, STUDENT)
    for one in found:
        values = with_own_arguments(one.value, form, mine) if is_function(one.value) else [one.value]
        for part in itertools.chain.from_iterable(map(parts, values)):
            if wanted_shape(form, shape_of(part)):
                for answer in typed(part, form, mine):
                    key = str(answer)
                    if key not in seen:
                        seen.add(key)
                        yield answer, one.where


def likeliest(question: Question, answers: Iterator[tuple[object, str]]) -> list[tuple[object, str]]:
    """Of answers in symbols those that are right in most entries at one point: the judge takes its time for each."""
    if not getattr(question.form, "symbols", ()):
        return list(answers)
    point = {sympy.Symbol(name): values[0] for name, values in question.samples.items()}
    right = values_at(question.answer(STUDENT), point)
    agreeing = lambda one: -int(np.isclose(values_at(one[0], point), right).sum())  # noqa: E731
    return sorted(answers, key=agreeing)[:MOST_JUDGED]


def values_at(answer: object, point: Mapping) -> np.ndarray:
    """The entries of an answer at a point, one after the other; nan where there is no number."""
    values = []
    for entry in flat(nested(answer)):
        try:
            values.append(float(sympy.sympify(entry).xreplace(point)))
        except (TypeError, ValueError):
            values.append(np.nan)
    return np.array(values)


def share(question: Question, answer: object) -> float:
    """The share of the points that an answer earns; none where it cannot be handed in."""
    with contextlib.suppress(ValueError, TypeError), warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        if question.form.kind != "function" and question.form.complaint(wire.encode(answer)) is not None:
            return 0.0
        return judge(question, evidence(question, answer), STUDENT).share
    return 0.0


def best(question: Question, found: tuple[Find, ...]) -> tuple[float, str]:
    """The largest share that the copier gets for a question, and where it is from."""
    if question.form.kind == "choice":
        return 1.0, "the text"
    most = 0.0, ""
    for answer, where in likeliest(question, handed_in(question, found)):
        if (earned := share(question, answer)) > most[0]:
            most = earned, where
        if most[0] == 1:
            break
    return most


@cache
def earned(exercise: str) -> dict[str, tuple[float, float, str]]:
    """Of each question of an exercise what the copier earns, what it is worth, and where the answer is from."""
    found = tuple(itertools.chain.from_iterable(map(finds, lectures_before()[exercise])))
    worth = points(nbformat.read(ROOT / f"solutions/{exercise}/{exercise}.ipynb", as_version=4))
    result = {}
    for question in exercises()[exercise]:
        most, where = best(question, found)
        result[question.id] = most * worth[question.id], worth[question.id], where
    return result


def told(exercise: str) -> str:
    lines = [f"{id}: {got:.2f} of {most:g} {where}" for id, (got, most, where) in earned(exercise).items() if got]
    got, most = total(exercise)
    return "\n".join([f"{exercise}: {got:.1f} of {most:g}", *lines])


def total(exercise: str) -> tuple[float, float]:
    """What the copier earns for an exercise, and what it is worth."""
    rows = earned(exercise).values()
    return sum(got for got, _, _ in rows), sum(most for _, most, _ in rows)


@pytest.mark.parametrize("exercise", [name for name in exercises() if name in lectures_before()])
def test_the_copier_earns_a_third_of_no_exercise(exercise):
    got, most = total(exercise)
    assert got <= OF_AN_EXERCISE * most, told(exercise)


def test_the_copier_earns_a_quarter_of_the_course():
    got, most = (sum(column) for column in zip(*map(total, lectures_before())))
    assert got <= OF_THE_COURSE * most, "\n".join(map(told, lectures_before()))


# ---------------------------------------------------------------- the copier finds what is there


@pytest.mark.parametrize(
    ("id", "value"),
    [
        ("tables.puma_row", [[0, 0, 0, 0, 0], [0, 0, -sympy.pi / 2, sympy.Symbol("d_6"), sympy.Symbol("theta_6")]]),
        ("transforms.operators", sympy.Matrix(sympy.symbols("beta b psi e"))),
        ("parameters.origin", {"a corner": ["no number", None], "the origin": None}),
    ],
)
def test_a_value_that_lies_about_is_found_whatever_its_symbols_are_called(id, value):
    question = next(question for question in exercises()[id.partition(".")[0]] if question.id == id)
    if isinstance(value, dict):
        value["the origin"] = tuple(question.answer(STUDENT))
    assert best(question, (Find(value, "here"),)) == (1.0, "here")


def test_a_function_is_found_and_called_with_own_numbers():
    point, planar = (
        next(q for q in exercises()[name] if q.id == id)
        for name, id in (("transforms", "transforms.point"), ("tables", "tables.planar"))
    )
    seen = lambda phi, t_x, t_y, px, py: [  # noqa: E731
        t_x + px * np.cos(np.radians(phi)) - py * np.sin(np.radians(phi)),
        t_y + px * np.sin(np.radians(phi)) + py * np.cos(np.radians(phi)),
    ]
    assert best(point, (Find(seen, "here"),)) == (1.0, "here")
    assert best(planar, (Find(planar.answer(STUDENT), "here"),)) == (1.0, "here")
