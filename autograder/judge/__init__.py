"""Answers in, verdicts out.

`judge` compares what a student handed in with a question's reference and response tree. It works on data
only: nothing of a student's is executed here.
"""

from dhkit.wire import MIME

from .decode import Malformed
from .question import Family, Follow, Made, Mistake, Question, Variant, mistake
from .verdict import Evidence, Verdict, is_forgivable, judge, plain

__all__ = [
    "MIME",
    "Evidence",
    "Family",
    "Follow",
    "Made",
    "Malformed",
    "Mistake",
    "Question",
    "Variant",
    "Verdict",
    "is_forgivable",
    "judge",
    "mistake",
    "plain",
]
