"""What a kernel can read, write and reach; each attack is shown to work without the sandbox where it is harmless."""

import errno
import json
import os
import socket
import struct
import sys
import threading

import pytest

from autograder import sandbox
from autograder.sandbox import bubblewrap, seccomp

pytestmark = pytest.mark.sandbox

READ = """
import os
def attempt(path):
    try:
        return open(path).read() if os.path.isfile(path) else os.listdir(path)
    except OSError as error:
        return type(error).__name__
import json
"""


def reading(*paths):
    return READ + f"print(json.dumps([attempt(path) for path in {[str(path) for path in paths]!r}]))"


@pytest.fixture
def class_folder(tmp_path):
    """A small class beside the work folder."""
    places = ["gradebook.db", "solutions/scara/scara.ipynb", "submitted/other/scara/scara.ipynb"]
    for place in places:
        (tmp_path / place).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / place).write_text("secret")
    return [tmp_path / place for place in places]


def test_gradebook_solutions_and_other_students_cannot_be_read(sandboxed, class_folder, printed):
    source = reading(*class_folder, class_folder[0].parent, "../gradebook.db", "../../gradebook.db")
    assert json.loads(printed(sandboxed(source, mode="none"), 0))[:3] == ["secret"] * 3
    found = json.loads(printed(sandboxed(source), 0))
    assert set(map(str, found)) == {"FileNotFoundError"}


def test_the_grader_itself_cannot_be_read(sandboxed, printed):
    package = os.path.dirname(sandbox.__file__)
    source = reading(package, os.path.join(package, "run.py"), "/var", "/etc/passwd", "/etc/shadow", "/home")
    outside = json.loads(printed(sandboxed(source, mode="none"), 0))
    inside = json.loads(printed(sandboxed(source), 0))
    assert "run.py" in outside[0]
    assert "secret" not in json.dumps(inside) and "run.py" not in json.dumps(inside[:2])
    assert inside[0] == inside[1] == "FileNotFoundError"
    assert inside[4] == "FileNotFoundError"
    assert inside[5] == ["student"] or "student" in inside[5]


def test_autograder_and_solver_cannot_be_imported_but_dhkit_can(sandboxed, statuses):
    sources = ["import autograder", "import dhm", "import dhkit", "import numpy, sympy, matplotlib"]
    assert statuses(sandboxed(*sources, mode="none")) == ["ok", "ok", "ok", "ok"]
    run = sandboxed(*sources)
    assert statuses(run) == ["error", "error", "ok", "ok"]
    assert all(run.cells[i].message.startswith("ModuleNotFoundError") for i in (0, 1))


def test_the_solver_is_private_wherever_it_is_installed(monkeypatch):
    monkeypatch.setattr(bubblewrap, "package_folder", {"dhm": "/usr/lib/dhm"}.get)
    assert "/usr/lib/dhm" in bubblewrap.own_private_folders()


def test_private_folders_below_visible_ones_are_hidden(tmp_path, monkeypatch):
    environment = tmp_path / "environment"
    for folder in ("lib/python3/site-packages/autograder", "lib/python3/site-packages/dhkit", "bin", "src/solutions"):
        (environment / folder).mkdir(parents=True)
    package = environment / "lib/python3/site-packages/autograder"
    monkeypatch.setattr(bubblewrap, "own_private_folders", lambda: [str(package)])
    for name in ("prefix", "exec_prefix"):
        monkeypatch.setattr(bubblewrap.sys, name, str(environment))
    arguments = bubblewrap.mounts(sandbox.Limits())
    bound = [arguments[place + 2] for place, word in enumerate(arguments) if word == "--ro-bind"]
    assert str(environment / "lib") in bound
    assert str(environment) not in bound and not any("src" in path for path in bound if str(environment) in path)
    masks = [
        place for place, word in enumerate(arguments) if word == "--tmpfs" and arguments[place + 1] == str(package)
    ]
    assert masks and masks[0] > arguments.index(str(environment / "lib"))
    closed = [arguments[place + 1] for place, word in enumerate(arguments) if word == "--remount-ro"]
    assert str(package) in closed


def test_a_folder_named_as_hidden_is_not_seen(sandboxed, printed):
    shared = "/usr/share/zoneinfo"
    if not os.path.isdir(shared):
        pytest.skip("no folder to hide")
    source = reading(shared)
    assert json.loads(printed(sandboxed(source), 0)) not in ([], [[]])
    assert json.loads(printed(sandboxed(source, hidden=(shared,)), 0)) == [[]]


def test_dhkit_is_seen_in_a_checkout_that_is_hidden(sandboxed, printed, monkeypatch):
    checkout, kit = "/usr/share/zoneinfo", "/usr/share/zoneinfo/Etc"
    if not os.path.isdir(kit):
        pytest.skip("no folder to take for a checkout")
    monkeypatch.setattr(bubblewrap, "own_private_folders", lambda: [checkout])
    monkeypatch.setattr(bubblewrap, "package_folder", lambda name: kit)
    found = json.loads(printed(sandboxed(reading(checkout, kit)), 0))
    assert found[0] == ["Etc"] and "UTC" in found[1]


WRITE = """
import os
def attempt(path):
    try:
        open(path, "w").write("x")
        return "written"
    except OSError as error:
        return os.strerror(error.errno)
"""


def test_nothing_outside_the_private_places_can_be_written(sandboxed, tmp_path, printed):
    target = tmp_path / "outside.txt"
    source = WRITE + f"print(attempt({str(target)!r}))"
    assert printed(sandboxed(source, mode="none"), 0) == "written"
    assert target.exists()
    target.unlink()
    assert printed(sandboxed(source), 0) != "written"
    assert not target.exists()

    name = tmp_path.name + f"-{os.getpid()}"  # nobody else's, wherever the repository and its environment lie
    package, dhkit = os.path.dirname(os.__file__), bubblewrap.package_folder("dhkit")
    folders = ["", "/dev", "/etc", "/usr", "/usr/lib", "/home", "/var", package, sys.prefix, f"{sys.prefix}/bin", dhkit]
    places = ["/proc/sys/kernel/hostname", *(f"{folder}/{name}" for folder in folders)]
    run = sandboxed(WRITE + f"print([path for path in {places!r} if attempt(path) == 'written'])")
    assert printed(run, 0) == "[]"
    private = [f"/tmp/{name}", f"/home/student/{name}", name, f"/dev/shm/{name}"]
    run = sandboxed(WRITE + f"print([attempt(path) for path in {private!r}])")
    assert printed(run, 0) == str(["written"] * 4)
    assert not any(map(os.path.exists, private)) and not os.path.exists("/home/student")


def test_there_is_no_network(sandboxed, printed):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        threading.Thread(target=lambda: [server.accept() for _ in range(1)], daemon=True).start()
        source = f"""
import socket
try:
    socket.create_connection(("127.0.0.1", {port}), timeout=5)
    print("connected")
except OSError as error:
    print(type(error).__name__)
"""
        assert printed(sandboxed(source, mode="none"), 0) == "connected"
        assert printed(sandboxed(source), 0) == "ConnectionRefusedError"
    run = sandboxed("import socket; print(sorted(name for _, name in socket.if_nameindex()))")
    assert printed(run, 0) == "['lo']"


def test_sockets_of_the_host_are_out_of_reach(sandboxed, tmp_path, printed):
    path = tmp_path / "host.socket"
    abstract = f"\0autograder-test-{os.getpid()}"
    with socket.socket(socket.AF_UNIX) as named, socket.socket(socket.AF_UNIX) as unnamed:
        named.bind(str(path))
        named.listen()
        unnamed.bind(abstract)
        unnamed.listen()
        source = f"""
import socket
for address in ({str(path)!r}, {abstract!r}):
    try:
        socket.socket(socket.AF_UNIX).connect(address)
        print("connected")
    except OSError as error:
        print(type(error).__name__)
"""
        assert printed(sandboxed(source, mode="none"), 0).split() == ["connected"] * 2
        assert "connected" not in printed(sandboxed(source), 0)


def test_inherited_sockets_do_not_tell_of_the_hosts_network(sandboxed, printed):
    source = """
import fcntl, os, socket, struct
told = set()
for fd in map(int, os.listdir("/proc/self/fd")):
    try:
        told.add(fcntl.ioctl(fd, 0x8910, struct.pack("16si20x", b"", 2))[:16].strip(bytes(1)).decode())
    except OSError:
        pass
print(sorted(told))
"""
    outside = printed(sandboxed(source, mode="none"), 0)
    if outside == "[]":
        pytest.skip("this machine has no second network interface to be told of")
    assert printed(sandboxed(source), 0) == "[]"


def test_the_hosts_processes_and_environment_are_not_seen(sandboxed, monkeypatch, printed):
    monkeypatch.setenv("GRADER_TOKEN", "token-of-the-grader")
    source = """
import glob
words = ""
for path in glob.glob("/proc/[0-9]*/environ") + glob.glob("/proc/[0-9]*/cmdline"):
    try:
        words += open(path, errors="replace").read()
    except OSError:
        pass
print("token-of-the-grader" in words, "pytest" in words)
"""
    assert printed(sandboxed(source, mode="none"), 0) == "True True"
    run = sandboxed(source, "import os; print(sorted(int(pid) for pid in os.listdir('/proc') if pid.isdigit()))")
    assert printed(run, 0) == "False False"
    assert len(json.loads(printed(run, 1))) <= 3
    run = sandboxed("import os; print(sorted(os.environ))")
    assert "GRADER_TOKEN" not in printed(run, 0)


def test_privileges_cannot_be_gained(sandboxed, printed):
    source = """
import ctypes, os
libc = ctypes.CDLL(None, use_errno=True)
status = dict(line.split(":", 1) for line in open("/proc/self/status").read().splitlines())
print(os.getuid() != 0, int(status["CapEff"], 16), int(status["CapPrm"], 16), int(status["NoNewPrivs"]))
print([call(*arguments) for call, arguments in [
    (libc.setuid, (0,)), (libc.unshare, (0x10000000,)), (libc.mount, (b"none", b"/tmp", b"tmpfs", 0, None)),
    (libc.ptrace, (16, 1, 0, 0)), (libc.memfd_create, (b"x", 0)), (libc.shmget, (0, 4096, 0o1666)),
    (libc.chroot, (b"/tmp",)), (libc.kill, (1, 9)),
]][:-1])
"""
    run = sandboxed(source)
    assert printed(run, 0).splitlines() == ["True 0 0 1", str([-1] * 7)]
    assert sandboxed("import os; os.kill(1, 9)", "1").cells[1].status == "ok"
    control = "import ctypes; print(ctypes.CDLL(None).memfd_create(b'x', 0) >= 0)"
    assert printed(sandboxed(control, mode="none"), 0) == "True"


LEAVE_BEHIND = """
import os, signal
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        os.execvp("sleep", ["sleep", "{seconds}"])
    os._exit(0)
import subprocess
subprocess.Popen(["sleep", "{seconds}"], start_new_session=True)
"""


def test_processes_left_behind_are_dead_after_the_run(sandboxed, alive):
    seen = []

    def look(index, cell, outputs):
        seen.append(len(alive("sleep 81.4")))

    run = sandboxed(LEAVE_BEHIND.format(seconds="81.4"), "import time; time.sleep(0.5)", followup=look)
    assert run.cells[0].status == "ok"
    assert seen[1] == 2
    assert not alive("sleep 81.4")

    sandboxed(LEAVE_BEHIND.format(seconds="82.4"), "import time; time.sleep(0.5)", mode="none")
    stray = alive("sleep 82.4")
    for process in stray:
        process.kill()
    assert stray


def test_each_sandbox_of_root_has_a_user_of_its_own(needs_sandbox):
    if os.geteuid() != 0:
        pytest.skip("an ordinary user's sandboxes have a user namespace each instead")
    drawn = {bubblewrap.unused_uid() for _ in range(50)}
    assert len(drawn) > 45 and min(drawn) > 0


def test_what_is_handed_over_cannot_be_changed_and_is_closed_in_the_first_process(sandboxed, printed):
    with bubblewrap._handed_over(b"plan") as descriptor:
        assert descriptor > 2 and os.read(descriptor, 10) == b"plan"
        with pytest.raises(PermissionError):
            os.pwrite(descriptor, b"x", 0)
        with pytest.raises(PermissionError):
            os.truncate(descriptor, 0)
    source = """
import os
try:  # open to the sandboxes of an ordinary user
    links = [os.readlink(f"/proc/1/fd/{name}") for name in os.listdir("/proc/1/fd")]
except PermissionError:
    links = []
print([link for link in links if not link.startswith(("/dev/null", "pipe:", "anon_inode:"))])
"""
    assert printed(sandboxed(source), 0) == "[]"


@pytest.mark.parametrize("machine", sorted(seccomp.CLOSED))
def test_every_jump_of_the_filter_lands_inside_it(machine):
    program = seccomp.program(machine)
    lines = [program[place : place + 8] for place in range(0, len(program), 8)]
    assert len(lines) < 4096
    for place, line in enumerate(lines):
        if line[0] & 7 == 5:
            assert place + 1 + max(line[2], line[3]) < len(lines)
    assert int.from_bytes(lines[-1][4:8], "little") == seccomp.ALLOW


def run_filter(program, *, machine, call, arguments=()):
    """What a filter returns for a system call: an interpreter of the few instructions that it uses."""
    data = struct.pack("<iIQ6Q", call, seccomp.AUDIT_ARCH[machine], 0, *arguments, *[0] * (6 - len(arguments)))
    lines = list(struct.iter_unpack("=HBBI", program))
    place = value = 0
    while True:
        code, yes, no, constant = lines[place]
        place += 1
        if code == seccomp.RETURN:
            return constant
        if code == seccomp.LOAD:
            value = int.from_bytes(data[constant : constant + 4], "little")
        elif code == seccomp.AND:
            value &= constant
        else:
            test = {
                seccomp.JUMP_EQ: value == constant,
                seccomp.JUMP_GE: value >= constant,
                seccomp.JUMP_SET: bool(value & constant),
            }
            place += yes if test[code] else no


@pytest.mark.parametrize("machine", sorted(seccomp.CLOSED))
def test_only_four_families_of_sockets_are_open(machine):
    program = seccomp.program(machine)
    answers = {
        family: run_filter(program, machine=machine, call=seccomp.SOCKET[machine], arguments=(family,))
        for family in (*range(64), 1 << 31)
    }
    opened = {family for family, answer in answers.items() if answer == seccomp.ALLOW}
    assert opened == {socket.AF_UNIX, socket.AF_INET, socket.AF_INET6, socket.AF_NETLINK}
    assert {answers[family] for family in answers.keys() - opened} == {seccomp.ERRNO | errno.EAFNOSUPPORT}
    assert run_filter(program, machine=machine, call=seccomp.CLOSED[machine]["mount"]) == seccomp.ERRNO | errno.EPERM
    assert run_filter(program, machine=machine, call=seccomp.CLONE[machine], arguments=(0x11,)) == seccomp.ALLOW
    assert run_filter(program, machine=machine, call=seccomp.IOCTL[machine], arguments=(1, 0x5401)) == seccomp.ALLOW
    assert run_filter(program, machine=machine, call=seccomp.IOCTL[machine], arguments=(1, 0x8912)) != seccomp.ALLOW


def test_a_socket_to_the_host_of_a_virtual_machine_cannot_be_made(sandboxed, printed):
    source = """
import socket
def attempt(family):
    try:
        return bool(socket.socket(family, socket.SOCK_STREAM if family != 16 else socket.SOCK_RAW))
    except OSError as error:
        return error.errno
print([attempt(family) for family in (1, 2, 10, 16, 40, 38, 17)])
"""
    assert printed(sandboxed(source), 0) == str([True] * 4 + [errno.EAFNOSUPPORT] * 3)


def test_a_machine_without_a_filter_is_refused_in_words(monkeypatch):
    monkeypatch.setattr(seccomp.platform, "machine", lambda: "vax")
    bubblewrap.available.cache_clear()
    try:
        assert "written for aarch64 and x86_64 machines, this is vax" in sandbox.available()
    finally:
        bubblewrap.available.cache_clear()


@pytest.mark.parametrize(
    ("output", "word"),
    [
        ("bwrap: No permissions to create new namespace, likely because the kernel does not", "sysctl"),
        ("bwrap: setting up uid map: Permission denied", "sysctl"),
        ("bwrap: Unknown option --size", "too old"),
        ("bwrap: Can't find source path /x/bin/python: Permission denied", "chmod"),
        ("Traceback\nPermissionError: [Errno 13] Permission denied: '/x/bin/python'", "chmod"),
        ("", "no message"),
    ],
)
def test_reasons_say_what_to_do(output, word):
    assert word in bubblewrap.explain(output)


def test_a_missing_bubblewrap_is_named_with_its_remedy(monkeypatch):
    monkeypatch.setattr(bubblewrap.shutil, "which", lambda name: None)
    bubblewrap.available.cache_clear()
    try:
        assert "apt-get install bubblewrap" in sandbox.available()
    finally:
        bubblewrap.available.cache_clear()
