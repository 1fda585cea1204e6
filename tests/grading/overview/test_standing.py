"""Who is falling behind, and which mistakes stay."""

import pytest

from autograder.grading.overview.standing import Answer, Student, Work, falling_behind, of_class, staying

NAMES = ("a", "b", "c", "d")
CLASS = (0.9, 0.8, 0.8, 0.7, 0.6, 0.6, 0.5, 0.5)


def work(name, share):
    """An exercise with this share of ten points; a word for one that was not graded."""
    return Work(name, share, 0, 10) if isinstance(share, str) else Work(name, "graded", 10 * share, 10)


def student(*shares):
    return Student("ann", "Ann", tuple(work(name, share) for name, share in zip(NAMES, shares, strict=False)))


def exercises(shares=CLASS):
    return [of_class(name, [work(name, share) for share in shares]) for name in NAMES]


@pytest.mark.parametrize(
    "shares, sign",
    [
        ((0.9, 0.9, "missing", "missing"), "nothing in the last 2 exercises"),
        (("missing", 0.9, "no notebook", 0.9), "2 of 4 exercises missing"),
        (("missing", "missing", "missing", "no notebook"), "handed in none of 4 exercises"),
        ((0.9, 0.9, 0.3, 0.2), "lowest quarter, twice in a row"),
        (
            (0.95, 0.95, 0.6, 0.6),
            "falling: 30% of the points above the class's median, in the last two exercises 5% of the points below",
        ),
    ],
)
def test_who_is_falling_behind_is_told_why(shares, sign):
    assert any(sign in said for said in falling_behind(student(*shares), exercises()))


@pytest.mark.parametrize(
    "shares",
    [
        ("missing",),
        (0.1, "exempt", "open", "not graded"),
        (0.9, "missing", 0.9, 0.9),
        (0.9, 0.9, 0.2, 0.9),
        (0.55, 0.55, 0.55, 0.55),
        (0.9, 0.9, "open", "exempt"),
    ],
)
def test_one_bad_day_is_no_sign(shares):
    assert falling_behind(student(*shares), exercises()) == ()


def test_a_hard_exercise_is_not_the_students_fault():
    hard = [of_class(name, [work(name, share) for share in (CLASS if name in "ab" else [0.2] * 8)]) for name in NAMES]
    assert falling_behind(student(0.6, 0.6, 0.2, 0.2), hard) == ()


def test_late_and_missing_are_counted_and_who_has_time_left_is_neither():
    works = [
        Work("a", "graded", 5, 10, late="late by 1 day"),
        work("a", "missing"),
        work("a", "open"),
        work("a", "exempt"),
    ]
    found = of_class("a", works)
    assert (found.shares, found.missing, found.late) == ((0.5,), 1, 1)


@pytest.mark.parametrize("note", ["right", "right_from_earlier", "not_attempted", "unnoted", "error"])
def test_what_is_no_wrong_answer_holds_no_mistake(note):
    answer = Answer("scara.T04", 0, 1, note)
    assert not answer.is_wrong and answer.mistakes == ()


def test_a_mistake_stays_that_comes_back_in_another_exercise_whatever_stands_beside_it():
    def wrong(name, *notes):
        answers = tuple(Answer(f"{name}.q{i}", 0, 1, note) for i, note in enumerate(notes))
        return Work(name, "graded", 0, 10, answers)

    ann = Student(
        "ann", "Ann", (wrong("a", "degrees", "degrees"), wrong("b", "right"), wrong("c", "sign_of_d+degrees"))
    )
    ben = Student(
        "ben", "Ben", (wrong("a", "degrees", "nothing_matched"), wrong("b", "nothing_matched", "not_attempted"))
    )
    (found,) = staying([ann, ben], "abc")
    assert (found.note, found.counts, found.again) == ("degrees", (2, 0, 1), 1)
    assert ann.stays == {"degrees": ("a", "c")}
    assert ben.stays == {}
