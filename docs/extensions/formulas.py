"""Formulas as MathML in the pages: no script and no network, dark and printed like the text around them."""

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.math import get_node_equation_number

from autograder.grading.inert import formula


def inline(self, node: nodes.math) -> None:
    self.body.append(formula(node.astext()))
    raise nodes.SkipNode


def block(self, node: nodes.math_block) -> None:
    number = get_node_equation_number(self, node) if node["number"] else ""
    self.body.append(self.starttag(node, "div", CLASS="math"))
    self.body.append(f"{formula(node.astext(), 'block')}{f'<span class=eqno>({number})</span>' if number else ''}</div>")
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict:
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    app.config.html_math_renderer = "mathml"
    return {"parallel_read_safe": True, "parallel_write_safe": True}
