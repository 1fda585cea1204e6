"""What a sandbox can see, as arguments of ``bwrap``, and the process started from them.

A kernel sees the system read-only, its Python environment read-only, the
package ``dhkit`` read-only, and private file systems of limited size. Nothing
of the host can be written, and nothing else of the host can be read.
"""

from __future__ import annotations

import fcntl
import functools
import importlib.util
import marshal
import math
import os
import random
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import psutil

from . import seccomp
from .limits import Limits

HOME = "/home/student"
WORK = HOME + "/work"
PRIVATE = ("/tmp", "/dev/shm", HOME)
_STUDENT_UID = 1000
_NICE = 10  # a tenth of the weight of what runs beside it; at 19 it would starve beside anything busy
_PROBE_SECONDS = 300  # a busy machine may need long for it

_SYSTEM = ("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32")
_CONFIGURATION = ("/etc/ld.so.cache", "/etc/fonts", "/etc/localtime", "/etc/alternatives", "/etc/mime.types")
_ENVIRONMENT_PARTS = ("bin", "lib", "lib64", "share", "ssl", "pyvenv.cfg")
# What root's kernel needs to become an ordinary user's, and what a warm parent needs to make its children's sandboxes;
# an ordinary user's parent gives each child a user namespace for that.
_ENTERING = ("CAP_SETUID", "CAP_SETGID")
_PARENTING = (*_ENTERING, "CAP_SETPCAP", "CAP_SYS_ADMIN", "CAP_NET_ADMIN")
_NEVER_SHOWN = ("/usr/local/etc",)  # Jupyter and nbgrader configuration may hold passwords

_INSTALL = "install it: apt-get install bubblewrap (Fedora: dnf install bubblewrap)"
_NAMESPACES = (
    "this user may not create user namespaces: run as root, or as root allow them with"
    " 'sysctl -w kernel.unprivileged_userns_clone=1' (Debian) or"
    " 'sysctl -w kernel.apparmor_restrict_unprivileged_userns=0' (Ubuntu 24.04 and later);"
    " in a container start it with --privileged"
)


class SandboxUnavailable(RuntimeError):
    """No sandbox can be had here; the message says what is missing and how to get it."""


def _kernel_environment() -> dict[str, str]:
    """The whole environment of a sandboxed kernel."""
    threads = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMEXPR_NUM_THREADS")
    return {
        "PATH": f"{sys.prefix}/bin:/usr/local/bin:/usr/bin:/bin",
        "HOME": HOME,
        "USER": "student",
        "LANG": "C.UTF-8",
        "TMPDIR": "/tmp",
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
        "MALLOC_ARENA_MAX": "2",
        "PYTHONDONTWRITEBYTECODE": "1",
        **dict.fromkeys(threads, "1"),
    }


def _python_places() -> list[tuple[str, str]]:
    """(host path, path inside) of everything the running Python needs, files and folders."""
    prefixes = dict.fromkeys((sys.prefix, sys.exec_prefix, sys.base_prefix, sys.base_exec_prefix))
    places = [
        (os.path.realpath(os.path.join(root, part)), os.path.join(root, part))
        for prefix in prefixes
        for root in dict.fromkeys((prefix, os.path.realpath(prefix)))
        for part in _ENVIRONMENT_PARTS
        if os.path.exists(os.path.join(root, part))
    ]
    hop = sys.executable
    while os.path.islink(hop):
        places.append((os.path.realpath(hop), hop))
        hop = os.path.normpath(os.path.join(os.path.dirname(hop), os.readlink(hop)))
    places.append((os.path.realpath(hop), hop))
    return places


def package_folder(name: str) -> str | None:
    """Folder of an installed package, found without importing it."""
    spec = importlib.util.find_spec(name)
    return spec.submodule_search_locations[0] if spec and spec.submodule_search_locations else None


def own_private_folders() -> list[str]:
    """This package's own folder, that of the solver and, when it is run from a checkout, the whole checkout."""
    package = Path(__file__).resolve().parents[1]
    installed = package.parent.name in ("site-packages", "dist-packages")
    checkout = [] if installed else [str(package.parent)]
    return [str(package), *checkout, *map(os.path.realpath, filter(None, [package_folder("dhm")]))]


def _inside(path: str, folder: str) -> bool:
    """Whether path lies strictly below folder."""
    return path != folder and os.path.commonpath((path, folder)) == folder


def place_in_private_folder() -> str | None:
    """A place that Python needs and that lies in a folder which every kernel has anew, as a checkout in /tmp does; None if none."""
    places = [path for _, path in _python_places()] + [path for path in [package_folder("dhkit")] if path]
    return next((path for path in places if any(_inside(path, folder) for folder in PRIVATE)), None)


def mounts(limits: Limits, hidden: Iterable[str] = ()) -> list[str]:
    """The bwrap arguments that build the file system of one sandbox.

    ``hidden`` names host folders that must not be seen even where a folder
    above them is bound.
    """
    visible: dict[str, list[str]] = {}
    for path in _SYSTEM:
        if os.path.islink(path):
            visible[path] = ["--symlink", os.readlink(path), path]
        elif os.path.exists(path):
            visible[path] = ["--ro-bind", path, path]
    for path in _CONFIGURATION:
        if os.path.exists(path):
            visible[path] = ["--ro-bind", os.path.realpath(path), path]
    places = _python_places()
    dhkit = package_folder("dhkit")
    if dhkit is not None:
        places.append((os.path.realpath(dhkit), dhkit))
    for source, path in sorted(places, key=lambda place: place[1]):
        if not any(path == other or _inside(path, other) for other in visible):
            visible[path] = ["--ro-bind", source, path]

    masks = [
        path
        for path in dict.fromkeys((*_NEVER_SHOWN, *own_private_folders(), *map(os.path.realpath, hidden)))
        if os.path.isdir(path) and any(_inside(path, other) for other in visible)
    ]
    masks = [path for path in masks if not any(_inside(path, other) for other in masks)]
    needed = [place for place in places if any(_inside(place[1], mask) for mask in masks)]
    # bwrap gives the folders above a mount the mode 0700: only root could pass through them.
    above = {str(parent) for path in visible for parent in Path(path).parents} - {"/"}
    steps = {path: ["--perms", "0755", "--dir", path] for path in above}
    steps |= visible
    for path in masks:
        steps[path] = ["--perms", "0555", "--size", "65536", "--tmpfs", path]
    for source, path in needed:
        steps[path] = ["--ro-bind", source, path]
    steps["/proc"] = ["--proc", "/proc"]
    steps["/dev"] = ["--dev", "/dev"]
    for path in PRIVATE:
        steps[path] = ["--perms", "1777", "--size", str(limits.disk), "--tmpfs", path]
    ordered = sorted(steps, key=lambda path: (path.count("/"), path))
    arguments = [word for path in ordered for word in steps[path]]
    for path in (*masks, "/dev", "/"):
        arguments += ["--remount-ro", path]
    return arguments


def unused_uid() -> int:
    """A user id that nobody has, for one sandbox started by root; a different one at each call."""
    with open("/proc/self/uid_map") as file:
        top = max(int(start) + int(length) for start, _, length in map(str.split, file)) - 1
    low, high = (1 << 30, 1 << 31) if top >= 1 << 31 else (top - min(5000, top // 2), top - 2)
    return random.SystemRandom().randrange(low, high)


def _process_quota(limits: Limits, uid: int | None) -> int:
    """Value for RLIMIT_NPROC.

    Since Linux 5.14 processes are counted per user namespace, before that per
    user over the whole machine, where an ordinary user's other processes count too.
    """
    release = tuple(int(part) for part in os.uname().release.split(".")[:2] if part.isdigit())
    if uid is not None or release >= (5, 14):
        return limits.processes
    mine = os.getuid()
    running = psutil.process_iter(["uids", "num_threads"])
    return limits.processes + sum(
        process.info["num_threads"] or 0
        for process in running
        if process.info["uids"] and process.info["uids"].real == mine
    )


def _resource_limits(limits: Limits, uid: int | None) -> dict[str, tuple[int, int]]:
    """Names and (soft, hard) values for setrlimit in each process of the sandbox.

    RLIMIT_DATA counts what can be written, so that a large allocation fails
    in the cell that asks for it, a little before the whole sandbox is stopped;
    RLIMIT_AS leaves room for libraries mapped and reserved but never touched,
    and catches shared mappings.
    """
    same = {
        "RLIMIT_DATA": limits.memory - limits.memory // 8,
        "RLIMIT_AS": limits.memory + (3 << 30),
        "RLIMIT_NPROC": _process_quota(limits, uid),
        "RLIMIT_FSIZE": limits.file_size,
        "RLIMIT_NOFILE": limits.open_files,
        # 1 and not 0: only so does a system that pipes core dumps into a program make none.
        "RLIMIT_CORE": 1,
    }
    bounds = {name: (value, value) for name, value in same.items()}
    # The whole family is watched from outside; this ends a process where the watch itself does not get to run.
    seconds = math.ceil(limits.notebook_seconds) + 10
    return bounds | {"RLIMIT_CPU": (seconds, seconds + 5)}


def _namespaces(capabilities: Iterable[str]) -> list[str]:
    """bwrap arguments for namespaces and privileges; root's sandbox keeps these capabilities, another user's none."""
    common = [
        "--unshare-ipc", "--unshare-pid", "--unshare-net", "--unshare-uts", "--unshare-cgroup-try",
        "--hostname", "sandbox", "--die-with-parent", "--new-session", "--cap-drop", "ALL",
    ]  # fmt: skip
    if os.geteuid() != 0:
        return [*common, "--unshare-user", "--uid", str(_STUDENT_UID), "--gid", str(_STUDENT_UID)]
    return [*common, *(word for name in capabilities for word in ("--cap-add", name))]


def _plan(argv: Sequence[str], limits: Limits, files: Mapping[str, bytes]) -> dict[str, Any]:
    """Return what a kernel is told at its start: its command, the user to be, files by their names below the home, bounds."""
    uid = unused_uid() if os.geteuid() == 0 else None
    return {
        "argv": list(argv),
        "uid": uid,
        "home": HOME,
        "cwd": WORK,
        "files": dict(files),
        "limits": _resource_limits(limits, uid),
        "nice": _NICE,
        "env": _kernel_environment(),
    }


def start(
    argv: Sequence[str],
    *,
    limits: Limits,
    files: Mapping[str, bytes] | None = None,
    hidden: Iterable[str] = (),
    pass_fds: Sequence[int] = (),
) -> subprocess.Popen[bytes]:
    """Start a command in a new sandbox; its output goes to the returned process's ``stdout`` pipe.

    Parameters
    ----------
    argv : sequence of str
        The command, its program with its whole path.
    limits : Limits
    files : mapping of str to bytes, optional
        Files by their names below the home, written there first.
    hidden : iterable of str
        Folders of the host that must not be seen.
    pass_fds : sequence of int
        Descriptors that the command inherits.

    Raises
    ------
    SandboxUnavailable
        If there is no bubblewrap, no /proc, or no filter of system calls for this machine.
    """
    arguments = [*_namespaces(_ENTERING), *mounts(limits, hidden)]
    with _handed_over(_filter()) as filter_file:
        arguments += ["--seccomp", str(filter_file)]
        return _bwrap(arguments, _plan(argv, limits, files or {}), (filter_file, *pass_fds))


def start_parent(
    argv: Sequence[str], *, files: Mapping[str, bytes], hidden: Iterable[str], pass_fds: Sequence[int]
) -> subprocess.Popen[bytes]:
    """Start a command that makes sandboxes for others inside its own, as `start` otherwise.

    It keeps what it needs for that and has no bounds: it must not run anything of a student's.
    """
    unbounded = _plan(argv, Limits(), files) | {"uid": None, "limits": {}, "nice": 0}
    return _bwrap([*_namespaces(_PARENTING), *mounts(Limits(), hidden)], unbounded, pass_fds)


@contextmanager
def child_plan(argv: Sequence[str], *, limits: Limits, files: Mapping[str, bytes]) -> Iterator[int]:
    """A descriptor of what the child of a warm parent is told: its plan, and what bwrap does for others."""
    private = dict.fromkeys(PRIVATE, limits.disk)
    with _handed_over(marshal.dumps(_plan(argv, limits, files) | {"private": private, "filter": _filter()})) as told:
        yield told


def _filter() -> bytes:
    """Return the filter of system calls for this machine; `SandboxUnavailable` if there is none."""
    try:
        return seccomp.program()
    except seccomp.NoFilter as reason:
        raise SandboxUnavailable(f"{reason}; grade on one of those") from None


def _bwrap(arguments: Sequence[str], plan: dict[str, Any], pass_fds: Sequence[int]) -> subprocess.Popen[bytes]:
    """Start bubblewrap with these arguments, and in it the command of a plan."""
    bwrap = shutil.which("bwrap")
    if bwrap is None:
        raise SandboxUnavailable(f"bubblewrap (bwrap) is not installed; {_INSTALL}")
    if not os.path.exists("/proc/self/uid_map"):
        raise SandboxUnavailable("/proc is not mounted here; as root mount it: mount -t proc proc /proc")
    with ExitStack() as stack:
        plan_file = stack.enter_context(_handed_over(marshal.dumps(plan)))
        argument_file = stack.enter_context(_handed_over(b"".join(os.fsencode(word) + b"\0" for word in arguments)))
        enter = Path(__file__).with_name("enter.py").read_text()
        python = [sys.executable, "-I", "-S", "-c", enter, str(plan_file)]
        return subprocess.Popen(
            [bwrap, "--args", str(argument_file), "--", *python],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            pass_fds=(argument_file, plan_file, *pass_fds),
            # The first process of a sandbox keeps the environment it was started with, in sight of the others.
            env={},
            start_new_session=True,
        )


@contextmanager
def _handed_over(content: bytes) -> Iterator[int]:
    """A descriptor of a file in memory with this content, read from its start, that nobody can change.

    It is not one of the first three, which the first process of a sandbox would keep open in sight of the others.
    """
    first = os.memfd_create("handed-over", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
    descriptor = fcntl.fcntl(first, fcntl.F_DUPFD_CLOEXEC, 3)
    os.close(first)
    try:
        with open(descriptor, "wb", closefd=False) as file:
            file.write(content)
        seals = fcntl.F_SEAL_SEAL | fcntl.F_SEAL_SHRINK | fcntl.F_SEAL_GROW | fcntl.F_SEAL_WRITE
        fcntl.fcntl(descriptor, fcntl.F_ADD_SEALS, seals)
        os.lseek(descriptor, 0, os.SEEK_SET)
        yield descriptor
    finally:
        os.close(descriptor)


@functools.cache
def available() -> str | None:
    """None when a sandbox starts here, else the reason in words, with what to do about it."""
    if not sys.platform.startswith("linux"):
        return f"bubblewrap exists for Linux only, this is {sys.platform}"
    packages = [folder for folder in map(package_folder, ("ipykernel", "dhkit")) if folder]
    probe = f"for folder in {packages}: open(folder + '/__init__.py').close()"
    try:
        process = start([sys.executable, "-c", probe], limits=Limits())
        output, _ = process.communicate(timeout=_PROBE_SECONDS)
    except SandboxUnavailable as error:
        return str(error)
    except OSError as error:
        return f"a trial sandbox could not be started: {error}"
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return f"a trial sandbox did not finish within {_PROBE_SECONDS} s"
    if process.returncode == 0:
        return None
    return explain(output.decode(errors="replace").strip())


def explain(output: str) -> str:
    """The reason why a trial sandbox failed, in words."""
    if "nknown option" in output:
        return f"bubblewrap is too old (0.8 or newer is needed): {output.splitlines()[0]}"
    refused = ("No permissions to creat", "Operation not permitted", "setting up uid map", "ermission denied")
    unreadable = "find source path" in output and "ermission denied" in output
    if output.startswith("bwrap:") and not unreadable and any(words in output for words in refused):
        return f"bubblewrap cannot build a sandbox ({output.splitlines()[0]}): {_NAMESPACES}"
    if "ermission denied" in output:
        return (
            "a sandboxed kernel, which is not root even when root starts it, cannot read its Python environment or"
            f" dhkit ({output.splitlines()[-1]}): chmod -R a+rX {sys.prefix} and the folder of dhkit"
        )
    last = output.splitlines()[-1] if output else "no message"
    return f"a trial sandbox failed: {last}"
