"""Determinants of Jacobians in closed form, of the documents' robots.

Sources: singular postures of the RX-90 (MECA 953 slides), two-link arm (EPFL slides), s600 tutorial.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import sympy as sp


def two_link_determinant(l1: Any, l2: Any, t2: Any) -> Any:
    """det of d(x, y)/d(t1, t2) of a planar two-link arm, and of the SCARA's (x, y) part.

    Lengths in metres, t2 in radians; numbers, arrays or SymPy expressions, as the result (square metres).
    Source: two-link arm of the EPFL slides.
    """
    return l1 * l2 * _sin(t2)


def scara_determinant(l1: Any, l2: Any, t2: Any, slide: int = 1, turn: int = 1) -> Any:
    """det of d(x, y, z, omega)/dq of a SCARA.

    l1, l2, t2 and the result as for `two_link_determinant`. slide, turn: +1 or -1, the sense in which joint 3 raises z and joint 4 raises omega. Both
    are -1 on one of the course's two SCARAs: joint 3 of the MECA 953 slides (depth d2), joint
    4 of the s600 (axis pointing down).
    """
    return slide * turn * two_link_determinant(l1, l2, t2)


def rx90_determinant(a3: Any, d3: Any, t2: Any, t3: Any, t5: Any) -> Any:
    """det of the 6x6 geometric Jacobian of the RX-90 at the wrist centre.

    Three factors, three singularities: elbow (cos t3 = 0), wrist (sin t5 = 0), shoulder
    (wrist centre on axis 1). Lengths in metres, angles in radians; numbers, arrays or SymPy expressions, as the
    result (cubic metres). Source: singular postures of the RX-90, MECA 953 slides.
    """
    return -a3 * d3 * _cos(t3) * _sin(t5) * (_sin(t2 + t3) * d3 - _cos(t2) * a3)


def _sin(angle: Any) -> Any:
    return sp.sin(angle) if isinstance(angle, sp.Basic) else np.sin(angle)


def _cos(angle: Any) -> Any:
    return sp.cos(angle) if isinstance(angle, sp.Basic) else np.cos(angle)
