"""Draws the pictures of the README: run it from anywhere, it writes beside itself."""

from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np

from autograder.reference import robots
from dhkit.drawing import draw_chain, draw_posture_gallery

HERE = Path(__file__).parent
Q = np.radians([-20, 40, -15, 20, 60, 0])
REACH_OUT = np.radians([0, 15, -6, 40, 50, -30])


def save(axes, name):
    axes.figure.savefig(HERE / name, dpi=110, bbox_inches="tight", facecolor="white")
    plt.close(axes.figure)


def rx90(q):
    """The DHm table of the RX-90 at joint angles q, as numbers."""
    table = robots.RX90.table.at({**robots.RX90.table.values, **dict(zip(robots.RX90.table.joints, q))})
    return [[row.sigma, *map(float, row.parameters)] for row in table.rows]


save(draw_chain(rx90(Q), frames=(0, 3, 6)), "rx90.png")
save(draw_posture_gallery([rx90(q) for q in robots.RX90.inverse(robots.RX90.forward(REACH_OUT)).q]), "postures.png")
