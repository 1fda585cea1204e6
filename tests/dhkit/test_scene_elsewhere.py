"""The widget where others show it: under the rules of VS Code's and Colab's output frames, in JupyterLab and in Notebook 7."""

import json
import os
import socket
import subprocess
import sys
import threading
import urllib.request
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from time import sleep

import nbformat
import numpy as np
import pytest
from browser import GRIP, READOUTS, Tab, numbers, shares, without_browser
from nbformat.v4 import new_code_cell, new_notebook

pytestmark = [pytest.mark.slow, without_browser]

PYTHON_3 = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
PLANAR = [[0, 0, 0, 0, 0.2], [0, 0.5, 0, 0, 1.0], [0, 0.4, 0, 0, 0]]

# Stricter than either: nothing is fetched, no text becomes code, no worker starts, and the page has no origin of its own.
RULES = "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline' blob:; style-src 'unsafe-inline'"
# What a widget manager does with a widget, which may use no more of it than anywidget promises: everything else is an error.
MANAGER = """<!doctype html><meta charset="utf-8"><title>frame</title><div id="output"></div>
<script>window.broken = []; addEventListener("securitypolicyviolation", (event) => broken.push(event.violatedDirective));</script>
<script type="module">
    const state = STATE, told = window.told = {};
    const promised = {
        get: (name) => state[name], set: (name, value) => { state[name] = value; },
        save_changes: () => Object.assign(told, { q: state.q }), on: () => {}, off: () => {},
    };
    const model = new Proxy(promised, { get(target, name) { if (name in target) return target[name]; throw Error(`model.${name}`); } });
    state.cloud = new DataView(new ArrayBuffer(0));
    const el = document.createElement("div");
    document.getElementById("output").attachShadow({ mode: "open" }).append(el);
    const url = URL.createObjectURL(new Blob([PROGRAM], { type: "text/javascript" }));
    const { default: widget } = await import(url);
    window.clear = await widget.render({ model, el });
    window.ready = true;
</script>"""


@pytest.fixture
def tab(tmp_path):
    tab = Tab(tmp_path, 1200, 900)
    yield tab
    tab.close()


@pytest.fixture
def served():
    """A function that serves a page under `RULES`, and gives its address."""
    servers = []

    def serve(page):
        class Handler(BaseHTTPRequestHandler):
            def do_GET(self):
                self.send_response(200)
                self.send_header("Content-Type", "text/html")
                self.send_header("Content-Security-Policy", RULES)
                self.end_headers()
                self.wfile.write(page.encode())

            def log_message(self, *args):
                pass

        servers.append(ThreadingHTTPServer(("127.0.0.1", 0), Handler))
        threading.Thread(target=servers[-1].serve_forever, daemon=True).start()
        return f"http://127.0.0.1:{servers[-1].server_port}/"

    yield serve
    for server in servers:
        server.shutdown()
        server.server_close()


def literal(value):
    """JavaScript for a value, which no "<" in it ends."""
    return json.dumps(value).replace("<", "\\u003c")


def test_the_widget_needs_no_more_than_it_is_promised(tab, served):
    from dhkit.scene import Scene
    from dhkit.scene.widget import PROGRAM

    state = Scene(PLANAR[:2], q=[0.2, 1.0], tool=np.diag([1.0, 1, 1, 1])).ghosts([[0.9, -1.0]]).state()
    page = MANAGER.replace("STATE", literal(state), 1).replace("PROGRAM", literal(PROGRAM), 1)
    tab.root = "document.getElementById('output')?.shadowRoot.firstElementChild?.shadowRoot"
    tab.open(served(page))
    assert tab.ask("origin") == "null"
    assert (tab.picture()[..., 3] > 0).mean() > 0.05
    before = tab.picture()
    tab.drag(*tab.ask(GRIP), by=(-60, -60))
    assert shares(tab.picture(), before) > 0.01
    tab.until("Math.abs(told.q?.[0] - 0.2) > 0.01")
    assert np.degrees(tab.ask("told.q")) == pytest.approx(numbers(tab.ask(READOUTS)), abs=0.06)
    tab.ask("clear()")
    assert tab.ask("broken") == []


# ---------------------------------------------------------------- JupyterLab and Notebook 7

CELL = """import numpy as np
from dhkit.scene import Scene

def both(T):
    x, y = T[:2, 3]
    bend = np.arccos((x**2 + y**2 - 0.41) / 0.4)
    return [(np.arctan2(y, x) - np.arctan2(0.4 * np.sin(t), 0.5 + 0.4 * np.cos(t)), t) for t in (bend, -bend)]

scene = Scene([[0, 0, 0, 0, 0.2], [0, 0.5, 0, 0, 1.0], [0, 0.4, 0, 0, 0]], tool=True, inverse=both)
scene"""
SCENES = "[...document.querySelectorAll('*')].flatMap((each) => each.shadowRoot?.querySelector('.scene') ? [each.shadowRoot] : [])"
BOOK = "[...(globalThis.jupyterapp?.shell.widgets('main') ?? [])].find((each) => each.sessionContext)"


@pytest.fixture(scope="module")
def jupyter(tmp_path_factory):
    """A server of JupyterLab and Notebook 7 with one notebook, whose settings are nobody's: its address."""
    pytest.importorskip("jupyterlab", reason="JupyterLab is not installed")
    home = tmp_path_factory.mktemp("jupyter")
    nbformat.write(new_notebook(cells=[new_code_cell(CELL), new_code_cell("1")], metadata=PYTHON_3), home / "arm.ipynb")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    settings = [
        f"ServerApp.port={port}",
        "ServerApp.open_browser=False",
        "ServerApp.allow_root=True",
        "IdentityProvider.token=",
    ]
    shown = [f"{app}.expose_app_in_browser=True" for app in ("LabApp", "JupyterNotebookApp")]
    command = [sys.executable, "-m", "jupyterlab", *(f"--{each}" for each in (*settings, *shown))]
    folders = {
        "HOME": str(home),
        "JUPYTER_CONFIG_DIR": str(home / "config"),
        "JUPYTER_RUNTIME_DIR": str(home / "runtime"),
    }
    server = subprocess.Popen(
        command, cwd=home, env=os.environ | folders, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    address = f"http://127.0.0.1:{port}"
    for _ in range(600):
        try:
            urllib.request.urlopen(f"{address}/api").close()
            break
        except OSError:
            sleep(0.1)
    yield address
    server.terminate()
    server.wait()


@pytest.mark.parametrize("place", ["lab/tree/arm.ipynb", "notebooks/arm.ipynb"], ids=["lab", "notebook"])
def test_a_scene_lives_in_jupyter(tab, jupyter, place):
    if place.startswith("notebooks"):
        pytest.importorskip("notebook", minversion="7", reason="Notebook 7 is not installed")
    tab.root = f"{SCENES}[0]"
    tab.tell("Page.navigate", url=f"{jupyter}/{place}")
    tab.until(f"{BOOK}?.sessionContext.session?.kernel?.status === 'idle'")
    tab.ask(f"jupyterapp.shell.activateById({BOOK}.id)")
    tab.until("!!jupyterapp.shell.currentWidget")
    tab.ask("jupyterapp.commands.execute('notebook:run-all-cells')")
    tab.until("!!root?.querySelector('.label')")
    before = tab.picture()
    assert (before[..., 3] > 0).mean() > 0.05
    # The kernel answers with both postures for where the hand has been drawn.
    tab.drag(*tab.ask(GRIP), by=(-60, -60))
    assert shares(tab.picture(), before) > 0.01
    bends = "[...root.querySelectorAll('[aria-label=postures] button')].map((one) => one.ariaPressed)"
    tab.until(f"{bends}.join() === 'true,false'")
    first = numbers(tab.ask(READOUTS))
    tab.ask("root.querySelectorAll('[aria-label=postures] button')[1].click()")
    tab.until(f"{bends}.join() === 'false,true'")
    assert numbers(tab.ask(READOUTS))[1] == pytest.approx(-first[1], abs=0.2)
    # Its keys move the joint, or the camera, and not the notebook to its next cell.
    tab.ask("root.querySelector('input[type=range]').focus()")
    turned = numbers(tab.ask(READOUTS))[0]
    tab.press("ArrowDown", 3)
    assert numbers(tab.ask(READOUTS))[0] == pytest.approx(turned - 3, abs=1)
    tab.ask("root.querySelector('canvas').focus()")
    before = tab.picture()
    tab.press("ArrowDown", 3)
    assert shares(tab.picture(), before) > 0.05
    assert tab.ask(f"{BOOK}.content.activeCellIndex") == 0
