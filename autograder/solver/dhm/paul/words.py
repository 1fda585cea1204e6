"""A derivation in words and formulas, as the slides write one: C_23 for cos(theta_2 + theta_3), matrices iTj."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy as sp

from .closure import Equation, Solved, Step
from .setting import Setting

_TYPES = {
    1: "$X r = Y$",
    2: "$X S + Y C = Z$",
    3: "$X_1 S + Y_1 C = Z_1$, $X_2 S + Y_2 C = Z_2$",
    4: "$X_1 r S = Y_1$, $X_2 r C = Y_2$",
    5: "$X_1 S = Y_1 + Z_1 r$, $X_2 C = Y_2 + Z_2 r$",
    6: "$W S_j = X C_i + Y S_i + Z_1$, $W C_j = X S_i - Y C_i + Z_2$",
    7: "$W_1 C_j + W_2 S_j = X C_i + Y S_i + Z_1$, $W_1 S_j - W_2 C_j = X S_i - Y C_i + Z_2$",
    8: "$X C_i + Y C_{ij} = Z_1$, $X S_i + Y S_{ij} = Z_2$",
}
"""The types of equations of Khalil and Dombre."""


def written(setting: Setting, steps: Sequence[Step], why: str) -> str:
    """The derivation in Markdown."""
    parts = [f"## Inverse model of {setting.name or 'the robot'}", *_given(setting)]
    for number, step in enumerate(steps, start=1):
        unknowns = " and ".join(f"${formula(unknown)}$" for unknown in sorted(step.unknowns, key=str))
        parts.append(f"### Step {number}: {unknowns} (type {step.kind})")
        parts += _step(setting, step)
    if steps:
        parts += _end(setting, steps)
    return "\n\n".join([*parts, why] if why else parts)


def formula(expression: sp.Expr) -> str:
    """An expression in LaTeX, with C_1 and S_23 for cosines and sines of the joints' angles."""
    short = {
        f: sp.Symbol(f"{type(f).__name__[0].upper()}_{_index(f.args[0])}")
        for f in expression.atoms(sp.sin, sp.cos)
        if f.args[0].is_Symbol and f.args[0].name.startswith("theta_")
    }
    shown = expression.xreplace(short)
    names = {
        s: f"{s.name[0] if s.name[0] in 'CS' else chr(92) + 'theta'}_{{{_index(s)}}}".replace("m", "-")
        for s in shown.free_symbols
        if s.name[:2] in ("C_", "S_") or s.name.startswith("theta_")
    }
    return sp.latex(shown, symbol_names=names)


def _index(symbol: sp.Symbol) -> str:
    return symbol.name.partition("_")[2]


def _given(setting: Setting) -> Iterator[str]:
    if setting.tip is None:
        yield (
            "Given is the pose $T$ of the tool. Without base and tool it is the pose of the last frame, "
            "$U_0 = [s\\; n\\; a\\; P]$"
            + (": here $U_0 = T$." if setting.base == setting.tool == sp.eye(4) else f": {_stripped(setting)}.")
        )
    else:
        tip = ", ".join(formula(entry) for entry in setting.tip[:3])
        yield f"Given is the place $P$ of the tool, which is at $[{tip}]$ in the last frame; its orientation follows."
    if setting.values:
        letters = ", ".join(f"${formula(s)} = {value:.6g}$" for s, value in sorted(setting.values.items(), key=str))
        yield f"Letters (metres, radians): {letters}."


def _stripped(setting: Setting) -> str:
    """U_0 from the pose of the tool."""
    left = "" if setting.base == sp.eye(4) else "B^{-1}\\,"
    right = "" if setting.tool == sp.eye(4) else "\\,E^{-1}"
    named = [f"$B = {sp.latex(setting.base)}$"] if left else []
    named += (
        [f"$E = {sp.latex(setting.tool.evalf(4) if not setting.tool.free_symbols else setting.tool)}$"] if right else []
    )
    return f"$U_0 = {left}T{right}$ with " + " and ".join(named)


def _step(setting: Setting, step: Step) -> Iterator[str]:
    count, point = len(setting.rows), setting.tip is not None
    lines = []
    for equation in step.equations:
        row, column = (index + 1 for index in equation.element)
        place = f"row {row}" if point else f"element ({row}, {column})"
        lines.append(
            f"* ${_matrices(equation, count, point)}$, {place}: ${formula(equation.left)} = {formula(equation.right)}$"
        )
    yield "\n".join(lines)
    yield f"Type {step.kind}: {_TYPES[step.kind]}."
    if step.kind > 3:
        yield "Squared and added, one unknown is left:"
    for each in step.solved:
        yield _solved(each)


def _matrices(equation: Equation, count: int, point: bool) -> str:
    first, last = equation.first, equation.last
    left = f"{{}}^{{{first}}}T_0\\," if first else ""
    if point:
        return f"{left}P = {{}}^{{{first}}}T_{{{last}}}\\,P_{{{last}}}"
    right = f"\\,{{}}^{{{count}}}T_{{{last}}}" if last < count else ""
    return f"{left}U_0{right} = {{}}^{{{first}}}T_{{{last}}}"


def _solved(each: Solved) -> str:
    name, parts = formula(each.unknown), [formula(part) for part in each.coefficients]
    index = _index(each.unknown).replace("m", "-")
    match each.helper:
        case "sum":
            return f"$${name} = {parts[0]}$$"
        case "type1":
            X, Y = each.coefficients
            return f"$${name} = {formula(Y / X)}$$"
        case "quadratic":
            return f"$$A\\,{name}^2 + B\\,{name} + C = 0,\\quad A = {parts[0]},\\; B = {parts[1]},\\; C = {parts[2]}$$\n\ntwo solutions, $$ {name} = \\frac{{-B \\pm \\sqrt{{B^2 - 4AC}}}}{{2A}}$$"
        case "type2":
            X, Y, Z = parts
            given = f"$$X S_{{{index}}} + Y C_{{{index}}} = Z,\\quad X = {X},\\; Y = {Y},\\; Z = {Z}$$"
            if each.coefficients[2] == 0:
                return f"{given}\n\n$${name} = \\mathrm{{atan2}}(-Y, X) \\;\\text{{ or that }} + \\pi$$"
            if each.coefficients[0] == 0:
                cosine = f"$$C_{{{index}}} = {formula(each.coefficients[2] / each.coefficients[1])}$$"
                root = f"\\sqrt{{1 - C_{{{index}}}^2}}"
                return f"{cosine}\n\n$${name} = \\pm \\mathrm{{atan2}}\\left({root},\\, C_{{{index}}}\\right)$$"
            return f"{given}\n\n$${name} = \\mathrm{{atan2}}(X, Y) \\pm \\mathrm{{atan2}}\\left(\\sqrt{{X^2 + Y^2 - Z^2}},\\, Z\\right)$$"
    return _pair(each, index, name)


def _pair(each: Solved, index: str, name: str) -> str:
    """Type 3: both rows, and sine and cosine where each row holds one of them."""
    X1, Y1, Z1, X2, Y2, Z2 = each.coefficients
    if X1 == Y2 == 0 or X2 == Y1 == 0:
        (sine, over), (cosine, under) = ((Z2, X2), (Z1, Y1)) if X1 == 0 else ((Z1, X1), (Z2, Y2))
        quotients = f"S_{{{index}}} = {formula(sine / over)}$$\n\n$$C_{{{index}}} = {formula(cosine / under)}"
        return f"$${quotients}$$\n\n$${name} = \\mathrm{{atan2}}(S_{{{index}}}, C_{{{index}}})$$"
    S, C = (sp.Symbol(f"{letter}_{_index(each.unknown)}") for letter in "SC")
    rows = [f"{formula(X * S + Y * C)} = {formula(Z)}" for X, Y, Z in ((X1, Y1, Z1), (X2, Y2, Z2))]
    return "\n\n".join(
        [
            *(f"$${row}$$" for row in rows),
            f"two linear equations for $S_{{{index}}}$ and $C_{{{index}}}$ (type 3): $${name} = \\mathrm{{atan2}}(S_{{{index}}}, C_{{{index}}})$$",
        ]
    )


def _end(setting: Setting, steps: Sequence[Step]) -> Iterator[str]:
    offsets = [
        f"${sp.latex(joint)} = {formula(sign * (unknown - offset))}$"
        for unknown, (joint, sign, offset) in zip(setting.unknowns, setting.joints)
        if offset != 0 or sign != 1
    ]
    if offsets:
        yield "The joints are " + ", ".join(offsets) + "; the others are the angles and lengths themselves."
    two = sum(each.helper in ("type2", "quadratic") for step in steps for each in step.solved)
    yield (
        f"{two} of the equations have two solutions: there are at most {2**two} postures. Those that the direct model does "
        "not confirm are left out; where both factors of a sine and a cosine vanish, the angle is free."
    )
