"""Writes a new exercise from a robot's table: the public and the private half of its questions, and the solution notebook."""

from .exercise import Written, write_exercise

__all__ = ["Written", "write_exercise"]
