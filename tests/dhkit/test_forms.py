"""Tables of questions: what is ill-formed is refused with the name of its field, and what each kind takes as its form."""

import pytest
import sympy

from dhkit import forms, public, wire
from dhkit.public import from_table, variant_ranges

t1, t2 = sympy.symbols("t1 t2")

NUMBER = {"title": "t", "kind": "number", "expected": "a number"}
VECTOR = {"title": "t", "kind": "vector", "expected": "e", "shape": [2], "symbols": ["t1"]}
MATRIX = {"title": "t", "kind": "matrix", "expected": "e", "shape": [2, 3]}
TRANSFORM = {"title": "t", "kind": "transform", "expected": "e", "shape": [4, 4], "symbols": ["t1"]}
TABLE = {"title": "t", "kind": "dh_table", "expected": "e", "shape": [2, 5], "joints": ["t1"], "symbols": ["t1", "a"]}
SOLUTIONS = {"title": "t", "kind": "joint_solutions", "expected": "e", "joints": ["t1", "t2"]}
ORIENTATION = {"title": "t", "kind": "orientation", "expected": "e", "shape": [3], "axes": "zyx"}
CLOUD = {"title": "t", "kind": "point_cloud", "expected": "e", "shape": [2]}
CHOICE = {"title": "t", "kind": "choice", "expected": "e", "options": ["A", "B"]}
FUNCTION = {"title": "t", "kind": "function", "expected": "e", "returns": {"kind": "vector", "shape": [2]}}
SOLVER = {**FUNCTION, "returns": {"kind": "joint_solutions", "joints": ["t1", "t2"]}}
VALUE = {"name": "value_at", "says": "s", "at": {"t1": 0.0}, "equals": [1.0, 0.0]}
RETURNS = {"name": "returns", "says": "s", "args": [1.0]}
REACHES = {"name": "forward_of_inverse", "says": "s", "args": [0.3, 0.4], "lengths": [0.5, 0.4]}
GOOD = (NUMBER, VECTOR, MATRIX, TRANSFORM, TABLE, SOLUTIONS, ORIENTATION, CLOUD, CHOICE, FUNCTION, SOLVER)


def without(table, *fields):
    return {key: value for key, value in table.items() if key not in fields}


def checked(table, check, **change):
    return {**table, "public": [{**check, **change}]}


ILL_FORMED = [
    # heading
    (without(NUMBER, "title"), "title: missing"),
    ({**NUMBER, "title": ""}, "title"),
    ({**NUMBER, "title": 7}, "title: expected str, found int"),
    ({**NUMBER, "hints": "look"}, "hints: expected array, found str"),
    ({**NUMBER, "hints": ["look", 3]}, "hints[1]"),
    ({**NUMBER, "minutes": "five"}, "minutes: expected int"),
    ({**NUMBER, "minutes": 2.5}, "minutes: expected int"),
    ({**NUMBER, "minutes": True}, "minutes: expected int"),
    ({**NUMBER, "minutes": -1}, "minutes"),
    # kind and fields
    (without(NUMBER, "kind"), "kind: missing; known: choice, classic_table, dh_table"),
    ({**NUMBER, "kind": "essay"}, "kind: 'essay' is unknown"),
    ({**NUMBER, "kind": 3}, "kind"),
    (without(NUMBER, "expected"), "expected: missing"),
    ({**NUMBER, "colour": "red"}, "colour: unknown field; known: expected, units"),
    ({**NUMBER, "shape": [2]}, "shape: unknown field"),
    ({**NUMBER, "units": 1}, "units: expected str"),
    ({**CHOICE, "symbols": ["t1"]}, "symbols: unknown field"),
    # shapes
    ({**VECTOR, "shape": 2}, "shape: expected array, found int"),
    ({**VECTOR, "shape": [2, 2]}, "shape: expected array of length 1"),
    ({**VECTOR, "shape": [-2]}, "shape[0]"),
    ({**VECTOR, "shape": [0]}, "shape[0]"),
    ({**VECTOR, "shape": ["2"]}, "shape[0]: expected int"),
    (without(VECTOR, "shape"), "shape: missing"),
    ({**MATRIX, "shape": [3]}, "shape"),
    ({**MATRIX, "shape": [3, -1]}, "shape[1]"),
    ({**TRANSFORM, "shape": [3, 4]}, "shape: a transform is square"),
    ({**TRANSFORM, "shape": [2, 4, 4]}, "shape: a transform is square"),
    ({**CLOUD, "shape": [100, 2]}, "shape"),
    # names
    ({**VECTOR, "symbols": "t1"}, "symbols: expected array, found str"),
    ({**VECTOR, "symbols": ["t1", "t1"]}, "symbols: t1 stands twice"),
    ({**VECTOR, "symbols": [1]}, "symbols[0]"),
    ({**VECTOR, "names": ["x"]}, "names: 1 for 2 entries"),
    ({**VECTOR, "names": ["x", "x"]}, "names: x stands twice"),
    ({**VECTOR, "names": {"x": 1}}, "names"),
    # tables and solutions
    (without(TABLE, "joints"), "joints: missing"),
    ({**TABLE, "joints": []}, "joints: 0 for a table of 2 rows"),
    ({**TABLE, "joints": ["t1", "a", "b"], "symbols": ["t1", "a", "b"]}, "joints: 3 for a table of 2 rows"),
    ({**TABLE, "joints": ["t1", "t1"]}, "joints: t1 stands twice"),
    ({**TABLE, "joints": ["t2"]}, "joints: t2 is not among the symbols"),
    ({**TABLE, "shape": [2, 4]}, "shape: a row is sigma, a, alpha, d, theta"),
    (without(SOLUTIONS, "joints"), "joints: missing"),
    ({**SOLUTIONS, "joints": []}, "joints"),
    ({**SOLUTIONS, "joints": "t1"}, "joints"),
    ({**SOLUTIONS, "joints": ["t1", "t1"]}, "joints: t1 stands twice"),
    # orientations
    (without(ORIENTATION, "axes"), "axes: missing"),
    ({**ORIENTATION, "axes": "zyq"}, "axes: 'zyq'"),
    ({**ORIENTATION, "axes": "zzx"}, "axes: 'zzx'"),
    ({**ORIENTATION, "axes": "zy"}, "axes: 'zy'"),
    ({**ORIENTATION, "axes": ["z", "y", "x"]}, "axes: expected str"),
    ({**ORIENTATION, "frames": "fixd"}, "frames: 'fixd' is not allowed, only moving or fixed"),
    ({**ORIENTATION, "shape": [4]}, "shape"),
    # choices
    (without(CHOICE, "options"), "options: missing"),
    ({**CHOICE, "options": []}, "options"),
    ({**CHOICE, "options": ["A"]}, "options"),
    ({**CHOICE, "options": "AB"}, "options"),
    ({**CHOICE, "options": ["A", "A"]}, "options: A stands twice"),
    ({**CHOICE, "options": ["a", "b"]}, "options[0]"),
    # functions
    (without(FUNCTION, "returns"), "returns: missing"),
    ({**FUNCTION, "returns": "a vector"}, "returns"),
    ({**FUNCTION, "returns": {"kind": "vector"}}, "returns.shape: missing"),
    ({**FUNCTION, "returns": {"kind": "vectr", "shape": [2]}}, "returns.kind: 'vectr' is unknown"),
    ({**FUNCTION, "returns": {"kind": "vector", "shape": [2], "hints": []}}, "returns.hints: unknown field"),
    ({**FUNCTION, "returns": {"kind": "function", "returns": {"kind": "number"}}}, "returns.kind"),
    # public checks
    ({**VECTOR, "public": VALUE}, "public: expected a list"),
    (checked(VECTOR, VALUE, name="value_of"), "public[0].name: 'value_of' is unknown; known: value_at"),
    (checked(VECTOR, without(VALUE, "name")), "public[0].name: missing"),
    (checked(VECTOR, without(VALUE, "says")), "public[0].says: missing"),
    (checked(VECTOR, without(VALUE, "equals")), "public[0].equals: missing"),
    (checked(VECTOR, VALUE, colour=1), "public[0].colour: unknown field"),
    (checked(VECTOR, VALUE, at={}), "public[0].at: gives no symbol, wanted is t1"),
    (checked(VECTOR, VALUE, at={"t1": 0.0, "t2": 0.0}), "public[0].at"),
    (checked(VECTOR, VALUE, at={"t1": "zero"}), "public[0].at"),
    (checked(VECTOR, VALUE, equals=[1.0]), "public[0].equals"),
    (checked(VECTOR, VALUE, equals="one"), "public[0].equals: expected numbers"),
    (checked(VECTOR, VALUE, entry=[2], equals=1.0), "public[0].entry"),
    (checked(VECTOR, VALUE, entry=0, equals=1.0), "public[0].entry"),
    (checked(VECTOR, VALUE, angles=[2]), "public[0].angles"),
    (checked(VECTOR, VALUE, tolerance=0), "public[0].tolerance"),
    (checked(CHOICE, VALUE), "public[0].name: value_at makes no sense"),
    (checked(SOLUTIONS, VALUE), "public[0].name"),
    (checked(MATRIX, {"name": "rigid_transform", "says": "s"}), "public[0].name: rigid_transform"),
    (checked(VECTOR, {"name": "rigid_transform", "says": "s"}), "public[0].name: rigid_transform"),
    (checked(VECTOR, RETURNS), "public[0].name: returns is for functions"),
    (checked(FUNCTION, without(RETURNS, "args")), "public[0].args: missing"),
    (checked(FUNCTION, RETURNS, args=1.0), "public[0].args"),
    (checked(FUNCTION, RETURNS, equals=[1.0, 2.0, 3.0]), "public[0].equals"),
    (checked(SOLVER, RETURNS, equals=[1.0, 2.0, 3.0]), "public[0].equals"),
    (checked(FUNCTION, RETURNS, shape=[-1]), "public[0].shape"),
    (checked(FUNCTION, REACHES), "public[0].name: forward_of_inverse"),
    (checked(SOLVER, REACHES, lengths=[0.5]), "public[0].lengths"),
    (checked(SOLVER, REACHES, args=[[0.3, 0.4]]), "public[0].target: missing"),
    (checked(SOLVER, without(REACHES, "lengths")), "public[0].lengths: missing"),
]


@pytest.fixture
def file(monkeypatch):
    """Stands for one file of questions with the tables given."""
    public.questions.cache_clear()
    yield lambda tables: monkeypatch.setattr(public, "_files", lambda: {"arm": tables})
    public.questions.cache_clear()


@pytest.mark.parametrize("table", GOOD, ids=lambda table: table["kind"])
def test_a_good_table_loads(table):
    question = from_table("arm.q", table)
    assert question.title == "t" and question.form.kind == table["kind"] and question.exercise == "arm"


@pytest.mark.parametrize(
    "check",
    [
        checked(VECTOR, VALUE),
        checked(VECTOR, VALUE, entry=[1], equals=1, angles=[1]),
        checked(TABLE, VALUE, at={"t1": 0, "a": 1}, entry=[1, 2], equals=0),
        checked(TRANSFORM, {"name": "rigid_transform", "says": "s", "tolerance": 0.002}),
        checked(FUNCTION, RETURNS, shape=[2], equals=[1, 2]),
        checked(SOLVER, RETURNS, shape=[2, 2]),
        checked(SOLVER, RETURNS, equals=[]),
        checked(SOLVER, REACHES),
        checked(SOLVER, REACHES, args=[[0.3, 0.4]], target=[0.3, 0.4]),
    ],
)
def test_a_good_public_check_loads(check):
    assert len(from_table("arm.q", check).public) == 1


@pytest.mark.parametrize(("table", "said"), ILL_FORMED)
def test_an_ill_formed_table_is_refused_with_file_question_and_field(file, table, said):
    file({"elbow": table})
    with pytest.raises(ValueError) as caught:
        public.questions()
    assert str(caught.value).startswith(f"arm.toml: question elbow: {said}")


@pytest.mark.parametrize(("name", "table"), [("elbow-1", NUMBER), ("2r", NUMBER), ("a.b", NUMBER), ("elbow", 3)])
def test_a_question_needs_a_name_and_a_table(file, name, table):
    file({name: table})
    with pytest.raises(ValueError, match=f"arm.toml: question {name}: a "):
        public.questions()


def test_text_that_is_no_toml_is_refused_with_its_file():
    with pytest.raises(ValueError, match=r"arm.toml: .*elbow"):
        public._tables("arm.toml", "[elbow]\n[elbow]\n")


@pytest.mark.parametrize(
    "range_",
    [
        [1, 0, 0.1], [0, 1], [0, 1, -1], [], ["a", 1], [0, 1, 0], [0, 1, 2], [0, 1, 0.3], [0, 0, 1], 5, "up",
        [0, float("inf"), 1], [float("nan"), 1, 1], [True, 2, 1], ["up", "up"], [0, 1, 0.5, 2], [[0, 1, 0.1]], {"low": 0},
    ],
    ids=str,
)  # fmt: skip
def test_a_range_that_makes_no_sense_is_named(range_, monkeypatch):
    monkeypatch.setattr(public, "_files", lambda: {"arm": {"variant": {"L1": range_}}})
    with pytest.raises(ValueError, match=r"arm.toml: variant.L1: "):
        variant_ranges("arm")


def test_the_files_of_the_course_load():
    assert len(public.questions()) > 100
    assert {question.form.kind for question in public.questions().values()} <= set(forms.KINDS)
    for exercise in {question.exercise for question in public.questions().values()}:
        variant_ranges(exercise)


# ---------------------------------------------------------------- forms of answers


def complaint(table, answer):
    return from_table("arm.q", table).form.complaint(wire.encode(answer))


@pytest.mark.parametrize(
    ("table", "answer"),
    [
        (NUMBER, sympy.sqrt(2) / 2),
        (VECTOR, sympy.Matrix([t1, 1])),
        (VECTOR, sympy.Matrix([[t1, 1]])),
        (VECTOR, [t1, ...]),
        ({**VECTOR, "names": ["x", "y"]}, {sympy.Symbol("y"): 1, sympy.Symbol("x"): t1}),
        (TABLE, [{"sigma": False, "a": 0, "alpha": 0, "d": 0, "theta": t1}, [0, 1, 0, 0, ...]]),
        (TABLE, {"sigma": [0, 0], "a": [0, 1], "alpha": [0, 0], "d": [0, 0], "theta": [t1, 0]}),
        (SOLUTIONS, []),
        (SOLUTIONS, sympy.zeros(0, 2)),
        (SOLUTIONS, {(0.1, 0.2), (0.3, 0.4)}),
        (SOLUTIONS, [0.1, sympy.pi / 2]),
        (SOLUTIONS, {"t2": [0.1, 0.2], "t1": [0.3, 0.4]}),
        (SOLUTIONS, {"t2": 0.1, "t1": 0.3}),
        (SOLUTIONS, [[0.1 + 0j, 0.2]]),
        (CLOUD, [[sympy.pi, 0.2]]),
        *((CHOICE, b) for b in (" b\n", "(B)", "B.", "\uff22", "b)", ["B"], {"b"}, "'B'", sympy.Symbol("B"))),
        *(
            (NUMBER, half)
            for half in ([0.5], [[0.5]], {0.5}, {"x": 0.5}, [{t1: 0.5}], sympy.Eq(t1, 0.5), sympy.FiniteSet(0.5))
        ),
        (NUMBER, sympy.CRootOf(t1**3 - t1 + 1, 0)),
        (VECTOR, (entry for entry in (t1, 1))),
        (VECTOR, {"x": t1, "y": 1}.values()),
        (VECTOR, [sympy.Piecewise((t1, t1 > 0), (0, True)), sympy.arg(sympy.re(t1) + sympy.I * sympy.conjugate(t1))]),
        (VECTOR, [sympy.Function("t1")(t2), sympy.Symbol("t1", positive=True)]),
        (SOLUTIONS, zip([0.1, 0.2], [0.3, 0.4], strict=True)),
        (SOLUTIONS, map(list, [[0.1, 0.2]])),
        (SOLUTIONS, sympy.Matrix([0.1, 0.2])),
        (SOLUTIONS, sympy.S.EmptySet),
        (FUNCTION, lambda x: x),
    ],
)
def test_what_is_in_the_form_asked_for(table, answer):
    assert complaint(table, answer) is None


@pytest.mark.parametrize(
    ("table", "answer", "found"),
    [
        (NUMBER, "0.5", 'the text "0.5": write 0.5 without quotation marks'),
        (NUMBER, [0.5, 0.6], "an array of shape 2"),
        (NUMBER, t1, "the symbol t1 where only no symbol (numbers) may appear"),
        (NUMBER, float("nan"), "the value nan"),
        (VECTOR, ["0.707", "1.028"], 'the text "0.707": write 0.707 without quotation marks'),
        (VECTOR, {t1, 1}, "a set, which has no order"),
        (VECTOR, [t1, "t1"], 'the text "t1": write t1 without quotation marks'),
        (VECTOR, [t1, float("inf")], "the value inf"),
        (VECTOR, [t1, complex(0, float("nan"))], "the value nan"),
        (VECTOR, [t1, sympy.Integral(t1)], "Integral"),
        (VECTOR, [t1, sympy.sin(sympy.Sum(t1, (t1, 1, 3)))], "Sum"),
        (VECTOR, [t1, sympy.Function("sin")(t1, t1)], "an object of type sin"),
        (VECTOR, [t1, sympy.sin(t2)], "the symbol t2 where only t1 may appear"),
        (VECTOR, {"x": 1, "y": 2}, "a dictionary with the keys x, y"),
        (VECTOR, [t1, 10**400], "an integer of more than a few hundred digits"),
        (VECTOR, [t1, sympy.Rational(1, 10**400)], "an integer of more than a few hundred digits"),
        (MATRIX, [[1, 2, 3], [4]], "rows have different lengths"),
        (TABLE, [[0, 0, 0, 0, "t1"], [0, 0, 0, 0, 0]], 'the text "t1"'),
        (SOLUTIONS, [[0.1, ...]], "an entry that is not filled in"),
        (SOLUTIONS, [[0.1, 1j]], "a complex number"),
        (SOLUTIONS, [[0.1, sympy.sqrt(-2)]], "a complex number"),
        (SOLUTIONS, [[0.1, float("inf")]], "the value inf"),
        (SOLUTIONS, [[0.1, sympy.Pow(0, -1, evaluate=False)]], "a value that is not finite"),
        (SOLUTIONS, [[0.1, 0.2]] * 101, "101 solutions, more than any robot has"),
        (SOLUTIONS, [[0.1], [0.2], [0.3]], "an array of shape 3 x 1"),
        (SOLUTIONS, [[0.1] * 3, [0.2] * 3], "2 x 3: each solution is a row, not a column"),
        (CLOUD, [[0.1, 0.2]] * 5001, "5001 points; 5000 are enough"),
        (CLOUD, [[0.1, 0.2]] * 50_000, "5000 points are enough"),
        (CLOUD, [[0.1, ...]], "an entry that is not filled in"),
        (CLOUD, [], "an empty list"),
        (CHOICE, "E", '"E", which is none of A, B'),
        (CHOICE, 1, "a number"),
        (FUNCTION, 3, "a number"),
        (VECTOR, [[t1] * 200] * 200, "more than 25000 parts"),
    ],
)
def test_what_is_not_is_told(table, answer, found):
    said = complaint(table, answer)
    assert said.startswith(f"expected {table['expected']}, found ") and found in said


def test_every_kind_says_what_it_is():
    """A new kind documents itself: its module, and each field of its own."""
    for name, form in forms.KINDS.items():
        assert form.__doc__ and form.__doc__.strip().endswith((".", "``")), name
        own = set(form.__struct_fields__) - {"expected", "units", "symbols"}
        documented = " ".join(base.__doc__ or "" for base in form.__mro__)
        assert all(f"{field} : " in documented or f"{field}, " in documented for field in own), (name, own)
