"""The gate between a kernel's sockets and the grader's: whole messages pass, and only bounded ones.

A kernel speaks ZeroMQ (ZMTP 3) over a Unix socket. Left to itself, ZeroMQ
would take in a multi-part message of any length before the grader sees a byte
of it, and would drop the connection, with whatever else was on its way, at one
message that is too long. The relay stands in between, knows nothing of the
protocol but its framing, and leaves out what is too long.
"""

from __future__ import annotations

import contextlib
import os
import selectors
import socket
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

GREETING_BYTES = 64
GREETING = ((0, 0xFF, 0xFF), (9, 0x7F, 0x7F), (10, 3, 0xFF))  # (place, least, most): signature and version
COMMAND_BYTES = 4096
MESSAGE_PARTS = 64
CHUNK_BYTES = 1 << 16
CONNECTIONS = 16
TAIL_BYTES = 4096

MORE, LONG, COMMAND = 1, 2, 4


class ProtocolError(Exception):
    """What came is not ZMTP 3; the connection ends."""


@dataclass(eq=False)
class MessageGate:
    """Passes on what a kernel sends, frame by frame, without messages above ``limit`` bytes."""

    limit: int
    refused: int = 0
    _greeting: bytearray = field(default_factory=bytearray)
    _pending: bytearray = field(default_factory=bytearray)
    _message: bytearray = field(default_factory=bytearray)
    _parts: int = 0
    _skip: int = 0
    _refusing: bool = False

    def feed(self, data: bytes) -> bytearray:
        """Take in received bytes, return those to be passed on."""
        self._pending += data
        passed = bytearray()
        while self._step(passed):
            pass
        return passed

    def _take(self, count: int) -> bytearray:
        taken = self._pending[:count]
        del self._pending[:count]
        return taken

    def _step(self, passed: bytearray) -> bool:
        """Handle one frame; False when more bytes are needed."""
        if self._skip:
            self._skip -= len(self._take(self._skip))
            return self._skip == 0
        if len(self._greeting) < GREETING_BYTES:
            return self._greet(passed)
        if len(self._pending) < 2:
            return False
        flags = self._pending[0]
        head = 9 if flags & LONG else 2
        if flags & ~(MORE | LONG | COMMAND):
            raise ProtocolError(f"frame flags {flags:#x}")
        if len(self._pending) < head:
            return False
        size = int.from_bytes(self._pending[1:head], "big")
        if flags & COMMAND:
            return self._command(passed, flags, head + size)
        return self._frame(passed, last=not flags & MORE, head=head, size=size)

    def _greet(self, passed: bytearray) -> bool:
        """Pass on the greeting as it comes: each end waits for the other's first half before it sends the second."""
        part = self._take(GREETING_BYTES - len(self._greeting))
        self._greeting += part
        for place, low, high in GREETING:
            byte = self._greeting[place] if place < len(self._greeting) else low
            if not low <= byte <= high:
                raise ProtocolError("no ZMTP 3 greeting")
        passed += part
        return bool(part)

    def _command(self, passed: bytearray, flags: int, length: int) -> bool:
        if flags & MORE or length > COMMAND_BYTES:
            raise ProtocolError("command out of bounds")
        if len(self._pending) < length:
            return False
        passed += self._take(length)
        return True

    def _frame(self, passed: bytearray, *, last: bool, head: int, size: int) -> bool:
        too_long = len(self._message) + head + size > self.limit or self._parts >= MESSAGE_PARTS
        if too_long and not self._refusing:
            self._refusing = True
            self.refused += 1
            self._message.clear()
        if self._refusing:
            self._take(head)
            self._skip = size
        elif len(self._pending) < head + size:
            return False
        else:
            self._message += self._take(head + size)
            self._parts += 1
        if last:
            passed += self._message
            self._message.clear()
            self._parts = 0
            self._refusing = False
        return True


@dataclass(eq=False)
class Side:
    """One end of a relayed connection; `outbox` waits to be sent to it, `peer` is the other end."""

    sock: socket.socket
    gate: MessageGate | None = None
    outbox: bytearray = field(default_factory=bytearray)
    peer: Side = field(init=False)

    def events(self) -> int:
        """What to wait for: reading stops while the other end does not keep up."""
        reading = selectors.EVENT_READ if len(self.peer.outbox) < CHUNK_BYTES else 0
        return reading | (selectors.EVENT_WRITE if self.outbox else 0)


class Relay(threading.Thread):
    """Carries the connections of one kernel until ``stop`` is called.

    ``doors`` maps each listening socket of the grader's side to the path of
    the kernel's listening socket. ``console`` is the read end of the kernel's
    raw standard output, of which the last bytes are kept in ``tail``.
    """

    def __init__(self, doors: Mapping[socket.socket, Path], console: int, limit: int) -> None:
        super().__init__(name="kernel-relay", daemon=True)
        self.tail = b""
        self._doors = dict(doors)
        self._console = console
        self._limit = limit
        self._gates: list[MessageGate] = []
        self._refused_before = 0
        self._selector = selectors.DefaultSelector()
        self._wake, self._woken = socket.socketpair()

    @property
    def refused(self) -> int:
        """How many messages were left out so far because they were too long."""
        return self._refused_before + sum(gate.refused for gate in tuple(self._gates))

    def stop(self) -> None:
        """End the relay and close all its sockets; the console pipe stays the caller's."""
        with contextlib.suppress(OSError):
            self._wake.send(b"x")
        if self.is_alive():
            self.join()

    def run(self) -> None:
        self._selector.register(self._woken, selectors.EVENT_READ, "stop")
        self._selector.register(self._console, selectors.EVENT_READ, "console")
        for door in self._doors:
            door.setblocking(False)
            self._selector.register(door, selectors.EVENT_READ, "door")
        try:
            while self._round():
                pass
        finally:
            for key in list(self._selector.get_map().values()):
                if isinstance(key.fileobj, socket.socket):
                    key.fileobj.close()
            self._selector.close()
            self._wake.close()

    def _round(self) -> bool:
        for key, ready in self._selector.select():
            if key.data == "stop":
                return False
            if key.data == "console":
                self._read_console()
            elif isinstance(key.data, Side):
                self._carry(key.data, ready)
            elif isinstance(key.fileobj, socket.socket):
                self._accept(key.fileobj)
        return True

    def _read_console(self) -> None:
        data = os.read(self._console, CHUNK_BYTES)
        self.tail = (self.tail + data)[-TAIL_BYTES:]
        if not data:
            self._selector.unregister(self._console)

    def _accept(self, door: socket.socket) -> None:
        with contextlib.suppress(OSError):
            ours, _ = door.accept()
            theirs = socket.socket(socket.AF_UNIX)
            try:
                if len(self._gates) >= CONNECTIONS:
                    raise ConnectionRefusedError
                # A kernel that accepts no connections must not hold up the others.
                theirs.setblocking(False)
                theirs.connect(str(self._doors[door]))
            except OSError:
                ours.close()
                theirs.close()
                return
            gate = MessageGate(self._limit)
            self._gates.append(gate)
            grader, kernel = Side(ours), Side(theirs, gate)
            grader.peer, kernel.peer = kernel, grader
            ours.setblocking(False)
            for side in (grader, kernel):
                self._selector.register(side.sock, selectors.EVENT_READ, side)

    def _carry(self, side: Side, ready: int) -> None:
        if side.sock.fileno() < 0:
            return
        try:
            if ready & selectors.EVENT_READ:
                data = side.sock.recv(CHUNK_BYTES)
                if not data:
                    raise ConnectionResetError
                side.peer.outbox += side.gate.feed(data) if side.gate else data
            if ready & selectors.EVENT_WRITE:
                del side.outbox[: side.sock.send(side.outbox)]
        except BlockingIOError:
            pass
        except (OSError, ProtocolError):
            self._close(side, side.peer)
            return
        for end in (side, side.peer):
            self._watch(end)

    def _watch(self, side: Side) -> None:
        events = side.events()
        watched = side.sock in self._selector.get_map()
        if events and watched:
            self._selector.modify(side.sock, events, side)
        elif events:
            self._selector.register(side.sock, events, side)
        elif watched:
            self._selector.unregister(side.sock)

    def _close(self, *sides: Side) -> None:
        for side in sides:
            if side.sock in self._selector.get_map():
                self._selector.unregister(side.sock)
            side.sock.close()
            if side.gate is not None:
                self._refused_before += side.gate.refused
                self._gates.remove(side.gate)


def listening_sockets(paths: Sequence[Path]) -> list[socket.socket]:
    """One listening Unix socket per path."""
    doors = []
    for path in paths:
        door = socket.socket(socket.AF_UNIX)
        door.bind(str(path))
        door.listen(8)
        doors.append(door)
    return doors
