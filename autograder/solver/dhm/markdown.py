"""What notebooks show typeset: tables in Markdown, with numbers in the units that are asked for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import sympy as sp

DEGREES = (180 / sp.pi, r"^\circ")
MILLIMETRES = (sp.Integer(1000), r"\,\mathrm{mm}")


class Markdown(str):
    """A text in Markdown, which notebooks show typeset."""

    def _repr_markdown_(self) -> str:
        return str(self)


def table(heads: Sequence[object], rows: Iterable[Sequence[object]]) -> str:
    """A table in Markdown."""
    head, *body = ("| " + " | ".join(map(str, cells)) + " |" for cells in (heads, *rows))
    return "\n".join([head, "|" + "---|" * len(heads), *body])


def latex(expression: sp.Expr) -> str:
    """An expression as a formula; t1, t2, ... are angles theta_1, theta_2, ..."""
    names = {
        s: s.name.replace("t", r"\theta_", 1)
        for s in expression.free_symbols
        if s.name[0] == "t" and s.name[1:].isdigit()
    }
    return sp.latex(expression, symbol_names=names)


def in_unit(expression: sp.Expr, unit: tuple[sp.Expr, str]) -> str:
    """An expression as a formula whose constant part is a number of units, given by its factor and its sign."""
    factor, sign = unit
    symbols = expression.free_symbols
    constant, rest = expression.as_independent(*symbols, as_Add=True) if symbols else (expression, sp.S.Zero)
    number = f"{float(constant * factor):.6g}{sign}"
    if not rest:
        return number
    return latex(rest) + ("" if not constant else f" {number}" if constant < 0 else f" + {number}")
