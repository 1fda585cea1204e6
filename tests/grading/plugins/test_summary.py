"""The table at the top of a feedback page."""

from nbformat.v4 import new_code_cell, new_notebook, new_output

from autograder.grading.plugins.preprocessors import Summarize, _summary
from autograder.grading.store import StoredComment, StoredGrade, StoredNotebook


def test_both_of_two_mistakes_are_told():
    feedback = "**The first one.** See the table.\n\n**The second one.** See the drawing."
    marks = {"grade_id": "scara-T04", "score": 1.0, "points": 3}
    shown = new_output("display_data", data={"text/markdown": feedback, "text/plain": feedback})
    row = _summary(
        new_code_cell(metadata={"nbgrader": marks, "autograder": {"note": "a+b", "share": 0.5}}, outputs=[shown]),
        StoredNotebook("1", 0.0),
    )
    assert row["line"] == "**The first one.** See the table. **The second one.** See the drawing."
    assert (row["title"], row["note"], row["percent"]) == ("The SCARA of the lecture, 0T4", "a+b", 33)


def cell(name, **marks):
    return new_code_cell(metadata={"nbgrader": {"grade_id": name, "schema_version": 3, **marks}})


def rows(*, manual=None, extra=None, comment=None):
    """The table of a question of 3 points, for which the judge gave 2, and of an open problem."""
    nb = new_notebook(
        cells=[
            cell("scara-T04-answer", solution=True),
            cell("scara-T04", grade=True, points=3),
            cell("scara-open", grade=True, solution=True, points=0),
        ]
    )
    stored = StoredNotebook("1", 0.0)
    stored.grades = {
        "scara-T04": StoredGrade(2, manual, None, 3, "code"),
        "scara-open": StoredGrade(0, None, extra, 0, "markdown"),
    }
    stored.comments = {name: StoredComment(None, comment) for name in ("scara-T04-answer", "scara-open")}
    _, resources = Summarize().preprocess(nb, {"stored": stored, "nbgrader": {}})
    return [(row["title"], row["score"], row["line"]) for row in resources["autograder"]["questions"]]


def test_the_table_adds_up_with_a_bonus_and_says_what_was_given_by_hand():
    title = "The SCARA of the lecture, 0T4"
    assert rows() == [(title, 2, "")]
    assert rows(manual=1.5) == [(title, 1.5, "*These points were given by hand.*")]
    assert rows(extra=1.5) == [(title, 2, ""), ("Open problem (bonus)", 1.5, "")]
    assert rows(comment="Well *drawn*.\nSee me.") == [
        (title, 2, "**Comment:** Well *drawn*. See me."), ("Open problem (bonus)", 0, "**Comment:** Well *drawn*. See me."),
    ]  # fmt: skip
