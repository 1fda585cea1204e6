"""``autograder explain``: how one verdict came about, as text and as a page that can be forwarded."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path

import nbformat
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from nbformat.notebooknode import NotebookNode

from autograder import questions
from autograder.judge import Evidence, is_forgivable
from autograder.judge.account import Account, account
from autograder.judge.tree import UNEXPLAINED
from autograder.sandbox import available
from dhkit.variants import normal_form

from .cells import answer_id, check_cells, check_id, counts_for_everybody, notebook_record, question_id, tracked_cells
from .collecting.receipts import read_receipts, receipts_folder, teams
from .course import Course
from .entries import note_of, score
from .errors import CourseError
from .folders import released_path
from .gradebook import reading
from .inert import terminal_text, without_markdown
from .plugins.autograde import SubmissionAutograde, submission
from .plugins.preprocessors import SandboxExecute
from .roster import read_roster
from .store import StoredComment, StoredGrade, stored_notebooks
from .submission.judging import verdicts
from .submission.restore import restore

_SOURCE, _LINE, _CALLS = 4000, 400, 3


@dataclass(frozen=True)
class Explanation:
    """All that is to be said about one question of one submission.

    Attributes
    ----------
    source : str
        What stands in the answer's cell.
    trouble : str or None
        Why it did not run, if it did not.
    for_everybody : bool
        Whether all who hand in get the points.
    stored, comment
        What the gradebook holds; None if it was never graded.
    earlier : str or None
        Answer note of the earlier question that errors may be carried over from.
    remarks : tuple of str
        About the notebook as a whole.
    """

    student: str
    question: str
    title: str
    max_score: float
    source: str
    trouble: str | None
    for_everybody: bool
    account: Account
    stored: StoredGrade | None
    comment: StoredComment | None
    earlier: str | None
    remarks: tuple[str, ...]

    @property
    def stale(self) -> str:
        """The note in the gradebook, where grading now would give another one; empty otherwise."""
        note = note_of(self.comment.auto) if self.comment else None
        return note if note and note != self.account.verdict.note else ""


def find_student(course: Course, exercise: str, given: str) -> str:
    """The id under which work of the student who is meant lies: by id or name, however typed, or that of the team."""
    students, roster = course.students(exercise), read_roster(course.root)
    if given in students:
        return given
    named = [person.id for person in roster.named(given)]
    in_teams = teams(read_receipts(receipts_folder(course.root, exercise)), roster, students)
    meant = {normal_form(name) for name in (given, *named, *(in_teams[id] for id in named if id in in_teams))}
    found = [student for student in students if normal_form(student) in meant]
    if len(found) != 1:
        raise CourseError(f"{given!r} handed in nothing for {exercise}; handed in: {', '.join(students) or 'nobody'}")
    return found[0]


def explain(course: Course, student: str, question: str) -> Explanation:
    """Run a student's notebook once more and account for the verdict on one question.

    Raises
    ------
    CourseError
        If there is no such question or submission, or it cannot be run here.
    """
    exercise = question.partition(".")[0]
    course.choose(exercise)
    student = find_student(course, exercise, student)
    released = released_path(course.app.coursedir, exercise, exercise)
    if not released.is_file():
        raise CourseError(f"{released} is missing; run: autograder release {exercise}")
    given_out = nbformat.read(released, as_version=4)
    asked, check = check_cells(given_out), check_id(question)
    if check not in asked:
        raise CourseError(f"there is no question {question!r}; there are: {', '.join(map(question_id, asked))}")
    folder = course.step("submitted", student, exercise)
    nb = restore(submission(folder / f"{exercise}.ipynb", released), given_out)
    evidence = _evidence(course, nb, folder, released, student)
    earlier, notes = _earlier(asked, check, evidence, student)
    this = questions.find(question)
    with reading(course.db_url) as session:
        stored = stored_notebooks(session, exercise, student).get((student, exercise))
    return Explanation(
        student,
        question,
        this.public.title,
        float(asked[check].metadata.nbgrader["points"]),
        "" if notebook_record(nb).unreadable else tracked_cells(nb)[answer_id(check)].source,
        evidence[check].trouble,
        counts_for_everybody(asked[check]),
        account(this, evidence[check], student, earlier),
        stored.grades.get(check) if stored else None,
        stored.comments.get(answer_id(check)) if stored else None,
        notes.get(this.follows.earlier) if this.follows else None,
        notebook_record(nb).remarks(),
    )


def _evidence(course: Course, nb: NotebookNode, folder: Path, released: Path, student: str) -> dict[str, Evidence]:
    runner = SandboxExecute(parent=SubmissionAutograde(coursedir=course.app.coursedir, parent=course.app))
    if runner.mode == "bwrap" and (reason := available()):
        raise CourseError(f"no sandbox: {reason}. Students' code is not run without one unless you say --sandbox none")
    execution = runner.run(nb, folder, released, student, course.root)
    if execution.doubt:
        execution = runner.run_alone(nb, folder, released, student, course.root)
    return execution.evidence


def _earlier(
    asked: Mapping[str, NotebookNode], check: str, evidence: Mapping[str, Evidence], student: str
) -> tuple[dict[str, Evidence], dict[str, str]]:
    """Evidence of the questions before `check` whose errors are forgivable, and the notes of all of them."""
    before = verdicts({name: evidence[name] for name in takewhile(lambda name: name != check, asked)}, student)
    notes = {question_id(name): verdict.note for name, verdict in before.items()}
    forgivable = {question_id(name): evidence[name] for name, verdict in before.items() if is_forgivable(verdict)}
    return forgivable, notes


def as_text(found: Explanation, with_answer: bool) -> str:
    """The explanation for a terminal."""
    parts = _parts(found, with_answer, whole_tree=True)
    return "\n".join(f"{heading}\n{textwrap.indent(_plain(text), '    ')}" for heading, text in parts)


def as_page(found: Explanation, with_answer: bool) -> str:
    """The explanation as one page that needs nothing else and in which nothing acts.

    Without the answer it does not name mistakes that the student did not make, either.
    """
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    parts = [(heading, _plain(text)) for heading, text in _parts(found, with_answer, whole_tree=with_answer)]
    return environment.get_template("explanation.html.j2").render(found=found, parts=parts)


def _plain(text: str) -> str:
    """Lines without control characters, indented as they were."""
    return "\n".join(
        f"{' ' * (len(line) - len(line.lstrip(' ')))}{terminal_text(line, _LINE)}" for line in text.split("\n")
    )


def _parts(found: Explanation, with_answer: bool, whole_tree: bool) -> list[tuple[str, str]]:
    """Headings and texts, in the order in which one asks."""
    told = found.account
    verdict = told.verdict
    share = 1.0 if found.for_everybody else verdict.share
    points = f"{score(share, found.max_score):g} of {found.max_score:g} points"
    parts = [
        (f"{found.question}: {found.title}", f"{found.student}: {points}, {verdict.note}"),
        ("In the gradebook", _gradebook(found)),
        ("What was typed", found.source[:_SOURCE] or "(nothing that can be read)"),
        ("How it was read", _reading(found)),
        ("What the student is told", without_markdown(verdict.feedback)),
        ("What decided", _tree(told, whole_tree)),
    ]
    if found.for_everybody:
        parts.append(("For everybody", "this question counts fully for all who handed in"))
    if told.numbers:
        own = ", ".join(f"{name} = {value}" for name, value in told.numbers.items())
        parts.append(("The student's own numbers", own))
    if told.calls:
        wrong = sum(not call.right for call in told.calls)
        parts.append(
            (f"The function was called {len(told.calls)} times; {wrong} times wrong", _calls(told, with_answer))
        )
    if with_answer and told.expected:
        parts.append(("The right answer", told.expected))
    if told.earlier:
        carried = "this answer follows from it, and was accepted" if told.carried_over else "nothing was carried over"
        parts.append(("Errors carried over", f"from {told.earlier} ({found.earlier}): {carried}"))
    if found.remarks:
        parts.append(("About the notebook", "\n".join(found.remarks)))
    return parts


def _gradebook(found: Explanation) -> str:
    if found.stored is None:
        return "not graded yet"
    grade, comment = found.stored, found.comment
    lines = [f"{grade.score:g} of {grade.max_score:g} points"]
    if grade.manual is not None:
        lines[0] += f": typed by hand, in place of {grade.auto or 0:g} from the judge"
    if grade.extra:
        lines.append(f"{grade.extra:g} of them extra credit")
    if comment and comment.manual:
        lines.append(f"comment: {comment.manual}")
    if found.stale:
        lines.append(f"the note there is {found.stale}: question or notebook have changed since; grade again")
    return "\n".join(lines)


def _reading(found: Explanation) -> str:
    lines = [f"asked for: {found.account.asked}"]
    if found.trouble:
        lines.append(f"it did not run: {found.trouble}")
    lines.append(
        f"found:\n{textwrap.indent(found.account.read, '    ')}" if found.account.read else "no answer was handed in"
    )
    return "\n".join(lines)


def _tree(told: Account, whole: bool) -> str:
    note, share = told.verdict.note, told.verdict.share
    decided = [name for name, _, has in told.tree if has]
    worth = f"({share:.0%} of the points)"
    if note == "right":
        why = "the answer equals the right one, in one of its forms"
    elif told.carried_over:
        why = "the answer is what follows from the student's own earlier answer"
    elif note == "numbers_of_another_student":
        why = "the answer is right for the numbers of the id that was typed, not for the student's own"
    elif decided:
        why = f"the answer equals the right one with this done wrong: {' and '.join(decided)} {worth}"
    elif note == "malformed":
        why = "the answer does not have the form that is asked for"
    elif note in UNEXPLAINED:
        why = f"the answer is not right, and none of the {len(told.tree) - 1} mistakes with a name gives it: {note} {worth}"
    else:
        why = f"there was nothing to compare: {note}"
    if not whole:
        return why
    lines = [f"{'->' if has else '  '} {name} ({part:.0%})" for name, part, has in told.tree]
    return "\n".join([why, "tried in this order:", *lines])


def _calls(told: Account, with_answer: bool) -> str:
    wrong = [call for call in told.calls if not call.right]
    blocks = []
    for call in wrong[:_CALLS]:
        blocks.append(f"{call.case}: ({', '.join(call.arguments)})")
        blocks.append(f"    returned\n{textwrap.indent(call.returned, ' ' * 8)}")
        if with_answer:
            blocks.append(f"    expected\n{textwrap.indent(call.expected, ' ' * 8)}")
        blocks += [f"    {remark}" for remark in call.remarks]
    if len(wrong) > _CALLS:
        blocks.append(f"and {len(wrong) - _CALLS} more that were wrong")
    right = [call for call in told.calls if call.right]
    if right:
        blocks.append(f"right for {len(right)}, for example ({', '.join(right[0].arguments)})")
    return "\n".join(blocks)
