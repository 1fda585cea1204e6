"""What a student sees at home: check, solution, progress and practice on an exercise with sealed verdicts.

That verdicts agree with the judge's, and give nothing away, is tried in `test_sealed`.
"""

import numpy as np
import pytest
from sympy import Matrix, cos, eye, sin, symbols

from autograder.questions import find, of_exercise
from autograder.sealing import seal_exercise
from dhkit import check, practice, progress, solution, variants
from dhkit.home import envelopes, verdict
from dhkit.home import progress as progress_of
from dhkit.home.envelopes import SUFFIX, encoded
from dhkit.variants import variant

pytestmark = pytest.mark.slow

t1, t2, t4, a2, a3, d2 = symbols("t1 t2 t4 a2 a3 d2")
MODEL = find("scara.model").answer("ada")
MISTAKEN = find("scara.model").answer("ada", find("scara.model").mistakes[0].ways[0])
SCARA = [a2 * cos(t1) + a3 * cos(t1 + t2), a2 * sin(t1) + a3 * sin(t1 + t2), -d2]
POINTS = {"scara.model": 2.0, "scara.T04": 3.0, "scara.d2_sign": 1.0, "scara.postures": 3.0}


@pytest.fixture(scope="module")
def sealed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("home")
    made, _ = seal_exercise(
        "scara", of_exercise("scara"), b"salt", {"scara.model": "```python\nworked\n```"}, POINTS, cost=2
    )
    (folder / f"scara{SUFFIX}").write_bytes(encoded(made))
    return folder


@pytest.fixture(autouse=True)
def student(sealed, monkeypatch):
    """A session in the folder of the exercise, with nothing checked yet."""
    import sys

    monkeypatch.chdir(sealed)
    monkeypatch.setattr(variants, "_typed", {"scara": "ada"})
    monkeypatch.setattr(sys.modules["dhkit.home.progress"], "_latest", {})
    monkeypatch.setattr(sys.modules["dhkit.home.practice"], "_rounds", {})
    monkeypatch.setattr(sys.modules["dhkit.home.practice"], "_streaks", {})


def said(capsys, id, answer):
    check(id, answer)
    return capsys.readouterr().out


def test_a_right_answer_is_said_to_be_right_and_unfolds_its_solution(capsys):
    assert said(capsys, "scara.model", MODEL).splitlines() == [
        "Where the end effector is: right",
        '  ✓ how it goes: solution("scara.model")',
    ]
    solution("scara.model")
    assert "Markdown" in capsys.readouterr().out


def test_a_mistake_is_named_at_once(capsys):
    out = said(capsys, "scara.model", MISTAKEN)
    assert out.splitlines()[0] == "Where the end effector is: not right yet"
    feedback = next(node.feedback for node in find("scara.model").mistakes if node.note == "seen_from_frame_1")
    assert feedback in out
    solution("scara.model")
    assert "it unfolds when your answer is right" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("answer", "state"),
    [
        (..., "blank"),
        ([..., 1, 2], "partly"),
        ("nothing", "form"),
        ([1, 2, 3], "not_right"),
        (MODEL, "right"),
        (MISTAKEN, "mistake"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_every_state_has_its_words(capsys, answer, state):
    assert verdict("scara.model", answer).state == state
    out = said(capsys, "scara.model", answer)
    assert ("✓" in out) == (state == "right")
    assert out.splitlines()[0].partition(": ")[2]


def test_no_tick_for_what_is_not_known(capsys):
    """A green mark that a student reads as "right" is one that lies."""
    out = said(capsys, "scara.d2_sign", "B")
    assert "whether it is right is decided by the grader" in out and "✓ the form" not in out


def test_a_right_block_of_a_wrong_transform_is_said():
    T = eye(4)
    T[:3, 3] = Matrix(SCARA)
    found = verdict("scara.T04", T)
    assert (found.state, found.text) == ("partly", "right already: position")
    c, s = cos(t1 + t2 + t4), sin(t1 + t2 + t4)
    T[:2, :2] = Matrix([[c, -s], [s, c]])
    assert verdict("scara.T04", T).state == "right"


def test_solutions_that_are_right_are_counted(capsys):
    variant("scara", "ada")
    rows = np.array(find("scara.postures").answer("ada"), float)
    wrong = rows.copy()
    wrong[0, 0] += 0.3
    found = verdict("scara.postures", wrong)
    assert found.state == "partly" and f"{len(rows) - 1} of your {len(rows)} solutions" in found.text


def test_what_a_student_function_does_wrong_is_told_with_its_arguments(capsys):
    def forward(*args):
        raise ZeroDivisionError("division by zero")

    out = said(capsys, "scara.forward", forward)
    assert "for the arguments" in out and "ZeroDivisionError" in out and "not right yet" in out.splitlines()[0]


def test_progress_counts_what_is_sure_and_what_the_grader_decides():
    check("scara.model", MODEL)
    check("scara.d2_sign", "B")
    check("scara.T04", eye(4))
    found = progress()
    assert (found.sure, found.with_grader, found.points) == (2.0, 1.0, sum(POINTS.values()))
    assert 0 < found.minutes_left < sum(row.minutes for row in found.rows)
    assert "2 of 9 points sure, 1 with the grader" in repr(found)
    assert "<table>" in found._repr_html_() and "handed in, the grader decides" in found._repr_html_()
    check("scara.model", [0, 0, 0])
    assert progress().sure == 0


def test_progress_of_nothing_names_the_exercises():
    with pytest.raises(KeyError, match="nothing was checked yet.*scara"):
        progress_of()
    with pytest.raises(KeyError, match="there is no exercise 'sacra'"):
        progress("sacra")


def test_practice_gives_other_numbers_and_counts_what_is_right_in_a_row(capsys):
    mine = variant("scara", "ada")
    seen = []
    for turn in range(1, 4):
        task = practice("scara.postures")
        assert dict(task.numbers) != dict(mine)
        seen.append(str(dict(task.numbers)))
        whose = task._student
        right = find("scara.postures").answer(whose)
        assert task.check(right).state == "right"
        out = capsys.readouterr().out
        assert ("in a row" in out) == (turn > 1)
    assert len(set(seen)) == 3
    assert practice("scara.postures").check([[0.0, 0.0, 0.0, 0.0]]).state == "not_right"
    task = practice("scara.postures")
    task.check(find("scara.postures").answer(task._student))
    assert "in a row" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("id", "said"), [("scara.T04", "the same for everybody"), ("scara.d2_sign", "nothing to practise with")]
)
def test_practice_says_why_there_is_none(id, said):
    with pytest.raises(ValueError, match=said):
        practice(id)


def test_without_the_file_the_grader_decides(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert envelopes.find("scara") is None
    assert "whether it is right is decided by the grader" in said(capsys, "scara.model", MODEL)


def test_the_file_is_found_from_the_folders_above(sealed, monkeypatch, tmp_path):
    folder = tmp_path / "exercises" / "scara"
    folder.mkdir(parents=True)
    (folder / f"scara{SUFFIX}").write_bytes((sealed / f"scara{SUFFIX}").read_bytes())
    for place in (folder, tmp_path, tmp_path / "exercises"):
        monkeypatch.chdir(place)
        assert envelopes.find("scara").exercise == "scara"
