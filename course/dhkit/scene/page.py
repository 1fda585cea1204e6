"""A scene in pages: one that holds it with its data and its program, where nothing is fetched and nothing but that program
may run; or its data alone, for a page of a site that brings the program along."""

from __future__ import annotations

import base64
import hashlib
import html
import json
from functools import cache
from importlib.resources import files
from typing import Any

from ..drawing.style import shown_size

_PAGE = """\
<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; script-src '{hash}'">
<title>{title}</title>
<style>
:root {{ color-scheme: light dark; }}
body {{ margin: 0 auto; max-width: 1100px; padding: 12px; font-family: system-ui, "DejaVu Sans", sans-serif; }}
</style>
</head>
<body>
<div id="scene"></div>
<noscript>The robot is drawn by a script, which this browser does not run.</noscript>
<script type="application/json" id="state">{state}</script>
<script>{script}</script>
</body>
</html>
"""


@cache
def script() -> str:
    """The program of a scene, built from ``js/``."""
    return files(__package__).joinpath("scene.js").read_text(encoding="utf-8")


def write_page(title: str, state: dict[str, Any]) -> str:
    """The page as text.

    Parameters
    ----------
    title : str
        Shown as text, whatever it holds.
    state : dict
        See `Scene.state`.
    """
    program = script() + "dhkitScene.page();"
    digest = base64.b64encode(hashlib.sha256(program.encode()).digest()).decode()
    return _PAGE.format(hash=f"sha256-{digest}", title=html.escape(title), state=_data(state), script=program)


def embed(state: dict[str, Any], still: bytes, words: str) -> str:
    """An element with the still drawing and the data of a scene, which the program of a scene shows as that of a widget.

    Parameters
    ----------
    state : dict
        See `Scene.state`.
    still : bytes
        The still drawing, PNG.
    words : str
        What stands for the picture where none is seen.
    """
    picture, width = base64.b64encode(still).decode(), shown_size(still)["width"]
    image = f'<img src="data:image/png;base64,{picture}" width="{width}" alt="{html.escape(words)}">'
    return f'<div class="dhkit-scene">{image}<script type="application/json">{_data(state)}</script></div>'


def _data(state: dict[str, Any]) -> str:
    """JSON for a script element: in it a "<" stands in texts only; written like this, none of them can end the element."""
    return json.dumps(state, allow_nan=False).replace("<", "\\u003c")
