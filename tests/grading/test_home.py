"""``autograder release`` and the verdicts that go home with an exercise."""

from functools import partial

import pytest

from autograder import cli
from autograder.grading import release
from autograder.sealing import seal_exercise
from dhkit.home.envelopes import SUFFIX, read

pytestmark = pytest.mark.slow


@pytest.fixture(autouse=True)
def cheap(monkeypatch):
    monkeypatch.setattr(release, "seal_exercise", partial(seal_exercise, cost=2, sets=2))


def released(course, *words):
    assert cli.main(["release", "scara", "--course", str(course), *words]) == 0
    return course / "exercises" / "scara" / f"scara{SUFFIX}"


def test_verdicts_are_sealed_with_points_and_solutions(course_copy):
    sealed = read(released(course_copy))
    assert sealed.exercise == "scara"
    assert sealed.of("scara.T04").points == 10 and not sealed.of("scara.T04").why_not
    assert sealed.of("scara.d2_sign").why_not == "its answer could be found by trying"


def test_the_same_release_is_the_same_to_the_byte_and_a_new_one_shares_nothing(course_copy):
    file = released(course_copy)
    first, salt = file.read_bytes(), read(file).salt
    assert released(course_copy).read_bytes() == first
    anew = read(released(course_copy, "--anew"))
    assert anew.salt != salt and not set(anew.of("scara.T04").texts) & set(read(file).of("scara.T0E").texts)
    assert file.read_bytes() != first


def test_the_lecturer_may_leave_it_at_the_form(course_copy):
    assert released(course_copy).exists()
    assert not released(course_copy, "--home", "form").exists()


def test_the_table_shows_the_arithmetic(course_copy, capsys):
    released(course_copy, "--table")
    lines = capsys.readouterr().out.splitlines()
    line = next(line for line in lines if "scara.T04" in line)
    assert "2^" in line and "sealed" in line
    assert any("scara.d2_sign" in line and "could be found by trying" in line for line in lines)
