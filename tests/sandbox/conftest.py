"""Runs lists of code cells for the sandbox tests."""

import os
from functools import partial

import nbformat
import psutil
import pytest

from autograder import sandbox

QUICK = sandbox.Limits(
    memory=400 << 20, processes=64, disk=16 << 20, file_size=8 << 20, cell_seconds=20, notebook_seconds=60
)


@pytest.fixture(scope="session")
def needs_sandbox():
    """Skips where there is no sandbox to be had, except in CI, where that is a failure."""
    reason = sandbox.available()
    if reason and os.environ.get("CI") == "true":
        pytest.fail(f"CI must have a sandbox: {reason}")
    if reason:
        pytest.skip(reason)


@pytest.fixture
def run_cells():
    """run_cells(*sources, mode=..., limits=..., followup=...) -> Run, with the files of a folder or none."""

    def run(*sources, limits=QUICK, mode="bwrap", workdir=None, **options):
        notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in sources])
        files, _ = sandbox.read_folders([workdir] if workdir else [], limits.disk // 2)
        return sandbox.run_notebook(notebook, files=files, limits=limits, mode=mode, **options)

    return run


BOTH = ("test_sandbox_isolation", "test_sandbox_limits")


def pytest_generate_tests(metafunc):
    """What bounds and encloses a kernel is tried on warm and on cold ones."""
    if "sandboxed" in metafunc.fixturenames:
        starts = ("warm", "cold") if metafunc.module.__name__.endswith(BOTH) else ("warm",)
        metafunc.parametrize("sandboxed", starts, indirect=True)


@pytest.fixture
def sandboxed(request, needs_sandbox, run_cells):
    """run_cells under bubblewrap."""
    return partial(run_cells, warm=request.param == "warm")


@pytest.fixture
def printed():
    """printed(run, index) -> the text a cell wrote to standard output."""

    def text(run, index):
        return "".join(output.text for output in run.cells[index].outputs if output.get("name") == "stdout").strip()

    return text


@pytest.fixture
def statuses():
    return lambda run: [run.cells[index].status for index in sorted(run.cells)]


@pytest.fixture
def alive():
    """alive(word) -> processes of the machine with this word in their command line."""

    def find(word):
        return [
            process
            for process in psutil.process_iter(["cmdline"])
            if word in " ".join(process.info["cmdline"] or []) and process.pid != os.getpid()
        ]

    return find
