"""dhkit: the student kit of the modified Denavit-Hartenberg course.

``check("scara.T04", answer)`` hands an answer in, ``hint("scara.T04")`` helps, ``dhkit.drawing`` draws.
"""

from .check import check, hint

__all__ = ["check", "hint"]
