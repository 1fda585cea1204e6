"""Time is counted fairly: processor time of the whole family, and the clock only while nothing holds it up."""

import os
import re
import signal
import subprocess
import sys

import psutil
import pytest

from autograder import sandbox
from autograder.sandbox import clock, watch
from autograder.sandbox.clock import LOAD_FACTOR, FairClock, Observation, Spent, is_over, time_up

pytestmark = pytest.mark.sandbox


def spend(steps, period=0.2):
    """(processor, own, wall) that a fair clock counts for steps of (processor seconds, held up)."""
    fair, now, used = FairClock(0.0), 0.0, 0.0
    for processor, held_up in steps:
        now, used = now + period, used + processor
        fair.tick(now, Observation(used, held_up))
    return fair.spent.processor, fair.spent.own, fair.spent.wall


def test_alone_the_clock_goes_as_any_other():
    assert spend([(0.2, True)] * 50) == pytest.approx((10, 10, 10))


def test_who_sleeps_is_not_held_up():
    assert spend([(0.0, False)] * 50) == pytest.approx((0, 10, 10))


@pytest.mark.parametrize("load", [2, 16, 32])
def test_on_a_busy_machine_only_the_time_it_ran_is_its_own(load):
    assert spend([(0.2 / load, True)] * 1000) == pytest.approx((200 / load, 200 / load, 200))


def test_a_hundred_busy_processes_are_not_held_up_by_each_other():
    assert spend([(0.4, True)] * 50) == pytest.approx((20, 10, 10))


def test_a_watch_that_was_held_up_itself_does_not_charge_the_gap():
    fair = FairClock(0.0)
    fair.tick(3600.0, Observation(0.1, False))
    assert fair.spent.own <= clock.LONGEST_STEP and fair.spent.wall == 3600


def test_processor_time_that_goes_out_of_sight_stays_counted():
    assert spend([(5.0, True), (-4.0, True), (1.0, True)])[0] == pytest.approx(6)


@pytest.mark.parametrize(
    ("cell", "notebook", "words"),
    [
        (Spent(30, 31, 900), Spent(40, 50, 900), "^stopped after 30 s$"),
        (Spent(3, 4, 5), Spent(120, 130, 900), "^stopped: the notebook's 120 s were used up$"),
        (Spent(0.5, 60, 60), Spent(2, 70, 70), "^stopped after 60 s, in which it computed for 0.5 s$"),
        (Spent(3, 4, 5), Spent(20, 240, 250), "^stopped: the notebook took 240 s"),
        (Spent(3, 4, 4800), Spent(3, 4, 4800), "^stopped: the machine gave it 3.0 s of processor time in 4800 s$"),
    ],
)
def test_which_bound_is_met(cell, notebook, words):
    limits = sandbox.Limits(cell_seconds=30, notebook_seconds=120)
    assert time_up(limits, Spent(29, 30, 900), Spent(119, 130, 4000)) is None
    up = time_up(limits, cell, notebook)
    assert re.search(words, up.message)
    assert bool(up.of_notebook) == ("notebook" in words or "machine" in words)
    assert up.starved == ("machine" in words)


def test_nobody_waits_for_ever():
    assert not is_over(Spent(own=2.9, wall=100), 3)
    assert is_over(Spent(own=3, wall=3), 3) and is_over(Spent(own=0, wall=3 * LOAD_FACTOR), 3)


@pytest.fixture
def sleeper():
    process = subprocess.Popen(["sleep", "60"])
    found = psutil.Process(process.pid)
    while found.name() != "sleep" or found.status() != psutil.STATUS_SLEEPING:
        assert process.poll() is None
    yield found
    process.kill()
    process.wait()


def test_what_is_stopped_from_outside_is_held_up(sleeper):
    assert not watch.observe([sleeper], outer=1).held_up
    sleeper.send_signal(signal.SIGSTOP)
    while sleeper.status() != psutil.STATUS_STOPPED:
        pass
    assert watch.observe([sleeper], outer=1).held_up
    assert not watch.observe([sleeper], outer=0).held_up  # it can do that to itself
    sleeper.send_signal(signal.SIGCONT)


def test_a_thread_that_stands_ready_is_seen():
    source = "import threading\ndef spin():\n    while True: pass\nthreading.Thread(target=spin).start()"
    process = subprocess.Popen([sys.executable, "-c", source])
    try:
        member = psutil.Process(process.pid)
        while not watch.observe([member], outer=1).held_up:
            assert process.poll() is None
        assert watch.observe([member], outer=1).processor >= 0
    finally:
        process.kill()
        process.wait()


BURN = """
import os, time
def burn(number):
    while time.process_time() < 0.5: pass
    open(f"/tmp/{number}", "w").close()
for number in range(8):
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            burn(number)
        os._exit(0)
    os.wait()
while len([name for name in os.listdir("/tmp") if name.isdigit()]) < 8: time.sleep(0.05)
"""


def test_processor_time_of_processes_that_went_away_counts(sandboxed, statuses):
    run = sandboxed(BURN, limits=sandbox.Limits(cell_seconds=15))
    assert statuses(run) == ["ok"]
    run = sandboxed(BURN, "1", limits=sandbox.Limits(cell_seconds=2))
    assert statuses(run) == ["timeout", "ok"]
    assert run.cells[0].message == "stopped after 2 s"


def test_who_sleeps_for_ever_is_stopped(sandboxed, statuses):
    run = sandboxed("import time; time.sleep(10**6)", "1", limits=sandbox.Limits(cell_seconds=1))
    assert statuses(run) == ["timeout", "ok"]
    assert run.cells[0].message.startswith("stopped after 2 s, in which it computed for ")
    assert run.doubt == run.cells[0].message and not run.starved


def without_processor(monkeypatch):
    """Observations of a family that always stands ready and never gets to run."""
    monkeypatch.setattr(watch, "observe", lambda members, outer: Observation(0.0, True))


NAP = "import time; time.sleep(2)"


def test_a_cell_without_a_processor_is_waited_for(sandboxed, statuses, monkeypatch):
    limits = sandbox.Limits(cell_seconds=0.5)
    assert statuses(sandboxed(NAP, limits=limits)) == ["timeout"]
    without_processor(monkeypatch)
    run = sandboxed(NAP, limits=limits)
    assert statuses(run) == ["ok"] and run.doubt is None


def test_what_never_gets_a_processor_is_given_up_without_a_verdict(sandboxed, statuses, monkeypatch):
    without_processor(monkeypatch)
    monkeypatch.setattr(clock, "LOAD_FACTOR", 1)
    run = sandboxed("1", "import time; time.sleep(10**6)", "1", limits=sandbox.Limits(notebook_seconds=3))
    assert statuses(run) == ["ok", "timeout", "not_run"]
    assert run.starved and "the machine gave it 0.0 s of processor time" in run.message


@pytest.mark.parametrize("lists_children", [True, False])
def test_a_glance_sees_children_of_every_thread_and_their_children(monkeypatch, lists_children):
    monkeypatch.setattr(watch, "_LISTS_CHILDREN", lists_children and watch._LISTS_CHILDREN)
    shell = "sleep 60 & echo; wait"
    source = f"""
import subprocess, sys, threading
def start():
    process = subprocess.Popen(["sh", "-c", {shell!r}], stdout=subprocess.PIPE)
    process.stdout.readline()
    print(flush=True)
    process.wait()
for _ in range(2): threading.Thread(target=start).start()
"""
    process = subprocess.Popen([sys.executable, "-c", source], stdout=subprocess.PIPE, start_new_session=True)
    try:
        for _ in range(2):
            process.stdout.readline()
        root = psutil.Process(process.pid)
        seen = watch.family_at_a_glance(root)
        assert seen[0] == root and set(seen) == set(watch.family(root)) and len(seen) == 5
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
    assert watch.family_at_a_glance(root) == []
