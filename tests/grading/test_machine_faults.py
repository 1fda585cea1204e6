"""A fault of the machine, or of a neighbour, is told as such and takes nobody's points; a student's own is his own."""

import json
import os
import shutil
import sys
import sysconfig
import threading
from concurrent.futures import ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from functools import partial
from pathlib import Path

import pytest
from nbformat.v4 import new_notebook

from autograder import cli, sandbox
from autograder.grading import pipeline
from autograder.grading.plugins.preprocessors import SandboxExecute
from autograder.grading.submission import trial
from autograder.grading.submission.execution import Execution, InDoubt, MachineFault, confirm
from autograder.sandbox import bubblewrap, clock, watch
from autograder.sandbox.clock import Observation

pytestmark = pytest.mark.sandbox


def execution(**what):
    return Execution("f", {}, {}, **what)


def no_fault(lasting):
    raise AssertionError("there is no reason to look for a fault")


def test_the_second_run_counts():
    second = execution()
    assert confirm(lambda: second, no_fault) is second


def test_what_fails_twice_while_a_trial_succeeds_is_the_students():
    second, asked = execution(doubt="the kernel ended", lived=7.0), []
    assert confirm(lambda: second, asked.append) is second and asked == [7.0]


def test_what_fails_twice_as_a_trial_does_is_the_machines():
    with pytest.raises(MachineFault, match="^no sandbox; then grade again$"):
        confirm(lambda: execution(doubt="the kernel ended"), lambda lasting: "no sandbox")


def test_who_hardly_got_to_run_is_not_judged():
    starved = execution(doubt="stopped", starved=True, message="notebook stopped: the machine gave it 1 s")
    with pytest.raises(MachineFault, match="gave it 1 s; grade again when the machine is less busy"):
        confirm(lambda: starved, no_fault)


def test_a_kernel_that_does_not_start_twice_is_the_machines():
    def again():
        raise sandbox.KernelStartError("the kernel did not start: it did not answer")

    with pytest.raises(MachineFault, match="not even alone .*did not answer"):
        confirm(again, no_fault)


def test_submissions_in_doubt_are_done_again_after_the_others_and_alone():
    lock, inside, seen = threading.Lock(), set(), []
    both = threading.Barrier(2)

    def judge(student, turn):
        with lock:
            inside.add(student)
            seen.append((turn, student, len(inside)))
        if turn == "first" and student in ("a", "b"):
            both.wait(timeout=60)  # they do run side by side
        with lock:
            inside.remove(student)
        if turn == "first" and student in ("a", "b"):
            raise {"a": InDoubt("stopped after 30 s"), "b": BrokenProcessPool("killed")}[student]
        return f"{student}, {turn}"

    with ThreadPoolExecutor(2) as threads:
        submit = partial(threads.submit, judge)
        order = [(student, done.result()) for student, done in pipeline._judged(submit, "abcd", jobs=2)]
    assert sorted(order[:2]) == [("c", "c, first"), ("d", "d, first")]
    assert sorted(order[2:]) == [("a", "a, alone"), ("b", "b, alone")]
    assert [entry[::2] for entry in seen if entry[0] == "alone"] == [("alone", 1)] * 2
    assert seen.index(next(entry for entry in seen if entry[0] == "alone")) == 4


@pytest.mark.parametrize("how", ["fails", "in doubt"])
def test_a_first_run_that_fails_or_ends_in_doubt_does_not_count(how, monkeypatch):
    def run(self, *whose):
        if how == "fails":
            raise OSError(28, "No space left on device")
        return execution(doubt="stopped after 30 s")

    monkeypatch.setattr(SandboxExecute, "run", run)
    resources = {
        "autograder": {"turn": "first", "folder": "a", "released": "b", "root": "c"},
        "nbgrader": {"student": "d"},
    }
    with pytest.raises(InDoubt, match="No space left|stopped after 30 s"):
        SandboxExecute().preprocess(new_notebook(), resources)


@pytest.fixture
def graded(needs_sandbox, course_copy, capsys, monkeypatch):
    """graded(*words) -> (exit code, results by student, what was said) of grading in an environment of one's own."""
    monkeypatch.setattr(trial, "_went_well", set())

    def grade(*words, jobs=2):
        code = cli.main(["grade", "scara", "--json", "--jobs", str(jobs), "--course", str(course_copy), *words])
        said = capsys.readouterr()
        results = [json.loads(line) for line in said.out.splitlines()]
        return code, {result["student"]: result for result in results}, said.err

    return grade


def without(monkeypatch, package):
    """Take a package out of every sandbox to come."""
    found = bubblewrap.mounts
    place = os.path.join(sysconfig.get_path("purelib"), package)

    def mounts(*arguments):
        return [*found(*arguments), "--perms", "0755", "--tmpfs", place]

    assert os.path.isdir(place)
    monkeypatch.setattr(bubblewrap, "mounts", mounts)


def test_an_environment_that_lacks_a_library_is_refused_by_its_name(graded, small, course_copy, released, monkeypatch):
    small.hand_in(course_copy, "ann", small.answered(released))
    with monkeypatch.context() as patch:
        without(patch, "sympy")
        code, results, said = graded()
    assert (code, results) == (2, {})
    assert "cannot do in the sandbox: import " in said and "sympy" in said and "make setup" in said
    assert not (course_copy / "autograded").exists()
    assert graded()[1]["ann"]["score"] == 20


BROKEN = 'raise RuntimeError("this library is broken")'


@pytest.mark.slow
@pytest.mark.parametrize("package", ["sympy", "numpy", "dhkit"])
@pytest.mark.parametrize("what", ["missing", "broken"])
def test_whatever_cannot_be_imported_in_the_sandbox_is_refused_by_its_name(
    graded, small, course_copy, released, tmp_path, monkeypatch, package, what
):
    """The kit may be on PYTHONPATH only, a library installed for another processor, or half of it deleted."""
    small.hand_in(course_copy, "ann", small.answered(released, d2_sign="import numpy; d2_sign = 'B'"))
    (tmp_path / "__init__.py").write_text(BROKEN)
    place = bubblewrap.package_folder(package)
    hidden = ["--perms", "0755", "--tmpfs", place]
    shadow = hidden if what == "missing" else ["--ro-bind", str(tmp_path / "__init__.py"), f"{place}/__init__.py"]
    found = bubblewrap.mounts
    monkeypatch.setattr(bubblewrap, "mounts", lambda *arguments: [*found(*arguments), *shadow])
    monkeypatch.setattr(bubblewrap, "available", lambda: None)
    code, results, said = graded()
    assert (code, results) == (2, {})
    assert package in said and "sandbox" in said and "Traceback" not in said
    assert not (course_copy / "autograded").exists() and not (course_copy / "feedback").exists()


def test_a_library_that_goes_missing_on_the_way_costs_nobody_a_point(graded, small, course_copy, released, monkeypatch):
    for student in ("ann", "ben"):
        small.hand_in(course_copy, student, small.answered(released))
    with monkeypatch.context() as patch:
        patch.setattr(trial, "find_fault_once", lambda *settings: without(patch, "sympy"))
        code, results, _ = graded()
    assert code == 1 and {result["status"] for result in results.values()} == {"failed"}
    assert "cannot do in the sandbox: import " in results["ann"]["found"] and "grade again" in results["ann"]["found"]
    code, results, _ = graded()
    assert code == 0 and [results[student]["score"] for student in ("ann", "ben")] == [20, 20]


def replace_bwrap(tmp_path, monkeypatch, script):
    """Put a program of our own before bubblewrap."""
    program = tmp_path / "bin/bwrap"
    program.parent.mkdir()
    program.write_text(f"#!/bin/sh\n{script.format(bwrap=shutil.which('bwrap'), folder=tmp_path)}\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{program.parent}:{os.environ['PATH']}")


EVERY_SECOND = 'echo x >> {folder}/calls; [ $(($(wc -l < {folder}/calls) % 2)) = 0 ] && exit 1; exec {bwrap} "$@"'


def test_a_bubblewrap_that_fails_every_second_time_changes_no_score(
    graded, small, course_copy, released, tmp_path, monkeypatch
):
    students = {"ann": small.answered(released), "ben": small.answered(released, d2_sign="d2_sign = 'A'")}
    for student, nb in students.items():
        small.hand_in(course_copy, student, nb)
    replace_bwrap(tmp_path, monkeypatch, EVERY_SECOND)
    code, results, said = graded()
    right = {"ann": 20, "ben": 16}
    assert code in (0, 1, 2) and (results or "grade again" in said or "could not be run" in said)
    for student, result in results.items():
        assert result["score"] in (right[student], None), result
        assert result["status"] == "graded" or "grade again" in result["found"]


@pytest.mark.slow
def test_a_bubblewrap_that_dies_is_no_dead_kernel_of_a_student(
    graded, small, course_copy, released, tmp_path, monkeypatch
):
    slow = small.answered(released, d2_sign="import time; time.sleep(8); d2_sign = 'B'")
    small.hand_in(course_copy, "ann", slow)
    monkeypatch.setattr(trial, "find_fault_once", lambda *settings: None)  # as if it began on the way
    replace_bwrap(tmp_path, monkeypatch, 'timeout -s KILL 6 {bwrap} "$@"')
    code, results, _ = graded()
    assert code == 1 and results["ann"]["status"] == "failed" and "grade again" in results["ann"]["found"]


@pytest.mark.slow
def test_a_student_cannot_turn_his_zero_into_a_fault_of_the_machine(graded, small, course_copy, released):
    endings = {
        "exits": "import os; os._exit(3)",
        "killed": "import os, signal; os.kill(os.getpid(), signal.SIGKILL)",
        "pretends": "raise ModuleNotFoundError(\"No module named 'sympy'\")",
        "stops": "import os, signal; os.kill(os.getpid(), signal.SIGSTOP)",
    }
    for student, source in endings.items():
        small.hand_in(course_copy, student, small.answered(released, T04=source))
    code, results, _ = graded("--cell-seconds", "4")
    assert code == 0
    notes = {student: result["answers"][0]["note"] for student, result in results.items()}
    assert notes == {"exits": "died", "killed": "died", "pretends": "error", "stops": "timeout"}
    assert {result["score"] for result in results.values()} == {10}


def test_a_machine_without_proc_is_refused_in_words(needs_sandbox, monkeypatch):
    exists = os.path.exists
    monkeypatch.setattr(bubblewrap.os.path, "exists", lambda path: path != "/proc/self/uid_map" and exists(path))
    bubblewrap.available.cache_clear()
    try:
        assert "/proc is not mounted" in sandbox.available()
    finally:
        bubblewrap.available.cache_clear()


def test_a_trial_imports_what_the_notebooks_import_and_hands_in_an_answer(small, released):
    released.cells[1].source += "\n%matplotlib inline"
    nb = trial.trial_notebook([small.solution(), released], lasting=2.2)
    sources = [cell.source for cell in nb.cells]
    assert sources[0] == "import time\ntime.sleep(3)"
    assert "from sympy import Matrix, cos, sin, symbols" in sources and sources.count("import sympy") == 1
    assert sources[-1].endswith("check('scara.T04', [0.5])")


def test_every_released_notebook_passes_its_trial(needs_sandbox, small):
    paths = sorted(Path(small.REPOSITORY, "exercises").glob("*/*.ipynb"))
    assert len(paths) > 5 and trial.find_fault(paths, sandbox.Limits(), "bwrap", (small.REPOSITORY,)) is None


def test_a_kit_that_hands_in_nothing_is_found_out(needs_sandbox, small, released, tmp_path, monkeypatch):
    path = tmp_path / "scara.ipynb"
    path.write_text(json.dumps(small.solution()))
    monkeypatch.setattr(trial, "last_packet", lambda outputs: None)
    assert "dhkit handed in nothing" in trial.find_fault([path], sandbox.Limits(), "bwrap")
    monkeypatch.setattr(sys, "executable", "/bin/false")
    assert "could not be run: the kernel did not start" in trial.find_fault([path], sandbox.Limits(), "none")


SHELLS = 'import subprocess, time\nP = [subprocess.Popen(["/bin/sh", "-c", "while :; do :; done"], start_new_session=True) for _ in range(30)]'


@pytest.mark.slow
def test_busy_shells_cost_an_honest_neighbour_nothing(graded, small, course_copy, released):
    work = "import time\nend = time.process_time() + 1.5\nwhile time.process_time() < end: pass\n"
    honest = small.answered(released, d2_sign=f"{work}d2_sign = 'B'", T04=work + small.T04)
    hostile = small.answered(released, T04=SHELLS, d2_sign="time.sleep(10**6)", forward="time.sleep(10**6)")
    small.hand_in(course_copy, "ann", honest)
    small.hand_in(course_copy, "eve", hostile)
    code, results, _ = graded("--cell-seconds", "4", "--notebook-seconds", "12", jobs=2)
    assert code == 0 and results["ann"]["score"] == 20
    assert results["eve"]["score"] == 0


class Processor:
    """Taken away once the trial is over: no time that goes by is a notebook's own, and there is little on the wall."""

    def __init__(self, patch):
        self.patch = patch
        find_fault_once = trial.find_fault_once

        def then_take(*settings):
            fault = find_fault_once(*settings)
            self.take()
            return fault

        patch.setattr(trial, "find_fault_once", then_take)

    def take(self):
        self.patch.setattr(watch, "observe", lambda members, outer: Observation(0.0, True))
        self.patch.setattr(clock, "LOAD_FACTOR", 0.2)

    def give_back(self):
        self.patch.undo()


@pytest.fixture
def processor():
    with pytest.MonkeyPatch.context() as patch:
        yield Processor(patch)


@pytest.fixture
def honest(small, course_copy, released):
    """Scores of two honest notebooks that need a few seconds."""
    for student, d2_sign in (("ann", "B"), ("ben", "A")):
        source = f"import time; time.sleep(4); d2_sign = {d2_sign!r}"
        small.hand_in(course_copy, student, small.answered(released, d2_sign=source))
    return {"ann": 20, "ben": 16}


def scores(results):
    return {student: result["score"] for student, result in results.items()}


@pytest.mark.slow
def test_whose_processor_is_taken_away_runs_again_alone(graded, honest, processor, monkeypatch):
    run, run_alone, runs = SandboxExecute.run, SandboxExecute.run_alone, []

    def noted(self, nb, folder, released, student, course, **how):
        execution = run(self, nb, folder, released, student, course, **how)
        runs.append((student, execution.starved))
        return execution

    def given_back(self, *whose):
        processor.give_back()
        return run_alone(self, *whose)

    monkeypatch.setattr(SandboxExecute, "run", noted)
    monkeypatch.setattr(SandboxExecute, "run_alone", given_back)
    code, results, _ = graded("--notebook-seconds", "20")
    assert code == 0 and scores(results) == honest
    assert sorted(runs[:2]) == [("ann", True), ("ben", True)] and sorted(runs[2:]) == [("ann", False), ("ben", False)]


@pytest.mark.slow
def test_who_has_no_processor_when_alone_either_is_not_graded(graded, honest, processor, course_copy):
    code, results, _ = graded("--notebook-seconds", "20")
    assert code == 1 and scores(results) == dict.fromkeys(honest)
    assert {result["status"] for result in results.values()} == {"failed"}
    assert all("grade again when the machine is less busy" in result["found"] for result in results.values())
    assert not (course_copy / "autograded").exists()
    processor.give_back()
    code, results, _ = graded("--notebook-seconds", "20")
    assert code == 0 and scores(results) == honest
