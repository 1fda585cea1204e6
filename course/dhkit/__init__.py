"""dhkit: the student kit of the modified Denavit-Hartenberg course.

``check("scara.T04", answer)`` hands an answer in and says what can be said of it here, ``hint("scara.T04")`` helps,
``solution("scara.T04")`` unfolds once the answer is right, ``progress()`` counts, ``practice("scara.postures")`` gives
other numbers to try with, ``dhkit.drawing`` draws, ``dhkit.scene`` shows robots that can be turned and moved.
"""

from . import names
from .check import check, hint, solution
from .home import practice, progress

__all__ = ["check", "hint", "practice", "progress", "solution"]

names.keep({"check": check, "hint": hint, "practice": practice, "solution": solution})
