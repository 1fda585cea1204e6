"""The solver is a package of its own: its wheel runs with NumPy and SymPy alone, and its README is true."""

import doctest
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import dhm

PROJECT = Path(__file__).parents[2] / "autograder/solver"
README = PROJECT / "README.md"


def test_the_readme_is_true():
    result = doctest.testfile(str(README), module_relative=False, optionflags=doctest.ELLIPSIS)
    assert result.attempted > 5 and not result.failed


def test_the_docstring_is_true():
    result = doctest.testmod(dhm)
    assert result.attempted > 5 and not result.failed


@pytest.mark.slow
def test_the_wheel_runs_with_numpy_and_sympy_alone(tmp_path):
    """Built and installed for itself; NumPy, SymPy and what that needs are those of this environment."""
    wheels, room = tmp_path / "wheels", tmp_path / "room"
    source = shutil.copytree(PROJECT, tmp_path / "source", ignore=shutil.ignore_patterns("build", "*.egg-info"))
    quiet = ("--quiet", "--disable-pip-version-check", "--no-deps")
    pip = (sys.executable, "-m", "pip")
    subprocess.run(
        [*pip, "wheel", *quiet, "--no-build-isolation", "--wheel-dir", wheels, source], check=True, cwd=tmp_path
    )
    (wheel,) = wheels.glob("dhm-*.whl")
    subprocess.run([*pip, "install", *quiet, "--target", room, wheel], check=True)
    for name in ("numpy", "sympy", "mpmath"):
        folder = Path(__import__(name).__file__).parent
        (room / name).symlink_to(folder)
        libraries = folder.parent / f"{name}.libs"
        if libraries.exists():
            (room / libraries.name).symlink_to(libraries)
    code = f"import doctest, sys; sys.path.insert(0, {str(room)!r}); import dhm; assert dhm.__file__.startswith({str(room)!r}); "
    code += f"sys.exit(doctest.testfile({str(README)!r}, module_relative=False, optionflags=doctest.ELLIPSIS).failed)"
    # -I -S: neither this environment's packages nor its variables.
    subprocess.run([sys.executable, "-I", "-S", "-c", code], check=True, cwd=tmp_path, env=dict(os.environ))
