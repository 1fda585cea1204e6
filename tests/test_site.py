"""The site: every lecture and exercise has its place in it, its links are looked after. `make site` builds the whole."""

import json
import re
import sys
from fnmatch import fnmatch
from io import BytesIO
from pathlib import Path

import pytest
from browser import Tab, without_browser
from PIL import Image

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
pytest.importorskip("sphinx_book_theme", reason="the site's packages are not installed: make setup")
sys.path[:0] = [str(DOCS), str(DOCS / "extensions")]

import check_links  # noqa: E402
import check_pages  # noqa: E402
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
    monkeypatch.setenv("DHKIT_SCENES", "")  # which it sets, and which is set back
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


# ---------------------------------------------------------------- in a browser

OPENED = {
    "<script>undefined_name()</script>": "ReferenceError: undefined_name is not defined",
    "<script>console.error('so', 1)</script>": "so 1",
    '<div style="width: 400px">wide</div>': "400 pixels wide on a screen of 320",
}


@pytest.mark.slow
@without_browser
def test_pages_are_opened_and_faults_are_found(tmp_path):
    head = '<meta charset="utf-8"><meta name="viewport" content="width=device-width"><body style="margin: 0">'
    for number, html in enumerate(OPENED):
        (tmp_path / f"{number}.html").write_text(head + html)
    (tmp_path / "3.html").write_text(f'{head}<img src="missing.png"><img src="http://127.0.0.1:9/a.png">')
    (tmp_path / "4.html").write_text(f'{head}<p id="a">right</p>')
    (tmp_path / "search.html").write_text(f'{head}<ul id="search-results"></ul>')
    found = check_pages.faults(tmp_path)
    assert found[:3] == [f"{number}.html: {words}" for number, words in enumerate(OPENED.values())]
    assert "3.html: it asks for http://127.0.0.1:9/a.png" in found
    assert any("3.html" in each and each.endswith("missing.png") for each in found)
    assert not any("4.html" in each for each in found)
    assert found[-1] == "search.html: nothing is found for 'singular'"


@pytest.mark.slow
@without_browser
def test_sliders_of_a_page_show_pictures_one_value_at_a_time(tmp_path):
    from dhkit.flipbook import flipbook

    def picture(values):
        buffer = BytesIO()
        Image.new("RGB", (100 + int(values["a"]), 100 + int(values["b"]))).save(buffer, format="png")
        return buffer.getvalue()

    book = flipbook(picture, {"a": (0, 8, 4), "b": (-40, 40, 0)})
    program = (DOCS / "_static/flipbook.js").read_text()
    (tmp_path / "page.html").write_text(f'<meta charset="utf-8">{book}<script>{program}</script>', encoding="utf-8")
    tab = Tab(tmp_path, 600, 400)
    try:
        tab.tell("Page.navigate", url=(tmp_path / "page.html").as_uri())
        tab.until("document.querySelectorAll('input').length === 2")
        shown = "(await document.querySelector('img').decode(), [...document.querySelectorAll('output')].map((each) => each.textContent))"
        size = "[document.querySelector('img').naturalWidth, document.querySelector('img').naturalHeight]"
        assert (tab.ask(shown), tab.ask(size)) == (["4", "0"], [104, 100])
        tab.ask("document.querySelectorAll('input')[1].focus()")
        tab.press("ArrowLeft", 2)
        assert (tab.ask(shown), tab.ask(size)) == (["4", "\N{MINUS SIGN}20"], [104, 80])
        tab.ask("document.querySelectorAll('input')[0].focus()")
        tab.press("ArrowRight")
        assert (tab.ask(shown), tab.ask(size)) == (["5", "0"], [105, 100])
        tab.press("ArrowLeft")
        assert (tab.ask(shown), tab.ask(size)) == (["4", "0"], [104, 100])
    finally:
        tab.close()
