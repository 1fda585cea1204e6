"""A variable that a student calls ``check`` takes the kit's name from no check cell."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping
from functools import partial

_ABOUT_A_QUESTION = re.compile(r"""\s*(\w+)\(["']\w+\.\w+["']""")


def keep(names: Mapping[str, Callable]) -> None:
    """In Jupyter, let a cell that begins with ``check("scara.T04"`` find the kit's own function under each of these names."""
    # Where IPython is not loaded there are no cells; loading it takes long.
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    if shell is not None:
        shell.events.register("pre_run_cell", partial(_bring_back, shell.user_ns, names))


def _bring_back(namespace: dict[str, object], names: Mapping[str, Callable], info: object) -> None:
    called = _ABOUT_A_QUESTION.match(str(getattr(info, "raw_cell", "")))
    if called is not None and called[1] in names:
        namespace[called[1]] = names[called[1]]
