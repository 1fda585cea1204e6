"""What cannot be read is refused in words, bounded, and never through a link."""

import errno
import json
import os

import nbformat
import pytest

from autograder.grading.cells import NotebookRecord, notebook_record
from autograder.grading.submission import reading
from autograder.grading.submission.reading import Unreadable, fingerprint, plain_files, read_submission
from autograder.grading.submission.restore import restore


def notebook(*cells, **more):
    return {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": list(cells), **more}


def code(source, **metadata):
    return {
        "cell_type": "code",
        "id": "a",
        "metadata": metadata,
        "source": source,
        "outputs": [],
        "execution_count": None,
    }


@pytest.fixture
def path(tmp_path):
    folder = tmp_path / "submitted/ann/scara"
    folder.mkdir(parents=True)
    return folder / "scara.ipynb"


BROKEN = {
    "empty": (b" \n", "empty"),
    "truncated": (json.dumps(notebook(code("x = 1")))[:-20].encode(), "cut off"),
    "utf-16": (json.dumps(notebook()).encode("utf-16"), "not UTF-8"),
    "a list": (b"[]", "not a Jupyter notebook"),
    "another JSON": (b'{"cells": []}', "not a Jupyter notebook"),
    "cells are no list": (json.dumps({**notebook(), "cells": {}}).encode(), "not a Jupyter notebook"),
    "old format": (b'{"nbformat": 3, "worksheets": []}', "old or unknown format"),
    "format as text": (json.dumps({**notebook(), "nbformat": "4"}).encode(), "old or unknown format"),
    "a cell is no cell": (json.dumps(notebook(code("x"), 7)).encode(), "cell 2 is not"),
    "unknown cell type": (json.dumps(notebook({**code("x"), "cell_type": "heading"})).encode(), "cell 1 is not"),
    "source is a number": (json.dumps(notebook({**code("x"), "source": 3})).encode(), "source of cell 1"),
    "too much text": (json.dumps(notebook(code("x" * 600_000))).encode(), "600,000 characters"),
    "too many cells": (json.dumps(notebook(*[code("")] * 1001)).encode(), "more than 1000 cells"),
    "deep": (b"[" * 100_000 + b"]" * 100_000, "nested"),
    "deep inside": (json.dumps(notebook()).replace("{}", '{"a":' * 50_000 + "1" + "}" * 50_000).encode(), "nested"),
}


@pytest.mark.parametrize("content, words", BROKEN.values(), ids=BROKEN)
def test_broken_files_are_refused_in_words(path, content, words):
    path.write_bytes(content)
    with pytest.raises(Unreadable, match=words):
        read_submission(path)


def test_a_huge_file_is_not_read(path):
    with path.open("wb") as file:
        file.truncate(reading.MAX_FILE + 1)
    with pytest.raises(Unreadable, match="larger than 100 MiB"):
        read_submission(path)


PICTURE = "QUJD" * (3 << 20)
NEVER_READ = {
    "NaN": ("[", '{"data": {"application/json": [NaN, -Infinity]}}', "]"),
    "an endless number": ("[", "9" * 5000, "]"),
    "12 MiB of pictures": ("[", json.dumps({"data": {"image/png": PICTURE}}), "]"),
    "depth": ("[" * 100_000, "", "]" * 100_000),
    "brackets in texts": ("[", r'"[[[{\"]]"', "]"),
    "no JSON": ("[", "<<>> ,,", "]"),
    "an object": ("{", '"outputs": [1, {"cells": []}]', "}"),
}


@pytest.mark.parametrize("outputs", NEVER_READ.values(), ids=NEVER_READ)
def test_outputs_are_never_read(path, outputs):
    """Whatever a cell displayed at home, its source is what counts."""
    text = json.dumps(notebook(code("x = 1"), {**code("y = 2"), "outputs": "HERE"}, code('"outputs": ["')))
    path.write_text(text.replace('"HERE"', "".join(outputs)))
    assert [cell.source for cell in read_submission(path).cells] == ["x = 1", "y = 2", '"outputs": ["']


@pytest.mark.parametrize("number", ["NaN", "-Infinity", "9" * 5000, "1e999"])
def test_a_number_that_is_never_read_does_no_harm(path, number):
    path.write_text(json.dumps({**notebook(code("x")), "metadata": {"a": "HERE"}}).replace('"HERE"', number))
    assert [cell.source for cell in read_submission(path).cells] == ["x"]


def test_more_brackets_than_any_notebook_has_are_refused(path, monkeypatch):
    monkeypatch.setattr(reading, "MAX_TOKENS", 1000)
    path.write_text(json.dumps(notebook({**code("x"), "outputs": [[]] * 1000})))
    with pytest.raises(Unreadable, match="more than 1,000 brackets and texts; clear its outputs"):
        read_submission(path)


def test_pictures_that_are_too_large_are_left_out_and_said(path, released):
    text = {"cell_type": "markdown", "metadata": {}, "source": "![](attachment:a.png)"}
    path.write_text(json.dumps(notebook(code("x"), {**text, "attachments": {"a.png": {"image/png": PICTURE}}})))
    nb = read_submission(path)
    assert [cell.source for cell in nb.cells] == ["x", "![](attachment:a.png)"]
    assert notebook_record(restore(nb, released)).repairs[0].startswith("its pasted pictures hold 12 MiB")


def test_a_folder_in_the_notebooks_place_is_refused(path):
    path.mkdir()
    with pytest.raises(Unreadable, match="not a regular file"):
        read_submission(path)


@pytest.mark.parametrize("fault", [errno.EACCES, errno.EIO, errno.EMFILE])
def test_trouble_of_the_machine_is_not_the_students(path, monkeypatch, fault):
    path.write_text(json.dumps(notebook(code("x"))))

    def refuse(*arguments):
        raise OSError(fault, os.strerror(fault))

    monkeypatch.setattr(os, "open", refuse)
    with pytest.raises(OSError, match="scara.ipynb"):
        read_submission(path)


def test_a_missing_notebook_names_the_file_that_is_there(path):
    with pytest.raises(Unreadable, match="there is no scara.ipynb in the folder$"):
        read_submission(path)
    path.with_name("scara (1).ipynb").write_text("{}")
    with pytest.raises(Unreadable, match=r"but scara \(1\).ipynb; rename it"):
        read_submission(path)


@pytest.mark.parametrize("level", ["file", "folder", "student"])
def test_links_are_not_followed(path, tmp_path, level):
    path.write_text(json.dumps(notebook(code("secret"))))
    secret = {"file": path, "folder": path.parent, "student": path.parent.parent}[level]
    elsewhere = tmp_path / "elsewhere"
    secret.rename(elsewhere)
    secret.symlink_to(elsewhere)
    with pytest.raises(Unreadable, match="is a link"):
        read_submission(path)


def test_a_pipe_does_not_block(path):
    os.mkfifo(path)
    with pytest.raises(Unreadable, match="not a regular file"):
        read_submission(path)


def test_only_type_source_pictures_and_claims_survive(path):
    cell = code(
        ["x = ", "1\n"], nbgrader={"grade_id": "scara-T04", "points": 99, "grade": True}, autograder={"share": 1}
    )
    text = {"cell_type": "markdown", "metadata": {"nbgrader": "no"}, "source": "![](attachment:a.png)"}
    text["attachments"] = {
        "a.png": {"image/png": "QUJD"},
        "b.png": {"image/png": '"><script>'},
        "c": {"text/html": "QUJD"},
        "d": {"image/svg+xml": "QUJD"},
        "e": {"text/plain": "x", "image/jpeg": ["QUJD\n", "REVG"]},
    }
    raw = notebook(cell, text, metadata={"kernelspec": {"name": "julia\ud800"}, "widgets": {}})
    path.write_text(json.dumps(raw))
    nb = read_submission(path)
    nbformat.validate(nb)
    assert nb.cells[0].source == "x = 1\n" and nb.cells[0].metadata == {"nbgrader": {"grade_id": "scara-T04"}}
    assert nb.cells[1].metadata == {} and nb.cells[1].attachments == {
        "a.png": {"image/png": "QUJD"},
        "e": {"image/jpeg": "QUJD\nREVG"},
    }
    said = "3 of its pasted pictures cannot be shown (PNG, JPEG, GIF and WebP can)"
    assert notebook_record(nb) == NotebookRecord(kernel="julia?", repairs=(said,)) and nb.metadata.keys() == {
        "autograder"
    }


@pytest.mark.parametrize("claim", [1, None, [], {"a": 1}, True])
def test_odd_claims_are_no_claims(path, claim):
    path.write_text(json.dumps(notebook(code("x", nbgrader={"grade_id": claim}), code("y", nbgrader=claim))))
    assert [cell.metadata for cell in read_submission(path).cells] == [{}, {}]


def test_lone_surrogates_can_be_written_again(path, tmp_path):
    path.write_text(json.dumps(notebook(code("s = '\ud800'"))))
    nbformat.write(read_submission(path), tmp_path / "out.ipynb")


def test_plain_files_are_the_regular_ones(path):
    folder = path.parent
    (folder / "data").mkdir()
    (folder / "data/points.csv").write_text("1")
    (folder / "link.csv").symlink_to("/etc/passwd")
    (folder / "up").symlink_to("/etc")
    os.mkfifo(folder / "pipe")
    assert [str(file.relative_to(folder)) for file in plain_files(folder)] == ["data/points.csv"]


def test_the_fingerprint_sees_every_change(path):
    path.write_text("a")
    seen = {fingerprint(path.parent, b"release"), fingerprint(path.parent, b"other release")}
    path.write_text("b")
    seen.add(fingerprint(path.parent, b"release"))
    (path.parent / "more.py").write_text("")
    seen.add(fingerprint(path.parent, b"release"))
    assert len(seen) == 4
    assert fingerprint(path.parent, b"release") in seen
