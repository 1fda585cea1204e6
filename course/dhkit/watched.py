"""Whether anybody sits before the notebook."""

from __future__ import annotations

import sys


def is_watched() -> bool:
    """Whether somebody sits before the notebook and could turn a robot or move a slider.

    Who runs one unattended (nbconvert, the grader) tells the kernel that nobody will answer its questions.
    """
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    kernel = getattr(shell, "kernel", None)
    if kernel is None:
        return False
    request = kernel.get_parent("shell") if hasattr(kernel, "get_parent") else {}
    return bool(request.get("content", {}).get("allow_stdin", True))
