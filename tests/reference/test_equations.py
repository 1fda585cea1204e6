"""General equations: every solution right, none missing, every degenerate case named.

The oracle is Newton's method from a grid of starts: it knows the equations and
nothing of their solutions.
"""

import numpy as np
import pytest

from autograder.reference import Status
from autograder.reference import equations as eq
from dhkit.geometry import wrap

pytestmark = pytest.mark.filterwarnings("error")


# -- the equations as residuals: angles (..., u), coefficients (..., k) -----------


def residual2(t, c):
    X, Y, Z = np.moveaxis(c, -1, 0)
    return (X * np.sin(t[..., 0]) + Y * np.cos(t[..., 0]) - Z)[..., None]


def residual3(t, c):
    return np.concatenate([residual2(t, c[..., :3]), residual2(t, c[..., 3:])], axis=-1)


def residual6(t, c):
    W, X, Y, Z1, Z2 = np.moveaxis(c, -1, 0)
    i, j = t[..., 0], t[..., 1]
    return np.stack(
        [W * np.sin(j) - X * np.cos(i) - Y * np.sin(i) - Z1, W * np.cos(j) - X * np.sin(i) + Y * np.cos(i) - Z2],
        axis=-1,
    )


def residual7(t, c):
    W1, W2, X, Y, Z1, Z2 = np.moveaxis(c, -1, 0)
    i, j = t[..., 0], t[..., 1]
    return np.stack(
        [
            W1 * np.cos(j) + W2 * np.sin(j) - X * np.cos(i) - Y * np.sin(i) - Z1,
            W1 * np.sin(j) - W2 * np.cos(j) - X * np.sin(i) + Y * np.cos(i) - Z2,
        ],
        axis=-1,
    )


def residual8(t, c):
    X, Y, Z1, Z2 = np.moveaxis(c, -1, 0)
    i, ij = t[..., 0], t[..., 0] + t[..., 1]
    return np.stack([X * np.cos(i) + Y * np.cos(ij) - Z1, X * np.sin(i) + Y * np.sin(ij) - Z2], axis=-1)


CASES = {
    "type2": (eq.type2, residual2, 1, 3),
    "type3": (eq.type3, residual3, 1, 6),
    "type6": (eq.type6, residual6, 2, 5),
    "type7": (eq.type7, residual7, 2, 6),
    "type8": (eq.type8, residual8, 2, 4),
}


def unpack(solve, c):
    roots = solve(*np.moveaxis(c, -1, 0))
    values = roots.values if solve not in (eq.type2, eq.type3) else roots.values[..., None]
    return roots, values


def make_solvable(name, c, angles):
    """Change the right-hand sides so that `angles` is a solution."""
    _, residual, _, _ = CASES[name]
    wrong = residual(angles, c)
    places = {"type2": [2], "type3": [2, 5], "type6": [3, 4], "type7": [4, 5], "type8": [2, 3]}
    c = c.copy()
    c[..., places[name]] += wrong
    return c


def multistart(residual, c, unknowns, per_axis):
    """All roots that Newton (least-squares steps, damped) finds: list of arrays per case."""
    axis = np.linspace(-np.pi, np.pi, per_axis, endpoint=False) + 0.137
    starts = np.stack(np.meshgrid(*[axis] * unknowns, indexing="ij"), -1).reshape(-1, unknowns)
    t = np.broadcast_to(starts, (len(c),) + starts.shape).copy()
    coefficients = c[:, None, :]
    for _ in range(60):
        f = residual(t, coefficients)
        J = np.stack(
            [(residual(t + h, coefficients) - residual(t - h, coefficients)) / 2e-6 for h in 1e-6 * np.eye(unknowns)],
            axis=-1,
        )
        step = (np.linalg.pinv(J) @ f[..., None])[..., 0]
        t -= np.clip(step, -0.5, 0.5)
    good = np.abs(residual(t, coefficients)).max(-1) < 1e-10
    found = []
    for row, ok in zip(wrap(t), good):
        distinct = []
        for candidate in row[ok]:
            if all(np.abs(wrap(candidate - d)).max() > 1e-4 for d in distinct):
                distinct.append(candidate)
        found.append(np.array(distinct).reshape(-1, unknowns))
    return found


@pytest.mark.parametrize("name", CASES)
def test_sound_and_the_generating_angles_are_recovered(name):
    solve, residual, unknowns, size = CASES[name]
    rng = np.random.default_rng(10)
    angles = rng.uniform(-np.pi, np.pi, (5000, unknowns))
    c = make_solvable(name, rng.normal(size=(5000, size)), angles)
    roots, values = unpack(solve, c)
    assert np.isfinite(values).all()
    assert (roots.count >= 1).all()
    error = np.abs(residual(values, c[:, None, :])).max(-1)
    assert error[roots.exists].max() < 1e-9
    gap = np.where(roots.exists, np.abs(wrap(values - angles[:, None])).max(-1), np.inf)
    assert np.quantile(gap.min(-1), 0.99) < 1e-9 and gap.min(-1).max() < 1e-6


@pytest.mark.parametrize("name", CASES)
def test_round_angles_are_recovered(name):
    solve, residual, unknowns, size = CASES[name]
    rounded = np.radians([0, 30, -30, 45, -45, 90, -90, 180])
    angles = np.stack(np.meshgrid(*[rounded] * unknowns), -1).reshape(-1, unknowns)
    angles = np.repeat(angles, 40, axis=0)
    rng = np.random.default_rng(11)
    c = make_solvable(name, rng.integers(-2, 3, (len(angles), size)).astype(float), angles)
    roots, values = unpack(solve, c)
    assert np.isfinite(values).all() and (roots.count != 0).all()
    error = np.abs(residual(values, c[:, None, :])).max(-1)
    assert error[roots.exists].max() < 1e-6
    finite = roots.status != Status.INFINITE
    gap = np.where(roots.exists, np.abs(wrap(values - angles[:, None])).max(-1), np.inf)
    assert gap.min(-1)[finite].max() < 3e-6
    assert (roots.free[~finite] != "").all() and (roots.free[finite] == "").all()


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_complete_against_multistart(name):
    solve, residual, unknowns, size = CASES[name]
    rng = np.random.default_rng(12)
    n = 60
    c = rng.uniform(0.3, 2, size=(n, size)) * rng.choice([-1, 1], size=(n, size))
    if name == "type3":
        c[::3, 3:] = c[::3, :3] * rng.normal(size=(n // 3, 1))
    solvable = rng.uniform(-np.pi, np.pi, (n, unknowns))
    c[: n // 2] = make_solvable(name, c, solvable)[: n // 2]
    roots, values = unpack(solve, c)
    oracle = multistart(residual, c, unknowns, 24 if unknowns == 1 else 9)
    sizes = [len(o) for o in oracle]
    assert {0, 2} <= set(sizes)
    for k in range(n):
        ours = values[k][roots.exists[k]]
        assert len(ours) == sizes[k] == roots.count[k], (c[k], ours, oracle[k])
        for theirs in oracle[k]:
            assert np.abs(wrap(ours - theirs)).max(-1).min() < 1e-6


def residual4(t, c):
    X1, Y1, X2, Y2 = np.moveaxis(c, -1, 0)
    return np.stack([X1 * t[..., 1] * np.sin(t[..., 0]) - Y1, X2 * t[..., 1] * np.cos(t[..., 0]) - Y2], axis=-1)


def residual5(t, c):
    X1, Y1, Z1, X2, Y2, Z2 = np.moveaxis(c, -1, 0)
    angle, r = t[..., 0], t[..., 1]
    return np.stack([X1 * np.sin(angle) - Y1 - Z1 * r, X2 * np.cos(angle) - Y2 - Z2 * r], axis=-1)


WITH_LENGTH = {"type4": (eq.type4, residual4, [1, 3], 4), "type5": (eq.type5, residual5, [1, 4], 6)}


@pytest.mark.parametrize("name", WITH_LENGTH)
@pytest.mark.parametrize("choice", ["random", "round"])
def test_an_angle_and_a_length_are_recovered(name, choice):
    """Round coefficients hold zeros: whatever is free then, the pairs solve the equations and a family has its name."""
    solve, residual, places, size = WITH_LENGTH[name]
    rng = np.random.default_rng(13)
    if choice == "random":
        unknowns, c = rng.uniform(-3, 3, (3000, 2)), rng.normal(size=(3000, size))
    else:
        unknowns = np.stack([rng.choice(np.radians([0, 30, -45, 90, 180]), 4000), rng.integers(-1, 2, 4000)], axis=-1)
        c = rng.integers(-1, 2, (4000, size)).astype(float)
    c[:, places] += residual(unknowns, c)
    roots = solve(*np.moveaxis(c, -1, 0))
    assert (roots.count != 0).all()
    error = np.abs(residual(roots.values, c[:, None])).max(-1)
    assert error[roots.exists].max() < (1e-9 if choice == "random" else 1e-6)
    gap = roots.values - unknowns[:, None]
    gap[..., 0] = wrap(gap[..., 0])
    gap = np.where(roots.exists, np.abs(gap).max(-1), np.inf).min(-1)
    finite = roots.status != Status.INFINITE
    assert gap[finite].max() < 3e-6 and ((roots.free != "") == ~finite).all()


@pytest.mark.parametrize("name", WITH_LENGTH)
def test_no_other_angle_and_length_is_found_by_newton(name):
    solve, residual, _, size = WITH_LENGTH[name]
    rng = np.random.default_rng(14)
    for c in rng.uniform(0.3, 2, (20, size)) * rng.choice([-1, 1], (20, size)):
        t = np.stack(np.meshgrid(np.linspace(-3, 3, 15), np.linspace(-8, 8, 15)), -1).reshape(-1, 2)
        for _ in range(60):
            ways = 1e-6 * np.eye(2)
            J = np.stack([(residual(t + h, c) - residual(t - h, c)) / 2e-6 for h in ways], axis=-1)
            t = t - np.clip((np.linalg.pinv(J) @ residual(t, c)[..., None])[..., 0], -0.5, 0.5)
        good = t[np.abs(residual(t, c)).max(-1) < 1e-10]
        ours = solve(*c).listed()
        assert bool(len(good)) == bool(len(ours))
        for each in good:
            gap = ours - each
            assert np.hypot(wrap(gap[:, 0]), gap[:, 1]).min() < 1e-6


@pytest.mark.parametrize(
    "solve, coefficients, count, free",
    [
        (eq.type4, (1, 3, 1, 4), 2, ""),
        (eq.type4, (1, 0, 1, 0), -1, "theta"),
        (eq.type4, (0, 0, 1, 4), -1, "theta (r follows)"),
        (eq.type4, (0, 1, 1, 4), 0, ""),
        (eq.type4, (0, 0, 0, 0), -1, "theta and r"),
        (eq.type5, (1, 0, 1, 1, 1, 0), 1, ""),  # the line touches the circle
        (eq.type5, (1, 0, 1, 1, 2, 0), 0, ""),
        (eq.type5, (1, 0.6, 0, 1, 0.8, 0), -1, "r"),
        (eq.type5, (0, 1, -2, 1, 0, 1), 2, ""),  # r = 1/2 from the first, then the cosine
        (eq.type5, (1, 0, 1, 0, 1, -2), 2, ""),
        (eq.type5, (0, 0, 0, 1, 0.5, 0), -1, "r"),
        (eq.type5, (0, 0, 0, 1, 0.5, 1), -1, "theta (r follows)"),
        (eq.type5, (0, 1, 0, 1, 0.5, 1), 0, ""),
        (eq.type5, (0, 1, -1, 0, 2, -2), -1, "theta"),
        (eq.type5, (0, 1, -1, 0, 1, -2), 0, ""),
        (eq.type5, (0, 0, 0, 0, 0, 0), -1, "theta and r"),
    ],
)
def test_counts_with_a_length(solve, coefficients, count, free):
    roots = solve(*coefficients)
    assert roots.count == count and str(roots.free) == free


def test_type1():
    roots = eq.type1([2, 0, 0], [3, 0, 1])
    assert roots.count.tolist() == [1, -1, 0]
    assert roots.values[0, 0] == 1.5 and roots.free.tolist() == ["", "r", ""]


@pytest.mark.parametrize(
    "coefficients, count, status",
    [
        ((1, 0, 0.5), 2, Status.SOLVED),
        ((3, 4, 5), 1, Status.BOUNDARY),
        ((3, 4, -5), 1, Status.BOUNDARY),
        ((3, 4, 5.001), 0, Status.UNREACHABLE),
        ((3, 4, 4.999), 2, Status.SOLVED),
        ((0, 0, 0), -1, Status.INFINITE),
        ((0, 0, 1), 0, Status.UNREACHABLE),
    ],
)
def test_type2_counts(coefficients, count, status):
    roots = eq.type2(*coefficients)
    assert roots.count == count and roots.status == status


@pytest.mark.parametrize(
    "coefficients, count, free",
    [
        ((1, 0, 0.6, 0, 1, 0.8), 1, ""),
        ((1, 0, 0.6, 0, 1, 0.81), 0, ""),
        ((1, 1, 0.5, 2, 2, 1.0), 2, ""),
        ((1, 1, 0.5, 2, 2, 1.1), 0, ""),
        ((0, 0, 0, 2, 2, 1.0), 2, ""),
        ((0, 0, 0.1, 2, 2, 1.0), 0, ""),
        ((3, 4, 5, 6, 8, 10), 1, ""),
        ((0, 0, 0, 0, 0, 0), -1, "theta"),
        ((0, 0, 0, 0, 0, 1), 0, ""),
    ],
)
def test_type3_counts(coefficients, count, free):
    roots = eq.type3(*coefficients)
    assert roots.count == count and roots.free == free


@pytest.mark.parametrize(
    "coefficients, count, free",
    [
        ((1, 0.6, 1.0, 0.2), 2, ""),
        ((1, 0.6, 1.6, 0), 1, ""),
        ((1, 0.6, 0, -0.4), 1, ""),
        ((1, 0.6, 1.61, 0), 0, ""),
        ((1, 0.6, 0.39, 0), 0, ""),
        ((1, 0.6, 0, 0), 0, ""),
        ((1, 1, 0, 0), -1, "theta_i"),
        ((1, -1, 0, 0), -1, "theta_i"),
        ((1, 1, 2, 0), 1, ""),
        ((1, 0, 0, 1), -1, "theta_j"),
        ((0, 1, 0, 1), -1, "theta_i (theta_i + theta_j defined)"),
        ((1, 0, 0, 0.9), 0, ""),
        ((0, 0, 0, 0), -1, "theta_i and theta_j"),
        ((0, 0, 1, 0), 0, ""),
    ],
)
def test_type8_counts(coefficients, count, free):
    roots = eq.type8(*coefficients)
    assert roots.count == count and roots.free == free
    listed = roots.listed()
    assert len(listed) == abs(count)
    if count:
        assert np.abs(residual8(listed, np.array(coefficients, float))).max() < 1e-9


def test_type8_keeps_its_accuracy_at_the_limits():
    """Both sides of the outer and inner circles, down to the merging of solutions."""
    distance = np.array([1e-3, 1e-6, 1e-9, 1e-11])
    for limit, side in [(1.6, -1), (0.4, 1)]:
        rho = limit + side * distance
        roots = eq.type8(1.0, 0.6, rho, 0.0)
        assert (roots.count == 2).all()
        error = residual8(roots.values, np.stack([np.ones(4), np.full(4, 0.6), rho, np.zeros(4)], -1)[:, None])
        assert np.abs(error).max() < 1e-14
        assert (eq.type8(1.0, 0.6, limit - side * distance, 0.0).count == 0).all()
        assert eq.type8(1.0, 0.6, limit + 1e-15, 0.0).count == 1


def test_type7_without_arm_leaves_theta_j_free():
    roots = eq.type7(0, 0, 1, 0, -0.6, -0.8)
    assert roots.count == -1 and roots.free == "theta_j"
    assert np.abs(residual7(roots.listed(), np.array([0, 0, 1, 0, -0.6, -0.8]))).max() < 1e-12
    assert eq.type7(0, 0, 1, 0, -0.6, -0.9).count == 0
    assert eq.type7(1, 0, 0, 1, 0, 0).free == "theta_i"


def test_the_s600_vector():
    """Adept s600: d2 = 0.325, d3 = 0.275, (t1, t2) = (30, 50) degrees."""
    x, y = (
        0.325 * np.cos(np.pi / 6) + 0.275 * np.cos(np.radians(80)),
        (0.325 * np.sin(np.pi / 6) + 0.275 * np.sin(np.radians(80))),
    )
    assert np.allclose([x, y], [0.329212, 0.433322], atol=1e-6)
    found = np.degrees(eq.type8(0.325, 0.275, x, y).listed())
    assert np.allclose(found, [[30, 50], [75.5493, -50]], atol=1e-4)


def test_millimetres_serve_as_well_as_metres():
    roots = eq.type8(325.0, 275.0, 600.0 * np.cos(0.3), 600.0 * np.sin(0.3))
    assert roots.status == Status.BOUNDARY


def test_batches_broadcast_and_bad_input_is_refused():
    assert eq.type8(1.0, [[0.5], [0.6]], [1.0, 1.1, 1.2], 0.0).values.shape == (2, 3, 2, 2)
    assert eq.type2(np.empty(0), 1.0, 0.5).values.shape == (0, 2)
    with pytest.raises(ValueError, match="finite"):
        eq.type2(1.0, np.nan, 0.0)
    with pytest.raises(ValueError, match="one problem at a time"):
        eq.type2([1.0, 1.0], 0.0, 0.0).listed()
