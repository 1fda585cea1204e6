"""Measurements of the reference solver against its peers, each pair in one run.

    .venv/bin/python tests/benchmarks/run.py

Every figure is a ratio of two timings on the same data and machine; absolute
times are shown for orientation. Both sides run several times in turns and the
best time of each counts, so that other work on the machine disturbs both alike;
only fkine and simplify, which take ten seconds and more, run once. Where both
sides compute the same thing, their results must agree. Peers with pins of
their own live in .venv-bench, made from requirements.txt beside this file; they
are run in that environment and hand back timings as JSON.

Exit status: 0 when all targets are met, 1 otherwise.
"""

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import numpy as np
import pinocchio
import sympy as sp
from eaik.IK_DH import DhRobot
from rich.console import Console
from rich.table import Table

from autograder.reference import Robot, robots, workspace
from autograder.reference.errata.proof import agree

HERE = Path(__file__).resolve().parent
PEERS = HERE.parents[1] / ".venv-bench" / "bin" / "python"
POSES = 100_000
POINTS = 1_000_000
A3, D3 = 0.45, 0.45
ARM = robots.rx90(a3=A3, d3=D3)


@dataclass(frozen=True)
class Row:
    """One line of the table; `met` is None when the measurement could not be made."""

    what: str
    ours: str
    peer: str
    ratio: str
    target: str
    met: bool | None


def best(*actions, turns=5):
    """Best time of each action in seconds; they take turns."""
    times = [[] for _ in actions]
    for _ in range(turns):
        for spent, action in zip(times, actions):
            start = perf_counter()
            action()
            spent.append(perf_counter() - start)
    return [min(spent) for spent in times]


def forward():
    what = f"forward, {POSES:,} poses of the RX-90"
    target = "50 x faster than robotics-toolbox fkine"
    if not PEERS.exists():
        return [Row(what, "", "", f"{PEERS.parents[1].name} is missing", target, None)]
    q = random_joints()
    (ours,) = best(lambda: ARM.forward(q))
    with tempfile.TemporaryDirectory() as folder:
        joints, poses = Path(folder, "joints.npy"), Path(folder, "poses.npy")
        np.save(joints, q)
        done = subprocess.run(
            [PEERS, HERE / "peer_fkine.py", joints, poses, str(A3), str(D3)], check=True, capture_output=True, text=True
        )
        peer = json.loads(done.stdout.splitlines()[-1])["seconds"]
        must_equal(np.load(poses), ARM.forward(q), "poses")
    return [Row(what, seconds(ours), seconds(peer), f"{peer / ours:.0f} x", target, peer / ours >= 50)]


def inverse():
    poses = ARM.forward(random_joints())
    quarter = np.pi / 2
    peer_robot = DhRobot(
        np.array([quarter, 0, -quarter, quarter, -quarter, 0]),
        np.array([0, A3, 0, 0, 0, 0]),
        np.array([0, 0, 0, D3, 0, 0]),
    )
    must_equal(peer_robot.fwdKin(np.full(6, 0.3)), ARM.forward(np.full(6, 0.3)), "the two robots")
    ours, alone, default = best(
        lambda: ARM.inverse_batch(poses),
        lambda: peer_robot.IK_batched(poses, 1),
        lambda: peer_robot.IK_batched(poses),
        turns=4,
    )
    few = list(poses[:500])
    one, one_peer, usual = best(
        lambda: [ARM.postures(pose) for pose in few],
        lambda: [peer_robot.IK(pose) for pose in few],
        lambda: [ARM.inverse(pose) for pose in few],
    )
    postures = int(ARM.inverse_batch(poses).count.sum())
    theirs = sum(len(found.Q) for found in peer_robot.IK_batched(poses[:2000]))
    must_equal(theirs, int(ARM.inverse_batch(poses[:2000]).count.sum()), "numbers of postures")
    what = f"inverse, {POSES:,} poses of the RX-90, {postures / POSES:.0f} postures each"
    return [
        Row(
            f"{what}; EAIK with {threads}",
            f"{1e6 * ours / POSES:.2f} us/pose",
            f"{1e6 * peer / POSES:.2f} us/pose",
            f"{peer / ours:.2f} x",
            "no slower than EAIK's C++ batch",
            peer >= ours,
        )
        for threads, peer in [("1 thread", alone), ("4 threads, its default", default)]
    ] + [
        Row(
            f"postures, one pose of the RX-90; {what}",
            f"{1e6 * one / len(few):.1f} us",
            f"{1e6 * peer / len(few):.1f} us",
            f"{one / peer:.3g} of it",
            target,
            met,
        )
        for what, peer, target, met in [
            ("EAIK's IK, C++", one_peer, "no more than 8 times", one <= 8 * one_peer),
            ("inverse, with names and reasons", usual, "no more than a tenth", one <= usual / 10),
        ]
    ]


def inverse_floor():
    """Against what no way avoids for 8 postures: 20 arc tangents, 9 roots, and 48 numbers put in the order of the answer."""
    count, block = 10_240, 1024
    poses = ARM.forward(random_joints()[:count])
    rng = np.random.default_rng(0)
    y, x, squares = rng.normal(size=(20, block)), rng.normal(size=(20, block)), rng.uniform(size=(9, block))
    angles, roots, joints = np.empty_like(y), np.empty_like(squares), rng.normal(size=(6, 8, block))
    answer = np.empty((count, 8, 6))

    def trigonometry():
        for start in range(0, count, block):
            np.arctan2(y, x, out=angles)
            np.sqrt(squares, out=roots)
            answer[start : start + block] = joints.transpose(2, 1, 0)

    ours, bare = best(lambda: ARM.inverse_batch(poses), trigonometry, turns=20)
    return [
        Row(
            f"inverse, {count:,} poses of the RX-90; its arc tangents and roots alone, and the answer written",
            f"{1e6 * ours / count:.2f} us/pose",
            f"{1e6 * bare / count:.2f} us/pose",
            f"{ours / bare:.1f} of it",
            "no more than 3 times",
            ours <= 3 * bare,
        )
    ]


def six_turns():
    """An arm of which no three joints form a group; its peer is the eigenvalue problem within, which no way avoids."""
    half = np.pi / 2
    arm = Robot.from_table(
        [
            *[(0, 0, 0, 0.2, None), (0, 0.1, -half, 0, None), (0, 0.54, 0, 0, None)],
            *[(0, 0.1, -half, 0.54, None), (0, 0.05, half, 0.15, None), (0, 0.06, -half, 0.16, None)],
        ],
        "six turns",
    )
    poses = arm.forward(random_joints()[:200])
    matrix = np.random.default_rng(0).normal(size=(24, 24))
    one, batch, eigenvalues = best(
        lambda: [arm.inverse(pose) for pose in poses],
        lambda: arm.inverse_batch(poses),
        lambda: [np.linalg.eig(matrix) for _ in poses],
    )
    return [
        Row(
            f"inverse, {how} of an arm of six turns, up to 16 postures; np.linalg.eig of 24 x 24",
            f"{1e6 * ours / len(poses):.0f} us/pose",
            f"{1e6 * eigenvalues / len(poses):.0f} us",
            f"{ours / eigenvalues:.2g} times",
            f"no more than {most} times",
            ours <= most * eigenvalues,
        )
        for how, ours, most in [("one pose", one, 15), (f"{len(poses)} poses", batch, 3)]
    ]


def jacobians():
    """Against a loop over Pinocchio's C++, as Python programs write it; in pieces that fit the cache, and one by one."""
    arm = robots.rx90(a3=A3, d3=D3, limits=[(-4, 4)] * 6)  # without limits, Pinocchio holds cosines and sines
    model = arm.to_pinocchio()
    data, tool = model.createData(), model.getFrameId("tool")
    q = random_joints()[:4096]
    listed = list(q)
    aligned = pinocchio.LOCAL_WORLD_ALIGNED

    def theirs():
        return [pinocchio.computeFrameJacobian(model, data, each, tool, aligned) for each in listed]

    must_equal(np.array(theirs()[:50]), arm.jacobian(q[:50]), "Jacobians")
    ours, peer, cosines, poses = best(
        lambda: arm.jacobian(q),
        theirs,
        lambda: [(np.cos(column), np.sin(column)) for column in q.T],
        lambda: arm.forward(q),
        turns=20,
    )
    one, batch_of_one = best(
        lambda: [arm.jacobian(each) for each in listed[:200]],
        lambda: [arm.jacobian(each[None]) for each in listed[:200]],
    )
    return [
        Row(
            f"Jacobian, {len(q):,} postures of the RX-90; a loop over Pinocchio",
            f"{1e6 * ours / len(q):.2f} us",
            f"{1e6 * peer / len(q):.2f} us",
            f"{peer / ours:.2f} x",
            "no slower than Pinocchio in a loop",
            peer >= ours,
        ),
        Row(
            f"forward, {len(q):,} postures of the RX-90; cosines and sines alone",
            f"{1e6 * poses / len(q):.2f} us",
            f"{1e6 * cosines / len(q):.2f} us",
            f"{poses / cosines:.2f} of it",
            "no more than 3 times",
            poses <= 3 * cosines,
        ),
        Row(
            "Jacobian, one posture; a batch of one",
            f"{1e6 * one / 200:.1f} us",
            f"{1e6 * batch_of_one / 200:.1f} us",
            f"{batch_of_one / one:.0f} x",
            "8 x faster",
            batch_of_one >= 8 * one,
        ),
    ]


def symbolic():
    table = ARM.table
    simplified = fresh(lambda: sp.simplify(table.product()))
    merged = min((fresh(table.symbolic_forward) for _ in range(3)), key=lambda done: done[0])
    if not agree(simplified[1], merged[1]):
        raise RuntimeError("the two symbolic models differ")
    ratio = simplified[0] / merged[0]
    operations = [int(sum(sp.count_ops(entry) for entry in done[1])) for done in (merged, simplified)]
    return [
        Row(
            "symbolic 0T6 of the RX-90",
            seconds(merged[0]),
            seconds(simplified[0]),
            f"{ratio:.0f} x",
            "30 x faster than sympy.simplify of the product",
            ratio >= 30,
        ),
        Row(
            "  operations in its entries",
            str(operations[0]),
            str(operations[1]),
            f"{operations[0] / operations[1]:.2f}",
            "no more than simplify's",
            operations[0] <= operations[1],
        ),
    ]


def workspace_points():
    lengths, limits = (1.0, 0.6), [(-2.5, 2.5), (-3.0, 3.0)]
    rng = np.random.default_rng(0)
    first = rng.uniform(*limits[0], POINTS)
    elbow = first + rng.uniform(*limits[1], POINTS)
    ours, bare = best(
        lambda: workspace.sample(lambda q: workspace.planar_points(lengths, q), limits, POINTS, rng),
        lambda: (np.cos(first), np.sin(first), np.cos(elbow), np.sin(elbow)),
    )
    side = int(POINTS**0.5)
    q1, q2 = (np.linspace(*pair, side) for pair in limits)
    sums = np.add.outer(q1, q2).ravel()
    grid, grid_bare = best(
        lambda: workspace.rr_grid(*lengths, q1, q2), lambda: (np.cos(q1), np.sin(q1), np.cos(sums), np.sin(sums))
    )
    return [
        Row(
            f"{POINTS:,} points of the 2R arm, {how}",
            seconds(a),
            seconds(b),
            f"{a / b:.2f} x",
            "3 x the bare cosines and sines",
            a <= 3 * b,
        )
        for how, a, b in [("random joints drawn too", ours, bare), ("grid", grid, grid_bare)]
    ]


def imports():
    """Both imports in one fresh process, ours last: what it adds is measured, not a difference.

    The first run leaves our bytecode in the cache, where that of numpy and sympy already is.
    """
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    script = (
        "import json; from time import perf_counter as now; a = now(); import numpy, sympy; "
        "b = now(); import autograder.reference; c = now(); print(json.dumps([b - a, c - b]))"
    )
    runs = [
        json.loads(
            subprocess.run(
                [sys.executable, "-c", script], check=True, text=True, capture_output=True, env=environment
            ).stdout
        )
        for _ in range(7)
    ]
    peer, added = (min(times) for times in zip(*runs))
    return [
        Row(
            "import autograder.reference (peer: numpy and sympy)",
            seconds(peer + added),
            seconds(peer),
            f"+{added:.3f} s",
            "+0.1 s",
            added <= 0.1,
        )
    ]


def fresh(action):
    """(seconds, result) without what sympy remembers from before."""
    sp.core.cache.clear_cache()
    start = perf_counter()
    result = action()
    return perf_counter() - start, result


def random_joints():
    return np.random.default_rng(0).uniform(-np.pi, np.pi, (POSES, 6))


def must_equal(a, b, what):
    """A benchmark of two different things means nothing."""
    if not np.allclose(a, b, atol=1e-9):
        raise RuntimeError(f"{what} differ: the measurement would be meaningless")


def seconds(value):
    return f"{value:.3g} s" if value >= 1 else f"{1000 * value:.3g} ms"


def main():
    table = Table(title="Reference solver against its peers")
    for name in ("what", "ours", "peer", "ratio", "target", ""):
        table.add_column(name, overflow="fold")
    rows = [
        row
        for measure in (forward, jacobians, inverse, inverse_floor, six_turns, symbolic, workspace_points, imports)
        for row in measure()
    ]
    for row in rows:
        verdict = {True: "[green]met[/]", False: "[red]missed[/]", None: "[yellow]not run[/]"}
        table.add_row(row.what, row.ours, row.peer, row.ratio, row.target, verdict[row.met])
    Console(width=150).print(table)
    return 0 if all(row.met for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
