"""Imports point one way: cli -> grading -> questions -> judge -> reference, and grading -> sandbox."""

import ast
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
MAY_IMPORT = {
    "autograder/reference": set(),
    "autograder/sandbox": set(),
    "autograder/judge": {"autograder.reference", "dhkit"},
    "autograder/questions": {"autograder.judge", "autograder.reference", "dhkit"},
    "autograder/grading": {"autograder.questions", "autograder.judge", "autograder.sandbox", "dhkit"},
    "course/dhkit": set(),
}


def imported(file):
    """Absolute names of the modules that a file imports."""
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            start = file.relative_to(ROOT).with_suffix("").parts[: -node.level] if node.level else ()
            base = ".".join([*start, *filter(None, [node.module])]).removeprefix("course.")
            yield from (base, *(f"{base}.{alias.name}" for alias in node.names))


def room(name):
    return ".".join(name.split(".")[:2]) if name.startswith("autograder.") else name.split(".")[0]


@pytest.mark.parametrize("folder", MAY_IMPORT)
def test_a_room_imports_only_what_stands_below_it(folder):
    own = folder.removeprefix("course/").replace("/", ".")
    allowed = MAY_IMPORT[folder] | {own, "autograder"}
    for file in sorted((ROOT / folder).rglob("*.py")):
        ours = {name for name in imported(file) if name.startswith(("autograder", "dhkit"))}
        assert {room(name) for name in ours} <= allowed, (file, ours)


def test_students_kit_needs_four_libraries():
    allowed = {
        "numpy",
        "sympy",
        "matplotlib",
        "mpl_toolkits",
        "IPython",
        "ipywidgets",
        "dhkit",
        *sys.stdlib_module_names,
    }
    for file in sorted((ROOT / "course/dhkit").rglob("*.py")):
        assert {name.split(".")[0] for name in imported(file)} <= allowed, file
