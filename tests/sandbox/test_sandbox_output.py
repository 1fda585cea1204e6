"""Output is bounded while it streams, and the grader's own memory with it."""

import json
import subprocess
import sys

import pytest

from autograder import sandbox

pytestmark = pytest.mark.sandbox

ENDLESS = "while True: print('x' * 1000)"
HUGE = "print('y' * 500_000_000)"
MULTIPART = """
import zmq
s = get_ipython().kernel.iopub_thread
s.send_multipart([b'x' * 1000] * 300_000)
"""
RAW = """
import os, socket, time
frame = bytes([3]) + (1 << 16).to_bytes(8, 'big') + bytes(1 << 16)
def push(end, data):
    while data:
        try:
            data = data[end.send(data):]
        except BlockingIOError:
            time.sleep(0.0005)
for fd in map(int, os.listdir('/proc/self/fd')):
    try:
        end = socket.socket(fileno=os.dup(fd))
        end.getpeername()
    except OSError:
        continue
    if end.family == socket.AF_UNIX and end.getsockname():
        for _ in range(3000):
            push(end, frame)
"""
WIDE = "from IPython.display import display\ndisplay({'a/b+json': [[]] * 400_000}, raw=True)"
FLOOD = "from IPython.display import display\nh = display(1, display_id=True)\nwhile True: h.update('x' * 3000)"
BLINK = "from IPython.display import display, clear_output\nwhile True: display('x' * 3000); clear_output()"
COMMS = "from comm import create_comm\nwhile True: create_comm('t', data={'a': 'x' * 3000})"

MEASURE = """
import json, pathlib, re, sys, nbformat
from autograder import sandbox
from autograder.sandbox import relay
if sys.argv[3:] == ["no gate"]:
    relay.MessageGate.feed = lambda self, data: bytearray(data)
seconds = 60 if sys.argv[3:] else 6  # a busy machine lets less through in the same time
def run(*sources):
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    limits = sandbox.Limits(memory=3 << 30, cell_seconds=seconds, notebook_seconds=100)
    return sandbox.run_notebook(nbformat.v4.new_notebook(cells=cells), limits=limits)
def peak():  # not ru_maxrss: that is inherited from the process that started this one
    return int(re.search(r"VmHWM:\\s+(\\d+) kB", pathlib.Path("/proc/self/status").read_text())[1])
run("1")
before = peak()
result = run("x = 1", *json.loads(sys.argv[2]), "print(x)")
after = peak()
kept = sum(len(json.dumps(cell.outputs)) for cell in result.cells.values())
print(json.dumps([(after - before) * 1024, kept, [cell.status for cell in result.cells.values()]]))
"""


def measured(folder, *arguments):
    """(bytes the grader's memory grew by, size of the outputs kept, statuses) of a run in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", MEASURE, str(folder), *arguments], capture_output=True, text=True, timeout=200
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize(
    "sources",
    [[ENDLESS], [HUGE], [MULTIPART], [RAW], [WIDE]],
    ids=["endless print", "one huge string", "endless parts", "raw protocol", "wide JSON"],
)
def test_the_graders_memory_does_not_grow(needs_sandbox, tmp_path, sources):
    grown, kept, statuses = measured(tmp_path, json.dumps(sources))
    assert grown < 100 << 20
    assert kept < 1 << 20
    assert statuses[0] == statuses[-1] == "ok"


def test_the_graders_memory_would_grow_without_the_gate(needs_sandbox, tmp_path):
    grown, _, _ = measured(tmp_path, json.dumps([RAW]), "no gate")
    assert grown > 100 << 20


LIMITS = sandbox.Limits(output_bytes=256 << 10, cell_seconds=20)


@pytest.mark.parametrize("flood", [ENDLESS, FLOOD, BLINK, COMMS], ids=["print", "updates", "clearing", "comms"])
def test_a_flood_is_stopped_and_costs_its_own_cell(sandboxed, statuses, printed, flood):
    run = sandboxed("x = 3", flood, "print(x)", "print(x + 1)", limits=LIMITS)
    assert statuses(run) == ["ok", "output_limit", "ok", "ok"]
    assert run.cells[1].message == "stopped: printed far more than 256 KiB"
    assert printed(run, 2) == "3" and printed(run, 3) == "4"
    assert len(json.dumps(run.cells[1].outputs)) < 64 << 10


def test_one_output_too_large_is_left_out_and_told(sandboxed, statuses, printed):
    run = sandboxed("print('y' * 3_000_000)", "print('still here')", limits=LIMITS)
    assert statuses(run) == ["output_limit", "ok"]
    assert printed(run, 1) == "still here"


def test_output_within_the_limit_is_complete(sandboxed, statuses, printed):
    source = "import sys\nfor i in range(2000): print(i)\nprint('e', file=sys.stderr)\nprint('end')"
    run = sandboxed(source, "print('z' * 100_000)", limits=LIMITS)
    assert statuses(run) == ["ok", "ok"]
    assert printed(run, 0) == "\n".join(map(str, range(2000))) + "\nend"
    assert len(printed(run, 1)) == 100_000


def kept(run, index):
    return sum(len(output.get("text", "")) for output in run.cells[index].outputs)


def test_the_limit_is_the_notebooks(sandboxed, statuses):
    run = sandboxed(*["print('z' * 100_000)"] * 4, limits=LIMITS)
    assert statuses(run) == ["ok"] * 4
    assert [kept(run, i) > 0 for i in range(4)] == [True, True, False, False]
    assert "left out" in run.cells[2].message and "left out" in run.cells[3].message


def test_a_talkative_cell_runs_to_its_end(sandboxed, statuses, printed):
    talk = "for i in range(600):\n    print('t' * 1000, flush=True)\nx = 'said'"
    run = sandboxed(talk, "print(x)", limits=LIMITS)
    assert statuses(run) == ["ok", "ok"] and printed(run, 1) == "said"
    assert 0 < kept(run, 0) <= LIMITS.output_bytes


def test_a_used_up_quota_does_not_silence_the_cells_after(sandboxed, statuses, printed):
    run = sandboxed("print('z' * 250_000)", "1 + 1", "print('a' * 20_000)", "print('b' * 40_000)", limits=LIMITS)
    assert statuses(run) == ["ok"] * 4
    assert run.cells[1].outputs[0].data["text/plain"] == "2"
    assert len(printed(run, 2)) == 20_000 and kept(run, 3) == 0


def test_outputs_are_valid_notebook_outputs(sandboxed):
    import nbformat

    run = sandboxed(
        "from IPython.display import *\ndisplay(HTML('<b>a</b>')); display({'application/vnd.x+json': {'a': [1]}}, raw=True)",
        "import matplotlib.pyplot as plt; plt.plot([1, 2]); plt.show()",
        "1 / 0",
        "'value'",
    )
    cells = [nbformat.v4.new_code_cell("", outputs=cell.outputs) for cell in run.cells.values()]
    nbformat.validate(nbformat.v4.new_notebook(cells=cells))
    assert run.cells[0].outputs[1].data["application/vnd.x+json"] == {"a": [1]}
    assert "image/png" in run.cells[1].outputs[-1].data
