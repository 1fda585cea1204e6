"""Who reads the notebook: somebody before it, or readers of a site."""

from __future__ import annotations

import os
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


def is_for_a_site() -> bool:
    """Whether what moves should come along as data for pages without a kernel: the builder of a site says so."""
    return os.environ.get("DHKIT_SCENES") == "embedded"
