"""Named edits that turn a solution notebook into what a student hands in.

A notebook is plain JSON data here, because some edits break it on purpose; a submission is a mapping of file
names to contents. Every edit is a pure function: it returns a changed copy. Cells are named by their nbgrader id
(``"scara-T04"`` is a check cell, ``"scara-T04-answer"`` its answer).
"""

from __future__ import annotations

import ast
import json
from copy import deepcopy

BEGIN, END = "### BEGIN SOLUTION", "### END SOLUTION"
STUB = "# your code here"
TEXT_STUB = "YOUR ANSWER HERE"

Notebook = dict
Files = dict[str, bytes]


def solved(nb: Notebook) -> Notebook:
    """The notebook of a student whose answers are the instructor's: the marks of the solution are gone."""
    return _each_source(nb, lambda line: [] if line.strip() in (BEGIN, END) else [line])


def released(nb: Notebook) -> Notebook:
    """The notebook as the class gets it: a stub stands in the place of each solution."""
    inside = False

    def stub(line: str) -> list[str]:
        nonlocal inside
        if line.strip() == BEGIN:
            inside = True
            return [line[: len(line) - len(line.lstrip())] + STUB]
        shown = [] if inside else [line]
        inside = inside and line.strip() != END
        return shown

    nb = _each_source(nb, stub)
    for cell in nb["cells"]:
        if cell["cell_type"] == "markdown" and cell["metadata"].get("nbgrader", {}).get("solution"):
            cell["source"] = TEXT_STUB
    return nb


def undrawn(nb: Notebook) -> Notebook:
    """The notebook without the cells that only draw: they give no name to anything, so that no answer depends on them."""
    return nb | {"cells": [cell for cell in nb["cells"] if not _only_draws(cell)]}


def _only_draws(cell: dict) -> bool:
    if cell["cell_type"] != "code" or grade_id(cell):
        return False
    statements = ast.parse(_source(cell)).body
    calls = [one.value.func for one in statements if isinstance(one, ast.Expr) and isinstance(one.value, ast.Call)]
    names = [called.id for called in calls if isinstance(called, ast.Name)]
    return len(names) == len(statements) > 0 and all(name.startswith(("draw_", "show_")) for name in names)


def signed(nb: Notebook, student: str) -> Notebook:
    """The notebook with the student's id typed in, where the exercise asks for it."""
    blank = "student = ..."
    return _each_source(
        nb, lambda line: [line.replace(blank, f"student = {student!r}", 1) if line.startswith(blank) else line]
    )


def answer(nb: Notebook, source: Notebook, cell: str, code: str) -> Notebook:
    """Answer as a student does: `code` takes the place of the stub, or of the whole cell where that is a function."""
    stub = released(source)["cells"][position(source, cell)]["source"]
    return write(nb, cell, code if stub.startswith("def ") else stub.replace(STUB, code))


def _each_source(nb: Notebook, change) -> Notebook:
    nb = deepcopy(nb)
    for cell in nb["cells"]:
        lines = _source(cell).split("\n")
        cell["source"] = "\n".join(kept for line in lines for kept in change(line))
    return nb


def _source(cell: dict) -> str:
    return cell["source"] if isinstance(cell["source"], str) else "".join(cell["source"])


def grade_id(cell: dict) -> str | None:
    return cell["metadata"].get("nbgrader", {}).get("grade_id")


def position(nb: Notebook, cell: str) -> int:
    """Index of the cell with this nbgrader id; `LookupError` lists the ids there are."""
    ids = [grade_id(found) for found in nb["cells"]]
    if cell not in ids:
        raise LookupError(f"there is no cell {cell!r}; there are {', '.join(filter(None, ids))}")
    return ids.index(cell)


def code_cell(id: str, source: str) -> dict:
    return {"cell_type": "code", "id": id, "metadata": {}, "execution_count": None, "outputs": [], "source": source}


# ---------------------------------------------------------------- edits of a notebook


def write(nb: Notebook, cell: str, source: str) -> Notebook:
    """Give a cell another source."""
    nb = deepcopy(nb)
    nb["cells"][position(nb, cell)]["source"] = source
    return nb


def insert(nb: Notebook, source: str, before: str | None = None, after: str | None = None) -> Notebook:
    """Insert a code cell before or after another one, or at the very end."""
    nb = deepcopy(nb)
    place = position(nb, before) if before else position(nb, after) + 1 if after else len(nb["cells"])
    nb["cells"].insert(place, code_cell(f"own-{len(nb['cells'])}", source))
    return nb


def insert_first(nb: Notebook, source: str) -> Notebook:
    """Insert a code cell at the very beginning, before anything is imported."""
    nb = deepcopy(nb)
    nb["cells"].insert(0, code_cell(f"own-{len(nb['cells'])}", source))
    return nb


def delete(nb: Notebook, cell: str) -> Notebook:
    nb = deepcopy(nb)
    del nb["cells"][position(nb, cell)]
    return nb


def duplicate(nb: Notebook, cell: str, source: str | None = None) -> Notebook:
    """Copy a cell, nbgrader id included, right behind itself, with another source if one is given."""
    nb = deepcopy(nb)
    place = position(nb, cell)
    copy = deepcopy(nb["cells"][place])
    copy["id"] = f"{copy['id'][:50]}-copy"
    copy["source"] = copy["source"] if source is None else source
    nb["cells"].insert(place + 1, copy)
    return nb


def move(nb: Notebook, cell: str, before: str | None = None) -> Notebook:
    """Move a cell before another one, or to the very end."""
    nb = deepcopy(nb)
    moved = nb["cells"].pop(position(nb, cell))
    nb["cells"].insert(position(nb, before) if before else len(nb["cells"]), moved)
    return nb


def set_metadata(nb: Notebook, cell: str, **values) -> Notebook:
    """Replace entries of a cell's metadata; entries of a table are merged."""
    nb = deepcopy(nb)
    found = nb["cells"][position(nb, cell)]["metadata"]
    for key, value in values.items():
        found[key] = (
            {**found.get(key, {}), **value} if isinstance(value, dict) and isinstance(found.get(key), dict) else value
        )
    return nb


def break_nbgrader_metadata(nb: Notebook) -> Notebook:
    """Give every tracked cell one of several kinds of nbgrader metadata that nbgrader cannot read, ids kept."""
    nb = deepcopy(nb)
    tracked = [cell["metadata"]["nbgrader"] for cell in nb["cells"] if grade_id(cell)]
    for number, marks in enumerate(tracked):
        broken = (
            {"schema_version": 99},
            {"schema_version": "three", "points": "many"},
            {"grade": "yes", "solution": None, "locked": [], "points": -5},
            {"cell_type": "markdown", "checksum": 17},
        )
        marks.update(broken[number % len(broken)])
    return nb


def drop_nbgrader_metadata(nb: Notebook) -> Notebook:
    """Take the nbgrader metadata from every cell, as an editor may that does not know it."""
    nb = deepcopy(nb)
    for cell in nb["cells"]:
        cell["metadata"].pop("nbgrader", None)
    return nb


def forge_output(nb: Notebook, cell: str, data: dict) -> Notebook:
    """Store an output in a cell as if the cell had displayed it."""
    nb = deepcopy(nb)
    nb["cells"][position(nb, cell)]["outputs"] = [{"output_type": "display_data", "data": data, "metadata": {}}]
    return nb


def ask_for_kernel(nb: Notebook, name: str, language: str) -> Notebook:
    """Name another kernel in the notebook's metadata."""
    nb = deepcopy(nb)
    nb["metadata"]["kernelspec"] = {"name": name, "display_name": name, "language": language}
    return nb


NOTEBOOK_EDITS = {
    edit.__name__: edit
    for edit in (
        write,
        insert,
        insert_first,
        delete,
        duplicate,
        move,
        set_metadata,
        forge_output,
        break_nbgrader_metadata,
        drop_nbgrader_metadata,
        ask_for_kernel,
    )
}

# ---------------------------------------------------------------- edits of the files handed in


def as_file(nb: Notebook) -> bytes:
    return (json.dumps(nb, indent=1, ensure_ascii=False) + "\n").encode()


def rename(files: Files, old: str, new: str) -> Files:
    return {new if name == old else name: content for name, content in files.items()}


def remove(files: Files, name: str) -> Files:
    return {other: content for other, content in files.items() if other != name}


def cut_off(files: Files, name: str, keep: float) -> Files:
    """Keep only the first part of a file, as a broken upload does."""
    return {**files, name: files[name][: int(len(files[name]) * keep)]}


def replace_file(files: Files, name: str, text: str) -> Files:
    """Write a file, in the place of one that is there or beside the others."""
    return {**files, name: text.encode()}


FILE_EDITS = {edit.__name__: edit for edit in (rename, remove, cut_off, replace_file)}
