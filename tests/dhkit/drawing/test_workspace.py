"""Drawings of workspaces: points where the direct model puts them, edges of the right kind, input refused in words."""

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
import sympy

from dhkit import drawing as ws
from dhkit.geometry import planar_joints
from dhkit.pictures import workspace as pictures
from dhkit.planar_arms import sliding_outline
from dhkit.variants import numbers

LENGTHS = (0.5, 0.3)
ONE_WAY = np.radians([(-60, 120), (20, 150)])
BOTH_WAYS = np.radians([(-60, 120), (-60, 150)])
SECTION = np.radians([(-20, 100), (-140, -30)])
OWN = numbers("workspace", "ada")
OUTLINE = sliding_outline(OWN)

pytestmark = pytest.mark.filterwarnings("error")


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


@pytest.mark.slow
@pytest.mark.parametrize("name", DRAWINGS)
def test_every_drawing_can_be_shown(name):
    DRAWINGS[name]().figure.canvas.draw()


def test_points_of_the_grid_are_those_of_the_direct_model():
    points = ws.grid_points(LENGTHS, [0.1, 0.4, 0.9], [0.2, 0.8])
    assert points.shape == (3, 2, 2)
    assert points[2, 1] == pytest.approx(planar_joints(LENGTHS, (0.9, 0.8))[2])


@pytest.mark.parametrize("limits", [ONE_WAY, BOTH_WAYS, [(-np.pi, np.pi)] * 2])
def test_the_count_of_postures_agrees_with_the_cloud(limits):
    """A point of the cloud has a posture, and one more exactly if its mirror image is within the limits."""
    random = np.random.default_rng(3)
    limits = np.array(limits)
    for q in random.uniform(limits[:, 0], limits[:, 1], (200, 2)):
        x, y = planar_joints(LENGTHS, q)[2]
        mirror = np.array([2 * np.arctan2(y, x) - q[0], -q[1]])
        allowed = (np.mod(mirror - limits[:, 0], 2 * np.pi) <= np.ptp(limits, axis=1)).all()
        assert ws.count_postures(LENGTHS, limits, (x, y)) == 1 + allowed


def test_out_of_reach_there_is_no_posture():
    assert ws.count_postures(LENGTHS, [(-np.pi, np.pi)] * 2, [(0.81, 0), (0.19, 0), (0.5, 0)]).tolist() == [0, 0, 2]


def test_the_marked_point_is_the_image_of_the_marked_pair():
    plane = ws.draw_joint_grid(LENGTHS, ONE_WAY, counts=(9, 7), chosen=(6, 4))
    q = [np.linspace(*ONE_WAY[0], 9)[5], np.linspace(*ONE_WAY[1], 7)[3]]
    label = next(text for text in plane.texts if text.get_text() == "$p_{ij}$")
    assert label.xy == pytest.approx(planar_joints(LENGTHS, q)[2])


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


# ---------------------------------------------------------------- pictures of a student's own result

t1i, t2i, t2j, L1, L2, t2, t3 = sympy.symbols("t1i t2i t2j L1 L2 t2 t3")
POINT = [L1 * sympy.cos(t1i) + L2 * sympy.cos(t1i + t2j), L1 * sympy.sin(t1i) + L2 * sympy.sin(t1i + t2j)]
VALUES = {"t2": 1.2, "t3": -1.0, "L1": 0.5, "L2": 0.3}
PICTURES = {
    "point": (pictures.show_point_function, (LENGTHS, ONE_WAY), POINT),
    "cloud": (pictures.show_cloud, (OUTLINE,), OUTLINE[:9]),
    "reach": (pictures.show_reach_range, (LENGTHS,), lambda *args: [0.2, 0.8]),
    "base": (pictures.show_base, (OWN,), [0.1, 0.2]),
    "area": (pictures.show_area, (OUTLINE,), 0.85),
    "count": (pictures.show_count, (LENGTHS, BOTH_WAYS), lambda *args: 1),
    "section": (pictures.show_section, (VALUES,), [L1 * sympy.cos(t2), L1 * sympy.sin(t2)]),
}


def words(ax):
    labels = ax.get_legend_handles_labels()[1]
    return " ".join([ax.get_title(), *(text.get_text() for text in ax.texts), *labels])


@pytest.mark.parametrize("name", PICTURES)
def test_an_answer_is_drawn_and_nothing_is_said_to_be_nothing(name):
    show, given, answer = PICTURES[name]
    show(answer, *given).figure.canvas.draw()
    untouched = (lambda *args: None) if callable(answer) else ...
    assert "not attempted yet" in words(show(untouched, *given))
    assert "cannot be drawn" in words(show("nonsense", *given))


def test_one_index_shows_as_a_curve():
    assert "576 different points" in words(pictures.show_point_function(POINT, LENGTHS, ONE_WAY))
    printed = [entry.subs(t2j, t2i) for entry in POINT]
    assert "24 different points" in words(pictures.show_point_function(printed, LENGTHS, ONE_WAY))


def test_counts_that_no_arm_has_are_crossed():
    assert "neither 0, 1 nor 2" in words(pictures.show_count(lambda *args: 3, LENGTHS, BOTH_WAYS))
    assert "neither 0, 1 nor 2" not in words(pictures.show_count(lambda *args: 2, LENGTHS, BOTH_WAYS))


def test_an_area_in_degrees_is_too_large_for_a_picture():
    assert "far larger than the arm reaches" in words(pictures.show_area(850.0, OUTLINE))
