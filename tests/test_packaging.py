"""All packages declare what they import; versions agree wherever they are told; licences go with each package."""

import ast
import re
import sys
import tomllib
from importlib import metadata
from itertools import chain
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[1]
SOLVER = "autograder/solver"
PROJECTS = {
    "pyproject.toml": ("autograder", "course/dhkit"),
    "course/pyproject.toml": ("course/dhkit",),
    f"{SOLVER}/pyproject.toml": (f"{SOLVER}/dhm",),
}
OURS = {"autograder", "dhkit", "dhm"}


def declared(file):
    """Name -> requirement of the dependencies in a pyproject.toml, the optional ones too."""
    project = tomllib.loads((ROOT / file).read_text())["project"]
    lines = [*project["dependencies"], *chain.from_iterable(project.get("optional-dependencies", {}).values())]
    return {canonicalize_name(found.name): found for found in map(Requirement, lines)}


def pinned():
    """Name -> version of the pins in both requirements files."""
    return versions("requirements.txt") | versions("course/requirements.txt")


def versions(file):
    found = re.findall(r"^([\w.-]+)==([^\s;]+)", (ROOT / file).read_text(), re.M)
    return {canonicalize_name(name): version for name, version in found}


def imported(folder):
    """Top-level modules that the files below a folder import."""
    for path in (ROOT / folder).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Import):
                yield from (alias.name.split(".")[0] for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and not node.level:
                yield node.module.split(".")[0]


@pytest.mark.slow
@pytest.mark.parametrize("file", PROJECTS)
def test_what_a_package_imports_is_declared(file):
    modules = {name for folder in PROJECTS[file] for name in imported(folder)} - OURS - sys.stdlib_module_names
    modules -= {"enter", "kernel"}  # their texts lie beside the warm parent's in its sandbox
    providers = metadata.packages_distributions()
    assert modules <= providers.keys(), "imported, and not installed"
    assert {canonicalize_name(providers[module][0]) for module in modules} <= declared(file).keys()


@pytest.mark.parametrize("file", PROJECTS)
def test_pins_lie_within_the_declared_ranges(file):
    pins = pinned()
    for name, requirement in declared(file).items():
        version = pins.get(name) or metadata.version(name)
        assert requirement.specifier.contains(version), f"{requirement}, but {version} is what is tested"


def test_the_lock_holds_the_pins():
    locked = versions("constraints.txt")
    assert {name: locked.get(name) for name in pinned()} == pinned(), "run: make lock"


def test_pre_commit_lints_with_the_version_of_the_environment():
    revisions = re.findall(r"ruff-pre-commit\s+rev: v(\S+)", (ROOT / ".pre-commit-config.yaml").read_text())
    assert revisions == [pinned()["ruff"]]


def test_students_get_a_licence_with_the_kit():
    for name in ("LICENSE", "LICENSE-TEXT.md"):
        assert (ROOT / "course" / name).read_text() == (ROOT / name).read_text()
    assert (ROOT / SOLVER / "LICENSE").read_text() == (ROOT / "LICENSE").read_text()
