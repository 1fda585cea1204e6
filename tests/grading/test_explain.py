"""A verdict is explained in words, a change of points is told, and what was typed by hand is kept and listed."""

import json
import re
import shutil

import nbformat
import pytest
from nbgrader.api import Gradebook

from autograder import cli
from autograder.grading.cells import check_cells, notebook_record, question_id
from autograder.grading.course import open_course
from autograder.grading.explain import as_page, as_text, explain
from autograder.grading.plugins.preprocessors import SandboxExecute
from autograder.grading.submission.execution import Execution
from autograder.judge import Evidence
from dhkit import wire

pytestmark = pytest.mark.slow

SCRIPT = "<script>alert('student')</script>"


@pytest.fixture(scope="module")
def root(without_kernels, small, empty_course, released, tmp_path_factory):
    """A course in which ann was graded: one right choice, one name that is not defined, a function without an answer."""
    root = tmp_path_factory.mktemp("explain") / "course"
    shutil.copytree(empty_course, root)
    small.hand_in(root, "ann", small.answered(released, T04=f"T04 = undefined  # {SCRIPT}", forward="forward = ..."))
    (root / "students.csv").write_text("id,last_name,first_name\nann,O'Ann,Anna\n")
    with without_kernels():
        assert cli.main(["grade", "scara", "--course", str(root)]) == 0
    return root


def told(course, without_kernels, question, with_answer=False):
    with without_kernels():
        found = explain(open_course(course), "ann", question)
    return as_text(found, with_answer), as_page(found, with_answer)


def test_a_right_answer(root, without_kernels):
    text, page = told(root, without_kernels, "scara.d2_sign")
    for said in (
        "ann: 4 of 4 points, right",
        "d2_sign = 'B'",
        'found:\n        "B"',
        "4 of 4 points",
        "equals the right one",
    ):
        assert said in text
    assert "<title>scara.d2_sign, ann</title>" in page


def test_a_member_is_found_in_the_team(root, without_kernels, tmp_path):
    course = shutil.copytree(root, tmp_path / "course")
    (course / "students.csv").write_text("id,last_name,first_name,groups\nbea,B,Bea,ann\n")
    (course / "downloaded/scara").mkdir(parents=True)
    (course / "downloaded/scara/collected.json").write_text('{"ann": {"platform": "moodle", "name": "ann"}}')
    with without_kernels():
        assert explain(open_course(course), "Bea B", "scara.d2_sign").student == "ann"


def test_an_answer_that_did_not_run(root, without_kernels):
    text, page = told(root, without_kernels, "scara.T04")
    for said in ("it did not run: NameError: undefined", "no answer was handed in", "Your code stopped with an error"):
        assert said in text and said in page
    assert "there was nothing to compare: error" in text
    assert "sign_of_d2" in text, "the lecturer sees which mistakes have a name"
    assert "sign_of_d2" not in page, "what is forwarded names no mistake that was not made"
    assert SCRIPT not in page and "&lt;script&gt;" in page


def test_a_file_that_cannot_be_read(root, without_kernels, small, tmp_path):
    shutil.copytree(root, tmp_path / "course")
    small.hand_in(tmp_path / "course", "cut", '{"cells": [')
    with without_kernels():
        found = explain(open_course(tmp_path / "course"), "cut", "scara.d2_sign")
    text = as_text(found, False)
    for said in (
        "(nothing that can be read)",
        "not valid JSON (line 1); it may have been cut off",
        "nothing to compare: ",
    ):
        assert said in text
    assert "\\" not in text


def test_the_right_answer_is_shown_on_request_only(root, without_kernels):
    text, page = told(root, without_kernels, "scara.T04")
    assert "a2*cos(t1)" not in text and "a2*cos(t1)" not in page
    text, page = told(root, without_kernels, "scara.T04", with_answer=True)
    assert "a2*cos(t1)" in text and "a2*cos(t1)" in page


def function_that_fails_for_some(self, nb, folder, released, student, course):
    probes = [[0.1 * n, 0.2, 0.3, 0.1, 0.4, 0.5] for n in range(1, 5)]
    from autograder import questions

    question = questions.find("scara.forward")
    results = [wire.encode(question.answer(student)(*args)) for args in probes]
    results[1][0][3] = 0.123
    results[2] = {"error": "ValueError: no such pose"}
    packet = wire.packet(question.id, answer={"function": "forward"})
    evidence = {check: Evidence(wire.packet(question_id(check), answer={"blank": True})) for check in check_cells(nb)}
    evidence["scara-forward"] = Evidence(packet, (probes, wire.packet(question.id, probes=results)))
    return Execution(notebook_record(nb).submission, {}, evidence)


def test_a_function_is_shown_where_it_failed_and_what_came_back(root, without_kernels):
    with without_kernels(), pytest.MonkeyPatch.context() as patch:
        patch.setattr(SandboxExecute, "run", function_that_fails_for_some)
        found = explain(open_course(root), "O'ANN anna", "scara.forward")
    text = as_text(found, False)
    assert "called 4 times; 2 times wrong" in text and "right for 2, for example (0.1, 0.2, 0.3, 0.1, 0.4, 0.5)" in text
    assert "(0.2, 0.2, 0.3, 0.1, 0.4, 0.5)" in text and "0.123" in text
    assert not re.search("^ +expected$", text, re.M)
    assert "an error: ValueError: no such pose" in text
    answer = as_text(found, True)
    assert len(re.findall("^ +expected$", answer, re.M)) == 2
    assert "the note there is not_attempted" in text, "the gradebook holds another verdict than would be reached now"


@pytest.mark.parametrize(
    "words, said",
    [
        (("bob", "scara.T04"), "'bob' handed in nothing for scara; handed in: ann"),
        (("ann", "scara.T05"), "there is no question 'scara.T05'; there are: scara.T04, scara.d2_sign, scara.forward"),
        (("ann", "sacra.T04"), "there is no exercise 'sacra'"),
    ],
)
def test_what_is_not_there_is_said(root, without_kernels, words, said, capsys):
    with without_kernels():
        assert cli.main(["explain", *words, "--course", str(root)]) == 2
    assert said in capsys.readouterr().err


def test_the_command_writes_a_page(root, without_kernels, tmp_path, capsys):
    with without_kernels():
        assert (
            cli.main(["explain", "ann", "scara.d2_sign", "--html", str(tmp_path / "a.html"), "--course", str(root)])
            == 0
        )
    assert "What decided" in capsys.readouterr().out and "What decided" in (tmp_path / "a.html").read_text()


@pytest.fixture
def marked(root, tmp_path):
    """The course, in which a lecturer gave 7 of 10 and a comment for T04 and 1.5 extra for the choice."""
    copy = tmp_path / "course"
    shutil.copytree(root, copy)
    with Gradebook(f"sqlite:///{copy}/gradebook.db") as gradebook:
        gradebook.find_grade("scara-T04", "scara", "scara", "ann").manual_score = 7
        gradebook.find_comment("scara-T04-answer", "scara", "scara", "ann").manual_comment = "good idea"
        gradebook.find_grade("scara-d2_sign", "scara", "scara", "ann").extra_credit = 1.5
        gradebook.db.commit()
    return copy


def graded_again(root, without_kernels, capsys, *more):
    with without_kernels():
        assert cli.main(["grade", "scara", "--course", str(root), *more]) == 0
    return capsys.readouterr().out


def test_what_was_typed_by_hand_is_kept_and_listed(marked, without_kernels, capsys):
    (line,) = map(json.loads, graded_again(marked, without_kernels, capsys, "--force", "--json").splitlines())
    assert line["score"] == 7 + 4 + 1.5 and line["moved"] == []
    assert line["by_hand"] == ["T04: 7 of 10, a comment", "d2_sign: 1.5 extra"]


def test_who_hands_in_anew_is_listed_with_what_moved(marked, small, released, without_kernels, capsys):
    small.hand_in(marked, "ann", small.answered(released, T04="T04 = undefined", d2_sign="d2_sign = 'A'"))
    said = graded_again(marked, without_kernels, capsys)
    assert re.search(r"ann .*d2_sign: 4 -> 0 \(right -> nothing_matched\)", said) and "T04: 7 of 10" in said
    said = graded_again(marked, without_kernels, capsys)
    assert "moved" not in said and "by hand" not in said


def test_other_points_are_told_and_what_was_typed_by_hand_is_to_be_looked_at(marked, small, without_kernels, capsys):
    path = marked / "solutions/scara/scara.ipynb"
    nb = nbformat.read(path, as_version=4)
    small.cell(nb, "scara-T04").metadata.nbgrader.points = 5
    small.cell(nb, "scara-d2_sign").metadata.nbgrader.points = 8
    nbformat.write(nb, path)
    assert cli.main(["release", "scara", "--course", str(marked)]) == 0
    (line,) = map(json.loads, graded_again(marked, without_kernels, capsys, "--json").splitlines()[-1:])
    assert line["moved"] == ["d2_sign: 4 -> 8 (4 -> 8 points)"]
    assert line["by_hand"] == ["T04: 7 of 5, a comment; LOOK AGAIN: it was 10 points, now 5",
                               "d2_sign: 1.5 extra; LOOK AGAIN: it was 4 points, now 8"]  # fmt: skip
