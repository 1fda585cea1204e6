"""Kernel messages as data: signature, shape, size and depth are checked before anything is believed.

A student's code knows the key of its own kernel, so a signed message may be
forged as well. It is only ever data: what has not the shape of a Jupyter
message is refused, and what has is bounded.
"""

from __future__ import annotations

import hmac
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

DELIMITER = b"<IDS|MSG>"
MAX_DEPTH = 200  # JSON within JSON; copying and writing nested data recurses a few frames per level


class MalformedMessage(ValueError):
    """Bytes that are no message of the kernel we started; says what is wrong with them."""


@dataclass(frozen=True)
class Message:
    """A kernel message; ``parent`` is the id of the request it answers, ``size`` its content in bytes."""

    kind: str
    parent: str
    content: dict[str, Any]
    size: int


def refuse_constant(name: str) -> None:
    raise MalformedMessage(f"{name} is not JSON")


def finite(text: str) -> float:
    number = float(text)
    if math.isinf(number):
        raise MalformedMessage(f"{text[:20]} is out of range")
    return number


def depth_exceeds(value: Any, limit: int) -> bool:
    """Whether lists and dicts are nested more than ``limit`` deep."""
    level = [value]
    for _ in range(limit + 1):
        level = [
            inner
            for outer in level
            if isinstance(outer, dict | list)
            for inner in (outer.values() if isinstance(outer, dict) else outer)
        ]
        if not level:
            return False
    return True


def parse_json(raw: bytes) -> dict[str, Any]:
    """A JSON object from untrusted bytes: strict, of bounded depth, with text that can be written as UTF-8."""
    try:
        value = json.loads(raw.decode("utf-8", "replace"), parse_constant=refuse_constant, parse_float=finite)
    except MalformedMessage:
        raise
    except RecursionError as error:
        raise MalformedMessage("nested too deep") from error
    except ValueError as error:
        raise MalformedMessage(str(error)) from error
    if not isinstance(value, dict):
        raise MalformedMessage("not an object")
    if depth_exceeds(value, MAX_DEPTH):
        raise MalformedMessage("nested too deep")
    if b"\\ud" in raw.lower():
        try:
            json.dumps(value, ensure_ascii=False).encode()
        except UnicodeEncodeError as error:
            raise MalformedMessage("half a surrogate pair") from error
    return value


def decode(frames: Sequence[bytes], key: bytes) -> Message:
    """Read one received multi-part message; raises MalformedMessage."""
    try:
        start = list(frames).index(DELIMITER) + 1
    except ValueError as error:
        raise MalformedMessage("no delimiter") from error
    signature, parts = b"".join(frames[start : start + 1]), frames[start + 1 : start + 5]
    if len(parts) != 4:
        raise MalformedMessage("parts are missing")
    digest = hmac.new(key, digestmod="sha256")
    for part in parts:
        digest.update(part)
    if not hmac.compare_digest(signature, digest.hexdigest().encode()):
        raise MalformedMessage("wrong signature")
    header, parent, _, content = map(parse_json, parts)
    kind, request = header.get("msg_type"), parent.get("msg_id", "")
    if not isinstance(kind, str) or not isinstance(request, str):
        raise MalformedMessage("header without type or id")
    return Message(kind=kind, parent=request, content=content, size=sum(map(len, parts)))


def is_text(value: Any) -> bool:
    return isinstance(value, str) or (isinstance(value, list) and all(isinstance(part, str) for part in value))


def mime_bundle(value: Any) -> dict[str, Any]:
    """The entries of a MIME bundle that have a legal type: text, or any JSON under a JSON MIME type."""
    if not isinstance(value, dict):
        return {}
    return {mime: data for mime, data in value.items() if mime.endswith("json") or is_text(data)}


def as_dict(value: Any) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def as_text(value: Any) -> str:
    return value if isinstance(value, str) else ""


def output_content(message: Message) -> dict[str, Any] | None:
    """The content of an output message reduced to what the notebook format allows; None for other messages."""
    content = message.content
    if message.kind == "stream":
        name = content.get("name")
        return {"name": name if name in ("stdout", "stderr") else "stdout", "text": as_text(content.get("text"))}
    if message.kind in ("display_data", "execute_result", "update_display_data"):
        bundle: dict[str, Any] = {
            "data": mime_bundle(content.get("data")),
            "metadata": as_dict(content.get("metadata")),
            "transient": {"display_id": as_text(as_dict(content.get("transient")).get("display_id"))},
        }
        if message.kind == "execute_result":
            count = content.get("execution_count")
            bundle["execution_count"] = count if type(count) is int and 0 <= count < 1 << 31 else None
        return bundle
    if message.kind == "error":
        lines = content.get("traceback")
        return {
            "ename": as_text(content.get("ename")),
            "evalue": as_text(content.get("evalue")),
            "traceback": [line for line in lines if isinstance(line, str)] if isinstance(lines, list) else [],
        }
    if message.kind == "clear_output":
        return {"wait": bool(content.get("wait"))}
    return None
