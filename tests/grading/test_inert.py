"""What students wrote can be looked at and does nothing."""

import html
import re
import sysconfig

import pytest
from nbformat.v4 import new_output

from autograder.grading.entries import comment, note_of, score
from autograder.grading.inert import clean_markdown, inert_outputs, spreadsheet_cell, terminal_text, with_pictures

ATTACKS = [
    "<script>alert(1)</script>",
    "<img src=x onerror=alert(1)>",
    "<svg onload=alert(1)></svg>",
    "[x](javascript:alert(1))",
    "[x](JaVaScRiPt:alert(1))",
    "[x](data:text/html;base64,PHNjcmlwdD4=)",
    '<a href="java&#10;script:alert(1)">x</a>',
    "![x](javascript:alert(1))",
    '<iframe src="https://example.org"></iframe>',
    '<form action="https://example.org"><input name="x"></form>',
    '<div style="position:fixed;inset:0" id="submit" class="btn">x</div>',
    '<style>body{display:none}</style>',
    '<math><mtext></p><style><img src="</style><img src=1 onerror=alert(1)>">',
    "$x<script>alert(1)</script>$",
    "$$\\begin{a}<img src=x onerror=alert(1)>\\end{a}$$",
    "```python\n</pre><script>alert(1)</script>\n```",
    r"$\href{javascript:alert(1)}{x}$",
    r"$\text{<img src=x onerror=alert(1)>} \class{btn}{x} \style{position:fixed}{y}$",
    "![x](attachment:missing.png)",
    "<base href='https://example.org'><meta http-equiv=refresh content=0><link rel=stylesheet href=x>",
]  # fmt: skip


@pytest.mark.parametrize("text", ATTACKS)
def test_markdown_cannot_act(text):
    page = clean_markdown(text)
    tags = re.findall(r"<\s*([a-zA-Z]+)([^>]*)>", page)
    assert not {name.lower() for name, _ in tags} & {
        "script",
        "svg",
        "iframe",
        "form",
        "input",
        "style",
        "base",
        "meta",
        "link",
    }
    for name, attributes in tags:
        assert not re.search(r"\bon\w+\s*=|javascript:|data:text|style=|\bid=|btn", attributes, re.I), (
            name,
            attributes,
        )


def test_formulas_need_no_script():
    page = clean_markdown(r"From ${}^0T_E$ follows $\operatorname{atan2}(y, x)$." + "\n\n$$\\frac{1}{2}$$")
    assert page.count("<math") == 3 and '<math display="block">' in page and "<mfrac>" in page
    assert "$" not in page and "\\" not in page
    assert '<mi mathvariant="normal">a</mi>' in page


def test_brackets_are_as_high_as_their_matrix():
    """MathML stretches them to all that stands in their row."""
    two = r"\begin{pmatrix} a \\ 1 \end{pmatrix} = \begin{pmatrix} \begin{bmatrix} b \end{bmatrix} \\ 1 \end{pmatrix}"
    page = clean_markdown(f"$${two}$$")
    assert page.count("<mrow><mo>(</mo><mtable>") == 2 and page.count("<mrow><mo>[</mo><mtable>") == 1


def test_what_is_no_formula_is_shown_as_typed():
    assert "<math" not in clean_markdown("It costs 5 $ and 6 $ more; <math><mi>x</mi></math>.")
    assert "$ and 6 $" in clean_markdown("It costs 5 $ and 6 $ more.")
    deep = "{" * 3000
    assert deep in clean_markdown(f"${deep}$")


def test_folders_of_this_machine_are_not_shown():
    where = f"{sysconfig.get_path('purelib')}/sympy/core/expr.py"
    outputs = [
        {"output_type": "error", "ename": "E", "evalue": "", "traceback": [f"File {where}:12, in f"]},
        {"output_type": "stream", "name": "stderr", "text": f"{where}:3: UserWarning: no"},
    ]
    failed, warned = inert_outputs(outputs, 1)
    assert failed.traceback == ["File sympy/core/expr.py:12, in f"]
    assert warned.text == "sympy/core/expr.py:3: UserWarning: no"


def test_markdown_stays_readable():
    page = clean_markdown(
        "# Title\n\n**bold** $a<b$ and `code`\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\n```python\nx = 1\n```"
    )
    for piece in (
        "<h1>Title</h1>",
        "<strong>bold</strong>",
        "<mi>a</mi><mo>&lt;</mo><mi>b</mi>",
        "<code>code</code>",
        "<td>1</td>",
        '<span class="n">x</span>',
    ):
        assert piece in page


@pytest.mark.parametrize(
    "text", ["a <script>alert(1)</script> b", "<script>alert(1)</script>", "x <T> y", "<b><style>p{}</style></b>"]
)
def test_tags_that_are_not_let_through_are_shown_as_typed(text):
    page = clean_markdown(text)
    typed = re.findall(r"</?(?:script|style|T)>", text)
    assert typed and all(html.escape(tag) in page for tag in typed)


def test_harmless_html_is_let_through():
    page = clean_markdown('x<sub>1</sub> <a href="https://example.org" title="t">y</a>\n\n<!-- nothing -->')
    assert 'x<sub>1</sub> <a href="https://example.org" title="t">y</a>' in page and "nothing" not in page


ATTACHED = {"a.png": {"image/png": "QUJD"}, "ä b.webp": {"image/webp": "REVG"}, "no.svg": {"image/svg+xml": "QUJD"}}


@pytest.mark.parametrize("name, shown", [
    ("a.png", ' src="data:image/png;base64,QUJD"'), ("%C3%A4%20b.webp", ' src="data:image/webp;base64,REVG"'),
    ("no.svg", ""), ("gone.png", ""),
])  # fmt: skip
def test_an_attached_picture_is_shown(name, shown):
    page = with_pictures(clean_markdown(f"**see** ![it](attachment:{name})", list(ATTACHED)), ATTACHED)
    assert f'<strong>see</strong> <img{shown} alt="it">' in page.replace("<img  ", "<img ")


def test_a_picture_is_put_in_once_and_nothing_else_is_put_in():
    page = clean_markdown("![a](attachment:a.png)" * 50 + '`src="attachment:0"` <img src="attachment:7">', ["a.png"])
    page = with_pictures(page, {"a.png": {"image/png": "QUJD"}})
    assert page.count("QUJD") == 1 and "attachment:7" not in page
    bad = {"a.png": {"image/png": '"><script>'}}
    assert "script" not in with_pictures(clean_markdown("![a](attachment:a.png)", ["a.png"]), bad)


@pytest.mark.parametrize("text", ["<b>" * 200, "<div><span>" * 100 + "x" + "</span></div>" * 100])
def test_deep_nesting_is_refused(text):
    with pytest.raises(ValueError, match="nested too deep"):
        clean_markdown(text)
    assert clean_markdown("<b>a</b> <br>" * 200)


def test_outputs_keep_text_formulas_and_pictures_only():
    html = {
        "text/html": "<script>1</script>",
        "application/javascript": "alert(1)",
        "text/plain": "x",
        "image/png": "QUJD\n",
    }
    bad = {
        "image/png": '"><script>',
        "image/svg+xml": "<svg/>",
        "application/vnd.jupyter.widget-view+json": {"model_id": "1"},
    }
    outputs = [
        new_output("display_data", data=html, metadata={"text/html": {"isolated": True}}),
        new_output("execute_result", data=bad, execution_count=99),
        new_output("display_data", data={"text/html": "<b>only</b>"}),
        new_output("stream", name="stderr", text=["a", "b"]),
        {"output_type": "update_display_data", "data": {}},
        {"output_type": "error", "ename": 3, "evalue": "e", "traceback": "no list"},
    ]
    kept = inert_outputs(outputs, 4)
    assert [dict(output.data) for output in kept[:2]] == [
        {"text/plain": "x", "image/png": "QUJD\n"},
        {"image/svg+xml": "<svg/>"},
    ]
    assert kept[0].metadata == {} and kept[1].execution_count == 4
    assert kept[2].text == "ab" and kept[3].traceback == [] and len(kept) == 4


def test_terminal_text_holds_no_control():
    assert terminal_text("a\x1b[2J\nb\u202ec\x07\x9b") == "a b c"
    assert terminal_text("x" * 300, 10) == "xxxxxxx..."


@pytest.mark.parametrize(
    "share, most, expected", [(0, 3, 0), (1, 3, 3), (0.5, 3, 1.5), (1 / 3, 2, 0.67), (1, 0.1 + 0.2, 0.1 + 0.2)]
)
def test_points_follow_the_share(share, most, expected):
    assert score(share, most) == expected
    assert 0 <= score(share, most) <= most


@pytest.mark.parametrize("share", [-0.1, 1.01, float("nan"), float("inf")])
def test_no_other_share_becomes_points(share):
    with pytest.raises(ValueError, match="between 0 and 1"):
        score(share, 3)


def test_a_note_survives_the_gradebook():
    assert note_of(comment("sign_of_d2")) == "sign_of_d2"
    assert note_of(comment("degrees+sign_of_d2")) == "degrees+sign_of_d2"
    assert note_of("No response.") is None and note_of(None) is None and note_of("note: <b>") is None


@pytest.mark.parametrize(
    "text", ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "\uff1d1+1", "\uff0b1", "\uff0d1", "\uff20SUM(A1)"]
)
def test_a_spreadsheet_sees_no_formula(text):
    assert spreadsheet_cell(text) == f"'{text}"
    assert spreadsheet_cell(-1.5) == -1.5 and spreadsheet_cell(None) == "" and spreadsheet_cell("ann") == "ann"
