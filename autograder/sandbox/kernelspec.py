"""The kernel spec of the sandbox, kept in memory so that nothing has to be installed."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any

from jupyter_client.kernelspec import KernelSpec, KernelSpecManager

PROVISIONER = "autograder-sandbox"


class SandboxKernelSpecs(KernelSpecManager):
    """Answers every kernel name with the sandboxed Python kernel.

    The name in a notebook's metadata is the student's and may be wrong.

    Parameters
    ----------
    provisioner_options : mapping, optional
        Traits of SandboxProvisioner.
    """

    def __init__(self, provisioner_options: Mapping[str, Any] | None = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._provisioner_options = dict(provisioner_options or {})

    def get_kernel_spec(self, kernel_name: str) -> KernelSpec:
        return KernelSpec(
            argv=[sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"],
            display_name="Python 3 (sandbox)",
            language="python",
            interrupt_mode="message",
            metadata={
                "kernel_provisioner": {"provisioner_name": PROVISIONER, "config": dict(self._provisioner_options)}
            },
        )

    def find_kernel_specs(self) -> dict[str, str]:
        return {"python3": ""}
