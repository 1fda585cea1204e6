"""Sliders for pages without a kernel: pictures drawn beforehand, which the page's own program shows."""

from __future__ import annotations

import base64
import html
import json
from collections.abc import Callable, Mapping
from io import BytesIO

from matplotlib.image import imread, imsave

from .drawing.style import shown_size

STOPS = 9  # of a slider
_QUALITY = 60  # of WebP: lines stay sharp, in a fifth of the bytes of PNG


def stops_of(low: float, high: float, start: float) -> list[float]:
    """`STOPS` numbers from `low` to `high` with equal gaps, the one next to `start` replaced by it; the ends stay."""
    stops = [round(low + k * (high - low) / (STOPS - 1), 9) for k in range(STOPS)]
    if start not in stops:
        inner = range(1, STOPS - 1)
        stops[min(inner, key=lambda k: abs(stops[k] - start))] = start
    return stops


def flipbook(picture: Callable[[dict[str, float]], bytes], sliders: Mapping[str, tuple[float, float, float]]) -> str:
    """An element with a drawing and, as data for the page's program, pictures of it with one value moved at a time.

    Parameters
    ----------
    picture : function
        The drawing for values by name, PNG; it keeps scale and place, and grows where it must (see `explore`).
    sliders : mapping from name to (lowest, highest, start)
        As for `explore`.
    """
    start = {name: first for name, (_, _, first) in sliders.items()}
    for name, (low, high, _) in sliders.items():  # what it must hold: no later picture is larger
        for end in (low, high):
            picture(start | {name: end})
    books = []
    for name, ends in sliders.items():
        stops = stops_of(*ends)
        pages = ["" if stop == start[name] else _as_url(picture(start | {name: stop})) for stop in stops]
        books.append({"name": name, "stops": stops, "start": stops.index(start[name]), "pages": pages})
    still = picture(start)
    image = f'<img src="{_as_url(still)}" width="{shown_size(still)["width"]}" alt="{html.escape(", ".join(sliders))}">'
    data = json.dumps(books).replace("<", "\\u003c")
    return f'<div class="dhkit-flipbook">{image}<script type="application/json">{data}</script></div>'


def _as_url(png: bytes) -> str:
    buffer = BytesIO()
    imsave(buffer, imread(BytesIO(png)), format="webp", pil_kwargs={"quality": _QUALITY})
    return f"data:image/webp;base64,{base64.b64encode(buffer.getvalue()).decode()}"
