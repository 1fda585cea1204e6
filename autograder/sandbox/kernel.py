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

import zmq  # noqa: E402
from ipykernel.kernelapp import IPKernelApp  # noqa: E402


class InheritedSocketsApp(IPKernelApp):
    name = "ipython-kernel"

    def _try_bind_socket(self, s, port):
        s.setsockopt(zmq.USE_FD, port)
        s.bind("ipc://kernel-" + str(port))
        return port

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
