"""The scene of a serial robot: what a notebook says to it, and what it asks of a student's own function."""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ..drawing.inputs import as_number, as_numbers, as_rows
from .arm import frame_names, read_arm
from .live import Live

MOST_GHOSTS = 64
MOST_POINTS = 20_000
MOST_IN_CLOUD = 5_000
_CLOSE = 5e-4  # metres: a posture that comes so near has its hand in the place
_LONGEST = 200  # letters of what is said of a student's function


class Scene(Live):
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
    inverse : function, optional
        All postures for a pose of the hand, a 4x4 array seen from the base: rows of n joint values, or an empty list.
        It is asked anew whenever the reader moves the hand, and its answers stand as ghosts; what goes wrong in it is
        told in words. In a page without Python the ghosts are led along by the browser itself.
    cloud : bool or array-like, shape (k, 3), optional
        The workspace as points in metres; True: reached with random joint values within the limits.
    trace, ellipsoid : bool
        Draw the way of the hand; its velocity ellipsoid, with what the hand loses near a singular posture. The reader
        has a button for each.
    tool : bool or 4x4 matrix
        True: the last row of a table of numbers is a tool, not a joint. A matrix: the hand seen from the last frame.
    limits : sequence of n pairs (lowest, highest), optional
        Of each joint, in radians or metres, which are drawn and which the hand keeps to; by default a full turn, and
        for a slide about half of the robot's lengths.
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

    With a student's own function, all postures follow the hand:

    >>> Scene(table, inverse=lambda T: both_elbows(T[0, 3], T[1, 3]))
    """

    def __init__(
        self,
        table: Any,
        values: Mapping[Any, Any] | None = None,
        q: Sequence[float] | None = None,
        *,
        inverse: Callable[[np.ndarray], Any] | None = None,
        cloud: Any = None,
        trace: bool = False,
        ellipsoid: bool = False,
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
        self._inverse = inverse
        self._shown = [
            name for name, on in {"trace": trace, "ellipsoid": ellipsoid, "cloud": True, "limits": True}.items() if on
        ]
        self._cloud = _points(self.arm.reached(4_000) if cloud is True else cloud)
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
            if self._inverse:
                self._widget.ghosts = self._branches()[0]

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
            Postures at equal times, two or more. A joint that may go round goes the shorter way from each to the next.
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
        self._path, self._run = self._unwound(rows), self._run + 1
        if self._widget is not None:
            self._widget.set_trait("path", self._path)
            self._widget.set_trait("seconds", self._seconds)
            self._widget.set_trait("run", self._run)
        return self

    def _draw(self) -> Any:
        """The postures side by side if there are ghosts, else the robot."""
        from ..drawing import draw_chain, draw_posture_gallery

        ghosts = self._branches()[0] if self._inverse else self._ghosts
        if ghosts and self.arm.tool is None:
            return draw_posture_gallery([self.arm.table(q) for q in ghosts[:16]])
        fixed = self.arm.tool is None and self.arm.ends_in_tool
        names = self.names if self.arm.tool is None else self.names[:-1]
        shown = [i for i in self._frames if i < len(names)]
        return draw_chain(self.arm.table(self._q), tool=fixed, frames=shown, names=names)

    def state(self) -> dict[str, Any]:
        """All that the browser needs, as JSON holds it; the points of a cloud as bytes in base 64."""
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
                "shown": self._shown,
                "asks": self._inverse is not None,
            },
            "q": self._q,
            "ghosts": self._branches()[0] if self._inverse else self._ghosts,
            "cloud": base64.b64encode(self._cloud.tobytes()).decode(),
            "path": self._path,
            "seconds": self._seconds,
            "run": self._run,
        }

    def _in_words(self) -> str:
        return f"robot with {len(self.arm.joints)} joints: {', '.join(joint.name for joint in self.arm.joints)}"

    def _make_widget(self) -> Any:
        from .widget import SceneWidget

        widget = SceneWidget(**self.state() | {"cloud": self._cloud.tobytes()})
        widget.observe(self._moved, "q")
        widget.observe(self._asked, "asked")
        return widget

    def _moved(self, change: Any) -> None:
        self._q = list(change.new)

    def _asked(self, change: Any) -> None:
        """The reader has moved the hand: answer with all postures for it."""
        self._q = list(change.new["q"])
        ghosts, words = self._branches()
        self._widget.answer = {"number": change.new["number"], "ghosts": ghosts, "words": words}

    def _branches(self) -> tuple[list[list[float]], str]:
        """What the student's function gives for the hand as it stands, and in words what is wrong with it."""
        pose = self.arm.hands(np.array(self._q))
        try:
            found = self._inverse(pose.copy())  # type: ignore[misc]
            if found is None or found is ...:
                return [], "inverse: nothing comes back yet"
            rows = self._rows(found, "inverse", MOST_GHOSTS)
        except Exception as error:  # whatever may go wrong in it
            words = str(error) or type(error).__name__
            return [], f"inverse: {words.removeprefix('inverse: ')}"[:_LONGEST]
        if not rows:
            return [], "inverse: no posture for this place"
        away = np.linalg.norm(self.arm.hands(np.array(rows))[:, :3, 3] - pose[:3, 3], axis=1)
        worst = int(away.argmax())
        return rows, f"posture {worst + 1} misses the ring by {away[worst]:.3f} m" if away[worst] > _CLOSE else ""

    def _unwound(self, path: list[list[float]]) -> list[list[float]]:
        """A path without the leaps by full turns that inverse functions make."""
        if not path:
            return path
        rows = np.array(path)
        round_and_round = [
            not joint.prismatic and joint.high - joint.low > 2 * np.pi - 1e-6 for joint in self.arm.joints
        ]
        rows[:, round_and_round] = np.unwrap(rows[:, round_and_round], axis=0)
        return rows.tolist()

    def _rows(self, rows: Any, what: str, most: int = MOST_POINTS) -> list[list[float]]:
        """Postures as lists of finite numbers; a single one may stand alone."""
        joints = self.arm.joints
        try:
            flat = np.array(rows, dtype=float)
            found = as_rows(flat.reshape(1, -1) if flat.size == len(joints) else flat, what, len(joints))
        except (TypeError, ValueError):
            names = ", ".join(joint.name for joint in joints)
            text = str(_plain(rows)).replace("\n", " ")
            raise ValueError(
                f"{what}: a posture of this robot is {len(joints)} finite numbers ({names}), found {text[:60]}"
            ) from None
        if len(found) > most:
            raise ValueError(f"{what}: expected at most {most} postures, found {len(found)}")
        return found.tolist()


def _points(cloud: Any) -> np.ndarray:
    """Points of a cloud as single precision, thinned out where they are too many."""
    if cloud is None or cloud is False:
        return np.empty((0, 3), dtype=np.float32)
    points = as_numbers(cloud, "cloud", (None, 3))
    return points[:: -(-len(points) // MOST_IN_CLOUD) or 1].astype("<f4")


def _plain(rows: Any) -> Any:
    """Rows of numbers as Python writes them, not as NumPy does; anything else as it is."""
    try:
        found = np.array(rows)
    except Exception:  # whatever the student's function gave
        return rows
    return found.tolist() if found.dtype.kind in "biuf" else rows


def _shown(frames: Sequence[int] | None, count: int) -> list[int]:
    if frames is None:
        return list(range(count)) if count <= 4 else [0, count - 1]
    if wrong := [i for i in frames if not (isinstance(i, int | np.integer) and 0 <= i < count)]:
        raise ValueError(f"frames: expected indices from 0 to {count - 1}, found {wrong[0]}")
    return sorted({int(i) for i in frames})
