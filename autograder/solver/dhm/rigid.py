"""Poses as they are given: rigid, rounded to few decimals, or no poses at all, which is said part by part."""

from __future__ import annotations

import warnings

import numpy as np

from .status import RoundedInput

_RIGID = 1e-5  # how far a transform may be from rigid: poses rounded to six decimals pass as they are
_ROUNDED = 3e-4  # how far numbers with four decimals may make it
_PAIRS = ((0, 1), (0, 2), (1, 2))


def rigid(T: np.ndarray) -> np.ndarray:
    """The poses (N, 4, 4), of which those with four decimals become the nearest rigid ones, with a `RoundedInput` warning.

    Raises ValueError for one that is no rigid transform, which says what part of it is wrong and by how much.
    """
    last_row = (T[:, 3] == (0.0, 0.0, 0.0, 1.0)).all(axis=1)
    off = _off_rigid(T)
    wrong = ~last_row | (off > _ROUNDED)
    if wrong.any():
        first = int(wrong.argmax())
        which = f"pose {first} of 0 to {len(T) - 1}" if len(T) > 1 else "a pose"
        raise ValueError(f"{which} must be a rigid transform: {_fault(T[first])}")
    rounded = off > _RIGID
    if not rounded.any():
        return T
    T = T.copy()
    u, _, vh = np.linalg.svd(T[rounded, :3, :3])
    nearest = u @ vh
    moved = np.abs(nearest - T[rounded, :3, :3]).max()
    T[rounded, :3, :3] = nearest
    which = f"{rounded.sum()} of {len(T)} poses are" if len(T) > 1 else "the pose is"
    one = "ones" if len(T) > 1 else "one"
    warnings.warn(
        f"{which} read as the nearest rigid {one}: the rotation has moved by at most {moved:.2g} in an entry",
        RoundedInput,
        stacklevel=5,
    )
    return T


def _off_rigid(T: np.ndarray) -> np.ndarray:
    """How far the rotations of transforms (N, 4, 4) are from rotations, (N,)."""
    (sx, nx, ax), (sy, ny, ay), (sz, nz, az) = np.ascontiguousarray(T[:, :3, :3].transpose(1, 2, 0))
    wrong = [
        *(sx * sx + sy * sy + sz * sz - 1, nx * nx + ny * ny + nz * nz - 1, sx * nx + sy * ny + sz * nz),
        *(sy * nz - sz * ny - ax, sz * nx - sx * nz - ay, sx * ny - sy * nx - az),
    ]
    return np.abs(wrong).max(axis=0, initial=0.0)


def _fault(T: np.ndarray) -> str:
    """What makes a transform (4, 4) no rigid one, in words."""
    if tuple(T[3]) != (0, 0, 0, 1):
        return f"the last row is {' '.join(f'{entry:g}' for entry in T[3])}, not 0 0 0 1"
    columns = T[:3, :3].T
    lengths = np.linalg.norm(columns, axis=1)
    longest = np.abs(lengths - 1).argmax()
    dots = np.array([columns[i] @ columns[j] for i, j in _PAIRS])
    i, j = _PAIRS[np.abs(dots).argmax()]
    text = "its rotation part is no rotation: "
    if abs(lengths[longest] - 1) >= np.abs(dots).max() and abs(lengths[longest] - 1) > _RIGID:
        return f"{text}column {longest + 1} has the length {lengths[longest]:.6g}, not 1"
    if np.abs(dots).max() > _RIGID:
        angle = np.degrees(np.arccos(np.clip(columns[i] @ columns[j] / (lengths[i] * lengths[j]), -1, 1)))
        return f"{text}columns {i + 1} and {j + 1} are {angle:.6g} degrees apart, not 90"
    return f"{text}left-handed: its determinant is {np.linalg.det(columns):.6g}, not 1"
