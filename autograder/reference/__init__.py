"""Reference solver: modified DH tables, direct and inverse models of the course's robots."""

from .tables import ClassicTable, DHRow, DHTable

__all__ = ["ClassicTable", "DHRow", "DHTable"]
