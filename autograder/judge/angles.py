"""Constant angles that were rounded, in decoded expressions (see `dhkit.angles`)."""

from __future__ import annotations

from dhkit.angles import ENOUGH, FEWEST, cosine, half_turns

from .decode import Call, Constant, Expression, Number

__all__ = ["ENOUGH", "FEWEST", "meant"]


def meant(expression: Expression, decimals: int = ENOUGH) -> Expression:
    """`expression` with exact numbers in place of those given to at least so many decimals."""
    match expression:
        case Number(float() as value):
            if (turns := half_turns(value, decimals)) is not None:
                return Call("mul", (Number(turns), Constant("pi")))
            return expression if (exact := cosine(value, decimals)) is None else Number(exact)
        case Call(function, args):
            exact_args = tuple(meant(arg, decimals) for arg in args)
            return expression if exact_args == args else Call(function, exact_args)
    return expression
