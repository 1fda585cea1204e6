"""Names are right or missing: mistakes that were once given the name of another one, and slips that any question may meet."""

import pytest
import sympy
from answers import STUDENT, right, verdict

from autograder.questions import exercises, find

psi, theta, phi = sympy.symbols("psi theta phi")


def at(table, row, column, value):
    rows = [list(each) for each in table]
    rows[row - 1][column] = value(rows[row - 1][column]) if callable(value) else value
    return rows


# What was handed in, which note it must not get again, and words that must be said.
ONCE_MISNAMED = {
    "sign in Rot_y": (
        "orientation.rpy_entries",
        lambda found: [sympy.sympify(entry).subs(theta, -theta) for entry in found],
        "sign_of_yaw",
        "pitch or the yaw",
    ),
    "the back forgotten on the limit": (
        "inverse_models.counts",
        lambda found: [*found[:2], 1, *found[3:]],
        "limit_counted_twice",
        "over the back",
    ),
    "sign of t5": (
        "tables.wrist",
        lambda rows: at(rows, 2, 4, lambda cell: -cell),
        "sign_of_alpha",
        "row 2, column theta",
    ),
    "theta1 negated": ("planar_2r.theta1", lambda angle: -angle, "atan2_arguments_exchanged", "One of these"),
    "rot_axis": (
        "orientation.zxz",
        lambda _: sympy.rot_axis3(psi) * sympy.rot_axis1(theta) * sympy.rot_axis3(phi),
        "extrinsic_for_intrinsic+transposed_rotation",
        "rot_axis",
    ),
}


@pytest.mark.parametrize("what", ONCE_MISNAMED)
def test_no_mistake_gets_the_name_of_another(what):
    id, change, note, words = ONCE_MISNAMED[what]
    found = verdict(find(id), change(right(find(id))))
    assert found.note != note and words in found.feedback, found


def test_what_does_not_fail_is_not_said_to_fail():
    for id in ("planar_2r.inverse", "inverse_models.rx90"):
        question = find(id)
        inverse = question.answer(STUDENT)
        found = verdict(question, lambda *args, f=inverse: f(*args) or [(None, None)])
        assert "does not return an empty list" in found.feedback and "fails" not in found.feedback


NAMED = [q for qs in exercises().values() for q in qs if q.form.kind == "vector" and q.form.names and q.places]


@pytest.mark.parametrize("question", NAMED, ids=lambda question: question.id)
def test_names_of_entries_keep_their_letters(question):
    """x is not X, and a is not A."""
    for k, name in enumerate(question.form.names):
        answer = [sympy.sympify(entry) for entry in right(question)]
        answer[k] = answer[k] + sympy.Rational(37, 100)
        found = verdict(question, answer)
        assert found.share < 1 and name in found.feedback, found
        assert f"**{name[0].upper()}{name[1:]}" not in found.feedback or name[0].isupper()
