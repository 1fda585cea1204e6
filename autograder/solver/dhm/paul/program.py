"""A derivation as a Python program of its own: one loop for each unknown, and a look at every posture by the direct model."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import sympy as sp
from sympy.printing.pycode import PythonCodePrinter

from .closure import U0, Solved, Step
from .setting import Setting

_HEAD = '''"""Inverse model of {name}: all postures of a pose, by Paul's method. Metres and radians."""

from math import atan2, cos, hypot, pi, remainder, sin, sqrt

import numpy as np

NOTHING = 1e-9  # under which a number counts as zero
BASE = np.array({base})
TOOL = np.array({tool})
# sigma, a, alpha, d, theta of each row; of d and theta, the one that moves is what is added to sign * q
ROWS = [
{rows}
]
SIGNS = {signs}


def direct(q):
    """The pose (4, 4) of the tool for joint values."""
    pose = BASE
    for (sigma, a, alpha, d, theta), sign, joint in zip(ROWS, SIGNS, q):
        d, theta = (d + sign * joint, theta) if sigma else (d, theta + sign * joint)
        ca, sa, c, s = cos(alpha), sin(alpha), cos(theta), sin(theta)
        pose = pose @ np.array([[c, -s, 0, a], [s * ca, c * ca, -sa, -sa * d], [s * sa, c * sa, ca, ca * d], [0, 0, 0, 1]])
    return pose @ TOOL


'''

_HELPERS = {
    "type1": '''def type1(X, Y):
    """X r = Y."""
    return [Y / X] if abs(X) > NOTHING else []


''',
    "type2": '''def type2(X, Y, Z, free):
    """X sin + Y cos = Z, for an angle, which may be free."""
    rho = hypot(X, Y)
    if rho <= NOTHING:
        return [free] if abs(Z) <= NOTHING else []
    if abs(Z) > rho + NOTHING:
        return []
    middle, aside = atan2(X, Y), atan2(sqrt(max(rho - abs(Z), 0.0) * (rho + abs(Z))), Z)
    return [middle + aside, middle - aside]


''',
    "type3": '''def type3(X1, Y1, Z1, X2, Y2, Z2, free):
    """X1 sin + Y1 cos = Z1 and X2 sin + Y2 cos = Z2, for an angle, which may be free."""
    determinant = X1 * Y2 - X2 * Y1
    first, second = hypot(X1, Y1), hypot(X2, Y2)
    if max(first, second) <= NOTHING:
        return [free]
    if abs(determinant) <= NOTHING * max(first, second) ** 2:  # one of them says all
        return type2(X1, Y1, Z1, free) if first >= second else type2(X2, Y2, Z2, free)
    return [atan2((Z1 * Y2 - Z2 * Y1) / determinant, (X1 * Z2 - X2 * Z1) / determinant)]


''',
    "quadratic": '''def quadratic(A, B, C):
    """A r^2 + B r + C = 0."""
    inside = B * B - 4 * A * C
    if abs(A) <= NOTHING or inside < -NOTHING:
        return []
    root = sqrt(max(inside, 0.0))
    return [(-B + root) / (2 * A), (-B - root) / (2 * A)]


''',
}

_TAIL = '''    return distinct(found)


def reaches(q, T):
    """Whether the direct model confirms a posture; poses may be rounded to six decimals."""
    return abs(direct(q) - T){part}.max() <= 1e-5 * max(1.0, abs(T).max())


def distinct(found):
    """The postures (k, n) without those that are the same, angles in (-pi, pi]."""
    kept = []
    for q in found:
        q = [x if row[0] else pi - (pi - x) % (2 * pi) for x, row in zip(q, ROWS)]
        apart = [[x - y if row[0] else remainder(x - y, 2 * pi) for x, y, row in zip(q, other, ROWS)] for other in kept]
        if all(max(map(abs, each)) > 1e-6 for each in apart):
            kept.append(q)
    return np.array(kept).reshape(-1, len(ROWS))
'''


class _Printer(PythonCodePrinter):
    def __init__(self) -> None:
        super().__init__({"fully_qualified_modules": False})

    def _print_Float(self, number: sp.Float) -> str:
        return repr(float(number))

    def _print_Rational(self, number: sp.Rational) -> str:
        return f"{number.p} / {number.q}"


Code = Callable[[sp.Expr], str]
_WIDTH = 110  # characters of a line of the program, above which it is broken


def written(setting: Setting, steps: Sequence[Step]) -> str:
    """The program of a derivation. Raises ValueError naming letters that have no value."""
    letters = {symbol for row in setting.rows for entry in row.parameters for symbol in entry.free_symbols}
    letters |= setting.base.free_symbols | setting.tool.free_symbols
    letters |= setting.tip.free_symbols if setting.tip is not None else set()
    letters = letters.union(*(offset.free_symbols for _, _, offset in setting.joints)) - set(setting.unknowns)
    without = sorted(str(symbol) for symbol in letters if symbol not in setting.values)
    if without:
        raise ValueError(f"give numbers for {', '.join(without)} first: table.with_values({{...}})")
    code = _Printer().doprint

    def number(entry: sp.Expr) -> str:
        return code(entry.xreplace(setting.values)) if entry.free_symbols else code(entry)

    rows = []
    for row, (_, _, offset) in zip(setting.rows, setting.joints):
        entries = [row.a, row.alpha, *((offset, row.theta) if row.sigma else (row.d, offset))]
        rows.append(f"    ({row.sigma}, {', '.join(number(entry) for entry in entries)}),")
    head = _HEAD.format(
        name=setting.name or "a robot",
        base=_array(setting.base, number),
        tool=_array(setting.tool, number),
        rows="\n".join(rows),
        signs=[sign for _, sign, _ in setting.joints],
    )
    used = {each.helper for step in steps for each in step.solved}
    used |= {"type2"} if "type3" in used else set()
    helpers = "".join(text for name, text in _HELPERS.items() if name in used)
    part = "[:3, 3]" if setting.tip is not None else ""
    return head + helpers + "\n".join(_search(setting, steps, code)) + "\n" + _TAIL.format(part=part)


def _search(setting: Setting, steps: Sequence[Step], code: Code) -> Iterator[str]:
    yield "def postures(T, free=0.0):"
    yield '    """The joint values (k, n) of all postures that bring the tool to a pose T (4, 4); an angle that is free is `free`."""'
    yield "    T = np.asarray(T, dtype=float)"
    if setting.tip is None:
        yield "    U0 = np.linalg.inv(BASE) @ T @ np.linalg.inv(TOOL)"
        yield "    " + ", ".join(f"({', '.join(map(str, U0[i, :]))})" for i in range(3)) + ", _ = U0.tolist()"
    else:
        yield f"    {', '.join(map(str, U0[:3, 3]))} = (np.linalg.inv(BASE) @ T)[:3, 3].tolist()"
    used = set().union(*(part.free_symbols for step in steps for each in step.solved for part in each.coefficients))
    used |= set().union(*(entry.free_symbols for step in steps for _, entry in step.seen))
    used |= set().union(*(offset.free_symbols for _, _, offset in setting.joints))
    yield from (
        f"    {letter} = {setting.values[letter]!r}" for letter in sorted(used & setting.values.keys(), key=str)
    )
    yield "    found = []"
    depth = 1
    for place, step in enumerate(steps, start=1):
        said = " and ".join(f"{code(each.left)} = {code(each.right)}" for each in step.equations)
        yield "    " * depth + f"# step {place}, type {step.kind}: {said}"
        yield from ("    " * depth + f"{name} = {code(entry)}" for name, entry in step.seen)
        for each in step.solved:
            yield from _line(each, depth, code)
            depth += each.helper != "sum"
    values = [sign * (unknown - offset) for unknown, (_, sign, offset) in zip(setting.unknowns, setting.joints)]
    yield "    " * depth + f"q = [{', '.join(map(code, values))}]"
    yield "    " * depth + "if reaches(q, T):"
    yield "    " * (depth + 1) + "found.append(q)"


def _line(each: Solved, depth: int, code: Code) -> Iterator[str]:
    indent, arguments = "    " * depth, [code(part) for part in each.coefficients]
    if each.helper == "sum":
        yield f"{indent}{each.unknown} = {arguments[0]}"
        return
    arguments += ["free"] * (each.helper in ("type2", "type3"))
    line = f"{indent}for {each.unknown} in {each.helper}({', '.join(arguments)}):"
    if len(line) <= _WIDTH:
        yield line
        return
    yield f"{indent}for {each.unknown} in {each.helper}("
    yield from (f"{indent}    {argument}," for argument in arguments)
    yield f"{indent}):"


def _array(matrix: sp.ImmutableMatrix, code: Code) -> str:
    return "[" + ", ".join("[" + ", ".join(map(code, matrix[i, :])) + "]" for i in range(4)) + "]"
