"""One term and one notation through the course: the glossary is held against the lectures."""

import re
from pathlib import Path

import nbformat
import pytest

COURSE = Path(__file__).parents[2] / "course"
LECTURES = sorted(COURSE.glob("[01]*.ipynb"))
CELLS = {cell.id: cell.source for cell in nbformat.read(COURSE / "glossary.ipynb", as_version=4).cells}
ROWS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in CELLS["terms"].splitlines()
    if line.startswith("| ") and not line.startswith("| English")
]
AVOIDED = sorted({word.strip() for row in ROWS for word in row[5].split(",") if word.strip()})


def prose(path) -> str:
    """The text of a lecture: Markdown without code, formulas, links, words in italics and boxes."""
    cells = [cell.source for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "markdown"]
    lines = [line for source in cells for line in source.splitlines() if not line.startswith(">")]
    text = re.sub(r"\$\$.*?\$\$|```.*?```", " ", "\n".join(lines), flags=re.S)
    return re.sub(r"\$[^$]*\$|`[^`]*`|\]\([^)]*\)|(?<!\*)\*[^*\n]+\*(?!\*)", " ", text)


TEXTS = {path.stem: prose(path) for path in LECTURES}


def test_each_term_stands_once_with_both_translations():
    terms = [term.strip() for row in ROWS for term in row[0].split(",")]
    assert len(ROWS) > 40 and len(terms) == len(set(terms))
    assert all(re.fullmatch(r"\*[^*]+\*", translation) for row in ROWS for translation in row[1:3])


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_a_term_is_used_in_the_lecture_that_it_links_to(row):
    number, notebook = re.fullmatch(r"\[(\d\d)\]\((\w+)\.ipynb\)", row[4]).groups()
    assert notebook.startswith(number)
    text = " ".join(TEXTS[notebook].lower().split())
    for term in row[0].split(","):
        words = re.sub(r"\(.*?\)", " ", term).lower().split()
        assert all(re.search(rf"\b{re.escape(word)}", text) for word in words), f"{term} is not in {notebook}"


@pytest.mark.parametrize("path", LECTURES, ids=lambda path: path.stem)
def test_no_lecture_says_what_the_glossary_avoids(path):
    text = TEXTS[path.stem]
    if path.stem == "15_errata":
        text = text[: text.index("## 9. One false friend")]
    words = "|".join(re.escape(word).replace(r"\ ", r"\s+") for word in AVOIDED)
    found = re.findall(rf"(?<!end )\b(?:{words})s?\b(?!\s+(?:of|\d))", text, re.I)
    assert found == []


@pytest.mark.parametrize("path", LECTURES, ids=lambda path: path.stem)
def test_a_row_s_matrix_and_the_cross_product_have_one_notation(path):
    cells = nbformat.read(path, as_version=4).cells
    formulas = "\n".join(
        line for cell in cells if cell.cell_type == "markdown" for line in cell.source.splitlines() if line[:1] != ">"
    )
    code = "\n".join(cell.source for cell in cells if cell.cell_type == "code")
    assert r"\wedge" not in formulas
    assert not re.search(r"\bdef (T|turn|turn_[xyz])\(", code), (
        "the matrix of a row is dhm, a turn rot, rot_x, rot_y or rot_z"
    )


SPEAKS_OF_A_DOCUMENT = re.compile(
    r"\b(the|these|those|french|romanian|meca|epfl|other|of|two)\s+slides\b|\bslide('s| error| says| prints)|\bthe tutorial\b",
    re.I,
)


@pytest.mark.parametrize("path", [path for path in LECTURES if path.stem != "15_errata"], ids=lambda path: path.stem)
def test_text_stands_without_the_documents_and_a_box_names_its_source(path):
    assert not SPEAKS_OF_A_DOCUMENT.search(TEXTS[path.stem])
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "markdown":
            for box in re.findall(r"(?:^>.*\n?)+", cell.source, re.M):
                assert re.match(
                    r"> \*\*Printed in (MECA 953|the EPFL notes|the DH-m notes \(Romanian\)|the report|the s600 tutorial)(?!\w)",
                    box,
                ), f"{cell.id}: {box}"


@pytest.mark.parametrize("path", sorted(COURSE.parent.glob("solutions/*/*.ipynb")), ids=lambda path: path.stem)
def test_statements_of_exercises_name_what_they_quote(path):
    """Of "the slides" nobody but their author knows which."""
    assert not SPEAKS_OF_A_DOCUMENT.search(prose(path))
