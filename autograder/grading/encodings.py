"""Text in the encodings that editors, spreadsheets and platforms write."""

from __future__ import annotations


def utf16(content: bytes) -> str | None:
    """Which UTF-16 it is, if it is: with its mark, or by the zeros beside the first letters."""
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "utf-16"
    if len(content) > 3 and content[1] == content[3] == 0:
        return "utf-16-le"
    return "utf-16-be" if len(content) > 3 and content[0] == content[2] == 0 else None


def decoded(content: bytes) -> str:
    """Text in whatever of the usual encodings it was saved."""
    if encoding := utf16(content):
        return content.decode(encoding, "replace")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", "replace")
