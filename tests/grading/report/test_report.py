"""The class report: what each question tells, the next misconception to name, and a page in which nothing acts."""

import csv
import re
import shutil
from math import sqrt

import nbformat
import pytest
import sympy
from bs4 import BeautifulSoup

from autograder import cli
from autograder.grading.course import convert, open_course
from autograder.grading.errors import CourseError
from autograder.grading.plugins.autograde import SubmissionAutograde
from autograder.grading.report.page import as_html, tables, write_report
from autograder.grading.report.statistics import ClassReport, _question_report, class_report, discrimination
from autograder.grading.submission.execution import Execution
from autograder.grading.submission.reading import fingerprint
from autograder.judge import Evidence
from autograder.judge.written import written
from dhkit import wire

pytestmark = pytest.mark.slow

t1, t2, t4, a2, a3, d2 = sympy.symbols("t1 t2 t4 a2 a3 d2")
NAMES = ("T04", "d2_sign", "forward")
BLANK = {"blank": True}
HOSTILE = "=<img src=x onerror=alert(1)>"
SCRIPT = "</pre><script>alert('student')</script>\x1b[2J"


def hand(x, sign=-1):
    """0T4 with another x."""
    c, s = sympy.cos(t1 + t2 + t4), sympy.sin(t1 + t2 + t4)
    y = a2 * sympy.sin(t1) + a3 * sympy.sin(t1 + t2)
    return sympy.Matrix([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, sign * d2], [0, 0, 0, 1]])


RIGHT = hand(a2 * sympy.cos(t1) + a3 * sympy.cos(t1 + t2))
# What no slip explains.
LEANING = hand(a2 * sympy.cos(t1) - a3 * sympy.cos(t1 + t2) / 3)
# The same wrong answer, expanded by hand.
ALSO_LEANING = hand(a2 * sympy.cos(t1) - a3 * (sympy.cos(t1) * sympy.cos(t2) - sympy.sin(t1) * sympy.sin(t2)) / 3)
SHORT = hand(a2 * sympy.cos(t1) / 5)
CLASS = {
    "ann": (RIGHT, "B", BLANK),
    "ben": (LEANING, "B", BLANK),
    "cem": (ALSO_LEANING, "C", BLANK),
    "dot": (SHORT, "C", BLANK),
    "eva": (hand(RIGHT[0, 3], sign=1), "B", BLANK),
    "fay": (BLANK, SCRIPT, BLANK),
    HOSTILE: ({"dict": [[SCRIPT, 1]]}, "C", BLANK),
}


def grade(root, answers):
    """Grade a class as if these answers had come out of the sandbox: evidence is all that the judge sees."""
    course = open_course(root)
    course.choose("scara")
    released = root / "exercises/scara/scara.ipynb"
    executions = {}
    for student, values in answers.items():
        folder = root / "submitted" / student / "scara"
        folder.mkdir(parents=True)
        evidence = {
            f"scara-{name}": Evidence(
                wire.packet(f"scara.{name}", answer=value if isinstance(value, dict) else wire.encode(value))
            )
            for name, value in zip(NAMES, values, strict=True)
        }
        (folder / "scara.ipynb").write_bytes(released.read_bytes())
        executions[student, "scara"] = Execution(fingerprint(folder, released.read_bytes()), {}, evidence)
    if answers:
        convert(
            # Named one by one: no folder of such a name is taken for a student's, but a gradebook may hold one.
            SubmissionAutograde(
                coursedir=course.app.coursedir,
                parent=course.app,
                students=tuple(answers),
                executions=executions,
                force=True,
            )
        )
    return course


@pytest.fixture(scope="module")
def course(empty_course, tmp_path_factory):
    root = tmp_path_factory.mktemp("report") / "course"
    shutil.copytree(empty_course, root)
    return grade(root, CLASS)


@pytest.fixture(scope="module")
def report(course):
    return class_report(course, "scara")


@pytest.fixture(scope="module")
def page(report):
    return as_html(report)


@pytest.mark.parametrize(
    "scores, rests, expected",
    [
        ([0, 1, 2, 3, 4], [10, 12, 14, 16, 18], 1),
        ([4, 3, 2, 1, 0], [10, 12, 14, 16, 18], -1),
        # All or nothing: point-biserial, (4 - 1.5) / sqrt(2) * sqrt(3/5 * 2/5).
        ([0, 0, 1, 1, 1], [1, 2, 3, 4, 5], sqrt(3) / 2),
        ([1, 0, 1, 0, 1, 0], [1, 1, 2, 2, 3, 3], 0),
        ([2, 2, 2, 2, 2], [1, 2, 3, 4, 5], None),
        ([1, 2, 3, 4, 5], [0.3, 0.1 + 0.2, 0.3, 0.3, 0.3], None),
        ([0, 1, 2, 3], [0, 1, 2, 3], None),
        ([1], [1], None),
    ],
)
def test_discrimination_has_its_known_values(scores, rests, expected):
    assert discrimination(scores, rests) == (None if expected is None else pytest.approx(expected, abs=1e-12))


def test_each_question_is_summed_up_over_the_class(report):
    first, second, third = report.questions
    assert [question.question for question in report.questions] == ["scara.T04", "scara.d2_sign", "scara.forward"]
    assert report.max_score == 20 and sorted(report.totals)[-1] == 14 and len(report.totals) == 7
    assert first.notes == {"right": 1, "partly_right": 3, "sign_of_d2": 1, "not_attempted": 1, "malformed": 1}
    assert second.notes == {"right": 3, "nothing_matched": 3, "malformed": 1}
    assert (first.full, first.not_attempted, first.unexplained) == (1 / 7, 1 / 7, 4)
    assert second.mean == pytest.approx(12 / 7) and second.median == 0
    assert first.discrimination == pytest.approx(second.discrimination) and first.discrimination > 0.2
    assert third.discrimination is None and third.discrimination_in_words().startswith("no spread")
    assert first.look_at and second.look_at and not third.look_at


def test_files_without_any_answer_do_not_decide_what_a_question_tells():
    def row(*scores):
        return {name: (score, "right" if score else "nothing_matched") for name, score in zip(NAMES, scores)}

    answered = {
        str(n): row(*scores)
        for n, scores in enumerate([(1, 0, 1), (0, 1, 0), (1, 1, 0), (0, 0, 1), (1, 0, 0), (0, 1, 1)])
    }
    nothing = {
        f"x{n}": dict.fromkeys(NAMES, (0.0, note))
        for n, note in enumerate(["unreadable", "not_attempted", "no_answer"] * 3)
    }
    alone = _question_report("T04", 1.0, answered, [])
    both = _question_report("T04", 1.0, answered | nothing, [])
    assert both.discrimination == alone.discrimination < 0 and (both.answered, both.submissions) == (6, 15)
    assert (both.mean, both.median, both.full) == (alone.mean, alone.median, alone.full)
    assert both.notes == alone.notes, "an unreadable file has no note that tells something of the question"


def test_equivalent_wrong_answers_stand_together(report):
    first, second, third = report.questions
    assert [(cluster.students, cluster.alike) for cluster in first.clusters] == [
        (("ben", "cem"), True),
        (("dot",), True),
        ((HOSTILE,), False),
    ]
    assert (
        "Only one cell differs: row 1, column 4" in first.clusters[0].feedback
        and "**" not in first.clusters[0].feedback
    )
    assert (
        written(first.clusters[0].attempts[0].answer.value).splitlines()[0].endswith("a2*cos(t1) - a3*cos(t1 + t2)/3]")
    )
    assert [cluster.students for cluster in second.clusters] == [(HOSTILE, "cem", "dot"), ("fay",)]
    assert written(second.right.value) == '"B"' and third.right is None and not third.clusters


def test_only_unexplained_answers_stay_in_the_graded_notebook(course):
    for student, expected in {
        "ann": [],
        "ben": ["scara-T04"],
        "eva": [],
        "cem": ["scara-T04", "scara-d2_sign"],
    }.items():
        nb = nbformat.read(course.step("autograded", student, "scara") / "scara.ipynb", as_version=4)
        marked = [cell for cell in nb.cells if "answer" in cell.metadata.get("autograder", {})]
        assert [cell.metadata.nbgrader["grade_id"] for cell in marked] == expected
        assert all(isinstance(cell.metadata["autograder"]["answer"], str) for cell in marked)


def test_what_a_student_wrote_is_inert(page):
    tree = BeautifulSoup(page, "html.parser")
    assert not tree.find_all(["script", "svg", "iframe", "object", "embed", "form", "link", "base"])
    for tag in tree.find_all(True):
        assert not [name for name in tag.attrs if name.startswith("on")]
        assert tag.get("src", "data:image/svg+xml;base64,").startswith("data:image/svg+xml;base64,")
        assert tag.get("href", "#").startswith("#")
    assert len(tree.find_all("img")) == 4 and not re.search(r"https?://", page) and "\x1b" not in page
    text = tree.get_text()
    assert HOSTILE in text and "</pre><script>alert('student')</script>" in text
    assert "default-src 'none'" in tree.head.find("meta", attrs={"http-equiv": True})["content"]


def test_the_page_shows_each_cluster_with_size_students_words_and_answer(page):
    text = " ".join(BeautifulSoup(page, "html.parser").get_text().split())
    assert "2 alike: ben, cem Partly right. Only one cell differs: row 1, column 4" in text
    assert "7 submissions, mean" in text and "4 unexplained wrong answers look at" in text
    assert "Discrimination: no spread" in text


def test_the_tables_hold_the_same_and_no_formula(report, tmp_path):
    write_report(report, tmp_path / "a/b")
    rows = {name: list(csv.DictReader((tmp_path / "a/b" / name).open(encoding="utf-8"))) for name in tables(report)}
    assert [row["question"] for row in rows["questions.csv"]] == ["scara.T04", "scara.d2_sign", "scara.forward"]
    assert {row["note"]: row["count"] for row in rows["notes.csv"] if row["question"] == "scara.forward"} == {
        "not_attempted": "7"
    }
    assert (rows["answers.csv"][0]["size"], rows["answers.csv"][0]["students"]) == ("2", "ben; cem")
    alone = next(row for row in rows["answers.csv"] if HOSTILE in row["students"])
    assert alone["students"] == f"'{HOSTILE}"


def test_the_command_prints_a_table_and_writes_into_the_course(course, capsys):
    assert cli.main(["report", "scara", "--course", str(course.root)]) == 0
    out = capsys.readouterr().out
    assert "4 unexplained, 2 alike" in out and "4 unexplained, 3 alike" in out
    assert "no spread" in out and f"report: {course.root}/build/reports/scara/report.html" in out
    folder = course.root / "build/reports/scara"
    assert {path.name for path in folder.iterdir()} == {"report.html", "questions.csv", "notes.csv", "answers.csv"}


def test_a_folder_that_is_a_file_is_refused(report, tmp_path):
    (tmp_path / "report").write_text("")
    with pytest.raises(CourseError, match="is not a folder"):
        write_report(report, tmp_path / "report")


def test_a_notebook_that_was_changed_or_lost_does_not_end_the_report(course_copy):
    course = grade(course_copy, {name: CLASS[name] for name in ("ben", "cem", "dot", "eva")})
    for student, text in {
        "ben": "[" * 5000,
        "dot": '{"format":1,"question":"scara.T04","answer":{"eval":"1"}}',
    }.items():
        path = course.step("autograded", student, "scara") / "scara.ipynb"
        nb = nbformat.read(path, as_version=4)
        next(cell for cell in nb.cells if "answer" in cell.metadata.get("autograder", {})).metadata["autograder"][
            "answer"
        ] = text
        nbformat.write(nb, path)
    (course.step("autograded", "cem", "scara") / "scara.ipynb").unlink()
    first = class_report(course, "scara").questions[0]
    assert first.unexplained == 3 and sum(cluster.size for cluster in first.clusters) == 2
    assert not any(cluster.alike for cluster in first.clusters)


def test_an_empty_class_is_said(course_copy, capsys):
    with pytest.raises(CourseError, match="nothing was graded for scara yet; run: autograder grade scara"):
        class_report(grade(course_copy, {}), "scara")
    assert not (course_copy / "build").exists()


def test_a_class_of_one(course_copy):
    report = class_report(grade(course_copy, {"ann": CLASS["ann"]}), "scara")
    assert isinstance(report, ClassReport) and report.totals == (14,)
    assert all(question.discrimination is None and not question.look_at for question in report.questions)
    text = " ".join(BeautifulSoup(as_html(report), "html.parser").get_text().split())
    assert (
        "1 submission, mean 14.0 of 20 points." in text and "too few submissions with answers (1; 5 are needed)" in text
    )
