"""Drawings of any serial robot from its table of modified DH parameters, as a body in space with axes and frames.

A robot is a list of rows [sigma, a, alpha, d, theta], as in the tables of the course. Link i runs from O_i along the
common normal to axis i + 1, then along that axis; the joints sit on the way, where a robot would have them.
"""

from __future__ import annotations

import itertools

import numpy as np
import sympy
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from .. import strokes
from .frames import merged_axes

LINK, JOINT, HAND = 0.80, 0.97, 0.62


# ---------------------------------------------------------------- from a table to frames


def _as_rows(rows, values) -> np.ndarray:
    """The table as numbers, shape (n, 5); `values` are the numbers for its symbols, by name."""
    given = {str(name): value for name, value in (values or {}).items()}
    rows = rows.tolist() if hasattr(rows, "tolist") else rows
    try:
        rows = [list(row) for row in rows]
    except TypeError:
        raise ValueError(f"table: expected rows [sigma, a, alpha, d, theta], found {rows!r}") from None
    symbols = {s for row in rows for entry in row for s in getattr(entry, "free_symbols", ())}
    if missing := sorted({str(s) for s in symbols} - set(given)):
        raise ValueError(f"values: expected a number for {', '.join(missing)}, found none")
    numbers = {s: given[str(s)] for s in symbols}
    rows = [[e.subs(numbers) if isinstance(e, sympy.Basic) else e for e in row] for row in rows]
    table = strokes.as_numbers(rows, "table with rows [sigma, a, alpha, d, theta]", (None, 5))
    if not np.isin(table[:, 0], (0, 1)).all():
        raise ValueError("sigma: expected 0 (revolute) or 1 (prismatic) in every row")
    return table


def _transform(a, alpha, d, theta) -> np.ndarray:
    ca, sa, ct, st = np.cos(alpha), np.sin(alpha), np.cos(theta), np.sin(theta)
    return np.array([[ct, -st, 0, a], [ca * st, ca * ct, -sa, -sa * d], [sa * st, sa * ct, ca, ca * d], [0, 0, 0, 1]])


def _frames(table) -> np.ndarray:
    frames = [np.eye(4)]
    for row in table:
        frames.append(frames[-1] @ _transform(*row[1:]))
    return np.array(frames)


def chain_frames(rows, values=None) -> np.ndarray:
    """Frames 0 to n of a robot seen from its base.

    Parameters
    ----------
    rows : list of n rows [sigma, a, alpha, d, theta], numbers or SymPy; metres and radians
    values : dict, optional
        Numbers for the symbols, by name.

    Returns
    -------
    ndarray, shape (n + 1, 4, 4)
    """
    return _frames(_as_rows(rows, values))


# ---------------------------------------------------------------- bodies: quads that one collection sorts by depth


class Bodies:
    """Quads of tubes, balls and boxes with a shade each, seen from one direction and drawn with an ink outline."""

    def __init__(self, ax, unit, fine=16):
        elev, azim = np.radians([ax.elev, ax.azim])
        self.towards = np.array([np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)])
        light = self.towards + 0.9 * np.array([0, 0, 1]) + 0.55 * np.array([np.sin(azim), -np.cos(azim), 0])
        self.light = light / np.linalg.norm(light)
        self.rim, self.fine = 0.0042 * unit, fine
        self.quads, self.colours = [], []

    def add(self, make, shade):
        """`make(rim)` returns quads (k, 4, 3) and their outward normals (k, 3), swollen by `rim`."""
        quads, normals = make(0.0)
        front = normals @ self.towards > 0
        lit = 0.62 + 0.42 * np.clip(normals @ self.light, 0, 1)
        self.quads.append(quads[front])
        self.colours.append(
            np.clip(np.outer(lit, np.asarray(to_rgb(str(shade)) if np.isscalar(shade) else shade)), 0, 1)[front]
        )
        quads, normals = make(self.rim)
        # The far side of a slightly larger ink body: what shows of it is the outline.
        back = normals @ self.towards <= 0
        self.quads.append(quads[back])
        self.colours.append(np.tile(to_rgb(strokes.INK), (back.sum(), 1)))

    def tube(self, start, end, radius, shade, caps=False):
        start, end = np.asarray(start, float), np.asarray(end, float)
        length = np.linalg.norm(end - start)
        if length < 1e-9:
            return
        along = (end - start) / length
        side = np.cross(along, np.eye(3)[np.argmin(np.abs(along))])
        side /= np.linalg.norm(side)
        turn = np.linspace(0, 2 * np.pi, self.fine + 1)
        ring = np.outer(np.cos(turn), side) + np.outer(np.sin(turn), np.cross(along, side))
        middle = (ring[:-1] + ring[1:]) / 2

        def make(rim):
            first = start - (rim * along if caps else 0)
            reach = length + (2 * rim if caps else 0)
            steps = np.linspace(0, reach, max(2, int(np.ceil(reach / (1.5 * radius)))) + 1)
            rings = first + steps[:, None, None] * along + (radius + rim) * ring
            sides = np.stack([rings[:-1, :-1], rings[:-1, 1:], rings[1:, 1:], rings[1:, :-1]], axis=2).reshape(-1, 4, 3)
            normals = np.tile(middle, (len(steps) - 1, 1))
            if caps:
                for rim_ring, centre, out in ((rings[0], first, -along), (rings[-1], first + reach * along, along)):
                    c = np.broadcast_to(centre, rim_ring[:-1].shape)
                    sides = np.vstack([sides, np.stack([c, rim_ring[:-1], rim_ring[1:], c], axis=1)])
                    normals = np.vstack([normals, np.tile(out, (len(c), 1))])
            return sides, normals

        self.add(make, shade)

    def ball(self, centre, radius, shade):
        up = np.linspace(0, np.pi, self.fine // 2 + 1)
        turn = np.linspace(0, 2 * np.pi, self.fine + 1)
        grid = np.stack(
            [
                np.outer(np.sin(up), np.cos(turn)),
                np.outer(np.sin(up), np.sin(turn)),
                np.outer(np.cos(up), turn * 0 + 1),
            ],
            -1,
        )
        quads = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]], axis=2).reshape(-1, 4, 3)
        normals = quads.mean(axis=1)
        self.add(lambda rim: (centre + (radius + rim) * quads, normals), shade)

    def box(self, centre, axes, half, shade, cells=3):
        """`axes` (3, 3): the directions of the edges as columns; `half` the half lengths."""
        grid = np.linspace(-1, 1, cells + 1)
        u, v = np.meshgrid(grid, grid, indexing="ij")
        faces, normals = [], []
        for k in range(3):
            for sign in (-1, 1):
                face = np.zeros((*u.shape, 3))
                face[..., k], face[..., (k + 1) % 3], face[..., (k + 2) % 3] = sign, u, v
                quads = np.stack([face[:-1, :-1], face[:-1, 1:], face[1:, 1:], face[1:, :-1]], axis=2)
                faces.append(quads.reshape(-1, 4, 3))
                normals.append(np.tile(sign * axes[:, k], (cells * cells, 1)))
        faces, normals = np.vstack(faces), np.vstack(normals)
        self.add(lambda rim: (centre + (faces * (np.asarray(half) + rim)) @ axes.T, normals), shade)

    def draw(self, ax, zorder=1.0):
        if self.quads:
            colours = np.vstack(self.colours)
            body = Poly3DCollection(
                np.vstack(self.quads), facecolors=colours, edgecolors=colours, linewidths=0.8, zorder=zorder
            )
            ax.add_collection3d(body, autolim=False)

    def points(self) -> np.ndarray:
        return np.vstack(self.quads).reshape(-1, 3) if self.quads else np.zeros((0, 3))


# ---------------------------------------------------------------- the robot on its way from base to hand


class _Robot:
    """Where a robot's joints, links and hand are drawn."""

    def __init__(self, table, tool, unit=None):
        self.table, self.tool = table, tool
        self.frames = _frames(table)
        self.origins, self.z = self.frames[:, :3, 3], self.frames[:, :3, 2]
        self.feet = self.origins[:-1] + table[:, 1:2] * self.frames[:-1, :3, 0]
        self.joints = range(1, len(table) + (0 if tool else 1))
        length = np.abs(table[:, [1, 3]]).sum()
        self.unit = unit or (length if length > 0 else 1.0)
        self.radius = 0.024 * self.unit
        self.half = 2.0 * self.radius
        reach = np.abs(table[-1, [1, 3]]).sum() if tool else 0.0
        self.scale = (
            min(1.0, reach / (7 * self.radius)) if reach > 0 else 1.0
        )  # of hand and last joint: they share the tool's length
        self.centres = {i: self._centre(i) for i in self.joints}
        self.hand = self._hand()
        self._part()

    def _centre(self, i):
        """Middle of joint i: of the walk d_i, or the guide at its beginning; O_i where d_i is short."""
        foot, origin = self.feet[i - 1], self.origins[i]
        walk = np.linalg.norm(origin - foot)
        if self.table[i - 1, 0] == 1:
            return foot if walk > self.half else origin
        return (foot + origin) / 2 if walk > 3.2 * self.half else origin.copy()

    def _part(self):
        """Move joints that lie on one another apart, along their own axes."""
        last = len(self.joints)
        for i in self.joints:
            if i == last or np.linalg.norm(self.centres[i] - self.centres[i + 1]) > 1.6 * self.half:
                continue
            same_axis = np.linalg.norm(np.cross(self.z[i], self.z[i + 1])) < 1e-6 and self.table[i, 1] == 0
            if i + 1 == last and (i > 1 or same_axis):
                way = np.sign(self.hand @ self.z[last]) if self.hand is not None and self.hand @ self.z[last] else 1
                self.centres[last] = self.origins[last] + way * self._forward() * self.z[last]
            else:
                self.centres[i] = self.centres[i] - 2.6 * self.half * self.z[i]

    def _forward(self):
        """How far the last joint may stand before the one it meets: within the tool, if that is short."""
        room = 2.2 * self.half
        return max(0.8 * self.half, room * self.scale) if self.tool and self.table[-1, 3] else room

    def _hand(self):
        """Direction in which the hand points, or None where the table does not tell of a hand."""
        n = len(self.table)
        if self.tool:
            a, d = self.table[-1, 1], self.table[-1, 3]
            if abs(d) > 1e-9:
                return np.sign(d) * self.z[n]
            return np.sign(a) * self.frames[n - 1, :3, 0] if abs(a) > 1e-9 else self.z[n]
        if n < 2 or self.table[-1, 1] != 0:
            return None
        if abs(np.sin(self.table[-1, 2])) < 1e-9:
            walks = self.origins[1:] - self.feet
            lengths = np.linalg.norm(walks, axis=1)
            k = np.flatnonzero(lengths > 1e-9)
            along = walks[k[-1]] @ self.z[n] if len(k) else 0.0
            return np.sign(along) * self.z[n] if abs(along) > 1e-9 else self.z[n]
        return self.z[n]

    def build(self, bodies, link=LINK, joint=JOINT, hand=HAND, base=LINK):
        """Add base, links, joints and hand to `bodies`."""
        r = self.radius
        self.base(bodies, base)
        stops = {0: self.base_top} | self.centres
        for i in range(len(self.table)):
            ends = [stops[i], self.origins[i], self.feet[i]]
            if i + 1 in self.centres:
                ends.append(stops[i + 1])
            else:
                ends.append(self.origins[i + 1] - (0 if self.hand is None else 2.4 * r) * self.hand)
            thin = i > 0 and self.table[i - 1, 0] == 1
            self._path(bodies, ends, r, link, first=0.62 * r if thin else r)
        if not self.tool and len(self.joints):
            n = len(self.table)
            self._path(bodies, [self.centres[n], self.origins[n]], 0.62 * r if self.table[-1, 0] == 1 else r, link)
        for i in self.joints:
            if self.table[i - 1, 0] == 1:
                # The guide stands still while joint i moves: its edges are those of the frame before.
                along = self.z[i]
                side = self.frames[i - 1, :3, 0]
                axes = np.column_stack([side, np.cross(along, side), along])
                bodies.box(self.centres[i], axes, (1.75 * r, 1.75 * r, 1.1 * self.half), joint)
                over = self.feet[i - 1] - self.origins[i]
                far = np.linalg.norm(over)
                over = over / far if far > 1e-9 else along
                bodies.tube(self.centres[i], self.centres[i] + 2.2 * self.half * over, 0.62 * r, link, caps=True)
            else:
                reach = (self.half if i < len(self.joints) else self.half * max(self.scale, 0.4)) * self.z[i]
                bodies.tube(self.centres[i] - reach, self.centres[i] + reach, 1.75 * r, joint, caps=True)
        if self.hand is not None:
            self._jaws(bodies, hand)

    def _path(self, bodies, points, radius, shade, first=None):
        width = first or radius
        for start, end in itertools.pairwise(points):
            if np.linalg.norm(end - start) > 1e-9:
                bodies.tube(start, end, width, shade)
            width = radius
        for point in points[1:-1]:
            bodies.ball(point, radius, shade)

    def base(self, bodies, shade):
        """A column and a plate under joint 1."""
        z0 = self.frames[0, :3, 2]
        walk = (self.feet[0] - self.origins[0]) @ z0
        first = self.centres.get(1, self.origins[0])
        lowest = min((first - self.origins[0]) @ z0, 0.0, walk)
        drop = lowest - (0 if (first - self.origins[0]) @ z0 > 2 * self.half else 2.1 * self.half)
        self.base_top = self.origins[0]
        self.base_foot = self.origins[0] + drop * z0
        plate = self.base_foot + 0.5 * self.radius * z0
        bodies.tube(self.base_foot, plate, 4.2 * self.radius, 0.92 * shade, caps=True)
        if drop < 0:
            bodies.tube(plate, self.origins[0], 1.2 * self.radius, shade)

    def _jaws(self, bodies, shade):
        """Two fingers that slide along Y of the last frame, O of that frame between their tips."""
        n, r = len(self.table), self.radius * max(self.scale, 0.5)
        tip, side = self.origins[n], self.frames[n, :3, 1]
        palm = tip - 2.4 * r * self.hand
        if not self.tool:
            past = max((self.centres[n] - self.origins[n]) @ self.hand, 0) + self.half
            palm = tip + (past + 1.6 * r) * self.hand
            bodies.tube(tip, palm, 0.8 * r, shade)
        axes = np.column_stack([self.hand, side, np.cross(self.hand, side)])
        bodies.box(palm, axes, (0.55 * r, 2.3 * r, 0.8 * r), shade, cells=2)
        for way in (-1, 1):
            bodies.box(
                palm + 1.9 * r * self.hand + way * 1.9 * r * side, axes, (1.5 * r, 0.42 * r, 0.7 * r), shade, cells=2
            )


# ---------------------------------------------------------------- labels that keep out of one another's way


class Labels:
    """Labels in space which are placed together, beside what they name and clear of each other."""

    def __init__(self):
        self.wanted, self.obstacles = [], []

    def ask(self, at, text, towards=None, colour=strokes.INK, fontsize=11, gap=4.0):
        """A label near the point `at`, best past it in the direction `towards` (in space)."""
        self.wanted.append((np.asarray(at, float), text, towards, colour, fontsize, gap))

    def avoid(self, points):
        """Points in space that no label should cover."""
        self.obstacles.append(np.atleast_2d(np.asarray(points, float)))

    def place(self, ax):
        """Choose a place for every label; the view of `ax` must be final."""
        if not self.wanted:
            return
        ax.apply_aspect()
        elev, azim = np.radians([ax.elev, ax.azim])
        right = np.array([-np.sin(azim), np.cos(azim), 0])
        up = np.array([-np.sin(elev) * np.cos(azim), -np.sin(elev) * np.sin(azim), np.cos(elev)])
        anchors = self._pixels(ax, [at for at, *_ in self.wanted])
        scale = np.linalg.norm(np.diff(self._pixels(ax, [self.wanted[0][0], self.wanted[0][0] + right]), axis=0))
        point = ax.figure.dpi / 72
        obstacles = self._pixels(ax, np.vstack(self.obstacles)) if self.obstacles else np.zeros((0, 2))
        frame = ax.figure.bbox
        choices = []
        for (at, text, towards, _, fontsize, gap), anchor in zip(self.wanted, anchors):
            half = point * fontsize * np.array([0.5 * _width(text) + 0.1, 0.62])
            if towards is None:
                heading, steep = np.pi / 2, 0.0
            else:
                way = self._pixels(ax, [at, at + np.asarray(towards, float)])
                heading = np.arctan2(*np.diff(way, axis=0)[0][::-1])
                steep = np.linalg.norm(np.diff(way, axis=0)) / scale / np.linalg.norm(towards)
            options = []
            for turn in np.radians([0, 30, -30, 60, -60, 90, -90, 125, -125, 180]):
                for extra in (0, 9, 20):
                    out = strokes.unit_vector(heading + turn)
                    reach = min(half / np.maximum(np.abs(out), 1e-9)) + (gap + extra) * point
                    cost = (2.2 if steep > 0.25 else 0.8) * abs(turn) + 0.09 * extra
                    options.append((anchor + reach * out, cost))
            choices.append((half, options))
        where = [options[0][0] for _, options in choices]
        placed = set()
        for sweep in range(3):
            for k, (half, options) in enumerate(choices):
                others = [(where[j], choices[j][0]) for j in range(len(choices)) if j != k and (sweep or j in placed)]
                where[k] = min(
                    options, key=lambda option: option[1] + _crowding(option[0], half, others, obstacles, frame)
                )[0]
                placed.add(k)
        for (at, text, _, colour, fontsize, _), anchor, to in zip(self.wanted, anchors, where):
            shift = (to - anchor) / scale
            strokes.write_3d(ax, at + shift[0] * right + shift[1] * up, text, color=colour, fontsize=fontsize)

    @staticmethod
    def _pixels(ax, points) -> np.ndarray:
        points = np.asarray(points, float)
        return ax.transData.transform(np.column_stack(proj3d.proj_transform(*points.T, ax.get_proj())[:2]))


def _width(text: str) -> float:
    """Width of a label in units of its font size, roughly."""
    width, small = 0.0, False
    plain = text
    for word in ("alpha", "theta", "sigma", "mathrm", "frac"):
        plain = plain.replace("\\" + word, "m" if word != "mathrm" else "")
    for letter in plain:
        if letter in "${}\\^":
            small = small and letter != "}"
        elif letter == "_":
            small = True
        else:
            width += 0.42 if small else 0.34 if letter in ",. il" else 0.66
            small = small and letter != ","
    return width


def _crowding(centre, half, others, obstacles, frame) -> float:
    cost = 0.0
    for other, size in others:
        overlap = np.minimum(half + size + 2 - np.abs(centre - other), 2 * np.minimum(half, size))
        if (overlap > 0).all():
            cost += 6 + 12 * overlap.prod() / (4 * half.prod())
    if len(obstacles):
        cost += 0.8 * min((np.abs(obstacles - centre) < half + 1).all(axis=1).sum(), 8)
    outside = np.maximum([frame.x0 + 3, frame.y0 + 3] - (centre - half), 0) + np.maximum(
        (centre + half) - [frame.x1 - 3, frame.y1 - 3], 0
    )
    return cost + 1.5 * outside.sum()


def fill_panel(ax, points, share=0.78):
    """Show `points` as large as the panel allows, centred."""
    points = np.asarray(points, float)
    low, high = points.min(axis=0), points.max(axis=0)
    centre, half = (low + high) / 2, np.full(3, (high - low).max() / 2)
    for _ in range(2):
        for setter, c, h in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), centre, half):
            setter(c - h, c + h)
        ax.set_box_aspect((1, 1, 1), zoom=1)
        ax.apply_aspect()
        on_paper = ax.transData.transform(np.column_stack(proj3d.proj_transform(*points.T, ax.get_proj())[:2]))
        box = ax.get_window_extent()
        room = ax.figure.bbox.size * ax.get_position(original=True).size
        half = half * max(np.ptp(on_paper, axis=0) / (share * room))
        middle = (on_paper.min(axis=0) + on_paper.max(axis=0)) / 2 - (box.p0 + box.p1) / 2
        elev, azim = np.radians([ax.elev, ax.azim])
        right = np.array([-np.sin(azim), np.cos(azim), 0])
        up = np.array([-np.sin(elev) * np.cos(azim), -np.sin(elev) * np.sin(azim), np.cos(elev)])
        start, end = (
            ax.transData.transform(proj3d.proj_transform(*p, ax.get_proj())[:2]) for p in (centre, centre + right)
        )
        scale = np.hypot(*(end - start))
        centre = centre + (middle[0] * right + middle[1] * up) / scale
    for setter, c, h in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), centre, half):
        setter(c - h, c + h)


# ---------------------------------------------------------------- drawings


@strokes.styled
def draw_chain(
    rows, values=None, ax=None, *, tool=False, frames=None, axes=True, normals=False, shade=None, names=None, size=None
):
    """A serial robot as a body: links as tubes, revolute joints as cylinders, prismatic joints as boxes.

    Parameters
    ----------
    rows : list of n rows [sigma, a, alpha, d, theta], numbers or SymPy; metres and radians
        Modified DH; symbols need a number in `values`.
    values : dict, optional
        Numbers for the symbols of the table, by name.
    tool : bool
        The last row is the constant displacement to the tool, not a joint.
    frames : sequence of indices, optional
        Frames to draw, by default all; () draws none.
    axes : bool
        Draw the joint axes as centre lines.
    normals : bool
        Draw the common normals and write a and d beside what they measure.
    shade : int, optional
        Index of a posture shade, for drawings that compare postures.
    names : sequence of n + 1 texts, optional
        Names of the frames, by default 0, 1, ..., and E for a tool.
    size : float, in metres, optional
        Length of the frames' axes; by default from the length of the robot.

    Returns
    -------
    matplotlib Axes (3D)
    """
    table = _as_rows(rows, values)
    count = len(table)
    if count == 0 or (tool and count == 1):
        raise ValueError("table: expected at least one joint, found none")
    names = [str(i) for i in range(count)] + ["E" if tool else str(count)] if names is None else [str(n) for n in names]
    if len(names) != count + 1:
        raise ValueError(f"names: expected {count + 1}, one per frame, found {len(names)}")
    shown = range(count + 1) if frames is None else _indices(frames, count)
    robot = _Robot(table, tool)
    size = robot.unit * 0.15 if size is None else float(strokes.as_lengths(size, "size", ()))
    own, ax = ax is None, ax or strokes.new_axes_3d()
    bodies = Bodies(ax, robot.unit)
    grey = LINK if shade is None else to_rgb(strokes.POSTURE_SHADES[shade % len(strokes.POSTURE_SHADES)])
    robot.build(bodies, link=grey)
    bodies.draw(ax)
    labels = Labels()
    extent = [bodies.points()]
    if axes:
        extent += _draw_axes(ax, robot, labels, names, shown, size)
    if shown:
        extent += _draw_frames(ax, robot.frames[list(shown)], [names[i] for i in shown], size, labels)
    if normals:
        _draw_normals(ax, robot, rows, labels, names)
    _fit(ax, np.vstack(extent), own)
    labels.place(ax)
    return ax


def _fit(ax, extent, own):
    if own:
        strokes.fit_3d(ax, extent, own, pad=0.42)
    else:
        fill_panel(ax, extent)


def _indices(frames, count) -> list[int]:
    frames = [int(i) for i in frames]
    if wrong := [i for i in frames if not 0 <= i <= count]:
        raise ValueError(f"frames: expected indices from 0 to {count}, found {wrong[0]}")
    return frames


def _lines(robot) -> list[tuple[list[int], np.ndarray, np.ndarray]]:
    """The joint axes as lines: joints that share one, a point and a direction."""
    lines = []
    for i in robot.joints:
        point, along = robot.origins[i], robot.z[i]
        for members, foot, other in lines:
            if (
                np.linalg.norm(np.cross(other, along)) < 1e-6
                and np.linalg.norm(np.cross(point - foot, other)) < 1e-6 * robot.unit
            ):
                members.append(i)
                break
        else:
            lines.append(([i], point, along))
    return lines


def _draw_axes(ax, robot, labels, names, shown, size):
    ends = []
    for members, foot, along in _lines(robot):
        stops = (
            [robot.origins[i] for i in members]
            + [robot.centres[i] for i in members]
            + [robot.feet[i - 1] for i in members]
        )
        places = np.array([(stop - foot) @ along for stop in stops])
        low, high = foot + (places.min() - 1.05 * size) * along, foot + (places.max() + 1.5 * size) * along
        ax.plot(*zip(low, high), color=strokes.SOFT, lw=1, ls=strokes.CENTRE_LINE, zorder=2)
        ends.append(np.array([low, high]))
        hidden = [i for i in members if i not in shown]
        if hidden:
            strokes.arrow_3d(
                ax, high - 0.6 * size * along, high, strokes.AXIS_COLOURS["z"], strokes.AXIS_DASHES["z"], width=1.4
            )
            text = ", ".join(f"Z_{{{names[i]}}}" for i in hidden)
            labels.ask(high, f"${text}$", along, strokes.AXIS_COLOURS["z"])
    return ends


def _draw_frames(ax, frames, names, size, labels):
    origins = frames[:, :3, 3]
    ax.plot(*origins.T, "o", ms=4, color=strokes.INK, ls="none", zorder=7)
    tips = []
    for letter, origin, direction, owners in merged_axes(frames, names, "xyz"):
        end = origin + size * direction
        strokes.arrow_3d(ax, origin, end, strokes.AXIS_COLOURS[letter], strokes.AXIS_DASHES[letter], width=1.8)
        text = ", ".join(f"{letter.upper()}_{{{name}}}" for name in owners)
        labels.ask(end, f"${text}$", direction, strokes.AXIS_COLOURS[letter])
        labels.avoid(origin + np.outer(np.linspace(0.1, 1, 9), end - origin))
        tips.append(end[None])
    return [origins, *tips]


def _draw_normals(ax, robot, rows, labels, names):
    """The common normals as ink lines; a and d written beside the walks they measure."""
    rows = rows.tolist() if hasattr(rows, "tolist") else [list(row) for row in rows]
    for i in range(len(robot.table)):
        for what, column, start, end in (
            ("a", 1, robot.origins[i], robot.feet[i]), ("d", 3, robot.feet[i], robot.origins[i + 1])
        ):  # fmt: skip
            length = np.linalg.norm(end - start)
            if length < 1e-6 * robot.unit:
                continue
            style = {"lw": 2.4, "zorder": 3} if what == "a" else {"lw": 1.2, "zorder": 3}
            ax.plot(*zip(start, end), color=strokes.INK, **style)
            entry = rows[i][column]
            index = names[i] if what == "a" else names[i + 1]
            if getattr(entry, "free_symbols", None):
                text = sympy.latex(entry)
            else:
                text = f"{what}_{{{index}}} = {float(entry):.3g}".replace("-", "\N{MINUS SIGN}")
            for way in (start, end):
                ax.plot(*way[:, None], marker=".", ms=4, color=strokes.INK, zorder=3)
            side = np.cross(end - start, _towards(ax))
            labels.ask((start + end) / 2, f"${text}$", side if np.linalg.norm(side) > 1e-9 else None, gap=10)
            labels.avoid(start + np.outer(np.linspace(0, 1, 9), end - start))


def _towards(ax) -> np.ndarray:
    elev, azim = np.radians([ax.elev, ax.azim])
    return np.array([np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)])


def _bulge(robot):
    """The corner of a robot that lies farthest off the line from its first joint to its hand, and the way there."""
    base, hand = robot.origins[1], robot.origins[-1]
    path = np.vstack([robot.origins[1:], robot.feet[1:]])
    along = (hand - base) / max(np.linalg.norm(hand - base), 1e-9)
    off = (path - base) - np.outer((path - base) @ along, along)
    k = np.argmax(np.linalg.norm(off, axis=1))
    return path[k], off[k] if np.linalg.norm(off[k]) > 1e-6 * robot.unit else np.array([0, 0, robot.unit])


@strokes.styled
def draw_chain_postures(rows, joints, solutions, values=None, ax=None, *, tool=False, target=None):
    """The postures of a robot in one drawing, shaded apart and numbered.

    Parameters
    ----------
    rows : list of rows [sigma, a, alpha, d, theta], numbers or SymPy; metres and radians
    joints : sequence of n texts or symbols
        Names of the joint variables in the table, in the order of a solution.
    solutions : array-like, shape (k, n)
        One posture per row; k may be zero.
    values : dict, optional
        Numbers for the other symbols of the table, by name.
    tool : bool
        The last row is the constant displacement to the tool.
    target : array-like, shape (3,) or (4, 4), optional
        The point or the frame that the postures were made for.

    Returns
    -------
    matplotlib Axes (3D)
    """
    joints = [str(name) for name in joints]
    solutions = list(solutions)
    if solutions:
        solutions = strokes.as_numbers(solutions, "solutions", (None, len(joints)))
    if target is not None:
        target = np.array(target.tolist() if isinstance(target, sympy.MatrixBase) else target, dtype=object)
        target = strokes.as_numbers(target.tolist(), "target", (4, 4) if target.ndim == 2 else (3,))
    tables = [_as_rows(rows, dict(values or {}) | dict(zip(joints, q))) for q in solutions]
    unit = max((np.abs(table[:, [1, 3]]).sum() for table in tables), default=0) or 1.0
    robots = [_Robot(table, tool, unit) for table in tables]
    own, ax = ax is None, ax or strokes.new_axes_3d()
    shades = strokes.POSTURE_SHADES if len(robots) <= 4 else [str(s) for s in np.linspace(0.95, 0.45, len(robots))]
    labels = Labels()
    extent = [np.zeros((1, 3))]
    numbers: dict[tuple, list] = {}
    for k, (robot, shade) in enumerate(zip(robots, shades)):
        # One collection per posture: where two share a link, the later one lies on top.
        bodies = Bodies(ax, unit, fine=12)
        robot.build(bodies, link=to_rgb(shade), joint=to_rgb(shade), hand=to_rgb(shade))
        bodies.draw(ax, 1 + 0.01 * k)
        extent.append(bodies.points())
        at, out = _bulge(robot)
        numbers.setdefault(tuple(np.round(at / unit, 3) + 0.0), [at, out, []])[2].append(str(k + 1))
    for at, out, members in numbers.values():
        labels.ask(at, ", ".join(members), out, gap=12)
    if target is not None:
        point = target if target.shape == (3,) else target[:3, 3]
        ax.plot(*point[:, None], marker="o", ms=13, mfc="none", mec=strokes.INK, mew=1.3, zorder=7)
        ax.plot(*point[:, None], marker="+", ms=19, color=strokes.INK, mew=1.3, zorder=7)
        extent.append(point[None])
        if target.shape == (4, 4):
            extent += _draw_frames(ax, target[None], ["E"], 0.14 * unit, labels)
    extent = np.vstack(extent)
    if len(extent) == 1 or np.ptp(extent, axis=0).max() == 0:
        extent = np.vstack([extent, extent - 0.5 * unit, extent + 0.5 * unit])
    if robots:
        handles = [
            Patch(facecolor=s, edgecolor=strokes.INK, label=f"posture {k + 1}")
            for k, s in enumerate(shades[: len(robots)])
        ]
        # Below our own figure; in somebody else's axes there may be no room outside.
        below = {
            "loc": "upper center",
            "bbox_to_anchor": (0.5, 0.0),
            "bbox_transform": ax.figure.transFigure,
            "ncols": min(len(robots), 4),
        }
        (ax.figure if own else ax).legend(handles=handles, fontsize=9, **(below if own else {"loc": "upper left"}))
    else:
        strokes.write_3d(ax, (0, 0, 0), "no posture")
    _fit(ax, extent, own)
    labels.place(ax)
    return ax
