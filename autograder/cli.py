"""The `autograder` command. What a command needs is imported when it runs: help must come at once."""

from __future__ import annotations

import argparse
import json
import logging
import os
import signal
import sys
import threading
import traceback
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import Field, fields
from io import TextIOWrapper
from pathlib import Path
from typing import Any

from autograder.sandbox import Limits


def _positive(text: str) -> int:
    if (number := int(text)) < 1:
        raise argparse.ArgumentTypeError("must be at least 1")
    return number


def _bytes(text: str) -> int:
    """Bytes, or with a K, M or G behind them KiB, MiB or GiB."""
    factor = {"K": 1 << 10, "M": 1 << 20, "G": 1 << 30}.get(text[-1:].upper())
    return _positive(text) if factor is None else _positive(text[:-1]) * factor


def _seconds(text: str) -> float:
    if not 0 < (number := float(text)) < float("inf"):
        raise argparse.ArgumentTypeError("must be a positive number of seconds")
    return number


def _points_of(text: str) -> float:
    if not 0 <= (number := float(text)) < float("inf"):
        raise argparse.ArgumentTypeError("must be 0 or more")
    return number


_UNITS = {"bytes": (_bytes, "BYTES"), "seconds": (_seconds, "S"), "count": (_positive, "N")}


def _shown(limit: Field) -> str:
    """The default of a limit as one would type it."""
    default: Any = limit.default
    if limit.metadata["unit"] != "bytes":
        return f"{default:g}"
    size, letter = next(
        (size, letter) for size, letter in ((30, "G"), (20, "M"), (10, "K"), (0, "")) if default >> size
    )
    return f"{default >> size}{letter}"


_LITTLE_LATER = 0.05  # seconds


class Stopped(KeyboardInterrupt):
    """A signal asked the command to stop."""

    def __init__(self, number: int) -> None:
        self.number = number


@contextmanager
def _stoppable() -> Iterator[None]:
    """Within the block a signal to stop raises `Stopped`; a second one ends the process at once, also after the block.

    A signal that is ignored, as under nohup, stays ignored.
    """
    signals = (signal.SIGINT, signal.SIGTERM, *([signal.SIGHUP] if hasattr(signal, "SIGHUP") else []))
    before = {number: found for number in signals if (found := signal.getsignal(number)) != signal.SIG_IGN}
    if threading.current_thread() is not threading.main_thread():
        before = {}

    report = sys.unraisablehook

    def arm() -> None:
        for number in before:
            signal.signal(number, stop)

    def stop(number: int, frame: object) -> None:
        for each in before:
            signal.signal(each, lambda number, frame: os._exit(128 + number))
        logging.disable()  # libraries that the exception passes through report it as a fault of theirs
        raise Stopped(number)

    def again(unraisable: Any) -> None:
        if not isinstance(unraisable.exc_value, Stopped):
            return report(unraisable)
        # It came while Python was cleaning up an object, where no exception gets through: once more, a little later.
        arm()
        whom = (threading.main_thread().ident, unraisable.exc_value.number)
        threading.Timer(_LITTLE_LATER, signal.pthread_kill, whom).start()

    arm()
    sys.unraisablehook = again
    try:
        yield
    except Stopped:
        before = {}  # the process is about to end
        raise
    finally:
        sys.unraisablehook = report
        for number, handler in before.items():
            signal.signal(number, handler)


def main(argv: list[str] | None = None) -> int:
    """Run the command line `argv`.

    Returns
    -------
    int
        Exit code: 0 done, 1 something failed, 2 the command made no sense, 128 and the number of the signal that
        stopped it.
    """
    options = _parser().parse_args(argv)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            # A name that the terminal cannot show must not end the command.
            stream.reconfigure(errors="replace")
    try:
        with _stoppable():
            return options.run(options)
    except KeyboardInterrupt as stopped:
        print("interrupted: what was graded before is in the gradebook; run it again for the rest", file=sys.stderr)
        return 128 + (stopped.number if isinstance(stopped, Stopped) else signal.SIGINT)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except Exception as error:
        if not options.verbose and (module := _broken_module(error)):
            reason = f"{type(error).__name__}: {error}"
            cure = "make setup installs what grading needs; with --verbose it is shown where this happened"
            print(f"autograder: {module} cannot be imported ({reason}); {cure}", file=sys.stderr)
            return 2
        from autograder.grading.errors import CourseError, in_words
        from autograder.grading.gradebook import GradebookError

        if not isinstance(error, CourseError | OSError):
            raise
        print(f"autograder: {in_words(error)}", file=sys.stderr)
        return 1 if isinstance(error, GradebookError | OSError) else 2


def _broken_module(error: Exception) -> str | None:
    """The module that failed while it was imported, if that is what happened: it was on its outermost level."""
    frames = (frame for frame, _ in traceback.walk_tb(error.__traceback__))
    names = [frame.f_globals["__name__"] for frame in frames if frame.f_code.co_name == "<module>"]
    return names[-1] if names else None


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="autograder",
        description="Releases exercises, grades what students hand in, writes feedback.",
        epilog="example: autograder release && autograder grade scara && autograder report scara",
    )
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument(
        "--course", metavar="DIR", help="course folder (default: the nearest one with nbgrader_config.py)"
    )
    common.add_argument("--verbose", action="store_true", help="show nbgrader's log")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)

    def command(name: str, run, help: str, example: str) -> argparse.ArgumentParser:
        formatter = argparse.RawDescriptionHelpFormatter
        added = commands.add_parser(
            name, help=help, description=help, epilog=f"example: {example}", parents=[common], formatter_class=formatter
        )
        added.set_defaults(run=run)
        return added

    release = command(
        "release", _release, "Make the students' notebooks from the solutions.", "autograder release scara"
    )
    release.add_argument(
        "--yes", action="store_true", help="do not ask where questions are added or removed that people have answered"
    )
    release.add_argument("exercise", nargs="*", help="exercises to release (default: all)")
    release.add_argument(
        "--home",
        choices=("sealed", "form"),
        default="sealed",
        help="what a student's copy tells: right or wrong and why, sealed under the answers (default), or the form only",
    )
    release.add_argument("--anew", action="store_true", help="seal with a new salt, for a new term")
    release.add_argument("--table", action="store_true", help="print what is sealed, and the arithmetic behind it")

    new = command(
        "new-exercise",
        _new_exercise,
        "Write an exercise on a robot of your own from its table or URDF: questions, mistakes, solution notebook, made students.",
        "autograder new-exercise my_robot.toml && autograder release my_robot",
    )
    new.add_argument(
        "robot", type=Path, help="a URDF, or a file with title, joints, rows [sigma, a, alpha, d, theta] and [lengths]"
    )
    new.add_argument("--title", help="what the robot is called in the texts (default: as its file says)")
    new.add_argument("--name", help="what the exercise is called (default: as the file)")

    points = command(
        "points",
        _points,
        "Change what a question is worth: other points (0 drops it), or full points for everybody.",
        "autograder points scara.postures --everybody",
    )
    points.add_argument("question", help="for example scara.postures")
    points.add_argument("points", nargs="?", type=_points_of, metavar="N", help="the most points, 0 or more")
    judged = points.add_mutually_exclusive_group()
    judged.add_argument("--everybody", action="store_true", help="all who hand in get them, whatever they answered")
    judged.add_argument("--judged", action="store_true", help="answers are judged again")

    roster = command(
        "roster",
        _roster,
        "Take the students of the course from what Moodle or Canvas exports into students.csv and the gradebook.",
        "autograder roster participants.csv grades.csv",
    )
    roster.add_argument(
        "file",
        nargs="*",
        metavar="FILE",
        help="Moodle's list of participants or grading worksheet, Canvas's grade table (none: show students.csv as it is)",
    )

    allow = command(
        "allow",
        _allow,
        "Give a student more time for an exercise, or exempt the student.",
        "autograder allow 'Ada Lovelace' scara --until +3d",
    )
    allow.add_argument("student", help="id, or name on the roster")
    allow.add_argument("exercise")
    what = allow.add_mutually_exclusive_group(required=True)
    what.add_argument("--until", metavar="TIME", help="+3d, +12h or '2026-10-20 23:59'")
    what.add_argument("--exempt", action="store_true", help="the exercise does not count for the student")
    what.add_argument("--nothing", action="store_true", help="take back what was allowed")

    collect = command(
        "collect",
        _collect,
        "Put what Moodle, Canvas or a zip holds into submitted/, and say of everybody what became of it.",
        "autograder collect scara ~/Downloads/robots-scara-4711.zip",
    )
    collect.add_argument("exercise")
    collect.add_argument(
        "download",
        nargs="+",
        metavar="ZIP",
        help="the platform's download (a folder if it is unpacked); with a .csv, Moodle's grading worksheet of the assignment",
    )
    collect.add_argument(
        "--force", action="store_true", help="also replace files that were put into submitted/ by hand"
    )

    grade = command(
        "grade",
        _grade,
        "Grade the submissions in submitted/*/EXERCISE.",
        "autograder grade scara --jobs 4 --cell-seconds 60",
    )
    grade.add_argument("exercise", nargs="*", help="exercises to grade (default: all that were handed in)")
    grade.add_argument(
        "--student", action="append", default=[], metavar="ID", help="only this student; may be repeated"
    )
    grade.add_argument("--force", action="store_true", help="also grade what has not changed since it was graded")
    grade.add_argument(
        "--jobs", type=_positive, metavar="N", help="notebooks that run at the same time (default: one per core)"
    )
    grade.add_argument(
        "--scheduler", metavar="ADDRESS", help="run notebooks on the workers of this Dask scheduler, as tcp://host:8786"
    )
    grade.add_argument("--json", action="store_true", help="print one JSON object per submission instead of the table")
    sandbox = grade.add_argument_group("sandbox")
    sandbox.add_argument("--sandbox", choices=("bwrap", "none"), help="'none' runs students' code unprotected, as you")
    for limit in fields(Limits):
        read, metavar = _UNITS[limit.metadata["unit"]]
        text = f"{limit.metadata['help']} (default {_shown(limit)})"
        sandbox.add_argument(f"--{limit.name.replace('_', '-')}", type=read, metavar=metavar, help=text)

    worker = command(
        "worker",
        _worker,
        "Run notebooks for `grade --scheduler`, on this machine, until it is stopped (docs/many_machines.md).",
        "autograder worker tcp://host:8786",
    )
    worker.add_argument("scheduler", metavar="ADDRESS", help="of the Dask scheduler, as tcp://host:8786")
    worker.add_argument(
        "--jobs", type=_positive, metavar="N", help="notebooks that run at the same time (default: one per core)"
    )

    watch = command(
        "watch",
        _watch,
        "Grade whatever arrives in submitted/, until it is stopped with Ctrl-C.",
        "autograder watch scara",
    )
    watch.add_argument("exercise", nargs="*", help="exercises to watch (default: all)")
    watch.add_argument(
        "--poll", action="store_true", help="look for what is new every few seconds: for a folder of the network"
    )
    watch.add_argument(
        "--jobs", type=_positive, metavar="N", help="notebooks that run at the same time (default: one per core)"
    )

    explain = command(
        "explain",
        _explain,
        "Say how one verdict came about: run the notebook once more and show what was read and compared.",
        "autograder explain 'Ada Lovelace' scara.T04 --html appeal.html",
    )
    explain.add_argument("student", help="id, or name on the roster")
    explain.add_argument("question", help="for example scara.T04")
    explain.add_argument("--with-answer", action="store_true", help="also show what is right; not to be forwarded")
    explain.add_argument("--html", metavar="FILE", help="write it as a page that can be forwarded")
    explain.add_argument("--sandbox", choices=("bwrap", "none"), help="'none' runs students' code unprotected, as you")

    feedback = command(
        "feedback", _feedback, "Write the feedback pages of all graded submissions.", "autograder feedback scara"
    )
    feedback.add_argument("exercise")

    returned = command(
        "return",
        _return,
        "Write grades and feedback pages as Moodle and Canvas take them back.",
        "autograder return scara --moodle ~/Downloads/worksheet.csv",
    )
    returned.add_argument("exercise")
    platform = returned.add_mutually_exclusive_group(required=True)
    platform.add_argument(
        "--moodle",
        nargs="?",
        const="",
        metavar="WORKSHEET",
        help="the assignment's grading worksheet, to be filled in (none: only the zip of feedback files)",
    )
    platform.add_argument("--canvas", metavar="CSV", help="the grade table as Canvas exports it")
    returned.add_argument("--assignment", metavar="NAME", help="column of Canvas's table (default: the exercise's)")
    returned.add_argument(
        "--scale", action="store_true", help="count in the platform's maximum where it is not the exercise's"
    )
    returned.add_argument("--to", metavar="FOLDER", help="folder to write to (default: build/return/EXERCISE)")

    report = command(
        "report",
        _report,
        "Show how the class did on each question; write a page and tables.",
        "autograder report scara",
    )
    report.add_argument("exercise")
    report.add_argument(
        "--to", metavar="FOLDER", help="folder to write to (default: build/reports/EXERCISE in the course)"
    )

    term = command(
        "term",
        _term,
        "Show the term at a glance: a page for the class, one per student, and equal wrong answers that are no chance.",
        "autograder term",
    )
    term.add_argument("--to", metavar="FOLDER", help="folder to write to (default: build/term in the course)")

    export = command(
        "export", _export, "Write grades and notes as CSV.", "autograder export --exercise scara --to grades.csv"
    )
    export.add_argument(
        "--exercise", action="append", default=[], metavar="NAME", help="only this exercise; may be repeated"
    )
    export.add_argument("--bom", action="store_true", help="mark the file as UTF-8, for Excel")
    export.add_argument("--to", metavar="FILE", default="grades.csv", help="file to write (default: grades.csv)")

    archive = command(
        "archive",
        _archive,
        "Keep a term in one zip: gradebook, what was handed in and given back, roster and dates.",
        "autograder archive robots-2026.zip --clear",
    )
    archive.add_argument("file", metavar="ZIP", help="file to write; it must not be there yet")
    archive.add_argument("--clear", action="store_true", help="then remove all that from the course, for the next term")
    archive.add_argument("--yes", action="store_true", help="do not ask before it is removed")

    bundle = command("bundle", _bundle, "Write the zip that students get.", "autograder bundle --to build/robots.zip")
    bundle.add_argument("--to", metavar="FILE", default="robots.zip", help="file to write (default: robots.zip)")

    command("doctor", _doctor, "Say what this machine lacks for grading, and how to get it.", "autograder doctor")
    return parser


def _course(options, config=None):
    from autograder.grading.course import find_root, open_course

    return open_course(find_root(options.course), config, options.verbose)


def _new_exercise(options) -> int:
    from autograder.authoring import write_exercise
    from autograder.grading.course import find_root
    from autograder.grading.errors import CourseError

    try:
        written = write_exercise(find_root(options.course), options.robot, options.name, options.title)
    except ValueError as error:
        raise CourseError(str(error)) from None
    for path in written.files:
        print(path)
    if written.left_out:
        print(f"without the inverse model: {written.left_out}")
    print(f"look at the notebook, then run: autograder release {written.name}")
    return 0


def _release(options) -> int:
    from autograder.grading.release import changes_ahead, release
    from autograder.grading.table import progress_bar, sealed_table
    from autograder.questions import of_exercise

    course = _course(options)
    for exercise in options.exercise or course.exercises():
        if not options.yes and not _agreed(exercise, changes_ahead(course, exercise)):
            print(f"{exercise} was not released; everything is as it was")
            continue
        to_seal = len(of_exercise(exercise)) if options.home == "sealed" else 0
        bar = progress_bar(f"sealing {exercise}", to_seal) if to_seal else nullcontext(lambda question: None)
        with bar as told:
            released = release(course, exercise, options.home, options.anew, told)
        changes = released.changes
        if options.table and released.decisions:
            sealed_table(released.decisions)
        print(course.step("release", ".", exercise))
        for what, questions in (("new", changes.added), ("no longer asked", changes.removed)):
            if changes.submissions and questions:
                print(
                    f"  {what}: {', '.join(questions)}; for {changes.submissions} submissions, run: autograder grade {exercise}"
                )
    return 0


def _agreed(exercise: str, changes) -> bool:
    """Whether questions are to be added or removed that people have answered; True where there are none."""
    from autograder.grading.errors import CourseError

    if not changes.submissions or not (changes.added or changes.removed):
        return True
    print(f"{changes.submissions} submissions of {exercise} are there.", file=sys.stderr)
    if changes.added:
        print(f"New: {', '.join(changes.added)}; no points for them until they are graded again.", file=sys.stderr)
    if changes.removed:
        print(f"No longer asked: {', '.join(changes.removed)}; their points and comments go.", file=sys.stderr)
    if not sys.stdin.isatty():
        raise CourseError(f"{exercise} was not released; say --yes if that is what you want")
    return input("Release? [y/N] ").strip().lower() in ("y", "yes")


def _points(options) -> int:
    from autograder.grading.points import set_worth

    for_everybody = True if options.everybody else False if options.judged else None
    worth = set_worth(_course(options), options.question, options.points, for_everybody)
    print(
        f"{options.question}: {worth.points:g} points" + (", for everybody who hands in" if worth.for_everybody else "")
    )
    exercise = options.question.partition(".")[0]
    print(f"run: autograder release {exercise}, then: autograder grade {exercise}")
    return 0


def _roster(options) -> int:
    from pathlib import Path

    from autograder.grading.enrolment import enrol
    from autograder.grading.table import roster_table

    files = [Path(name).absolute() for name in options.file]
    roster_table(enrol(_course(options), files))
    return 0


def _allow(options) -> int:
    from autograder.grading.enrolment import allow

    person = allow(_course(options), options.student, options.exercise, options.until, options.exempt)
    given = [*person.extensions, *(f"exempt from {name}" for name in person.exempt)]
    print(f"{person.id}: {'; '.join(given) or 'nothing out of the ordinary'}")
    print(f"run: autograder grade {options.exercise}")
    return 0


def _collect(options) -> int:
    from pathlib import Path

    from autograder.grading.collecting.collect import collect, without_time
    from autograder.grading.table import collect_table

    given = [Path(name).absolute() for name in options.download]
    course = _course(options)
    worksheets = [path for path in given if path.suffix.lower() == ".csv"]
    downloads = [path for path in given if path not in worksheets]
    rows = collect(course, options.exercise, downloads, worksheets, options.force)
    collect_table(rows)
    if unknown := without_time(course, options.exercise):
        print(
            f"when {unknown} of them handed in is not in the download, so they are not late; "
            "Moodle's grading worksheet, given beside it, tells that"
        )
    return int(any(row.status == "nobody's" and row.remarks for row in rows))


def _grade(options) -> int:
    from traitlets.config import Config

    from autograder.grading.pipeline import grade
    from autograder.grading.results import without_notebook
    from autograder.grading.table import changes_table, class_table, progress_bar, summary

    given = {limit.name: getattr(options, limit.name) for limit in fields(Limits)} | {"mode": options.sandbox}
    course = _course(
        options, Config(SandboxExecute={name: value for name, value in given.items() if value is not None})
    )
    submissions = course.submissions(options.exercise, options.student)
    if options.sandbox == "none":
        print("warning: no sandbox; students' code runs with your rights", file=sys.stderr)
    jobs, results = options.jobs or os.cpu_count() or 1, []
    with _crew(course, jobs, options.scheduler) as crew:
        for exercise, students in submissions.items():
            with progress_bar(f"grading {exercise}", len(students)) as progress:
                results += grade(course, exercise, students, crew, options.force, progress)
            results += without_notebook(course, exercise) if not options.student else []
    if options.json:
        for result in results:
            print(json.dumps(result.as_json()))
    else:
        class_table(results)
        changes_table(results)
        summary(course, results)
    return int(any(result.status == "failed" for result in results))


def _crew(course, jobs, scheduler):
    """Whoever runs and judges: this machine, or the workers of a scheduler."""
    if scheduler is None:
        from autograder.grading.crew import Crew

        return Crew(course, jobs)
    from autograder.grading.cluster import ClusterCrew

    return ClusterCrew(course, jobs, scheduler)


def _worker(options) -> int:
    from autograder.grading.cluster import worker_command

    command = worker_command(options.scheduler, options.jobs or os.cpu_count() or 1)
    os.execv(command[0], command)


def _watch(options) -> int:
    from datetime import datetime

    from autograder.grading.crew import Crew
    from autograder.grading.errors import CourseError
    from autograder.grading.pipeline import grade
    from autograder.grading.table import progress_bar, result_line
    from autograder.grading.watch import arrivals

    course, jobs = _course(options), options.jobs or os.cpu_count() or 1
    for exercise in options.exercise:
        course.require(exercise)

    print(f"watching {course.step('submitted')}; Ctrl-C stops", flush=True)
    again: dict[str, set[str]] = {}
    failures: dict[tuple[str, str], str] = {}
    with Crew(course, jobs) as crew:
        for waiting in arrivals(course, options.exercise, poll=options.poll):
            for exercise in sorted({*waiting, *again}):
                students = sorted({*waiting.get(exercise, ()), *again.pop(exercise, ())})
                try:
                    with progress_bar(f"grading {exercise}", len(students)) as progress:
                        results = grade(course, exercise, students, crew, False, progress)
                except CourseError as reason:
                    print(f"autograder: {exercise}: {reason}", file=sys.stderr)
                    again[exercise] = set(students)
                    continue
                for result in results:
                    failed = result.found() if result.status == "failed" else ""
                    if failed and result.student in students:
                        again.setdefault(exercise, set()).add(result.student)
                    told = failures.pop((result.student, exercise), None)
                    if failed:
                        failures[result.student, exercise] = failed
                    if (result.status != "unchanged" or result.moved) and (not failed or failed != told):
                        print(result_line(result, datetime.now()), flush=True)
    return 0


def _explain(options) -> int:
    from pathlib import Path

    from traitlets.config import Config

    from autograder.grading.explain import as_page, as_text, explain
    from autograder.grading.files import write_whole

    page = Path(options.html).absolute() if options.html else None
    config = Config(SandboxExecute={"mode": options.sandbox}) if options.sandbox else None
    found = explain(_course(options, config), options.student, options.question)
    print(as_text(found, options.with_answer))
    if page is not None:
        write_whole(page, as_page(found, options.with_answer).encode())
        print(page)
    return 0


def _feedback(options) -> int:
    from autograder.grading.course import convert
    from autograder.grading.plugins.feedback import FeedbackPages

    course = _course(options)
    course.choose(options.exercise)
    pages = FeedbackPages(coursedir=course.app.coursedir, parent=course.app)
    pages.force = True
    convert(pages)
    written = sorted(course.step("feedback", "*", options.exercise).parent.parent.glob(f"*/{options.exercise}/*.html"))
    print(*written, sep="\n")
    return 0


def _return(options) -> int:
    from pathlib import Path

    from autograder.grading.returning import return_canvas, return_moodle
    from autograder.grading.table import returned_table

    given, to = (Path(name).absolute() if name else None for name in (options.moodle or options.canvas, options.to))
    course, exercise = _course(options), options.exercise
    folder = to or course.root / "build/return" / exercise
    if options.canvas:
        lines = return_canvas(course, exercise, given, options.assignment, folder, options.scale)
    else:
        lines = return_moodle(course, exercise, given, folder, options.scale)
    returned_table(lines)
    print(*sorted(folder.glob(f"{exercise}-*")), sep="\n")
    return 0


def _report(options) -> int:
    from pathlib import Path

    from autograder.grading.report.page import write_report
    from autograder.grading.report.statistics import class_report
    from autograder.grading.table import report_table

    course = _course(options)
    report = class_report(course, options.exercise)
    folder = Path(options.to) if options.to else course.root / "build/reports" / options.exercise
    page = write_report(report, folder)
    report_table(report)
    print(f"report: {page}")
    return 0


def _term(options) -> int:
    from datetime import UTC, datetime
    from pathlib import Path

    from autograder.grading.overview.page import write_pages
    from autograder.grading.overview.reading import overview
    from autograder.grading.table import term_table

    target = Path(options.to).absolute() if options.to else None
    course = _course(options)
    found = overview(course, datetime.now(UTC).replace(tzinfo=None))
    term_table(found)
    print(write_pages(found, target or course.root / "build/term"))
    return 0


def _export(options) -> int:
    from traitlets.config import Config

    from autograder.grading.gradebook import stock_gradebook
    from autograder.grading.plugins.export import GradesAndNotes

    target = os.path.abspath(options.to)
    plugin = {"to": target, "assignment": options.exercise, "bom": options.bom}
    course = _course(options, Config(GradesAndNotes=plugin))
    for exercise in options.exercise:
        course.choose(exercise)
    with stock_gradebook(course.db_url, course.app.coursedir.course_id) as gradebook:
        GradesAndNotes(parent=course.app).export(gradebook)
    print(target)
    return 0


def _archive(options) -> int:
    from pathlib import Path

    from autograder.grading.archive import archive, clear
    from autograder.grading.errors import CourseError

    target, course = Path(options.file).absolute(), _course(options)
    names = archive(course, target)
    print(f"{target}: {len(names)} files")
    if options.clear:
        print("Gradebook, submissions, feedback and roster are removed from the course now.", file=sys.stderr)
        if not options.yes:
            if not sys.stdin.isatty():
                raise CourseError("nothing was removed; say --yes if that is what you want")
            if input("Remove? [y/N] ").strip().lower() not in ("y", "yes"):
                return 0
        clear(course)
        print("removed; run: autograder release")
        if (course.root / "term.toml").exists():
            print("term.toml holds the dates of the last term: change them")
    return 0


def _bundle(options) -> int:
    from pathlib import Path

    from autograder.grading.bundle import write_bundle
    from autograder.grading.course import find_root

    names = write_bundle(find_root(options.course), Path(options.to))
    print(f"{options.to}: {len(names)} files")
    return 0


def _doctor(options) -> int:
    from pathlib import Path

    from autograder.grading.doctor import examine

    missing = False
    for finding in examine(Path(options.course or ".").resolve()):
        print(f"{'ok     ' if finding.ok else 'missing'}  {finding.what}: {finding.found}")
        if not finding.ok and finding.cure:
            print(f"         {finding.cure}")
        missing |= not finding.ok
    return int(missing)


def program() -> int:
    """`main` as a process of its own: a signal that comes when all is done and said finds nothing to stop."""
    code = main()
    if code < 128:
        for name in ("SIGINT", "SIGTERM", "SIGHUP"):
            if hasattr(signal, name):
                signal.signal(getattr(signal, name), signal.SIG_IGN)
    return code


if __name__ == "__main__":
    sys.exit(program())
