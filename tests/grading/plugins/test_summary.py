"""The table at the top of a feedback page."""

from nbformat.v4 import new_code_cell, new_output

from autograder.grading.plugins.preprocessors import _summary


def test_both_of_two_mistakes_are_told():
    feedback = "**The first one.** See the table.\n\n**The second one.** See the drawing."
    marks = {"grade_id": "scara-T04", "score": 1.0, "points": 3}
    shown = new_output("display_data", data={"text/markdown": feedback, "text/plain": feedback})
    row = _summary(
        new_code_cell(metadata={"nbgrader": marks, "autograder": {"note": "a+b", "share": 0.5}}, outputs=[shown])
    )
    assert row["line"] == "**The first one.** See the table. **The second one.** See the drawing."
    assert (row["title"], row["note"]) == ("From the base to the hand, 0T4", "a+b")
