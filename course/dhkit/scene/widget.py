"""The scene as a widget. This module alone imports anywidget: who draws nothing does not pay for it."""

from typing import Any

import anywidget
import traitlets

from .page import script

PROGRAM = script() + "export default dhkitScene.default;"


class SceneWidget(anywidget.AnyWidget):
    """What kernel and browser share of a scene: see `Scene.state`."""

    _esm = PROGRAM
    arm = traitlets.Dict().tag(sync=True)
    q: Any = traitlets.List(traitlets.Float()).tag(sync=True)
    ghosts: Any = traitlets.List().tag(sync=True)
    path: Any = traitlets.List().tag(sync=True)
    seconds = traitlets.Float().tag(sync=True)
    run = traitlets.Int().tag(sync=True)
    cloud = traitlets.Bytes().tag(sync=True)
    asked: Any = traitlets.Dict().tag(sync=True)
    answer: Any = traitlets.Dict().tag(sync=True)


class ParallelWidget(anywidget.AnyWidget):
    """What kernel and browser share of a parallel robot: see `ParallelScene.state`."""

    _esm = PROGRAM
    legs = traitlets.Dict().tag(sync=True)
    pose: Any = traitlets.List(traitlets.Float()).tag(sync=True)
