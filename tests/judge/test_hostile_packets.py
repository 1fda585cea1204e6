"""Bundles that no honest notebook sends: a verdict on each, within a second of processor time and 64 MiB, never an exception."""

import json
import signal
import tracemalloc

import pytest
from answers import STUDENT
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.judge import Evidence, judge
from autograder.questions import find
from dhkit import wire

pytestmark = pytest.mark.slow

BYTES = 64 << 20
ASKED = (
    "planar_2r.table",
    "planar_2r.model",
    "planar_2r.T0E",
    "planar_2r.theta1",
    "planar_2r.postures",
    "planar_2r.inverse",
    "planar_2r.centre",
)
SIZES = {"planar_2r.table": (4, 5), "planar_2r.model": (2,), "planar_2r.T0E": (4, 4), "planar_2r.theta1": ()}


class Hang(BaseException):
    pass


def bounded(id, node):
    """The verdict, within a second of processor time (whatever else the machine does) and, asked again, within `BYTES`."""

    def stop(*_):
        raise Hang("more than a second of processor time")

    found, before = evidence(id, node), signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, 1.0)
    try:
        verdict = judge(find(id), found, STUDENT)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
    tracemalloc.start()
    judge(find(id), found, STUDENT)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < BYTES
    return verdict


@pytest.fixture(scope="module", autouse=True)
def warm():
    """The references are ready before anything is timed, as after the first submission of a class."""
    for id in ASKED:
        judge(find(id), evidence(id, filled(id, 0.123)), STUDENT)


def evidence(id, node):
    packet = wire.packet(id, answer=node)
    if find(id).form.kind != "function":
        return Evidence(packet)
    probes = find(id).probes(STUDENT, 3)
    return Evidence(wire.packet(id, answer={"function": "f"}), (probes, wire.packet(id, probes=[node] * len(probes))))


def filled(id, node):
    """An answer of the form asked for, every entry `node`."""
    for size in reversed(SIZES.get(id, (1, 2))):
        node = [node] * size
    return node


def nested(node, wrap, times):
    for _ in range(times):
        node = wrap(node)
    return node


T1, L1 = {"sym": "q1"}, {"sym": "a"}
HEAVY = {
    "deep sines": nested(T1, lambda node: {"call": ["sin", node]}, 50),
    "tower of powers": nested(T1, lambda node: {"call": ["pow", 9, node]}, 40),
    "tower of roots": nested(L1, lambda node: {"call": ["pow", node, {"rat": [1, 3]}]}, 40),
    "huge exponent": {"call": ["pow", L1, {"int": "9" * 300}]},
    "huge base": {"call": ["pow", {"int": "9" * 300}, {"int": "9" * 300}]},
    "exponential of exponentials": nested(T1, lambda node: {"call": ["exp", node]}, 40),
    "tangent of a huge number": {"call": ["tan", {"int": "9" * 300}]},
    "modulo nothing": {"call": ["Mod", T1, 0]},
    "modulo a tiny number": {"call": ["Mod", {"int": "9" * 300}, {"rat": [1, {"int": "9" * 300}]}]},
    "root of minus one": {"call": ["pow", -1, {"rat": [1, 2]}]},
    "logarithm of nothing": {"call": ["log", 0]},
    "division by nothing": {"call": ["pow", 0, -1]},
    "infinity": {"float": "inf"},
    "400 sines in a sum": {"call": ["add", *[{"call": ["sin", {"call": ["mul", T1, k]}]} for k in range(400)]]},
    "long product": {"call": ["mul", *[{"call": ["add", T1, k]} for k in range(400)]]},
    "cancellation": {
        "call": [
            "add",
            {"call": ["mul", {"int": "1" + "0" * 40}, T1]},
            {"call": ["mul", {"int": "-1" + "0" * 40}, T1]},
            T1,
        ]
    },
    "greatest of many": {"call": ["Max", *[{"call": ["atan2", T1, k]} for k in range(1, 400)]]},
}
WHOLE = {
    "all nodes one may send": [{"sym": "t1"}] * 9000,
    "a sum of all nodes": {"call": ["add", *[{"call": ["sin", T1]}] * 9000]},
    "one entry takes all nodes": [
        {"call": ["add", *[{"call": ["tan", {"call": ["mul", k, T1]}]} for k in range(4000)]]},
        0,
    ],
    "a hundred solutions": [[k / 7, k] for k in range(100)],
    "one solution a hundred times": [[0.1, 0.2]] * 100,
    "deep lists": nested(0, lambda node: [node], 2000),
    "keys without end": {"dict": [[f"k{k}", k] for k in range(5000)]},
    "the same key twice": {"dict": [["t1", 1], ["t1", 2], ["t2", 0]]},
    "names of methods": {"dict": [["__class__", 1], ["t2", 2]]},
    "text of control characters": "\x1b[31m\u202e" * 200,
    "markup": "<script>alert(1)</script>" * 30,
}


@pytest.mark.parametrize("id", ["planar_2r.table", "planar_2r.T0E", "planar_2r.theta1", "planar_2r.postures"])
@pytest.mark.parametrize("name", HEAVY)
def test_heavy_entries_get_a_verdict(id, name):
    found = bounded(id, filled(id, HEAVY[name]))
    assert found.share <= find(id).partial


@pytest.mark.parametrize(
    "id", ["planar_2r.table", "planar_2r.model", "planar_2r.postures", "planar_2r.inverse", "planar_2r.centre"]
)
@pytest.mark.parametrize("name", WHOLE)
def test_odd_answers_get_a_verdict(id, name):
    found = bounded(id, WHOLE[name])
    assert found.share <= find(id).partial
    assert "<script" not in found.feedback and found.feedback.replace("\n", "").isprintable()


NODES = st.recursive(
    st.sampled_from([0, 1, -1, 0.5, 1e308, True, "A", T1, L1, {"const": "pi"}, {"const": "I"}, {"float": "nan"}, {"blank": True}, {"rat": [1, 3]}, {"unknown": "x"}]),
    lambda inner: st.lists(inner, max_size=4)
    | st.builds(lambda f, args: {"call": [f, *args]}, st.sampled_from(["add", "mul", "pow", *wire.FUNCTIONS]), st.lists(inner, min_size=1, max_size=3))
    | st.builds(lambda keys, item: {"dict": [[key, item] for key in keys]}, st.lists(st.sampled_from(["t1", "t2", "x", "a", "sigma"]), max_size=5), inner),
    max_leaves=30,
)  # fmt: skip


@settings(max_examples=300, deadline=None)
@given(st.sampled_from(ASKED), NODES, st.booleans())
def test_any_node_gets_a_verdict_as_an_answer_and_as_an_entry(id, node, whole):
    answer = json.loads(json.dumps(node if whole else filled(id, node)))
    found = judge(find(id), evidence(id, answer), STUDENT)
    assert 0 <= found.share <= 1 and found.note and found.feedback
