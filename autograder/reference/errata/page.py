"""Errata as a web page: what is printed, what is right and why, and the proof, run on the way."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from .proof import Erratum

_CELL = 'style="text-align: left; vertical-align: top"'
_HEADS = ("where", "printed", "right", "why", "proof")


def as_html(errata: Iterable[Erratum]) -> str:
    """A table with one row per erratum. Every proof is run; a proof that fails says so in its cell."""
    head = "".join(f"<th {_CELL}>{name}</th>" for name in _HEADS)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(map(_row, errata))}</tbody></table>"


def _row(erratum: Erratum) -> str:
    proof = erratum.prove()
    verdict = "proved" if proof.proved else "NOT PROVED"
    steps = "<br>".join(map(escape, proof.detail.splitlines()))
    where = f"{escape(erratum.line)}<br><code>{escape(erratum.id)}</code>"
    cells = [where, *map(escape, (erratum.printed, erratum.corrected, erratum.why)), f"<b>{verdict}</b><br>{steps}"]
    return "<tr>" + "".join(f"<td {_CELL}>{cell}</td>" for cell in cells) + "</tr>"
