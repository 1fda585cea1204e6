"""Links of the texts to files that are no pages: the README's place is the front page, folders stand on GitHub."""

import re

from sphinx.application import Sphinx

FRONT = re.compile(r"\]\((?:\.\./)*README\.md\)")


def read(app: Sphinx, page: str, source: list[str]) -> None:
    source[0] = FRONT.sub(f"](/{app.config.root_doc}.md)", source[0])


def setup(app: Sphinx) -> dict:
    app.connect("source-read", read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
