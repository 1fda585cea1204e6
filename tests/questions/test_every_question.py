"""Judge the judge, for every question there is: a new question is covered by being registered.

Right answers in several forms earn full marks, every mistake of the tree is named, perturbed answers are refused.
"""

from itertools import permutations

import numpy as np
import pytest
import sympy
from autograder.judge import Evidence, Variant, judge
from autograder.questions import exercises, find
from dhkit import public, wire

QUESTIONS = [question for questions in exercises().values() for question in questions]
VARIANT = Variant("ada")
DATA = [question for question in QUESTIONS if question.public.kind != "function"]
FUNCTIONS = [question for question in QUESTIONS if question.public.kind == "function"]
ids = lambda questions: [question.id for question in questions]  # noqa: E731


def verdict(question, answer):
    if question.public.kind != "function":
        return judge(question, Evidence(wire.bundle(question.id, answer=wire.encode(answer))), VARIANT)
    probes = question.probes(VARIANT, 7)
    results = []
    for args in probes:
        try:
            results.append(wire.encode(answer(*args)))
        except Exception as error:
            results.append({"error": str(error)})
    handed_in = wire.bundle(question.id, answer={"function": "f"})
    return judge(question, Evidence(handed_in, (probes, wire.bundle(question.id, probes=results))), VARIANT)


def entries(answer):
    """The answer as nested lists of SymPy expressions."""
    if isinstance(answer, str):
        return answer
    rows = np.array(sympy.Matrix(answer).tolist() if isinstance(answer, sympy.MatrixBase) else answer, dtype=object)
    return np.vectorize(sympy.sympify, otypes=[object])(rows)


def other_forms(question):
    """The reference written in other ways that a student may use."""
    answer = question.reference(VARIANT)
    kind = question.public.kind
    if kind == "choice":
        return {"lower case": answer.lower(), "spaces": f" {answer}\n"}
    if kind == "joint_solutions":
        solutions = np.array(answer, dtype=float)
        turned = solutions.copy()
        turned[:, list(question.angles)] += 2 * np.pi
        return {
            "other order": solutions[::-1],
            "a turn further": turned,
            "twice": np.vstack([solutions, solutions]),
            "list of tuples": [tuple(row) for row in solutions],
            "sympy matrix": sympy.Matrix(solutions.tolist()),
            "rounded": np.round(solutions, 4),
        }
    form = entries(answer)
    change = lambda f: np.vectorize(f, otypes=[object])(form)  # noqa: E731
    forms = {
        "nested lists": form.tolist(),
        "array of objects": form,
        "expanded": change(lambda e: sympy.expand(e, trig=True)),
        "exponentials": change(lambda e: e.rewrite(sympy.exp)),
        "floats": change(lambda e: e.evalf(12)),
        "unevaluated sum": change(lambda e: sympy.Add(e, 3, -3, evaluate=False)),
        "together": change(sympy.together),
    }
    if form.ndim == 2:
        forms["sympy matrix"] = sympy.Matrix(form.tolist())
        forms["immutable matrix"] = sympy.ImmutableMatrix(form.tolist())
        forms["tuples"] = tuple(map(tuple, form.tolist()))
    elif form.ndim == 1:
        forms["column"] = sympy.Matrix(form.tolist())
        forms["row"] = sympy.Matrix([form.tolist()])
    return forms


def right_forms():
    for question in DATA:
        for name in ("as it is", *other_forms(question)):
            yield pytest.param(question, name, id=f"{question.id}: {name}")


@pytest.mark.parametrize(("question", "form"), list(right_forms()))
def test_right_forms_earn_everything(question, form):
    answer = {"as it is": question.reference(VARIANT), **other_forms(question)}[form]
    assert (verdict(question, answer).note, verdict(question, answer).share) == ("right", 1.0)


@pytest.mark.parametrize("question", FUNCTIONS, ids=ids(FUNCTIONS))
def test_right_functions_earn_everything(question):
    reference = question.reference(VARIANT)
    for form in (reference, lambda *args: np.array(reference(*args)), lambda *args: np.array(reference(*args)).tolist()):
        assert verdict(question, form).note == "right"


def mistakes():
    for question in QUESTIONS:
        for node in question.mistakes:
            for i, step in enumerate(node.steps):
                yield pytest.param(question, node, step, id=f"{question.id}: {node.note} {i}")


@pytest.mark.parametrize(("question", "node", "step"), list(mistakes()))
def test_every_mistake_is_named(question, node, step):
    found = verdict(question, step(question.reference(VARIANT)))
    assert (found.note, found.share, found.feedback) == (node.note, node.share, node.feedback)


TURNED_X2 = [[0, 0, 0, 0, "t1"], [0, "a2", 0, 0, "t2 + pi"], [1, "-a3", 0, "-d2", "pi"], [0, 0, 0, 0, "t4"]]
SHIFTED_O3 = [[0, 0, 0, 0, "t1"], [0, "a2", 0, 0, "t2"], [1, "a3", 0, "-d2 - a2", 0], [0, 0, 0, "a2", "t4"]]
DOWNWARDS = [[0, 0, 0, 0, "t1"], [0, "a2", 0, 0, "t2"], [1, "a3", "pi", "d2", 0], [0, 0, 0, 0, "-t4"]]


@pytest.mark.parametrize(
    ("rows", "note", "words"),
    [
        (TURNED_X2, "right", "another sense of X2"),
        (SHIFTED_O3, "right", "another origin O3 along Z3"),
        (DOWNWARDS, "same_chain_other_frames", "another tool frame"),
    ],
)
def test_the_scara_in_other_frames(rows, note, words):
    found = verdict(find("scara.table"), [[sympy.sympify(cell) for cell in row] for row in rows])
    assert found.note == note and words in found.feedback


@pytest.mark.parametrize("question", DATA, ids=ids(DATA))
def test_two_mistakes_at_once_are_named(question):
    for first, second in permutations(question.mistakes, 2):
        answer = second.steps[0](first.steps[0](question.reference(VARIANT)))
        note = verdict(question, answer).note
        assert note not in ("partly_right", "nothing_matched", "malformed"), f"{first.note}, then {second.note}"


def test_two_mistakes_earn_the_product_of_their_shares_and_both_feedbacks():
    question = find("scara.table")
    signs, classic = (next(n for n in question.mistakes if n.note == note) for note in ("sign_of_d2", "classic_table"))
    found = verdict(question, classic.steps[0](signs.steps[0](question.reference(VARIANT))))
    assert found.note == "classic_table+sign_of_d2"
    assert found.share == pytest.approx(signs.share * classic.share)
    assert signs.feedback in found.feedback and classic.feedback in found.feedback


@pytest.mark.parametrize("question", QUESTIONS, ids=ids(QUESTIONS))
def test_a_tree_is_well_formed(question):
    notes = [node.note for node in question.mistakes]
    assert len(set(notes)) == len(notes)
    assert all(0 <= node.share < 1 and node.feedback.strip() for node in question.mistakes)
    assert all(node.steps for node in question.mistakes)


@pytest.mark.parametrize("question", QUESTIONS, ids=ids(QUESTIONS))
def test_nothing_is_not_an_answer(question):
    blank = ... if question.public.kind != "function" else lambda *args: None
    assert (verdict(question, blank).note, verdict(question, blank).share) == ("not_attempted", 0.0)


def perturbed(question, rng):
    """The reference with one entry changed by a visible amount."""
    answer = question.reference(VARIANT)
    if question.public.kind == "joint_solutions":
        solutions = np.array(answer, dtype=float)
        solutions[rng.integers(len(solutions)), rng.integers(solutions.shape[1])] += rng.choice([-1, 1]) * rng.uniform(0.05, 1)
        return solutions
    form = entries(answer)
    place = rng.integers(form.size)
    symbols = sympy.symbols(question.public.symbols)
    change = [rng.uniform(0.01, 1), -1, symbols[rng.integers(len(symbols))], 0]
    old = form.reshape(-1)[place] if form.ndim else form.item()
    new = [old + change[0], -old, old * change[2], old + change[2]][rng.integers(4)]
    changed = form.reshape(-1).copy()
    changed[place] = new
    return changed.reshape(form.shape) if form.ndim else changed[0], old, new


@pytest.mark.parametrize("question", [q for q in DATA if q.public.kind != "choice"], ids=lambda q: q.id)
def test_perturbed_answers_are_refused(question):
    rng = np.random.default_rng(11)
    for _ in range(200):
        result = perturbed(question, rng)
        answer = result
        if isinstance(result, tuple):
            answer, old, new = result
            if old == new:
                continue
        found = verdict(question, answer)
        assert found.share < 1, answer


@pytest.mark.parametrize("question", [q for q in DATA if q.public.kind == "choice"], ids=lambda q: q.id)
def test_other_choices_are_refused(question):
    right = question.reference(VARIANT)
    assert right in question.public.options
    assert all(verdict(question, letter).share == 0 for letter in question.public.options if letter != right)


@pytest.mark.parametrize("question", FUNCTIONS, ids=ids(FUNCTIONS))
def test_constant_functions_are_refused(question):
    first = question.reference(VARIANT)(*question.probes(VARIANT, 7)[0])
    for wrong in (lambda *args: first, lambda *args: [], lambda *args: 1 / 0, lambda *args: "right"):
        assert verdict(question, wrong).share == 0


@pytest.mark.parametrize("question", FUNCTIONS, ids=ids(FUNCTIONS))
def test_something_else_than_a_function_is_said_to_be_so(question):
    found = judge(question, Evidence(wire.bundle(question.id, answer=[1, 2])), VARIANT)
    assert found.note == "malformed" and "expected a function" in found.feedback and "shape 2" in found.feedback


def test_both_halves_ask_the_same_questions():
    assert {question.id for question in QUESTIONS} == set(public.questions())


def test_an_unknown_question_names_what_exists():
    with pytest.raises(KeyError, match="scara.T04"):
        find("scara.T40")
