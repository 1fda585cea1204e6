"""Drawings of workspaces: points where the direct model puts them, edges of the right kind, input refused in words."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from dhkit.drawing import planar_points
from dhkit.drawing import workspace as ws

LENGTHS = (0.5, 0.3)
ONE_WAY = np.radians([(-60, 120), (20, 150)])
BOTH_WAYS = np.radians([(-60, 120), (-60, 150)])
SECTION = np.radians([(-20, 100), (-140, -30)])

pytestmark = pytest.mark.filterwarnings("error")


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


DRAWINGS = {
    "grid": lambda: ws.draw_joint_grid(LENGTHS, ONE_WAY),
    "cells": lambda: ws.draw_joint_grid(LENGTHS, BOTH_WAYS, chosen=(9, 7), cells=True),
    "clouds": lambda: ws.draw_clouds({"a": [(0.1, 0.2)], "b": [(0.3, 0.4)]}, LENGTHS, BOTH_WAYS),
    "radius": lambda: ws.draw_radius(LENGTHS, BOTH_WAYS[1]),
    "sheets": lambda: ws.draw_sheets(LENGTHS, BOTH_WAYS),
    "sheets_full_turn": lambda: ws.draw_sheets(LENGTHS, [(-np.pi, np.pi)] * 2),
    "count": lambda: ws.draw_posture_count(LENGTHS, BOTH_WAYS, (0.35, 0.65)),
    "count_out_of_reach": lambda: ws.draw_posture_count(LENGTHS, BOTH_WAYS, (0.9, 0.65)),
    "change": lambda: ws.draw_posture_change(LENGTHS, (0, 1.8), (1.2, -1.8)),
    "dexterous": lambda: ws.draw_dexterous((0.5, 0.3, 0.1)),
    "section": lambda: ws.draw_section(LENGTHS, SECTION, (1.2, -1.0)),
    "section_behind_the_axis": lambda: ws.draw_section(LENGTHS, np.radians([(-20, 170), (-150, 30)])),
    "solid": lambda: ws.draw_elbow_workspace(LENGTHS, SECTION, q=(0, 1.2, -1.0)),
}


@pytest.mark.parametrize("name", DRAWINGS)
def test_every_drawing_can_be_shown(name):
    DRAWINGS[name]().figure.canvas.draw()


def test_points_of_the_grid_are_those_of_the_direct_model():
    points = ws.rr_points(LENGTHS, [0.1, 0.4, 0.9], [0.2, 0.8])
    assert points.shape == (3, 2, 2)
    assert points[2, 1] == pytest.approx(planar_points(LENGTHS, (0.9, 0.8))[2])


@pytest.mark.parametrize("limits", [ONE_WAY, BOTH_WAYS, [(-np.pi, np.pi)] * 2])
def test_the_count_of_postures_agrees_with_the_cloud(limits):
    """A point of the cloud has a posture, and one more exactly if its mirror image is within the limits."""
    random = np.random.default_rng(3)
    limits = np.array(limits)
    for q in random.uniform(limits[:, 0], limits[:, 1], (200, 2)):
        x, y = planar_points(LENGTHS, q)[2]
        mirror = np.array([2 * np.arctan2(y, x) - q[0], -q[1]])
        allowed = (np.mod(mirror - limits[:, 0], 2 * np.pi) <= np.ptp(limits, axis=1)).all()
        assert ws.count_postures(LENGTHS, limits, (x, y)) == 1 + allowed


def test_out_of_reach_there_is_no_posture():
    assert ws.count_postures(LENGTHS, [(-np.pi, np.pi)] * 2, [(0.81, 0), (0.19, 0), (0.5, 0)]).tolist() == [0, 0, 2]


def test_the_marked_point_is_the_image_of_the_marked_pair():
    plane = ws.draw_joint_grid(LENGTHS, ONE_WAY, counts=(9, 7), chosen=(6, 4))
    q = [np.linspace(*ONE_WAY[0], 9)[5], np.linspace(*ONE_WAY[1], 7)[3]]
    label = next(text for text in plane.texts if text.get_text() == "$p_{ij}$")
    assert label.xy == pytest.approx(planar_points(LENGTHS, q)[2])


def test_only_the_straight_elbow_makes_a_bold_edge():
    widths = {line.get_linewidth() for line in ws.draw_posture_count(LENGTHS, ONE_WAY).lines}
    assert 2.6 not in widths
    bold = [line for line in ws.draw_posture_count(LENGTHS, BOTH_WAYS).lines if line.get_linewidth() == 2.6]
    assert bold and all(np.hypot(*line.get_data()) == pytest.approx(0.8) for line in bold)


@pytest.mark.parametrize(
    ("draw", "words"),
    [
        (lambda: ws.draw_sheets(LENGTHS, [(1, 0), (0, 1)]), "min below max"),
        (lambda: ws.draw_sheets(LENGTHS, [(0, 7), (0, 1)]), "full turn"),
        (lambda: ws.draw_sheets((0.5, -0.3), ONE_WAY), "lengths must be positive"),
        (lambda: ws.draw_joint_grid(LENGTHS, ONE_WAY, chosen=(10, 1)), "counted from 1"),
        (lambda: ws.draw_radius(LENGTHS, (2, 4)), "between -pi and pi"),
        (lambda: ws.draw_dexterous((0.5, 0.3)), "expected 3 numbers"),
    ],
)
def test_bad_input_is_refused_in_words(draw, words):
    with pytest.raises(ValueError, match=words):
        draw()
