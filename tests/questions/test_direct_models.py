"""What the trees of the direct models rest on: marks of wrong cells, and every arm and data sheet that an id can pick."""

import json
from pathlib import Path

import numpy as np
import pytest
import sympy
from answers import evidence

from autograder.judge import judge
from autograder.questions import direct_models, find
from autograder.questions.shared import sheets
from autograder.questions.shared.pool import arms
from autograder.reference import errata, robots
from dhkit import public
from dhkit.sheets import ARMS, READINGS, SHEETS, sheet_of
from dhkit.variants import SETS, OwnNumbers, member, numbers_of_set

NOTEBOOK = Path(__file__).parents[2] / "solutions/direct_models/direct_models.ipynb"
SOMEWHERE = {"t4": 0.3, "t5": 0.7, "t6": 1.1, "d3": 0.4, "a3": 0.5}


def printed():
    """The three matrices as the notebook shows them."""
    cells = json.loads(NOTEBOOK.read_text())["cells"]
    source = "".join(next(cell["source"] for cell in cells if cell["id"] == "printed"))
    names = {"Matrix": sympy.Matrix, "cos": sympy.cos, "sin": sympy.sin, "d3": sympy.Symbol("d3")}
    names |= {f"t{i}": sympy.Symbol(f"t{i}") for i in range(1, 7)}
    exec(source.partition("show_marks")[0], names)
    return list(names["printed"].values())


def test_marked_cells_are_those_that_differ_from_the_table():
    *_, U3, U4, U5, _ = robots.RX90.table.recursion()
    for matrix, right, marks in zip(
        printed(), (U5, U4, U3), (direct_models.WRONG_T56, direct_models.WRONG_U4, direct_models.WRONG_U3)
    ):
        gap = np.array((matrix - right).subs(SOMEWHERE), dtype=float)
        assert (np.abs(gap) > 1e-9).astype(int).tolist() == marks


def test_the_notebook_prints_what_the_errata_say_is_printed():
    T56, U4, U3 = printed()
    assert errata.find("000-rx90-T56").check.readings[0].form == T56
    assert errata.find("000-rx90-U4").check.readings[0].form == U4[2, 0]
    assert errata.find("000-rx90-U3").check.readings[0].form == (U3[0, 0], U3[0, 1], U3[2, 0], U3[2, 1])


OF_ARM = ("K", "end_point", "table")
OF_SHEET = ("reading", "U2", "T06", "forward")
RANGES = public.variant_ranges("direct_models")


def members(*names):
    """Ids that between them have every value of these variants."""
    found = {}
    for which in range(SETS):
        numbers = numbers_of_set("direct_models", which)
        for name in names:
            found.setdefault((name, numbers[name]), member("direct_models", which))
    return sorted(set(found.values()))


def test_the_pool_of_the_exercise_is_what_the_kit_has():
    assert set(RANGES["arm"]) <= set(arms()) and RANGES["robot"] == ARMS and RANGES["sheet"] == SHEETS
    assert set(ARMS) <= set(arms())
    assert len(arms()) >= 24


@pytest.mark.parametrize(
    ("name", "student"),
    [(name, student) for name in OF_ARM for student in members("arm")]
    + [(name, student) for name in OF_SHEET for student in members("robot")],
)
def test_every_arm_has_its_right_answer_and_its_mistakes(name, student):
    question = find(f"direct_models.{name}")
    right = judge(question, evidence(question, question.answer(student), student), student)
    assert (right.note, right.share) == ("right", 1.0)
    for node in question.mistakes:
        for way in node.ways:
            found = judge(question, evidence(question, question.answer(student, way), student), student)
            # An axis against frame 0 that the end effector lies on turns nothing of it, whichever way it turns.
            assert found.note in (
                node.note,
                "right" if (name, node.note) == ("end_point", "senses_overlooked") else None,
            )


def test_the_kit_has_the_sheets_that_the_pool_makes():
    assert sheets.KIT_FILE.read_text(encoding="utf-8") == sheets.for_the_kit(), "-m autograder.questions.shared.sheets"


@pytest.mark.parametrize("name", ARMS)
def test_only_one_reading_of_a_sheet_leads_to_the_point_of_its_example(name):
    for sheet_name in SHEETS:
        sheet = sheet_of(OwnNumbers(robot=name, sheet=sheet_name))
        at = {**sheet.lengths, **dict(zip(sheet.joints, sheet.q))}
        far = {}
        for letter in READINGS:
            pose = np.eye(4)
            for row in sheet.rows:
                pose = pose @ np.array(sheets.read(row, letter).subs(at), dtype=float)
            far[letter] = np.linalg.norm(pose[:3, 3] - sheet.point)
        assert far.pop(sheets.reading_of(name, sheet_name)) < 1e-3
        assert min(far.values()) > 0.05
        said = sheet._repr_markdown_()
        assert sheet.title in said and said.count("\n| ") == 7
