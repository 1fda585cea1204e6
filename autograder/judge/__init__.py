"""Answers in, verdicts out.

`judge` compares what a student handed in with a question's reference and response tree. It works on data
only: nothing of a student's is executed here.
"""

from dhkit.wire import MIME

from .decode import Malformed
from .question import Family, Follow, Mistake, Question, mistake
from .tree import Verdict, is_forgivable
from .verdict import Evidence, judge
from .written import plain

__all__ = [
    "MIME",
    "Evidence",
    "Family",
    "Follow",
    "Malformed",
    "Mistake",
    "Question",
    "Verdict",
    "is_forgivable",
    "judge",
    "mistake",
    "plain",
]
