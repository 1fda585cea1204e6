"""What all scenes share: a widget where somebody watches, a page of its own, and a still drawing beside them."""

from __future__ import annotations

import base64
import os
from io import BytesIO
from pathlib import Path
from typing import Any

from ..drawing.style import SHARP, shown_size
from ..watched import is_for_a_site, is_watched
from .page import embed, write_page


class Live:
    """A picture that moves in the reader's browser, with a still drawing in its place where none does."""

    title: str
    _widget: Any = None

    def state(self) -> dict[str, Any]:
        """All that the browser needs, as JSON holds it."""
        raise NotImplementedError

    def _draw(self) -> Any:
        """The still drawing: a Matplotlib Axes."""
        raise NotImplementedError

    def _make_widget(self) -> Any:
        """The widget; ImportError where anywidget is not installed."""
        raise NotImplementedError

    def _in_words(self) -> str:
        raise NotImplementedError

    def save(self, file: str | os.PathLike[str]) -> None:
        """Write a page with the scene as it stands, which needs neither Python nor a network.

        Parameters
        ----------
        file : path
            For instance ``"arm.html"``.
        """
        Path(file).write_text(write_page(self.title or "Robot", self.state()), encoding="utf-8")

    def still(self) -> bytes:
        """The still drawing, as PNG."""
        import matplotlib.pyplot as plt

        ax = self._draw()
        buffer = BytesIO()
        ax.figure.savefig(buffer, format="png", dpi=90 * SHARP, bbox_inches="tight")
        plt.close(ax.figure)
        return buffer.getvalue()

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> tuple[dict[str, Any], dict[str, Any]]:
        """The widget with the still drawing beside it, for a printed notebook or a kernel without widgets.

        With ``DHKIT_SCENES=embedded`` in the environment, which the builder of a site sets, the data come along for its pages.
        """
        still = self.still()
        words = self._in_words()
        bundle: dict[str, Any] = {"text/plain": words, "image/png": base64.b64encode(still).decode()}
        metadata: dict[str, Any] = {"image/png": shown_size(still)}
        if (widget := self._live()) is not None:
            # Colab draws the widget that ends a cell only if these metadata name the program for widgets of others.
            view, said = widget._repr_mimebundle_()
            bundle, metadata = view | bundle, said | metadata
        elif is_for_a_site():
            bundle["text/html"] = embed(self.state(), still, words)
        return bundle, metadata

    def _live(self) -> Any:
        """The widget, made at first use; None where there is none."""
        if self._widget is None and is_watched():
            try:
                self._widget = self._make_widget()
            except ImportError:
                return None
        return self._widget
