"""What a student sees, and what the notebook hands on."""

import json

import numpy as np
import pytest
import sympy

from dhkit import check, hint, names, public, wire
from dhkit.check import answer_probes
from dhkit.public import from_table
from dhkit.public_checks import is_rigid

t1 = sympy.symbols("t1")

TABLES = {
    "demo.model": {
        "title": "Demo model",
        "kind": "vector",
        "shape": [2],
        "symbols": ["t1"],
        "expected": "a vector (x, y) in t1",
        "hints": ["look", "look harder"],
        "public": [
            {"name": "value_at", "at": {"t1": 0.0}, "entry": [0], "equals": 1.0, "says": "x = 1 at t1 = 0"},
        ],
    },
    "demo.T": {
        "title": "Demo transform",
        "kind": "transform",
        "shape": [4, 4],
        "symbols": ["t1"],
        "expected": "a 4x4 matrix",
        "public": [{"name": "rigid_transform", "says": "it is a rigid motion"}],
    },
    "demo.f": {
        "title": "Demo function",
        "kind": "function",
        "expected": "a function f(x)",
        "returns": {"kind": "vector", "shape": [2]},
        "public": [{"name": "returns", "args": [0.0], "shape": [2], "equals": [1.0, 0.0], "says": "f(0) = (1, 0)"}],
    },
}


@pytest.fixture(autouse=True)
def demo_questions(monkeypatch):
    table = {id: from_table(id, spec) for id, spec in TABLES.items()}
    monkeypatch.setattr(public, "questions", lambda: table)


def said(capsys, *args):
    check(*args)
    return capsys.readouterr().out


def test_an_untouched_answer_is_not_attempted(capsys):
    for blank in (..., None, [..., ...]):
        assert "not attempted yet" in said(capsys, "demo.model", blank)
    assert "not attempted yet" in said(capsys, "demo.f", lambda x: None)


def test_a_partly_filled_answer_is_told(capsys):
    assert "1 entry is still" in said(capsys, "demo.model", [sympy.cos(t1), ...])


def test_right_and_wrong_public_checks(capsys):
    assert "\N{CHECK MARK} x = 1 at t1 = 0" in said(capsys, "demo.model", [sympy.cos(t1), sympy.sin(t1)])
    assert "\N{BALLOT X} x = 1 at t1 = 0" in said(capsys, "demo.model", [sympy.sin(t1), sympy.sin(t1)])


@pytest.mark.parametrize(
    ("id", "answer", "words"),
    [
        ("demo.model", [1, 2, 3], "found an array of shape 3"),
        ("demo.model", [sympy.Symbol("q"), 1], "found the symbol q"),
        ("demo.model", object(), "found an object of type object"),
        ("demo.T", [[1, 2], [3]], "different lengths"),
        ("demo.f", 3, "found a number"),
    ],
)
def test_a_wrong_form_is_explained(capsys, id, answer, words):
    assert words in said(capsys, id, answer)


def test_rigid_transform_check(capsys):
    rotation = sympy.eye(4)
    rotation[:2, :2] = sympy.Matrix([[sympy.cos(t1), -sympy.sin(t1)], [sympy.sin(t1), sympy.cos(t1)]])
    assert "\N{CHECK MARK} it is a rigid motion" in said(capsys, "demo.T", rotation)
    rotation[0, 1] = sympy.sin(t1)
    assert "\N{BALLOT X} it is a rigid motion" in said(capsys, "demo.T", rotation)
    assert not is_rigid(np.diag([1.0, 1, -1, 1]))


def test_an_error_inside_the_function_is_shown_not_raised(capsys):
    assert "ZeroDivisionError" in said(capsys, "demo.f", lambda x: 1 / x)


def test_hints_come_in_levels(capsys):
    hint("demo.model")
    assert "look\n" in (first := capsys.readouterr().out) and "demo.model" in first
    hint("demo.model", 2)
    assert "look harder" in capsys.readouterr().out
    hint("demo.model", 9)
    assert "1 to 2" in capsys.readouterr().out


def test_unknown_question_names_the_nearest():
    with pytest.raises(KeyError, match="demo.model"):
        check("demo.modle", 1)


class Shell:
    """Stands for a running IPython: keeps what is displayed."""

    def __init__(self, monkeypatch):
        self.shown = []
        monkeypatch.setattr("IPython.get_ipython", lambda: self)
        monkeypatch.setattr("IPython.display.display", lambda data, raw: self.shown.append(data))


def test_in_jupyter_the_answer_travels_as_data(monkeypatch):
    shell = Shell(monkeypatch)
    check("demo.model", [sympy.cos(t1), "<script>"])
    data = shell.shown[0]
    assert json.loads(json.dumps(data[wire.MIME])) == {
        "format": 1,
        "question": "demo.model",
        "answer": [{"call": ["cos", {"sym": "t1"}]}, "<script>"],
    }


def test_notices_escape_what_the_student_wrote(monkeypatch):
    shell = Shell(monkeypatch)
    check("demo.model", [sympy.Symbol("<script>"), 1])
    assert "<script>" not in shell.shown[0]["text/html"] and "&lt;script&gt;" in shell.shown[0]["text/html"]


def test_probes_answer_value_by_value(monkeypatch):
    shell = Shell(monkeypatch)
    check("demo.f", lambda x: [1 / x, x])
    answer_probes("demo.f", "[[2.0], [0.0]]")
    assert shell.shown[-1][wire.MIME]["probes"] == [[0.5, 2.0], {"error": "ZeroDivisionError: float division by zero"}]


def test_public_question_is_frozen():
    with pytest.raises(AttributeError):
        public.find("demo.model").title = "another"


def test_a_variable_called_check_takes_no_name_from_a_check_cell(monkeypatch):
    from IPython.core.interactiveshell import InteractiveShell

    shell, handed_in = InteractiveShell(), []
    monkeypatch.setattr("IPython.get_ipython", lambda: shell)
    names.keep({"check": lambda id, answer: handed_in.append((id, answer))})
    for cell in (
        "check = (1 == 1)",
        "check = check and True",
        'check("scara.T04", 7)',
        "check = len",
        'size = check("ab")',
    ):
        assert shell.run_cell(cell).success, cell
    assert handed_in == [("scara.T04", 7)] and shell.user_ns["size"] == 2
