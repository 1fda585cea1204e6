"""Frames of tables: what a statement fixes is pinned, what it leaves free is right in every choice."""

import pytest
import sympy
from answers import right, verdict

from autograder.questions import exercises, find

TABLES = [q for qs in exercises().values() for q in qs if q.form.kind == "dh_table"]
# Which senses a statement tells: "every Z_i points ..." and "X_i points ...", or only that the product must be the same.
FIXED = {
    "scara.table": "Z", "tables.arm": "ZX", "direct_models.table": "Z",
    "parameters.flip": "ZX", "transforms.convert": "", "tables.wrist": "", "pen_robot.table": "",
}  # fmt: skip


def turned_over(rows, i, axis):
    """The same chain with Z_i, or X_i, the other way (rows from 0)."""
    rows, (sigma, a, alpha, d, theta), (after, b, beta, e, phi) = [list(row) for row in rows], rows[i], rows[i + 1]
    if axis == "Z":
        rows[i], rows[i + 1] = [sigma, a, alpha + sympy.pi, -d, -theta], [after, b, beta + sympy.pi, e, phi]
    else:
        rows[i], rows[i + 1] = [sigma, a, alpha, d, theta + sympy.pi], [after, -b, -beta, e, phi + sympy.pi]
    return rows


@pytest.mark.slow
@pytest.mark.parametrize("axis", ["Z", "X"])
@pytest.mark.parametrize("question", TABLES, ids=lambda question: question.id)
def test_an_axis_turned_over_is_right_where_the_statement_leaves_it_free(question, axis):
    for i in range(question.form.shape[0] - 1):
        found = verdict(question, turned_over(sympy.Matrix(right(question)).tolist(), i, axis))
        if axis in FIXED.get(question.id, ""):
            assert (found.note, found.share) == ("same_chain_other_frames", question.partial), (i, found)
            assert f"another sense of {axis}{i + 1}" in found.feedback
        else:
            assert found.note == "right" and f"another sense of {axis}{i + 1}" in found.feedback, (i, found)


@pytest.mark.parametrize("id", ["planar_2r.table", "transforms.convert", "pen_robot.table"])
def test_a_row_without_a_joint_does_not_slide(id):
    rows = sympy.Matrix(right(find(id))).tolist()
    found = verdict(find(id), [*rows[:-1], [1, *rows[-1][1:]]])
    assert found.share < 1 and f"row {len(rows)}" in found.feedback.lower() and "sigma" in found.feedback
