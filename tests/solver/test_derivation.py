"""Derivations: their programs find what the solver finds, their steps are those of the books, and some end in words."""

import subprocess
import sys
from functools import cache

import numpy as np
import pytest
import sympy as sp

import dhm.paul
from autograder.reference import robots
from dhm import DHTable, Robot, Status, derivation

HALF = np.pi / 2
WRIST = [(0, 0, 0, 0, None), (0, 0, -HALF, 0, None), (0, 0, HALF, 0, None)]
GANTRY = [(1, 0, 0, None, 0), (1, 0, -HALF, None, -HALF), (1, 0, -HALF, None, 0)]
UR5E = [
    (0, 0, HALF, 0.1625, None),
    (0, -0.425, 0, 0, None),
    (0, -0.3922, 0, 0, None),
    (0, 0, HALF, 0.1333, None),
    (0, 0, -HALF, 0.0997, None),
    (0, 0, 0, 0.0996, None),
]
PUMA_560 = [
    (0, 0, 0, 0, None),
    (0, 0, -HALF, 0, None),
    (0, 0.4318, 0, 0.14909, None),
    (0, 0.0203, -HALF, 0.4331, None),
    (0, 0, HALF, 0, None),
    (0, 0, -HALF, 0.05625, None),
]
OWN = {
    "UR5e": Robot(DHTable.from_classic(UR5E)),
    "PUMA 560": Robot(DHTable(PUMA_560)),
    "Stanford": Robot(DHTable([(0, 0, 0, 0.4, None), (0, 0, -HALF, 0.15, None), (1, 0, HALF, None, 0), *WRIST])),
    "gantry": Robot(DHTable(GANTRY)),
    "gantry with wrist": Robot(DHTable([*GANTRY, *WRIST])),
    "cylindrical": Robot(DHTable([(0, 0, 0, 0, None), (1, 0, 0, None, 0), (1, 0, -HALF, None, 0)])),
    "spherical": Robot(DHTable([(0, 0, 0, 0.3, None), (0, 0, -HALF, 0, None), (1, 0, HALF, None, 0)])),
    "four turns": Robot(
        DHTable([(0, 0, 0, 0, None), (0, 0.02, HALF, 0, None), (0, 0.15, np.pi, 0, None), (0, 0.18, np.pi, 0, None)])
    ),
    "oblique": Robot(DHTable([(0, 0, 0, 0, None), (0, 0, 0.9, 0.1, None), (1, 0, HALF, None, 0)])),
}
KINDS = {
    "PLANAR_2R": (8,),
    "PLANAR_3R": (3, 8),
    "ELBOW_3R": (2, 8),
    "SPHERICAL_WRIST": (2, 3, 3),
    "gantry": (1, 1, 1),
    "cylindrical": (1, 4),
    "spherical": (2, 4),
    "SCARA": (1, 3, 8),
}
SLOW_KINDS = {
    "ADEPT_S600": (1, 3, 8),
    "RX90": (2, 6, 2, 3, 3),
    "PUMA 560": (2, 7, 2, 3, 3),
    "KR210": (2, 7, 2, 3, 3),
    "UR5e": (2, 2, 3, 3, 8),
    "Stanford": (2, 4, 2, 3, 3),
    "gantry with wrist": (1, 1, 1, 2, 3, 3),
    "four turns": (3, 3, 8),
}
CASES = [*KINDS.items(), *(pytest.param(*case, marks=pytest.mark.slow) for case in SLOW_KINDS.items())]


@cache
def found(name):
    robot = OWN.get(name) or getattr(robots, name)
    return robot, derivation(robot)


def run(text):
    program = {}
    exec(compile(text, "program", "exec"), program)
    return program["postures"]


def among(q, postures, slides):
    apart = postures - q
    apart[:, ~slides] = np.angle(np.exp(1j * apart[:, ~slides]))
    return bool((np.abs(apart) < 1e-5).all(axis=1).any())


@pytest.mark.parametrize("name, kinds", CASES)
def test_the_program_finds_what_the_solver_finds(name, kinds):
    """At random postures, and at round ones, where many are singular."""
    robot, its = found(name)
    assert its.kinds == kinds
    postures = run(its.to_python())
    chain = robot.table.chain
    slides, rng = chain.prismatic[: chain.joints], np.random.default_rng(0)
    turns = [
        *rng.uniform(-np.pi, np.pi, (20, chain.joints)),
        *rng.choice(np.arange(-6, 7) * np.pi / 6, (30, chain.joints)),
    ]
    for q in np.where(slides, np.abs(turns) / 6 + 0.05, turns):
        pose = robot.forward(q)
        mine, solver = postures(pose), robot.inverse(pose)
        part = np.s_[:3, 3] if its.setting.tip is not None else np.s_[:]
        assert all(np.abs(robot.forward(each) - pose)[part].max() < 1e-6 for each in mine)
        if solver.status == Status.INFINITE:
            assert any(len(postures(pose, free)) for free in (0.0, *solver.q.ravel())), q
        else:
            assert len(mine) == len(solver) and all(among(each, mine, slides) for each in solver.q), q


def test_a_pose_out_of_reach_has_no_postures():
    robot, its = found("PLANAR_3R")
    pose = robot.forward([0, 0, 0])
    pose[0, 3] += 1
    assert run(its.to_python())(pose).shape == (0, 3)


def test_the_program_runs_alone(tmp_path):
    robot, its = found("PLANAR_2R")
    file = tmp_path / "model.py"
    file.write_text(
        its.to_python()
        + f"\nprint(len(postures({robot.forward([0.3, 0.8]).tolist()})), 'dhm' in __import__('sys').modules)\n"
    )
    assert subprocess.run([sys.executable, file], capture_output=True, text=True, check=True).stdout == "2 False\n"


def test_the_docstring_is_true():
    import doctest

    assert doctest.testmod(dhm.paul).failed == 0


@pytest.mark.slow
def test_the_rx90_is_derived_as_on_the_slides():
    """Shoulder from the wrist centre across the arm's plane, then elbow, then the wrist from the hand's axes."""
    text = found("RX90")[1].to_markdown()
    order = [
        r"C_{1} P_{y} - P_{x} S_{1} = 0",
        r"P_{z} = C_{23} d_{3} + S_{2} a_{3}",
        r"\theta_{4} = \mathrm{atan2}(-Y, X)",
        r"C_{5} = ",
        r"S_{6} = ",
    ]
    places = [text.index(each) for each in order]
    assert places == sorted(places) and "at most 8 postures" in text


@pytest.mark.slow
def test_the_ur5e_is_derived_as_in_the_literature():
    """Origin 5 gives theta_1, its Z_6 theta_5, then theta_6, the sum of the parallel axes, and a two-link arm."""
    steps = found("UR5e")[1].steps
    assert [step.unknowns[0].name for step in steps] == ["theta_1", "theta_5", "theta_6", "theta_234", "theta_3"]


def test_letters_and_offsets_are_told():
    text = found("SCARA")[1].to_markdown()
    assert "$a_{2} = 0.4$" in text and "$d_{2} = - r_{3}$" in text
    assert derivation(OWN["oblique"]).setting.values[sp.Symbol("alpha_1")] == 0.9


def test_what_is_solved_by_elimination_says_so():
    bent = [*UR5E[:2], (0, -0.39, 0.2, 0, None), *UR5E[3:]]
    its = derivation(Robot(DHTable.from_classic(bent, name="bent")))
    assert not its.steps and "bent is solved by elimination only" in its.to_markdown()
    with pytest.raises(ValueError, match="polynomial of degree up to 16"):
        its.to_python()


def test_a_robot_without_inverse_model_is_refused():
    with pytest.raises(ValueError, match="no inverse model"):
        derivation(robots.PUMA_PRINTED)
    with pytest.raises(ValueError, match="row 2 is moved by"):
        derivation(robots.PEN_A)
