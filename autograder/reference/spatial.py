"""Inverse models of the elbow arms: axis 1 upright, axes 2 and 3 parallel, then a wrist.

One closed form serves RX-90, KR210, the EPFL arm, the elbow arm and the PUMA-like arm of the
DH-m slides and the repaired pen robot: each is only a DHm table. Seen from frame 1 the arm is
a two-link arm in a plane that stands beside axis 1 at a lateral offset.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .inverse import Answer, InverseModel, JointMap
from .planar import (
    FOLDED,
    FREE_FIRST,
    FREE_LINE,
    FREE_PLANE,
    FOLDED_LINE,
    SIDEWAYS,
    STRETCHED,
    shoulder,
    two_link,
    unit,
)
