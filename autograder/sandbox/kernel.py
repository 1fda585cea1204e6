"""The kernel's own start-up: ipykernel on sockets that it inherited.

The grader never imports this module; its text is handed to ``python -c``. The
"ports" in the kernel's connection file are descriptors of listening sockets
that the trusted side opened, so no folder with sockets has to be shared with
the kernel, and no name in the file system is its to replace.
"""

import importlib.util
import sys
import threading
import types

# A stack counts as memory in its whole size: with the usual 8 MiB, a hundred idle threads left later cells none.
threading.stack_size(2 << 20)

# The work folder must not shadow what the kernel itself imports; IPython puts it back.
sys.path[:] = [entry for entry in sys.path if entry]

import psutil  # noqa: E402
import zmq  # noqa: E402
from ipykernel.kernelapp import IPKernelApp  # noqa: E402

FIGURE = "application/vnd.autograder.figure+json"
# What may wait, as it keeps its memory; further figures are drawn at once.
MOST_FIGURES = 64
MOST_BYTES = 128 << 20


def put_off_figures(shell):
    """Let figures wait until the notebook has run: who ran it says which of them somebody will look at (see `run`)."""
    waiting = []
    memory = psutil.Process().memory_info
    before = memory().rss

    def wait(figure):
        if len(waiting) < MOST_FIGURES and memory().rss - before < MOST_BYTES:
            waiting.append(figure)
            said = "(not drawn here: your own notebook shows this picture)"
            shell.display_pub.publish({FIGURE: len(waiting) - 1, "text/plain": said})
        else:
            draw(figure)

    def draw(figure, **number):
        from IPython.core.pylabtools import print_figure

        picture = print_figure(figure, fmt="png", bbox_inches="tight", base64=True)
        if picture is not None:  # an empty figure
            shell.display_pub.publish({"image/png": picture, "text/plain": repr(figure), **number})

    def draw_figures(*numbers):
        for number in numbers:
            draw(waiting[number], **{FIGURE: number})

    def forget_to_redraw():
        if (pyplot := sys.modules.get("matplotlib.pyplot")) is not None:
            pyplot.uninstall_repl_displayhook()  # it would draw every figure for nothing at each cell's end

    shell.draw_figures = draw_figures
    forget_to_redraw()
    shell.events.register("post_execute", forget_to_redraw)
    shell.display_formatter.ipython_display_formatter.for_type_by_name("matplotlib.figure", "Figure", wait)


class InheritedSocketsApp(IPKernelApp):
    name = "ipython-kernel"

    def _try_bind_socket(self, s, port):
        s.setsockopt(zmq.USE_FD, port)
        s.bind("ipc://kernel-" + str(port))
        return port

    def init_shell(self):
        super().init_shell()
        if "matplotlib.pyplot" in sys.modules:
            self.shell.enable_matplotlib("inline")  # a warm parent has drawn with another backend
        put_off_figures(self.shell)

    def init_control(self, context):
        super().init_control(context)
        # The debugger's socket would knock for ever at a path that does not exist in here.
        self.debug_shell_socket.disconnect(self.shell_socket.getsockopt(zmq.LAST_ENDPOINT))

    def init_heartbeat(self):
        """No heartbeat: the process itself is watched from outside."""


def launch(argv):
    """Be a kernel with these options of the command line, until it ends."""
    InheritedSocketsApp.launch_instance(argv)


if __name__ == "__main__":
    if (kit := importlib.util.find_spec("dhkit")) is not None:
        # As in a warm kernel, a file of this name beside the notebook is not the kit.
        sys.meta_path.insert(0, types.SimpleNamespace(find_spec=lambda name, *_: kit if name == kit.name else None))
    launch(sys.argv[1:])
