"""Two tables of one chain are recognised, with the freedoms used; other tables are not.

Gauge changes are made by rules on tables, and differences are confirmed by a numeric oracle; neither shares code
with the checker. The oracle decides whether ``T_ref(s v + o) = B T(v) E`` has a solution, v being the joint entries: first by numbers
that no such change can alter, measured on twists got by finite differences, then by fitting s, o and B.
"""

from dataclasses import dataclass, replace
from itertools import product

import numpy as np
import pytest
import sympy
from autograder.judge.axes import Chain, NotAChain
from autograder.judge.chains import Freedom, same_chain
from autograder.judge.decode import Blank, Call, Constant, Number, Symbol, decode_answer
from autograder.reference import DHTable, robots
from dhkit.wire import bundle, encode

PI = np.pi
PRICES = {"base frame": 2.5, "tool frame": 2.5, "zero of joint": 2, "sense of joint": 2}


@dataclass(frozen=True)
class Table:
    """Rows of a modified DH table: numbers with all joint variables zero, and what each variable adds (rows, m)."""

    sigma: np.ndarray
    cells: np.ndarray  # (rows, 4): a, alpha, d, theta
    coupling: np.ndarray

    @property
    def joints(self):
        return np.flatnonzero(self.coupling.any(axis=1))

    @property
    def has_tool_row(self):
        return self.joints[-1] != len(self.sigma) - 1


def transform(a, alpha, d, theta):
    """TransX(a) RotX(alpha) TransZ(d) RotZ(theta)."""
    c, s, ca, sa, zero, one = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha), 0 * theta, 1 + 0 * theta
    rows = [c, -s, zero, a * one, s * ca, c * ca, -sa * one, -sa * d * one, s * sa, c * sa, ca * one, ca * d * one, zero, zero, zero, one]
    return np.stack(np.broadcast_arrays(*rows), axis=-1).reshape(*np.shape(rows[7]), 4, 4)


def frames(table, entries):
    """Frames after each row, (..., rows, 4, 4), for what is added to the joint entries, (..., rows)."""
    a, alpha, d, theta = table.cells.T
    result = transform(a, alpha, d + table.sigma * entries, theta + (1 - table.sigma) * entries)
    for i in range(1, len(table.sigma)):
        result[..., i, :, :] = result[..., i - 1, :, :] @ result[..., i, :, :]
    return result


def close(one, other, tolerance=1e-6):
    return np.abs(one - other).max() < tolerance


def posture(table, q):
    """Frames after each row for values of the joint variables, (..., m)."""
    return frames(table, np.asarray(q) @ table.coupling.T)


def constant_rows(motion):
    """Two constant rows that make up a rigid motion."""
    r, p = motion[:3, :3], motion[:3, 3]
    alpha = np.arccos(np.clip(r[2, 2], -1, 1))
    if abs(np.sin(alpha)) < 1e-9:
        first = np.arctan2(p[1], p[0])
        tilt = round(np.cos(alpha))
        total = np.arctan2(r[1, 0], r[0, 0])
        return np.array([[0, 0, p[2], first], [np.hypot(p[0], p[1]), alpha, 0, (total - first) * tilt]])
    first, second = np.arctan2(r[0, 2], -r[1, 2]), np.arctan2(r[2, 0], r[2, 1])
    x = np.array([np.cos(first), np.sin(first), 0])
    d1, a, d2 = np.linalg.solve(np.stack([[0, 0, 1], x, r[:, 2]], axis=1), p)
    return np.array([[0, 0, d1, first], [a, alpha, d2, second]])


def with_rows(table, before=None, after=None):
    """The table with constant rows at its ends."""
    parts = [(before, True), (table.cells, False), (after, True)]
    cells = np.concatenate([rows for rows, _ in parts if rows is not None])
    start = 0 if before is None else len(before)
    sigma, coupling = np.zeros(len(cells)), np.zeros((len(cells), table.coupling.shape[1]))
    sigma[start : start + len(table.sigma)] = table.sigma
    coupling[start : start + len(table.sigma)] = table.coupling
    return Table(sigma, cells, coupling)


def random_motion(rng):
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    motion = np.eye(4)
    motion[:3, :3] = turn * np.sign(np.linalg.det(turn))
    motion[:3, 3] = rng.uniform(-0.5, 0.5, 3)
    return motion


A, ALPHA, D, THETA = range(4)


class Changes:
    """Gauge changes of a table at its joints, and the frames they replace: frame i becomes frame i times G_i.

    Every change keeps the chain. Those of frames between the ends keep the model too; a change of the last frame of
    a table is a change of tool.
    """

    def __init__(self, table, rng):
        self.table, self.rng = table, rng
        self.gauge = {row: np.eye(4) for row in table.joints}
        self.signs, self.offsets = np.ones(table.coupling.shape[1]), np.zeros(table.coupling.shape[1])
        self.base = self.tool = False

    def rows(self):
        return replace(self.table, cells=self.table.cells.copy(), coupling=self.table.coupling.copy())

    def possible(self):
        """All (name, row) that can be done."""
        found = [("base", 0), ("tool", 0)]
        t, last = self.table, len(self.table.sigma) - 1
        coupled = (np.abs(t.coupling).sum(axis=0) > 1).any() or (np.abs(t.coupling).sum(axis=1) > 1).any()
        for row in t.joints:
            found += [("flip_z", row), ("flip_x", row)]
            # A new zero shows in every joint that shares the variable: only plain joints are changed here.
            if not coupled:
                found += [("zero", row), ("sense", row)]
            if row == last or abs(np.sin(t.cells[row + 1, ALPHA])) < 1e-12:
                found.append(("origin", row))
                if row == last or t.cells[row + 1, A] == 0:
                    found.append(("turn_x", row))
            if t.sigma[row] and (row == last or abs(np.sin(t.cells[row, THETA])) < 1e-12):
                found.append(("axis", row))
        return found

    def do(self, name, row):
        t = self.rows()
        below = t.cells[row + 1] if row + 1 < len(t.sigma) else np.zeros(4)
        here, g = t.cells[row], np.eye(4)
        if name == "flip_x":
            here[THETA] += PI
            below[A], below[ALPHA] = -below[A], -below[ALPHA]
            below[THETA] -= PI
            g = np.diag([-1.0, -1, 1, 1])
        elif name == "flip_z":
            here[ALPHA] += PI
            here[D], here[THETA] = -here[D], -here[THETA]
            t.coupling[row] *= -1
            below[ALPHA] -= PI
            g = np.diag([1.0, -1, -1, 1])
        elif name == "origin":
            h = self.rng.uniform(0.1, 0.5) * self.rng.choice([-1, 1])
            here[D] += h
            below[D] -= h * np.cos(below[ALPHA])
            g[2, 3] = h
        elif name == "turn_x":
            angle = self.rng.uniform(0.3, 2.8)
            here[THETA] += angle
            below[THETA] -= angle * np.cos(below[ALPHA])
            g[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        elif name == "axis":
            h = self.rng.uniform(0.1, 0.5)
            here[A] += h
            below[A] -= h * np.cos(here[THETA])
            g[0, 3], g[1, 3] = h * np.cos(here[THETA]), -h * np.sin(here[THETA])
        elif name == "zero":
            j = int(np.argmax(t.coupling[row] != 0))
            h = self.rng.uniform(0.2, 1.5)
            here[D if t.sigma[row] else THETA] += h
            self.offsets[j] += self.signs[j] * h / t.coupling[row, j]
        elif name == "sense":
            j = int(np.argmax(t.coupling[row] != 0))
            t.coupling[row] *= -1
            self.signs[j] *= -1
        elif name in ("base", "tool"):
            extra = constant_rows(random_motion(self.rng))
            t = with_rows(t, before=extra) if name == "base" else with_rows(t, after=extra)
            if name == "base":
                self.gauge = {row + 2: g for row, g in self.gauge.items()}
            setattr(self, name, True)
        if name not in ("base", "tool"):
            self.gauge[row] = self.gauge[row] @ g
            if row == len(t.sigma) - 1 and not close(g, np.eye(4)):
                self.tool = True
        self.table = t


def differences(gauge, joint, is_end):
    """What a frame change is called, at joint number `joint`."""
    names = set()
    if gauge[2, 2] < 0:
        names.add(f"sense of Z{joint}")
    if is_end:
        return names
    if close(gauge[:3, 0], (-1, 0, 0)):
        names.add(f"sense of X{joint}")
    elif not close(gauge[:3, 0], (1, 0, 0)):
        names.add(f"direction of X{joint}")
    if abs(gauge[2, 3]) > 1e-6:
        names.add(f"origin O{joint} along Z{joint}")
    if np.abs(gauge[:2, 3]).max() > 1e-6:
        names.add(f"place of axis Z{joint}")
    return names


# ---------------------------------------------------------------- the oracle


def _entries(table, moved):
    """Entries of all rows (..., rows) from those of the joints (..., n)."""
    full = np.zeros((*np.shape(moved)[:-1], len(table.sigma)))
    full[..., table.joints] = moved
    return full


def hand(table, moved):
    return frames(table, _entries(table, moved))[..., -1, :, :]


def twists(table, moved, step=1e-5):
    """Twists (..., n, 6) of the joints, (omega, v), by central differences of the hand's pose."""
    moved = np.asarray(moved, float)
    steps = step * np.eye(moved.shape[-1])
    rate = (hand(table, moved[..., None, :] + steps) - hand(table, moved[..., None, :] - steps)) / (2 * step)
    rate = rate @ np.linalg.inv(hand(table, moved))[..., None, :, :]
    return np.stack([rate[..., 2, 1], rate[..., 0, 2], rate[..., 1, 0], rate[..., 0, 3], rate[..., 1, 3], rate[..., 2, 3]], axis=-1)


def _pairings(one, other):
    """Three functions of two twists that no rigid motion changes; the third means something for parallel axes only."""
    w1, v1, w2, v2 = one[..., :3], one[..., 3:], other[..., :3], other[..., 3:]
    turn = (w1 * w2).sum(-1)
    moment = (w1 * v2).sum(-1) + (w2 * v1).sum(-1)
    parallel = ((np.abs(np.cross(w1, w2)).max(axis=-1) < 1e-6) & (np.abs(turn) > 0.5)).all()
    apart = ((np.cross(w1, v1) - np.cross(w2, v2)) ** 2).sum(-1)
    sliding = np.abs(w1).max() + np.abs(w2).max() < 1e-6
    slide = (v1 * v2).sum(-1)
    return np.stack([turn, moment, apart if parallel else 0 * apart, slide if sliding else 0 * slide], axis=-1)


def invariants(table):
    """Numbers that no gauge change alters: sizes of the Fourier coefficients of the pairings, for joints up to three apart."""
    n, grid, found = len(table.joints), 2 * PI * np.arange(3) / 3, []
    for i in range(n):
        for gap in (1, 2, 3):
            if i + gap >= n:
                continue
            between = list(range(i + 1, i + gap))
            moved = np.zeros((*(3,) * len(between), n))
            for axis, joint in enumerate(between):
                moved[..., joint] = grid.reshape([-1 if k == axis else 1 for k in range(len(between))])
            xi = twists(table, moved)
            values = _pairings(xi[..., i, :], xi[..., i + gap, :])
            slides = [k for k, joint in enumerate(between) if table.sigma[table.joints[joint]]]
            if slides:
                # Along a prismatic joint only the direction counts.
                values = values[..., [0, 3]]
            if gap == 3:
                # The squared distance is of second order in both angles: three values each are too few.
                values = values[..., [0, 1]] if not slides else values
            sizes = np.abs(np.fft.fftn(values, axes=range(len(between)))) if between else np.abs(values)
            if len(between) == 2:
                mixed = np.sort(np.stack([sizes[1, 1], sizes[1, 2]]), axis=0)
                sizes = np.concatenate([sizes[0, :2], sizes[1:2, 0], mixed])
            elif between:
                sizes = sizes[:2]
            found.append(sizes.ravel())
    return np.concatenate(found) if found else np.zeros(1)


def _hat(xi):
    w1, w2, w3, v1, v2, v3 = np.moveaxis(xi, -1, 0)
    zero = 0 * w1
    rows = [[zero, -w3, w2, v1], [w3, zero, -w1, v2], [-w2, w1, zero, v3], [zero, zero, zero, zero]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def _exponential(xi):
    m = _hat(xi) / 64
    result = np.eye(4) + m + m @ m / 2 + m @ m @ m / 6 + m @ m @ m @ m / 24
    for _ in range(6):
        result = result @ result
    return result


def _axes_twists(table, moved):
    """Twists of the joints from their frames, (..., n, 6)."""
    here = frames(table, _entries(table, moved))[..., table.joints, :, :]
    z, p = here[..., :3, 2], here[..., :3, 3]
    slides = table.sigma[table.joints].astype(bool)[:, None]
    return np.where(slides, np.concatenate([0 * z, z], axis=-1), np.concatenate([z, np.cross(p, z)], axis=-1))


def fit(student, reference, signs, rng, starts=6, rounds=60):
    """Smallest residual of ``T_ref(s v + o) = B T(v) E`` over o, B and the given senses; Gauss-Newton, many starts.

    E drops out of the motions from the first posture to the others.
    """
    n = len(reference.joints)
    signs = np.repeat(np.array(signs, float), starts, axis=0)
    slides = reference.sigma[reference.joints].astype(bool)
    v = rng.uniform(-2, 2, (7, n))
    poses = hand(student, v)
    motions = poses[1:] @ np.linalg.inv(poses[0])
    o = rng.uniform(-PI, PI, signs.shape)
    o[:, slides] *= 0.1
    turns = np.array([random_motion(rng) for _ in signs])
    damping = np.full(len(signs), 1e-1)

    def residual(o, turns, signs):
        theirs = hand(reference, signs[:, None] * v + o[:, None])
        ours = theirs[:, 1:] @ np.linalg.inv(theirs[:, :1])
        return ours, (ours @ turns[:, None] - turns[:, None] @ motions)[..., :3, :].reshape(len(o), -1)

    ours, r = residual(o, turns, signs)
    for k in range(rounds):
        cost = (r**2).sum(axis=1)
        if cost.min() < 1e-16:
            break
        if k in (12, 25):
            keep = np.argsort(cost)[: max(12, len(cost) // 4)]
            signs, o, turns, damping, ours, r, cost = (x[keep] for x in (signs, o, turns, damping, ours, r, cost))
        screws = _hat(_axes_twists(reference, signs[:, None] * v + o[:, None]))
        by_offset = (screws[:, 1:] @ ours[:, :, None] - ours[:, :, None] @ screws[:, :1]) @ turns[:, None, None]
        basis = _hat(np.eye(6))
        by_motion = ours[:, :, None] @ basis @ turns[:, None, None] - basis @ turns[:, None, None] @ motions[:, None]
        j = np.concatenate([by_offset, by_motion], axis=2)[..., :3, :]
        j = np.moveaxis(j, 2, -1).reshape(len(o), r.shape[1], -1)
        normal = np.swapaxes(j, 1, 2) @ j
        normal += damping[:, None, None] * np.eye(normal.shape[-1])
        step = -np.linalg.solve(normal, np.swapaxes(j, 1, 2) @ r[..., None])[..., 0]
        new_o, new_turns = o + step[:, :n], _exponential(step[:, n:]) @ turns
        new_ours, new_r = residual(new_o, new_turns, signs)
        better = (new_r**2).sum(axis=1) < cost
        o, turns, ours, r = (np.where(better.reshape(-1, *(1,) * (x.ndim - 1)), y, x) for x, y in ((o, new_o), (turns, new_turns), (ours, new_ours), (r, new_r)))
        damping = np.where(better, damping / 5, damping * 4)
    return float(np.sqrt((r**2).sum(axis=1).min()))


def senses(table):
    """All senses of the joints; joints that share a variable have theirs in common."""
    n, coupling = len(table.joints), table.coupling[table.joints] != 0
    shared = coupling.astype(int) @ coupling.T.astype(int) > 0
    return [s for s in product((1, -1), repeat=n) if all(s[i] == s[k] for i, k in np.argwhere(shared))]


def same(student, reference, rng):
    """The oracle's verdict."""
    ours, theirs = invariants(reference), invariants(student)
    if np.abs(ours - theirs).max() > 1e-4:
        return False
    return fit(student, reference, senses(reference), rng) < 1e-6


# ---------------------------------------------------------------- tables of the catalogue


def catalogue_table(name):
    """A robot of the catalogue as numbers, its base and tool as constant rows."""
    table = getattr(robots, name).table
    chain = table.chain
    sigma = np.array([row.sigma for row in table.rows], float)
    alpha = np.arctan2(chain.sin_alpha, chain.cos_alpha)
    d, theta = np.where(sigma, chain.offset, chain.fixed), np.where(sigma, chain.fixed, chain.offset)
    own = Table(sigma, np.stack([chain.a, alpha, d, theta], axis=1), np.array(chain.coupling))
    ends = [None if close(motion, np.eye(4)) else constant_rows(motion) for motion in (chain.base, chain.tool)]
    return with_rows(own, *ends)


def entries(table):
    """The table as decoded entries, joint variables q1, q2, ..."""
    found = []
    for sigma, cells, coupling in zip(table.sigma, table.cells, table.coupling):
        row = [Number(float(cell)) for cell in (sigma, *cells)]
        terms = tuple(Call("mul", (Number(float(c)), Symbol(f"q{j + 1}"))) for j, c in enumerate(coupling) if c)
        if terms:
            place = 3 if sigma else 4
            row[place] = Call("add", (row[place], *terms))
        found += row
    return tuple(found)


def chain(table):
    return Chain.of_entries(entries(table), [f"q{j + 1}" for j in range(table.coupling.shape[1])], {})


def maps_model(match, student, reference, rng):
    """True if T_ref(s q + o) = B T(q) E at random q."""
    q = rng.uniform(-2, 2, (3, student.coupling.shape[1]))
    theirs = posture(reference, np.array(match.senses) * q + match.offsets[0])[:, -1]
    return close(match.base[0] @ posture(student, q)[:, -1] @ match.tool[0], theirs)


def named(match):
    return {str(used) for used in match.freedoms}


def expected_names(match, student, reference):
    """The freedoms that follow from the map of a match, found by comparing frames in one posture."""
    names = set()
    if not close(match.base[0], np.eye(4)):
        names.add("base frame")
    if not close(match.tool[0], np.eye(4)):
        names.add("tool frame")
    for j, (sign, offset) in enumerate(zip(match.senses, match.offsets[0])):
        joint = int(np.argmax(reference.coupling[reference.joints][:, j] != 0)) + 1
        names |= {f"sense of joint {joint}"} if sign < 0 else set()
        names |= {f"zero of joint {joint}"} if abs(offset) > 1e-6 else set()
    theirs = posture(student, np.zeros(student.coupling.shape[1]))[student.joints]
    ours = posture(reference, match.offsets[0])[reference.joints]
    bare = not student.has_tool_row and not reference.has_tool_row
    for i, gauge in enumerate(np.linalg.inv(ours) @ match.base[0] @ theirs):
        names |= differences(gauge, i + 1, bare and i == len(ours) - 1)
    return names


def cost(names):
    return sum(next((price for kind, price in PRICES.items() if name.startswith(kind)), 1) for name in names)


def made(changes, start):
    """The freedoms that a series of changes has used."""
    names = {f"{end} frame" for end in ("base", "tool") if getattr(changes, end)}
    joints = dict(enumerate(changes.table.joints))
    for j, (sign, offset) in enumerate(zip(changes.signs, changes.offsets)):
        names |= {f"sense of joint {j + 1}"} if sign < 0 else set()
        names |= {f"zero of joint {j + 1}"} if abs(offset) > 1e-9 else set()
    bare = not changes.table.has_tool_row and not start.has_tool_row
    for i, row in joints.items():
        names |= differences(changes.gauge[row], i + 1, bare and i == len(joints) - 1)
    return names


ROBOTS = robots.names()
COUNT = 500


@pytest.mark.parametrize("name", ROBOTS)
def test_gauge_changes_are_recognised(name):
    rng = np.random.default_rng(ROBOTS.index(name))
    reference = catalogue_table(name)
    ours = chain(reference)
    for _ in range(COUNT):
        changes = Changes(reference, rng)
        for _ in range(rng.integers(1, 7)):
            possible = changes.possible()
            changes.do(*possible[rng.integers(len(possible))])
        student = changes.table
        match = same_chain(chain(student), ours)
        assert match.equal, match.parting
        assert maps_model(match, student, reference, rng)
        assert named(match) == expected_names(match, student, reference)
        assert cost(named(match)) <= cost(made(changes, reference)) + 1e-9


def single_cell_change(table, rng):
    """The table with one cell turned round, shifted, set to zero, or taken from another column of its row."""
    while True:
        row, column = rng.integers(len(table.sigma)), rng.integers(4)
        cell, right = table.cells[row, column], PI / 2 if column in (ALPHA, THETA) else 0.1
        shift = rng.choice([right, rng.uniform(0.05, 1.5)]) * rng.choice([-1, 1])
        new = rng.choice([-cell, cell + shift, 0.0, table.cells[row, (column + rng.integers(1, 4)) % 4]])
        if abs(new - cell) > 1e-3:
            cells = table.cells.copy()
            cells[row, column] = new
            return replace(table, cells=cells)


@pytest.mark.parametrize("name", ROBOTS)
def test_single_cell_changes_are_rejected_unless_the_chain_is_the_same(name):
    rng = np.random.default_rng(100 + ROBOTS.index(name))
    reference = catalogue_table(name)
    ours, verdicts, rejected = chain(reference), {}, 0
    for _ in range(COUNT):
        student = single_cell_change(reference, rng)
        match = same_chain(chain(student), ours)
        if match.equal:
            assert maps_model(match, student, reference, rng)
            assert named(match) == expected_names(match, student, reference)
            continue
        rejected += 1
        assert match.parting
        key = student.cells.round(9).tobytes()
        if key not in verdicts:
            verdicts[key] = same(student, reference, rng)
        assert not verdicts[key], (student.cells - reference.cells, str(match.parting))
    assert rejected
