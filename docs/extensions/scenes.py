"""What moves in the pages, live scenes and sliders: their programs come along where a page holds one, once."""

from pathlib import Path

from sphinx.application import Sphinx

from dhkit.scene.page import script

PROGRAM = "scene.js"


def add_program(app: Sphinx, page: str, template: str, context: dict, doctree) -> None:
    if 'class="dhkit-scene"' in context.get("body", ""):
        app.add_js_file(PROGRAM, loading_method="defer")
        app.add_js_file("scenes.js", loading_method="defer")
    if 'class="dhkit-flipbook"' in context.get("body", ""):
        app.add_js_file("flipbook.js", loading_method="defer")


def write_program(app: Sphinx, fault: Exception | None) -> None:
    if fault is None:
        Path(app.outdir, "_static", PROGRAM).write_text(script(), encoding="utf-8")


def setup(app: Sphinx) -> dict:
    app.connect("html-page-context", add_program)
    app.connect("build-finished", write_program)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
