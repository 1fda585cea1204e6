"""The site: every lecture and exercise has its place in it, its links are looked after. `make site` builds the whole."""

import json
import re
import sys
from fnmatch import fnmatch
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
pytest.importorskip("sphinx_book_theme", reason="the site's packages are not installed: make setup")
sys.path[:0] = [str(DOCS), str(DOCS / "extensions")]

import check_links  # noqa: E402
import elsewhere  # noqa: E402
import statements  # noqa: E402

TOCTREE = re.compile(r"```\{toctree\}\n((?:.|\n)*?)```")
NOTEBOOKS = [*ROOT.glob("course/*.ipynb"), *ROOT.glob("exercises/*/*.ipynb")]


def entries():
    """All lines of the front page's tables of contents, as paths from the root."""
    for block in TOCTREE.findall((DOCS / "index.md").read_text()):
        for line in block.splitlines():
            if line.strip() and not line.startswith(":"):
                yield (
                    (DOCS / line).resolve().relative_to(ROOT).as_posix()
                    if "*" not in line
                    else line.removeprefix("../")
                )


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_every_notebook_has_its_place_in_the_contents(notebook):
    name = notebook.relative_to(ROOT).with_suffix("").as_posix()
    assert sum(fnmatch(name, entry) for entry in entries()) == 1


def test_every_text_has_its_place_in_the_contents():
    pages = {path.relative_to(ROOT).with_suffix("").as_posix() for path in DOCS.glob("*.md")} - {"docs/index"}
    assert not (pages | {"CONTRIBUTING", "CHANGELOG"}) - set(entries()), "name it in a toctree of docs/index.md"


def test_the_configuration_can_be_read_and_names_files_that_are_there(monkeypatch):
    monkeypatch.setenv("REPOSITORY", "somebody/course")
    settings = {"__file__": str(DOCS / "conf.py")}
    exec(compile((DOCS / "conf.py").read_text(), "conf.py", "exec"), settings)
    assert settings["html_theme_options"]["repository_url"] == "https://github.com/somebody/course"
    assert set(settings["html_theme_options"]["launch_buttons"]) >= {"colab_url", "binderhub_url"}
    named = [
        *settings["html_static_path"],
        *settings["html_extra_path"],
        *(f"_static/{css}" for css in settings["html_css_files"]),
    ]
    assert all((DOCS / name).exists() for name in named)
    assert all(list(ROOT.glob(pattern)) for pattern in settings["include_patterns"])


def test_an_exercise_is_a_statement_without_outputs_for_answers_that_are_not_there():
    notebook = statements.without_verdicts(json.loads((ROOT / "exercises/scara/scara.ipynb").read_text()))
    silent = {cell["id"] for cell in notebook["cells"] if "remove-output" in cell["metadata"].get("tags", ())}
    assert {"scara-table-answer", "picture-table", "scara-table"} <= silent
    assert not silent & {"imports", "figure-side", "figure-top"}


def test_pictures_of_the_readme_stand_alone():
    """MyST takes them for pictures, and brings their files along, only where no other HTML is around them."""
    assert elsewhere.linked('<p>\n<img src="docs/a.png" alt="a">\n</p>\n', ROOT) == '<img src="/docs/a.png" alt="a">\n'


def test_links_of_the_readme_find_the_pages():
    text = elsewhere.linked(
        "`course/03_scara.ipynb` `exercises/scara/` [a](docs/a.md) [b](https://b.org) [c](#c)", ROOT
    )
    assert text == (
        "[SCARA: table and direct model](/course/03_scara.ipynb) [scara](/exercises/scara/scara.ipynb)"
        " [a](/docs/a.md) [b](https://b.org) [c](#c)"
    )


FAULTS = {
    '<a href="nowhere.html">': "nowhere.html leads nowhere",
    '<a href="b.html#c">': "b.html#c: the page has no such place",
    '<a href="../outside.html">': "../outside.html leads nowhere",
    '<a href="#top">': "#top: the page has no such place",
    '<a href="http://">': "http://: no host",
    '<a href="javascript:act()">': "javascript:act(): a scheme that browsers do not open",
    '<img src="https://cdn.example.org/a.png">': "https://cdn.example.org/a.png is fetched from another server",
    '<script src="//cdn.example.org/a.js"></script>': "//cdn.example.org/a.js is fetched from another server",
    '<script src="a.js"></script>': "a.js leads nowhere",
    "x" * (check_links.PAGE_BYTES + 1): "3.0 MB, more than 3",
}


@pytest.mark.parametrize("html", FAULTS, ids=lambda html: html[:40])
def test_a_fault_of_a_page_is_found(tmp_path, html):
    (tmp_path / "b.html").write_text('<p id="a"><a href="b.html#a">a</a> <a href="https://example.org/x">x</a></p>')
    (tmp_path / "index.html").write_text(html)
    assert check_links.faults(tmp_path) == [f"index.html: {FAULTS[html]}"]


def test_styles_and_scripts_fetch_nothing(tmp_path):
    (tmp_path / "index.html").write_text("<p>")
    (tmp_path / "a.css").write_text('@font-face { src: url("https://fonts.example.org/a.woff2"); } p { fill: url(#b) }')
    (tmp_path / "a.js").write_text('const x = "https://example.org"; import("https://cdn.example.org/a.js")')
    assert len(check_links.faults(tmp_path)) == 2
