"""Runs notebooks on other machines: what is sent there, what is done there, and what may come back.

There and back goes JSON, read strictly and bounded in size: no object of Python is made from what another machine
sends. That machine runs the same code as this one, and students' code only in its sandbox.
"""

from __future__ import annotations

import json
import os
from typing import Literal

import msgspec
import nbformat

from autograder.sandbox import Limits

from ..errors import CourseError, in_words
from . import trial
from .execution import MachineFault, Work, confirm, execution_of
from .kept import MOST_BYTES, KeptRun, read, written


class MustRun(Exception):
    """A notebook has to run on another machine first.

    Parameters
    ----------
    name : str
        Of the notebook.
    parcel : bytes
        What to send there, for `run_parcel`.
    """

    def __init__(self, name: str, parcel: bytes) -> None:
        super().__init__(name, parcel)
        self.name, self.parcel = name, parcel


class _Parcel(msgspec.Struct, forbid_unknown_fields=True):
    notebook: str
    files: list[tuple[bytes, bytes]]
    student: str
    limits: Limits
    mode: Literal["bwrap", "none"]
    alone: bool


class _Reply(msgspec.Struct, forbid_unknown_fields=True):
    """What came of a parcel: a run, or the words that say what is wrong with the machine."""

    run: str = ""
    fault: str = ""


def pack(work: Work, alone: bool) -> bytes:
    """What is sent to another machine; `alone` says that nothing else runs there meanwhile, and that this run counts."""
    files = [(os.fsencode(name), content) for name, content in work.files.items()]
    return msgspec.json.encode(_Parcel(json.dumps(work.nb), files, work.student, work.limits, work.mode, alone))


def run_parcel(parcel: bytes) -> bytes:
    """Run what was sent, on the machine that it was sent to."""
    sent = msgspec.json.decode(parcel, type=_Parcel)
    files = {os.fsdecode(name): content for name, content in sent.files}
    work = Work(nbformat.from_dict(json.loads(sent.notebook)), files, sent.student, sent.limits, sent.mode)
    found: list[KeptRun] = []

    def run():
        found.append(work.run(warm=not sent.alone))
        return execution_of(work.nb, found[0])

    try:
        if sent.alone:
            confirm(run, lambda lasting: trial.find_fault((), sent.limits, sent.mode, lasting=lasting, warm=False))
        else:
            run()
    except Exception as error:
        return msgspec.json.encode(_Reply(fault=in_words(error)))
    return msgspec.json.encode(_Reply(run=written(work.key, found[0]).decode()))


def try_out(settings: bytes) -> bytes:
    """Say what keeps another machine from running notebooks, with limits and mode as in a parcel; empty if nothing does."""
    sent = msgspec.json.decode(settings, type=_Parcel)
    return (trial.find_fault((), sent.limits, sent.mode) or "").encode()


def unpack(reply: object, work: Work) -> KeptRun:
    """The run of `work` that came back.

    Raises
    ------
    MachineFault
        If that machine cannot be used, or anything else came back.
    """
    if not isinstance(reply, bytes) or len(reply) > 2 * MOST_BYTES:
        raise MachineFault("what came back from the other machine is no run of a notebook, or too long")
    try:
        found = msgspec.json.decode(reply, type=_Reply)
    except (msgspec.DecodeError, RecursionError):
        raise MachineFault("what came back from the other machine is no run of a notebook") from None
    if found.fault:
        raise MachineFault(f"on the machine where it ran: {found.fault}")
    if (run := read(found.run.encode(), work.key)) is None or not work.fits(run):
        raise CourseError(
            "the machine where it ran has another kit, other libraries or another Python than this one; "
            "install the same there, then grade again"
        )
    return run
