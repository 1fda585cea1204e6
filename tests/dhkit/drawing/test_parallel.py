"""Drawings of parallel robots: legs end where the platform is, modes lie on the coupler curve, singular lines meet."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest

from dhkit.drawing import parallel
from dhkit.pictures import parallel_robots as pictures

solver = pytest.importorskip("dhm.parallel", reason="only the students' kit is installed")
ThreeRPR, ThreeRRR = solver.ThreeRPR, solver.ThreeRRR

BASE = np.array([(0, 0), (1.0, 0), (0.3, 0.6)])
PLATFORM = np.array([(-0.2, -0.2), (0.2, -0.2), (0.1, 0.3)])
ROBOT = ThreeRPR(BASE, PLATFORM)
SIX = (1.0, 0.5, 0.9)

pytestmark = pytest.mark.filterwarnings("error")


def texts(ax):
    return [text.get_text() for text in ax.texts]


def rings(ax):
    """Centres of the round marks that have no fill."""
    return np.array(
        [line.get_xydata()[0] for line in ax.lines if line.get_marker() == "o" and line.get_mfc() == "none"]
    )


def test_platform_points_are_turned_then_moved():
    found = parallel.platform_points(PLATFORM, (0.5, 0.6, np.pi / 2))
    assert found == pytest.approx(np.array([(0.7, 0.4), (0.7, 0.8), (0.2, 0.7)]))


def test_the_legs_join_anchors_and_platform_and_their_lengths_are_written():
    ax = parallel.draw_3rpr(BASE, PLATFORM, (0.55, 0.6, 0.35), lengths=True)
    drawn = [line.get_xydata() for line in ax.lines]
    for foot, joint in zip(BASE, parallel.platform_points(PLATFORM, (0.55, 0.6, 0.35))):
        assert any(len(ends) == 2 and np.allclose(ends, [foot, joint]) for ends in drawn)
    assert {"$A_1$", "$B_3$", "$q_2$", r"$\varphi$", "$P$"} <= set(texts(ax))
    for q in ROBOT.inverse([0.55, 0.6, 0.35]):
        assert f"{q:.3f} m" in ax.get_title()


@pytest.mark.parametrize("lengths", [SIX, (1.0, 0.5, 1.0), (0.9, 0.9, 0.8), (0.6, 1.2, 0.7)])
def test_every_assembly_mode_lies_on_the_coupler_curve(lengths):
    paths = parallel.coupler_curve(BASE, PLATFORM, lengths)
    for pose in ROBOT.forward(lengths).listed():
        point = parallel.platform_points(PLATFORM, pose)[2]
        assert min(np.hypot(*(path - point).T).min() for path in paths) < 0.02
    for path in paths:
        assert path[0] == pytest.approx(path[-1]), "closed"
        assert np.hypot(*np.diff(path, axis=0).T).max() < 0.12, "without a gap"


def test_legs_that_cannot_close_have_no_coupler_curve():
    assert parallel.coupler_curve(BASE, PLATFORM, (0.1, 0.1)) == []
    parallel.draw_coupler_curve(BASE, PLATFORM, (0.1, 0.1, 0.1)).figure.canvas.draw()


@pytest.mark.parametrize("lengths", [SIX, (1.0, 0.5, 1.2), (0.1, 0.1, 0.1)])
def test_a_gallery_numbers_its_pictures_or_says_that_there_are_none(lengths):
    modes = ROBOT.forward(lengths).listed()
    ax = parallel.draw_assembly_modes(BASE, PLATFORM, modes)
    ax.figure.canvas.draw()
    assert [text.split(":")[0] for text in texts(ax)] == (
        [str(k + 1) for k in range(len(modes))] or ["no way to close the legs"]
    )


def test_leg_lines_meet_in_one_point_in_a_singular_pose_only():
    def spread(pose):
        found = rings(parallel.draw_leg_lines(BASE, PLATFORM, [pose], view=(-9, 9, -9, 9)))
        return np.ptp(found, axis=0).max() if len(found) == 3 else np.inf

    assert spread((0.55, 0.6, 0.35)) > 0.2
    x, y, phi = 0.5, 0.6, 0.0
    aims = (BASE - np.array([0.4, 2.0])) / np.array([[4.0]])  # joints on the lines from a common point to the anchors
    concurrent = parallel.draw_leg_lines(BASE, np.array([0.4, 2.0]) + aims - (x, y), [(x, y, phi)], view=(-9, 9, -9, 9))
    assert np.ptp(rings(concurrent), axis=0).max() < 1e-9


def test_all_eight_postures_of_the_3rrr_carry_the_platform():
    pose, bars = (0.5, 0.45, 0.2), (0.4, 0.4)
    found = ThreeRRR(BASE, PLATFORM, bars[:1] * 3, bars[1:] * 3).inverse(pose).listed()
    ax = parallel.draw_3rrr(BASE, PLATFORM, bars, pose, found)
    assert len(texts(ax)) == 8 and "8:  elbows \N{MINUS SIGN} \N{MINUS SIGN} \N{MINUS SIGN}" in texts(ax)


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda: parallel.draw_3rpr(BASE[:2], PLATFORM, (0, 0, 0)), "base: expected 3 x 2 numbers, found 2 x 2"),
        (lambda: parallel.draw_3rpr(BASE, PLATFORM, (0, 0)), "pose: expected 3 numbers, found 2"),
        (lambda: parallel.draw_assembly_modes(BASE, PLATFORM, [(1, 2)]), "modes: expected n x 3 numbers, found 1 x 2"),
        (lambda: parallel.draw_coupler_curve(BASE, PLATFORM, (1, 0, 1)), "leg lengths: lengths must be positive"),
        (lambda: parallel.draw_3rrr(BASE, PLATFORM, (1, 1), (0, 0, 0), [(1, 2)]), "solutions: expected n x 6 numbers"),
    ],
)
def test_bad_input_is_refused_in_words(draw, message):
    with pytest.raises(ValueError, match=message):
        draw()
    assert not plt.get_fignums()


# ---------------------------------------------------------------- pictures of a student's result


SHOWN = {
    "leg_lengths": (pictures.show_leg_lengths, lambda *pose: ROBOT.inverse(pose), ((0.5, 0.6, 0.3),)),
    "modes": (pictures.show_modes, ROBOT.forward(SIX).listed(), (SIX,)),
    "postures": (
        pictures.show_3rrr_postures,
        [[0.1] * 6] * 2,
        ([(0.4, 0.4), (0.4, 0.3), (0.5, 0.4)], (0.5, 0.45, 0.2)),
    ),
}


def shown(name, answer):
    show, _, rest = SHOWN[name]
    return show(answer, BASE, PLATFORM, *rest)


@pytest.mark.slow
@pytest.mark.parametrize("name", SHOWN)
def test_answers_are_drawn_and_blanks_say_so(name):
    answer = SHOWN[name][1]
    ax = shown(name, answer)
    ax.figure.canvas.draw()
    assert ax.lines or ax.collections or ax.patches
    blank = (lambda *pose: None) if callable(answer) else ...
    assert texts(shown(name, blank)) == ["not attempted yet"]
    assert "cannot be drawn" in texts(shown(name, "seven"))[0]


def test_circles_have_the_radii_that_the_function_returns():
    circles = [
        patch for patch in shown("leg_lengths", lambda *pose: [0.3, 0.4, 0.5]).patches if hasattr(patch, "radius")
    ]
    assert [circle.radius for circle in circles] == [0.3, 0.4, 0.5]


def test_a_wrong_mode_is_named_by_its_legs():
    right = ROBOT.forward(SIX).listed()
    assert all("legs fit" in text for text in texts(shown("modes", right)))
    wrong = texts(shown("modes", [right[0], right[1] + [0.1, 0, 0]]))
    assert "legs fit" in wrong[0] and "a leg is off by" in wrong[1]
    assert texts(shown("modes", [])) == ["no way to close the legs"]
