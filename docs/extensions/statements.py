"""Exercises as statements: what a copy without answers would print below its questions is left out."""

import json

from sphinx.application import Sphinx


def without_verdicts(notebook: dict) -> dict:
    """The notebook with tags that hide outputs from each cell for an answer to the cell that hands it in."""
    waits = False  # for the check of an answer
    for cell in notebook["cells"]:
        marks = cell["metadata"].get("nbgrader", {})
        waits |= bool(marks.get("solution")) and cell["cell_type"] == "code"
        if waits and cell["cell_type"] == "code":
            cell["metadata"].setdefault("tags", []).append("remove-output")
        waits &= not marks.get("grade")
    return notebook


def read(app: Sphinx, page: str, source: list[str]) -> None:
    if page.startswith("exercises/"):
        source[0] = json.dumps(without_verdicts(json.loads(source[0])))


def setup(app: Sphinx) -> dict:
    app.connect("source-read", read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
