"""The robots of the pool that can be bought are those of their sources, composed here anew from the numbers printed there."""

from dataclasses import dataclass
from math import pi

import numpy as np
import pytest

from autograder.questions.shared.pool import arms

SAME = (1,) * 6
Z, Y, X = (0, 0, 1), (0, 1, 0), (1, 0, 0)


@dataclass(frozen=True)
class Published:
    """A chain as it is printed, and how its joints count against those of the pool: theirs = sense * ours + zero."""

    joints: tuple[tuple, ...]
    sense: tuple[int, ...] = SAME
    zero: tuple[float, ...] = (0,) * 6


def shifted(x: float = 0, y: float = 0, z: float = 0) -> np.ndarray:
    return np.block([[np.eye(3), np.array([[x], [y], [z]])], [np.zeros(3), np.ones(1)]])


def turned(axis: tuple, angle: float) -> np.ndarray:
    """About a direction of length 1, after Rodrigues."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    result = np.eye(4)
    result[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return result


def urdf(xyz: tuple, axis: tuple, rpy: tuple = (0, 0, 0)):
    """A revolute joint of a URDF file: its origin, roll, pitch, yaw about fixed axes, then its turn."""
    roll, pitch, yaw = rpy
    placed = shifted(*xyz) @ turned(Z, yaw) @ turned(Y, pitch) @ turned(X, roll)
    return lambda q: placed @ turned(axis, q)


def classic(theta: float, d: float, a: float, alpha: float):
    """A revolute joint of a classic table."""
    return lambda q: turned(Z, q + theta) @ shifted(z=d) @ shifted(a) @ turned(X, alpha)


def modified(alpha: float = 0, d: float = 0, slides: bool = False):
    """A joint of a modified table without lengths a."""
    return lambda q: turned(X, alpha) @ (shifted(z=q) if slides else turned(Z, q) @ shifted(z=d))


PUBLISHED = {
    "ur5e": Published(
        (
            urdf((0, 0, 0.1625), Z),
            urdf((0, 0, 0), Z, (1.570796327, 0, 0)),
            urdf((-0.425, 0, 0), Z),
            urdf((-0.3922, 0, 0.1333), Z),
            urdf((0, -0.0997, 0), Z, (1.570796327, 0, 0)),
            urdf((0, 0.0996, 0), Z, (1.570796326589793, pi, pi)),
        )
    ),
    "irb120": Published(
        (
            urdf((0, 0, 0), Z),
            urdf((0, 0, 0.29), Y),
            urdf((0, 0, 0.27), Y),
            urdf((0, 0, 0.07), X),
            urdf((0.302, 0, 0), Y),
            urdf((0.072, 0, 0), X),
        )
    ),
    # The table of the source stands on the floor, 26.45 inches below the shoulder; the pool's begins there.
    "puma560": Published(
        (
            classic(0, 0, 0, pi / 2),
            classic(0, 0, 0.4318, 0),
            classic(0, 0.15005, 0.0203, -pi / 2),
            classic(0, 0.4318, 0, pi / 2),
            classic(0, 0, 0, -pi / 2),
            classic(0, 0, 0, 0),
        ),
        zero=(pi, pi, 0, 0, 0, 0),
    ),
    "stanford": Published(
        (
            modified(d=0.412),
            modified(-pi / 2, 0.154),
            modified(pi / 2, slides=True),
            modified(),
            modified(-pi / 2),
            modified(pi / 2, 0.263),
        )
    ),
    "lr_mate": Published(
        (
            urdf((0, 0, 0.330), Z),
            urdf((0.075, 0, 0), Y),
            urdf((0, 0, 0.300), (0, -1, 0)),
            urdf((0, 0, 0.075), (-1, 0, 0)),
            urdf((0.320, 0, 0), (0, -1, 0)),
            urdf((0.080, 0, 0), (-1, 0, 0)),
        )
    ),
    "kr6": Published(
        (
            urdf((0, 0, 0.400), (0, 0, -1)),
            urdf((0.025, 0, 0), Y),
            urdf((0.455, 0, 0), Y),
            urdf((0, 0, 0.035), (-1, 0, 0)),
            urdf((0.420, 0, 0), Y),
            urdf((0.080, 0, 0), (-1, 0, 0)),
        ),
        sense=(-1, 1, 1, -1, 1, -1),
    ),
    "tx2_60": Published(
        (
            urdf((0, 0, 0.375), Z),
            urdf((0, 0, 0), Y),
            urdf((0, 0.02, 0.29), Y),
            urdf((0, 0, 0), Z),
            urdf((0, 0, 0.31), Y),
            urdf((0, 0, 0.07), Z),
        )
    ),
}


def pose(published: Published, q: np.ndarray) -> np.ndarray:
    frame = np.eye(4)
    for joint, value in zip(published.joints, published.sense * q + published.zero, strict=True):
        frame = frame @ joint(value)
    return frame


@pytest.mark.parametrize("name", PUBLISHED)
def test_an_arm_that_can_be_bought_moves_as_its_source_says(name):
    """At any joint values the end effectors are in one place, and one constant turn apart."""
    drawn = np.random.default_rng(1).uniform(-3, 3, (30, 6))
    ours = arms()[name].table.forward(drawn)
    theirs = np.array([pose(PUBLISHED[name], q) for q in drawn])
    np.testing.assert_allclose(ours[:, :3, 3], theirs[:, :3, 3], atol=1e-8)
    apart = np.swapaxes(theirs[:, :3, :3], 1, 2) @ ours[:, :3, :3]
    np.testing.assert_allclose(apart, np.broadcast_to(apart[0], apart.shape), atol=1e-8)


def test_every_arm_that_can_be_bought_has_a_source():
    """Robots have a name of their own; of made-up ones the title says what they are."""
    bought = {name for name, arm in arms().items() if arm.title[:1].isupper()}
    assert bought == {name for name, arm in arms().items() if arm.source} == set(PUBLISHED)
