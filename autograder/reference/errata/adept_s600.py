"""Adept s600 tutorial: SCARA with its fourth axis pointing down, and the type-8 equation."""

from __future__ import annotations

import numpy as np
import sympy as sp

from dhm.transforms import modified_dh

from .proof import Erratum, against, agree

DOCUMENT = "Adept s600 tutorial"

t1, t2, t4, ti, tj = sp.symbols("t1 t2 t4 ti tj")
r1, r2, r3, r4, t3 = sp.symbols("r1 r2 r3 r4 t3")
d2, d3, r30, X, Y, Z1, Z2 = sp.symbols("d2 d3 r30 X Y Z1 Z2")
C, S = sp.cos, sp.sin

_T12 = modified_dh(d2, 0, 0, t2)
_T34 = modified_dh(0, sp.pi, 0, t4)
_T04 = modified_dh(0, 0, 0, t1) * _T12 * modified_dh(d3, 0, r3 + r30, 0) * _T34


def _contains_the_sines(sines_of):
    """From cos tj alone: the sines found are those of tj and -tj, all on the unit circle."""
    angles = np.linspace(-3, 3, 13)
    return all(
        np.isclose(sines_of(np.cos(angle)), np.sin(angle)).any()
        and np.allclose(np.array(sines_of(np.cos(angle))) ** 2 + np.cos(angle) ** 2, 1)
        for angle in angles
    )


def _turns_the_equations_into_S1(B):
    """Ci B1 - Si B2 and Ci B2 + Si B1 are the two left-hand sides."""
    B1, B2 = B
    return agree(C(ti) * B1 - S(ti) * B2, X * C(ti) + Y * C(ti + tj)) and agree(
        C(ti) * B2 + S(ti) * B1, X * S(ti) + Y * S(ti + tj)
    )


ERRORS = (
    Erratum(
        "004-T04-expanded",
        DOCUMENT,
        "L116",
        "cell (2, 1) of the expanded 0T4: S1 C(2-4) - C1 S(2-4)",
        "S1 C(2-4) + C1 S(2-4)",
        "a sign; the factored form S(1+2-4) printed next is right.",
        against(
            "it is the cell of the product of the four transforms",
            lambda cell: agree(cell, _T04[1, 0]),
            S(t1) * C(t2 - t4) - C(t1) * S(t2 - t4),
            S(t1) * C(t2 - t4) + C(t1) * S(t2 - t4),
        ),
    ),
    Erratum(
        "004-app-brace",
        DOCUMENT,
        "L276",
        "the bracket is C(ti - (ti + ti))",
        "C(ti - (ti + tj))",
        "an index; the other form given, C(ti + tj - ti), is right.",
        against(
            "it equals Ci Cij + Si Sij",
            lambda form: agree(form, C(ti) * C(ti + tj) + S(ti) * S(ti + tj)),
            C(ti - (ti + ti)),
            C(ti - (ti + tj)),
        ),
    ),
    Erratum(
        "004-app-sin",
        DOCUMENT,
        "L280",
        "sin tj = sqrt(1 - cos tj)",
        "sin tj = +-sqrt(1 - cos^2 tj)",
        "the square is missing, and the sign: it carries the second solution.",
        against(
            "the sine of tj is among the values, on the unit circle",
            _contains_the_sines,
            lambda c: (np.sqrt(1 - c),),
            lambda c: (np.sqrt(1 - c**2), -np.sqrt(1 - c**2)),
        ),
    ),
    Erratum(
        "004-app-B",
        DOCUMENT,
        "L293",
        "B1 = Y Sj, B2 = X + Y Cj",
        "B1 = X + Y Cj, B2 = Y Sj",
        "exchanged; the system (S1) and all that follows use the corrected ones.",
        against(
            "the system (S1) is the pair of equations",
            _turns_the_equations_into_S1,
            (Y * S(tj), X + Y * C(tj)),
            (X + Y * C(tj), Y * S(tj)),
        ),
    ),
)


# -- ambiguities ------------------------------------------------------------------------


def _are_independent(variables):
    """Each variable moves the hand in its own way: as many freedoms as variables.

    The table with every r_i and theta_i left open; freedoms are the rank of the derivative
    of the whole transform.
    """
    T = (
        modified_dh(0, 0, r1, t1)
        * modified_dh(d2, 0, r2, t2)
        * modified_dh(d3, 0, r3, t3)
        * modified_dh(0, sp.pi, r4, t4)
    )
    everything = (r1, r2, r3, r4, t1, t2, t3, t4, d2, d3)
    values = dict(zip(everything, np.linspace(0.3, 1.2, len(everything))))
    derivative = np.array(T[:3, :].reshape(12, 1).jacobian(variables).subs(values).evalf(), float)
    return np.linalg.matrix_rank(derivative, tol=1e-9) == len(variables)


_T24 = sp.Matrix([[C(t4), -S(t4), 0, d3], [-S(t4), -C(t4), 0, 0], [0, 0, -1, r3 + r30], [0, 0, 0, 1]])


def _is_the_distance_of_the_axes(length):
    """Along x_1, frame 2 stands this far from frame 1, at any posture."""
    return agree(_T12[0, 3], length) and agree(_T12[1:3, 3], sp.zeros(2, 1))


AMBIGUITIES = (
    Erratum(
        "004-vars",
        DOCUMENT,
        "L75-77",
        "the r_i and theta_i are the joint variables",
        "theta_1, theta_2, r_3 and theta_4 are",
        "one per row: the other of the pair is a constant. Eight variables would not be independent.",
        against("the variables are independent", _are_independent, (r1, r2, r3, r4, t1, t2, t3, t4), (t1, t2, r3, t4)),
    ),
    Erratum(
        "004-cste",
        DOCUMENT,
        "L61, L85, L107",
        "r_3 alone in T23, r_3 + constant in T24 and after",
        "r_3 + r_30 throughout",
        "the table has the constant in brackets; T23 leaves it out, the rest uses it.",
        against(
            "T23 T34 is the printed T24", lambda height: agree(modified_dh(d3, 0, height, 0) * _T34, _T24), r3, r3 + r30
        ),
    ),
    Erratum(
        "004-one-param",
        DOCUMENT,
        "L230",
        "the only parameter between frames 1 and 2 is d_1",
        "it is d_2 of the table",
        "in the DHm table of the page d_1 = 0; in the classic table of the simulator the same length has index 1.",
        against("it is the distance of frame 2 from frame 1", _is_the_distance_of_the_axes, sp.S.Zero, d2),
    ),
)
