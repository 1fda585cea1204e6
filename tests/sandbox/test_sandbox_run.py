"""One bad cell costs one question: order, replay, time, follow-ups, threads, interrupts."""

import asyncio
import concurrent.futures
import copy
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
from functools import partial

import nbformat
import pytest

from autograder import sandbox
from autograder.sandbox import client, provisioner, scratch

pytestmark = pytest.mark.sandbox

SHORT = sandbox.Limits(cell_seconds=1.5, notebook_seconds=60)


@pytest.fixture(params=["bwrap", "none"])
def either(request, run_cells):
    """run_cells in both modes."""
    if request.param == "bwrap":
        request.getfixturevalue("needs_sandbox")
    return lambda *sources, **options: run_cells(*sources, mode=request.param, **options)


def test_cells_share_a_kernel_and_an_exception_costs_one_cell(either, statuses, printed):
    run = either("x = 41", "1 / 0", "print(x + 1)", "", "import warnings; warnings.warn('noise'); x", "x = = 1")
    assert statuses(run) == ["ok", "error", "ok", "ok", "ok", "error"]
    assert run.cells[1].message == "ZeroDivisionError: division by zero"
    assert run.cells[5].message.startswith("SyntaxError")
    assert printed(run, 2) == "42"
    assert run.cells[4].outputs[-1].data["text/plain"] == "41"
    assert run.message is None


def test_the_given_notebook_is_not_changed_and_only_code_is_run(either, tmp_path):
    notebook = nbformat.v4.new_notebook(
        cells=[nbformat.v4.new_markdown_cell("1/0"), nbformat.v4.new_code_cell("7")],
        metadata={"kernelspec": {"name": "no-such-kernel", "display_name": "?"}},
    )
    before = copy.deepcopy(notebook)
    run = sandbox.run_notebook(notebook, mode="none")
    assert notebook == before
    assert list(run.cells) == [1] and run.cells[1].status == "ok"


def test_an_infinite_loop_is_interrupted_and_the_kernel_kept(either, statuses, printed):
    run = either("x = 5", "while True: pass", "print(x)", limits=SHORT)
    assert statuses(run) == ["ok", "timeout", "ok"]
    assert run.cells[1].message == "stopped after 1.5 s"
    assert printed(run, 2) == "5"


def test_a_loop_that_cannot_be_interrupted_costs_its_cell_only(either, statuses, printed):
    stubborn = """
import signal, time
signal.signal(signal.SIGINT, signal.SIG_IGN); signal.signal(signal.SIGTERM, signal.SIG_IGN)
while True:
    time.sleep(1)
"""
    run = either("x = 5", stubborn, "print(x)", "y = x + 1", limits=SHORT)
    assert statuses(run) == ["ok", "timeout", "ok", "ok"]
    assert printed(run, 2) == "5"


def test_an_interrupt_that_comes_late_does_not_hit_the_next_cell(sandboxed, statuses, printed):
    late = """
import time
kernel = get_ipython().kernel
send = kernel._send_interrupt_children
kernel._send_interrupt_children = lambda: (time.sleep(1), send())
time.sleep(2.5)
"""
    run = sandboxed("x = 3", late, "time.sleep(1); print(x)", limits=sandbox.Limits(cell_seconds=1))
    assert statuses(run) == ["ok", "timeout", "ok"]
    assert printed(run, 2) == "3"


@pytest.mark.parametrize(
    "end", ["import os; os._exit(1)", "exit()", "import os, signal; os.kill(os.getpid(), signal.SIGKILL)"]
)
def test_a_dead_kernel_is_replaced_and_the_cells_before_replayed(sandboxed, statuses, printed, end):
    run = sandboxed("x = [1]", "x.append(2); 1 / 0", end, "print(x)")
    assert statuses(run) == ["ok", "error", "died", "ok"]
    assert printed(run, 3) == "[1, 2]"
    assert run.cells[1].message == "ZeroDivisionError: division by zero"


def test_a_delayed_death_ends_the_run_in_bounded_time(sandboxed, statuses):
    fuse = "import os, threading; threading.Timer(0.4, os._exit, (1,)).start()"
    run = sandboxed("x = 3", fuse, *["import time; time.sleep(5)"] * 5)
    assert statuses(run) == ["ok", "ok", "died", "died", "died", "not_run", "not_run"]


def test_the_output_quota_outlives_a_restart(sandboxed, statuses):
    limits = sandbox.Limits(output_bytes=200_000)
    run = sandboxed(
        "print('a' * 90_000)", "import os; os._exit(1)", "print('b' * 90_000)", "print('c' * 90_000)", limits=limits
    )
    assert statuses(run) == ["ok", "died", "ok", "ok"]
    assert run.cells[2].outputs and not run.cells[3].outputs


def test_system_exit_costs_one_cell(either, statuses):
    assert statuses(either("x = 1", "raise SystemExit(3)", "x")) == ["ok", "error", "ok"]


def test_after_two_restarts_the_rest_is_not_run(sandboxed, statuses):
    run = sandboxed("x = 1", *["import os; os._exit(0)"] * 4, "x")
    assert statuses(run) == ["ok", "died", "died", "died", "not_run", "not_run"]
    assert "3 times" in run.message
    assert run.cells[5].message


def test_the_notebook_has_a_time_of_its_own(either, statuses):
    nap = "import time; time.sleep(0.9)"
    run = either(*[nap] * 9, limits=sandbox.Limits(cell_seconds=30, notebook_seconds=1.1))
    found = statuses(run)
    last = found.index("timeout")  # on a busy machine, time in which the kernel waits for a processor does not count
    assert found == ["ok"] * last + ["timeout"] + ["not_run"] * (8 - last)
    assert 2 <= last <= 7
    assert "2.2 s" in run.message and "2.2 s" in run.cells[last].message


def test_followup_code_runs_in_the_same_kernel_and_is_kept_apart(either, printed):
    seen = []

    def followup(index, cell, outputs):
        seen.append((index, cell.source, len(outputs)))
        return "print(f(20))" if index == 1 else None

    run = either("def f(x): return 2 * x", "print('own')", "print(f(1))", followup=followup)
    assert seen == [(0, "def f(x): return 2 * x", 0), (1, "print('own')", 1), (2, "print(f(1))", 1)]
    assert printed(run, 1) == "own"
    assert [output.text for output in run.followups[1]] == ["40\n"]
    assert set(run.followups) == {1}


def test_trouble_in_followup_code_is_told_of_its_cell(either, statuses, printed):
    run = either(
        "def f():\n    while True: pass",
        "1",
        "print('later')",
        limits=SHORT,
        followup=lambda index, cell, outputs: "f()" if index == 1 else None,
    )
    assert statuses(run) == ["ok", "timeout", "ok"]
    assert "grader's inputs" in run.cells[1].message
    assert printed(run, 2) == "later"


def test_input_does_not_wait(either, statuses):
    run = either(
        "input('name? ')",
        "get_ipython().kernel._allow_stdin = True\nimport getpass\nget_ipython().kernel.raw_input('name? ')",
        "1",
        limits=SHORT,
    )
    assert statuses(run)[0] == "error" and run.cells[0].message.startswith("StdinNotImplementedError")
    assert statuses(run)[1] in ("error", "timeout")
    assert statuses(run)[2] == "ok"


def test_work_folder_is_a_copy(either, tmp_path, printed):
    work = tmp_path / "own"
    (work / "data").mkdir(parents=True)
    (work / "data" / "lengths.csv").write_text("0.3,0.2")
    (tmp_path / "secret.txt").write_text("secret")
    (work / "link.txt").symlink_to(tmp_path / "secret.txt")
    (work / "folder").symlink_to(tmp_path)
    run = either(
        "print(open('data/lengths.csv').read())",
        "import os; print(sorted(os.listdir('.')))",
        "open('data/lengths.csv', 'w').write('x'); open('new.txt', 'w').write('x'); import os; os.mkdir('sub')",
        workdir=work,
    )
    assert printed(run, 0) == "0.3,0.2"
    assert printed(run, 1) == "['data']"
    assert run.cells[2].status == "ok"
    assert (work / "data" / "lengths.csv").read_text() == "0.3,0.2"
    assert not (work / "new.txt").exists()


def test_works_from_several_threads_and_inside_an_event_loop(sandboxed, printed):
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        runs = list(pool.map(lambda number: sandboxed(f"print({number})"), range(4)))
    assert [printed(run, 0) for run in runs] == ["0", "1", "2", "3"]

    async def from_a_server():
        return sandboxed("print('served')")

    assert printed(asyncio.run(from_a_server()), 0) == "served"


def test_cancel_runs_ends_the_runs_of_other_threads(sandboxed, alive):
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        future = pool.submit(sandboxed, "import subprocess; subprocess.run(['sleep', '71.4'])")
        while not alive("sleep 71.4"):
            assert not future.done()
            time.sleep(0.05)
        sandbox.cancel_runs()
        with pytest.raises(asyncio.CancelledError):
            future.result(timeout=30)
    assert not alive("sleep 71.4")


def test_an_interrupt_kills_the_kernel_and_cleans_up(needs_sandbox, tmp_path, alive):
    script = """
import nbformat, pathlib, sys
from autograder import sandbox
cell = nbformat.v4.new_code_cell("import subprocess; subprocess.run(['sleep', '72.4'])")
try:
    sandbox.run_notebook(nbformat.v4.new_notebook(cells=[cell]))
except KeyboardInterrupt:
    sys.exit(42)
"""
    (tmp_path / "work").mkdir()
    (tmp_path / "tmp").mkdir()
    process = subprocess.Popen(
        [sys.executable, "-c", script, str(tmp_path / "work")],
        env={**os.environ, "TMPDIR": str(tmp_path / "tmp")},
        # A job in the background is started with Ctrl-C ignored, and hands that on: here it must be heard.
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),
    )
    while not alive("sleep 72.4"):
        assert process.poll() is None
        time.sleep(0.05)
    assert list((tmp_path / "tmp").iterdir())
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=30) == 42
    assert not alive("sleep 72.4")
    assert not list((tmp_path / "tmp").iterdir())


def test_a_killed_grader_takes_its_kernels_along(needs_sandbox, tmp_path, alive):
    script = """
import nbformat, pathlib, sys
from autograder import sandbox
cell = nbformat.v4.new_code_cell("import subprocess; subprocess.run(['sleep', '73.4'])")
sandbox.run_notebook(nbformat.v4.new_notebook(cells=[cell]))
"""
    process = subprocess.Popen(
        [sys.executable, "-c", script, str(tmp_path)], env={**os.environ, "TMPDIR": str(tmp_path)}
    )
    while not alive("sleep 73.4"):
        assert process.poll() is None
        time.sleep(0.05)
    process.kill()
    process.wait()
    for _ in range(100):
        if not alive("sleep 73.4"):
            break
        time.sleep(0.1)
    assert not alive("sleep 73.4")


def test_nothing_is_left_open_or_lying_about(sandboxed, tmp_path, monkeypatch):
    folders = []
    original = provisioner.PrivateFolder

    def watched():
        private = original()
        folders.append(private.path)
        return private

    monkeypatch.setattr(provisioner, "PrivateFolder", watched)
    sandboxed("1")
    before = len(os.listdir("/proc/self/fd"))
    for _ in range(3):
        sandboxed("import os; os._exit(0)", "1")
    assert len(folders) >= 7
    assert not any(folder.exists() for folder in folders)
    assert len(os.listdir("/proc/self/fd")) <= before


def test_folders_of_killed_graders_are_removed_at_the_next_start(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    source = "from autograder.sandbox.scratch import PrivateFolder; import sys; print(PrivateFolder().path); sys.stdin.read()"
    graders = [
        subprocess.Popen(
            [sys.executable, "-c", source],
            env={**os.environ, "TMPDIR": str(tmp_path)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        for _ in range(2)
    ]
    left, kept = (pathlib.Path(grader.stdout.readline().strip()) for grader in graders)
    (left / "work").mkdir()
    (left / "work/answer.txt").touch()
    foreign = tmp_path / "ag-notes"
    foreign.mkdir()
    graders[0].kill()
    graders[0].wait()
    with scratch.PrivateFolder() as own:
        assert not left.exists() and kept.exists() and own.exists() and foreign.exists()
    graders[1].communicate("")
    scratch.sweep()
    assert list(tmp_path.iterdir()) == [foreign]


def test_without_a_sandbox_it_refuses(monkeypatch, tmp_path):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("1")])
    monkeypatch.setattr(sandbox.run, "available", lambda: "bubblewrap (bwrap) is not installed; apt-get it")
    with pytest.raises(sandbox.SandboxUnavailable, match="not installed"):
        sandbox.run_notebook(notebook)
    with pytest.raises(ValueError, match="bwrap"):
        sandbox.run_notebook(notebook, mode="docker")


def test_a_kernel_that_does_not_start_is_not_the_students_fault(run_cells, monkeypatch):
    monkeypatch.setattr(client, "START_SECONDS", 5)
    monkeypatch.setattr(provisioner.sys, "executable", "/bin/false")
    with pytest.raises(sandbox.KernelStartError):
        run_cells("1", mode="none")


def test_a_new_folder_that_is_swept_away_at_once_is_made_again(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    make, made = tempfile.mkdtemp, []

    def then_swept(**options):
        made.append(make(**options))
        if len(made) == 1:
            scratch.sweep()
        return made[-1]

    monkeypatch.setattr(tempfile, "mkdtemp", then_swept)
    with scratch.PrivateFolder() as own:
        assert own.exists() and len(made) == 2


def test_a_file_with_the_name_of_the_kit_is_not_the_kit(either, printed, tmp_path):
    (tmp_path / "dhkit.py").write_text("check = 1")
    run = either("from dhkit import check; print(check.__module__)", workdir=tmp_path)
    assert printed(run, 0) == "dhkit.check"
