"""What a question is worth is changed by a command, and nobody's answers go without being asked for."""

import io
import json

import nbformat
import pytest

from autograder import cli

pytestmark = pytest.mark.slow


def run(root, *words):
    return cli.main([*words, "--course", str(root)])


@pytest.fixture
def graded(without_kernels, small, course_copy, released, capsys):
    """ann has 4 points, for the choice; ben none."""
    for student, choice in (("ann", "B"), ("ben", "A")):
        small.hand_in(course_copy, student, small.answered(released, T04="T04 = ...", d2_sign=f"d2_sign = {choice!r}", forward="forward = ..."))  # fmt: skip
    assert scores(course_copy, without_kernels, capsys) == {"ann": (4, 20), "ben": (0, 20)}
    return course_copy


def scores(root, without_kernels, capsys):
    capsys.readouterr()
    with without_kernels():
        assert run(root, "grade", "scara", "--json") == 0
    lines = map(json.loads, capsys.readouterr().out.splitlines())
    return {line["student"]: (line["score"], line["max_score"]) for line in lines}


def released_anew(root):
    return run(root, "release", "scara", "--home", "form")


def test_other_points_and_none(graded, small, without_kernels, capsys):
    path = graded / "solutions/scara/scara.ipynb"
    nb = nbformat.read(path, as_version=4)
    place = nb.cells.index(small.cell(nb, "scara-d2_sign-answer"))
    nb.cells.insert(
        place, nbformat.v4.new_markdown_cell("## The sign (4 points)\n\nWhich? (2 points are not these)", id="t")
    )
    nbformat.write(nb, path)
    for points, title, expected in (
        ("1", "(1 point)", (1, 17)),
        ("2.5", "(2.5 points)", (2.5, 18.5)),
        ("0", "(0 points)", (0, 16)),
    ):
        assert run(graded, "points", "scara.d2_sign", points) == 0 and released_anew(graded) == 0
        assert (
            nbformat.read(path, as_version=4).cells[place].source.startswith(f"## The sign {title}\n\nWhich? (2 points")
        )
        assert scores(graded, without_kernels, capsys)["ann"] == expected


def test_full_points_for_everybody_and_back(graded, without_kernels, capsys):
    before = (graded / "solutions/scara/scara.ipynb").read_text()
    assert run(graded, "points", "scara.d2_sign", "--everybody") == 0
    assert "4 points, for everybody who hands in" in capsys.readouterr().out
    assert released_anew(graded) == 0
    assert scores(graded, without_kernels, capsys) == {"ann": (4, 20), "ben": (4, 20)}
    page = (graded / "feedback/ben/scara/scara.html").read_text()
    assert "counts fully for everybody" in page and "nothing_matched" in page
    with without_kernels():
        assert run(graded, "explain", "ben", "scara.d2_sign") == 0
    said = capsys.readouterr().out
    assert "ben: 4 of 4 points, nothing_matched" in said and "counts fully for all who handed in" in said
    assert run(graded, "points", "scara.d2_sign", "--judged") == 0 and released_anew(graded) == 0
    assert scores(graded, without_kernels, capsys) == {"ann": (4, 20), "ben": (0, 20)}
    assert json.loads((graded / "solutions/scara/scara.ipynb").read_text()) == json.loads(before)


def test_nobody_gets_full_points_by_saying_so(graded, small, released, without_kernels, capsys):
    nb = small.answered(released, T04="T04 = ...", d2_sign="d2_sign = 'A'", forward="forward = ...")
    for cell in nb.cells:
        cell.metadata["full_points_for_everybody"] = True
    small.hand_in(graded, "ben", nb)
    assert scores(graded, without_kernels, capsys)["ben"] == (0, 20)


@pytest.mark.parametrize(
    "words, said",
    [
        (("scara.T05", "3"), "there is no question 'scara.T05'; there are: scara.T04, scara.d2_sign, scara.forward"),
        (("sacra.T04", "3"), "there is no exercise 'sacra'"),
    ],
)
def test_a_question_that_is_not_there(course_copy, words, said, capsys):
    assert run(course_copy, "points", *words) == 2
    assert said in capsys.readouterr().err


def without_forward(root):
    path = root / "solutions/scara/scara.ipynb"
    nb = nbformat.read(path, as_version=4)
    nb.cells = [cell for cell in nb.cells if not cell.id.startswith("scara-forward")]
    nbformat.write(nb, path)


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize("typed, goes", [("y\n", True), ("n\n", False), ("\n", False)])
def test_a_release_that_takes_answers_away_asks_first(graded, typed, goes, monkeypatch, capsys):
    without_forward(graded)
    before = (graded / "exercises/scara/scara.ipynb").read_bytes()
    monkeypatch.setattr("sys.stdin", Terminal(typed))
    assert released_anew(graded) == 0
    said = capsys.readouterr()
    assert (
        "2 submissions of scara are there.\nNo longer asked: scara-forward; their points and comments go." in said.err
    )
    assert ((graded / "exercises/scara/scara.ipynb").read_bytes() != before) == goes
    assert ("was not released" in said.out) == (not goes)


def test_without_a_terminal_it_is_refused_unless_one_says_yes(graded, monkeypatch, capsys):
    without_forward(graded)
    monkeypatch.setattr("sys.stdin", io.StringIO(""))
    assert released_anew(graded) == 2 and "say --yes" in capsys.readouterr().err
    assert run(graded, "release", "scara", "--home", "form", "--yes") == 0


def test_a_release_that_takes_nothing_away_does_not_ask(graded, monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO(""))
    assert released_anew(graded) == 0
