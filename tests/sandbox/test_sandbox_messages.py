"""What comes from a kernel is data: strict, bounded, and never an exception in the grader."""

import hashlib
import hmac
import json
import random

import pytest

from autograder.sandbox import messages, relay

KEY = b"key"


def signed(*parts, key=KEY):
    encoded = [part if isinstance(part, bytes) else json.dumps(part).encode() for part in parts]
    signature = hmac.new(key, b"".join(encoded), hashlib.sha256).hexdigest().encode()
    return [b"topic", messages.DELIMITER, signature, *encoded]


HEADER = {"msg_type": "stream", "msg_id": "1"}


def test_a_sound_message_is_read():
    message = messages.decode(signed(HEADER, {"msg_id": "p"}, {}, {"text": "π \x00"}), KEY)
    assert (message.kind, message.parent, message.content) == ("stream", "p", {"text": "π \x00"})
    assert message.size > 20


@pytest.mark.parametrize(
    "frames",
    [
        [],
        [b"no delimiter"],
        [messages.DELIMITER],
        signed(HEADER, {}, {}),
        signed(HEADER, {}, {}, {}, key=b"other"),
        signed([], {}, {}, {}),
        signed({}, {}, {}, {}),
        signed({"msg_type": 3}, {}, {}, {}),
        signed(HEADER, {"msg_id": []}, {}, {}),
        signed(HEADER, {}, {}, b"{"),
        signed(HEADER, {}, {}, b"[1]"),
        signed(HEADER, {}, {}, b'{"a": NaN}'),
        signed(HEADER, {}, {}, b'{"a": -Infinity}'),
        signed(HEADER, {}, {}, b'{"a": 1e999}'),
        signed(HEADER, {}, {}, b'{"a": ' + b"9" * 10000 + b"}"),
        signed(HEADER, {}, {}, b'{"a": "\\ud800"}'),
        signed(HEADER, {}, {}, b'{"a": ' * 100000 + b"1" + b"}" * 100000),
        signed(HEADER, {}, {}, b'{"a": ' + b"[" * 100000 + b"]" * 100000 + b"}"),
        signed(HEADER, {}, {}, b'{"a": ' + b"[" * 300 + b"]" * 300 + b"}"),
        signed(b'{"a": ' * 900 + b"1" + b"}" * 900, {}, {}, {}),
    ],
)
def test_malformed_messages_are_refused(frames):
    with pytest.raises(messages.MalformedMessage):
        messages.decode(frames, KEY)


def test_a_changed_message_is_refused():
    frames = signed(HEADER, {}, {}, {"text": "a"})
    messages.decode(frames, KEY)
    with pytest.raises(messages.MalformedMessage, match="signature"):
        messages.decode([*frames[:-1], b'{"text": "b"}'], KEY)


def test_invalid_utf8_is_replaced_and_can_be_written():
    message = messages.decode(signed(HEADER, {}, {}, b'{"text": "a\xff"}'), KEY)
    assert message.content["text"] == "a�"
    assert json.dumps(messages.decode(signed(HEADER, {}, {}, b'{"a": "\\ud83d\\ude00"}'), KEY).content).encode()


def test_nested_data_within_bounds_is_kept():
    nested = b'{"a": ' + b"[" * 150 + b"]" * 150 + b"}"
    assert messages.decode(signed(HEADER, {}, {}, nested), KEY).content["a"]


@pytest.mark.parametrize("kind", ["stream", "display_data", "execute_result", "update_display_data", "error"])
@pytest.mark.parametrize("junk", [None, 1, "x", [], {}, [1], {"a": 1}, True])
def test_output_content_has_the_notebook_format_whatever_comes(kind, junk):
    import nbformat
    from nbformat.v4 import output_from_msg

    names = ("name", "text", "data", "metadata", "transient", "execution_count", "ename", "evalue", "traceback")
    content = messages.output_content(messages.Message(kind, "p", dict.fromkeys(names, junk), 1))
    shown = "display_data" if kind == "update_display_data" else kind
    output = output_from_msg({"header": {"msg_type": shown}, "content": content})
    cell = nbformat.v4.new_code_cell("", outputs=[output])
    nbformat.validate(nbformat.v4.new_notebook(cells=[cell]))


def test_bundles_keep_json_under_json_types_and_text_elsewhere():
    bundle = messages.mime_bundle(
        {"image/png": {"a": 1}, "text/plain": ["a", "b"], "x/y+json": {"a": [1]}, "text/html": 3}
    )
    assert bundle == {"text/plain": ["a", "b"], "x/y+json": {"a": [1]}}


GREETING = b"\xff" + bytes(8) + b"\x7f" + b"\x03" + bytes(53)


def frame(body, more=False, command=False):
    flags = more | (command << 2)
    if len(body) > 255:
        return bytes([flags | 2]) + len(body).to_bytes(8, "big") + body
    return bytes([flags, len(body)]) + body


def fed(gate, data, seed=0):
    """Everything that passes when data arrives in pieces of random length."""
    rng = random.Random(seed)
    passed = b""
    while data:
        count = rng.choice([1, 2, 7, 64, 1000, 100000])
        passed += bytes(gate.feed(data[:count]))
        data = data[count:]
    return passed


@pytest.mark.parametrize("seed", range(5))
def test_the_gate_passes_what_is_bounded_and_leaves_out_whole_messages(seed):
    command = frame(b"\x05READY", command=True)
    small = frame(b"a" * 10, more=True) + frame(b"b" * 300)
    large = frame(b"c" * 2000)
    in_parts = b"".join(frame(b"d" * 100, more=True) for _ in range(20)) + frame(b"")
    many_parts = b"".join(frame(b"", more=True) for _ in range(100)) + frame(b"")
    gate = relay.MessageGate(limit=1000)
    passed = fed(gate, GREETING + command + small + large + small + in_parts + small + many_parts + small, seed)
    assert passed == GREETING + command + small * 4
    assert gate.refused == 3


def test_the_gate_holds_no_more_than_one_message():
    gate = relay.MessageGate(limit=10_000)
    gate.feed(GREETING)
    endless = frame(b"x" * 5000, more=True)
    for _ in range(1000):
        assert not gate.feed(endless)
    assert len(gate._message) + len(gate._pending) <= 20_000
    gate.feed(b"\x02" + (1 << 40).to_bytes(8, "big"))
    for _ in range(100):
        assert not gate.feed(bytes(100_000))
    assert len(gate._message) + len(gate._pending) == 0


@pytest.mark.parametrize(
    "data",
    [
        b"GET / HTTP/1.1",
        b"\xff" + bytes(8) + b"\x7f\x01",
        GREETING + b"\xf0\x01a",
        GREETING + frame(b"x" * 5000, command=True),
        GREETING + frame(b"x", more=True, command=True),
    ],
)
def test_what_is_not_the_protocol_ends_the_connection(data):
    with pytest.raises(relay.ProtocolError):
        fed(relay.MessageGate(limit=1000), data)


FORGE = """
import hashlib, hmac, json, zmq
kernel = get_ipython().kernel
key = kernel.session.key
def post(kind, content, key=key, parent=None, header=None):
    parent = parent or {"msg_id": kernel.get_parent("shell")["header"]["msg_id"]}
    parts = [json.dumps(header or {"msg_type": kind, "msg_id": "forged"}), json.dumps(parent), "{}", content]
    parts = [part.encode() if isinstance(part, str) else part for part in parts]
    signature = hmac.new(key, b"".join(parts), hashlib.sha256).hexdigest().encode()
    kernel.iopub_thread.send_multipart([b"topic", b"<IDS|MSG>", signature, *parts])
"""


def test_forged_messages_are_data_and_cost_their_own_cell_at_most(sandboxed, statuses, printed):
    attacks = [
        'post(\'stream\', \'{"name": "stdout", "text": "sound"}\')',
        'post(\'stream\', \'{"name": "stdout", "text": "unsigned"}\', key=b\'wrong\')',
        "post('display_data', '{\"data\": {\"a/b+json\": ' + '[' * 100000 + ']' * 100000 + '}}')",
        'post(\'display_data\', \'{"data": {"a/b+json": {"x": NaN}}}\')',
        "post('display_data', b'{\"data\": \"\\xff\\xfe\"}'); post('display_data', '{}'); post('stream', '{}')",
        "post('error', '[]'); post('status', '{\"execution_state\": 3}'); post('update_display_data', '{}')",
        "post('stream', '{}', parent=[1]); post('', '{}', header={'msg_type': None})",
        "post('comm_open', '{}'); post('comm_msg', '{\"data\": 1}'); post('comm_close', '{}')",
        "post('clear_output', '{\"wait\": []}'); post('nonsense', '{}'); post('display_data', '{\"transient\": 1}')",
        "kernel.iopub_thread.send_multipart([b'a']); kernel.iopub_thread.send_multipart([b''] * 40)",
        "kernel.iopub_thread.send_multipart([b'<IDS|MSG>'] + [b''] * 5)",
        "from IPython.display import *; h = display(1, display_id='d'); clear_output(); h.update(2); h.update(3)",
        "h.update(4); display(5, display_id='d'); clear_output(wait=True); h.update(6); print('end')",
    ]
    run = sandboxed(FORGE, *attacks, "print('after')")
    assert statuses(run) == ["ok"] * len(run.cells)
    assert printed(run, 1) == "sound"
    assert printed(run, 2) == ""
    assert all(not output.get("data") for index in (3, 4) for output in run.cells[index].outputs)
    assert printed(run, len(attacks)) == "end"
    assert printed(run, len(attacks) + 1) == "after"


def test_forged_ends_of_a_cell_do_not_stop_the_run(sandboxed, statuses, printed):
    run = sandboxed(
        FORGE,
        "post('status', '{\"execution_state\": \"idle\"}'); import time; time.sleep(0.3); x = 1; 1 / 0",
        "request = kernel.get_parent('shell')\nimport time\n"
        "kernel.session.send(kernel.shell_stream, 'execute_reply', {'status': 'ok'}, parent=request,"
        " ident=kernel._shell_parent_ident.get() if hasattr(kernel, '_shell_parent_ident') else None)\ntime.sleep(0.5)",
        "print(x)",
    )
    assert statuses(run)[1] == "error"
    assert printed(run, 3) == "1"


def test_a_kernel_that_speaks_another_protocol_is_replaced(sandboxed, statuses, printed):
    takeover = """
import os, socket, threading, time
def answer(door):
    while True:
        connection, _ = door.accept()
        connection.sendall(b"HTTP/1.1 200 OK" * 1000)
doors = []
for fd in map(int, os.listdir("/proc/self/fd")):
    try:
        door = socket.socket(fileno=os.dup(fd))
        if door.family == socket.AF_UNIX and door.getsockopt(socket.SOL_SOCKET, socket.SO_ACCEPTCONN):
            doors.append(door)
        else:
            door.shutdown(socket.SHUT_RDWR) if door.type == socket.SOCK_STREAM else None
    except OSError:
        pass
for door in doors:
    threading.Thread(target=answer, args=(door,), daemon=True).start()
time.sleep(30)
"""
    from autograder.sandbox import Limits

    run = sandboxed("x = 7", takeover, "print(x)", limits=Limits(cell_seconds=3))
    assert statuses(run)[0] == "ok" and statuses(run)[1] != "ok" and statuses(run)[2] == "ok"
    assert printed(run, 2) == "7"
