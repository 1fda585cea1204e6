"""First step inside the sandbox: put the files in place, take on the limits, become the kernel.

The grader never imports this module. Its text is handed to ``python -I -S -c`` under
bubblewrap, because nothing of this package may be visible in there. The plan
arrives on the descriptor named by the first argument, marshalled by the trusted
side, which built it. Children of a warm parent take the same step, see `warm_parent`.
"""

import marshal
import os
import resource
import sys


def write_files(home, files):
    for name, content in files.items():
        path = os.path.join(home, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content)


def give_way(nice):
    """Let whatever else runs on this machine go first, above all the grader that watches."""
    os.nice(nice)
    os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))


def settle(plan):
    """Take on the user, put the files in place, go to the work folder and take on the limits."""
    give_way(plan["nice"])
    if plan["uid"] is not None:
        # Root is exempt from the limit on processes, so the kernel must not be root.
        os.setgroups([])
        os.setresgid(plan["uid"], plan["uid"], plan["uid"])
        os.setresuid(plan["uid"], plan["uid"], plan["uid"])
    os.umask(0o077)
    write_files(plan["home"], plan["files"])
    os.makedirs(plan["cwd"], exist_ok=True)
    os.chdir(plan["cwd"])
    for name, bounds in plan["limits"].items():
        resource.setrlimit(getattr(resource, name), bounds)


def main():
    with open(int(sys.argv[1]), "rb") as file:
        plan = marshal.load(file)
    settle(plan)
    os.execve(plan["argv"][0], plan["argv"], plan["env"])


if __name__ == "__main__":
    main()
