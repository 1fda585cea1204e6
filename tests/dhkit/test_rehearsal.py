"""What a process does once that is copied for many notebooks."""

import subprocess
import sys

REHEARSED = """
import matplotlib.pyplot as plt
from dhkit import rehearsal, variants
rehearsal.rehearse()
print(len(plt.get_fignums()), [variants.typed(name) for name in ("scara", "planar_2r")])
"""


def test_a_rehearsal_leaves_figures_and_nobodys_id():
    code = [sys.executable, "-W", "error", "-c", REHEARSED]
    done = subprocess.run(code, capture_output=True, text=True, env={"MPLBACKEND": "agg", "HOME": "/nonexistent"})
    assert done.stdout == "3 [None, None]\n", done.stderr
