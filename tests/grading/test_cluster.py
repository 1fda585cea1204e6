"""Notebooks run on the workers of a Dask scheduler: the results are those of one machine, whichever worker ends."""

import json
import os
import pickle
import signal

import pytest

from autograder import cli, questions
from autograder.grading import cluster
from autograder.grading.errors import CourseError
from autograder.grading.submission.elsewhere import pack, unpack
from autograder.grading.submission.execution import MachineFault, Work
from autograder.grading.submission.kept import KeptRun, written
from autograder.sandbox import CellRun, Limits, Run


@pytest.fixture
def work(small, released):
    return Work(small.answered(released), {"data.csv": b"1, 2", "caf\udce9": b"\xff"}, "ann", Limits(), "bwrap")


def reply(run, fault=""):
    return json.dumps({"run": run.decode(), "fault": fault}).encode()


def test_what_is_sent_is_json_and_says_what_is_run(work):
    sent = json.loads(pack(work, alone=False))
    assert json.loads(sent["notebook"]) == work.nb and sent["limits"]["cell_seconds"] == 30


def test_a_run_comes_back_as_it_was(work):
    text = {"output_type": "stream", "name": "stdout", "text": "1"}
    run = Run({1: CellRun("timeout", "stopped", [text], True)}, {2: [text]}, "said", True, 3.0)
    assert unpack(reply(written(work.key, KeptRun(run))), work) == KeptRun(run)


class Harmful:
    def __reduce__(self):
        return os._exit, (3,)


@pytest.mark.parametrize(
    "answer",
    [None, "text", b"", b"[]", b"{}\x00", b"[" * 100_000, pickle.dumps(Harmful()), b'{"run": 1}', b'{"more": ""}', b"x" * (129 << 20)],
    ids=["nothing", "text", "empty", "list", "rest", "deep", "pickle", "number", "unknown", "long"],
)  # fmt: skip
def test_anything_else_that_comes_back_is_refused(work, answer):
    with pytest.raises(MachineFault, match="no run of a notebook"):
        unpack(answer, work)


def test_a_fault_of_the_other_machine_is_told(work):
    with pytest.raises(MachineFault, match="where it ran: no bubblewrap"):
        unpack(reply(b"", "no bubblewrap"), work)


@pytest.mark.parametrize("run", [b"", b"{}", b"[" * 100_000])
def test_a_run_of_another_notebook_or_with_other_libraries_is_refused(work, run):
    with pytest.raises(CourseError, match="other libraries"):
        unpack(reply(run), work)
    with pytest.raises(CourseError, match="other libraries"):
        unpack(reply(written("another key", KeptRun(Run()))), work)
    with pytest.raises(CourseError, match="other libraries"):
        unpack(reply(written(work.key, KeptRun(Run(), {1: [[0.5]]}))), work)


def test_a_scheduler_that_is_not_there_is_told(course_copy, monkeypatch, capsys):
    monkeypatch.setattr(cluster, "_ANSWER_SECONDS", 0.5)
    (course_copy / "submitted/ann/scara").mkdir(parents=True)
    assert cli.main(["grade", "--scheduler", "tcp://127.0.0.1:9", "--course", str(course_copy)]) == 2
    assert "the scheduler tcp://127.0.0.1:9 does not answer" in capsys.readouterr().err


def run_unless_eve(parcel):
    """Stands in for `run_parcel`: a submission that ends whatever works on it."""
    from autograder.grading.submission.elsewhere import run_parcel

    if b'"student":"eve"' in parcel:
        os.kill(os.getpid(), signal.SIGKILL)
    return run_parcel(parcel)


@pytest.mark.slow
@pytest.mark.sandbox
def test_who_ends_two_workers_is_set_aside_and_all_others_are_graded(
    needs_sandbox, small, course_copy, released, monkeypatch, capsys
):
    from distributed import LocalCluster

    for student, answers in {"ann": {}, "ben": {"d2_sign": "d2_sign = 'A'"}, "eve": {}}.items():
        small.hand_in(course_copy, student, small.answered(released, **answers))
    # Workers know the questions of the course, not those of these tests.
    monkeypatch.setattr(questions, "find", {one.id: one for one in questions.of_exercise("scara")}.get)

    def graded(*words):
        code = cli.main(["grade", "scara", "--json", "--course", str(course_copy), *words])
        return code, {line["student"]: line for line in map(json.loads, capsys.readouterr().out.splitlines())}

    monkeypatch.setattr(run_unless_eve, "__module__", "__main__")  # sent as it is: workers cannot import this file
    monkeypatch.setattr(cluster, "run_parcel", run_unless_eve)
    with LocalCluster(n_workers=2, threads_per_worker=1, memory_limit=0, dashboard_address=None) as machines:
        code, found = graded("--scheduler", machines.scheduler_address)
    assert code == 1 and list(found) == ["ann", "ben", "eve"]
    assert "set aside: two workers ended" in found["eve"]["found"]
    assert found["ann"]["score"] == 20 and found["ben"]["score"] < 20
    code, here = graded("--force", "--jobs", "2")
    assert code == 0 and here["eve"]["score"] == 20
    assert all(here[student] == found[student] for student in ("ann", "ben"))
