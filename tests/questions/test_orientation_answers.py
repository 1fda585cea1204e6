"""The wrist formulas agree with the reference solver, and mistakes differ from right answers, whatever numbers a student gets."""

from itertools import combinations, product

import numpy as np
import pytest

from autograder.questions import find
from autograder.questions.orientation.kit import KIT_FILE, for_the_kit
from autograder.questions.orientation.model import R, draw_rotation_and_sign, e, wrist_angles
from autograder.questions.orientation.own import (
    CONVENTIONS,
    LECTURES_RPY,
    LECTURES_RPY_FIXED,
    LECTURES_WRIST,
    MOUNTS,
    PAN_TILT_ROLL,
    READINGS,
    draw_locked,
    draw_poses,
    drone,
    hinge_angles,
    lock_of,
    locked,
    misses,
    pan_tilt_roll,
)
from dhkit.attitudes import camera_of, display_of, hinges
from dhkit.geometry import rotation_angle_between
from dhkit.public import variant_ranges
from dhkit.variants import OwnNumbers
from dhm.orientation import EULER_SETS, euler_angles, euler_matrix


@pytest.mark.parametrize("axes", EULER_SETS)
def test_wrist_formulas_give_both_solutions_of_the_reference_solver(axes):
    values = {name: value for name, value in draw_rotation_and_sign(np.random.default_rng(5)).items() if name != "e"}
    matrix = np.array([values[str(entry)] for entry in R]).reshape(3, 3)
    found = [[float(angle.subs(values | {"e": sign})) for angle in wrist_angles(axes)] for sign in (1, -1)]
    assert found == pytest.approx(euler_angles(matrix, axes, intrinsic=True).angles, abs=1e-9)
    assert all(angle.has(e) for angle in wrist_angles(axes))


def class_of(name):
    return variant_ranges("orientation")[name]


@pytest.mark.parametrize("wrist", class_of("wrist"))
def test_formulas_of_every_wrist_put_its_hinges_into_the_wanted_orientation(wrist):
    axes, senses = hinges(wrist)
    values = {name: value for name, value in draw_rotation_and_sign(np.random.default_rng(7)).items() if name != "e"}
    matrix = np.array([values[str(entry)] for entry in R]).reshape(3, 3)
    found = [[float(angle.subs(values | {"e": sign})) for angle in hinge_angles(wrist)] for sign in (1, -1)]
    turned = euler_matrix(np.multiply(senses, found), axes, intrinsic=True)
    assert rotation_angle_between(turned, matrix).max() < 1e-9
    assert np.ptp(np.cos(found), axis=0).max() > 0.1, "two solutions"
    root = next(argument for argument in hinge_angles(wrist)[1].args if argument.has(e))
    assert root.subs(values | {"e": 1}) > 0, "e stands before a positive root"


@pytest.mark.parametrize("wrist", class_of("wrist"))
def test_a_locked_wrist_has_all_triples_of_one_combination(wrist):
    axes, senses = hinges(wrist)
    mine = OwnNumbers(wrist=wrist)
    for (rows,) in draw_locked(np.random.default_rng(3), mine):
        k, angle = locked(rows, mine=mine)
        triples = [(angle - k * third, lock_of(axes), third) for third in (-1.0, 0.0, 2.0)]
        assert (
            rotation_angle_between(
                euler_matrix(np.multiply(senses, triples), axes, intrinsic=True), np.array(rows)
            ).max()
            < 1e-9
        )


def test_wrists_of_the_class_are_not_those_of_lectures_and_other_questions():
    assert {hinges(wrist)[0] for wrist in class_of("wrist")} <= set(EULER_SETS) - {"zyz", "zyx", "xzy", PAN_TILT_ROLL}
    assert all("-" in wrist for wrist in class_of("wrist"))


@pytest.mark.parametrize("controller", class_of("controller"))
def test_a_log_fits_one_reading_only_and_none_of_the_lectures(controller):
    display = display_of({"controller": controller})
    fit = [
        reading
        for reading in READINGS
        if np.abs([reading.matrix(np.radians(row)) for row in display.shown] - display.measured).max() < 0.05
    ]
    assert fit == [CONVENTIONS[controller]]
    assert CONVENTIONS[controller] not in (LECTURES_RPY, LECTURES_RPY_FIXED, LECTURES_WRIST)


def test_what_students_see_of_controllers_and_cameras_is_what_is_meant():
    assert KIT_FILE.read_text(encoding="utf-8") == for_the_kit(), "python -m autograder.questions.orientation.kit"
    assert (*CONVENTIONS,) == class_of("controller") and (*MOUNTS,) == class_of("camera")


@pytest.mark.parametrize("camera", class_of("camera"))
def test_a_camera_looks_where_it_is_said_to(camera):
    mount, seen = MOUNTS[camera], camera_of({"camera": camera})
    right, down, view = mount.camera.T
    assert np.cross(right, down) == pytest.approx(view) and mount.camera.T @ mount.camera == pytest.approx(np.eye(3))
    where = {"ahead": (1, 0), "back": (-1, 0), "to the left": (0, 1), "to the right": (0, -1)}
    assert np.sign(view[:2].round(9)) == pytest.approx(where[mount.hangs.removeprefix("looks ").partition(",")[0]])
    assert f"{np.degrees(np.arcsin(-view[2])):.0f}°" in mount.hangs or (view[2] == 0 and "level" in mount.hangs)
    assert np.sign(-down[2]) == (-1 if "upside down" in mount.hangs else 1)
    assert rotation_angle_between(mount.drone @ mount.camera, seen.rotation) < 1e-5


@pytest.mark.parametrize("camera", class_of("camera"))
def test_no_mistake_about_a_camera_looks_right(camera):
    mine = OwnNumbers(camera=camera)
    wrong = [
        drone(mine, **way.wrong) for node in find("orientation.rpy_both").mistakes for way in node.ways if way.wrong
    ]
    assert rotation_angle_between(np.array(wrong), drone(mine)).min() > 0.1
    apart = [rotation_angle_between(one, other) for one, other in combinations(wrong, 2)]
    assert min(apart) > 0.1, "and each has its name"


def test_the_function_as_found_fails_in_three_poses_of_everybody():
    names = ("pan", "tilt", "roll")
    ranges = [class_of(name) for name in names]
    for own in product(*(np.arange(low, high + step / 2, step) for low, high, step in ranges)):
        found = misses(OwnNumbers(zip(names, own)))
        assert [angle > 0.01 for angle in found] == [False, True, False, True, False, True], own


def test_pan_tilt_and_roll_are_those_of_the_reference_solver():
    for (rows,) in draw_poses(np.random.default_rng(9)):
        assert (
            rotation_angle_between(euler_matrix(pan_tilt_roll(rows), PAN_TILT_ROLL, intrinsic=True), np.array(rows))
            < 1e-9
        )
