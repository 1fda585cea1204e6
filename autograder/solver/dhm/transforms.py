"""Elementary homogeneous transforms and the two Denavit-Hartenberg products (sympy, 4x4).

Modified convention (Khalil-Kleinfinger, Craig), MECA 953 slides and DH-m slides (Romanian):
``i-1Ti = Trans_x(a_{i-1}) Rot_x(alpha_{i-1}) Trans_z(d_i) Rot_z(theta_i)``.
Classic convention: ``i-1Ti = Rot_z(theta_i) Trans_z(d_i) Trans_x(a_i) Rot_x(alpha_i)``.
Lengths in metres, angles in radians; entries may be numbers or sympy expressions.
"""

from __future__ import annotations

import math
import warnings
from typing import TypeAlias

import sympy as sp

from .status import RoundedInput

Entry: TypeAlias = float | sp.Expr
"""A number or a SymPy expression."""

_ROUND_ANGLE = 12  # floats within 1e-12 of a multiple of pi/12 (15 degrees) are meant exactly
ROUNDED = 1e-4
"""Radians by which a right angle typed with few digits may be off: 1.5708, 3.1416."""


def trans_x(a: Entry) -> sp.Matrix:
    """Translation by a metres along x."""
    return sp.Matrix([[1, 0, 0, a], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def trans_z(d: Entry) -> sp.Matrix:
    """Translation by d metres along z."""
    return sp.Matrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, d], [0, 0, 0, 1]])


def rot_x(alpha: Entry) -> sp.Matrix:
    """Rotation by alpha radians about x."""
    c, s = sp.cos(alpha), sp.sin(alpha)
    return sp.Matrix([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])


def rot_y(beta: Entry) -> sp.Matrix:
    """Rotation by beta radians about y."""
    c, s = sp.cos(beta), sp.sin(beta)
    return sp.Matrix([[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]])


def rot_z(theta: Entry) -> sp.Matrix:
    """Rotation by theta radians about z."""
    c, s = sp.cos(theta), sp.sin(theta)
    return sp.Matrix([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def modified_dh(a: Entry, alpha: Entry, d: Entry, theta: Entry) -> sp.Matrix:
    """Modified DH matrix, multiplied out: frame i seen from frame i-1.

    Source: W. Khalil, J. Kleinfinger, "A new geometric notation for open and closed-loop robots", ICRA 1986,
    doi:10.1109/ROBOT.1986.1087552; MECA 953 slides.
    """
    ca, sa, c, s = sp.cos(alpha), sp.sin(alpha), sp.cos(theta), sp.sin(theta)
    return sp.Matrix(
        [
            [c, -s, 0, a],
            [s * ca, c * ca, -sa, -d * sa],
            [s * sa, c * sa, ca, d * ca],
            [0, 0, 0, 1],
        ]
    )


def modified_dh_inverse(a: Entry, alpha: Entry, d: Entry, theta: Entry) -> sp.Matrix:
    """Inverse of the modified DH matrix: frame i-1 seen from frame i."""
    ca, sa, c, s = sp.cos(alpha), sp.sin(alpha), sp.cos(theta), sp.sin(theta)
    return sp.Matrix(
        [
            [c, s * ca, s * sa, -a * c],
            [-s, c * ca, c * sa, a * s],
            [0, -sa, ca, -d],
            [0, 0, 0, 1],
        ]
    )


def classic_dh(a: Entry, alpha: Entry, d: Entry, theta: Entry) -> sp.Matrix:
    """Classic DH matrix, multiplied out, with the parameters a_i, alpha_i, d_i, theta_i.

    Source: J. Denavit, R. Hartenberg, "A kinematic notation for lower-pair mechanisms based on matrices", 1955,
    doi:10.1115/1.4011045.
    """
    ca, sa, c, s = sp.cos(alpha), sp.sin(alpha), sp.cos(theta), sp.sin(theta)
    return sp.Matrix(
        [
            [c, -ca * s, sa * s, a * c],
            [s, ca * c, -sa * c, a * s],
            [0, sa, ca, d],
            [0, 0, 0, 1],
        ]
    )


def rigid_inverse(transform: sp.Matrix) -> sp.Matrix:
    """Inverse of a 4x4 rigid transform, without elimination: [R^T, -R^T p; 0, 1]."""
    transform = sp.Matrix(transform)
    turn = transform[:3, :3].T
    return turn.row_join(-turn * transform[:3, 3]).col_join(sp.Matrix([[0, 0, 0, 1]]))


def exact_angle(angle: Entry, name: str = "an angle") -> sp.Expr:
    """The angle with its constant part exact: a float near k*pi/12 becomes k*pi/12.

    A float pi/2 hides every zero of cos and sin from sympy, which costs minutes later on. A float that is only nearly a
    multiple of pi/2 (1.5708) makes almost parallel axes of parallel ones: it is read as that, with a `RoundedInput`
    warning that calls it by its name.
    """
    angle = sp.sympify(angle)
    constant, rest = angle.as_coeff_Add()
    if not constant.is_Float:
        return angle
    steps = round(float(constant) * _ROUND_ANGLE / math.pi)
    if abs(float(constant) - steps * math.pi / _ROUND_ANGLE) <= 1e-12:
        return rest + sp.Rational(steps, _ROUND_ANGLE) * sp.pi
    quarters, off = nearest_quarter(float(constant))
    if off > ROUNDED:
        return angle
    exact = sp.Rational(quarters, 2) * sp.pi
    warnings.warn(f"{name} = {float(constant):.12g} is read as {exact}, {off:.2g} rad away", RoundedInput, stacklevel=2)
    return rest + exact


def nearest_quarter(angle: float) -> tuple[int, float]:
    """The multiple of 90 degrees that is nearest to an angle (radians), and how far it is, radians."""
    quarters = round(angle * 2 / math.pi)
    return quarters, abs(angle - quarters * math.pi / 2)
