"""Notebooks per minute and processor time per notebook: our grader, stock nbgrader, and the bare cells, in one run.

    .venv/bin/python tests/benchmarks/grading.py [--exercise planar_2r] [--notebooks 16] [--jobs 1 2 4]

A class hands in the instructor's own answers, every student with a name of his own. Ours is ``autograder grade`` with
feedback pages, from start to end of the command, notebooks run in the sandbox; a second run after ``--force`` judges what
was kept. Stock is ``nbgrader autograde`` and ``nbgrader generate_feedback`` with nothing of ours configured: no sandbox, no
judge; and it draws every picture, while ours draws those of questions with something to mend: in this class, none. The
floor is what the cells of one notebook take in a process that has run them before, their pictures not drawn. Processor time
is that of a command and everything it started; other work on the machine disturbs it less than the time on the clock.
"""

import argparse
import os
import platform
import resource
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
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


# `autograder`, which says at its end what it and all its processes took. Kernels are killed, and nobody waits for what is killed
# with them: each is looked at before. Processes of the crew import this file, too, so theirs are counted like those of threads.
OURS = """
import os, sys, time
import psutil
from autograder import cli
from autograder.grading.crew import Crew
from autograder.sandbox.provisioner import SandboxProvisioner as Provisioner

release, leave = Provisioner.release, Crew.__exit__

def note(seconds):
    with open(os.environ["KERNELS"], "a") as file:
        print(seconds, file=file)

def counted(self):
    if self.process is not None:
        note(self.watch.spent_now().processor)
    release(self)

def looked_at(self, *error):
    for process in psutil.Process().children(recursive=True):
        note(sum(process.cpu_times()[:2]))
    leave(self, *error)

Provisioner.release, Crew.__exit__ = counted, looked_at
if __name__ == "__main__":
    code = cli.main(sys.argv[1:])
    note(time.process_time())
    sys.exit(code)
"""


@dataclass(frozen=True)
class Spent:
    """Seconds on the clock and of processor time that some commands took."""

    wall: float
    processor: float


def spent(*commands, cwd):
    """What commands take, one after the other, with all that they start and wait for."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    for command in commands:
        subprocess.run(command, cwd=cwd, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Spent(perf_counter() - start, processor)


def graded(course, exercise, jobs):
    """What ``autograder grade`` takes, with all of its processes."""
    script, kernels = course / "counted.py", course / "kernels.txt"
    script.write_text(OURS)
    kernels.write_text("")
    start = perf_counter()
    words = [sys.executable, script, "grade", exercise, "--force", "--jobs", str(jobs)]
    subprocess.run(words, cwd=course, check=True, capture_output=True, env={**os.environ, "KERNELS": str(kernels)})
    return Spent(perf_counter() - start, sum(map(float, kernels.read_text().split())))


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
    parser.add_argument("--notebooks", type=int, default=16)
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
        rows = {"stock nbgrader": spent(*commands, cwd=stock)}
        for jobs in options.jobs:
            shutil.rmtree(ours / "build", ignore_errors=True)
            rows[f"ours, {jobs} job{'s' if jobs > 1 else ''}"] = graded(ours, exercise, jobs)
        rows["ours, judged again"] = graded(ours, exercise, max(options.jobs))
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
