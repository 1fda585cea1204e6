"""The catalogue of misconceptions: wrong steps that students really take, each ready to stand in a response tree.

Every function here returns a `Mistake`: its note, its share of the points, its feedback, and the steps that turn a right
answer into the mistaken one. A question lists those that fit it; ``share``, ``feedback`` and ``note`` can be given where
the question has better words::

    mistakes=(sign_of("alpha", 3), classic_table(), columns_exchanged("a", "d", share=0.2))

Answers that steps work on: a DH table is a list of rows ``[sigma, a, alpha, d, theta]``, rows counted from 1 as on the
slides; a transform is a SymPy matrix; joint solutions are a list of rows. Of a probed question they work on what the
function returns. Mistakes that are made on the way to an answer take the keywords with which the reference makes them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import sympy

from dhkit.forms.dh_table import DH_COLUMNS
from dhm.transforms import classic_dh

from .question import Mistake, Step, Wrong, mistake
from .steps import change_rows, substitute

Rows = list[list]


def _entry(
    note: str,
    share: float,
    feedback: str,
    /,
    *steps: Step,
    turn: float = 2 * np.pi,
    wrong: Wrong | Sequence[Wrong] = (),
    **other,
) -> Mistake:
    """A `Mistake` of the catalogue; `other` replaces its note, share or feedback, `wrong` the steps it is made in."""
    return replace(mistake(note, share, feedback, *(() if wrong else steps), wrong=wrong, turn=turn), **other)


# ---------------------------------------------------------------- tables


def _each_and_all(column: str, change: Callable, rows: Sequence[int]) -> list[Step]:
    """One step for every row, and one for all of them together."""
    steps = [change_rows(column, change, row) for row in rows]
    return steps if len(rows) == 1 else [*steps, change_rows(column, change, *rows)]


def classic_table(last: Sequence = (0, 0), **other) -> Mistake:
    """a and alpha stand one row too early: the classic table. `last` is (a, alpha) of its last row."""

    def classic(rows):
        links = [tuple(row[1:3]) for row in rows[1:]] + [tuple(last)]
        return [[row[0], *link, *row[3:]] for row, link in zip(rows, links, strict=True)]

    return _entry(
        "classic_table",
        0.3,
        "**This is the classic Denavit-Hartenberg table.** In the modified form (Khalil-Kleinfinger) row i holds a and "
        "alpha of the link *before* joint i. See the slide that compares the two conventions.",
        classic,
        **other,
    )


def rows_shifted(**other) -> Mistake:
    """Every row stands one place too high or too low; the row that is left over comes at the other end, or an empty one."""
    return _entry(
        "rows_shifted",
        0.3,
        "**The rows are shifted by one.** Row i leads from frame i-1 to frame i. Check row 1: what lies between the base "
        "and joint 1?",
        lambda rows: [*rows[1:], rows[0]],
        lambda rows: [rows[-1], *rows[:-1]],
        lambda rows: [*rows[1:], [0, 0, 0, 0, 0]],
        lambda rows: [[0, 0, 0, 0, 0], *rows[:-1]],
        **other,
    )


def columns_exchanged(first: str, second: str, **other) -> Mistake:
    """Two columns stand under each other's header."""
    reasons = {
        frozenset({"a", "d"}): "a is counted along X, from one joint axis to the next; d along Z.",
        frozenset({"a", "alpha"}): "Some slides print alpha first; the question asks for sigma, a, alpha, d, theta.",
        frozenset({"alpha", "theta"}): "alpha turns about X, from one joint axis to the next; theta about Z.",
    }
    i, j = DH_COLUMNS.index(first), DH_COLUMNS.index(second)

    def exchanged(rows):
        order = [j if k == i else i if k == j else k for k in range(len(DH_COLUMNS))]
        return [[row[k] for k in order] for row in rows]

    return _entry(
        f"{first}_and_{second}_exchanged",
        0.3,
        f"**The columns {first} and {second} are exchanged.** {reasons.get(frozenset({first, second}), '')}".rstrip(),
        exchanged,
        **other,
    )


def sign_of(column: str, *rows: int, **other) -> Mistake:
    """The sign of a, alpha or d is turned in one of `rows`, or in all of them."""
    how = {
        "a": "a is positive where X_(i-1) points from Z_(i-1) towards Z_i.",
        "alpha": "alpha turns Z_(i-1) onto Z_i about X_(i-1), by the right-hand rule: thumb along X, which way do the fingers go?",
        "d": "d is positive where Z_i points from X_(i-1) towards X_i.",
    }
    return _entry(
        f"sign_of_{column}",
        0.6,
        f"**A sign is turned in column {column}.** {how[column]}",
        *_each_and_all(column, lambda cell: -cell, rows),
        **other,
    )


def _constant(cell) -> sympy.Expr:
    cell = sympy.sympify(cell)
    return cell.subs(dict.fromkeys(cell.free_symbols, 0))


def offset_missing(*rows: int, **other) -> Mistake:
    """The constant beside a joint variable is left out: theta is t2 where it should be t2 plus a quarter turn."""
    return _entry(
        "joint_offset_missing",
        0.6,
        "**A joint offset is missing.** At q = 0 the frames of your table do not stand as in the drawing: in which row "
        "does X_(i-1) have to turn before the joint has moved at all?",
        *_each_and_all("theta", lambda cell: cell - _constant(cell), rows),
        **other,
    )


def tool_left_out(**other) -> Mistake:
    """The last row, which carries the origin to the tool, is all zeros."""
    return _entry(
        "tool_left_out",
        0.5,
        "**The tool length is missing.** The last row must bring the origin from the last joint to the hand.",
        lambda rows: [*rows[:-1], [0, 0, 0, 0, 0]],
        **other,
    )


def revolute_everywhere(**other) -> Mistake:
    """sigma = 0 in every row: the prismatic joint is taken for a revolute one."""
    return _entry(
        "sigma_all_revolute",
        0.7,
        "**One joint slides, and sigma must say so.** Look at what its motor changes: an angle or a distance?",
        lambda rows: [[0, *row[1:]] for row in rows],
        **other,
    )


def degrees_in_table(**other) -> Mistake:
    """Constant angles of the table are written in degrees."""

    def in_degrees(rows):
        turned = [[*row[:2], _constant_in_degrees(row[2]), row[3], _constant_in_degrees(row[4])] for row in rows]
        return turned

    return _entry(
        "degrees",
        0.6,
        "**Angles of your table are in degrees.** The question counts in radians: a quarter turn is pi/2.",
        in_degrees,
        **other,
    )


def _constant_in_degrees(cell) -> sympy.Expr:
    return sympy.sympify(cell) + _constant(cell) * (180 / sympy.pi - 1)


# ---------------------------------------------------------------- transforms


def product(transforms: Sequence[sympy.Matrix]) -> sympy.Matrix:
    """The plain product of transforms, left to right."""
    result = sympy.eye(len(transforms[0].row(0)))
    for transform in transforms:
        result = result * transform
    return result


def classic_matrix(*rows: Sequence, **other) -> Mistake:
    """The matrix of classic DH for rows (a, alpha, d, theta); of several rows, the product."""
    return _entry(
        "classic_matrix",
        0.3,
        "**This is the matrix of classic Denavit-Hartenberg.** The modified form begins with the step along and about "
        "X, and ends with the step along and about Z. See the slide that compares the two conventions.",
        lambda _: product([classic_dh(*row) for row in rows]),
        **other,
    )


def reversed_product(*transforms: sympy.Matrix, **other) -> Mistake:
    """The factors are multiplied last first."""
    return _entry(
        "reversed_product",
        0.3,
        "**The matrices are multiplied in the reverse order.** From left to right: base first, hand last.",
        lambda _: product(transforms[::-1]),
        **other,
    )


def one_factor_missing(*products: sympy.Matrix, **other) -> Mistake:
    """A factor is left out at one end: each of `products` is such a shorter product."""
    return _entry(
        "one_step_short",
        0.4,
        "**One step of the chain is missing.** Count the matrices: every frame between the two ends takes one.",
        *(lambda _, shorter=shorter: shorter for shorter in products),
        **other,
    )


def _blocks(transform: sympy.Matrix) -> tuple[sympy.Matrix, sympy.Matrix]:
    transform = sympy.Matrix(transform)
    return transform[:-1, :-1], transform[:-1, -1]


def _assembled(rotation: sympy.Matrix, position: sympy.Matrix) -> sympy.Matrix:
    last = sympy.Matrix([[0] * rotation.cols + [1]])
    return rotation.row_join(position).col_join(last)


def transposed_rotation(**other) -> Mistake:
    """The rotation block is transposed, the position kept; a bare rotation matrix is transposed."""

    def transposed(transform):
        transform = sympy.Matrix(transform)
        if transform.rows == 3:
            return transform.T
        rotation, position = _blocks(transform)
        return _assembled(rotation.T, position)

    return _entry(
        "transposed_rotation",
        0.4,
        "**The rotation block is transposed.** Its columns, not its rows, are the axes of the new frame.",
        transposed,
        **other,
    )


def inverse_by_transposing(**other) -> Mistake:
    """The inverse of a transform is taken by transposing the whole 4x4."""

    def whole_transposed(inverse):
        rotation, position = _blocks(inverse)
        return _assembled(rotation.T, -rotation.T * position).T

    return _entry(
        "inverse_by_transposing",
        0.3,
        "**The whole 4x4 was transposed.** Only the rotation block is inverted by transposing; look at the last row of "
        "your result.",
        whole_transposed,
        **other,
    )


def inverse_keeps_position(**other) -> Mistake:
    """The inverse of a transform has the position -P, or P, instead of -R^T P."""

    def position_of(inverse, sign):
        rotation, position = _blocks(inverse)
        return _assembled(rotation, sign * rotation.T * position)

    return _entry(
        "inverse_with_unturned_position",
        0.5,
        "**The position of the inverse is not turned.** The inverse tells where the old origin lies, seen along the *new* "
        "axes. Multiply your result by the transform: is it the identity?",
        lambda inverse: position_of(inverse, 1),
        lambda inverse: position_of(inverse, -1),
        **other,
    )


# ---------------------------------------------------------------- expressions and models


def symbol_negated(symbol: sympy.Symbol, note: str, feedback: str, share: float = 0.6) -> Mistake:
    """A symbol with the wrong sense: everything is as if it were counted the other way."""
    return mistake(note, share, feedback, substitute({symbol: -symbol}))


def symbols_exchanged(
    first: sympy.Symbol, second: sympy.Symbol, note: str, feedback: str, share: float = 0.5
) -> Mistake:
    """Two symbols stand in each other's place."""
    return mistake(note, share, feedback, substitute({first: second, second: first}))


def angles_subtracted(*angles: sympy.Symbol, **other) -> Mistake:
    """theta1 - theta2 for theta1 + theta2: one of `angles` enters with the wrong sign."""
    return _entry(
        "angles_subtracted",
        0.4,
        "**Joint angles are subtracted.** The joints turn in the same sense about parallel axes: which angle does the "
        "second link make with the x axis when both turn by 10 degrees?",
        *(substitute({angle: -angle}) for angle in angles),
        **other,
    )


def angle_not_summed(*wrong, **other) -> Mistake:
    """A relative angle is taken for an absolute one; `wrong` are the answers that come of it."""
    return _entry(
        "angle_not_summed",
        0.4,
        "**An angle is measured from the wrong line.** Each joint angle goes from the link before it to its own link; with "
        "the second angle zero the arm is stretched, whatever the first one is.",
        *(lambda _, answer=answer: answer for answer in wrong),
        **other,
    )


def _change_atan2(answer: sympy.Expr, change: Callable, which: int | None) -> sympy.Expr:
    """The answer with one atan2 of it changed, or all of them."""
    answer = sympy.sympify(answer)
    calls = sorted(answer.atoms(sympy.atan2), key=sympy.default_sort_key)
    if which is not None:
        calls = [calls[which]]
    return answer.xreplace({call: change(*call.args) for call in calls})


def atan_for_atan2(count: int = 1, **other) -> Mistake:
    """atan of a quotient for atan2; `count` is the number of different atan2 in the answer, an expression."""
    return _on_atan2(
        "atan_for_atan2",
        0.5,
        "**atan loses the quadrant.** It cannot tell a target behind the base from one in front of it; a function of two "
        "arguments can.",
        lambda y, x: sympy.atan(y / x),
        count,
        **other,
    )


def atan2_arguments_exchanged(count: int = 1, **other) -> Mistake:
    """atan2(x, y) for atan2(y, x); `count` is the number of different atan2 in the answer, an expression.

    All of them exchanged turn the sign of a difference: that has two causes, and is left to `slips`.
    """
    return _on_atan2(
        "atan2_arguments_exchanged",
        0.4,
        "**The arguments of atan2 are exchanged.** The ordinate comes first: atan2(y, x).",
        lambda y, x: sympy.atan2(x, y),
        count,
        together=False,
        **other,
    )


def _on_atan2(
    note: str, share: float, feedback: str, change: Callable, count: int, /, together: bool = True, **other
) -> Mistake:
    """`together` says whether all of them may be changed at once, as well as each."""
    places = (*((None,) if together and count > 1 else ()), *range(count))
    steps = (partial(_change_atan2, change=change, which=which) for which in places)
    return _entry(note, share, feedback, *steps, **other)


def misprint(printed, because: str, **other) -> Mistake:
    """The answer as a document prints it, wrongly.

    `printed` is this answer, a step that makes the right one into it, or the keywords with which the reference gives it.
    """
    if isinstance(printed, Mapping):
        other["wrong"] = printed
    step = printed if callable(printed) else lambda _: printed
    return _entry(
        "slide_misprint",
        0.5,
        f"**This is the form printed on the slide; it is an erratum** because {because}",
        step,
        **other,
    )


# ---------------------------------------------------------------- joint solutions and orientations


def posture_missing(*kept: Sequence[int], **other) -> Mistake:
    """acos without its second sign: only some of the solutions are given. By default one of two; else indices of those kept.

    Where a target has fewer solutions, those of them that are there, or else all.
    """

    def keep(found, chosen):
        return [found[i] for i in chosen if -len(found) <= i < len(found)] or list(found)

    return _entry(
        "one_posture_missing",
        0.5,
        "**Not all postures are there.** A cosine alone does not tell the sign of its angle, nor a square root its own.",
        *(lambda found, chosen=chosen: keep(found, chosen) for chosen in kept or ((0,), (-1,))),
        **other,
    )


def with_first_theta1(column: int = 0, **other) -> Mistake:
    """Every posture is paired with the theta1 (or another joint, from 0) of one of them."""

    def paired(found, which):
        return [[*row[:column], found[which][column], *row[column + 1 :]] for row in found]

    return _entry(
        "posture_with_other_theta1" if column == 0 else f"posture_with_other_joint{column + 1}",
        0.4,
        f"**All postures share one value of joint {column + 1}.** Each posture has its own: put your second solution into the "
        "direct model and see where the hand goes.",
        lambda found: paired(found, 0),
        lambda found: paired(found, -1),
        **other,
    )


def degrees(*angles: int, **other) -> Mistake:
    """Angles in degrees: those at the given indices of each row, or of a single list."""

    def in_degrees(found):
        found = np.array(found, dtype=float)
        if not found.size:
            return []
        found[..., list(angles)] = np.degrees(found[..., list(angles)])
        return found.tolist()

    return _entry(
        "degrees", 0.4, "**The angles are in degrees.** The question asks for radians.", in_degrees, turn=360, **other
    )


def arguments_in_degrees(*wrong: Wrong, **other) -> Mistake:
    """A function takes angles among its arguments as degrees; `wrong` are keywords with which the reference does."""
    return _entry(
        "degrees",
        0.4,
        "**The angles are taken in degrees.** The question and numpy's cos and sin count in radians.",
        wrong=wrong,
        **other,
    )


def fails_on_limit(*wrong: Wrong, **other) -> Mistake:
    """acos without clipping: the function fails where rounding pushes a cosine above 1.

    `wrong` are keywords with which the reference does just that.
    """
    return _entry(
        "unclipped_acos",
        0.6,
        "**On a limit your function fails.** Rounding pushes a cosine a hair above 1, where acos has no value. What must "
        "the cosine be on the limit?",
        wrong=wrong,
        **other,
    )


def tolerance_too_wide(*wrong: Wrong, **other) -> Mistake:
    """A target out of reach gets a solution, because the function allows for more than rounding.

    `wrong` are keywords with which the reference does that.
    """
    return _entry(
        "tolerance_too_wide",
        0.8,
        "**Your function answers for targets that are a little out of reach.** The statement says how much to allow for rounding: what "
        "lies further out has no solution.",
        wrong=wrong,
        **other,
    )


def extrinsic_for_intrinsic(**other) -> Mistake:
    """Turns about the fixed axes are taken for turns about the moving ones: the angles come out in the reverse order."""

    def reverse(answer):
        rows = answer if isinstance(answer[0], (list, tuple, np.ndarray)) else None
        return [list(row)[::-1] for row in rows] if rows is not None else list(answer)[::-1]

    return _entry(
        "extrinsic_for_intrinsic",
        0.4,
        "**Fixed and moving axes are mixed up.** Turns about the axes of the moving frame are multiplied from left to right, "
        "turns about fixed axes from right to left.",
        reverse,
        **other,
    )


def one_triple_only(**other) -> Mistake:
    """Only one of the two triples of angles is given."""
    about = {
        "note": "one_triple_only",
        "feedback": "**One of the two triples is missing.** The middle angle comes from a square root: take its other "
        "sign, and see what becomes of the other two.",
    }
    return posture_missing(**about | other)


def lock_not_switched(*wrong: Wrong, **other) -> Mistake:
    """At gimbal lock the general formulas are used although atan2(0, 0) says nothing.

    `wrong` are keywords with which the reference does that.
    """
    return _entry(
        "gimbal_lock_not_switched",
        0.6,
        "**At gimbal lock your function is wrong.** There both arguments of an atan2 vanish: only the sum or the difference "
        "of two angles is left, and one of them may be chosen.",
        wrong=wrong,
        **other,
    )


def summed_in_the_wrong_frame(*wrong, **other) -> Mistake:
    """Vectors of different frames are added as they stand; `wrong` are the answers that come of it."""
    return _entry(
        "summed_in_the_wrong_frame",
        0.4,
        "**Quantities of different frames are added.** Turn each into the same frame first: what is ahead of link 2 is "
        "not ahead of the base.",
        *(lambda _, answer=answer: answer for answer in wrong),
        **other,
    )


# ---------------------------------------------------------------- choices


def option(letter: str, note: str, feedback: str, share: float = 0.0) -> Mistake:
    """A wrong letter, and what is behind choosing it."""
    return mistake(note, share, feedback, lambda _: letter)
