"""Seals the grader's verdicts for the students' copies: who makes an answer can open what is said of it.

`seal` writes the envelopes that `dhkit.home` opens, `plausible` decides which answers are worth sealing: those that
nobody finds by trying.
"""

from .seal import Decision, decisions, seal_exercise

__all__ = ["Decision", "decisions", "seal_exercise"]
