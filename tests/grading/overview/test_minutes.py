"""How long questions took, from the times that JupyterLab and Colab write into cells."""

from datetime import datetime, timedelta

import pytest

from autograder.grading.overview.minutes import spent, summary

START = datetime.fromisoformat("2026-10-12T09:00:00+00:00")
CHECKS = ["scara-table", "scara-T04", "scara-model"]


def lab(minutes, check=None):
    said = (START + timedelta(minutes=minutes)).isoformat().replace("+00:00", "Z")
    return {"execution": {"shell.execute_reply": said}} | ({"nbgrader": {"grade_id": check}} if check else {})


def colab(minutes, check=None):
    said = int((START + timedelta(minutes=minutes)).timestamp() * 1000)
    return {"executionInfo": {"timestamp": said}} | ({"nbgrader": {"grade_id": check}} if check else {})


@pytest.mark.parametrize("ran", [lab, colab])
def test_what_passed_between_two_checks_is_the_later_questions_time(ran):
    cells = [ran(0), ran(8), ran(10, CHECKS[0]), ran(12), ran(15, CHECKS[1]), ran(40, CHECKS[2])]
    assert spent(cells, CHECKS) == pytest.approx({CHECKS[0]: 10, CHECKS[1]: 5, CHECKS[2]: 25})


def test_a_second_run_of_everything_a_break_and_a_gap_tell_nothing():
    assert spent([lab(0), lab(0.1, CHECKS[0]), lab(0.2, CHECKS[1])], CHECKS) == {}
    assert spent([lab(0), lab(300, CHECKS[0]), lab(310, CHECKS[2])], CHECKS) == {}
    assert spent([lab(9), lab(5, CHECKS[0])], CHECKS) == {}


@pytest.mark.parametrize(
    "metadata",
    [
        {"execution": {"shell.execute_reply": "yesterday"}},
        {"execution": {"shell.execute_reply": 5}},
        {"execution": [1]},
        {"executionInfo": {"timestamp": 10**40}},
        {"executionInfo": {"timestamp": "now"}},
        {"executionInfo": "x", "nbgrader": 3},
    ],
)
def test_what_is_no_time_tells_nothing(metadata):
    marks = {"nbgrader": {"grade_id": CHECKS[0]}}
    assert spent([metadata, metadata | marks, lab(5, CHECKS[1])], CHECKS) == {}


def test_the_median_is_set_against_the_minutes_where_enough_notebooks_tell():
    measured = [{"q.a": minutes, "q.b": 9} for minutes in (2, 20, 21, 22, 60)] + [{"q.c": 4}]
    found = summary({"q.a": 10, "q.b": 10, "q.c": 20, "q.d": 5}, measured)
    assert [(one.question, one.median, one.count, one.off) for one in found] == [
        ("q.a", 21, 5, "takes longer"), ("q.b", 9, 5, ""), ("q.c", 4, 1, ""),
    ]  # fmt: skip
