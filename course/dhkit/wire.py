"""The wire format: how an answer leaves the notebook as plain JSON data.

A node is one of

======================  =====================================================
JSON                    meaning
======================  =====================================================
number, true, false     a finite float, a small integer, a truth value
string                  text
array                   list, tuple, range, generator, NumPy array or SymPy matrix (nested)
``{"set": [...]}``      a set: as an array, in no order
``{"blank": true}``     not attempted: ``...`` or ``None``
``{"int": "123"}``      an integer beyond 2**53
``{"float": "nan"}``    ``nan``, ``inf`` or ``-inf``
``{"complex": [r, i]}`` a complex number
``{"rat": [p, q]}``     the fraction p / q
``{"const": "pi"}``     ``pi``, ``E`` or ``I``
``{"sym": "t1"}``       a symbol
``{"call": [f, ...]}``  ``add``, ``mul``, ``pow`` or one of `FUNCTIONS`, then its arguments; ``Piecewise``, then values
                        and conditions in turn (see `CONDITIONS`)
``{"dict": [[k, v]]}``  a dictionary, keys as text
``{"function": name}``  something that can be called
``{"large": words}``    what is beyond the bounds below, described only
``{"unknown": type}``   any other object, only its type is told
``{"error": words}``    a function that was probed raised an exception
======================  =====================================================

The grader reads this format with a parser of its own that trusts nothing here. The bounds are the same for both.
"""

from __future__ import annotations

import math
import traceback
from collections import deque
from collections.abc import ItemsView, Iterable, Iterator, KeysView, Mapping, ValuesView
from numbers import Integral, Rational, Real

import numpy as np
import sympy
from sympy.core.function import AppliedUndef

MIME = "application/vnd.dhkit.answer+json"
FORMAT = 1

MAX_NODES = 25_000
MAX_DEPTH = 60
MAX_DIGITS = 300
MAX_TEXT = 1000
MAX_ASSUMED = 50

FUNCTIONS = ("sin", "cos", "tan", "cot", "sec", "csc", "asin", "acos", "atan", "acot", "atan2",
             "exp", "log", "Abs", "sign", "re", "im", "arg", "conjugate", "floor", "ceiling", "Max", "Min", "Mod")  # fmt: skip

CONDITIONS = {"StrictLessThan": "lt", "LessThan": "le", "StrictGreaterThan": "gt", "GreaterThan": "ge", "Equality": "eq",
              "Unequality": "ne", "And": "and", "Or": "or", "Not": "not"}  # fmt: skip
"""SymPy's names of what may be a condition in a ``Piecewise``, and the wire's: 1 where it holds, else 0."""

ARITIES: dict[str, int | None] = {
    "add": None, "mul": None, "pow": 2, **dict.fromkeys(FUNCTIONS, 1), "atan2": 2, "Mod": 2, "Max": None, "Min": None,
    "Piecewise": None, **dict.fromkeys(CONDITIONS.values(), 2), "and": None, "or": None, "not": 1,
}  # fmt: skip
"""Number of arguments of everything that can be called; None for one or more."""

_SAFE_INTEGER = 2**53
_CONSTANTS = {sympy.pi: "pi", sympy.E: "E", sympy.I: "I"}


def packet(question: str, **content: object) -> dict[str, object]:
    """The JSON object displayed under `MIME` for one question: ``answer`` or ``probes``, perhaps the ``student``
    typed, and the symbols ``assumed`` to be positive."""
    return {"format": FORMAT, "question": question, **content}


def encode(value: object) -> object:
    """The node of any Python object a student may hand in (see the table above). Never raises."""
    return encode_with_assumptions(value)[0]


def encode_with_assumptions(value: object) -> tuple[object, list[str]]:
    """The node, and the names of the symbols declared positive: SymPy has simplified the answer with that."""
    encoder = _Encoder()
    try:
        return encoder.node(value), sorted(encoder.positive)[:MAX_ASSUMED]
    except _TooLarge as bound:
        return {"large": f"{_extent(value)}, {bound}"}, []


def failure(error: BaseException) -> str:
    """An exception in words, short: its type and its message."""
    return _text("".join(traceback.format_exception_only(error)).strip())[:300]


class _TooLarge(Exception):
    """The answer is beyond a bound; the message says which."""


class _Encoder:
    """Counts nodes and levels of one answer, so that an endless one ends here and not in the grader."""

    def __init__(self) -> None:
        self.left = MAX_NODES
        self.positive: set[str] = set()

    def node(self, value: object, depth: int = 0) -> object:
        self._count(1, depth)
        try:
            return self._encoded(value, depth)
        except _TooLarge:
            raise
        except Exception:  # a student's object may raise whatever it is asked
            return _unknown(value)

    def _encoded(self, value: object, depth: int) -> object:
        if value is None or value is Ellipsis:
            return {"blank": True}
        if isinstance(value, (bool, np.bool_)):
            return bool(value)
        if isinstance(value, str):
            return _text(value)
        if isinstance(value, sympy.Basic):
            return self._symbolic(value, depth)
        if isinstance(value, sympy.MatrixBase):
            self._expect(value.rows * value.cols)
            return self._entries(value.tolist(), depth)
        if isinstance(value, np.ndarray):
            self._expect(value.size)
            entries = value.tolist()
            return self._entries(entries, depth) if value.ndim else self._again(entries, depth)
        if isinstance(value, Integral):
            return _integer(int(value))
        if isinstance(value, Rational):
            return self._fraction(int(value.numerator), int(value.denominator), depth)
        if isinstance(value, Real):
            return _real(float(value))
        if isinstance(value, (complex, np.complexfloating)):
            self._count(2, depth + 1)
            return {"complex": [_real(float(value.real)), _real(float(value.imag))]}
        if isinstance(value, Mapping):
            self._expect(len(value))
            return {"dict": [[_text(str(key)), self.node(item, depth + 1)] for key, item in value.items()]}
        if isinstance(value, (set, frozenset)):
            self._expect(len(value))
            return {"set": self._entries(value, depth)}
        if isinstance(value, (list, tuple, range, deque, KeysView, ValuesView, ItemsView)):
            self._expect(len(value))
            return self._entries(value, depth)
        if isinstance(value, Iterator):
            return self._entries(value, depth)
        if callable(value):
            return {"function": _text(getattr(value, "__name__", type(value).__name__))}
        return _unknown(value)

    def _count(self, nodes: int, depth: int) -> None:
        self.left -= nodes
        if self.left < 0:
            raise _TooLarge(f"more than {MAX_NODES} parts")
        if depth > MAX_DEPTH:
            raise _TooLarge(f"nested more than {MAX_DEPTH} levels deep")

    def _expect(self, nodes: int) -> None:
        """Refuse what has more parts than are left before it is copied."""
        if nodes > self.left:
            raise _TooLarge(f"more than {MAX_NODES} parts")

    def _again(self, value: object, depth: int) -> object:
        """Another way to say what was counted already."""
        self.left += 1
        return self.node(value, depth)

    def _entries(self, values: Iterable, depth: int) -> list:
        return [self.node(value, depth + 1) for value in values]

    def _fraction(self, numerator: int, denominator: int, depth: int) -> object:
        self._count(2, depth + 1)
        parts = [_integer(numerator), _integer(denominator)]
        return next((part for part in parts if isinstance(part, dict) and "large" in part), {"rat": parts})

    def _call(self, name: str, value: sympy.Basic, depth: int) -> object:
        arity = ARITIES[name]
        if not value.args or (arity is not None and len(value.args) != arity):
            return _unknown(value)
        return {"call": [name, *self._entries(value.args, depth)]}

    def _symbolic(self, value: sympy.Basic, depth: int) -> object:
        if isinstance(value, sympy.MatrixBase):
            self._expect(value.rows * value.cols)
            return self._entries(value.tolist(), depth)
        if isinstance(value, sympy.MatrixExpr):
            if not all(isinstance(n, (int, sympy.Integer)) for n in value.shape):
                return _unknown(value)
            self._expect(int(value.rows * value.cols))
            explicit = value.as_explicit()
            return self._again(explicit, depth) if isinstance(explicit, sympy.MatrixBase) else _unknown(value)
        if isinstance(value, sympy.NDimArray):
            self._expect(len(value))
            return self._again(value.tolist(), depth)
        if isinstance(value, sympy.Integer):
            return _integer(int(value))
        if isinstance(value, sympy.Rational):
            return self._fraction(int(value.p), int(value.q), depth)
        if isinstance(value, sympy.Float):
            return _real(float(value))
        if value in _CONSTANTS:
            return {"const": _CONSTANTS[value]}
        if value in (sympy.oo, -sympy.oo, sympy.nan, sympy.zoo):
            return {"float": {sympy.oo: "inf", -sympy.oo: "-inf"}.get(value, "nan")}
        if isinstance(value, sympy.Symbol):
            if value.is_nonnegative:
                self.positive.add(_text(value.name))
            return {"sym": _text(value.name)}
        if isinstance(value, AppliedUndef) and type(value).__name__ not in FUNCTIONS and _is_of_time(value):
            return {"sym": _text(type(value).__name__)}
        if isinstance(value, sympy.Equality):
            return self._again(_solved(value), depth)
        if isinstance(value, sympy.Piecewise):
            parts = [
                part
                for piece in value.args
                for part in (self.node(piece.expr, depth + 1), self._condition(piece.cond, depth + 1))
            ]
            return {"call": ["Piecewise", *parts]}
        if isinstance(value, sympy.Tuple):
            return self._entries(value, depth)
        if isinstance(value, sympy.FiniteSet):
            return {"set": self._entries(value, depth)}
        if isinstance(value, sympy.Dict):
            return self._again(dict(value.items()), depth)
        if value is sympy.S.EmptySet:
            return {"set": []}
        if isinstance(value, (sympy.Add, sympy.Mul, sympy.Pow)):
            return self._call(type(value).__name__.lower(), value, depth)
        if isinstance(value, sympy.exp):
            return self._call("exp", value, depth)
        if isinstance(value, (sympy.Function, sympy.Max, sympy.Min)) and type(value).__name__ in FUNCTIONS:
            return self._call(type(value).__name__, value, depth)
        if isinstance(value, sympy.UnevaluatedExpr):
            return self._again(value.args[0], depth)
        if isinstance(value, sympy.logic.boolalg.BooleanAtom):
            return bool(value)
        if isinstance(value, (sympy.CRootOf, sympy.NumberSymbol)) or (
            isinstance(value, sympy.Function) and value.is_number
        ):
            return self._again(complex(value.evalf(17)) if value.is_real is False else float(value.evalf(17)), depth)
        return _unknown(value)

    def _condition(self, value: sympy.Basic, depth: int) -> object:
        self._count(1, depth)
        if isinstance(value, sympy.logic.boolalg.BooleanAtom):
            return bool(value)
        name = CONDITIONS.get(type(value).__name__)
        if name is None:
            return _unknown(value)
        part = self._condition if name in ("and", "or", "not") else self.node
        return {"call": [name, *(part(arg, depth + 1) for arg in value.args)]}


def _is_of_time(value: sympy.Basic) -> bool:
    """Whether an undefined function is a joint variable of ``dynamicsymbols``: of one symbol, the time."""
    return len(value.args) == 1 and isinstance(value.args[0], sympy.Symbol)


def _solved(equation: sympy.Equality) -> sympy.Basic:
    """What an equation says of its symbol, or of zero; else its right-hand side."""
    left, right = equation.lhs, equation.rhs
    said_backwards = right == 0 or isinstance(right, sympy.Symbol)
    return left if said_backwards and not isinstance(left, sympy.Symbol) else right


def _unknown(value: object) -> dict:
    kind = type(value)
    return {"unknown": _text(f"{kind.__module__}.{kind.__qualname__}" if kind.__module__ else kind.__qualname__)}


def _text(text: str) -> str:
    """`text` cut short, and without the half characters that no encoding can carry."""
    return str(text)[:MAX_TEXT].encode("utf-8", "replace").decode("utf-8")


def _integer(value: int) -> object:
    if abs(value) <= _SAFE_INTEGER:
        return value
    if value.bit_length() > MAX_DIGITS * 3:
        return {"large": "an integer of more than a few hundred digits"}
    return {"int": str(value)}


def _real(value: float) -> object:
    return value if math.isfinite(value) else {"float": str(value)}


def _extent(value: object) -> str:
    """How large an object is, in words."""
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple):
        return f"an array of shape {' x '.join(map(str, shape))}"
    if isinstance(value, (list, tuple, set, frozenset, Mapping)):
        return f"a list of {len(value)} entries"
    if isinstance(value, Iterator):
        return "a generator"
    return "an expression"
