"""Derivations read against their sources, equation by equation; what a source prints is typed in here, in its own way.

* RX-90: Khalil and Dombre, "Modeling, Identification and Control of Robots", 2002, chapter 4, whose F, G, H are s, n, a
  seen from frame 3. Same equations, same types (2, 6, 2, 3, 3). Of the pair of type 6 they solve for theta_2 first, we for
  theta_3, as Craig does: its two values are the two sides of the elbow whatever the pose.
* PUMA 560: Craig, "Introduction to Robotics", 3rd ed., 2005, section 4.7. Same equations; he squares all three
  coordinates where we square two, which is the same by the first step.
* UR5e: Hawkins, "Analytic inverse kinematics for the Universal Robots UR-5/UR-10 arms", 2013. Same order. He has theta_5 from
  the tool's place, we have it from its axis, which needs no d_6; he has theta_4 last from what is left, we by a difference.
* SCARA: the solved tutorial of the s600, whose type 8 has B_1 and B_2 as ours does.
"""

from functools import cache
from math import acos, atan2, cos, hypot, pi, sin, sqrt

import numpy as np
import pytest
import sympy as sp

from autograder.reference import robots
from dhm import DHTable, Robot, derivation

pytestmark = pytest.mark.slow

SIDES, HALF = (1, -1), pi / 2
UR5E = {"d1": 0.1625, "a2": -0.425, "a3": -0.3922, "d4": 0.1333, "d5": 0.0997, "d6": 0.0996}
PUMA = {"a2": 0.4318, "a3": 0.0203, "d3": 0.14909, "d4": 0.4331, "d6": 0.05625}
(sx, nx, ax, Px), (sy, ny, ay, Py), (sz, nz, az, Pz) = (sp.symbols(f"s_{i} n_{i} a_{i} P_{i}") for i in "xyz")
C1, C2, C4, C5, C6, C23 = (sp.cos(sp.Symbol(f"theta_{i}")) for i in (1, 2, 4, 5, 6, 23))
S1, S2, S4, S5, S6, S23 = (sp.sin(sp.Symbol(f"theta_{i}")) for i in (1, 2, 4, 5, 6, 23))
a2, a3, d3, d4, d5 = sp.symbols("a_2 a_3 d_3 d_4 d_5")


@cache
def found(name):
    tables = {
        "UR5e": lambda d1, a2, a3, d4, d5, d6: DHTable.from_classic(
            [(0, 0, HALF, d1, None), (0, a2, 0, 0, None), (0, a3, 0, 0, None)]
            + [(0, 0, HALF, d4, None), (0, 0, -HALF, d5, None), (0, 0, 0, d6, None)]
        ),
        "PUMA 560": lambda a2, a3, d3, d4, d6: DHTable(
            [(0, 0, 0, 0, None), (0, 0, -HALF, 0, None), (0, a2, 0, d3, None)]
            + [(0, a3, -HALF, d4, None), (0, 0, HALF, 0, None), (0, 0, -HALF, d6, None)]
        ),
    }
    numbers = {"UR5e": UR5E, "PUMA 560": PUMA}
    robot = Robot(tables[name](**numbers[name])) if name in tables else getattr(robots, name)
    return robot, derivation(robot)


def run(text):
    program = {}
    exec(compile(text, "program", "exec"), program)
    return program["postures"]


def spelled_out(its):
    """For each step its equations as differences, with what is seen from later frames written out."""
    seen = {name: entry for step in its.steps for name, entry in step.seen}

    def whole(expression):
        while expression.has(*seen):
            expression = expression.xreplace(seen)
        return sp.expand(expression)

    return [[whole(each.difference) for each in step.equations] for step in its.steps]


def assert_same(its, printed):
    """Every equation of every step is one of those that the source prints for it, up to the sign."""
    for ours, theirs in zip(spelled_out(its), printed, strict=True):
        for mine in ours:
            assert any(sp.expand(mine - sign * sp.expand(each)) == 0 for each in theirs for sign in SIDES), mine


def assert_same_postures(robot, its, source, tool=(0.0, 0.0, 0.0)):
    """On random poses; both lists in any order."""
    postures, behind = run(its.to_python()), np.eye(4)
    behind[:3, 3] = tool
    for q in np.random.default_rng(8).uniform(-pi, pi, (20, robot.table.chain.joints)):
        T = robot.forward(q)
        mine, theirs = postures(T), np.array(source(T @ np.linalg.inv(behind)))
        apart = np.abs(np.angle(np.exp(1j * (mine[:, None] - theirs)))).max(axis=2)
        assert len(mine) and apart.min(axis=0).max() < 1e-8 and apart.min(axis=1).max() < 1e-8


def test_rx90_as_khalil_and_dombre():
    """Their D3 and RL4 are a3 and d3 in the slides' table."""
    _, its = found("RX90")
    a3, d3 = sp.symbols("a3 d3")
    columns = sp.Matrix([[sx, nx, ax], [sy, ny, ay], [sz, nz, az]])
    (Fx, Gx, Hx), (_, _, Hy), (Fz, Gz, Hz) = (
        sp.Matrix([[C1 * C23, S1 * C23, S23], [-C1 * S23, -S1 * S23, C23], [S1, -C1, 0]]) * columns
    ).tolist()
    assert_same(
        its,
        [
            [-S1 * Px + C1 * Py],
            [C1 * Px + S1 * Py - (C2 * a3 - S23 * d3), Pz - (S2 * a3 + C23 * d3)],
            [-S4 * Hx - C4 * Hz],
            [C4 * Hx - S4 * Hz + S5, Hy - C5],
            [-S4 * Fx - C4 * Fz - S6, -S4 * Gx - C4 * Gz - C6],
        ],
    )


def khalil_and_dombre_rx90(T, D3=0.45, RL4=0.45):
    (px, py, pz), R = T[:3, 3], T[:3, :3]
    for t1 in (atan2(py, px), atan2(py, px) + pi):
        B1 = px * cos(t1) + py * sin(t1)
        X, Y, Z = -2 * pz * D3, -2 * B1 * D3, RL4**2 - D3**2 - pz**2 - B1**2
        for e in SIDES:
            root = sqrt(X**2 + Y**2 - Z**2)
            c2, s2 = (Y * Z - e * X * root) / (X**2 + Y**2), (X * Z + e * Y * root) / (X**2 + Y**2)
            t3 = atan2((-pz * s2 - B1 * c2 + D3) / RL4, (-B1 * s2 + pz * c2) / RL4)
            t2 = atan2(s2, c2)
            c1, s1, c23, s23 = cos(t1), sin(t1), cos(t2 + t3), sin(t2 + t3)
            F, G, H = (np.array([[c1 * c23, s1 * c23, s23], [-c1 * s23, -s1 * s23, c23], [s1, -c1, 0]]) @ R).T
            for t4 in (atan2(H[2], -H[0]), atan2(H[2], -H[0]) + pi):
                c4, s4 = cos(t4), sin(t4)
                t5 = atan2(-c4 * H[0] + s4 * H[2], H[1])
                yield t1, t2, t3, t4, t5, atan2(-s4 * F[0] - c4 * F[2], -s4 * G[0] - c4 * G[2])


def test_rx90_has_the_postures_of_khalil_and_dombre():
    assert_same_postures(*found("RX90"), lambda T: list(khalil_and_dombre_rx90(T)))


def test_puma_as_craig():
    _, its = found("PUMA 560")
    r13, r23, r33 = ax, ay, az
    assert_same(
        its,
        [
            [-S1 * Px + C1 * Py - d3],
            [C1 * Px + S1 * Py - (a3 * C23 - d4 * S23 + a2 * C2), -Pz - (a3 * S23 + d4 * C23 + a2 * S2)],
            [C4 * (-r13 * S1 + r23 * C1) - S4 * (-r13 * C1 * C23 - r23 * S1 * C23 + r33 * S23)],
            [
                r13 * (C1 * C23 * C4 + S1 * S4) + r23 * (S1 * C23 * C4 - C1 * S4) - r33 * S23 * C4 + S5,
                -r13 * C1 * S23 - r23 * S1 * S23 - r33 * C23 - C5,
            ],
            [
                -sx * (C1 * C23 * S4 - S1 * C4) - sy * (S1 * C23 * S4 + C1 * C4) + sz * S23 * S4 - S6,
                -nx * (C1 * C23 * S4 - S1 * C4) - ny * (S1 * C23 * S4 + C1 * C4) + nz * S23 * S4 - C6,
            ],
        ],
    )
    bend = its.steps[1].solved[0].coefficients
    assert [sp.expand(part / (2 * a2)) for part in bend[:2]] == [-d4, a3]  # a_3 C_3 - d_4 S_3 = K


def craig_puma_560(T):
    a2, a3, d3, d4, _ = PUMA.values()
    (r11, _, r13, px), (r21, _, r23, py), (r31, _, r33, pz) = T[:3].tolist()
    K = (px**2 + py**2 + pz**2 - a2**2 - a3**2 - d3**2 - d4**2) / (2 * a2)
    for e in SIDES:
        t1 = atan2(py, px) - atan2(d3, e * sqrt(px**2 + py**2 - d3**2))
        c1, s1 = cos(t1), sin(t1)
        for g in SIDES:
            t3 = atan2(a3, d4) - atan2(K, g * sqrt(a3**2 + d4**2 - K**2))
            c3, s3, out = cos(t3), sin(t3), c1 * px + s1 * py
            t23 = atan2((-a3 - a2 * c3) * pz - out * (d4 - a2 * s3), (a2 * s3 - d4) * pz + (a3 + a2 * c3) * out)
            c23, s23 = cos(t23), sin(t23)
            t4 = atan2(-r13 * s1 + r23 * c1, -r13 * c1 * c23 - r23 * s1 * c23 + r33 * s23)
            c4, s4 = cos(t4), sin(t4)
            s5 = -(r13 * (c1 * c23 * c4 + s1 * s4) + r23 * (s1 * c23 * c4 - c1 * s4) - r33 * s23 * c4)
            c5 = -r13 * c1 * s23 - r23 * s1 * s23 - r33 * c23
            s6 = -r11 * (c1 * c23 * s4 - s1 * c4) - r21 * (s1 * c23 * s4 + c1 * c4) + r31 * s23 * s4
            c6 = (
                r11 * ((c1 * c23 * c4 + s1 * s4) * c5 - c1 * s23 * s5)
                + r21 * ((s1 * c23 * c4 - c1 * s4) * c5 - s1 * s23 * s5)
                - r31 * (s23 * c4 * c5 + c23 * s5)
            )
            t5, t6 = atan2(s5, c5), atan2(s6, c6)
            yield t1, t23 - t3, t3, t4, t5, t6
            yield t1, t23 - t3, t3, t4 + pi, -t5, t6 + pi


def test_puma_has_the_postures_of_craig():
    """His frame 6 is in the wrist's centre: our d_6 is a tool."""
    assert_same_postures(*found("PUMA 560"), lambda T: list(craig_puma_560(T)), (0, 0, PUMA["d6"]))


def test_ur5e_as_hawkins():
    """His place of the tool without d_6 is P, his height without d_1 too."""
    _, its = found("UR5e")
    C3, C234 = (sp.cos(sp.Symbol(f"theta_{i}")) for i in (3, 234))
    S3, S234 = (sp.sin(sp.Symbol(f"theta_{i}")) for i in (3, 234))
    right = C6 * (nx * C1 + ny * S1) + S6 * (sx * C1 + sy * S1)
    assert_same(
        its,
        [
            [Px * S1 - Py * C1 - d4],
            [ax * S1 - ay * C1 - C5],  # times d_6 it is what he prints
            [-(nx * S1 - ny * C1) - S5 * S6, sx * S1 - sy * C1 - S5 * C6],
            [nz * C6 + sz * S6 - C234, right + S234],
            [
                Px * C1 + Py * S1 - d5 * S234 - (a2 * C2 + a3 * C23),
                Pz + d5 * C234 - (a2 * S2 + a3 * S23),
            ],
        ],
    )
    bend = its.steps[4].solved[0]
    assert bend.unknown.name == "theta_3" and [sp.expand(part) for part in bend.coefficients[:2]] == [0, 2 * a2 * a3]
    assert not {C3, S3} & set().union(*(part.atoms(sp.sin, sp.cos) for part in bend.coefficients))


def hawkins_ur5e(T):
    d1, a2, a3, d4, d5, d6 = UR5E.values()
    (T00, T01, T02, T03), (T10, T11, T12, T13), (T20, T21, T22, T23) = T[:3].tolist()
    A, B = d6 * T12 - T13, d6 * T02 - T03
    for e in SIDES:
        q1 = e * acos(d4 / hypot(A, B)) + atan2(-B, A)
        c1, s1 = cos(q1), sin(q1)
        for f in SIDES:
            q5 = f * acos((T03 * s1 - T13 * c1 - d4) / d6)
            c5, s5 = cos(q5), sin(q5)
            q6 = atan2(-f * (T01 * s1 - T11 * c1), f * (T00 * s1 - T10 * c1))
            c6, s6 = cos(q6), sin(q6)
            x04x = -s5 * (T02 * c1 + T12 * s1) - c5 * (s6 * (T01 * c1 + T11 * s1) - c6 * (T00 * c1 + T10 * s1))
            x04y = c5 * (T20 * c6 - T21 * s6) - T22 * s5
            x = d5 * (s6 * (T00 * c1 + T10 * s1) + c6 * (T01 * c1 + T11 * s1)) - d6 * (T02 * c1 + T12 * s1)
            x += T03 * c1 + T13 * s1
            y = T23 - d1 - d6 * T22 + d5 * (T21 * c6 + T20 * s6)
            c3 = (x * x + y * y - a2 * a2 - a3 * a3) / (2 * a2 * a3)
            if abs(c3) > 1:
                continue
            for g in SIDES:
                q3 = g * acos(c3)
                along, aside = a2 + a3 * c3, a3 * sin(q3)
                q2 = atan2(along * y - aside * x, along * x + aside * y)
                c23, s23 = cos(q2 + q3), sin(q2 + q3)
                yield q1, q2, q3, atan2(c23 * x04y - s23 * x04x, x04x * c23 + x04y * s23), q5, q6


def test_ur5e_has_the_postures_of_hawkins():
    assert_same_postures(*found("UR5e"), lambda T: list(hawkins_ur5e(T)))


def test_scara_as_in_the_solved_tutorial():
    """The s600: C_2 from the squares, S_1 and C_1 from B_1 and B_2, theta_4 from the sum of the angles."""
    robot, its = found("ADEPT_S600")
    text = its.to_markdown()
    assert r"B_1 = C_{2} d_{3} + d_{2}" in text and r"B_2 = - S_{2} d_{3}" in text
    names = [each.name for step in its.steps for each in step.unknowns]
    assert names == ["r_3", "theta_12m4", "theta_2", "theta_1"]
    d2, d3 = (its.setting.values[sp.Symbol(name)] for name in ("d2", "d3"))

    def tutorial(T):
        x, y, turned = T[0, 3], T[1, 3], atan2(T[1, 0], T[0, 0])
        for e in SIDES:
            c2 = (x * x + y * y - d2**2 - d3**2) / (2 * d2 * d3)
            t2 = atan2(e * sqrt(1 - c2**2), c2)
            B1, B2 = d2 + d3 * cos(t2), d3 * sin(t2)
            t1 = atan2((y * B1 - x * B2) / (B1**2 + B2**2), (x * B1 + y * B2) / (B1**2 + B2**2))
            yield t1, t2, t1 + t2 - turned

    postures = run(its.to_python())
    for q in np.random.default_rng(8).uniform(-0.9, 0.9, (20, 4)):
        T = robot.forward(q)
        mine, theirs = postures(T)[:, [0, 1, 3]], np.array(list(tutorial(T)))
        apart = np.abs(np.angle(np.exp(1j * (mine[:, None] - theirs)))).max(axis=2)
        assert mine.shape == (2, 3) and apart.min(axis=0).max() < 1e-8 and apart.min(axis=1).max() < 1e-8
