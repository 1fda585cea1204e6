"""Runs the `autograder` command and tells what it cost and what it left behind.

python tests/sample_class/watched.py REPORT.json COMMAND ...
"""

from __future__ import annotations

import ctypes
import json
import resource
import sys
from pathlib import Path

import psutil

from autograder import cli
from autograder.grading import rendering
from autograder.sandbox import warm

OWN = (rendering.__name__, "multiprocessing.forkserver", "multiprocessing.resource_tracker")
ADOPT_ORPHANS = 36  # PR_SET_CHILD_SUBREAPER of prctl(2)


def adopt_orphans() -> None:
    """Make this process the parent of every descendant whose own parent ends: none can slip away unseen."""
    if sys.platform.startswith("linux"):
        ctypes.CDLL(None).prctl(ADOPT_ORPHANS, 1, 0, 0, 0)


def peak_memory() -> int:
    """Most bytes this process ever held, without its children."""
    status = Path("/proc/self/status")
    if not status.exists():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    # ru_maxrss would count what the parent held before this program was loaded.
    (line,) = (line for line in status.read_text().splitlines() if line.startswith("VmHWM:"))
    return int(line.split()[1]) << 10


def living_descendants() -> list[str]:
    """Command lines of the processes below this one that are not just waiting to be collected.

    Three are the grader's own, and end with it: what lays out pages, what processes of a crew are copies of, and what
    removes its files. The copies have ended, and look the same: one of each may be left.
    """
    children = psutil.Process().children(recursive=True)
    _, alive = psutil.wait_procs(children, timeout=5)
    left = [" ".join(child.cmdline()) for child in alive if child.status() != psutil.STATUS_ZOMBIE]
    for own in OWN:
        if (mine := next((words for words in left if own in words), None)) is not None:
            left.remove(mine)
    return left


def main() -> None:
    adopt_orphans()
    code = cli.main(sys.argv[2:])
    warm.end_parents()  # as when the process ends
    sys.stdout.flush()
    report = {"exit": code, "peak": peak_memory(), "left": living_descendants()}
    Path(sys.argv[1]).write_text(json.dumps(report))


if __name__ == "__main__":
    main()
