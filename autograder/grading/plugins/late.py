"""nbgrader's penalty for being late, as ``term.toml`` says it; nbgrader's own where it says nothing."""

from __future__ import annotations

from pathlib import Path

from nbgrader.plugins import LateSubmissionPlugin

from ..term import read_term


class TermPenalty(LateSubmissionPlugin):
    """A share of the points for each day that has begun."""

    def late_submission_penalty(self, student_id: str, score: float, total_seconds_late: float) -> float | None:
        late = read_term(Path(self.parent.parent.coursedir.root)).late
        if late is None:
            return super().late_submission_penalty(student_id, score, total_seconds_late)
        return round(late.penalty(score, total_seconds_late), 2)
