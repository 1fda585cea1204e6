"""A page costs a bounded amount of work, whatever a student wrote, and is always there."""

import json
import os
import re

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output, new_raw_cell
from traitlets.config import Config

from autograder.grading import rendering
from autograder.grading.rendering import Budget, Renderer

pytestmark = pytest.mark.slow

NAMES = ("markdown2html", "highlight_code", "ansi2html", "clean_html", "strip_files_prefix")
FILTERS = {name: f"autograder.grading.rendering.{name}" for name in NAMES}
HALF_A_MILLION = 500_000


def printed(text):
    return new_code_cell("x", outputs=[new_output("stream", name="stdout", text=text)])


def markdown(text, count):
    return [new_markdown_cell(text) for _ in range(count)]


HOSTILE = {
    "25 fences of nested f-strings": markdown("```python\n" + "f'{" * 6_600 + "\n```", 25),
    "one cell of nested f-strings": [new_code_cell("f'{" * 160_000)],
    "cells of nested f-strings": [new_code_cell("f'{" * 6_600) for _ in range(25)],
    "open emphasis": markdown("***a" * 5_000, 25),
    "open brackets": markdown("[" * 20_000, 25),
    "open links": markdown("[a](" * 5_000, 25),
    "quotes within quotes": markdown("> " * 10_000, 25),
    "lists within lists": markdown("- " * 10_000, 25),
    "deep lists": markdown("\n".join("  " * i + "- a" for i in range(195)), 25),
    "a huge table": markdown("|a" * 6_000 + "\n" + "|-" * 3_900, 25),
    "open formulas": markdown("\\begin{a}" * 2_200, 25),
    "odd dollars": markdown("$" * 19_999, 25),
    "back ticks": markdown("`a" * 10_000, 25),
    "tags within tags": markdown("<b>" * 6_000, 25),
    "open strings": [new_code_cell("'''\n" + '"' * 19_000) for _ in range(25)],
    "open brackets in code": [new_code_cell("([{" * 6_000) for _ in range(25)],
    "colours": [printed("\x1b[31m\x1b[1mx" * 100_000)],
    "colours in small pieces": [printed("\x1b[31m\x1b[1mx" * 1_900) for _ in range(50)],
    "open colours": [printed("\x1b[" * HALF_A_MILLION)],
    "raw tags": [new_raw_cell("<b>" * 160_000)],
    "pictures of tags": [
        new_code_cell("x", outputs=[new_output("display_data", {"image/svg+xml": "<svg><g>" * 60_000})])
    ],
    "many cells": [new_code_cell("f'{" * 160) for _ in range(1000)],
}


def page(cells):
    """The page as HTML; nbgrader's pages of feedback and of formgrader extend the same template."""
    from nbconvert.exporters import HTMLExporter

    exporter = HTMLExporter(config=Config(HTMLExporter={"filters": FILTERS, "template_name": "classic"}))
    return exporter.from_notebook_node(new_notebook(cells=cells))[0]


@pytest.fixture
def spent(monkeypatch):
    """What each page was given and took, as (seconds, HTML, text as typed) that were left."""
    budgets = []

    def recorded():
        budgets.append(Budget())
        return budgets[-1]

    monkeypatch.setattr(rendering, "Budget", recorded)
    return budgets


@pytest.mark.slow
@pytest.mark.parametrize("cells", HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_page_stays_within_its_budget(cells, monkeypatch, spent):
    asked = []
    render = Renderer.render

    def watched(self, kind, text, budget, pictures=()):
        before = budget.seconds
        html = render(self, kind, text, budget, pictures)
        asked.append(before - budget.seconds)
        return html

    monkeypatch.setattr(Renderer, "render", watched)
    html = page(cells)
    assert sum(asked) < 2 * rendering.PAGE_SECONDS
    assert len(html) < len(page([])) + rendering.PAGE_HTML + 6 * rendering.PAGE_TEXT + 2_000 * len(cells)


def test_an_honest_page_is_laid_out(small):
    cells = [*small.solution().cells, printed("\x1b[31mred\x1b[0m plain")]
    html = page(cells)
    assert '<span class="kn">from</span>' in html and "SCARA</h1>" in html
    assert '<span class="ansi-red-fg">red</span>' in html and "\x1b" not in html


def test_what_is_too_long_is_shown_as_typed_and_cut():
    html = rendering.highlight_code({}, "<b>" + "x" * 30_000)
    assert html.startswith('<div class="highlight"><pre>&lt;b&gt;xxx')
    assert "[... 10,003 further characters are not shown]" in html
    assert rendering.markdown2html({}, "$$" * 20_000).startswith("<pre>$$")
    assert rendering.ansi2html({}, "\x1b[31m<" * 20_000).startswith("&lt;&lt;")


def context(**resources):
    return {"cell": new_code_cell("x"), "resources": resources}


def test_all_texts_of_a_page_share_a_budget_and_the_graders_own_have_another():
    spent = Budget(seconds=0.0, typed=2)
    shared = context(rendering=spent)
    assert rendering.markdown2html(shared, "**abc**") == "<pre>**\n[... 5 further characters are not shown]</pre>"
    shared["cell"].metadata["nbgrader"] = {"grade": True, "solution": False, "grade_id": "scara-T04"}
    assert "<strong>abc</strong>" in rendering.markdown2html(shared, "**abc**")
    assert "<strong>abc</strong>" in rendering.markdown2html({}, "**abc**")


def test_a_large_picture_is_shown_and_costs_nothing_of_the_budget():
    cell = new_markdown_cell("*See* ![it](attachment:a.png)")
    cell["attachments"] = {"a.png": {"image/png": "QUJD" * 2_000_000}}
    html = page([cell, new_markdown_cell("**after**")])
    assert "<em>See</em>" in html and f'src="data:image/png;base64,{cell.attachments["a.png"]["image/png"]}"' in html
    assert "<strong>after</strong>" in html


def test_a_renderer_that_was_stopped_starts_again():
    renderer, budget = Renderer(), Budget(seconds=0.01)
    assert renderer.render("markdown", "***a" * 5_000, budget) is None
    assert budget.seconds <= 0
    assert renderer.render("markdown", "*a*", Budget()) == "<p><em>a</em></p>\n"
    renderer._stop()


def test_a_process_forked_from_a_grader_has_a_renderer_of_its_own():
    rendering.RENDERER.render("markdown", "started", Budget())
    children = []
    for number in range(2):
        if (child := os.fork()) == 0:
            mine = [rendering.RENDERER.render("markdown", f"{number} {text}", Budget()) for text in range(20)]
            os._exit(0 if all(f"{number} {text}" in html for text, html in enumerate(mine)) else 1)
        children.append(child)
    assert [os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) for child in children] == [0, 0]
    assert "still ours" in rendering.RENDERER.render("markdown", "still ours", Budget())


def test_a_text_that_cannot_be_laid_out_does_not_end_the_renderer():
    renderer = Renderer()
    assert renderer.render("markdown", "<b>" * 500, Budget()) is None
    process = renderer._process
    assert renderer.render("code", "x = 1", Budget()) and renderer._process is process
    renderer._stop()


def test_formgrader_uses_the_same_filters(small):
    source = (small.REPOSITORY / "nbgrader_config.py").read_text()
    assert all(re.search(name, source) for name in FILTERS)


def test_a_hostile_submission_is_graded_like_any_other(needs_sandbox, small, course_copy, released, capsys):
    from autograder import cli

    nb = small.answered(released)
    nb.cells += HOSTILE["25 fences of nested f-strings"][:10]
    small.hand_in(course_copy, "ann", nbformat.from_dict(json.loads(json.dumps(nb))))
    assert cli.main(["grade", "scara", "--json", "--course", str(course_copy)]) == 0
    assert json.loads(capsys.readouterr().out)["score"] == 20
    html = (course_copy / "feedback/ann/scara/scara.html").read_text()
    assert "f&#x27;{f&#x27;{" in html


def test_ctrl_c_at_the_terminal_is_for_the_grader():
    """It reaches every process of the group; a page laid out at that moment would lack its texts, and be stored."""
    renderer = Renderer()
    assert renderer.render("markdown", "*a*", Budget())
    assert os.getpgid(renderer._process.pid) != os.getpgid(0)
    renderer._stop()
