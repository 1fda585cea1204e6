"""What only a verdict can know: whose numbers, what went wrong before, which freedoms, how far off."""

import numpy as np
import pytest
import sympy
from answers import verdict

from autograder.judge import Evidence, Family, Follow, Question, following, is_forgivable, judge, kinds, mistake
from autograder.judge.chain import SAME_SENSES
from autograder.judge.decode import decode
from autograder.judge.misconceptions import classic_table, columns_exchanged
from autograder.questions import find
from dhkit import public, variants, wire
from dhkit.public import from_table

t1, t2, L1, L2, a2, a3, d2, t4 = sympy.symbols("t1 t2 L1 L2 a2 a3 d2 t4")
ADA, BOB = "ada", "bob"


def length(student):
    return variants.numbers("arm", student)["L1"]


TABLES = {
    "arm.reach": {"kind": "number", "expected": "one number"},
    "arm.both": {"kind": "joint_solutions", "expected": "a list of all (t1, t2)", "joints": ["t1", "t2"]},
    "arm.angles": {
        "kind": "orientation",
        "expected": "three angles",
        "axes": "zyx",
        "names": ["psi", "theta", "phi"],
    },
    "arm.fixed": {"kind": "orientation", "expected": "three angles", "axes": "xyz", "frames": "fixed"},
    "arm.free": {"kind": "direction", "expected": "a direction", "shape": [2]},
    "arm.cloud": {"kind": "point_cloud", "expected": "a list of points", "shape": [2]},
    "arm.half": {
        "kind": "function",
        "expected": "a function",
        "returns": {"kind": "vector", "expected": "two numbers", "shape": [2]},
    },
    "arm.rows": {
        "kind": "dh_table",
        "expected": "four rows [sigma, a, alpha, d, theta]",
        "shape": [4, 5],
        "symbols": ["t1", "t2", "d2", "t4", "a2", "a3"],
        "joints": ["t1", "t2", "d2", "t4"],
    },
    "arm.product": {
        "kind": "transform",
        "expected": "a 4x4 matrix",
        "shape": [4, 4],
        "symbols": ["t1", "t2", "d2", "t4", "a2", "a3"],
    },
    "arm.T": {"kind": "transform", "expected": "a 4x4 matrix", "shape": [4, 4]},
}


@pytest.fixture(autouse=True)
def arm(monkeypatch):
    """An exercise of our own: nothing here depends on the questions of the course."""
    known = public.questions() | {id: from_table(id, {"title": id, **table}) for id, table in TABLES.items()}
    monkeypatch.setattr(public, "find", lambda id: known[id])
    monkeypatch.setattr(
        variants, "variant_ranges", lambda exercise: {"L1": (0.1, 100.0, 0.1)} if exercise == "arm" else {}
    )


def evidence(id, answer, **whose):
    return Evidence(wire.packet(id, answer=wire.encode(answer), **whose))


def judged(question, answer, whose=ADA, earlier=None, **typed):
    return judge(question, evidence(question.id, answer, **typed), whose, earlier)


# ---------------------------------------------------------------- numbers of one's own

REACH = Question(
    "arm.reach",
    reference=lambda mine: 2 * mine.L1,
    mistakes=(
        mistake(
            "halved",
            0.5,
            "**Half of it.** With your L1 = {L1} m the arm is longer; {this} stays.",
            lambda reach: reach / 2,
        ),
    ),
)


def test_a_copied_answer_is_wrong_in_another_notebook():
    mine, theirs = (2 * length(student) for student in (ADA, BOB))
    assert judged(REACH, mine).note == "right"
    assert judged(REACH, theirs).share == 0
    assert judged(REACH, theirs, student="ada").share == 0


def test_an_answer_for_the_id_that_was_typed_is_told_apart():
    theirs = 2 * length(BOB)
    found = judged(REACH, theirs, student="bob")
    assert (found.note, found.share) == ("numbers_of_another_student", 0)
    assert "the id bob" in found.feedback
    assert judged(REACH, 2 * length(ADA), student="bob").note == "right"
    assert judged(REACH, 1.234, student="bob").note == "nothing_matched"
    assert "nobody" in judged(REACH, 2 * length(variants.NOBODY), student=variants.NOBODY).feedback


def test_another_spelling_of_the_own_id_is_no_other_student():
    assert judged(REACH, 2 * length("jose obrien"), "José OBrien", student="José O'Brien").note == "right"
    theirs = judged(REACH, 1.234, "José OBrien", student="jose\u0301 o'brien")
    assert theirs.note == "nothing_matched"


@pytest.mark.parametrize("typed", [17, ["bob"], {"a": 1}, "x" * 5000])
def test_a_forged_id_is_malformed(typed):
    assert judged(REACH, 1.0, student=typed).note == "malformed"


def test_the_reference_is_made_once_for_each_student():
    asked = []

    def reference(mine):
        asked.append(mine.L1)
        return 2 * mine.L1

    factors = (mistake(f"times_{k}", 0.5, "**A factor too much.**", lambda reach, k=k: k * reach) for k in (3, 5, 7))
    question = Question("arm.reach", reference=reference, mistakes=tuple(factors))
    for student in (ADA, BOB, ADA):
        right = 2 * length(student)
        notes = [judged(question, factor * right, student).note for factor in (1.5, 1, 15, 1.5)]
        assert notes == ["nothing_matched", "right", "nothing_matched", "nothing_matched"], "one number: no pairs"
    assert asked == [length(ADA), length(BOB)]


def test_feedback_uses_the_students_own_numbers():
    for student in (ADA, BOB):
        found = judged(REACH, length(student), student)
        assert (
            found.note == "halved"
            and f"your L1 = {length(student)} m" in found.feedback
            and "{this} stays" in found.feedback
        )


# ---------------------------------------------------------------- errors carried over

ROWS = [[0, 0, 0, 0, t1], [0, a2, 0, 0, t2], [1, a3, 0, -d2, 0], [0, 0, 0, 0, t4]]


def hand(rows):
    result = sympy.eye(4)
    for _, a, alpha, d, theta in rows:
        for axis, shift, angle in ((0, a, alpha), (2, d, theta)):
            turn = sympy.Matrix(sympy.rot_axis1(-angle) if axis == 0 else sympy.rot_axis3(-angle))
            result = result * turn.row_join(sympy.Matrix([shift if k == axis else 0 for k in range(3)])).col_join(
                sympy.Matrix([[0, 0, 0, 1]])
            )
    return result


TABLE = Question("arm.rows", ROWS, (classic_table(), columns_exchanged("a", "d")), partial=0.6, pinned=SAME_SENSES)
PRODUCT = Question("arm.product", hand(ROWS), follows=Follow("arm.rows", following.product_of_table))


def test_the_right_product_of_a_wrong_table_earns_the_points_of_the_product():
    wrong = [ROWS[0], [0, a2 + a3, 0.3, 0, t2 + 1], *ROWS[2:]]
    before = {"arm.rows": evidence("arm.rows", wrong)}
    assert judged(TABLE, wrong).share < 1
    product = hand(wrong)
    assert judged(PRODUCT, product).share < 1
    found = judged(PRODUCT, product, earlier=before)
    assert (found.note, found.share) == ("right_from_earlier", 1.0)
    assert judged(PRODUCT, hand(ROWS), earlier=before).note == "right"


def test_where_a_length_got_lost_nothing_follows():
    wrong = [ROWS[0], [0, 0, 0, 0, t2], *ROWS[2:]]
    before = {"arm.rows": evidence("arm.rows", wrong)}
    assert is_forgivable(judged(TABLE, wrong))
    assert judged(PRODUCT, hand(wrong), earlier=before).note != "right_from_earlier"


def test_another_product_than_that_of_the_table_is_still_wrong():
    wrong = [ROWS[0], [0, a2 + a3, 0.3, 0, t2 + 1], *ROWS[2:]]
    product = hand(wrong)
    product[0, 3] += a2 / 10
    found = judged(PRODUCT, product, earlier={"arm.rows": evidence("arm.rows", wrong)})
    assert found.share < 1


@pytest.mark.parametrize("table", [None, "text", [[...] * 5] * 4, [[1 / sympy.Symbol("t1")] * 5] * 4, {"a": 1}])
def test_an_earlier_answer_that_says_nothing_forgives_nothing(table):
    assert judged(PRODUCT, sympy.eye(4), earlier={"arm.rows": evidence("arm.rows", table)}).share < 1
    assert judged(PRODUCT, sympy.eye(4), earlier={"arm.rows": Evidence(None)}).share < 1


def test_the_product_of_a_table_follows_from_its_values():
    rows = np.random.default_rng(4).uniform(-1, 1, (3, 4, 5))
    for found, row in zip(following.product_of_table(rows), rows, strict=True):
        assert np.allclose(found, np.array(hand(row.tolist()), dtype=float))


def test_only_a_named_mistake_or_one_slip_is_forgiven_later():
    """From a table of zeros follows the identity: a guess must not earn the points of the product."""
    table = TABLE
    named = next(node for node in table.mistakes if node.note == "classic_table")
    assert is_forgivable(judged(table, ROWS))
    assert is_forgivable(judged(table, table.answer(ADA, *named.ways[:1])))
    assert is_forgivable(judged(table, [[0, 0, 0, 0, t1], [0, 3 * a2, 0, 0, t2], *ROWS[2:]]))
    assert is_forgivable(judged(table, [ROWS[0], [0, a2, 0.3, a3, t2], *ROWS[2:]]))
    joints_only = [[0, 0, 0, 0, joint] for joint in (t1, t2, d2, t4)]
    for guess in ([[0] * 5] * 4, [ROWS[0], *[[0] * 5] * 3], joints_only, ..., "text"):
        assert not is_forgivable(judged(table, guess))


# ---------------------------------------------------------------- sets of solutions


def residual(q):
    return np.hypot(np.cos(q[:, 0]) + np.cos(q.sum(axis=1)) - 1, np.sin(q[:, 0]) + np.sin(q.sum(axis=1)) - 1)


BOTH = Question("arm.both", reference=[[0, np.pi / 2], [np.pi / 2, -np.pi / 2]], angles=(0, 1), residual=residual)
FREE = Question(
    "arm.both", reference=Family([[0, np.pi]]), angles=(0, 1),
    residual=lambda q: np.hypot(np.cos(q[:, 0]) + np.cos(q.sum(axis=1)), np.sin(q[:, 0]) + np.sin(q.sum(axis=1))),
)  # fmt: skip


def test_missing_and_wrong_solutions_are_told_apart_and_measured():
    assert judged(BOTH, [[0, np.pi / 2], [np.pi / 2, -np.pi / 2]]).note == "right"
    assert "1 of 2 solutions missing" in judged(BOTH, [[0, np.pi / 2]]).feedback
    wrong = judged(BOTH, [[0, np.pi / 2], [np.pi / 2, -np.pi / 2], [0, 0]]).feedback
    assert "1 of the 3 given misses the target, by up to 1.41" in wrong and "missing" not in wrong


def test_a_single_solution_may_be_keyed_by_joint_names():
    assert "1 of 2 solutions missing" in judged(BOTH, {"t2": np.pi / 2, "t1": 0}).feedback
    assert judged(BOTH, [{"t2": np.pi / 2, "t1": 0}, {"t1": np.pi / 2, "t2": -np.pi / 2}]).note == "right"
    assert "keys t1, t3" in judged(BOTH, {"t1": 0, "t3": 1}).feedback


def test_of_infinitely_many_solutions_every_valid_one_is_right():
    for q in ([[0.7, np.pi]], [[-2, np.pi], [1, -np.pi], [3, 3 * np.pi]]):
        assert judged(FREE, q).note == "right"
    assert judged(FREE, [[0.7, 3.0]]).share == 0
    assert "gives none" in judged(FREE, []).feedback
    assert "1 of the 2 given misses" in judged(FREE, [[0.7, np.pi], [0, 1]]).feedback


def test_an_unreachable_target_has_no_solution():
    nothing = Question("arm.both", reference=[], angles=(0, 1), residual=residual)
    assert judged(nothing, []).note == "right"
    assert "no solution here" in judged(nothing, [[0, 1]]).feedback


def test_degrees_are_named_also_where_some_targets_have_no_solution():
    question = find("planar_2r.inverse")
    (node,) = (node for node in question.mistakes if node.note == "degrees")
    assert verdict(question, question.answer(ADA, *node.ways[:1])).note == "degrees"
    assert any(len(question.answer(ADA)(*args)) == 0 for args in question.probes(ADA, 7))


@pytest.mark.parametrize("rows", [[[0] * 5] * 4, [[0, 1, 2, 3, 4]] * 4])
def test_two_tables_without_any_joint_are_compared_cell_by_cell(rows):
    question = TABLE
    student, other = (kinds.read(question.form, decode(wire.encode(each))) for each in (rows, [[0, 7, 0, 0, 0]] * 4))
    assert not kinds.compare(question.form, student, other, kinds.Setting(question.samples)).equal


# ---------------------------------------------------------------- orientations, directions, clouds, transforms


def test_both_triples_of_a_rotation_are_right_and_the_error_is_told_in_degrees():
    question = Question("arm.angles", reference=[0.3, 0.5, -0.4])
    for answer in ([0.3, 0.5, -0.4], [0.3 - np.pi, np.pi - 0.5, np.pi - 0.4], {"phi": -0.4, "psi": 0.3, "theta": 0.5}):
        assert judged(question, answer).note == "right"
    assert "10 deg" in judged(question, [0.3, 0.5, -0.4 + np.radians(10)]).feedback
    assert judged(question, [0.3, 0.5, 1j]).share == 0


def test_at_gimbal_lock_every_triple_of_the_family_is_right():
    question = Question("arm.angles", reference=[0.3, np.pi / 2, 0.0])
    for shift in (-2.0, 0.4, 1.0):
        assert judged(question, [0.3 + shift, np.pi / 2, shift]).note == "right"
        assert judged(question, [0.3 + shift, np.pi / 2, -shift]).share == 0


def test_fixed_axes_are_not_moving_ones():
    moving, fixed = (
        Question("arm.angles", reference=[0.3, 0.5, -0.4]),
        Question("arm.fixed", reference=[-0.4, 0.5, 0.3]),
    )
    assert judged(moving, [0.3, 0.5, -0.4]).note == judged(fixed, [-0.4, 0.5, 0.3]).note == "right"
    assert judged(fixed, [0.3, 0.5, -0.4]).share == 0


def test_a_direction_has_neither_length_nor_sense():
    question = Question("arm.free", reference=[1, -1])
    for answer in ([1, -1], [-3, 3], [0.1, -0.1]):
        assert judged(question, answer).note == "right"
    assert "90 deg" in judged(question, [1, 1]).feedback
    assert "zeros" in judged(question, [0, 0]).feedback


def ring(inner, outer, count=3000):
    rng = np.random.default_rng(2)
    r, angle = np.sqrt(rng.uniform(inner**2, outer**2, count)), rng.uniform(-np.pi, np.pi, count)
    return np.column_stack([r * np.cos(angle), r * np.sin(angle)])


def test_a_cloud_is_judged_by_what_it_covers_and_what_it_has_outside():
    question = Question("arm.cloud", reference=ring(0.5, 1), tolerance=0.08)
    assert judged(question, ring(0.5, 1, 2000)[::-1]).note == "right"
    assert "covers" in judged(question, ring(0.5, 0.8)).feedback
    outside = judged(question, ring(0.0, 1))
    assert "lie where the robot cannot be" in outside.feedback and outside.share < 1
    for odd in ([[0, 0, 0]], [[0, np.nan]], [[0, 1j]], [[0, "a"]], [[t1, 0]], np.zeros((6000, 2))):
        assert judged(question, odd).note == "malformed"
    assert judged(question, np.zeros((1, 2))).share == 0


def test_points_outside_are_not_outweighed_by_many_at_sure_places():
    question = Question("arm.cloud", reference=ring(0.5, 1), tolerance=0.08)
    honest, sure = judged(question, ring(0.2, 1, 700)), [[0.75, 0.0]]
    assert honest.share < 1
    for much in (np.repeat(sure, 4000, axis=0), sure + np.random.default_rng(1).normal(0, 0.02, (4000, 2))):
        diluted = judged(question, np.vstack([ring(0.2, 1, 700), much]))
        assert diluted.share == pytest.approx(honest.share, abs=0.02), diluted


def test_the_error_of_a_transform_is_told_in_degrees_and_metres():
    right = np.eye(4)
    question = Question("arm.T", reference=right)
    moved, turned = right.copy(), right.copy()
    moved[:3, 3] = 0.3, 0, 0.4
    turned[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    assert (
        "position is off by up to 0.5 m" in judged(question, moved).feedback
        and "the rotation is right" in judged(question, moved).feedback
    )
    assert (
        "rotation is off by up to 90 deg" in judged(question, turned).feedback and judged(question, turned).share == 0.5
    )
    bent = right.copy()
    bent[0, 1] = 0.2
    assert "no rotation" in judged(question, bent).feedback
    last = right.copy()
    last[3, 0] = 1
    assert "last row" in judged(question, last).feedback and judged(question, last).share < 1


def test_cancellation_never_fails_a_right_answer():
    question = find("planar_2r.theta1")
    x, y, t2 = sympy.symbols("x y t2")
    right = sympy.atan2(y, x) - sympy.atan2(L2 * sympy.sin(t2), L1 + L2 * sympy.cos(t2))
    big = sympy.Integer(10) ** 18
    spoiled = sympy.Add(
        sympy.Mul(big, x + 1, evaluate=False), sympy.Mul(-big, x, evaluate=False), -big, right, evaluate=False
    )
    assert judged(question, spoiled).note == "right"
    assert judged(question, spoiled + sympy.Rational(1, 1000)).share < 1


# ---------------------------------------------------------------- functions


def halve(x, *, divided=False):
    return [x / 2, x / x if divided else 1.0]


HALF = Question(
    "arm.half",
    reference=halve,
    mistakes=(mistake("fails_at_zero", 0.6, "**At zero it fails.**", wrong={"divided": True}),),
    probe=lambda rng: [[1.0], [0.0], [3.0]],
    case=lambda x: "zero" if x == 0 else "the rest",
)


@pytest.mark.parametrize(
    "failed", [{"error": "division by zero"}, [{"float": "nan"}, 1.0], [{"float": "-inf"}, {"float": "nan"}]]
)
def test_a_value_that_is_not_finite_is_a_failure_like_an_exception(failed):
    probes = HALF.probes(ADA, 7)
    results = [[0.5, 1.0], failed, [1.5, 1.0]]
    handed_in = wire.packet("arm.half", answer={"function": "half"})
    found = judge(HALF, Evidence(handed_in, (probes, wire.packet("arm.half", probes=results))), ADA)
    assert (found.note, found.share) == ("fails_at_zero", 0.6)
