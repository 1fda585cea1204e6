"""The four parameters between two frames, one at a time."""

from __future__ import annotations

import numpy as np

from .chains import Labels, fill_panel
from .frames import dh_axes
from .inputs import as_numbers
from .strokes_3d import draw_arrow_3d
from .style import AXIS_COLOURS, CENTRE_LINE, DASHED, FAINT, INK, SOFT, styled
from .two_axes import add_arc, add_axis
from .view import new_panels_3d

STEPS = ("a", "alpha", "d", "theta")


@styled
def draw_parameter_steps(a=1.0, alpha=np.radians(40), d=0.9, theta=np.radians(50)):
    """Draw the four parameters between two frames, in four spaces: what each is measured from, to, and along or about.

    Parameters
    ----------
    a, d : float, in metres
    alpha, theta : float, in radians

    Returns
    -------
    list of 4 matplotlib Axes (3D)
    """
    values = as_numbers([a, alpha, d, theta], "a, alpha, d, theta", (4,))
    titles = (
        r"$a_{i-1}$: from $Z_{i-1}$ to $Z_i$ along $X_{i-1}$",
        r"$\alpha_{i-1}$: from $Z_{i-1}$ to $Z_i$ about $X_{i-1}$",
        r"$d_i$: from $X_{i-1}$ to $X_i$ along $Z_i$",
        r"$\theta_i$: from $X_{i-1}$ to $X_i$ about $Z_i$",
    )
    panels = new_panels_3d(titles, width=4.2, height=3.9, columns=2)
    for ax, step in zip(panels, STEPS):
        labels = Labels()
        fill_panel(ax, _parameter(ax, labels, step, *values), share=0.8)
        labels.place(ax)
    return panels


def _parameter(ax, labels, step, a, alpha, d, theta):
    (x0, _, z0), (x1, side, z1) = np.eye(3), dh_axes(alpha, theta)
    foot, size = a * x0, 0.5
    origin = foot + d * z1
    lines = (
        (np.zeros(3), z0, -0.3, 1.0), (foot, z1, min(d, 0) - 0.35, max(d, 0) + 0.75),
        (np.zeros(3), x0, min(a, 0) - 0.2, max(a, 0) + 0.5),
    )  # fmt: skip
    extent = []
    for base, along, low, high in lines:
        ends = np.array([base + low * along, base + high * along])
        ax.plot(*ends.T, color=SOFT, lw=1, ls=CENTRE_LINE, zorder=1)
        extent.append(ends)
    for start, end in ((np.zeros(3), foot), (foot, origin)):
        ax.plot(*zip(start, end), color=FAINT, lw=6, zorder=1.5, solid_capstyle="round")
    for at, letter, along, name, length in (
        (np.zeros(3), "z", z0, "i-1", 1.0), (np.zeros(3), "x", x0, "i-1", size),
        (origin, "z", z1, "i", 0.7), (origin, "x", x1, "i", size),
    ):  # fmt: skip
        asked = letter == ("z" if step in ("a", "alpha") else "x")
        out = -z0 if (letter, name) == ("x", "i-1") else None
        add_axis(ax, labels, at, along, length, letter, name, 2.4 if asked else 1.3, out)
        extent.append((at + length * along)[None])
    for at, name, out in ((np.zeros(3), "i-1", -x0 - z0), (origin, "i", side - x1)):
        ax.plot(*at[:, None], "o", ms=5, color=INK, zorder=7)
        labels.ask(at, f"$O_{{{name}}}$", out, gap=6)
    if step == "a":
        _measure(ax, labels, np.zeros(3), foot, "a_{i-1}", z0)
    elif step == "alpha":
        ax.plot(*zip(foot, foot + 0.85 * z0), color=AXIS_COLOURS["z"], lw=1, ls=DASHED, zorder=2)
        add_arc(ax, labels, foot, z0, -np.array([0, 1.0, 0]), 0.6, alpha, r"\alpha_{i-1}")
        extent.append((foot + 0.85 * z0)[None])
    elif step == "d":
        _measure(ax, labels, foot, origin, "d_i", x0)
    else:
        ax.plot(*zip(origin, origin + 0.62 * x0), color=AXIS_COLOURS["x"], lw=1, ls=DASHED, zorder=2)
        add_arc(ax, labels, origin, x0, side, 0.42, theta, r"\theta_i")
        extent.append((origin + 0.62 * x0)[None])
    return np.vstack(extent)


def _measure(ax, labels, start, end, label, aside):
    """A length as a bold arrow from where it is measured to where."""
    if np.linalg.norm(end - start) < 1e-9:
        return
    draw_arrow_3d(ax, start, end, INK, width=3, scale=15, zorder=5)
    labels.ask((start + end) / 2, f"${label}$", aside, gap=8)
    labels.avoid(np.linspace(start, end, 10))
