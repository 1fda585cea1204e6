"""Warm kernels: children of one parent that share nothing of a student's, and cold ones where there is no parent."""

import json
import os
import threading

import psutil
import pytest

from autograder import sandbox
from autograder.sandbox import bubblewrap, warm

pytestmark = pytest.mark.sandbox


IN_TMP = bubblewrap.place_in_private_folder()


@pytest.fixture
def warmed(sandboxed):
    """run_cells on kernels that are known to be warm."""
    if IN_TMP:
        pytest.skip(f"no warm kernels from here: {IN_TMP}")
    sandboxed("1")
    if (reason := sandbox.why_cold()) and os.geteuid() != 0:
        pytest.skip(f"no warm kernels for this user: {reason}")
    assert reason is None
    return sandboxed


@pytest.fixture
def no_parents():
    """Parents that are started in a test are ended with it."""
    warm.end_parents()
    yield
    warm.end_parents()


# What is looked for never stands in the memory that is searched: the memory is turned about, and so is the word.
SEARCH = """
turn = bytes(255 - byte for byte in range(256))
def found(turned, step=4 << 20):
    words = {bytes.fromhex(word): 0 for word in turned}
    with open("/proc/self/maps") as maps, open("/proc/self/mem", "rb", 0) as memory:
        for line in maps:
            places, rights = line.split()[:2]
            if "r" not in rights or "[v" in line:
                continue
            start, end = (int(place, 16) for place in places.split("-"))
            memory.seek(start)
            left = b""
            while start < end and (part := memory.read(min(step, end - start))):
                start += len(part)
                part = left + part.translate(turn)
                for word in words:
                    words[word] += part.count(word)
                left = part[-100:]
    return list(words.values())
"""


def turned(word):
    return bytes(255 - byte for byte in word.encode()).hex()


def test_memory_of_a_warm_kernel_holds_nothing_of_the_grader_and_of_other_students(
    no_parents, warmed, printed, tmp_path, monkeypatch
):
    marks = {name: f"mark-of-{name}-{os.urandom(8).hex()}" for name in ("solution", "grader", "answer", "file", "self")}
    (tmp_path / "solutions").mkdir()
    (tmp_path / "solutions" / "solution.txt").write_text(marks["solution"])
    monkeypatch.chdir(tmp_path / "solutions")
    monkeypatch.setenv("GRADER", marks["grader"])
    warm.end_parents()  # the next one starts beside the marks
    work = tmp_path / "work"
    work.mkdir()
    (work / "notes.txt").write_text(marks["file"])
    keep = f"answer = {marks['answer']!r} * 100; text = open('notes.txt').read(); print(answer, text)"
    hold = threading.Thread(target=warmed, args=(keep, "import time; time.sleep(3)"), kwargs={"workdir": work})
    hold.start()
    warmed(keep, workdir=work)
    own = f"own = bytes(255 - byte for byte in bytes.fromhex({turned(marks['self'])!r})).decode()"
    run = warmed(own, SEARCH, f"print(found({[turned(mark) for mark in marks.values()]!r}))")
    hold.join()
    counts = dict(zip(marks, json.loads(printed(run, 2))))
    assert counts.pop("self") > 0  # the search finds what is there
    assert counts == dict.fromkeys(counts, 0)


def test_siblings_draw_numbers_of_their_own(warmed, printed):
    source = """
import gc, hashlib, os, pickle, random, tempfile, uuid
import numpy, sympy, sympy.core.random
gc.unfreeze()
states = {}
used_at_import_only = sympy.Dummy._prng
for found in gc.get_objects() + [random._inst, sympy.core.random.rng]:
    if type(found) is random.Random and found is not used_at_import_only:
        states[id(found)] = found.getstate()
states["numpy"] = numpy.random.get_state()[1].tolist()
drawn = [hashlib.sha256(pickle.dumps(state)).hexdigest() for state in states.values()]
drawn += [uuid.uuid1().hex, uuid.uuid4().hex, os.urandom(8).hex(), next(tempfile._get_candidate_names())]
drawn += [get_ipython().kernel.session.session, str(numpy.random.default_rng().random())]
import json; print(json.dumps(drawn))
"""
    first, second = (set(json.loads(printed(warmed(source), 0))) for _ in range(2))
    assert len(first) >= 8 and not first & second


def test_a_warm_kernel_keeps_nothing_of_its_start(warmed, printed):
    source = """
import os, stat, sys
status = dict(line.split(":", 1) for line in open("/proc/self/status").read().splitlines())
print([int(status[f"Cap{name}"], 16) for name in ("Inh", "Prm", "Eff", "Bnd", "Amb")], status["Seccomp"].strip())
kinds = {os.readlink(f"/proc/self/fd/{name}").split("[")[0] for name in os.listdir("/proc/self/fd") if int(name) < 9}
print(sorted(kinds))
print(os.getsid(0), os.getpgid(0), os.getppid())
print([name for name in ("enter", "kernel", "warm_parent") if name in sys.modules], os.listdir("/dev/pts"))
def attempt(path):
    try:
        return len(os.listdir(path)) if os.path.isdir(path) else len(open(path, "rb").read())
    except OSError as error:
        return type(error).__name__
print([attempt(f"/proc/1/{name}") for name in ("mem", "fd", "environ")], attempt("/home/student/.warm"))
"""
    lines = printed(warmed(source), 0).splitlines()
    assert lines[0] == "[0, 0, 0, 0, 0] 2"
    assert set(eval(lines[1])) <= {"/dev/null", "pipe:", "socket:", "anon_inode:", "/proc/2/fd"}
    assert lines[2] == "1 1 1"
    assert lines[3] == "[] ['ptmx']"
    assert lines[4] == "['PermissionError', 'PermissionError', 'PermissionError'] FileNotFoundError"


LEAVE = """
import os, socket, time
for place in ("/tmp", "/dev/shm", "/home/student"):
    open(f"{place}/left", "w").write("x")
doors = [socket.create_server(("127.0.0.1", 4321)), socket.socket(socket.AF_UNIX)]
doors[1].bind("\\0left"); doors[1].listen()
terminal = os.openpty()
time.sleep(2)
"""
LOOK = """
import os, socket
def reached(family, address):
    try:
        return socket.socket(family).connect(address) is None
    except OSError:
        return False
print([os.path.exists(f"{place}/left") for place in ("/tmp", "/dev/shm", "/home/student")], os.listdir("/dev/pts"),
      reached(socket.AF_INET, ("127.0.0.1", 4321)), reached(socket.AF_UNIX, "\\0left"))
"""


def test_siblings_do_not_meet(warmed, printed):
    runs = {}
    leaving = threading.Thread(target=lambda: runs.update(left=warmed(LEAVE, LOOK)))
    leaving.start()
    seen = [printed(warmed("import time; time.sleep(0.5)", LOOK), 1) for _ in range(2)]
    leaving.join()
    assert printed(runs["left"], 1) == "[True, True, True] ['0', 'ptmx'] True True"
    assert seen == ["[False, False, False] ['ptmx'] False False"] * 2


def test_signals_to_everybody_reach_no_sibling(warmed, statuses):
    runs = {}
    bystander = threading.Thread(target=lambda: runs.update(by=warmed("x = 1", "import time; time.sleep(2)", "x")))
    bystander.start()
    everybody = "import os, signal\nfor who in (0, -1): os.kill(who, signal.SIGKILL)"
    attacker = warmed("import time; time.sleep(0.5)", everybody)
    bystander.join()
    assert statuses(attacker) == ["ok", "died"]
    assert statuses(runs["by"]) == ["ok"] * 3 and runs["by"].doubt is None
    assert sandbox.why_cold() is None


def test_a_parent_that_died_is_followed_by_another(no_parents, warmed, printed):
    parent = next(iter(warm._parents.values()))
    first = [child for child in psutil.Process().children() if child.name() == "bwrap"]
    for child in first:
        child.kill()
    parent.join()
    assert printed(warmed("print(6 * 7)"), 0) == "42"
    assert sandbox.why_cold() is None and not parent.fault


def test_a_parent_with_nothing_to_do_ends(no_parents, warmed, monkeypatch):
    monkeypatch.setattr(warm, "_IDLE_SECONDS", 0.0)
    (parent,) = warm._parents.values()
    parent.join()
    assert not [child for child in psutil.Process().children() if child.name() == "bwrap"]


def test_a_checkout_in_a_private_folder_is_told(no_parents, monkeypatch):
    monkeypatch.setattr(bubblewrap, "_python_places", lambda: [("/usr/lib", "/usr/lib"), ("/x", "/tmp/clone/.venv")])
    parent = warm.WarmParent(())
    parent.join()
    assert parent.gone and "/tmp/clone/.venv lies in a folder that every kernel has anew" in parent.fault
    monkeypatch.setattr(bubblewrap, "_python_places", lambda: [("/usr/lib", "/usr/lib")])
    monkeypatch.setattr(bubblewrap, "package_folder", lambda name: None)
    assert bubblewrap.place_in_private_folder() is None


@pytest.mark.skipif(IN_TMP is not None, reason="no warm kernels from a checkout in a private folder")
@pytest.mark.parametrize("fault", ["does not start", "cannot import", "cannot make namespaces"])
def test_where_there_is_no_parent_kernels_start_cold_and_say_why(no_parents, sandboxed, printed, monkeypatch, fault):
    if fault == "does not start":
        monkeypatch.setattr(bubblewrap, "start_parent", lambda *arguments, **options: os.stat("/nowhere"))
    elif fault == "cannot import":
        monkeypatch.setattr(warm, "_TEXTS", ("warm_parent", "enter"))
    else:
        monkeypatch.setattr(bubblewrap, "_PARENTING", ())
        if os.geteuid() != 0:
            pytest.skip("an ordinary user's parent holds no privilege that could be missing")
    assert printed(sandboxed("print(6 * 7)"), 0) == "42"
    words = {
        "does not start": "nowhere",
        "cannot import": "No module named 'kernel'",
        "cannot make namespaces": "unshare",
    }
    assert words[fault] in sandbox.why_cold()
