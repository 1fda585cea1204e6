"""A live scene beside the picture of a student's own result, where somebody sits before the notebook."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from IPython.display import display

from ..watched import is_watched


def beside(make: Callable[[], Any]) -> None:
    """Show the scene that `make` gives, if anybody watches; nobody else pays for it.

    What is wrong with an answer is told by its picture: where no scene can be made of it there is none.
    """
    if not is_watched():
        return
    try:
        scene = make()
    except Exception:
        return
    display(scene)


def robot(table: Any, values: dict[str, float], **options: Any) -> Any:
    """The scene of a table: see `dhkit.scene.Scene`."""
    from ..scene import Scene

    return Scene(table, values, **options)


def postures(table: Callable[..., Any], solutions: Any, joints: int, inverse: Callable[..., Any] | None = None) -> Any:
    """The scene of joint solutions, shape (k, joints), of a table that is a function of the joint values.

    With an inverse model, which is asked for the pose of the hand, they follow the hand.
    """
    import sympy

    variables = sympy.symbols(table.__code__.co_varnames[:joints])
    scene = robot(table(*variables), {}, q=solutions[0], inverse=inverse)
    return scene if inverse else scene.ghosts(solutions)


def planar_arm(lengths: Any, solutions: Any = (), inverse: Callable[..., Any] | None = None) -> Any:
    """The scene of a planar 2R arm with joint solutions (t1, t2), or with an inverse model of its hand's pose."""

    def table(t1: Any, t2: Any) -> list[list[Any]]:
        return [[0, 0, 0, 0, t1], [0, float(lengths[0]), 0, 0, t2], [0, float(lengths[1]), 0, 0, 0]]

    return postures(table, solutions if len(solutions) else [[0.4, 1.0]], 2, inverse)


def modes(base: Any, platform: Any, poses: Any) -> Any:
    """The scene of a planar parallel robot in the first of its poses."""
    from ..scene import ParallelScene

    return ParallelScene(base, platform, poses[0])
