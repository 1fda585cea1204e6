"""A trial notebook: shows that the sandbox can run what students' notebooks need, before any of them is blamed.

It imports what the released notebooks import and hands in one answer. Where it fails, the machine is at fault and
nobody is graded. It runs before a class is graded, and again after a notebook that failed for no reason one can see.
"""

from __future__ import annotations

import ast
import math
import shutil
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from nbformat.notebooknode import NotebookNode
from nbformat.v4 import new_code_cell, new_notebook

from autograder.sandbox import KernelStartError, Limits, SandboxUnavailable, read_folders, run_notebook
from dhkit.public import questions as public_questions

from ..cells import check_cells, question_id
from ..folders import released_notebook
from .execution import Mode, last_packet

_ALWAYS = ("import numpy", "import sympy", "import matplotlib.pyplot", "import ipywidgets", "import dhkit")
_LONGEST = 60  # seconds that a trial is made to last at most


def trial_notebook(released: Iterable[NotebookNode], lasting: float = 0.0) -> NotebookNode:
    """Return a notebook that needs of the sandbox what the `released` notebooks need.

    Parameters
    ----------
    released : iterable of NotebookNode
    lasting : float
        Seconds that its kernel must stay alive at least.
    """
    imports = dict.fromkeys(_ALWAYS)
    checks: list[str] = []
    for nb in released:
        for cell in nb.cells:
            if cell.cell_type == "code":
                imports |= dict.fromkeys(_imports(cell.source))
        checks += map(question_id, check_cells(nb))
    sources = list(imports)
    if known := [check for check in checks if check in public_questions()]:
        sources.append(f"from dhkit import check\ncheck({known[0]!r}, [0.5])")
    if lasting:
        sources.insert(0, f"import time\ntime.sleep({math.ceil(min(lasting, _LONGEST))})")
    return new_notebook(cells=[new_code_cell(source) for source in sources])


def _imports(source: str) -> list[str]:
    """The import statements of a cell that are always carried out."""
    try:
        statements = ast.parse(source).body
    except SyntaxError:  # a magic command
        return []
    return [ast.unparse(statement) for statement in statements if isinstance(statement, ast.Import | ast.ImportFrom)]


def find_fault(
    released: Iterable[Path],
    limits: Limits,
    mode: Mode,
    hidden: tuple[Path, ...] = (),
    lasting: float = 0.0,
    warm: bool = True,
) -> str | None:
    """Run a trial notebook, once more if it fails.

    Parameters
    ----------
    released : iterable of Path
        The released notebooks; the files beside each are there in the trial, too.
    limits, mode, hidden
        As for students' notebooks, see `execution.execute`.
    lasting : float
        Seconds that its kernel must stay alive at least.
    warm : bool
        Whether its kernel may share a parent with others.

    Returns
    -------
    str or None
        What is wrong with this machine and what to do, in a sentence; None if all went well.
    """
    paths = list(released)
    nb = trial_notebook(map(released_notebook, paths), lasting)
    files, _ = read_folders((path.parent for path in paths), limits.disk // 2)
    settings = (nb, files, limits, mode, hidden, warm)
    return _fault(*settings) and _fault(*settings)


def find_fault_once(released: Sequence[Path], limits: Limits, mode: Mode, hidden: tuple[Path, ...]) -> str | None:
    """Like `find_fault`, without trying again what went well a moment ago in this process."""
    key = (*((path, path.stat().st_mtime_ns) for path in released), limits, mode, hidden, shutil.which("bwrap"))
    if key not in _went_well:
        if fault := find_fault(released, limits, mode, hidden):
            return fault
        _went_well.add(key)
    return None


_went_well: set[tuple] = set()


def _fault(
    nb: NotebookNode, files: Mapping[str, bytes], limits: Limits, mode: Mode, hidden: tuple[Path, ...], warm: bool
) -> str | None:
    try:
        run = run_notebook(nb, files=files, limits=limits, mode=mode, hidden=hidden, warm=warm)
    except SandboxUnavailable as error:
        return f"no sandbox: {error}"
    except KernelStartError as error:
        return f"a trial notebook could not be run: {error}; run: autograder doctor"
    except OSError as error:
        return f"a trial notebook could not be run: {error}"
    for index, cell in sorted(run.cells.items()):
        source = nb.cells[index].source.splitlines()[-1]
        if cell.status == "error":
            return (
                f"students' notebooks need what this machine cannot do in the sandbox: {source} ({cell.message});"
                f" install it for {sys.executable}, for example with: make setup"
            )
        if cell.status != "ok":
            return (
                f"a trial notebook did not get through {source} ({cell.status}: {cell.message}); run: autograder doctor"
            )
    last = max(run.cells, default=None)
    if last is not None and "check(" in nb.cells[last].source and last_packet(run.cells[last].outputs) is None:
        return f"dhkit handed in nothing in a trial notebook: {nb.cells[last].source.splitlines()[-1]}; run: make setup"
    return None
