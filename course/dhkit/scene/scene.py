"""The scene itself: what a notebook says to a robot, shown by a widget, by a page, or by a still drawing."""

from __future__ import annotations

import base64
import os
import sys
from collections.abc import Mapping, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from ..drawing.inputs import as_number, as_rows
from .arm import frame_names, read_arm
from .page import write_page

MOST_GHOSTS = 64
MOST_POINTS = 20_000


class Scene:
    """A robot in space from its table, which moves in the reader's browser.

    Parameters
    ----------
    table : rows [sigma, a, alpha, d, theta], numbers or SymPy; metres and radians
        Modified DH. The symbols of theta (sigma = 0) and d (sigma = 1) are the joint variables, in the order of the
        rows; a row without one is fixed, such as the row of a tool. In a table of numbers each row is a joint, which
        starts at its number.
    values : dict, optional
        Numbers for the lengths, by name: ``{"a2": 0.4, "a3": 0.3}``. A number for a joint variable is where it starts.
    q : sequence of n numbers, optional
        Joint values to start from; by default zeros.
    tool : bool or 4x4 matrix
        True: the last row of a table of numbers is a tool, not a joint. A matrix: the hand seen from the last frame.
    limits : sequence of n pairs (lowest, highest), optional
        Of each joint, in radians or metres; by default a full turn, and for a slide about half of the robot's lengths.
    names : sequence of texts, optional
        Names of the frames, by default 0, 1, ..., and E for a tool.
    frames : sequence of indices, optional
        Frames that are shown at first, by default all of a short robot, else the first and the last.
    title : str

    Raises
    ------
    ValueError
        In words, for a table or numbers of another form.

    Examples
    --------
    >>> t1, t2 = sympy.symbols("t1 t2")
    >>> scene = Scene([[0, 0, 0, 0, t1], [0, 0.5, 0, 0, t2], [0, 0.4, 0, 0, 0]])
    >>> scene.q = [0.3, 1.2]
    """

    def __init__(
        self,
        table: Any,
        values: Mapping[Any, Any] | None = None,
        q: Sequence[float] | None = None,
        *,
        tool: Any = False,
        limits: Sequence[tuple[float, float]] | None = None,
        names: Sequence[Any] | None = None,
        frames: Sequence[int] | None = None,
        title: str = "",
    ) -> None:
        self.arm = read_arm(table, values, tool, limits)
        self.names = frame_names(self.arm, names)
        self.title = str(title)
        self._frames = _shown(frames, len(self.names))
        self._q = list(self.arm.start)
        self._ghosts: list[list[float]] = []
        self._path: list[list[float]] = []
        self._seconds = 4.0
        self._run = 0
        self._widget: Any = None
        if q is not None:
            self.q = q  # type: ignore[assignment]

    @property
    def q(self) -> list[float]:
        """Joint values in radians and metres, as set here or by the reader's sliders."""
        return list(self._q)

    @q.setter
    def q(self, values: Sequence[float]) -> None:
        rows = self._rows(values, "q", 1)
        if not rows:
            raise ValueError("q: expected a posture, found none")
        self._q = rows[0]
        if self._widget is not None:
            self._widget.q = self._q

    def ghosts(self, solutions: Any) -> Scene:
        """Set postures beside the robot, to compare and to click; an empty list takes them away.

        Parameters
        ----------
        solutions : rows of n joint values, shape (k, n)
            For instance all that an inverse model returns.

        Returns
        -------
        Scene
            Itself, so that it is shown at the end of a cell.
        """
        self._ghosts = self._rows(solutions, "solutions", MOST_GHOSTS)
        if self._widget is not None:
            self._widget.ghosts = self._ghosts
        return self

    def play(self, path: Any, seconds: float = 4.0) -> Scene:
        """Move along a path, drawing the trace of the hand; an empty list takes it away.

        Parameters
        ----------
        path : rows of n joint values, shape (k, n)
            Postures at equal times, two or more.
        seconds : float
            How long it takes.

        Returns
        -------
        Scene
            Itself, so that it is shown at the end of a cell.
        """
        rows = self._rows(path, "path")
        if len(rows) == 1:
            raise ValueError("path: expected two or more postures, found one")
        self._seconds = as_number(seconds, "seconds")
        if not 0 < self._seconds <= 600:
            raise ValueError(f"seconds: expected more than 0, and at most 600, found {self._seconds:g}")
        self._path, self._run = rows, self._run + 1
        if self._widget is not None:
            self._widget.set_trait("path", rows)
            self._widget.set_trait("seconds", self._seconds)
            self._widget.set_trait("run", self._run)
        return self

    def save(self, file: str | os.PathLike[str]) -> None:
        """Write a page with the scene as it stands, which needs neither Python nor a network.

        Parameters
        ----------
        file : path
            For instance ``"arm.html"``.
        """
        Path(file).write_text(write_page(self.title or "Robot", self.state()), encoding="utf-8")

    def still(self) -> bytes:
        """The still drawing, as PNG: the postures side by side if there are ghosts, else the robot."""
        import matplotlib.pyplot as plt

        from ..drawing import draw_chain, draw_posture_gallery

        if self._ghosts and self.arm.tool is None:
            ax = draw_posture_gallery([self.arm.table(q) for q in self._ghosts[:16]])
        else:
            fixed = self.arm.tool is None and self.arm.ends_in_tool
            names = self.names if self.arm.tool is None else self.names[:-1]
            shown = [i for i in self._frames if i < len(names)]
            ax = draw_chain(self.arm.table(self._q), tool=fixed, frames=shown, names=names)
        buffer = BytesIO()
        ax.figure.savefig(buffer, format="png", dpi=90, bbox_inches="tight")
        plt.close(ax.figure)
        return buffer.getvalue()

    def state(self) -> dict[str, Any]:
        """All that the browser needs, as JSON holds it."""
        arm = self.arm
        # The layout of the body is chosen with all slides drawn out.
        nominal = [joint.high if joint.prismatic else 0.0 for joint in arm.joints]
        return {
            "arm": {
                "title": self.title,
                "rows": arm.rows.tolist(),
                "coupling": arm.coupling.tolist(),
                "tool": None if arm.tool is None else arm.tool.ravel().tolist(),
                "letters": [{"a": a, "d": d} for a, d in arm.letters],
                "joints": [vars(joint) for joint in arm.joints],
                "names": self.names,
                "frames": self._frames,
                "nominal": nominal,
            },
            "q": self._q,
            "ghosts": self._ghosts,
            "path": self._path,
            "seconds": self._seconds,
            "run": self._run,
        }

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, Any]:
        """The widget with the still drawing beside it, for a printed notebook or a kernel without widgets."""
        bundle: dict[str, Any] = {
            "text/plain": f"robot with {len(self.arm.joints)} joints: {', '.join(joint.name for joint in self.arm.joints)}",
            "image/png": base64.b64encode(self.still()).decode(),
        }
        if (widget := self._live()) is not None:
            view = {"version_major": 2, "version_minor": 0, "model_id": widget.model_id}
            bundle["application/vnd.jupyter.widget-view+json"] = view
        return bundle

    def _live(self) -> Any:
        """The widget, made at first use; None where there is none."""
        if self._widget is None and is_watched():
            try:
                from .widget import SceneWidget
            except ImportError:
                return None
            self._widget = SceneWidget(**self.state())
            self._widget.observe(self._moved, "q")
        return self._widget

    def _moved(self, change: Any) -> None:
        self._q = list(change.new)

    def _rows(self, rows: Any, what: str, most: int = MOST_POINTS) -> list[list[float]]:
        """Postures as lists of finite numbers; a single one may stand alone."""
        joints = self.arm.joints
        try:
            flat = np.array(rows, dtype=float)
            found = as_rows(flat.reshape(1, -1) if flat.size == len(joints) else flat, what, len(joints))
        except (TypeError, ValueError):
            names = ", ".join(joint.name for joint in joints)
            text = str(rows).replace("\n", " ")
            raise ValueError(
                f"{what}: a posture of this robot is {len(joints)} finite numbers ({names}), found {text[:60]}"
            ) from None
        if len(found) > most:
            raise ValueError(f"{what}: expected at most {most} postures, found {len(found)}")
        return found.tolist()


def is_watched() -> bool:
    """Whether somebody sits before the notebook and could turn a robot.

    Who runs one unattended (nbconvert, the grader) tells the kernel that nobody will answer its questions.
    """
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    kernel = getattr(shell, "kernel", None)
    if kernel is None:
        return False
    request = kernel.get_parent("shell") if hasattr(kernel, "get_parent") else {}
    return bool(request.get("content", {}).get("allow_stdin", True))


def _shown(frames: Sequence[int] | None, count: int) -> list[int]:
    if frames is None:
        return list(range(count)) if count <= 4 else [0, count - 1]
    if wrong := [i for i in frames if not (isinstance(i, int | np.integer) and 0 <= i < count)]:
        raise ValueError(f"frames: expected indices from 0 to {count - 1}, found {wrong[0]}")
    return sorted({int(i) for i in frames})
