"""What students see of controllers and cameras: the kit's ``attitudes.json``.

``python -m autograder.questions.orientation.kit`` writes it. How a controller counts, and how a drone flies, it does not say.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

import dhkit

from .own import CONVENTIONS, MOUNTS, shown

KIT_FILE = Path(dhkit.__file__).with_name("attitudes.json")


def for_the_kit() -> str:
    """What the kit's file says."""
    controllers = {
        name: {
            "shown": shown(name),
            "measured": (np.round([convention.matrix(np.radians(row)) for row in shown(name)], 4) + 0.0).tolist(),
        }
        for name, convention in CONVENTIONS.items()
    }
    cameras = {
        name: {"hangs": mount.hangs, "rotation": (np.round(mount.drone @ mount.camera, 6) + 0.0).tolist()}
        for name, mount in MOUNTS.items()
    }
    lines = [
        f"{json.dumps(kind)}: {{\n"
        + ",\n".join(f"{json.dumps(name)}: {json.dumps(one)}" for name, one in all_.items())
        + "\n}"
        for kind, all_ in (("controllers", controllers), ("cameras", cameras))
    ]
    return "{\n" + ",\n".join(lines) + "\n}\n"


if __name__ == "__main__":
    KIT_FILE.write_text(for_the_kit(), encoding="utf-8")
