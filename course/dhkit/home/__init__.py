"""The verdict at home: right, wrong and why, without a network and without the answer in any file.

When an exercise is released, each right answer and each mistake with a name is locked under a key that is made from that
answer itself (``autograder.sealing``). The student's own answer makes the same key, or none that opens anything.
`verdict` asks, `progress` counts, `practice` gives other numbers to try with.
"""

from .practice import Practice, practice
from .progress import Progress, progress
from .verdict import Verdict, verdict

__all__ = ["Practice", "Progress", "Verdict", "practice", "progress", "verdict"]
