"""Text of a page as HTML, at a bounded price: highlighted code, Markdown, coloured output.

Whatever a student wrote is laid out by pattern matchers that need minutes for some texts. They run in a process of
their own, which is stopped when a page has used up its processor time; what is left of the page is shown as it was
typed. The page of an honest student costs a tenth of its budget. nbgrader's formgrader and our feedback pages use the
same filters: nbgrader_config.py names them.

This module is also that process: ``python -m autograder.grading.rendering REQUESTS REPLIES``, two descriptors.
"""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from multiprocessing.connection import Connection
from typing import Any

from jinja2 import pass_context
from jinja2.runtime import Context

from .cells import is_check
from .inert import clean_markdown, with_pictures

PAGE_SECONDS = 1.0  # processor time for the texts of one page
PAGE_HTML = 250_000  # characters of HTML made of them: the exporter reads the whole page once more
TEXT = 20_000  # characters of one text that are laid out, or shown at all
PAGE_TEXT = 200_000  # characters of a page that are shown as they were typed
KNOWN_TEXTS = 1000  # of at most TEXT characters each, and as much HTML
_MEMORY = 2 << 30
_CONTROL = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]|[\x00-\x08\x0b-\x1f\x7f]")


@dataclass
class Budget:
    """What may still be spent on one page: processor seconds, characters of HTML, characters shown as typed."""

    seconds: float = PAGE_SECONDS
    html: int = PAGE_HTML
    typed: int = PAGE_TEXT


class Renderer:
    """The process that lays out texts; started when it is first needed, and again after it was stopped."""

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Leave the process to whoever else talks to it; the next text starts another."""
        self._lock = threading.Lock()
        self._process: subprocess.Popen[bytes] | None = None
        # Statements, check cells and verdicts stand on the page of every student.
        self._known: dict[tuple[str, str, tuple[str, ...]], tuple[str | None, float]] = {}

    def render(self, kind: str, text: str, budget: Budget, pictures: Iterable[str] = ()) -> str | None:
        """Return `text` as HTML, None if that goes beyond the budget, which is reduced by what it took.

        Parameters
        ----------
        kind : str
            "code", "markdown", "output" or "html".
        text : str
        budget : Budget
        pictures : iterable of str
            Names of the pictures attached to a Markdown cell.
        """
        if len(text) > TEXT or budget.seconds <= 0 or budget.html <= 0:
            return None
        key = (kind, text, tuple(pictures))
        with self._lock:
            found = self._known.get(key)
            if found is None or found[1] > budget.seconds:
                found = self._ask(kind, text, budget.seconds, key[2])
            if found is None:
                budget.seconds = 0.0
                return None
            if len(self._known) >= KNOWN_TEXTS:
                self._known.clear()
            if len(found[0] or "") <= TEXT:
                self._known[key] = found
        html, seconds = found
        budget.seconds -= seconds
        if html is not None and len(html) > budget.html:
            budget.html = 0
            return None
        budget.html -= len(html or "")
        return html

    def _ask(self, kind: str, text: str, seconds: float, pictures: Sequence[str]) -> tuple[str | None, float] | None:
        """The HTML of a text and the seconds that it took; None if it takes longer than it may."""
        request = {"kind": kind, "text": text, "seconds": seconds, "pictures": pictures}
        try:
            if self._process is None:
                self._start()
            self._requests.send_bytes(json.dumps(request).encode())
            reply = json.loads(self._replies.recv_bytes())
        except (EOFError, OSError):
            self._stop()
            return None
        return reply["html"], reply["seconds"]

    def _start(self) -> None:
        (theirs_in, ours_out), (ours_in, theirs_out) = os.pipe(), os.pipe()
        try:
            self._process = subprocess.Popen(
                [sys.executable, "-m", __name__, str(theirs_in), str(theirs_out)],
                pass_fds=(theirs_in, theirs_out),
                stdin=subprocess.DEVNULL,
                start_new_session=True,  # Ctrl-C is for the grader: a page without its texts would be stored
            )
        finally:
            os.close(theirs_in)
            os.close(theirs_out)
            self._requests = Connection(ours_out, readable=False)
            self._replies = Connection(ours_in, writable=False)

    def _stop(self) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None
        self._requests.close()
        self._replies.close()


RENDERER = Renderer()
os.register_at_fork(after_in_child=RENDERER.forget)  # two readers of one pipe would take each other's replies


def _budget(context: Context | Mapping[str, Any]) -> Budget:
    """What is left for the student's texts of a page; what the grader itself wrote has a budget for each text."""
    cell, resources = context.get("cell"), context.get("resources")
    if cell is None or resources is None or is_check(cell):
        return Budget()
    return resources.setdefault("rendering", Budget())


def _as_typed(text: str, budget: Budget) -> str:
    shown = text[: min(TEXT, max(0, budget.typed))]
    budget.typed -= len(shown)
    rest = len(text) - len(shown)
    return escape(shown) + (f"\n[... {rest:,} further characters are not shown]" if rest else "")


@pass_context
def highlight_code(context: Context, source: str, **options: Any) -> str:
    """nbconvert's filter of the same name, within the page's budget."""
    budget = _budget(context)
    html = RENDERER.render("code", source, budget)
    return f'<div class="highlight"><pre>{_as_typed(source, budget)}</pre></div>' if html is None else html


@pass_context
def markdown2html(context: Context, source: str) -> str:
    """nbconvert's filter of the same name, harmless (see `inert.clean_markdown`) and within the page's budget."""
    budget = _budget(context)
    attachments = (context.get("cell") or {}).get("attachments", {})
    html = RENDERER.render("markdown", source, budget, attachments)
    return f"<pre>{_as_typed(source, budget)}</pre>" if html is None else with_pictures(html, attachments)


@pass_context
def ansi2html(context: Context, text: str) -> str:
    """nbconvert's filter of the same name, within the page's budget."""
    budget = _budget(context)
    html = RENDERER.render("output", text, budget)
    return _as_typed(_CONTROL.sub("", text), budget) if html is None else html


@pass_context
def clean_html(context: Context, text: str | bytes) -> str:
    """nbconvert's filter of the same name, within the page's budget."""
    budget, text = _budget(context), text.decode("utf-8", "replace") if isinstance(text, bytes) else text
    html = RENDERER.render("html", text, budget)
    return _as_typed(text, budget) if html is None else html


def strip_files_prefix(text: str) -> str:
    """nbconvert's filter of the same name left out: it serves links of 2012, and ``[[[[`` costs it a minute."""
    return text


def _serve(requests: Connection, replies: Connection) -> None:
    """Lay out one text after the other until nobody asks any more."""
    import resource

    from nbconvert.filters.ansi import ansi2html as coloured
    from nbconvert.filters.highlight import Highlight2HTML
    from nbconvert.filters.strings import clean_html as cleaned

    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    highlighted = Highlight2HTML(pygments_lexer="ipython3")
    ways = {
        "code": lambda text, _: highlighted(text),
        "markdown": clean_markdown,
        "output": lambda text, _: coloured(text),
        "html": lambda text, _: cleaned(text),
    }
    while True:
        try:
            request = json.loads(requests.recv_bytes())
        except EOFError:
            return
        start = time.process_time()
        # A signal that nobody catches ends the process, however deep in a pattern it is.
        signal.setitimer(signal.ITIMER_PROF, request["seconds"])
        try:
            html = ways[request["kind"]](request["text"], request["pictures"])
        except (RecursionError, MemoryError, ValueError):
            html = None
        signal.setitimer(signal.ITIMER_PROF, 0)
        reply = {"html": html, "seconds": time.process_time() - start}
        replies.send_bytes(json.dumps(reply).encode())


if __name__ == "__main__":
    _serve(*(Connection(int(number)) for number in sys.argv[1:]))
