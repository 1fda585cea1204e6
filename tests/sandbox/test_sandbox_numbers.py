"""A process's number is given again: nobody is killed, or watched, who only has the number of a kernel that is gone."""

import os
import signal
import subprocess
import sys

import psutil
import pytest

from autograder.sandbox import cold, watch
from autograder.sandbox.cold import ColdKernel

PASSES_ON = """
import subprocess, sys
child = subprocess.Popen(["cat"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
print(child.pid, flush=True)
for line in sys.stdin:
    child.stdin.write(line.encode())
    child.stdin.flush()
    if not (answer := child.stdout.readline()):
        break
    print(answer.decode(), end="", flush=True)
"""


class Stranger:
    """Somebody else's process with a child, in a group of their own; a line said to it comes back through both."""

    def __init__(self):
        self.process = subprocess.Popen(
            [sys.executable, "-S", "-c", PASSES_ON],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            start_new_session=True,
        )
        self.child = psutil.Process(int(self.process.stdout.readline()))

    def lives(self):
        """Whether both do their work: a process that was sent the signal to die does none, dead or not yet."""
        self.process.stdin.write("still here\n")
        self.process.stdin.flush()
        return self.process.stdout.readline() == "still here\n"


@pytest.fixture
def stranger():
    found = Stranger()
    yield found
    found.process.kill()
    found.process.communicate()


@pytest.mark.parametrize("under_bwrap", [True, False], ids=["bwrap", "none"])
def test_a_stranger_with_the_number_of_a_kernel_that_is_gone_lives_on(stranger, under_bwrap):
    process = subprocess.Popen(["true"], stdout=subprocess.PIPE, start_new_session=True)
    process.wait()
    process.pid = stranger.process.pid
    kernel = ColdKernel(process, under_bwrap)
    kernel.kill()
    kernel.close()
    assert stranger.lives()


def test_a_stranger_with_the_number_of_a_child_lives_on(stranger, monkeypatch):
    """The child that was seen is gone at the moment of the signal, and its number was given again."""
    with subprocess.Popen(["sleep", "600"], stdout=subprocess.PIPE, start_new_session=True) as process:
        monkeypatch.setattr(psutil.Process, "children", lambda self: [stranger.child])
        ColdKernel(process, sandboxed=True).kill()
        process.kill()
    assert stranger.lives()


def test_a_child_is_killed_and_no_one_elses(stranger):
    cold._kill_child(stranger.child.pid, os.getpid())
    assert stranger.lives()
    cold._kill_child(stranger.child.pid, stranger.process.pid)
    assert not stranger.lives()


def test_what_a_kernel_leaves_behind_in_its_group_ends_with_it():
    source = "import subprocess; print(subprocess.Popen(['sleep', '600']).pid, flush=True); input()"
    command = [sys.executable, "-S", "-c", source]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True)
    with process:
        child = psutil.Process(int(process.stdout.readline()))
        process.send_signal(signal.SIGKILL)
        kernel = ColdKernel(process, sandboxed=False)
        while kernel.poll() is None:
            pass
    child.wait(60)
    assert process.returncode == -signal.SIGKILL


def test_a_stranger_with_the_number_of_a_family_that_is_gone_is_not_watched(stranger):
    root = psutil.Process(stranger.process.pid)
    assert watch.family(root) == [root, stranger.child]
    root._ident = (root.pid, root.create_time() - 1)  # whoever was watched started earlier
    assert watch.family(root) == []
