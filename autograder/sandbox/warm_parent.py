"""The warm parent: imports what notebooks need once, and forks a kernel for each of them.

This module is never imported by the grader. It runs inside a sandbox, its text with those of `enter` and `kernel`
lying beside it. It never runs a line of a student's and reads nothing of theirs: what a kernel needs comes in a file
that only the child opens. A child gets namespaces and private file systems of its own, gives up what it could do to
make them, and takes on the same bounds as a kernel that was started cold.

For every child there are three processes: one that waits outside its namespaces and tells the grader how it ended,
the first process inside, which takes all others with it when it ends, and the kernel.
"""

import ctypes
import fcntl
import functools
import gc
import importlib
import io
import marshal
import os
import random
import signal
import socket
import struct
import sys
import traceback

import enter
import kernel

LIBC = ctypes.CDLL(None, use_errno=True)
NEW_USER = 0x10000000
NAMESPACES = 0x20000 | 0x4000000 | 0x8000000 | 0x20000000 | 0x40000000  # mounts, host name, IPC, processes, network
READ_ONLY, NO_SETUID, NO_DEVICES, NO_PROGRAMS, RECURSIVE, PRIVATE = 1, 2, 4, 8, 1 << 14, 1 << 18
SET_DEATH_SIGNAL, SET_DUMPABLE, SET_SECCOMP, DROP_BOUNDING, NO_NEW_PRIVILEGES, AMBIENT = 1, 4, 22, 24, 38, 47
CAPABILITIES_3 = 0x20080522
GET_FLAGS, SET_FLAGS, UP = 0x8913, 0x8914, 1
REPORT = 3  # descriptor of a child that it reports on; the kernel's sockets follow
HIGH = 64  # a descriptor above all that is in use
MESSAGE = 200
FORMULAS = 500  # pictures of a few kilobytes


def call(function, *arguments):
    """Call a function of the C library; OSError if it fails."""
    result = getattr(LIBC, function)(*arguments)
    if result < 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{function}: {os.strerror(number)}")
    return result


def prctl(option, *values):
    return call("prctl", option, *map(ctypes.c_ulong, (*values, *[0] * (4 - len(values)))))


def warm_up(modules):
    """Load what notebooks import, and do once what is slow the first time: fonts, formulas, SymPy's caches.

    Of the modules, the last one has a function ``rehearse``, which may leave figures; the last of them is drawn.
    """
    for module in modules:
        importlib.import_module(module)
    share_formulas()
    import matplotlib.pyplot as plt
    import numpy
    import sympy

    plt.switch_backend("agg")  # a kernel chooses its own
    sys.modules[modules[-1]].rehearse()
    plt.savefig(io.BytesIO(), format="png", bbox_inches="tight")
    plt.close("all")

    a, b, c = sympy.symbols("a b c")
    turn = sympy.Matrix([[sympy.cos(a), -sympy.sin(a), b], [sympy.sin(a), sympy.cos(a), 0], [0, 0, 1]])
    product = (turn * turn.subs(a, c)).applyfunc(sympy.simplify)
    sympy.latex(product), str(product), product.subs({a: 0.1, b: 0.2, c: 0.3}).evalf()
    sympy.lambdify((a, b, c), product)(0.1, 0.2, 0.3)
    numpy.linalg.inv(numpy.eye(3))


def share_formulas():
    """Let all figures of a kernel use each other's formulas: Matplotlib would lay out every label anew for each figure."""
    from matplotlib import mathtext
    from matplotlib.backends import backend_agg

    backend_agg.MathTextParser = functools.cache(mathtext.MathTextParser)
    laid_out = mathtext.MathTextParser._parse_cached
    mathtext.MathTextParser._parse_cached = functools.lru_cache(FORMULAS)(laid_out.__wrapped__)


def shared_bytes():
    """Memory that a notebook is not charged for, because the parent has it anyway.

    That is what was reserved and never touched, and half of the rest: a notebook of the course writes to less.
    """
    with open("/proc/self/status") as file:
        sizes = {name: value.split()[0] for name, value in (line.split(":", 1) for line in file) if "kB" in value}
    return (int(sizes["VmData"]) - int(sizes["RssAnon"]) // 2) << 10


def fresh_randomness():
    """Give a child random numbers of its own; Python's own generator sees to itself at a fork."""
    import numpy
    import sympy.core.random

    numpy.random.seed()  # noqa: NPY002 - the one that students may use
    sympy.core.random.seed(random.SystemRandom().getrandbits(128))


def separate(plan, user, group):
    """Leave the parent's namespaces; without root's privileges only a user namespace of its own allows that."""
    if plan["uid"] is not None:
        call("unshare", NAMESPACES)
        return
    call("unshare", NAMESPACES | NEW_USER)
    for name, content in (("setgroups", "deny"), ("uid_map", f"{user} {user} 1"), ("gid_map", f"{group} {group} 1")):
        with open(f"/proc/self/{name}", "w") as file:
            file.write(content)


def mount(kind, place, flags, options=""):
    call("mount", kind.encode(), place.encode(), kind.encode(), ctypes.c_ulong(flags), options.encode())


def build(private):
    """Mount what must not be shared: processes, terminals and the private folders; start the loopback device."""
    mount("none", "/", RECURSIVE | PRIVATE)
    mount("proc", "/proc", READ_ONLY | NO_SETUID | NO_DEVICES | NO_PROGRAMS)
    mount("devpts", "/dev/pts", NO_SETUID | NO_PROGRAMS, "newinstance,ptmxmode=0666,mode=620")
    for place, size in private.items():
        mount("tmpfs", place, NO_SETUID | NO_DEVICES, f"mode=1777,size={size}")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        device = struct.pack("16sH14x", b"lo", 0)
        _, flags = struct.unpack("16sH14x", fcntl.ioctl(any_socket, GET_FLAGS, device))
        fcntl.ioctl(any_socket, SET_FLAGS, struct.pack("16sH14x", b"lo", flags | UP))


def give_up_bounding():
    """Give up every capability that a program started later could gain."""
    prctl(NO_NEW_PRIVILEGES, 1)
    prctl(AMBIENT, 4)
    with open("/proc/sys/kernel/cap_last_cap") as file:
        last = int(file.read())
    for capability in range(last + 1):
        prctl(DROP_BOUNDING, capability)


def give_up_capabilities():
    call("capset", struct.pack("Ii", CAPABILITIES_3, 0), bytes(24))


def close_calls(program):
    """Take on the filter of system calls."""
    instructions = ctypes.create_string_buffer(program, len(program))
    count_and_place = struct.pack("HxxxxxxP", len(program) // 8, ctypes.addressof(instructions))
    wanted = ctypes.create_string_buffer(count_and_place, len(count_and_place))
    prctl(SET_SECCOMP, 2, ctypes.addressof(wanted))


def keep_only(descriptors):
    """Close all descriptors but the standard ones and these, which become the first behind them, in their order."""
    high = [fcntl.fcntl(descriptor, fcntl.F_DUPFD, HIGH) for descriptor in descriptors]
    os.closerange(REPORT, HIGH)
    for number, descriptor in enumerate(high, REPORT):
        os.dup2(descriptor, number)
    os.closerange(REPORT + len(high), max(map(int, os.listdir("/proc/self/fd"))) + 1)


def status_of(status):
    """The exit status as a shell gives it."""
    code = os.waitstatus_to_exitcode(status)
    return 128 - code if code < 0 else code


def wait_outside(plan_file, report, console, doors, user, group):
    """The process outside: make the namespaces, start the first process in them, tell how it ended."""
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    os.dup2(console, 1)
    os.dup2(console, 2)
    keep_only([report, *doors, plan_file])
    with open(REPORT + 1 + len(doors), "rb") as file:
        plan = marshal.load(file)
    separate(plan, user, group)
    first = os.fork()
    if first == 0:
        in_child(be_first, plan)
    try:
        with socket.socket(fileno=os.dup(REPORT)) as channel:
            socket.send_fds(channel, [b"started"], [os.pidfd_open(first)])
        os.closerange(REPORT + 1, HIGH)
        _, status = os.waitpid(first, 0)
        os.write(REPORT, b"ended %d" % status_of(status))
    except OSError:
        os.kill(first, signal.SIGKILL)  # nobody listens any more


def be_first(plan):
    """The first process inside: build the file systems, start the kernel, and bury whoever dies."""
    prctl(SET_DEATH_SIGNAL, signal.SIGKILL)
    os.setsid()
    build(plan["private"])
    give_up_bounding()
    own = os.fork()
    if own == 0:
        in_child(become_kernel, plan)
    give_up_capabilities()
    prctl(SET_DUMPABLE, 0)
    close_calls(plan["filter"])
    keep_only([])
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # what has no handler does not reach a first process
    while True:
        process, status = os.wait()
        if process == own:
            os._exit(status_of(status))


def become_kernel(plan):
    """The kernel: take on everything that bounds it, before the first line of a student's."""
    fresh_randomness()
    plan["limits"]["RLIMIT_DATA"] = (plan["limits"]["RLIMIT_DATA"][0] + shared_bytes(),) * 2
    enter.settle(plan)
    give_up_capabilities()
    prctl(SET_DUMPABLE, 1)  # as after exec: its memory and descriptors are its own
    close_calls(plan["filter"])
    for name in ("enter", "kernel"):
        del sys.modules[name]  # files beside a notebook may have these names
    sys.argv = ["-c", *plan["argv"]]
    os.write(REPORT, b"ready")
    os.close(REPORT)
    run_kernel(plan["argv"])


def run_kernel(options):
    """Be a kernel, and end as a program does that is nothing else."""
    status = 0
    try:
        kernel.launch(options)
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc(file=sys.__stderr__)
        status = 1
    os._exit(status)


def in_child(run, *arguments):
    """Do what a forked process is there for, and end it; what goes wrong is reported."""
    try:
        run(*arguments)
    except BaseException as error:
        traceback.print_exc(file=sys.__stderr__)
        os.write(REPORT, f"failed {error}".encode()[:MESSAGE])
        os._exit(1)
    os._exit(0)


def main():
    control = socket.socket(fileno=int(sys.argv[1]))
    sys.path.remove(os.path.dirname(__file__))
    warm_up(sys.argv[2:])
    if (threads := len(os.listdir("/proc/self/task"))) != 1:
        raise RuntimeError(f"{threads} threads after the imports: a fork would lose all but one")
    user, group = os.getuid(), os.getgid()
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # children are not waited for
    gc.collect()
    gc.freeze()  # a child's collector would write to every page it shares
    control.send(b"ready")
    while True:
        message, descriptors, _, _ = socket.recv_fds(control, MESSAGE, 16)
        if not message:
            return
        plan_file, report, console, *doors = descriptors
        if os.fork() == 0:
            in_child(wait_outside, plan_file, report, console, doors, user, group)
        for descriptor in descriptors:
            os.close(descriptor)


if __name__ == "__main__":
    main()
