"""Made students of an exercise on one robot: one who is right, and some who make the named mistakes, one in each question."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import partial

import numpy as np
import sympy

from autograder.judge import Mistake, Question
from autograder.judge.question import take
from autograder.questions.shared import arm as asked
from autograder.questions.shared.configurations import turning
from autograder.questions.shared.described import Described
from autograder.questions.shared.sweep import sweep_of
from autograder.questions.shared.tables import list_rows


def made_students(exercise: str, arm: Described, questions: tuple[Question, ...]) -> str:
    """A file of the sample class: who hands in what, and the notes and shares that each answer must earn."""
    most = max(len(question.mistakes) for question in questions)
    lines = [
        f"# {arm.title}: made by autograder new-exercise. One is right, the others make every named mistake once.",
        "",
        f"[{exercise}.right]",
        'says = "Everything right, in the instructor\'s form."',
    ]
    for number in range(most):
        made = {question: question.mistakes[number] for question in questions if number < len(question.mistakes)}
        lines += [
            "",
            f"[{exercise}.mistakes-{number + 1}]",
            f'says = "In each question that has one, mistake {number + 1}; the others are left."',
            "answered = []",
            "",
            f"[{exercise}.mistakes-{number + 1}.answers]",
            *(f"{_kind(question)} = '''\n{_source(arm, question, node)}\n'''" for question, node in made.items()),
            "",
            f"[{exercise}.mistakes-{number + 1}.notes]",
            *(f"{_kind(question)} = {_note(node)}" for question, node in made.items()),
        ]
    return "\n".join(lines) + "\n"


def _kind(question: Question) -> str:
    return question.id.partition(".")[2]


def _note(node: Mistake) -> str:
    return f"[{json.dumps(node.note)}, {node.share:g}]"


def _source(arm: Described, question: Question, node: Mistake) -> str:
    """What somebody types who makes a mistake in the first of its ways."""
    kind, way = _kind(question), node.ways[0]
    if kind == asked.FORWARD:
        return "\n".join(_forward(arm, **dict(way.wrong or {})))
    if kind == asked.CLOUD:
        return "\n".join(_cloud(arm, **dict(way.wrong or {})))
    # Without the question's form, which is only being written.
    reference = question.reference
    right = reference(**dict(way.wrong or {})) if isinstance(reference, partial) else reference
    return f"{kind} = {_typed(take([way.step] if way.step else [], right))}"


def _typed(answer: object) -> str:
    if isinstance(answer, sympy.MatrixBase):
        return f"Matrix({_typed(answer.tolist())})"
    if isinstance(answer, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_typed(entry) for entry in answer) + "]"
    return str(round(answer, 6)) if isinstance(answer, float) else str(answer)


def _forward(arm: Described, unit: float = 1.0, convention: str = "modified") -> Iterator[str]:
    """A forward model that needs nothing but the letters and `lengths`."""
    yield f"def forward({', '.join(arm.joints)}):"
    for joint in (arm.joints[i] for i in turning(arm) if unit != 1.0):
        yield f"    {joint} = {joint} * np.pi / 180"
    yield f"    {', '.join([*arm.table.values, 'pi'])} = {', '.join([*(f'{value:g}' for value in arm.table.values.values()), 'np.pi'])}"
    yield "    pose = np.eye(4)"
    rows = ", ".join(f"[{', '.join(str(entry) for entry in row[1:])}]" for row in list_rows(arm.table))
    yield f"    for a, alpha, d, theta in [{rows}]:"
    yield "        along_x, along_z = np.eye(4), np.eye(4)"
    yield "        along_x[:, 1:] = [[0, 0, a], [np.cos(alpha), -np.sin(alpha), 0], [np.sin(alpha), np.cos(alpha), 0], [0, 0, 1]]"
    yield "        along_z[:2, :2] = [[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]]"
    yield "        along_z[2, 3] = d"
    yield f"        pose = pose @ {'along_x @ along_z' if convention == 'modified' else 'along_z @ along_x'}"
    yield "    return pose"


def _cloud(arm: Described, shape: str = "grid", ranges: str = "own", held: str = "own") -> Iterator[str]:
    sweep = sweep_of(arm)
    assert sweep is not None
    limits = [list(pair) for pair in (sweep.ranges if ranges == "own" else sweep.ranges[::-1])]
    names = dict(zip(sweep.joints, ("one", "other")))
    values = [names.get(i, f"{value:g}" if held == "own" else "0.0") for i, value in enumerate(sweep.held)]
    yield from _forward(arm)
    yield ""
    yield f"first, second = (np.linspace(*limits, 60) for limits in {limits})"
    pairs = "in zip(first, second)" if shape == "diagonal" else "in [(one, other) for one in first for other in second]"
    yield f"cloud = [forward({', '.join(values)})[:3, 3] for one, other {pairs}]"
