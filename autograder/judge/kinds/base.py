"""What the kinds of answer share: how two answers compare, and what a comparison must know."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from dhkit.forms.dh_table import DH_COLUMNS


@dataclass(frozen=True)
class Comparison:
    """How two answers compare: equal or not, the share of parts that agree, and what differs, in words.

    `note` is the answer note of a difference that has a name of its own; `slip` says that all but one row, or one entry,
    agree; `aside` is a sentence for somebody whose answer is right all the same.
    """

    equal: bool
    share: float
    remarks: tuple[str, ...] = ()
    note: str = ""
    slip: bool = False
    aside: str = ""


@dataclass(frozen=True)
class Setting:
    """What a comparison needs to know besides the two answers.

    Attributes
    ----------
    samples : mapping of str to (N,) array
        Values of the symbols at the sample points.
    angles : tuple of int
        Indices of the vector entries (or () and (0,) for a single expression) that are angles, compared modulo 2 pi.
    tolerance : float
        Largest difference that still counts as equal, relative to the larger of 1 and the reference's size; metres
        for a point cloud.
    pinned : set of str
        Freedoms of the DHm convention that a right table may not use (see `chain.same_chain`).
    turn : float
        A full turn in the unit of the joint angles: 2 pi, or 360 where both answers are in degrees.
    patient : bool
        Whether an entry that differs in float64 gets the benefit of forty digits: asked for against the reference,
        where rounding must not fail a right answer.
    residual : callable, optional
        How far joint solutions (k, n) are from the target, (k,), in metres and radians.
    position_share : float
        Share of the position among the parts of a transform.
    columns : tuple of str
        The letters over the columns of a DHm table.
    family : bool
        Infinitely many solutions: every one that does not miss the target is right.
    slack : float or array
        By how much more each number of the student's answer may be off, in its shape: it was rounded.
    """

    samples: Mapping[str, np.ndarray] = field(default_factory=dict)
    angles: tuple[int, ...] = ()
    tolerance: float = 1e-6
    pinned: frozenset[str] = frozenset()
    turn: float = 2 * np.pi
    patient: bool = False
    residual: Callable[[np.ndarray], np.ndarray] | None = None
    position_share: float = 0.5
    columns: tuple[str, ...] = DH_COLUMNS
    family: bool = False
    slack: np.ndarray | float = 0.0


@dataclass(frozen=True)
class Kind:
    """A kind of answer as the judge sees it: the two functions of its module (see the package's docstring)."""

    read: Callable[[Any, Any], Any]
    compare: Callable[[Any, Any, Any, Setting], Comparison]
