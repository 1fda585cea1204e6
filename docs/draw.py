"""Draws the pictures of the README: run it from anywhere, it writes beside itself."""

from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
from dhkit import drawing

HERE = Path(__file__).parent


def save(axes, name):
    axes.figure.savefig(HERE / name, dpi=110, bbox_inches="tight", facecolor="white")
    plt.close(axes.figure)


save(drawing.draw_scara_3d(), "scara.png")
save(drawing.draw_postures([0.5, 0.4], [(0.0838, 1.5828), (1.4426, -1.5828)], (0.46, 0.44)), "postures.png")
