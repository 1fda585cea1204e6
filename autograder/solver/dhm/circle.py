"""Real roots of trigonometric polynomials, for many of them at once.

What is left of a closure equation when all joints but one are eliminated is such a polynomial in that joint. It is
known by its values at equally spaced angles; a slide d joins in as d = tan(angle / 2).
"""

from __future__ import annotations

from functools import cache

import numpy as np

_REAL = 2e-2  # imaginary part, in radians, up to which a root may be real: of a double root half of the digits are lost

ZERO = 1e-10
"""Length, of an arm of size 1, under which a vector has no direction."""
DOUBLE = 1e-5
"""Radians up to which two roots are one."""


def angles(degree: int) -> np.ndarray:
    """Where a polynomial of a degree must be known: 2 degree + 1 angles, radians. None of them is pi."""
    count = 2 * degree + 1
    return 2 * np.pi * np.arange(count) / count


def roots(values: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Roots from the values at `angles`, (2 degree + 1, N).

    Returns
    -------
    where : (2 degree, N) array
        Radians; of a complex root its real part. In rising order, real ones first.
    real, double : (2 degree, N) bool arrays
    """
    count = len(values)
    degree = count // 2
    # In t = tan((angle - start) / 2), infinite where the polynomial is largest, so that the leading coefficient is too.
    start = angles(degree)[np.abs(values).argmax(axis=0)] - np.pi
    orders = np.r_[0 : degree + 1, -degree:0]
    turned = np.fft.fft(values, axis=0) / count * np.exp(1j * orders[:, None] * start)
    coefficients = (_to_half_angle(degree) @ turned).real
    leading = coefficients[-1]
    monic = coefficients[:-1] / np.where(leading == 0, 1.0, leading)
    companion = np.zeros((values.shape[1], 2 * degree, 2 * degree))
    companion[:, np.arange(1, 2 * degree), np.arange(2 * degree - 1)] = 1.0
    companion[:, :, -1] = -monic.T
    t = np.linalg.eigvals(companion).T
    real = 2 * np.abs(t.imag) <= _REAL * (1 + np.abs(t) ** 2)
    aside = 2 * np.arctan(t.real)  # from start, where no root is near the ends of the turn
    aside, real = _sorted(aside, real, aside + 10 * ~real)
    double = np.zeros_like(real)
    for i in range(2 * degree - 1):  # the mean of a double root keeps all digits
        same = real[i + 1] & (aside[i + 1] - aside[i] <= DOUBLE)
        aside[i : i + 2] = np.where(same, (aside[i] + aside[i + 1]) / 2, aside[i : i + 2])
        double[i : i + 2] |= same
    where = np.angle(np.exp(1j * (start + aside)))
    where, real, double = _sorted(where, real, double, where + 10 * ~real)
    return where, real, double


def _sorted(*arrays: np.ndarray) -> list[np.ndarray]:
    """All arrays but the last, in the order that the last has when it rises along the first axis."""
    order = arrays[-1].argsort(axis=0)
    return [np.take_along_axis(each, order, axis=0) for each in arrays[:-1]]


@cache
def _to_half_angle(degree: int) -> np.ndarray:
    """From the coefficients of e^(i k angle), as the FFT orders them, to those of t^0, ... times (1 + t^2)^degree."""
    matrix = np.zeros((2 * degree + 1, 2 * degree + 1), dtype=complex)
    for column, k in enumerate([*range(degree + 1), *range(-degree, 0)]):
        power = np.ones(1, dtype=complex)
        for factor in [[1, 1j]] * (degree + k) + [[1, -1j]] * (degree - k):
            power = np.convolve(power, factor)
        matrix[:, column] = power
    return matrix
