"""Makes the students' notebooks from the solutions: ``nbgrader generate_assignment`` for one exercise."""

from __future__ import annotations

from .course import Course, convert
from .exercise import Changes
from .plugins.assignment import AssignmentRelease


def release(course: Course, exercise: str) -> Changes:
    """Write ``exercises/<exercise>`` and enter it in the gradebook, both or neither.

    Raises
    ------
    CourseError
        If there is no such solution, or it cannot be released.
    """
    course.choose(exercise)
    converter = AssignmentRelease(coursedir=course.app.coursedir, parent=course.app)
    converter.force = True
    convert(converter)
    return converter.changes
