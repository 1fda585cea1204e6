"""The envelopes of an exercise: for each question its right answer, its named mistakes and its right parts."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import chain, islice
from math import log2

import msgspec
import numpy as np
from msgspec.structs import replace

from autograder.judge import Question
from autograder.judge.chain.freedoms import Freedom
from autograder.judge.question import Family, Way
from autograder.judge.tree import IMPOSSIBLE
from dhkit import variants, wire
from dhkit.forms import Form
from dhkit.forms.base import Parts, Sight
from dhkit.forms.choice import Choice
from dhkit.forms.dh_table import DHTable
from dhkit.home.cells import COST
from dhkit.home.envelopes import (
    Said,
    SealedExercise,
    SealedQuestion,
    derived,
    length_for,
    lock_of,
    seal,
    seal_text,
)
from dhkit.home.verdict import function_parts, kind_of

from .likely import named
from .plausible import ENOUGH, bits_of_parts, bits_of_results

CALLS_A_CASE = 3
POINTS_OF_A_TABLE = 2
"""A chain is known by its hand in two postures; frames at every point would make large envelopes."""

_SEED = 13
_TO_TRY = "its answer could be found by trying"
_PINS = {"z": Freedom.Z, "x": Freedom.X, "origin": Freedom.ORIGIN}


@dataclass(frozen=True)
class Decision:
    """Whether a question has a verdict at home, and the arithmetic behind it.

    Attributes
    ----------
    question : str
    bits : float
        Of the right answer: see `plausible`.
    why_not : str
        Empty where it is sealed.
    mistakes, parts : int
        How many of its mistakes and of its parts are sealed.
    """

    question: str
    bits: float
    why_not: str = ""
    mistakes: int = 0
    parts: int = 0


@dataclass(frozen=True, eq=False)
class Sealable:
    """An answer, or a part of one, that is to be sealed for one set of numbers."""

    said: Said
    part: str
    numbers: np.ndarray
    witness: np.ndarray = field(default_factory=lambda: np.zeros(0))


@dataclass(frozen=True, eq=False)
class Look:
    """An answer of the question itself, as it is seen at home."""

    parts: Parts
    bits: Mapping[str, float]
    witness: np.ndarray


def seal_exercise(
    exercise: str,
    questions: Sequence[Question],
    salt: bytes,
    solutions: Mapping[str, str] = {},
    points: Mapping[str, float] = {},
    *,
    cost: int = COST,
    sets: int = variants.SETS,
    least: float = ENOUGH,
    told: Callable[[str], None] = lambda question: None,
) -> tuple[SealedExercise, list[Decision]]:
    """The file for the students' copies of an exercise.

    Parameters
    ----------
    exercise : str
    questions : sequence of Question
    salt : bytes
        Drawn anew for each release; the same one gives the same bytes.
    solutions : mapping of str to str
        The worked solution of each question, Markdown.
    points : mapping of str to float
        What each question is worth.
    cost : int
        Of scrypt, for each envelope.
    sets : int
        How many sets of numbers are sealed; the others have no verdict at home.
    least : float
        Bits that an answer must have to be sealed, 0 where it is no secret: see `plausible`.
    told : callable
        Told each question that is done.
    """
    head = SealedExercise(exercise=exercise, salt=salt, cost=cost)
    sealed, made = {}, []
    with ThreadPoolExecutor() as pool:
        for question in questions:
            entry, decision = _seal_question(head, question, solutions.get(question.id, ""), sets, least, pool)
            sealed[question.id.partition(".")[2]] = replace(entry, points=points.get(question.id, 0.0))
            made.append(decision)
            told(question.id)
    return SealedExercise(exercise=exercise, salt=salt, cost=cost, questions=sealed), made


def decisions(questions: Iterable[Question]) -> list[Decision]:
    """Which of the questions have a verdict at home, without sealing them."""
    return [
        _decide(question, _sight(question), _rights(question, _different(question, variants.SETS)[0]))
        for question in questions
    ]


def _different(question: Question, sets: int) -> tuple[list[int], list[int]]:
    """Sets of numbers that lead to different answers, and for every set the place of its like among them."""
    if not question.personal:
        return [0], []
    if question.depends is None:
        return list(range(sets)), []
    numbers = [variants.numbers_of_set(question.exercise, which) for which in range(sets)]
    counting = [tuple(one[name] for name in question.depends) for one in numbers]
    places = {values: place for place, values in enumerate(dict.fromkeys(counting))}
    return [counting.index(values) for values in places], [places[values] for values in counting]


def _rights(question: Question, sets: Iterable[int]) -> list[Look | None]:
    """The right answer for each of these sets of numbers."""
    return [_seen(question, which) for which in sets]


def _seal_question(
    head: SealedExercise, question: Question, solution: str, sets: int, least: float, pool: ThreadPoolExecutor
) -> tuple[SealedQuestion, Decision]:
    sight = _sight(question)
    numbers_sets, shared = _different(question, sets)
    decision = _decide(question, sight, _rights(question, numbers_sets), least)
    if decision.why_not:
        return SealedQuestion(why_not=decision.why_not), decision
    calls = [_calls(question, which) for which in numbers_sets]
    to_seal = [sealables(question, which, solution, least) for which in numbers_sets]
    texts = {one.said: None for some in to_seal for one in some}
    numbered = {said: number for number, said in enumerate(texts)}
    length = length_for(max(len(one.witness) for some in to_seal for one in some))
    most = max(map(len, to_seal))

    def keyed(place: int, one: Sealable) -> tuple[bytes, bytes]:
        lock = lock_of(head, question.id, one.part, question.personal, place, sight.tolerance)
        return lock.key(lock.cell(one.numbers))

    keys = list(pool.map(lambda job: keyed(*job), ((place, one) for place, some in enumerate(to_seal) for one in some)))
    # Whoever has the right answer for the first set has made it; from nothing else do the keys of texts follow.
    secret = keys[0][1]
    text_keys = {said: derived(secret, f"text {number}") for said, number in numbered.items()}
    size = max(len(msgspec.json.encode(said)) for said in texts)
    remaining = iter(keys)
    envelopes = []
    for place, some in enumerate(to_seal):
        found = [seal(*next(remaining), numbered[one.said], text_keys[one.said], one.witness, length) for one in some]
        found += [_filler(secret, place, number, length) for number in range(len(some), most)]
        envelopes.append(b"".join(sorted(found)))
    entry = SealedQuestion(
        sight=sight,
        calls=[one.arguments for one in calls],
        cases=[one.cases for one in calls],
        personal=question.personal,
        shared=shared,
        length=length,
        envelopes=envelopes,
        texts=[seal_text(text_keys[said], said, size) for said in texts],
    )
    notes = {one.said.note for some in to_seal for one in some if one.said.state == "mistake"}
    parts = {one.part for some in to_seal for one in some if one.part}
    return entry, Decision(question.id, decision.bits, "", len(notes), len(parts))


def _filler(secret: bytes, place: int, number: int, length: int) -> bytes:
    """What cannot be told from an envelope, so that their number says nothing."""
    return hashlib.shake_256(derived(secret, f"filler {place} {number}")).digest(length)


def _sight(question: Question) -> Sight:
    """How answers to the question are compared, said without its answer."""
    samples = {name: values.tolist() for name, values in question.samples.items()}
    count = len(next(iter(samples.values()), [0]))
    if isinstance(question.form, DHTable):
        count = min(count, POINTS_OF_A_TABLE)
    points = tuple({name: values[i] for name, values in samples.items()} for i in range(count))
    pins = tuple(name for name, freedom in _PINS.items() if freedom in question.pinned)
    return Sight(points=points, angles=question.angles, tolerance=question.accuracy, pins=pins)


def _decide(question: Question, sight: Sight, rights: Sequence[Look | None], least: float = ENOUGH) -> Decision:
    if question.public.home == "form":
        return Decision(question.id, 0.0, "the lecturer decided so")
    if isinstance(question.form, Choice):
        return Decision(question.id, log2(len(question.form.options)), _TO_TRY)
    if any(right is None for right in rights):
        return Decision(question.id, 0.0, "there are too many ways to be right")
    bits = min(right.bits.get("", 0.0) for right in rights if right is not None)
    return Decision(question.id, bits, "" if bits >= least else _TO_TRY)


def sealables(question: Question, which: int, solution: str = "", least: float = ENOUGH) -> list[Sealable]:
    """What is sealed of a question for one set of numbers, the right answer first."""
    sight, right = _sight(question), _seen(question, which)
    assert right is not None, question.id
    left_out = ", ".join(_calls(question, which).left_out)
    said = Said(state="right", note="right", share=1.0, solution=solution, left_out=left_out)
    essential = question.form.essential
    found = [Sealable(said, "", right.parts[""], essential(right.witness))]
    seen = [essential(right.witness)]

    def add(said: Said, look: Look | None) -> None:
        if look is None or look.bits[""] < least:
            return
        if any(question.form.agree(essential(look.witness), other, sight) for other in seen):
            return  # what comes first in the tree decides
        seen.append(essential(look.witness))
        found.append(Sealable(said, "", look.parts[""], look.witness))

    for node in question.mistakes:
        said = Said(state="mistake", note=node.note, share=node.share, text=node.feedback)
        for way in node.ways:
            add(said, _seen(question, which, way))
    if not question.personal and question.form.kind != "function":
        for verdict, answer in named(question, variants.member(question.exercise, which)):
            said = Said(state="mistake", note=verdict.note, share=verdict.share, text=verdict.feedback)
            add(said, _look(question, sight, answer))
    for part, numbers in right.parts.items():
        if part and right.bits.get(part, 0.0) >= least:
            found.append(Sealable(Said(state="part", note=kind_of(part)), kind_of(part), numbers))
    return found


def _seen(question: Question, which: int, *ways: Way) -> Look | None:
    """An answer of the question itself; None where there is none, or none that numbers tell from others."""
    sight, student = _sight(question), variants.member(question.exercise, which)
    try:
        answer = question.answer(student, *ways)
        if question.form.kind == "function":
            return _seen_function(question, sight, which, answer)
    except IMPOSSIBLE:
        return None
    return None if isinstance(answer, Family) else _look(question, sight, answer)


def _look(question: Question, sight: Sight, answer: object) -> Look | None:
    form: Form = question.form
    node = wire.encode(answer)
    if form.complaint(node):
        return None
    node = form.arranged(node)
    parts = form.invariants(node, sight)
    if not parts:
        return None
    return Look(parts, bits_of_parts(form, node, sight, parts), form.witness(node, sight))


def _seen_function(question: Question, sight: Sight, which: int, function: Callable) -> Look | None:
    calls = _calls(question, which)
    alone = [_result(question, sight, function, args) for args in calls.arguments]
    if any(one is None for one in alone):
        return None
    results = [wire.encode(function(*args)) for args in calls.arguments]
    parts = function_parts(question.returns, results, calls.cases, SealedQuestion(sight=sight))
    bits = {
        part: bits_of_results(
            [one for one, case in zip(alone, calls.cases) if one is not None and part in ("", case)], sight.tolerance
        )
        for part in parts
    }
    return Look(parts, bits, parts[""])


def _result(question: Question, sight: Sight, function: Callable, args: list) -> np.ndarray | None:
    """What a function returns for `args`, as it is seen at home."""
    node = wire.encode(function(*args))
    form = question.returns
    return None if form.complaint(node) else form.invariants(form.arranged(node), sight).get("")


@dataclass(frozen=True)
class Calls:
    """Arguments that a function is called with at home.

    Attributes
    ----------
    arguments : list of list
    cases : list of str
        The case of each.
    left_out : tuple of str
        Cases in which infinitely many results are right: only the grader tries them.
    """

    arguments: list[list] = field(default_factory=list)
    cases: list[str] = field(default_factory=list)
    left_out: tuple[str, ...] = ()


@lru_cache(maxsize=4096)
def _calls(question: Question, which: int) -> Calls:
    """A few calls of each case, and for every mistake one that tells it from the right function."""
    if question.form.kind != "function":
        return Calls()
    student, sight = variants.member(question.exercise, which), _sight(question)
    right = question.answer(student)
    drawn = [json.loads(json.dumps(args, default=float)) for args in question.probes(student, _SEED) or ()]
    usable = [args for args in drawn if not isinstance(right(*args), Family)]
    seen = [_result(question, sight, right, args) for args in usable]
    cases = [question.case(*args) for args in usable]
    chosen = {
        place for case in cases for place in islice((i for i, one in enumerate(cases) if one == case), CALLS_A_CASE)
    }
    for way in chain.from_iterable(node.ways for node in question.mistakes):
        in_turn = (*sorted(chosen), *(place for place in range(len(usable)) if place not in chosen))
        differ = (place for place in in_turn if _differs(question, sight, student, way, usable[place], seen[place]))
        chosen.update(islice(differ, 1))
    kept = sorted(chosen)
    left_out = dict.fromkeys(question.case(*args) for args in drawn if isinstance(right(*args), Family))
    return Calls([usable[i] for i in kept], [cases[i] for i in kept], tuple(left_out))


def _differs(question: Question, sight: Sight, student: str, way: Way, args: list, right: np.ndarray | None) -> bool:
    """Whether somebody who makes a mistake gets something else for `args`."""
    try:
        found = _result(question, sight, question.answer(student, way), args)
    except IMPOSSIBLE:
        return True
    return right is None or found is None or not question.form.agree(found, right, sight)
