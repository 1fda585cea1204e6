"""The scene of a planar parallel robot: three legs, one platform, and all its modes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..drawing.inputs import as_lengths, as_numbers
from ..drawing.parallel import draw_3rpr, draw_3rrr, platform_points
from .live import Live


class ParallelScene(Live):
    """A 3-RPR or 3-RRR which moves in the reader's browser, with all modes that its drives allow as ghosts.

    Parameters
    ----------
    base, platform : array-like, shape (3, 2), in metres
        Anchors A_i on the base; joints b_i of the platform, seen from its frame.
    pose : (float, float, float)
        x, y (metres) and phi (radians) of the platform to start from.
    bars : (float, float), in metres, optional
        3-RRR: the driven bar of each leg, and the one that carries the platform. Without them the legs are drawn out
        (3-RPR).
    elbows : three signs
        3-RRR: +1 where the second bar turns to the left of the driven one.
    title : str

    Raises
    ------
    ValueError
        In words, for numbers of another form, and for a pose that the legs do not reach.

    Examples
    --------
    >>> scene = ParallelScene([[0, 0], [1, 0], [0.3, 0.6]], [[-0.2, -0.2], [0.2, -0.2], [0.1, 0.3]], (0.55, 0.6, 0.35))
    >>> scene.pose = (0.5, 0.5, 0)
    >>> scene.drives  # lengths of the legs
    """

    def __init__(
        self,
        base: Any,
        platform: Any,
        pose: Sequence[float],
        bars: Sequence[float] | None = None,
        *,
        elbows: Sequence[int] = (1, 1, 1),
        title: str = "",
    ) -> None:
        self._base = as_numbers(base, "base", (3, 2))
        self._platform = as_numbers(platform, "platform", (3, 2))
        self._bars = None if bars is None else as_lengths(bars, "bars", (2,))
        self._elbows = np.where(as_numbers(elbows, "elbows", (3,)) < 0, -1, 1)
        self.title = str(title)
        self.pose = pose  # type: ignore[assignment]

    @property
    def pose(self) -> list[float]:
        """x, y (metres) and phi (radians) of the platform, as set here or by the reader."""
        return list(self._pose)

    @pose.setter
    def pose(self, values: Sequence[float]) -> None:
        pose = as_numbers(values, "pose", (3,))
        self._drives(pose)
        self._pose = pose.tolist()
        if self._widget is not None:
            self._widget.pose = self._pose

    @property
    def drives(self) -> list[float]:
        """What the motors measure: three leg lengths in metres, or three angles of the driven bars in radians."""
        return self._drives(np.array(self._pose))[:, 0].tolist()

    def _drives(self, pose: np.ndarray) -> np.ndarray:
        """Rows (drive, elbow) of the legs; the elbow of a leg that is drawn out is 0."""
        legs = platform_points(self._platform, pose) - self._base
        lengths = np.hypot(*legs.T)
        if self._bars is None:
            return np.column_stack([lengths, np.zeros(3)])
        first, second = self._bars
        cosine = (lengths**2 - first**2 - second**2) / (2 * first * second)
        if (far := np.flatnonzero(np.abs(cosine) > 1)).size:
            raise ValueError(
                f"pose: leg {far[0] + 1} would have to span {lengths[far[0]]:.3f} m, its bars reach from "
                f"{abs(first - second):.3f} to {first + second:.3f} m"
            )
        bend = self._elbows * np.arccos(cosine)
        turn = np.arctan2(legs[:, 1], legs[:, 0]) - np.arctan2(second * np.sin(bend), first + second * np.cos(bend))
        return np.column_stack([turn, bend])

    def state(self) -> dict[str, Any]:
        """All that the browser needs, as JSON holds it."""
        longest = float(np.ptp(np.vstack([self._base, platform_points(self._platform, self._pose)]), axis=0).max())
        ends = (-np.pi, np.pi) if self._bars is not None else (0.05, round(max(2 * longest, 1.2 * max(self.drives)), 1))
        return {
            "legs": {
                "title": self.title,
                "base": self._base.tolist(),
                "platform": self._platform.tolist(),
                "bars": None if self._bars is None else self._bars.tolist(),
                "elbows": self._elbows.tolist(),
                "drives": [{"low": ends[0], "high": ends[1], "step": 0.01}] * 3,
            },
            "pose": self._pose,
        }

    def _draw(self) -> Any:
        if self._bars is None:
            return draw_3rpr(self._base, self._platform, self._pose)
        solutions = [self._drives(np.array(self._pose)).ravel()]
        return draw_3rrr(self._base, self._platform, self._bars, self._pose, solutions)

    def _in_words(self) -> str:
        return f"parallel robot with three legs, {'3-RPR' if self._bars is None else '3-RRR'}"

    def _make_widget(self) -> Any:
        from .widget import ParallelWidget

        widget = ParallelWidget(**self.state())
        widget.observe(self._moved, "pose")
        return widget

    def _moved(self, change: Any) -> None:
        self._pose = list(change.new)
