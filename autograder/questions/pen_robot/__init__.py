"""The pen robot (its sheet, French and English): table, tip, the surface it reaches, and a curve written on it."""

from __future__ import annotations

import numpy as np
import sympy

from autograder.judge import Follow, Question, following, mistake
from autograder.judge.misconceptions import columns_exchanged, offset_missing, option, tolerance_too_wide, tool_left_out
from autograder.judge.steps import change_entry, substitute

from .model import (
    ABSOLUTE_REPAIRED,
    COMMON_SHARES,
    HALF,
    L2,
    READINGS,
    REPAIRED,
    ROWS,
    TIP,
    TWISTED_TIP,
    asin,
    atan,
    circles,
    draw_curve,
    draw_places,
    draw_surface,
    follow,
    h2,
    height_squared,
    inverse,
    name_half,
    name_place,
    p1,
    pair_residual,
    pen_for_circle,
    read_twist_as_length,
    t1,
    t2,
    t3,
    trace_residual,
)

QUESTIONS = (
    Question(
        "pen_robot.table",
        reference=ROWS,
        mistakes=(
            mistake(
                "twist_read_as_length",
                0.3,
                "**The second printed column is read as a length.** Its header is a misprint: -pi/2 is no length, but an angle "
                "about X from one joint axis to the next.",
                read_twist_as_length,
            ),
            columns_exchanged(
                "a",
                "alpha",
                feedback="**The columns a and alpha are exchanged.** Their heads on the sheet do not help: look at the entries. Which "
                "column can hold a length?",
            ),
            offset_missing(2),
            tool_left_out(
                feedback="**The pen is missing.** The last row must bring the origin from the last joint to the tip."
            ),
        ),
        partial=0.6,
    ),
    Question(
        "pen_robot.tip",
        reference=TIP,
        mistakes=(
            mistake(
                "pen_left_out",
                0.4,
                "**This is the origin of the last frame, not the tip.** The pen reaches p1 further along the last X axis.",
                substitute({p1: 0}),
            ),
            mistake(
                "joint_offset_missing",
                0.6,
                "**The offset of theta2 is missing.** With all angles zero your pen lies; row 2 of the table makes it stand.",
                substitute({t2: t2 + HALF}),
            ),
            mistake(
                "sign_of_alpha",
                0.5,
                "**A sign is turned, as if alpha were +pi/2.** To which side of axis 1 does the pen's plane pass?",
                lambda _: TWISTED_TIP,
            ),
        ),
        follows=Follow("pen_robot.table", lambda rows: following.position(following.product_of_table(rows))),
    ),
    Question(
        "pen_robot.linear",
        reference="C",
        mistakes=(
            option(
                "A",
                "taken_for_linear",
                "**The sheet says so, but the unknowns stand inside sines and cosines, and in products.** Double all angles: does the tip "
                "move twice as far?",
            ),
            option(
                "B",
                "three_unknowns_counted",
                "**Three angles are written, fewer act.** Turn joint 2 forward and joint 3 back by the same angle: where does the tip go?",
                share=0.3,
            ),
            option(
                "D",
                "linear_in_sines_and_cosines",
                "**The sines and cosines are not independent, and they occur in products.** Besides, count how many angles act.",
            ),
        ),
    ),
    Question(
        "pen_robot.height",
        reference=height_squared,
        mistakes=(
            mistake(
                "side_forgotten",
                0.4,
                "**The distance of the pen's plane from axis 1 is forgotten.** Seen from above the arm has a corner: rho is not the "
                "distance from the axis.",
                wrong={"side": 0},
            ),
            mistake(
                "side_added",
                0.5,
                "**A sign is turned under the root.** The distance from axis 1 is the hypotenuse, not a leg.",
                wrong={"sign": 1},
            ),
            mistake(
                "one_offset_only",
                0.6,
                "**Only one of the two lengths along axis 2 is there.** L2 lies on the same line as h2.",
                wrong=[{"side": h2}, {"side": L2}],
            ),
            mistake(
                "arm_forgotten",
                0.4,
                "**The arm L1 is forgotten.** The circle of the pen has its centre on axis 2, not on axis 1.",
                wrong={"out": 0},
            ),
        ),
        draw=draw_surface,
    ),
    Question(
        "pen_robot.circles",
        reference=circles,
        mistakes=(
            mistake(
                "side_forgotten",
                0.5,
                "**These are the two rho, not the radii.** The pen's plane passes axis 1 at a distance.",
                wrong={"side": "none"},
            ),
            mistake(
                "one_offset_only",
                0.6,
                "**Only h2 = {h2} m of the lengths along axis 2 is taken.** L2 lies on the same line.",
                wrong={"side": "h2"},
            ),
            mistake(
                "circles_exchanged",
                0.7,
                "**The two radii are exchanged.** The large one comes first.",
                lambda circles: circles[::-1],
            ),
        ),
    ),
    Question(
        "pen_robot.pen",
        reference=pen_for_circle,
        mistakes=(
            mistake(
                "side_forgotten",
                0.4,
                "**The radius is not rho.** The plane of the pen passes beside axis 1, at the distance H = h2 + L2.",
                wrong={"side": False},
            ),
            mistake(
                "sheet_forgotten",
                0.5,
                "**The sheet lies {drop} m below axis 2.** The pen must go ahead *and* down.",
                wrong={"sheet": False},
            ),
        ),
    ),
    Question(
        "pen_robot.inverse",
        reference=inverse,
        mistakes=(
            mistake(
                "points_behind_missed",
                0.6,
                "**Points behind axis 1 get no solution.** A long pen reaches over the axis: rho may be negative.",
                wrong={"signs": (1,)},
            ),
            mistake(
                "surface_not_checked",
                0.4,
                "**Your function answers for points that the pen cannot reach.** Three equations, two unknowns: one equation is left over "
                "as a condition. Put every solution into the direct model before you return it.",
                wrong=[{"slack": np.inf}, {"slack": np.inf, "signs": (1,)}],
            ),
            tolerance_too_wide(
                {"slack": 1e-3},
                {"slack": 5e-3},
                feedback="**Your function answers for points beside the surface.** Some tenths of a millimetre are no rounding: the "
                "statement says how much to allow.",
            ),
            mistake(
                "surface_taken_too_narrow",
                0.7,
                "**Points of the surface come back without a solution.** Rounding moves a point a hair off it: leave the small tolerance of "
                "the statement.",
                wrong=[{"slack": 1e-8}, {"slack": 1e-14}],
            ),
            mistake(
                "sign_of_the_side",
                0.5,
                "**theta1 is turned the wrong way.** The tip lies to the left of the arm: does the arm point to the right or to the left of "
                "the tip?",
                wrong=[{"side": -1}, {"side": 0}],
            ),
            mistake(
                "half_of_the_circle_lost",
                0.5,
                "**phi is right on half of its circle only.** A sine, or a quotient, does not tell the whole angle; you know sine and cosine.",
                wrong=[{"angle": asin}, {"angle": atan}],
            ),
        ),
        angles=(0, 1),
        probe=draw_places,
        case=name_place,
        residual=pair_residual,
    ),
    Question(
        "pen_robot.follow",
        reference=follow,
        mistakes=(
            mistake(
                "stops_ignored",
                0.5,
                "**The trace is right, but a joint goes beyond its stop.** Only the sum of theta2 and theta3 is fixed: share it.",
                wrong={"shares": (0.0, 1.0)},
            ),
            mistake(
                "heading_of_the_tip",
                0.4,
                "**theta1 is the direction of the tip, which is not the direction of the arm.** The pen's plane passes beside axis 1.",
                wrong={"heading": "tip", "shares": COMMON_SHARES},
            ),
            mistake(
                "sign_of_the_side",
                0.5,
                "**theta1 is turned the wrong way.** The tip lies to the left of the arm: does the arm point to the right or to the left of "
                "the tip?",
                wrong={"heading": "mirror", "shares": COMMON_SHARES},
            ),
            mistake(
                "measured_from_the_horizontal",
                0.4,
                "**phi is counted from the horizontal.** With theta2 = theta3 = 0 the pen stands upright.",
                wrong={"zero": "horizontal", "shares": COMMON_SHARES},
            ),
        ),
        angles=(0, 1, 2),
        tolerance=1e-5,
        probe=draw_curve,
        case=name_half,
        residual=trace_residual,
    ),
    Question(
        "pen_robot.readings",
        reference=READINGS,
        mistakes=(
            mistake(
                "sign_of_theta1",
                0.5,
                "**theta1 has the wrong sign.** It is subtracted inside the entry: what must theta2 do to make up for it?",
                substitute({t1: -t1}),
            ),
            mistake(
                "sign_of_the_quarter_turn",
                0.5,
                "**A quarter turn has the wrong sign.** Set the angle of row 2 in your reading equal to the printed one, and solve for theta2.",
                lambda found: [found[0], found[1] - sympy.pi, found[2] + sympy.pi],
                change_entry(1, lambda entry: entry - sympy.pi),
                change_entry(2, lambda entry: entry + sympy.pi),
            ),
            mistake(
                "offset_left_in_phi",
                0.4,
                "**phi stands for the angle of row 2 plus theta3; it is larger by a quarter turn.** The printed entry is theta2 - pi/2.",
                lambda found: [entry - HALF for entry in found],
            ),
        ),
        angles=(0, 1, 2),
    ),
    Question(
        "pen_robot.repaired",
        reference=REPAIRED,
        mistakes=(
            mistake(
                "link_left_out",
                0.3,
                "**This is the robot as printed.** Now L2 is a link between joints 2 and 3, and moves with theta2.",
                substitute({L2: 0}),
            ),
            mistake(
                "angle_not_summed",
                0.4,
                "**The pen is placed as if theta3 were measured from the vertical.** It goes from link 2 to the pen.",
                lambda _: ABSOLUTE_REPAIRED,
            ),
            mistake(
                "sine_and_cosine_exchanged",
                0.5,
                "**Sine and cosine are exchanged.** With both angles zero the robot stands upright.",
                substitute({t2: HALF - t2, t3: -t3}),
            ),
        ),
    ),
)
