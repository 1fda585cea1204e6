"""The notice a student sees: HTML in Jupyter, plain text elsewhere."""

from __future__ import annotations

import html
import re
from dataclasses import dataclass

_MARKS = {True: "\N{CHECK MARK}", False: "\N{BALLOT X}", None: "\N{BULLET}"}
# Okabe-Ito colours: told apart by colour-blind readers; the marks carry the same meaning in grey print.
_COLOURS = {True: "#009E73", False: "#D55E00", None: "#555555"}


@dataclass(frozen=True)
class Line:
    """One statement of a notice: it holds (True), fails (False) or only informs (None)."""

    holds: bool | None
    text: str
    blank: bool = False

    @classmethod
    def unattempted(cls, text: str) -> Line:
        return cls(None, text, blank=True)


@dataclass(frozen=True)
class Notice:
    """Title, overall status and lines shown for one question."""

    title: str
    status: str
    lines: tuple[Line, ...]

    def text(self) -> str:
        head = f"{self.title}: {self.status}" if self.status else self.title
        return "\n".join([head, *(f"  {_MARKS[line.holds]} {line.text}" for line in self.lines)])

    def html(self) -> str:
        status = f": {html.escape(self.status)}" if self.status else ""
        rows = "".join(
            f'<div style="margin-left:1em"><span style="color:{_COLOURS[line.holds]};font-weight:bold">'
            f"{_MARKS[line.holds]}</span> {_inline(line.text)}</div>"
            for line in self.lines
        )
        return f'<div style="border-left:3px solid #0072B2;padding:0.2em 0.8em"><b>{html.escape(self.title)}</b>{status}{rows}</div>'


def _inline(text: str) -> str:
    """Bold words and code of Markdown as HTML; formulas are left to Jupyter."""
    said = re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(text))
    return re.sub(r"\*\*([^*]+)\*\*", r"<b>\1</b>", said)


def show(notice: Notice, data: dict | None = None) -> None:
    """Display `notice`; in Jupyter the MIME bundle `data` goes along, unseen."""
    # Here, since the reference solver imports the kit's geometry and has no use for IPython, which is slow to load.
    from IPython import get_ipython
    from IPython.display import display

    if get_ipython() is None:
        print(notice.text())
    else:
        display({"text/plain": notice.text(), "text/html": notice.html(), **(data or {})}, raw=True)
