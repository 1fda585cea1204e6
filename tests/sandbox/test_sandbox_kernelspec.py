"""The provisioner under stock Jupyter code: its own manager, client and nbclient."""

import json

import nbformat
import pytest
from jupyter_client.manager import AsyncKernelManager, KernelManager
from jupyter_client.provisioning import KernelProvisionerFactory
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

from autograder.sandbox.kernelspec import PROVISIONER, SandboxKernelSpecs
from autograder.sandbox.provisioner import SandboxProvisioner

pytestmark = pytest.mark.sandbox

INSIDE = "import os; print(os.getcwd()); import autograder"


def test_the_entry_point_is_registered():
    assert PROVISIONER in KernelProvisionerFactory.instance().provisioners
    assert KernelProvisionerFactory.instance().provisioners[PROVISIONER].load() is SandboxProvisioner


def test_the_spec_is_that_of_a_spec_file_for_any_name():
    spec = SandboxKernelSpecs().get_kernel_spec("no-such-kernel")
    assert spec.interrupt_mode == "message"
    assert json.loads(json.dumps(spec.to_dict()))["metadata"] == {
        "kernel_provisioner": {"provisioner_name": "autograder-sandbox", "config": {}}
    }


def test_stock_nbclient_runs_a_notebook_in_the_sandbox(needs_sandbox):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in ("1 + 1", INSIDE)])
    manager = AsyncKernelManager(kernel_spec_manager=SandboxKernelSpecs())
    client = NotebookClient(notebook, km=manager)
    with pytest.raises(CellExecutionError, match="autograder"):
        client.execute(cleanup_kc=True)
    assert notebook.cells[0].outputs[0].data["text/plain"] == "2"
    assert notebook.cells[1].outputs[0].text == "/home/student/work\n"


def test_a_stock_manager_interrupts_restarts_and_shuts_down(needs_sandbox):
    manager = KernelManager(kernel_spec_manager=SandboxKernelSpecs())
    manager.start_kernel()
    client = manager.client()
    client.start_channels()
    try:
        client.wait_for_ready(timeout=60)
        request = client.execute("print('on')\nwhile True: pass")
        while client.get_iopub_msg(timeout=60)["msg_type"] != "stream":
            pass
        manager.interrupt_kernel()
        replies = iter(lambda: client.get_shell_msg(timeout=60), None)
        reply = next(reply for reply in replies if reply["parent_header"]["msg_id"] == request)
        assert reply["content"]["ename"] == "KeyboardInterrupt"
        client.stop_channels()
        first, folder = manager.provisioner.pid, manager.provisioner.folder
        manager.restart_kernel(now=True)
        client = manager.client()
        client.start_channels()
        client.wait_for_ready(timeout=60)
        assert client.execute("1", reply=True, timeout=60)["content"]["status"] == "ok"
        assert manager.provisioner.pid != first
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)
    assert not folder.exists() and not manager.is_alive()
