"""The decoder meets everything a hostile kernel can send: it answers with a value or with `Malformed`, soon and small."""

import contextlib
import json
import tracemalloc

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.judge.decode import MAX_DEPTH, Blank, Constant, Malformed, Number, decode_answer, decode_probes
from autograder.judge.evaluate import evaluate
from dhkit.wire import encode, packet

t1, t2 = sympy.symbols("t1 t2")


def decode(node):
    return decode_answer(packet("q", answer=node), "q").value


@pytest.mark.parametrize(
    "expression",
    [
        sympy.sin(t1 + t2) / 3,
        sympy.sqrt(t1**2 + 1),
        sympy.atan2(t1, t2),
        sympy.exp(sympy.I * t1),
        sympy.Abs(t1 - t2),
        sympy.Max(t1, t2) + sympy.Mod(t1, 2),
        sympy.cot(t1) * sympy.sec(t2),
        sympy.Float(0.1) * t1,
        sympy.pi / 7,
        sympy.sign(t1) * sympy.log(t2 + 3),
    ],
)
def test_an_expression_keeps_its_value_over_the_wire(expression):
    points = {"t1": np.array([0.3, 1.2]), "t2": np.array([0.7, 0.1])}
    values = evaluate(decode(json.loads(json.dumps(encode(expression)))), points)
    for i in range(2):
        expected = complex(expression.subs({t1: points["t1"][i], t2: points["t2"][i]}))
        assert abs(values[i] - expected) < 1e-12


def test_blank_and_constants():
    assert decode(encode(...)) == Blank() and decode(encode(None)) == Blank()
    assert decode(encode(sympy.pi)) == Constant("pi")
    assert decode(encode(True)) == Number(1)


def nested(depth):
    node = 1
    for _ in range(depth):
        node = [node]
    return node


NASTY = {
    "deep list": nested(MAX_DEPTH + 2),
    "wide list": [0] * 30_000,
    "deep call": {"call": ["sin", {"call": ["sin", nested(80)]}]},
    "nan as a number": float("nan"),
    "huge integer": 10**5000,
    "huge integer in digits": {"int": "9" * 5000},
    "digits that are not ascii": {"int": "\u0663\u0663"},
    "two tags": {"sym": "a", "int": "1"},
    "no tag": {},
    "unknown tag": {"exec": "import os"},
    "private method as tag": {"numbers": [1, 2]},
    "dunder as tag": {"_init__": []},
    "unknown function": {"call": ["system", 1]},
    "wrong arity": {"call": ["atan2", 1]},
    "call of a text": {"call": ["sin", "rm -rf /"]},
    "call of a list": {"call": ["add", [1], 2]},
    "zero denominator": {"rat": [1, 0]},
    "fraction of floats": {"rat": [0.5, 2]},
    "fraction of three": {"rat": [1, 2, 3]},
    "unhashable constant": {"const": ["pi"]},
    "unhashable function": {"call": [["sin"], 1]},
    "long text": "x" * 100_000,
    "odd dictionary": {"dict": [[1, 2, 3]]},
    "number as text": {"sym": 5},
    "null": None,
    "float tag": {"float": "1e400"},
}


@pytest.mark.parametrize("name", NASTY)
def test_nasty_nodes_are_refused(name):
    with pytest.raises(Malformed):
        decode(NASTY[name])


@pytest.mark.parametrize(
    "raw",
    [
        None, 1, "text", [], {},
        {"format": 1, "question": "other", "answer": 1},
        {"format": 2, "question": "q", "answer": 1},
        {"format": True, "question": "q", "answer": 1},
        {"format": 1, "question": "q", "answer": 1, "share": 1.0},
        {"format": 1, "question": ["q"], "answer": 1},
        {"format": 1, "question": "q", "probes": []},
    ],
)  # fmt: skip
def test_a_packet_must_be_exactly_what_check_writes(raw):
    with pytest.raises(Malformed):
        decode_answer(raw, "q")


def test_probes_must_match_what_was_sent():
    assert len(decode_probes(packet("q", probes=[1, 2]), "q", 2)) == 2
    with pytest.raises(Malformed):
        decode_probes(packet("q", probes=[1]), "q", 2)


def test_power_towers_cost_nothing():
    tower = 9
    for _ in range(30):
        tower = {"call": ["pow", 9, tower]}
    assert not np.isfinite(evaluate(decode(tower), {})).all()


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=5)
    | st.dictionaries(st.sampled_from(["sym", "int", "rat", "call", "const", "dict", "blank", "float", "error", "x"]), inner, max_size=2)
    | st.builds(lambda f, args: {"call": [f, *args]}, st.sampled_from(["add", "mul", "pow", "sin", "atan2", "eval"]), st.lists(inner, max_size=3)),
    max_leaves=40,
)  # fmt: skip


@pytest.mark.slow
@settings(max_examples=400, deadline=None)
@given(JSON)
def test_any_json_is_decoded_or_refused(node):
    with contextlib.suppress(Malformed):
        decode(node)


@pytest.mark.parametrize("node", [[0] * 19_000, {"call": ["add", *[{"sym": "t1"}] * 19_000]}, ["x" * 1000] * 5000])
def test_memory_stays_small(node):
    tracemalloc.start()
    decode(node)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 64 << 20
