"""Every notebook runs from top to bottom, and a warning in it is an error."""

import re
from pathlib import Path

import nbformat
import pytest
from expected import submissions
from nbclient import NotebookClient

from autograder.reference import errata

pytestmark = [pytest.mark.slow, pytest.mark.notebook]

ROOT = Path(__file__).parents[2]
ERRATA = ROOT / "course/13_errata.ipynb"
# The sample class runs these, warnings looked for, as the notebooks of its student "right".
RUN_ELSEWHERE = {
    ROOT / f"solutions/{one.exercise}/{one.exercise}.ipynb" for one in submissions() if one.student == "right"
}
NOTEBOOKS = {*ROOT.glob("course/*.ipynb"), *ROOT.glob("exercises/*/*.ipynb"), *ROOT.glob("solutions/*/*.ipynb")}


@pytest.fixture(autouse=True)
def warnings_are_errors(monkeypatch):
    monkeypatch.setenv("PYTHONWARNINGS", "error::RuntimeWarning,error::UserWarning,error::SyntaxWarning")


def executed(path):
    """The notebook with its outputs; an exception names the cell."""
    resources = {"metadata": {"path": path.parent}}
    return NotebookClient(nbformat.read(path, as_version=4), timeout=600, resources=resources).execute()


@pytest.mark.parametrize("path", sorted(NOTEBOOKS - RUN_ELSEWHERE - {ERRATA}), ids=lambda path: path.stem)
def test_a_notebook_runs_without_a_warning(path):
    executed(path)


def test_the_errata_lecture_shows_every_erratum_with_its_proof():
    cells = executed(ERRATA).cells
    shown = "\n".join(
        output.get("data", {}).get("text/html", "") for cell in cells for output in cell.get("outputs", ())
    )
    known = {erratum.id for erratum in errata.ERRORS + errata.AMBIGUITIES}
    assert len(known) == 61
    assert sorted(known) == sorted(re.findall(r"<code>([\w-]+)</code>", shown)), "each once"
    assert shown.count("<b>proved</b>") == len(known) and "NOT PROVED" not in shown
