"""Bodies in space made of tubes, balls and boxes, which one Matplotlib collection sorts by depth."""

from __future__ import annotations

import numpy as np
from matplotlib.colors import to_rgb
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ..geometry import perpendicular, unit_vector
from .style import INK
from .view import view_axes

LINK, JOINT, HAND = 0.80, 0.97, 0.62  # shades of grey, from black (0) to white (1)


class Bodies:
    """Quads of bodies with a shade each, seen from one direction and drawn with an ink outline.

    Parameters
    ----------
    ax : matplotlib Axes (3D)
        Its direction of view must be final.
    unit : float, in metres
        Size of what is drawn, for the width of the outline.
    fine : int
        Number of quads around a tube or a ball.

    Notes
    -----
    All points are of shape (3,), in metres. A shade is a grey from 0 (black) to 1 (white), or a colour (r, g, b).
    """

    def __init__(self, ax, unit, fine=16):
        right, _, self._towards = view_axes(ax)
        light = self._towards + 0.9 * np.array([0, 0, 1]) - 0.55 * right
        self._light = light / np.linalg.norm(light)
        self._rim, self._fine = 0.0042 * unit, fine
        self._quads, self._colours = [], []

    def add_tube(self, start, end, radius, shade, caps=False):
        """Add a tube between two points; `caps` closes its ends."""
        start, end = np.asarray(start, float), np.asarray(end, float)
        length = np.linalg.norm(end - start)
        if length < 1e-9:
            return
        along = (end - start) / length
        side = perpendicular(along)
        ring = unit_vector(np.linspace(0, 2 * np.pi, self._fine + 1)) @ [side, np.cross(along, side)]
        middle = (ring[:-1] + ring[1:]) / 2

        def make(rim):
            first = start - (rim * along if caps else 0)
            reach = length + (2 * rim if caps else 0)
            steps = np.linspace(0, reach, max(2, int(np.ceil(reach / (1.5 * radius)))) + 1)
            rings = first + steps[:, None, None] * along + (radius + rim) * ring
            sides, normals = _cells(rings), np.tile(middle, (len(steps) - 1, 1))
            if caps:
                for edge, centre, out in ((rings[0], first, -along), (rings[-1], first + reach * along, along)):
                    c = np.broadcast_to(centre, edge[:-1].shape)
                    sides = np.vstack([sides, np.stack([c, edge[:-1], edge[1:], c], axis=1)])
                    normals = np.vstack([normals, np.tile(out, (len(c), 1))])
            return sides, normals

        self._add(make, shade)

    def add_ball(self, centre, radius, shade):
        """Add a ball."""
        up = np.linspace(0, np.pi, self._fine // 2 + 1)[:, None]
        around = unit_vector(np.linspace(0, 2 * np.pi, self._fine + 1))
        level = np.broadcast_to(np.cos(up)[..., None], (*up.shape[:1], len(around), 1))
        quads = _cells(np.concatenate([np.sin(up)[..., None] * around, level], axis=-1))
        normals = quads.mean(axis=1)
        self._add(lambda rim: (centre + (radius + rim) * quads, normals), shade)

    def add_box(self, centre, axes, half, shade, cells=3):
        """Add a box.

        Parameters
        ----------
        axes : ndarray, shape (3, 3)
            Directions of the edges as columns.
        half : array-like, shape (3,), in metres
            Half lengths of the edges.
        cells : int
            Number of quads along each edge.
        """
        grid = np.linspace(-1, 1, cells + 1)
        u, v = np.meshgrid(grid, grid, indexing="ij")
        faces, normals = [], []
        for k in range(3):
            for sign in (-1, 1):
                face = np.zeros((*u.shape, 3))
                face[..., k], face[..., (k + 1) % 3], face[..., (k + 2) % 3] = sign, u, v
                faces.append(_cells(face))
                normals.append(np.tile(sign * axes[:, k], (cells * cells, 1)))
        faces, normals = np.vstack(faces), np.vstack(normals)
        self._add(lambda rim: (centre + (faces * (np.asarray(half) + rim)) @ axes.T, normals), shade)

    def _add(self, make, shade):
        """`make(rim)` returns quads (k, 4, 3) and their outward normals (k, 3), swollen by `rim`."""
        quads, normals = make(0.0)
        front = normals @ self._towards > 0
        lit = 0.62 + 0.42 * np.clip(normals @ self._light, 0, 1)
        colour = np.asarray(to_rgb(str(shade)) if np.isscalar(shade) else shade)
        self._quads.append(quads[front])
        self._colours.append(np.clip(np.outer(lit, colour), 0, 1)[front])
        quads, normals = make(self._rim)
        # The far side of a slightly larger ink body: what shows of it is the outline.
        back = normals @ self._towards <= 0
        self._quads.append(quads[back])
        self._colours.append(np.tile(to_rgb(INK), (back.sum(), 1)))

    def draw(self, ax, zorder=1.0):
        """Draw what has been added."""
        if self._quads:
            colours = np.vstack(self._colours)
            body = Poly3DCollection(
                np.vstack(self._quads), facecolors=colours, edgecolors=colours, linewidths=0.8, zorder=zorder
            )
            ax.add_collection3d(body, autolim=False)

    def points(self) -> np.ndarray:
        """Corners of what has been added, shape (n, 3), in metres: what the view must hold."""
        return np.vstack(self._quads).reshape(-1, 3) if self._quads else np.zeros((0, 3))


def _cells(grid) -> np.ndarray:
    """Quads between neighbours of a grid of points, shape (n, m, 3): shape ((n - 1) (m - 1), 4, 3)."""
    return np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]], axis=2).reshape(-1, 4, 3)
