"""Memory, processes, disk, files and processor time: what exceeds them fails, and costs its own cell."""

import dataclasses
import os
import threading
import time

import numpy
import psutil
import pytest

from autograder import sandbox
from autograder.sandbox import watch

pytestmark = pytest.mark.sandbox

MIB = 1 << 20


def test_a_ten_gigabyte_allocation_is_an_ordinary_memory_error(sandboxed, statuses, printed):
    run = sandboxed(
        "x = 3",
        "bytearray(10 << 30)",
        "import numpy; numpy.ones((10 << 30) // 8)",
        "import mmap; mmap.mmap(-1, 10 << 30)",
        "data = []\nwhile True: data.append(bytes(range(256)) * 40000)",
        "data = None; print(x)",
    )
    assert statuses(run) == ["ok", "memory", "memory", "error", "memory", "ok"]
    assert run.cells[1].message.startswith("MemoryError")
    assert printed(run, 5) == "3"


@pytest.mark.parametrize(
    "hoard",
    [
        # shared mappings belong to no process's private data
        "import mmap\nkeep = mmap.mmap(-1, 900 << 20)\nfor i in range(0, 900 << 20, 4096): keep[i] = 1",
        # many processes, each within the limit of one
        "import os, time\nfor i in range(12):\n    if os.fork() == 0:\n"
        "        keep = b'x' * (60 << 20); time.sleep(60); os._exit(0)\ntime.sleep(60)",
        # unread bytes in sockets belong to no process at all
        "import os, socket, time\nfor i in range(40):\n    if os.fork() == 0:\n"
        "        keep = [socket.socketpair() for i in range(60)]; time.sleep(60)\ntime.sleep(60)",
    ],
    ids=["shared mapping", "many processes", "sockets"],
)
def test_a_sandbox_above_its_memory_is_stopped_at_the_cost_of_one_cell(sandboxed, statuses, printed, hoard):
    run = sandboxed("x = 3", hoard, "print(x)")
    assert statuses(run) == ["ok", "memory", "ok"]
    assert run.cells[1].message == "used more than 400 MiB of memory and was stopped"
    assert printed(run, 2) == "3"


def test_a_cell_that_keeps_all_memory_leaves_some_for_the_others(sandboxed, statuses, printed):
    keep = "kept = []\nwhile True:\n    kept.append(b'x' * (8 << 20))"
    run = sandboxed("x = 3", keep, "y = b'y' * (100 << 20)", "print(x)", limits=sandbox.Limits(memory=400 * MIB))
    assert statuses(run) == ["ok", "memory", "ok", "ok"]
    assert printed(run, 3) == "3"


def test_a_kernel_that_ends_with_its_memory_full_was_ended_by_that(sandboxed, statuses):
    full = "kept = b'x' * (310 << 20)\nimport os, time; time.sleep(1); os.abort()"
    run = sandboxed("x = 3", full, "import os; os.abort()", "x", limits=sandbox.Limits(memory=400 * MIB))
    assert statuses(run) == ["ok", "memory", "died", "ok"]


def test_files_in_memory_count(sandboxed, statuses):
    hoard = (
        "for i in range(40):\n    for place in ('/tmp', '/dev/shm'):\n"
        "        open(f'{place}/{i}', 'wb').write(bytes(6 << 20))\nimport time; time.sleep(30)"
    )
    roomy = sandbox.Limits(memory=400 * MIB, disk=300 * MIB)
    assert statuses(sandboxed(hoard, "1", limits=roomy)) == ["memory", "ok"]


def test_empty_files_count_too(needs_sandbox, tmp_path):
    state = os.statvfs(tmp_path)
    for number in range(200):
        (tmp_path / str(number)).touch()
    assert watch.stored_bytes(os.getpid(), [str(tmp_path)]) >= 200 * watch.INODE_BYTES
    assert state.f_files


def test_memory_of_a_family_is_summed_with_shared_pages_once():
    block = numpy.ones(60 * MIB // 8)
    pids = []
    for _ in range(3):
        pid = os.fork()
        if pid == 0:
            time.sleep(30)
            os._exit(0)
        pids.append(pid)
    try:
        members = [psutil.Process(), *map(psutil.Process, pids)]
        own = watch.resident_bytes(os.getpid())
        separate = sum(watch.resident_bytes(member.pid) for member in members)
        buffers = sum(map(watch.buffered_bytes, members))
        together = watch.memory_in_use(members) - buffers
    finally:
        for pid in pids:
            os.kill(pid, 9)
            os.waitpid(pid, 0)
    assert own > block.nbytes
    assert separate > own + 2 * block.nbytes
    assert block.nbytes < together < own + block.nbytes


def test_five_hundred_threads_fail_with_an_ordinary_error_and_leave_later_cells_their_memory(sandboxed, statuses):
    threads = """
import threading
stop = threading.Event()
for i in range(500):
    threading.Thread(target=stop.wait, args=(60,), daemon=True).start()
"""
    assert statuses(sandboxed(threads, "stop.set()", mode="none")) == ["ok", "ok"]
    run = sandboxed("x = 1", threads, "large = bytearray(100 << 20)")
    assert statuses(run) == ["ok", "error", "ok"]
    assert run.cells[1].message == "RuntimeError: can't start new thread"


def test_a_fork_bomb_stays_small_and_ends_with_the_run(sandboxed, statuses, alive):
    bomb = """
import os, time
end = time.monotonic() + 2
while time.monotonic() < end:
    try:
        if os.fork() == 0:
            os.setsid()
            os.execvp("sleep", ["sleep", "91.4"]) if os.getpid() % 3 == 0 else None
    except OSError as error:
        last = error
        time.sleep(0.01)
if os.getpid() > 2: time.sleep(60)
print(last)
"""
    most = 0
    done = threading.Event()

    def count():
        nonlocal most
        while not done.wait(0.1):
            most = max(most, len(psutil.Process().children(recursive=True)))

    counter = threading.Thread(target=count)
    counter.start()
    try:
        run = sandboxed(bomb, "1", limits=sandbox.Limits(processes=48, cell_seconds=10))
    finally:
        done.set()
        counter.join()
    assert statuses(run)[0] in ("ok", "memory", "timeout")
    assert statuses(run)[1] in ("ok", "error")
    assert 20 < most <= 48 + 4
    assert not alive("sleep 91.4")


def test_the_limit_on_processes_holds_per_sandbox(sandboxed):
    threads = "import threading, time\nfor i in range(35): threading.Thread(target=time.sleep, args=(4,)).start()"
    runs = []

    def one():
        runs.append(sandboxed(threads, limits=sandbox.Limits(processes=64)))

    both = [threading.Thread(target=one) for _ in range(2)]
    for thread in both:
        thread.start()
    for thread in both:
        thread.join()
    assert [run.cells[0].status for run in runs] == ["ok", "ok"]


def test_private_file_systems_are_small(sandboxed, printed):
    fill = """
import errno
for place in ("/tmp", "/home/student", "/dev/shm", "."):
    try:
        for i in range(100):
            with open(f"{place}/{i}", "wb") as file:
                file.write(bytes(1 << 20))
        print("filled")
    except OSError as error:
        print(errno.errorcode[error.errno])
    import os
    for i in range(100):
        if os.path.exists(f"{place}/{i}"): os.remove(f"{place}/{i}")
"""
    assert printed(sandboxed(fill), 0).split() == ["ENOSPC"] * 4
    roomy = sandbox.Limits(disk=110 * MIB)
    assert printed(sandboxed(fill, limits=roomy), 0).split() == ["filled"] * 4


def test_a_file_and_the_number_of_open_files_are_bounded(sandboxed):
    one = "open('/tmp/large', 'wb').write(bytes(9 << 20))"
    many = "keep = [open('/dev/null') for _ in range(300)]"
    run = sandboxed(one, many, "1")
    assert [run.cells[index].message for index in (0, 1)] == [
        "OSError: [Errno 27] File too large",
        "OSError: [Errno 24] Too many open files: '/dev/null'",
    ]
    assert run.cells[2].status == "ok"
    roomy = sandbox.Limits(open_files=600)
    run = sandboxed(one, many, limits=roomy)
    assert [run.cells[index].status for index in (0, 1)] == ["ok", "ok"]


def test_processor_time_is_bounded(sandboxed, statuses):
    run = sandboxed("x = 1", "while True: pass", "x", limits=sandbox.Limits(notebook_seconds=3, cell_seconds=30))
    assert statuses(run) == ["ok", "timeout", "not_run"]


def test_limits_cannot_be_raised_from_inside(sandboxed, printed):
    source = """
import resource
for name in ("DATA", "AS", "NPROC", "FSIZE", "NOFILE"):
    number = getattr(resource, "RLIMIT_" + name)
    hard = resource.getrlimit(number)[1]
    try:
        resource.setrlimit(number, (hard + 1, hard + 1))
        print("raised")
    except (ValueError, OSError):
        print("kept")
"""
    assert printed(sandboxed(source), 0).split() == ["kept"] * 5


def test_a_large_work_folder_is_copied_in_part(sandboxed, tmp_path, printed):
    work = tmp_path / "large"
    work.mkdir()
    (work / "a_large.bin").write_bytes(bytes(9 * MIB))
    (work / "b_small.txt").write_text("small")
    run = sandboxed("import os; print(os.listdir('.'))", workdir=work)
    assert printed(run, 0) == "['b_small.txt']"
    assert sandbox.read_folders([work], 8 * MIB) == ({"b_small.txt": b"small"}, ["a_large.bin"])


def test_of_files_of_one_name_the_last_folder_counts(tmp_path):
    for name, files in {"student": {"a.csv": "mine", "b.csv": "mine"}, "released": {"a.csv": "ours"}}.items():
        (tmp_path / name).mkdir()
        for file, content in files.items():
            (tmp_path / name / file).write_text(content)
    (tmp_path / "student/other.ipynb").write_text("{}")
    found, left_out = sandbox.read_folders([tmp_path / "student", tmp_path / "released"], 100)
    assert found == {"a.csv": b"ours", "b.csv": b"mine"} and left_out == []
    found, left_out = sandbox.read_folders([tmp_path / "student", tmp_path / "released"], 5)
    assert found == {"a.csv": b"ours"} and left_out == ["b.csv"]


def test_every_limit_explains_itself():
    for limit in dataclasses.fields(sandbox.Limits):
        assert limit.metadata["unit"] in ("bytes", "seconds", "count") and limit.metadata["help"]


@pytest.mark.parametrize("value", [0, -1, float("nan"), float("inf")])
def test_a_limit_that_makes_no_sense_is_refused_by_name(value):
    with pytest.raises(ValueError, match="cell_seconds must be a positive number of seconds"):
        sandbox.Limits(cell_seconds=value)
