"""Imports point one way: cli -> grading -> sealing -> questions -> judge -> reference -> dhm; grading -> sandbox; cli -> authoring -> questions.

The solver `dhm` and the students' kit `dhkit` stand alone; rooms that know both may use the kit's geometry.
"""

import ast
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
OURS = ("autograder", "dhkit", "dhm")
FOLDERS = ("autograder", "course/dhkit")
PARENTS = re.compile(r"^(course|autograder\.solver)\.")  # folders that hold a package and are none
GEOMETRY = "dhkit.geometry"  # of the kit, the one part that the course's reference may use
MAY_IMPORT = {
    "autograder/solver/dhm": set(),
    "autograder/reference": {"dhm", GEOMETRY},
    "autograder/sandbox": set(),
    "autograder/judge": {"autograder.reference", "dhm", "dhkit", GEOMETRY},
    "autograder/questions": {"autograder.judge", "autograder.reference", "dhm", "dhkit", GEOMETRY},
    "autograder/authoring": {"autograder.questions", "autograder.judge", "autograder.reference", "dhkit", "dhm"},
    "autograder/sealing": {"autograder.questions", "autograder.judge", "dhkit"},
    "autograder/grading": {
        "autograder.sealing",
        "autograder.questions",
        "autograder.judge",
        "autograder.sandbox",
        "dhkit",
    },
    "course/dhkit": {GEOMETRY},
}


def imported(file):
    """Absolute names of the modules that a file imports."""
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            start = file.relative_to(ROOT).with_suffix("").parts[: -node.level] if node.level else ()
            base = PARENTS.sub("", ".".join([*start, *filter(None, [node.module])]))
            yield from (base, *(f"{base}.{alias.name}" for alias in node.names))


def room(name):
    if name == GEOMETRY or name.startswith(GEOMETRY + "."):
        return GEOMETRY
    return ".".join(name.split(".")[:2]) if name.startswith("autograder.") else name.split(".")[0]


@pytest.mark.parametrize("folder", MAY_IMPORT)
def test_a_room_imports_only_what_stands_below_it(folder):
    own = PARENTS.sub("", folder.replace("/", "."))
    allowed = MAY_IMPORT[folder] | {own, "autograder"}
    for file in sorted((ROOT / folder).rglob("*.py")):
        ours = {name for name in imported(file) if name.startswith(OURS)}
        assert {room(name) for name in ours} <= allowed, (file, ours)


def module_file(name):
    """The file or folder of a module of ours, None where there is none."""
    top = {"dhkit": ROOT / "course", "dhm": ROOT / "autograder/solver"}.get(name.split(".")[0], ROOT)
    found = top.joinpath(*name.split("."))
    return next((path for path in (found.with_suffix(".py"), found / "__init__.py") if path.exists()), None)


@pytest.mark.parametrize("folder", [*FOLDERS, "tests"])
def test_every_module_of_ours_that_is_imported_exists(folder):
    for file in sorted((ROOT / folder).rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.ImportFrom) and not node.level and node.module.split(".")[0] in OURS:
                assert module_file(node.module), f"{file}:{node.lineno}: there is no {node.module}"


def private_names_of_other_modules(file):
    """Names with a leading underscore that a file takes from another module of ours, with their lines."""
    tree = ast.parse(file.read_text())
    modules = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.level or node.module.split(".")[0] in OURS):
            modules |= {alias.asname or alias.name for alias in node.names}
            yield from (f"{node.lineno}: {alias.name}" for alias in node.names if is_private(alias.name))
        elif isinstance(node, ast.Import):
            modules |= {alias.asname or alias.name for alias in node.names if alias.name.split(".")[0] in OURS}
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and is_private(node.attr) and ast.unparse(node.value) in modules:
            yield f"{node.lineno}: {ast.unparse(node)}"


def is_private(name):
    return name.startswith("_") and not name.startswith("__")


@pytest.mark.parametrize("folder", FOLDERS)
def test_what_begins_with_an_underscore_stays_in_its_module(folder):
    found = {str(file): list(private_names_of_other_modules(file)) for file in sorted((ROOT / folder).rglob("*.py"))}
    assert not {file: names for file, names in found.items() if names}


def test_students_kit_needs_few_libraries():
    allowed = {
        "numpy",
        "sympy",
        "matplotlib",
        "mpl_toolkits",
        "IPython",
        "cryptography",
        "msgspec",
        "ipywidgets",
        "anywidget",
        "traitlets",
        "dhkit",
        *sys.stdlib_module_names,
    }
    for file in sorted((ROOT / "course/dhkit").rglob("*.py")):
        assert {name.split(".")[0] for name in imported(file)} <= allowed, file


def test_solver_needs_numpy_and_sympy_only():
    allowed = {"numpy", "sympy", "dhm", *sys.stdlib_module_names}
    for file in sorted((ROOT / "autograder/solver/dhm").rglob("*.py")):
        assert {name.split(".")[0] for name in imported(file)} <= allowed, file


def test_kit_and_solver_have_the_same_geometry():
    kit, solver = ROOT / "course/dhkit/geometry.py", ROOT / "autograder/solver/dhm/geometry.py"
    assert kit.read_text() == solver.read_text(), f"after a change of one, copy it to the other: cp {kit} {solver}"
