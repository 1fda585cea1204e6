"""The wire format: how an answer leaves the notebook as plain JSON data.

A node is one of

======================  =====================================================
JSON                    meaning
======================  =====================================================
number, true, false     a finite float, a small integer, a truth value
string                  text
array                   list, tuple, set, NumPy array or SymPy matrix (nested)
``{"blank": true}``     not attempted: ``...`` or ``None``
``{"int": "123"}``      an integer beyond 2**53
``{"float": "nan"}``    ``nan``, ``inf`` or ``-inf``
``{"complex": [r, i]}`` a complex number
``{"rat": [p, q]}``     the fraction p / q
``{"const": "pi"}``     ``pi``, ``E`` or ``I``
``{"sym": "t1"}``       a symbol
``{"call": [f, ...]}``  ``add``, ``mul``, ``pow`` or one of `FUNCTIONS`, then its arguments
``{"dict": [[k, v]]}``  a dictionary, keys as text
``{"function": name}``  something that can be called
``{"unknown": type}``   any other object, only its type is told
======================  =====================================================

The grader reads this format with a parser of its own that trusts nothing here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from numbers import Integral, Rational, Real

import numpy as np
import sympy

MIME = "application/vnd.dhkit.answer+json"
FORMAT = 1

FUNCTIONS = ("sin", "cos", "tan", "cot", "sec", "csc", "asin", "acos", "atan", "acot", "atan2",
             "exp", "log", "Abs", "sign", "Max", "Min", "Mod")  # fmt: skip

_MAX_TEXT = 1000
_MAX_DIGITS = 300
_SAFE_INTEGER = 2**53
_CONSTANTS = {sympy.pi: "pi", sympy.E: "E", sympy.I: "I"}


def packet(question: str, **content) -> dict:
    """The JSON object displayed under `MIME` for one question: ``answer`` or ``probes``, and perhaps the ``student`` typed."""
    return {"format": FORMAT, "question": question, **content}


def encode(value) -> object:
    """The node of any Python object a student may hand in (see the table above)."""
    if value is None or value is Ellipsis:
        return {"blank": True}
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    if isinstance(value, str):
        return str(value)[:_MAX_TEXT]
    if isinstance(value, sympy.Basic):
        return _symbolic(value)
    if isinstance(value, (sympy.MatrixBase, np.ndarray)):
        return encode(value.tolist())
    if isinstance(value, (int, Integral)):
        return _integer(int(value))
    if isinstance(value, (Fraction, Rational)):
        return {"rat": [_integer(value.numerator), _integer(value.denominator)]}
    if isinstance(value, (float, Real)):
        return _real(float(value))
    if isinstance(value, complex):
        return {"complex": [_real(value.real), _real(value.imag)]}
    if isinstance(value, Mapping):
        return {"dict": [[str(key)[:_MAX_TEXT], encode(item)] for key, item in value.items()]}
    if isinstance(value, (list, tuple, set, frozenset)):
        return [encode(item) for item in value]
    if callable(value):
        return {"function": getattr(value, "__name__", type(value).__name__)[:_MAX_TEXT]}
    return _unknown(value)


def _unknown(value) -> dict:
    kind = type(value)
    return {"unknown": f"{kind.__module__}.{kind.__qualname__}"[:_MAX_TEXT]}


def _integer(value: int) -> object:
    if abs(value) <= _SAFE_INTEGER:
        return value
    if value.bit_length() > _MAX_DIGITS * 3:
        return {"unknown": "an integer of more than a few hundred digits"}
    return {"int": str(value)}


def _real(value: float) -> object:
    return value if math.isfinite(value) else {"float": str(value)}


def _symbolic(value: sympy.Basic) -> object:
    if isinstance(value, sympy.MatrixBase):
        return encode(value.tolist())
    if isinstance(value, sympy.MatrixExpr):
        explicit = value.as_explicit() if all(isinstance(n, (int, sympy.Integer)) for n in value.shape) else value
        return encode(explicit.tolist()) if isinstance(explicit, sympy.MatrixBase) else _unknown(value)
    if isinstance(value, sympy.NDimArray):
        return encode(value.tolist())
    if isinstance(value, sympy.Integer):
        return _integer(int(value))
    if isinstance(value, sympy.Rational):
        return {"rat": [_integer(int(value.p)), _integer(int(value.q))]}
    if isinstance(value, sympy.Float):
        return _real(float(value))
    if value in _CONSTANTS:
        return {"const": _CONSTANTS[value]}
    if value in (sympy.oo, -sympy.oo, sympy.nan, sympy.zoo):
        return {"float": {sympy.oo: "inf", -sympy.oo: "-inf"}.get(value, "nan")}
    if isinstance(value, sympy.Symbol):
        return {"sym": value.name[:_MAX_TEXT]}
    if isinstance(value, sympy.Tuple):
        return [encode(item) for item in value]
    if isinstance(value, (sympy.Add, sympy.Mul, sympy.Pow)):
        return {"call": [type(value).__name__.lower(), *map(encode, value.args)]}
    if isinstance(value, sympy.exp):
        return {"call": ["exp", *map(encode, value.args)]}
    if isinstance(value, (sympy.Function, sympy.Max, sympy.Min)) and type(value).__name__ in FUNCTIONS:
        return {"call": [type(value).__name__, *map(encode, value.args)]}
    if isinstance(value, sympy.UnevaluatedExpr):
        return encode(value.args[0])
    if isinstance(value, sympy.logic.boolalg.BooleanAtom):
        return bool(value)
    return _unknown(value)
