"""DH tables as questions ask for them."""

from __future__ import annotations

from autograder.reference import DHTable


def list_rows(table: DHTable) -> list[list]:
    """The rows ``[sigma, a, alpha, d, theta]`` of a table, joints only."""
    return [[row.sigma, *row.parameters] for row in table.rows]
