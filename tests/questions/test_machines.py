"""The machines of the parallel robots' exercise: their ways, and the one singular pose on their line, are what is asked about."""

import numpy as np
import pytest

from autograder.questions.parallel_robots.machine import BETWEEN, crossings, drives, hold, rates, singular
from dhkit.machines import MACHINES
from dhkit.variants import OwnNumbers


def own(name):
    return OwnNumbers(machine=name, order="012345")


def signs_along(machine, poses):
    return np.sign([hold(machine, pose) for pose in poses])


@pytest.mark.parametrize("name", MACHINES)
def test_three_ways_pass_twice_two_never_and_one_once(name):
    ways = MACHINES[name].ways
    assert [crossings(*start, *end, own(name)) for start, end in ways] == [2, 2, 2, 0, 0, 1]
    for start, end in ways:
        signs = signs_along(MACHINES[name], np.linspace(start, end, 201))
        changes = np.flatnonzero(signs[1:] != signs[:-1])
        assert np.diff([0, *changes, 200]).min() >= 20, "a tenth of the way apart, as the statement says"


@pytest.mark.parametrize("name", MACHINES)
def test_on_the_line_there_is_one_singular_pose(name):
    machine = MACHINES[name]
    signs = signs_along(machine, [(x, machine.line, 0.0) for x in np.linspace(*BETWEEN, 241)])
    assert (signs[1:] != signs[:-1]).sum() == 1
    assert abs(hold(machine, (singular(own(name)), machine.line, 0.0))) < 1e-9


@pytest.mark.parametrize("name", MACHINES)
def test_every_pose_that_the_statement_names_is_reached(name):
    grid = [
        (x, y, phi)
        for x in np.linspace(0.35, 0.65, 7)
        for y in np.linspace(0.35, 0.65, 7)
        for phi in np.linspace(-0.9, 0.9, 7)
    ]
    assert np.isfinite([drives(*pose, own(name)) for pose in grid]).all()


@pytest.mark.parametrize("name", MACHINES)
def test_rates_are_differences_of_drives(name):
    pose, step = np.array([0.43, 0.57, 0.3]), 1e-6
    ahead, behind = ([drives(*(pose + sign * way), own(name)) for way in step * np.eye(3)] for sign in (1, -1))
    differences = np.subtract(ahead, behind).T / (2 * step)
    np.testing.assert_allclose(rates(*pose, own(name)), differences, atol=1e-7)
