"""System calls that a student's kernel has no use for, as a BPF program for ``bwrap --seccomp``.

Closed are new namespaces and mounts (they would undo the read-only system and
the size limits), memory that belongs to no process or file system we count
(memfd, System V), looking into other processes, and kernel interfaces with a
long record of holes. They fail with EPERM, an ordinary OSError. Sockets are
left only in families that a network namespace holds: AF_VSOCK, which none
holds, would lead out of a virtual machine to its host.
"""

from __future__ import annotations

import errno
import platform
import struct

CLOSED = {
    "x86_64": {
        "ptrace": 101,
        "process_vm_readv": 310,
        "process_vm_writev": 311,
        "kcmp": 312,
        "pidfd_getfd": 438,
        "shmget": 29,
        "shmat": 30,
        "msgget": 68,
        "semget": 64,
        "mq_open": 240,
        "memfd_create": 319,
        "memfd_secret": 447,
        "unshare": 272,
        "setns": 308,
        "mount": 165,
        "umount2": 166,
        "pivot_root": 155,
        "chroot": 161,
        "open_tree": 428,
        "move_mount": 429,
        "fsopen": 430,
        "fsconfig": 431,
        "fsmount": 432,
        "fspick": 433,
        "mount_setattr": 442,
        "keyctl": 250,
        "add_key": 248,
        "request_key": 249,
        "bpf": 321,
        "perf_event_open": 298,
        "userfaultfd": 323,
        "io_uring_setup": 425,
        "io_uring_enter": 426,
        "io_uring_register": 427,
        "kexec_load": 246,
        "kexec_file_load": 320,
        "init_module": 175,
        "finit_module": 313,
        "delete_module": 176,
        "open_by_handle_at": 304,
        "swapon": 167,
        "swapoff": 168,
        "reboot": 169,
        "quotactl": 179,
        "syslog": 103,
        "acct": 163,
        "personality": 135,
        "fanotify_init": 300,
    },
    "aarch64": {
        "ptrace": 117,
        "process_vm_readv": 270,
        "process_vm_writev": 271,
        "kcmp": 272,
        "pidfd_getfd": 438,
        "shmget": 194,
        "shmat": 196,
        "msgget": 186,
        "semget": 190,
        "mq_open": 180,
        "memfd_create": 279,
        "memfd_secret": 447,
        "unshare": 97,
        "setns": 268,
        "mount": 40,
        "umount2": 39,
        "pivot_root": 41,
        "chroot": 51,
        "open_tree": 428,
        "move_mount": 429,
        "fsopen": 430,
        "fsconfig": 431,
        "fsmount": 432,
        "fspick": 433,
        "mount_setattr": 442,
        "keyctl": 219,
        "add_key": 217,
        "request_key": 218,
        "bpf": 280,
        "perf_event_open": 241,
        "userfaultfd": 282,
        "io_uring_setup": 425,
        "io_uring_enter": 426,
        "io_uring_register": 427,
        "kexec_load": 104,
        "kexec_file_load": 294,
        "init_module": 105,
        "finit_module": 273,
        "delete_module": 106,
        "open_by_handle_at": 265,
        "swapon": 224,
        "swapoff": 225,
        "reboot": 142,
        "quotactl": 60,
        "syslog": 116,
        "acct": 89,
        "personality": 92,
        "fanotify_init": 262,
    },
}
CLONE = {"x86_64": 56, "aarch64": 220}
SOCKET = {"x86_64": 41, "aarch64": 198}
IOCTL = {"x86_64": 16, "aarch64": 29}
CLONE3 = 435
AUDIT_ARCH = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
X32_BIT = 0x40000000

NEW_NAMESPACES = 0x7E020080  # CLONE_NEWUSER, NEWPID, NEWNET, NEWIPC, NEWUTS, NEWCGROUP, NEWNS, NEWTIME
SOCKET_FAMILIES = (1, 2, 10, 16)  # AF_UNIX, AF_INET, AF_INET6, AF_NETLINK
NETWORK_IOCTLS = 0x8900  # SIOC*: the inherited sockets belong to the host's network namespace

LOAD, JUMP_EQ, JUMP_GE, JUMP_SET, AND, RETURN = 0x20, 0x15, 0x35, 0x45, 0x54, 0x06
NUMBER, ARCH, FIRST_ARGUMENT, SECOND_ARGUMENT = 0, 4, 16, 24
ALLOW, KILL, ERRNO = 0x7FFF0000, 0x80000000, 0x00050000


class NoFilter(RuntimeError):
    """There is no filter for this kind of machine; the message says for which there is one."""


def program(machine: str | None = None) -> bytes:
    """Return the filter for a kind of machine as an array of ``struct sock_filter``.

    Parameters
    ----------
    machine : str, optional
        A name as `platform.machine` gives it, this machine's by default.

    Raises
    ------
    NoFilter
        If the numbers of its system calls are not known here.
    """
    machine = machine or platform.machine()
    if machine not in CLOSED:
        known = " and ".join(sorted(CLOSED))
        raise NoFilter(f"its filter of system calls is written for {known} machines, this is {machine}")
    refuse = (RETURN, 0, 0, ERRNO | errno.EPERM)
    missing = (RETURN, 0, 0, ERRNO | errno.ENOSYS)
    unknown_family = (RETURN, 0, 0, ERRNO | errno.EAFNOSUPPORT)
    allow = (RETURN, 0, 0, ALLOW)
    code = [
        (LOAD, 0, 0, ARCH),
        (JUMP_EQ, 1, 0, AUDIT_ARCH[machine]),
        (RETURN, 0, 0, KILL),
        (LOAD, 0, 0, NUMBER),
    ]
    if machine == "x86_64":
        code += [(JUMP_GE, 0, 1, X32_BIT), missing]
    for number in sorted(CLOSED[machine].values()):
        code += [(JUMP_EQ, 0, 1, number), refuse]
    # The flags of clone3 lie in memory where a filter cannot look: glibc falls back to clone.
    code += [(JUMP_EQ, 0, 1, CLONE3), missing]
    code += [
        (JUMP_EQ, 0, 4, CLONE[machine]),
        (LOAD, 0, 0, FIRST_ARGUMENT),
        (JUMP_SET, 0, 1, NEW_NAMESPACES),
        refuse,
        allow,
        (JUMP_EQ, 0, len(SOCKET_FAMILIES) + 3, SOCKET[machine]),
        (LOAD, 0, 0, FIRST_ARGUMENT),
        *((JUMP_EQ, left, 0, family) for left, family in zip(range(len(SOCKET_FAMILIES), 0, -1), SOCKET_FAMILIES)),
        unknown_family,
        allow,
        (JUMP_EQ, 0, 4, IOCTL[machine]),
        (LOAD, 0, 0, SECOND_ARGUMENT),
        (AND, 0, 0, 0xFF00),
        (JUMP_EQ, 0, 1, NETWORK_IOCTLS),
        refuse,
        allow,
    ]
    return b"".join(struct.pack("=HBBI", *line) for line in code)
