"""Matplotlib's list of fonts, which every new home needs."""

from __future__ import annotations

import functools
import glob
import importlib.util
import os
import subprocess
import sys
from pathlib import Path


@functools.cache
def font_list() -> dict[str, bytes]:
    """matplotlib's list of fonts, by its place in the sandbox's home.

    Building it takes half a second, so it is done once for this user and not in every new home.
    """
    home = os.path.expanduser("~")
    cache = os.environ.get("XDG_CACHE_HOME") or f"{home}/.cache"
    folder = os.environ.get("MPLCONFIGDIR") or f"{cache}/matplotlib"
    pattern = f"{glob.escape(folder)}/fontlist-v*.json"
    found = glob.glob(pattern)
    if not found and importlib.util.find_spec("matplotlib"):
        subprocess.run([sys.executable, "-c", "import matplotlib.font_manager"], check=False, capture_output=True)
        found = glob.glob(pattern)
    return {f".cache/matplotlib/{os.path.basename(path)}": Path(path).read_bytes() for path in found}
