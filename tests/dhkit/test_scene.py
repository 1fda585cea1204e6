"""The live scene: what Python says to it, what the browser computes, and what stands in its place without one."""

import base64
import json
import re
import shutil
import subprocess
import sys
import tomllib
import types
import zipfile
from html.parser import HTMLParser
from pathlib import Path

import anywidget
import matplotlib.pyplot as plt
import numpy as np
import pytest
import sympy

from dhkit.geometry import modified_dh
from dhkit.scene import ParallelScene, Scene
from dhkit.scene.page import script

ROOT = Path(__file__).parents[2]
PROGRAM = ROOT / "course/dhkit/scene/scene.js"
WIDGET = "application/vnd.jupyter.widget-view+json"
PNG = b"\x89PNG"

t1, t2, t3, t4, a2, a3, d2 = sympy.symbols("t1 t2 t3 t4 a2 a3 d2")
SCARA = [[0, 0, 0, 0, t1], [0, a2, 0, 0, t2], [1, a3, 0, -d2, 0], [0, 0, 0, 0, t4]]
LENGTHS = {"a2": 0.4, "a3": 0.3}
PLANAR = [[0, 0, 0, 0, t1], [0, 0.5, 0, 0, t2], [0, 0.4, 0, 0, 0]]
HOSTILE = '<img src=x onerror="window.hacked=1"></script><script>window.hacked=1</script>'


def in_node(expression, given):
    """What a JavaScript expression in `dhkitScene`, the built program, and `given` comes to."""
    if shutil.which("node") is None:
        pytest.skip("node, which runs the program of the scene here, is not installed")
    code = f"""
        const {{ readFileSync }} = require("fs");
        const dhkitScene = new Function(readFileSync({json.dumps(str(PROGRAM))}, "utf8") + "; return dhkitScene;")();
        const given = JSON.parse(readFileSync(0, "utf8"));
        console.log(JSON.stringify({expression}));
    """
    done = subprocess.run(["node", "-e", code], input=json.dumps(given), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


# ---------------------------------------------------------------- the table


def test_joint_variables_are_the_symbols_that_move():
    scene = Scene(SCARA, LENGTHS)
    assert [(joint.name, joint.prismatic) for joint in scene.arm.joints] == [
        ("θ₁", False),
        ("θ₂", False),
        ("d₂", True),
        ("θ₄", False),
    ]
    assert scene.arm.table([0.1, 0.2, 0.3, 0.4]) == pytest.approx(
        np.array([[0, 0, 0, 0, 0.1], [0, 0.4, 0, 0, 0.2], [1, 0.3, 0, -0.3, 0], [0, 0, 0, 0, 0.4]])
    )


def test_a_row_without_joint_is_the_tool():
    scene = Scene(PLANAR)
    assert len(scene.q) == 2
    assert scene.names == ["0", "1", "2", "E"]


def test_a_table_of_numbers_is_a_posture():
    rows = [[0, 0, 0, 0, 0.3], [1, 0.5, 0, 0.2, 0], [0, 0.4, 0, 0, 0.7]]
    assert Scene(rows).q == pytest.approx([0.3, 0.2, 0.7])
    scene = Scene(rows, tool=True)
    assert scene.q == pytest.approx([0.3, 0.2])
    assert scene.arm.table(scene.q) == pytest.approx(np.array(rows))


def test_a_number_for_a_joint_variable_is_its_start():
    assert Scene(SCARA, LENGTHS | {"t2": 0.9}).q == pytest.approx([0, 0.9, 0, 0])


def test_joints_may_drive_several_rows():
    rows = [[0, 0, 0, 0, t1], [0, 0.3, 0, 0, t2 - t1 - sympy.pi / 2]]
    assert Scene(rows).arm.table([0.4, 1.0])[:, 4] == pytest.approx([0.4, 0.6 - np.pi / 2])


@pytest.mark.parametrize(
    "table, values, message",
    [
        (SCARA, {"a2": 0.4}, r"number for a3 \(row 3, a\)"),
        ([[0, 0, 0, 0]], None, "row 1: expected .*found 4 entries"),
        ([[2, 0, 0, 0, t1]], None, "row 1: sigma must be 0"),
        ([[0, 0, 0, 0, sympy.sin(t1)]], None, r"row 1: expected a sum .*sin\(t1\)"),
        ([[0, "__import__('os')", 0, 0, t1]], None, "row 1: a must be a number or an expression"),
        ([[0, 0, 0, 0, ...]], None, "row 1: theta must be a number"),
        ([], None, "found 0"),
        (3, None, "expected rows"),
        ([[0, sympy.nan, 0, 0, t1]], None, "finite"),
    ],
)
def test_a_wrong_table_is_refused_in_words(table, values, message):
    with pytest.raises(ValueError, match=message):
        Scene(table, values)


@pytest.mark.parametrize(
    "act, message",
    [
        (lambda scene: setattr(scene, "q", [1, 2]), r"q: .*is 4 finite numbers \(θ₁, θ₂, d₂, θ₄\), found \[1, 2\]"),
        (lambda scene: setattr(scene, "q", []), "q: expected a posture"),
        (lambda scene: scene.play([[0, 0, 0, 0], [1, 2, 3]]), "path: .*4 finite numbers"),
        (lambda scene: setattr(scene, "q", [1, 2, 3, float("nan")]), "finite"),
        (lambda scene: scene.ghosts([[1, 2, 3]]), "solutions: "),
        (lambda scene: scene.ghosts(np.zeros((65, 4))), "at most 64"),
        (lambda scene: scene.play([[0, 0, 0, 0]]), "two or more"),
        (lambda scene: scene.play(np.zeros((2, 4)), seconds=0), "seconds"),
        (lambda scene: Scene(SCARA, LENGTHS, frames=[5]), "frames"),
        (lambda scene: Scene(SCARA, LENGTHS, limits=[(1, 0)] * 4), "lowest first"),
        (lambda scene: Scene(SCARA, LENGTHS, tool=np.diag([2, 1, 1, 1])), "tool"),
    ],
)
def test_wrong_numbers_are_refused_in_words(act, message):
    with pytest.raises(ValueError, match=message):
        act(Scene(SCARA, LENGTHS))


def test_a_single_posture_may_stand_alone():
    scene = Scene(SCARA, LENGTHS).ghosts([sympy.pi / 2, 0, 0.1, 0])
    assert np.array(scene.state()["ghosts"]) == pytest.approx(np.array([[np.pi / 2, 0, 0.1, 0]]))
    scene.q = sympy.Matrix([0, sympy.pi, 0, 0])
    assert scene.q == pytest.approx([0, np.pi, 0, 0])


def test_the_hand_is_where_the_table_brings_it(catalogue):
    for name, case in catalogue.items():
        assert case["scene"].arm.hands(np.array(case["q"])) == pytest.approx(case["hands"], abs=1e-9), name


def test_a_cloud_is_reached_within_the_limits_and_thinned_out():
    limits = [(0, 0.5), (0, 1), (0, 0.1), (0, 1)]
    cloud = Scene(SCARA, LENGTHS, cloud=True, limits=limits)._cloud
    assert cloud.shape == (4000, 3)
    assert (np.hypot(*cloud.T[:2]) <= 0.7 + 1e-6).all()
    assert (cloud[:, 1] >= -1e-6).all() and cloud[:, 2].min() < -0.09
    given = np.random.default_rng(0).uniform(size=(12_000, 3))
    assert Scene(SCARA, LENGTHS, cloud=given)._cloud == pytest.approx(given[::3], abs=1e-6)
    with pytest.raises(ValueError, match="cloud: expected n x 3 numbers"):
        Scene(SCARA, LENGTHS, cloud=[1, 2])


def both_elbows(pose):
    """Both postures of `PLANAR`."""
    x, y = pose[:2, 3]
    bend = np.arccos((x**2 + y**2 - 0.41) / 0.4)
    return [(np.arctan2(y, x) - np.arctan2(0.4 * np.sin(t), 0.5 + 0.4 * np.cos(t)), t) for t in (bend, -bend)]


def test_a_students_function_is_asked_for_all_postures(watched):
    scene = Scene(PLANAR, inverse=both_elbows, q=[0.2, 1.0])
    scene._repr_mimebundle_()
    assert np.array(scene._widget.ghosts)[:, 1] == pytest.approx([1.0, -1.0])
    scene._widget.set_state({"asked": {"number": 3, "q": [0.2, 0.5]}})
    answer = scene._widget.answer
    assert (answer["number"], answer["words"]) == (3, "")
    assert np.array(answer["ghosts"])[:, 1] == pytest.approx([0.5, -0.5])
    scene.q = [0, 0.7]
    assert np.array(scene._widget.ghosts)[:, 1] == pytest.approx([0.7, -0.7])


@pytest.mark.parametrize(
    "function, words",
    [
        (lambda pose: [], "no posture for this place"),
        (lambda pose: ..., "nothing comes back yet"),
        (lambda pose: [[1, 2, 3]], "a posture of this robot is 2 finite numbers"),
        (lambda pose: [(np.float64(1), np.float64("nan"))], "2 finite numbers (θ₁, θ₂), found [[1.0, nan]]"),
        (lambda pose: 1 / 0, "division by zero"),
        (lambda pose: pose["x"], "indices"),
    ],
)
def test_what_goes_wrong_in_a_students_function_is_told_in_words(watched, function, words):
    scene = Scene(PLANAR, inverse=function)
    assert scene._repr_mimebundle_()
    scene._widget.set_state({"asked": {"number": 1, "q": [0.2, 0.5]}})
    assert scene._widget.answer["ghosts"] == []
    assert words in scene._widget.answer["words"]
    assert scene._widget.answer["words"].count("inverse:") == 1


def test_a_path_does_not_leap_by_full_turns():
    path = Scene(PLANAR).play([[3.0, 0], [-3.1, 0.2], [-2.9, 6.2]]).state()["path"]
    assert np.array(path) == pytest.approx(
        np.array([[3.0, 0], [2 * np.pi - 3.1, 0.2], [2 * np.pi - 2.9, 6.2 - 2 * np.pi]])
    )
    limited = Scene(PLANAR, limits=[(-3.1, 3.1)] * 2).play([[3.0, 0], [-3.1, 0.2]])
    assert limited.state()["path"] == [[3.0, 0], [-3.1, 0.2]]


def test_a_posture_that_misses_the_hand_is_named(watched):
    scene = Scene(PLANAR, q=[0.2, 0.5], inverse=lambda pose: [both_elbows(pose)[0], [0.2, 0.6]])
    scene._repr_mimebundle_()
    scene._widget.set_state({"asked": {"number": 1, "q": [0.2, 0.5]}})
    away = 2 * 0.4 * np.sin(0.05)
    assert scene._widget.answer["words"] == f"posture 2 misses the ring by {away:.3f} m"
    assert len(scene._widget.answer["ghosts"]) == 2


def test_sliders_have_round_values_within_the_limits():
    joints = Scene(SCARA, LENGTHS, limits=[(-1, 1), (-1, 1), (0.0, 0.25), (-1, 1)]).arm.joints
    assert (joints[2].low, joints[2].high, joints[2].step) == (0.0, 0.25, 0.005)
    assert Scene(SCARA, LENGTHS).arm.joints[2].high == pytest.approx(0.3)


# ---------------------------------------------------------------- what is shown


@pytest.fixture
def watched(monkeypatch):
    monkeypatch.setattr("dhkit.scene.live.is_watched", lambda: True)


def test_a_scene_is_a_widget_with_the_still_drawing_beside_it(watched):
    scene = Scene(SCARA, LENGTHS)
    bundle, metadata = scene._repr_mimebundle_()
    assert base64.b64decode(bundle["image/png"]).startswith(PNG)
    assert bundle[WIDGET]["model_id"] == scene._widget.model_id
    # Sharp screens have two pixels for one.
    assert int.from_bytes(scene.still()[16:20]) // 2 == metadata["image/png"]["width"]
    assert bundle["text/plain"] == "robot with 4 joints: θ₁, θ₂, d₂, θ₄"
    assert not plt.get_fignums()


def test_in_colab_a_scene_names_the_program_for_widgets_of_others(monkeypatch, watched):
    """Colab adds it by itself to what is displayed, not to what ends a cell."""
    asked = []
    output = types.ModuleType("google.colab.output")
    output.enable_custom_widget_manager = lambda: asked.append(True)
    output._widgets = types.SimpleNamespace(_installed_url="https://colab.example/manager.js")
    monkeypatch.setitem(sys.modules, "google.colab.output", output)
    anywidget._util.enable_custom_widget_manager_once.cache_clear()
    bundle, metadata = Scene(SCARA, LENGTHS)._repr_mimebundle_()
    anywidget._util.enable_custom_widget_manager_once.cache_clear()
    assert asked == [True]
    assert metadata[WIDGET]["colab"]["custom_widget_manager"]["url"] == "https://colab.example/manager.js"
    assert base64.b64decode(bundle["image/png"]).startswith(PNG) and metadata["image/png"]["width"] > 0


def test_kernel_and_browser_share_the_posture(watched):
    scene = Scene(SCARA, LENGTHS)
    scene._repr_mimebundle_()
    scene.q = [0.1, 0.2, 0.3, 0.4]
    assert scene._widget.q == [0.1, 0.2, 0.3, 0.4]
    scene._widget.set_state({"q": [1.0, 0.5, 0.2, 0.1]})  # as a slider does
    assert scene.q == [1.0, 0.5, 0.2, 0.1]
    scene.ghosts([[0, 0, 0, 0], [1, 1, 0, 1]])
    assert scene._widget.ghosts == [[0, 0, 0, 0], [1, 1, 0, 1]]
    run = scene._widget.run
    assert scene.play([[0, 0, 0, 0], [1, 1, 0, 1]], seconds=2) is scene
    assert (scene._widget.run, scene._widget.seconds, len(scene._widget.path)) == (run + 1, 2, 2)
    assert scene.ghosts([])._widget.ghosts == []


def test_where_nobody_sits_before_the_notebook_there_is_no_widget():
    assert WIDGET not in Scene(SCARA, LENGTHS)._repr_mimebundle_()[0]


def test_for_a_site_the_data_come_along(monkeypatch):
    monkeypatch.setenv("DHKIT_SCENES", "embedded")
    scene = Scene(SCARA, LENGTHS, title="</script><b>")
    html = scene._repr_mimebundle_()[0]["text/html"]
    data = html.partition('<script type="application/json">')[2].removesuffix("</script></div>")
    assert json.loads(data) == scene.state() and "<" not in data
    assert WIDGET not in scene._repr_mimebundle_()[0]


def test_without_anywidget_the_still_drawing_remains(monkeypatch, watched):
    monkeypatch.setitem(sys.modules, "anywidget", None)
    monkeypatch.delitem(sys.modules, "dhkit.scene.widget", raising=False)
    bundle, _ = Scene(SCARA, LENGTHS)._repr_mimebundle_()
    assert WIDGET not in bundle
    assert base64.b64decode(bundle["image/png"]).startswith(PNG)


@pytest.mark.slow
def test_who_draws_no_scene_does_not_load_the_widget():
    code = """import sys, dhkit.scene
scene = dhkit.scene.Scene([[0, 0, 0, 0, 0.1], [0, 0.5, 0, 0, 0.2]])
scene.q = [1, 2]
scene.ghosts([[1, 2]]).play([[1, 2], [0, 0]])
assert "anywidget" not in sys.modules"""
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.slow
def test_a_notebook_that_runs_unattended_shows_still_drawings():
    from jupyter_client.manager import start_new_kernel

    code = f"from dhkit.scene import Scene\nScene({[[0, 0, 0, 0, 0.1], [0, 0.5, 0, 0, 0.2]]})"
    manager, client = start_new_kernel()
    shown = []
    try:
        for answers in (False, True):
            client.execute_interactive(code, allow_stdin=answers, output_hook=shown.append, timeout=300)
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)
    results = [message["content"]["data"] for message in shown if message["msg_type"] == "execute_result"]
    assert [("image/png" in data, WIDGET in data) for data in results] == [(True, False), (True, True)]


@pytest.mark.parametrize("solutions", [[], [[0.1, 0.2], [0.3, -0.2]]])
def test_the_still_drawing_shows_robot_or_postures(solutions):
    assert Scene(PLANAR).ghosts(solutions).still().startswith(PNG)
    assert Scene(PLANAR[:2], tool=np.eye(4)).ghosts(solutions).still().startswith(PNG)


# ---------------------------------------------------------------- the page


class Elements(HTMLParser):
    """Tags of a page, and the text of each script."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.scripts = [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        if tag == "script":
            self.scripts.append("")

    def handle_data(self, data):
        if self.tags[-1:] == ["script"]:
            self.scripts[-1] += data


def test_no_text_of_a_student_acts_as_html(tmp_path):
    evil = sympy.Symbol(HOSTILE)
    scene = Scene([[0, 0, 0, 0, evil], [0, a2, 0, 0, t2]], LENGTHS, names=[HOSTILE, "1", "2"], title=HOSTILE)
    scene.save(tmp_path / "arm.html")
    page = Elements((tmp_path / "arm.html").read_text(encoding="utf-8"))
    assert "img" not in page.tags
    assert len(page.scripts) == 2
    state = json.loads(page.scripts[0])
    assert state["arm"]["title"] == state["arm"]["names"][0] == HOSTILE
    assert "</" not in page.scripts[0]


def test_a_page_fetches_nothing_and_runs_its_own_program_only(tmp_path):
    Scene(PLANAR).save(tmp_path / "arm.html")
    page = (tmp_path / "arm.html").read_text(encoding="utf-8")
    assert "default-src 'none'" in page
    assert re.search(r"script-src 'sha256-[\w+/=]{44}'\"", page)
    assert not re.search(r"<(link|img|iframe)|\ssrc=", page.replace(script(), ""))


def test_the_program_cannot_end_its_own_element():
    assert not re.search(r"</script|<!--", script(), re.I)
    assert script().isascii()


# ---------------------------------------------------------------- the program


@pytest.fixture(scope="module")
def catalogue():
    """State, joint values and hand poses of each serial robot of the catalogue."""
    robots = pytest.importorskip("autograder.reference", reason="the kit alone is installed").robots
    rng = np.random.default_rng(1)
    cases = {}
    for name in robots.names():
        table = getattr(robots, name).table
        rows = [[row.sigma, *row.parameters] for row in table.rows]
        tool = np.array(table.tool.subs(table.values), dtype=float)
        scene = Scene(rows, table.values, tool=False if np.array_equal(tool, np.eye(4)) else tool)
        q = rng.uniform(-3, 3, (20, len(table.joints)))
        cases[name] = {"scene": scene, "arm": scene.state()["arm"], "q": q.tolist(), "hands": table.forward(q)}
    return cases


def test_forward_kinematics_in_the_browser_is_the_reference_solver(catalogue):
    given = {name: {"arm": case["arm"], "q": case["q"]} for name, case in catalogue.items()}
    of_all = "Object.fromEntries(Object.entries(given).map(([name, { arm, q }]) => [name, q.map((each) => dhkitScene.forward(arm, each))]))"
    found = in_node(of_all, given)
    assert len(found) >= 15
    for name, case in catalogue.items():
        error = np.abs(np.reshape(found[name], (-1, 4, 4)) - case["hands"]).max()
        assert error < 1e-9, name


def test_every_robot_of_the_catalogue_has_a_body_fixed_to_its_frames(catalogue):
    given = {name: case["arm"] for name, case in catalogue.items()}
    bodies = in_node(
        "Object.fromEntries(Object.entries(given).map(([name, arm]) => [name, dhkitScene.layout(arm)]))", given
    )
    for name, arm in given.items():
        pieces = bodies[name]["pieces"]
        assert {piece["joint"] for piece in pieces if "joint" in piece} == set(range(1, 1 + len(arm["joints"]))), name
        last = len(arm["rows"]) + (arm["tool"] is not None)
        ends = [piece[end] for piece in pieces for end in ("from", "to", "centre") if end in piece]
        assert max(end["frame"] for end in ends) == last, name
        assert np.isfinite([end["point"] for end in ends]).all(), name


def test_the_hand_leads_the_arm_of_every_robot_of_the_catalogue(catalogue):
    rng = np.random.default_rng(3)
    given = {}
    for name, case in catalogue.items():
        low, high = np.transpose([(joint.low, joint.high) for joint in case["scene"].arm.joints])
        q = low + (high - low) * rng.uniform(0.55, 0.7, (8, len(low)))
        aims = case["scene"].arm.hands(q + (high - low) * rng.uniform(0, 0.02, q.shape))
        given[name] = {"arm": case["arm"], "q": q.tolist(), "aims": aims.reshape(-1, 16).tolist()}
    found = in_node(
        "Object.fromEntries(Object.entries(given).map(([name, { arm, q, aims }]) =>"
        " [name, q.map((each, k) => dhkitScene.follow(arm, dhkitScene.layout(arm).unit, each, aims[k]))]))",
        given,
    )
    for name, case in given.items():
        for aim, each in zip(case["aims"], found[name]):
            reached = catalogue[name]["scene"].arm.hands(np.array(each["q"]))
            assert reached.ravel() == pytest.approx(np.array(aim), abs=1e-7), name


def test_the_hand_keeps_to_the_limits_and_goes_as_far_as_it_can():
    arm = Scene(PLANAR, limits=[(-1, 1), (0.0, 2.0)]).state()["arm"]
    aims = [[1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, 0, 0, 0, 0, 1] for x, y in ((3, 0), (0.4, -0.5), (0.3, 0.7))]
    found = in_node(
        "given.aims.map((aim) => dhkitScene.follow(given.arm, 0.9, [0.3, 0.9], aim))", {"arm": arm, "aims": aims}
    )
    stretched, at_limit, reached = found
    assert stretched["q"] == pytest.approx([0, 0], abs=0.02)
    assert stretched["missed"] == pytest.approx(2.1, abs=1e-3)
    assert at_limit["q"][0] == -1 and at_limit["missed"] > 0.01
    assert all(-1 <= a <= 1 and 0 <= b <= 2 for a, b in (each["q"] for each in found))
    assert reached["missed"] < 1e-9


def test_the_ellipsoid_is_that_of_the_jacobian(catalogue):
    given = {name: {"arm": case["arm"], "q": case["q"][:5]} for name, case in catalogue.items()}
    found = in_node(
        "Object.fromEntries(Object.entries(given).map(([name, { arm, q }]) => [name, q.map((each) => {"
        " const { unit } = dhkitScene.layout(arm); return dhkitScene.speeds(arm, unit, each, dhkitScene.usual(arm, unit)); })]))",
        given,
    )
    for name, case in given.items():
        for q, each in zip(case["q"], found[name]):
            steps = 1e-6 * np.eye(len(q))
            hands = catalogue[name]["scene"].arm.hands(np.vstack([q + steps, q - steps]))[:, :3, 3]
            J = (hands[: len(q)] - hands[len(q) :]).T / 2e-6
            sizes = np.zeros(3)
            sizes[: min(J.shape)] = np.linalg.svd(J, compute_uv=False)
            assert [axis["speed"] for axis in each["axes"]] == pytest.approx(sizes, abs=1e-6), name


@pytest.mark.parametrize(
    "name, q, turn, way, free",
    [
        ("PLANAR_2R", [0.5, 0], False, [np.cos(0.5), np.sin(0.5), 0], None),
        ("SCARA", [0.3, 0, 0.1, 0], False, [np.cos(0.3), np.sin(0.3), 0], None),
        ("RX90", [0.3, 0.6, -0.5, 0, 0, 0.2], True, None, "θ₄ − θ₆"),
        ("RX90", [0.3, 0.6, -0.5, 0, 0.8, 0.2], None, None, None),
    ],
)
def test_a_singular_posture_names_what_is_lost_and_what_is_free(catalogue, name, q, turn, way, free):
    given = {"arm": catalogue[name]["arm"], "q": q}
    lost, words = in_node(
        "(({ arm, q }) => { const { unit } = dhkitScene.layout(arm);"
        " const { lost, free } = dhkitScene.speeds(arm, unit, q, dhkitScene.usual(arm, unit));"
        " return [lost, free.map((each) => dhkitScene.inWords(each, arm.joints))]; })(given)",
        given,
    )
    assert [each["turn"] for each in lost] == ([] if turn is None else [turn])
    if way is not None:
        assert np.abs(np.dot(lost[0]["way"], way)) == pytest.approx(1, abs=1e-3)
    if free is not None:
        assert words == [free]


@pytest.fixture(scope="module")
def robots():
    return pytest.importorskip("autograder.reference", reason="the kit alone is installed").robots


def test_modes_in_the_browser_are_those_of_the_reference_solver(robots):
    lecture = [[0, 0], [1, 0], [0.3, 0.6]], [[-0.2, -0.2], [0.2, -0.2], [0.1, 0.3]]
    robot, rng = robots.ThreeRPR(*lecture), np.random.default_rng(4)
    lengths = np.vstack([robot.inverse(rng.uniform((0, 0, -3), (1, 1, 3), (30, 3))), [[1.0, 0.5, 0.9]]])
    given = {"base": robot.base.tolist(), "platform": robot.platform.tolist(), "lengths": lengths.tolist()}
    found = in_node("given.lengths.map((each) => dhkitScene.modes(given.base, given.platform, each))", given)
    answer = robot.forward(lengths)
    for poses, values, exists in zip(found, answer.values, answer.exists):
        assert np.reshape(poses, (-1, 3)) == pytest.approx(values[exists], abs=1e-9)
    assert len(found[-1]) == 6
    singular = in_node(
        "given.poses.map((pose) => dhkitScene.determinant(given.base, given.platform, pose))",
        given | {"poses": found[-1]},
    )
    assert singular == pytest.approx(np.linalg.det(robot.jacobian(found[-1])), abs=1e-9)


def test_drives_in_the_browser_are_those_of_the_reference_solver(robots):
    robot, rng = robots.THREE_RRR, np.random.default_rng(5)
    poses = rng.uniform((0.35, 0.35, -0.4), (0.6, 0.6, 0.4), (20, 3))
    bars = [robot.proximal[0], robot.distal[0]]
    for signs, place in (((1, 1, 1), 0), ((1, -1, -1), 3)):
        legs = ParallelScene(robot.base, robot.platform, poses[0], bars, elbows=signs).state()["legs"]
        found = in_node(
            "given.poses.map((pose) => dhkitScene.drivesAt(given.legs, pose))", {"legs": legs, "poses": poses.tolist()}
        )
        turns = np.array(found) - robot.inverse(poses).values[:, place, ::2]
        assert np.abs(np.arctan2(np.sin(turns), np.cos(turns))).max() < 1e-9


def test_a_parallel_scene_is_told_its_pose_and_tells_its_drives(watched, robots):
    scene = ParallelScene(robots.THREE_RPR.base, robots.THREE_RPR.platform, (0.55, 0.6, 0.35))
    bundle, _ = scene._repr_mimebundle_()
    assert WIDGET in bundle and base64.b64decode(bundle["image/png"]).startswith(PNG)
    scene.pose = [0.5, 0.5, 0.1]
    assert scene._widget.pose == [0.5, 0.5, 0.1]
    scene._widget.set_state({"pose": [0.6, 0.5, 0.2]})
    assert scene.pose == [0.6, 0.5, 0.2]
    assert scene.drives == pytest.approx(robots.THREE_RPR.inverse(scene.pose))
    folded = ParallelScene(robots.THREE_RRR.base, robots.THREE_RRR.platform, (0.5, 0.45, 0.2), (0.4, 0.4))
    assert folded.still().startswith(PNG)
    with pytest.raises(ValueError, match=r"leg \d would have to span .* its bars reach from 0.000 to 0.800 m"):
        folded.pose = (3, 0, 0)
    assert folded.pose == [0.5, 0.45, 0.2]


def test_labels_never_hide_each_other():
    rng = np.random.default_rng(2)
    labels = [
        {"x": x, "y": y, "heading": heading, "gap": 4, "w": w, "h": 16}
        for x, y, heading, w in rng.uniform((60, 60, -3, 20), (260, 200, 3, 90), (40, 4))
    ]
    placed = in_node("dhkitScene.arrange(given, 320, 260)", labels)
    boxes = [box for box in placed if box]
    assert len(boxes) > 15
    for k, one in enumerate(boxes):
        assert one["w"] / 2 <= one["x"] <= 320 - one["w"] / 2
        for other in boxes[:k]:
            apart = abs(one["x"] - other["x"]) >= (one["w"] + other["w"]) / 2
            assert apart or abs(one["y"] - other["y"]) >= (one["h"] + other["h"]) / 2


def test_a_label_keeps_its_place_when_it_can():
    label = {"x": 100, "y": 100, "heading": 0, "gap": 4, "w": 30, "h": 16}
    (first,) = in_node("dhkitScene.arrange(given, 320, 260)", [label])
    (second,) = in_node("dhkitScene.arrange(given, 320, 260, ['0.5235987755982988 0'])", [label])
    assert first["key"] == "0 0"
    assert second["key"].startswith("0.52")


def test_the_four_moves_of_a_row_lead_from_frame_to_frame():
    arm = Scene([[0, 0.3, 0.5, 0.2, t1]]).state()["arm"]
    found = np.array(in_node("[0, 1, 1.5, 2, 3, 4].map((share) => dhkitScene.walk(given, [0.7], 0, share))", arm))
    steps = [
        (0, 0, 0, 0),
        (0.3, 0, 0, 0),
        (0.3, 0.25, 0, 0),
        (0.3, 0.5, 0, 0),
        (0.3, 0.5, 0.2, 0),
        (0.3, 0.5, 0.2, 0.7),
    ]
    assert found.reshape(-1, 4, 4) == pytest.approx(modified_dh(*np.array(steps).T))


def test_a_path_is_followed_from_end_to_end():
    given = [[0, 0], [1, 2], [3, 2]]
    assert in_node("[0, 0.25, 0.5, 1].map((share) => dhkitScene.along(given, share))", given) == [
        [0, 0],
        [0.5, 1],
        [1, 2],
        [3, 2],
    ]


@pytest.mark.slow
def test_the_committed_program_is_built_from_its_sources(tmp_path):
    folder = PROGRAM.parent / "js"
    if not (folder / "node_modules").is_dir():
        pytest.skip("the tools that build the program are not installed: make scene")
    command = json.loads((folder / "package.json").read_text())["scripts"]["build"]
    built = tmp_path / "scene.js"
    command = command.replace("--outfile=../scene.js", f"--outfile={built}")
    subprocess.run(["npx", "--no-install", *command.split()], cwd=folder, check=True, capture_output=True)
    assert built.read_bytes() == PROGRAM.read_bytes()


@pytest.mark.parametrize("project", ["pyproject.toml", "course/pyproject.toml"])
def test_the_program_goes_with_the_kit_with_its_licence(project):
    data = tomllib.loads((ROOT / project).read_text())["tool"]["setuptools"]["package-data"]
    assert data["dhkit.scene"] == ["scene.js", "LICENSE-three.txt"]


def test_the_kit_stays_below_two_megabytes(tmp_path):
    course = ROOT / "course"
    data = tomllib.loads((course / "pyproject.toml").read_text())["tool"]["setuptools"]["package-data"]
    taken = [path for path in (course / "dhkit").rglob("*.py") if "node_modules" not in path.parts]
    for package, patterns in data.items():
        taken += [path for pattern in patterns for path in (course / package.replace(".", "/")).glob(pattern)]
    with zipfile.ZipFile(tmp_path / "kit.whl", "w", zipfile.ZIP_DEFLATED) as wheel:
        for path in taken:
            wheel.write(path, path.relative_to(course))
    assert PROGRAM in taken
    assert (tmp_path / "kit.whl").stat().st_size < 2_000_000
