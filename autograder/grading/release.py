"""Makes the students' notebooks from the solutions: ``nbgrader generate_assignment`` for one exercise or all."""

from __future__ import annotations

from nbgrader.converters import GenerateAssignment

from .course import Course, convert


def release(course: Course, exercise: str) -> str:
    """Write ``exercises/<exercise>`` and enter it in the gradebook; returns the folder.

    Raises
    ------
    CourseError
        If there is no such solution, or its cells changed while submissions depend on them.
    """
    course.choose(exercise)
    converter = GenerateAssignment(coursedir=course.app.coursedir, parent=course.app)
    converter.force = True
    convert(converter)
    return str(course.step("release", ".", exercise))
