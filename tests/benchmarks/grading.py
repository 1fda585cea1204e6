"""Notebooks per minute and processor time per notebook: our grader, stock nbgrader, and the bare cells, in one run.

    .venv/bin/python tests/benchmarks/grading.py [--exercise planar_2r] [--notebooks 8] [--jobs 1 2 4]

A class hands in the instructor's own answers, every student with a name of his own. Ours is ``autograder grade`` with
feedback pages, from start to end of the command, notebooks run in the sandbox; a second run after ``--force`` judges what
was kept. Stock is ``nbgrader autograde`` and ``nbgrader generate_feedback`` with nothing of ours configured: no sandbox, no
judge. The floor is what the cells of one notebook take in a process that has run them before. Processor time is that
of a command and everything it started; other work on the machine disturbs it less than the time on the clock.
"""

import argparse
import os
import platform
import resource
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

import nbformat
from rich.console import Console
from rich.table import Table

sys.path.insert(0, str(Path(__file__).parents[1] / "sample_class"))

from expected import Submission
from write import hand_in, solution

ROOT = Path(__file__).resolve().parents[2]
STOCK = 'c = get_config()\nc.CourseDirectory.source_directory = "solutions"\nc.ClearSolutions.code_stub = {"python": "..."}\n'


# `autograder` with what its kernels took said at the end: they are killed, and nobody waits for what is killed with them.
OURS = """
import sys
from autograder import cli
from autograder.sandbox.provisioner import SandboxProvisioner as Provisioner

total, release = 0.0, Provisioner.release

def counted(self):
    global total
    if self.process is not None:
        total += self.watch.spent_now().processor
    release(self)

Provisioner.release = counted
code = cli.main(sys.argv[1:])
print(total)
sys.exit(code)
"""


@dataclass(frozen=True)
class Spent:
    """Seconds on the clock and of processor time that some commands took."""

    wall: float
    processor: float


def spent(*commands, cwd):
    """What commands take, one after the other, with all that they start and wait for, and what the last one prints."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    said = ""
    for command in commands:
        said = subprocess.run(command, cwd=cwd, check=True, capture_output=True, text=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Spent(perf_counter() - start, processor), said


def graded(course, exercise, jobs):
    """What ``autograder grade`` takes, its kernels included."""
    words = [sys.executable, "-c", OURS, "grade", exercise, "--force", "--jobs", str(jobs)]
    found, said = spent(words, cwd=course)
    return replace(found, processor=found.processor + float(said.split()[-1]))


def program(name):
    return str(Path(sys.executable).with_name(name))


def class_of(folder, exercise, count):
    """A course in which so many students have handed in right answers to an exercise."""
    folder.mkdir()
    shutil.copyfile(ROOT / "nbgrader_config.py", folder / "nbgrader_config.py")
    for step in ("solutions", "exercises"):
        shutil.copytree(ROOT / step / exercise, folder / step / exercise)
    source = solution(exercise)
    for number in range(count):
        submission = Submission(exercise, f"student-{number}", says="Everything right.")
        place = folder / "submitted" / submission.student / exercise
        place.mkdir(parents=True)
        for name, content in hand_in(submission, source).items():
            (place / name).write_bytes(content)
    return folder


def floor(folder, exercise):
    """Processor seconds of a notebook's cells, the second time in one kernel; its start and imports are not in it."""
    from autograder import sandbox

    nb = nbformat.read(folder / "submitted" / "student-0" / exercise / f"{exercise}.ipynb", as_version=4)
    sources = [cell.source for cell in nb.cells if cell.cell_type == "code"]
    look = "print(__import__('time').process_time())"
    cells = [*sources, look, *sources, look]
    run = sandbox.run_notebook(nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells]))
    first, second = (float(run.cells[place].outputs[0].text) for place in (len(sources), len(cells) - 1))
    return second - first


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--exercise", default="planar_2r")
    parser.add_argument("--notebooks", type=int, default=8)
    parser.add_argument("--jobs", type=int, nargs="+", default=[1, 2, 4])
    options = parser.parse_args()
    exercise, count = options.exercise, options.notebooks
    os.environ["PATH"] = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))
    with tempfile.TemporaryDirectory() as place:
        ours, stock = (class_of(Path(place, name), exercise, count) for name in ("ours", "stock"))
        (stock / "nbgrader_config.py").write_text(STOCK)
        spent([program("autograder"), "release", exercise, "--home", "form"], cwd=ours)
        spent([program("nbgrader"), "generate_assignment", exercise, "--create", "--force"], cwd=stock)
        commands = ([program("nbgrader"), command, exercise] for command in ("autograde", "generate_feedback"))
        rows = {"stock nbgrader": spent(*commands, cwd=stock)[0]}
        for jobs in options.jobs:
            shutil.rmtree(ours / "build", ignore_errors=True)
            rows[f"ours, {jobs} job{'s' if jobs > 1 else ''}"] = graded(ours, exercise, jobs)
        rows["ours, judged again"] = graded(ours, exercise, 1)
        bare = floor(ours, exercise)
    title = f"{count} right notebooks of {exercise}; {os.cpu_count()} cores, Python {platform.python_version()}"
    table = Table(title=f"{title}; the bare cells, warm: {bare:.2f} s of processor time", title_justify="left")
    for name in (
        "",
        "s on the clock",
        "notebooks/min",
        "processor s/notebook",
        "times stock's pace",
        "times the bare cells",
    ):
        table.add_column(name, justify="right" if name else "left")
    for name, what in rows.items():
        each, pace = what.processor / count, rows["stock nbgrader"].wall / what.wall
        figures = (what.wall, 60 * count / what.wall, each, pace, each / bare)
        table.add_row(name, *(f"{figure:.2f}" for figure in figures))
    Console(width=130).print(table)


if __name__ == "__main__":
    main()
