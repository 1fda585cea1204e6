"""Names in drawings: none on another, one for arms that lie on one another, and the last joint on the hand's side."""

import itertools

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest

from dhkit.drawing import draw_chain, draw_frames_3d, draw_postures
from dhkit.drawing.robot import Robot
from dhkit.drawing.view import to_pixels
from dhkit.geometry import chain_products, modified_dh

HALF = np.pi / 2
RX90 = np.array(
    [[0, 0, 0, 0, 0], [0, 0, HALF, 0, 0], [0, 0.45, 0, 0, 0], [0, 0, -HALF, 0.45, 0], [0, 0, HALF, 0, 0], [0, 0, -HALF, 0, 0]]
)  # fmt: skip
EPFL = np.array(
    [
        [0, 0, 0, HALF], [0, HALF, 0, HALF], [0.5, 0, 0.2, HALF],
        [0, HALF, 0.6, np.pi], [0, HALF, 0, np.pi], [0, HALF, 0, HALF],
    ]
)  # fmt: skip


def overlaps(ax) -> list[tuple[str, str]]:
    """Pairs of texts of which one covers more than a third of the other."""
    ax.figure.canvas.draw()
    texts = [text for text in ax.texts if text.get_text()]
    centres = to_pixels(ax, [text.get_position_3d() for text in texts])
    halves = [np.array(text.get_window_extent().size) / 2 for text in texts]
    found = []
    for k, j in itertools.combinations(range(len(texts)), 2):
        common = np.clip(halves[k] + halves[j] - abs(centres[k] - centres[j]), 0, None)
        if common.prod() > 4 * min(halves[k].prod(), halves[j].prod()) / 3:
            found.append((texts[k].get_text(), texts[j].get_text()))
    return found


@pytest.mark.slow
@pytest.mark.slow
def test_names_of_frames_do_not_lie_on_one_another():
    assert overlaps(draw_frames_3d(chain_products(modified_dh(*EPFL.T)))) == []
    assert overlaps(draw_chain(RX90.tolist(), normals=True)) == []


def test_arms_that_lie_on_one_another_share_their_number():
    ax = draw_postures((0.36, 0.26), [(0.1, 1.8), (0.1, 1.8 - 2 * np.pi), (1.5, -1.8)], (0.26, 0.3))
    assert [text.get_text() for text in ax.texts] == ["1, 2", "3"]


@pytest.mark.parametrize("tool, side", [((0.15, -2.4, 0.12), 1), ((0, 0, 0.2), 1), ((0, 0, -0.2), -1)])
def test_joint_6_stands_before_the_wrist_also_with_a_bent_tool(tool, side):
    robot = Robot(np.vstack([RX90, [0, tool[0], tool[1], tool[2], 0]]), tool=True)
    assert np.sign((robot.centres[6] - robot.origins[6]) @ robot.z[6]) == side
