"""Homogeneous transforms (MECA 953 and DH-m slides): order of moves, inverse, classic and modified convention."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Question, mistake
from autograder.judge.misconceptions import (
    classic_table,
    degrees,
    inverse_by_transposing,
    inverse_keeps_position,
    misprint,
    option,
    summed_in_the_wrong_frame,
    symbol_negated,
    tool_left_out,
    transposed_rotation,
)
from autograder.judge.steps import replace_entry
from dhm.transforms import rigid_inverse

from .model import (
    CLASSIC,
    COMMUTE,
    INVERSE,
    MODIFIED,
    ROWS,
    SIGNS_TURNED,
    a,
    acos,
    alpha,
    asin,
    atan,
    d,
    divide,
    draw_matrices,
    failing_atan,
    flat,
    half_turn_forgotten,
    leave_alpha,
    misread_angles,
    name_twist,
    project_by_angle,
    project_on_axis,
    read_parameters,
    see_from_a,
    theta,
)

QUESTIONS = (
    Question(
        "transforms.point",
        reference=see_from_a,
        mistakes=(
            mistake(
                "turned_the_other_way",
                0.5,
                "**The point is turned the other way.** The columns of R, not its rows, are the axes of B: with phi = {phi} degrees "
                "x_B points up to the right.",
                wrong={"turn": -1.0},
            ),
            mistake(
                "shift_turned_too",
                0.5,
                "**The way from O_A to O_B was turned as well.** It is given along the axes of A already: turn the point, then add.",
                wrong={"shift_turned": True},
            ),
            mistake(
                "shift_missing",
                0.4,
                "**The way from O_A to O_B is missing.** Your point is turned, but counted from O_B.",
                wrong={"shift": 0.0},
            ),
            mistake(
                "degrees",
                0.6,
                "**The angle {phi} is taken in radians.** It is given in degrees: numpy's cos and sin want `np.radians` of it.",
                wrong={"unit": 1.0},
            ),
            summed_in_the_wrong_frame(
                wrong={"turn": 0.0},
                feedback="**Coordinates of two frames are added as they stand.** {px} m along x_B is not {px} m along x_A: frame B is "
                "turned by {phi} degrees.",
            ),
        ),
    ),
    Question(
        "transforms.commute",
        reference=COMMUTE,
        mistakes=(
            mistake(
                "translations_do_not_commute",
                0.6,
                "**Two shifts are missing among the pairs that may be exchanged.** Neither of them turns anything: does it matter "
                "which one you walk first?",
                replace_entry(1, 0),
            ),
            mistake(
                "rotations_commute",
                0.3,
                "**Turns about two different axes do not commute.** Turn a book by a quarter about its long edge, then about its "
                "spine; now the other way round.",
                replace_entry(4, 1),
            ),
            mistake(
                "translation_and_rotation_commute",
                0.3,
                "**A turn changes the direction in which a later shift goes**, unless it turns about that very direction.",
                replace_entry(2, 1),
                replace_entry(3, 1),
                lambda found: [*found[:2], 1, 1, *found[4:]],
            ),
        ),
        places=False,
    ),
    Question(
        "transforms.operators",
        reference=[alpha, a, theta, d],
        mistakes=(
            misprint(
                replace_entry(1, alpha),
                "the second move is a shift, and a shift wants a length.",
                share=0.3,
            ),
            mistake(
                "a_for_alpha",
                0.4,
                "**An a stands where an alpha belongs.** The first move turns: its argument is an angle. (The slide's list of "
                "parameters names a twice, too.)",
                replace_entry(0, a),
            ),
            mistake(
                "order_of_the_table",
                0.2,
                "**These are the parameters in the order of a table.** The slide turns before it shifts: R, D, R, D.",
                lambda found: [found[1], found[0], found[3], found[2]],
            ),
        ),
        angles=(0, 2),
    ),
    Question(
        "transforms.inverse",
        reference=INVERSE,
        mistakes=(
            inverse_by_transposing(),
            inverse_keeps_position(),
            transposed_rotation(
                share=0.5,
                feedback="**The position is right, the rotation is not inverted.** Your rotation block still leads from frame i-1 to frame i: what "
                "is the inverse of a rotation?",
                note="rotation_not_inverted",
            ),
            mistake(
                "signs_turned_order_kept",
                0.4,
                "**The four signs are turned, but the order is kept.** Who puts on socks and then shoes, takes off the shoes first.",
                lambda _: SIGNS_TURNED,
            ),
            mistake(
                "not_inverted",
                0.1,
                "**This is the way from frame i-1 to frame i itself.** The way back is asked for.",
                rigid_inverse,
            ),
        ),
    ),
    Question(
        "transforms.classic",
        reference=CLASSIC,
        mistakes=(
            misprint(
                lambda matrix: matrix[:, :3].row_join(matrix[:, 3].subs({a: d, d: a}, simultaneous=True)),
                "it puts the origin a up the z axis and d outwards. What does the page's own definition of a and d say?",
                share=0.2,
            ),
            mistake(
                "modified_matrix",
                0.3,
                "**This is the modified matrix.** In the classic walk the joint comes first: about z, along z, then along x, about x.",
                lambda _: MODIFIED,
            ),
            mistake(
                "origin_not_turned",
                0.5,
                "**The origin is not turned.** a is walked along the x axis *after* the turn by theta.",
                lambda matrix: matrix[:, :3].row_join(sympy.Matrix([a, 0, d, 1])),
            ),
            transposed_rotation(),
            symbol_negated(
                alpha,
                "sign_of_alpha",
                "**alpha turns the wrong way.** Write Rot_x(alpha) alone and see where it sends the y axis.",
                share=0.5,
            ),
        ),
    ),
    Question(
        "transforms.frame_place",
        reference="B",
        mistakes=(
            option(
                "A",
                "slide_misprint",
                "**This is the claim of the slide, and the matrices contradict it.** Which convention ends with the turn of joint i, "
                "so that the joint turns about the z axis of frame i?",
            ),
            option(
                "C",
                "same_place",
                "**The frames are not at the same place.** In one convention joint i turns about z_i, in the other about z_(i-1).",
            ),
            option(
                "D",
                "same_place_downstream",
                "**The frames are not at the same place.** In one convention joint i turns about z_i, in the other about z_(i-1).",
            ),
        ),
    ),
    Question(
        "transforms.convert",
        reference=ROWS,
        mistakes=(
            classic_table(
                feedback="**The classic rows were copied.** In the modified table row i holds a and alpha of the link *before* "
                "joint i: what stands before joint 1?",
            ),
            mistake(
                "alpha_left_behind",
                0.5,
                "**Column a was moved, column alpha was not.** The two are one pair, along and about the same X axis.",
                leave_alpha,
            ),
            tool_left_out(
                feedback="**The last pair got lost.** a3 and its twist lead from axis 3 to the hand: where do they go when the "
                "columns move down?",
            ),
        ),
        partial=0.6,
    ),
    Question(
        "transforms.parameters",
        reference=read_parameters,
        mistakes=(
            mistake(
                "d_by_division",
                0.6,
                "**For some twists your d has no value or a wrong one.** Where the sine or the cosine of alpha vanishes, an entry that "
                "should hold d holds nothing. The other entry then holds all of it.",
                wrong=[
                    {"offset": divide(2, (2, 2))},
                    {"offset": divide(1, (1, 2))},
                    {"offset": lambda T, angle: T[2, 3] / np.cos(angle)},
                ],
            ),
            mistake(
                "half_turn_forgotten",
                0.7,
                "**With a twist of half a turn your function is wrong.** Where the sine of alpha vanishes the cosine is +1 or -1: look at what "
                "each of the two does to alpha and to d.",
                wrong=[
                    {"offset": half_turn_forgotten},
                    *(
                        {"twist": flat, "turn": turn, "offset": d}
                        for turn in (np.arctan2, flat)
                        for d in (project_on_axis, project_by_angle)
                    ),
                    {"twist": flat, "offset": half_turn_forgotten},
                ],
            ),
            mistake(
                "d_is_one_component",
                0.4,
                "**d is not an entry of the matrix.** The origin goes d along the *tilted* axis: the last column holds two "
                "components of it.",
                wrong={"offset": lambda T, angle: T[2, 3]},
            ),
            mistake(
                "atan_for_atan2",
                0.5,
                "**atan loses the quadrant.** A quotient is the same for an angle and for the opposite one; a function of two "
                "arguments can tell them apart.",
                wrong=misread_angles(atan, failing_atan),
            ),
            mistake(
                "sign_of_angle_lost",
                0.5,
                "**acos does not know the sign of its angle**, and asin does not know more than half a turn. Each angle has a sine "
                "*and* a cosine in the matrix.",
                wrong=misread_angles(acos, asin),
            ),
            degrees(1, 3),
        ),
        angles=(1, 3),
        probe=draw_matrices,
        case=name_twist,
    ),
)
