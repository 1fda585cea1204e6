"""Texts that are read on GitHub too: their links to files and folders of the repository find the pages of the site."""

import json
import re
from pathlib import Path

from sphinx.application import Sphinx

README = re.compile(r"\]\((?:\.\./)*README\.md\)")
FOLDER = re.compile(r"\[([^]]+)\]\(([\w./-]+/)\)")
RELATIVE = re.compile(r'(\]\(|<img src=")(?=[\w.-]+(?:/[\w.-]+)*[)"])')
AROUND_PICTURES = re.compile(r"^</?p(?: [^>]*)?>\n", re.M)
LECTURE = re.compile(r"`course/(\w+)\.ipynb`")
EXERCISE = re.compile(r"`exercises/(\w+)/`")


def title(notebook: Path) -> str:
    """The heading of a notebook, without its mark."""
    first = json.loads(notebook.read_text(encoding="utf-8"))["cells"][0]["source"]
    return "".join(first).splitlines()[0].lstrip("# ")


def linked(text: str, root: Path) -> str:
    """A text of the repository's root: its links stand from there, names of notebooks in it lead to them."""
    text = RELATIVE.sub(r"\1/", AROUND_PICTURES.sub("", text))
    text = LECTURE.sub(lambda name: f"[{title(root / f'course/{name[1]}.ipynb')}](/course/{name[1]}.ipynb)", text)
    return EXERCISE.sub(r"[\1](/exercises/\1/\1.ipynb)", text)


def read(app: Sphinx, page: str, source: list[str]) -> None:
    """The README's place is the front page; a folder stands on GitHub, or is named only."""
    if page.startswith(("course/", "exercises/")):
        return
    home, branch = (app.config.html_theme_options.get(f"repository_{what}", "") for what in ("url", "branch"))
    at = f"{home}/tree/{branch}/{page.rpartition('/')[0]}".rstrip("/")
    text = README.sub(f"](/{app.config.root_doc}.md)", source[0])
    source[0] = FOLDER.sub(rf"[\1]({at}/\2)" if home else r"`\2`", text)


def read_included(app: Sphinx, path: Path, page: str, content: list[str]) -> None:
    if path.parent == Path():
        content[0] = linked(content[0], Path(app.srcdir))


def setup(app: Sphinx) -> dict:
    app.connect("source-read", read)
    app.connect("include-read", read_included)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
