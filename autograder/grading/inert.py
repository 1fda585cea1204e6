"""Makes what a student's notebook shows harmless: in a browser, in Markdown, in a terminal, in a spreadsheet."""

from __future__ import annotations

import os
import re
import sysconfig
from collections.abc import Iterable, Mapping, Sequence
from html import escape, unescape
from pathlib import Path
from typing import Literal
from urllib.parse import unquote

import nh3
from latex2mathml.converter import convert
from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath
from nbformat.notebooknode import NotebookNode
from pygments.token import STANDARD_TYPES

import dhkit

MAX_NESTING = 100  # tags within tags; what reads the page later on needs time with the square of it
PICTURES = ("image/png", "image/jpeg", "image/gif", "image/webp")
"""Pictures that can be pasted into a cell; SVG is not among them, as it is a program of its own."""

# The full-width ones begin a formula in East Asian spreadsheets.
_FORMULA = ("=", "+", "-", "@", "\t", "\r", "\uff1d", "\uff0b", "\uff0d", "\uff20")
_SHOWN = ("text/plain", "text/latex", "image/svg+xml", "image/png", "image/jpeg")
_LIBRARIES = sorted(
    {
        f"{folder}{os.sep}"
        for folder in (*map(sysconfig.get_path, ("purelib", "platlib", "stdlib")), Path(dhkit.__file__).parents[1])
    },
    key=len,
    reverse=True,
)
BASE64 = re.compile(r"[A-Za-z0-9+/=\s]*\Z")
_CONTROL = re.compile(
    r"(?:\x1b\[[0-9;?]*[A-Za-z]|[\x00-\x1f\x7f-\x9f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff])+"
)


def terminal_text(text: str, limit: int = 200) -> str:
    """`text` on one line, without control or direction characters, at most `limit` characters."""
    text = _CONTROL.sub(" ", text).strip()
    return text if len(text) <= limit else f"{text[: limit - 3]}..."


def without_markdown(feedback: str) -> str:
    """What the judge says, as plain text."""
    return unescape(re.sub(r"\\(.)", r"\1", feedback.replace("**", "")))


def spreadsheet_cell(value: object) -> object:
    """`value` for a spreadsheet: a text that a spreadsheet would take for a formula gets an apostrophe."""
    if value is None:
        return ""
    if isinstance(value, str) and value[:1] in _FORMULA:
        return f"'{value}"
    return value


def from_spreadsheet(text: str) -> str:
    """A text as it was before `spreadsheet_cell`."""
    return text[1:] if text[:1] == "'" and text[1:2] in _FORMULA else text


def inert_outputs(outputs: Iterable, count: int) -> list[NotebookNode]:
    """Outputs of a student's cell rebuilt from what can only be looked at: text, formulas and pictures.

    Parameters
    ----------
    outputs : iterable
        nbformat outputs from a sandbox.
    count : int
        Execution count shown beside results.
    """
    kept = (_inert(output, count) for output in outputs)
    return [output for output in kept if output is not None]


def shown(data: Mapping[str, str], **result: int | None) -> NotebookNode:
    """An output that displays `data`, by media type; a result if it is given an ``execution_count``.

    nbformat's own constructor validates each output by itself, which costs more than making them.
    """
    node = NotebookNode(output_type="display_data", metadata=NotebookNode(), data=NotebookNode(data))
    if result:
        node.update(output_type="execute_result", **result)
    return node


def _inert(output: dict, count: int) -> NotebookNode | None:
    kind = output.get("output_type")
    if kind == "stream":
        name = "stderr" if output.get("name") == "stderr" else "stdout"
        return NotebookNode(output_type="stream", name=name, text=_without_folders(_joined(output.get("text"))))
    if kind == "error":
        lines = output.get("traceback")
        return NotebookNode(
            output_type="error",
            ename=_joined(output.get("ename")),
            evalue=_joined(output.get("evalue")),
            traceback=[_without_folders(_joined(line)) for line in lines] if isinstance(lines, list) else [],
        )
    if kind not in ("display_data", "execute_result") or not isinstance(output.get("data"), dict):
        return None
    data = {mime: _joined(output["data"][mime]) for mime in _SHOWN if mime in output["data"]}
    data = {mime: text for mime, text in data.items() if mime not in ("image/png", "image/jpeg") or BASE64.match(text)}
    if not data:
        return None
    return shown(data, execution_count=count) if kind == "execute_result" else shown(data)


def _without_folders(text: str) -> str:
    """A text without the folders in which this machine keeps its libraries."""
    for folder in _LIBRARIES:
        text = text.replace(folder, "")
    return text


def _joined(text: object) -> str:
    """One clean string from nbformat's string or list of strings."""
    if isinstance(text, list):
        text = "".join(line for line in text if isinstance(line, str))
    return text.encode("utf-8", "replace").decode("utf-8") if isinstance(text, str) else ""


def formula(source: str, display: Literal["inline", "block"] = "inline") -> str:
    """A formula in LaTeX as MathML, which browsers show without a script and without a network; as it is, if it is none."""
    try:
        return convert(_MATRIX.sub(_grouped, _NAMES.sub(r"\\mathrm", source)), display=display)
    except Exception:  # whatever the converter runs into
        return f"<code>{escape(source, quote=False)}</code>"


def _grouped(mark: re.Match) -> str:
    """The begin or end of a matrix, as that of a group: its brackets are as high as it is, not as high as the line."""
    return f"{{{mark[0]}" if mark[1] == "begin" else f"{mark[0]}}}"


class _Renderer(IPythonRenderer):
    """Stock rendering, except that tags which are not let through are shown as they were typed, and formulas are MathML.

    An attached picture is named by its number; a missing one is said instead of ending the page.
    """

    def inline_math(self, body: str) -> str:
        # Between two prices is no formula.
        return f"${escape(body, quote=False)}$" if body != body.strip() else formula(body)

    def block_math(self, body: str) -> str:
        return formula(body, "block")

    def latex_environment(self, name: str, body: str) -> str:
        return formula(f"\\begin{{{name}}}{body}\\end{{{name}}}", "block")

    def block_html(self, html: str) -> str:
        return super().block_html(html) if _is_allowed(html) else f"<p>{escape(html)}</p>"

    def inline_html(self, html: str) -> str:
        return super().inline_html(html) if _is_allowed(html) else escape(html)

    def _embed_image_or_attachment(self, src: str) -> str:
        if not src.startswith("attachment:"):
            return src
        name, names = src.removeprefix("attachment:"), list(self.attachments)
        known = next((one for one in (name, unquote(name)) if one in names), None)
        return "missing-picture" if known is None else f"attachment:{names.index(known)}"


def clean_markdown(source: str, pictures: Sequence[str] = ()) -> str:
    """Markdown as HTML, with every tag and attribute that could act left out.

    Parameters
    ----------
    source : str
    pictures : sequence of str
        Names of the pictures attached to the cell; `with_pictures` puts them in.

    Raises
    ------
    ValueError
        If tags are nested more than `MAX_NESTING` deep.
    """
    renderer = _Renderer(escape=False, attachments={name: {} for name in pictures}, exclude_anchor_links=True)
    page = MarkdownWithMath(renderer=renderer).render(source)
    if _nesting(page) > MAX_NESTING:
        raise ValueError("nested too deep")
    return nh3.clean(
        page,
        tags=_TAGS | _MATHML,
        attributes=_ATTRIBUTES,
        attribute_filter=_attribute,
        url_schemes=_SCHEMES,
        link_rel=None,
    )


def with_pictures(page: str, attachments: Mapping[str, Mapping[str, str]]) -> str:
    """HTML made by `clean_markdown` with the attached pictures in it, each at the first place where it is shown."""
    forms = list(attachments.values())
    shown = set()

    def picture(place: re.Match) -> str:
        number = int(place[1])
        found = forms[number] if number < len(forms) else {}
        mime = next((mime for mime in PICTURES if BASE64.match(found.get(mime, "-"))), None)
        if mime is None or number in shown:
            return ""  # a browser shows the words that stand for the picture
        shown.add(number)
        return f'src="data:{mime};base64,{found[mime]}"'

    return _ATTACHED.sub(picture, page)


_TAGS = {
    "a", "abbr", "b", "blockquote", "br", "code", "dd", "del", "div", "dl", "dt", "em", "h1", "h2", "h3", "h4", "h5", "h6",
    "hr", "i", "img", "kbd", "li", "ol", "p", "pre", "s", "span", "strong", "sub", "sup", "table", "tbody", "td", "th",
    "thead", "tr", "u", "ul",
}  # fmt: skip
_ATTRIBUTES = {"*": {"align", "title"}, "a": {"href"}, "img": {"alt", "src"}, "ol": {"start"}}
_ATTRIBUTES |= {"div": {"class"}, "span": {"class"}}
_MATHML = {
    "math", "menclose", "mfrac", "mi", "mn", "mo", "mover", "mphantom", "mroot", "mrow", "mspace", "msqrt", "mstyle", "msub",
    "msubsup", "msup", "mtable", "mtd", "mtext", "mtr", "munder", "munderover",
}  # fmt: skip
"""Made from formulas only: whoever types such tags sees them as typed."""
_ATTRIBUTES |= {
    "math": {"display"},
    "menclose": {"notation"},
    "mfrac": {"linethickness"},
    "mi": {"mathvariant"},
    "mo": {"fence", "form", "maxsize", "minsize", "stretchy"},
    "mspace": {"width"},
    "mstyle": {"displaystyle", "scriptlevel"},
    "mtd": {"columnalign"},
}
_NAMES = re.compile(r"\\operatorname\b\*?")
_MATRIX = re.compile(r"\\(begin|end)\{[pbBvV]matrix\}")
_SCHEMES = {"http", "https", "mailto", "data", "attachment"}
_TAG = re.compile(r"</?\s*([a-zA-Z][^\s/>]*)")
_LINK = re.compile(r"(https?://|mailto:|#)\S*\Z")
_IMAGE = re.compile(r"(attachment:\d{1,9}|data:image/(png|jpeg);base64,[A-Za-z0-9+/=\s]*)\Z")
_ATTACHED = re.compile(r'src="attachment:(\d{1,9})"')
_EMPTY = {"br", "hr", "img"}
_CODE_CLASSES = frozenset(STANDARD_TYPES.values()) - {""} | {"highlight"}


def _nesting(page: str) -> int:
    """How deep tags of a page are nested at most, counted as if each that is opened were closed."""
    depth = deepest = 0
    for tag in _TAG.finditer(page):
        depth = max(0, depth - 1) if tag[0].startswith("</") else depth + (tag[1].lower() not in _EMPTY)
        deepest = max(deepest, depth)
    return deepest


def _is_allowed(html: str) -> bool:
    """True if every tag in a piece of HTML is one that is let through."""
    return all(name.lower() in _TAGS for name in _TAG.findall(html))


def _attribute(tag: str, name: str, value: str) -> str | None:
    """The value of an attribute that is let through, None for one that could act."""
    wanted = {"href": _LINK, "src": _IMAGE}.get(name)
    if wanted is not None:
        return value if wanted.match(value) else None
    return None if name == "class" and value not in _CODE_CLASSES else value
