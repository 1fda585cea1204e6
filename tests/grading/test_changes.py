"""Whose points moved when a class is graded again, and what was typed by hand: nothing moves unseen."""

import json
import shutil

import nbformat
import pytest
from nbgrader.api import Gradebook

from autograder import cli
from autograder.grading.cells import FOR_EVERYBODY
from autograder.grading.changes import Given, by_hand, moved
from autograder.grading.store import Mark, StoredComment, StoredGrade, StoredNotebook


def stored(penalty=0.0, **scores):
    """A notebook with automatic points, or (automatic, by hand, extra, the most), and a note for each question."""
    found = StoredNotebook("1", penalty, mark=Mark())
    for name, (score, note) in scores.items():
        auto, manual, extra, most = score if isinstance(score, tuple) else (score, None, None, 4)
        found.grades[f"scara-{name}"] = StoredGrade(auto, manual, extra, most, "code")
        found.comments[f"scara-{name}-answer"] = StoredComment(f"note: {note}", None)
    return {"scara": found}


BEFORE = {"scara-T04": Given(4, 2, "sign_of_d2"), "scara-U1": Given(4, 4, "right")}


@pytest.mark.parametrize(
    "now, everybody, said",
    [
        (stored(T04=(2, "sign_of_d2"), U1=(4, "right")), (), ()),
        (stored(T04=(4, "right"), U1=(4, "right")), (), ("T04: 2 -> 4 (sign_of_d2 -> right)",)),
        (stored(T04=(3, "sign_of_d2"), U1=(4, "right")), (), ("T04: 2 -> 3 (sign_of_d2, which counts otherwise now)",)),
        (stored(T04=(4, "sign_of_d2"), U1=(4, "right")), ("scara-T04",), ("T04: 2 -> 4 (full points for everybody)",)),
        (stored(T04=((3, None, None, 6), "sign_of_d2"), U1=(4, "right")), (), ("T04: 2 -> 3 (4 -> 6 points)",)),
        (stored(T04=(2, "sign_of_d2")), (), ("U1: 4 -> no longer asked",)),
        (stored(T04=(2, "sign_of_d2"), U1=(4, "right"), dhm=(0, "error")), (), ("dhm: new, 0 of 4 (error)",)),
        (stored(1.5, T04=(2, "sign_of_d2"), U1=(4, "right")), (), ("points off for being late: 0 -> 1.5",)),
    ],
)  # fmt: skip
def test_whatever_moved_is_told_with_its_reason(now, everybody, said):
    # The gradebook follows a release at once: what is no longer asked has gone from it before anything is graded again.
    before = stored(T04=(2, "sign_of_d2"), U1=(4, "right"))
    before["scara"].grades = {
        check: grade for check, grade in before["scara"].grades.items() if check in now["scara"].grades
    }
    assert moved(before, now, BEFORE, everybody) == said


def test_who_was_not_graded_before_has_nothing_that_moved():
    before = stored(T04=(None, ""))
    before["scara"].mark = None
    assert moved(before, stored(T04=(2, "sign_of_d2")), {}, ()) == moved({}, stored(T04=(2, "right")), {}, ()) == ()


@pytest.mark.parametrize(
    "grade, note, said",
    [
        ((2, 3, None, 4), "sign_of_d2", ("T04: 3 of 4",)),
        ((2, None, 1.5, 4), "sign_of_d2", ("T04: 1.5 extra",)),
        ((3, 3, None, 6), "sign_of_d2", ("T04: 3 of 6; LOOK AGAIN: it was 4 points, now 6; LOOK AGAIN: the judge gave 2, now 3",)),
        ((4, 3, None, 4), "right", ("T04: 3 of 4; LOOK AGAIN: the judge gave 2, now 4",)),
        ((2, None, None, 4), "sign_of_d2", ()),
    ],
)  # fmt: skip
def test_what_was_typed_by_hand_is_told_and_flagged_where_it_may_not_fit(grade, note, said):
    assert by_hand(stored(T04=(2, "sign_of_d2")), stored(T04=(grade, note)), BEFORE) == said


@pytest.mark.slow
def test_grading_after_a_change_of_questions_lists_it_all(
    without_kernels, small, empty_course, released, tmp_path, capsys
):
    root = shutil.copytree(empty_course, tmp_path / "course")
    small.hand_in(root, "ann", small.answered(released))

    def run(*words):
        with without_kernels():
            assert cli.main([*words, "--course", str(root)]) == 0
        return capsys.readouterr().out

    assert "moved" not in run("grade", "scara")
    with Gradebook(f"sqlite:///{root}/gradebook.db") as gradebook:
        gradebook.find_grade("scara-T04", "scara", "scara", "ann").manual_score = 7
        gradebook.find_comment("scara-T04-answer", "scara", "scara", "ann").manual_comment = "Well drawn."
        gradebook.db.commit()
    path = root / "solutions/scara/scara.ipynb"
    nb = nbformat.read(path, as_version=4)
    nb.cells = [cell for cell in nb.cells if not cell.id.startswith("scara-d2_sign")]
    small.cell(nb, "scara-T04").metadata.nbgrader.points = 12
    small.cell(nb, "scara-forward").metadata[FOR_EVERYBODY] = True
    nbformat.write(nb, path)
    run("release", "scara", "--home", "form", "--yes")
    (line,) = (json.loads(line) for line in run("grade", "scara", "--json").splitlines())
    assert line["moved"] == ["d2_sign: 4 -> no longer asked", "forward: 0 -> 6 (full points for everybody)"]
    assert line["by_hand"] == ["T04: 7 of 12, a comment; LOOK AGAIN: it was 10 points, now 12"]
    assert line["score"] == 13
