"""Formulas as MathML in the pages: no script and no network, dark and printed like the text around them."""

import re
from html import unescape
from typing import Literal

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.math import get_node_equation_number

from autograder.grading.inert import formula

LOGGER = logging.getLogger(__name__)
SHORT = 20  # letters of TeX that surely fit on a phone
DOLLARS = re.compile(r"\$(?!\s)([^$<]+?)(?<!\s)\$")


def converted(node: nodes.Node, display: Literal["inline", "block"]) -> str:
    found = formula(node.astext(), display)
    if not found.startswith("<math"):
        LOGGER.warning("no formula: %s", node.astext(), location=node)
    return found


def in_line(tex: str, made: str) -> str:
    """A formula within a line; one that may be wider than a phone is marked, so that it can scroll by itself."""
    return made if len(tex) <= SHORT else f'<span class="long">{made}</span>'


def inline(self, node: nodes.math) -> None:
    self.body.append(in_line(node.astext(), converted(node, "inline")))
    raise nodes.SkipNode


def block(self, node: nodes.math_block) -> None:
    number = get_node_equation_number(self, node) if node["number"] else ""
    self.body.append(self.starttag(node, "div", CLASS="math"))
    self.body.append(f"{converted(node, 'block')}{f'<span class=eqno>({number})</span>' if number else ''}</div>")
    raise nodes.SkipNode


def typeset(found: re.Match) -> str:
    """What stands between two dollars in HTML, as MathML if it is a formula."""
    made = formula(unescape(found[1]))
    return in_line(found[1], made) if made.startswith("<math") else found[0]


def within_outputs(app: Sphinx, tree: nodes.document, page: str) -> None:
    """Formulas in the HTML that cells display, which a notebook's own page would typeset."""
    for node in list(tree.findall(nodes.raw)):
        if "text_html" in node.parent.get("classes", ()) and "<script" not in node.astext():
            text = DOLLARS.sub(typeset, node.astext())
            node.parent.replace(node, nodes.raw("", text, format="html"))


def setup(app: Sphinx) -> dict:
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    app.config.html_math_renderer = "mathml"
    app.connect("doctree-resolved", within_outputs)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
