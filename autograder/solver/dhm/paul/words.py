"""A derivation in words and formulas, as the slides write one: C_23 for cos(theta_2 + theta_3), matrices iTj."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import groupby

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


_SEEN = re.compile(r"[snaP]_[xyz]_\d+").fullmatch


def written(setting: Setting, steps: Sequence[Step], why: str) -> str:
    """The derivation in Markdown."""
    parts = [f"## Inverse model of {setting.name or 'the robot'}", *_given(setting)]
    if len(steps) > 1:
        order = (", ".join(f"${formula(each)}$" for each in sorted(step.unknowns, key=str)) for step in steps)
        parts.append(f"In this order: {'; '.join(order)}.")
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
    names = {s: _name(s) for s in shown.free_symbols if s.name.startswith(("C_", "S_", "theta_")) or _SEEN(s.name)}
    return sp.latex(shown, symbol_names=names)


def _index(symbol: sp.Symbol) -> str:
    return symbol.name.partition("_")[2]


def _name(symbol: sp.Symbol) -> str:
    """A symbol in LaTeX: C_23, theta_2, or an entry of the pose with the frame that it is seen from."""
    if symbol.name[:2] in ("C_", "S_") or symbol.name.startswith("theta_"):
        letter = symbol.name[0] if symbol.name[0] in "CS" else "\\theta"
        return f"{letter}_{{{_index(symbol)}}}".replace("m", "-")
    entry, axis, frame = symbol.name.split("_")
    return f"\\;{{}}^{{{frame}}}{entry}_{{{axis}}}"  # the space keeps the frame apart from a factor before it


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
    yield from _seen(step, point)
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
        gone = next(each.unknown for each in step.solved if each.helper == "type3")
        yield f"Squared and added, they hold no ${formula(gone)}$ any more:"
    for each in step.solved:
        yield _solved(each)


def _seen(step: Step, point: bool) -> Iterator[str]:
    """What the pose is seen from later frames, as far as the step needs it."""
    for frame, several in groupby(step.seen, key=lambda each: each[0].name.rpartition("_")[2]):
        pose = "P" if point else "U_0"
        yield f"Seen from frame {frame}, the pose is ${{}}^{{{frame}}}T_0\\,{pose}$; in it"
        for name, entry in several:
            yield f"$${formula(name)} = {formula(entry)}$$"


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
    both = [_positive(row) for row in ((X1, Y1, Z1), (X2, Y2, Z2))]
    rows = [f"$${formula(X * S + Y * C)} = {formula(Z)}$$" for X, Y, Z in both]
    result = [f"$${name} = \\mathrm{{atan2}}(S_{{{index}}}, C_{{{index}}})$$"]
    said = f"two linear equations for $S_{{{index}}}$ and $C_{{{index}}}$ (type 3)"
    (B2, B1, Z1), (X2, Y2, Z2) = both
    sense = next((sense for sense in (1, -1) if sp.expand(X2 - sense * B1) == sp.expand(Y2 + sense * B2) == 0), 0)
    if not sense:
        return "\n\n".join([*rows, said + ":", *result])
    z1, z2 = formula(Z1), formula(sense * Z2)
    solution = [
        f"$$B_1 = {formula(B1)},\\quad B_2 = {formula(B2)}$$",
        f"$$Z_1 = {z1},\\quad Z_2 = {z2}$$",
        f"$$C_{{{index}}} = \\frac{{B_1 Z_1 - B_2 Z_2}}{{B_1^2 + B_2^2}},\\quad "
        f"S_{{{index}}} = \\frac{{B_2 Z_1 + B_1 Z_2}}{{B_1^2 + B_2^2}}$$",
    ]
    return "\n\n".join([*rows, said + ", with the solution", *solution, *result])


def _positive(row: tuple[sp.Expr, ...]) -> tuple[sp.Expr, ...]:
    """Both sides of an equation with the sign that reads better."""
    minus = [part.could_extract_minus_sign() for part in row if part != 0]
    return tuple(-part for part in row) if 2 * sum(minus) > len(minus) else row


def _end(setting: Setting, steps: Sequence[Step]) -> Iterator[str]:
    offsets = [
        f"${_joint(joint, unknown, place)} = {formula(sign * (unknown - offset))}$"
        for place, (unknown, (joint, sign, offset)) in enumerate(zip(setting.unknowns, setting.joints), start=1)
        if offset != 0 or sign != 1
    ]
    if offsets:
        yield "The joints are " + ", ".join(offsets) + "; the others are the angles and lengths themselves."
    two = sum(each.helper in ("type2", "quadratic") for step in steps for each in step.solved)
    many = {
        0: "No equation has two solutions: there is at most 1 posture",
        1: "One equation has two solutions: there are at most 2 postures",
    }
    yield (
        f"{many.get(two, f'{two} of the equations have two solutions: there are at most {2**two} postures')}. Those that the "
        "direct model does not confirm are left out; where both factors of a sine and a cosine vanish, the angle is free."
    )


def _joint(joint: sp.Symbol, unknown: sp.Symbol, place: int) -> str:
    """A joint's name in LaTeX; q_i where the row's variable has the same one."""
    name = sp.latex(joint)
    return f"q_{{{place}}}" if name == formula(unknown) else name
