"""Sliders come with a static picture, and with the picture alone where widgets are missing."""

import base64
import json
import re
from io import BytesIO

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest

from dhkit import interactive
from dhkit.drawing import draw_chain, draw_planar_arm, view
from dhkit.flipbook import stops_of

PNG = b"\x89PNG"


@pytest.fixture
def shown(monkeypatch):
    seen = []
    monkeypatch.setattr(interactive, "display", lambda content, **options: seen.append(content))
    return seen


@pytest.fixture
def watched(monkeypatch):
    monkeypatch.setattr(interactive, "is_watched", lambda: True)


def arm(t1, t2):
    return draw_planar_arm((0.5, 0.4), (t1, t2))


def test_sliders_carry_the_start_figure_as_a_static_picture(shown, watched):
    interactive.explore(arm, t1=(-1, 1, 0.3), t2=(-1, 1, 0.5))
    (bundle,) = shown
    assert "application/vnd.jupyter.widget-view+json" in bundle
    assert base64.b64decode(bundle["image/png"]).startswith(PNG)
    assert not plt.get_fignums()


def test_without_widgets_the_static_picture_remains(shown, watched, monkeypatch):
    monkeypatch.setattr(interactive, "find_spec", lambda name: None)
    interactive.explore(arm, t1=(-1, 1, 0.3), t2=(-1, 1, 0.5))
    assert shown[0].data.startswith(PNG)


def test_where_nobody_sits_before_the_notebook_the_picture_stands_alone(shown):
    interactive.explore(arm, t1=(-1, 1, 0.3), t2=(-1, 1, 0.5))
    (picture,) = shown
    assert picture.data.startswith(PNG)


def test_moving_a_slider_redraws(shown, watched, monkeypatch):
    import ipywidgets

    drawn, sliders = [], []

    class Recorded(ipywidgets.FloatSlider):
        def __init__(self, *args, **options):
            super().__init__(*args, **options)
            sliders.append(self)

    def record(**values):
        drawn.append(values)
        return arm(**values)

    monkeypatch.setattr(ipywidgets, "FloatSlider", Recorded)
    interactive.explore(record, t1=(-1, 1, 0.3), t2=(-1, 1, 0.5))
    sliders[1].value = -0.5
    assert drawn == [{"t1": 0.3, "t2": 0.5}, {"t1": 0.3, "t2": -0.5}]


@pytest.mark.slow
def test_a_site_gets_pictures_of_each_slider_in_one_size(shown, monkeypatch):
    monkeypatch.setenv("DHKIT_SCENES", "embedded")
    drawn = []

    def record(**values):
        drawn.append(values)
        return arm(**values)

    interactive.explore(record, t1=(-1, 1, 0.3), t2=(-3, 3, 0))
    (bundle,) = shown
    assert base64.b64decode(bundle["image/png"]).startswith(PNG)
    books = json.loads(re.search(r'<script type="application/json">(.*?)</script>', bundle["text/html"])[1])
    assert [book["name"] for book in books] == ["t1", "t2"]
    assert [book["stops"][book["start"]] for book in books] == [0.3, 0]
    assert all({"t1": 0.3, "t2": stop} in drawn for stop in books[1]["stops"])
    pages = [page for book in books for page in book["pages"] if page]
    still = re.search(r'<img src="(.*?)"', bundle["text/html"])[1]
    assert len(pages) == len(set(pages)) == 16 and still not in pages
    sizes = {plt.imread(BytesIO(base64.b64decode(page.partition(",")[2])), "webp").shape for page in (*pages, still)}
    assert len(sizes) == 1
    assert [len(book["pages"]) for book in books] == [9, 9]
    assert all(book["pages"][book["start"]] == "" for book in books)


@pytest.mark.parametrize("low, high, start", [(-90, 90, 40), (0, 4, 4), (0, 4, 0), (-1, 1, 0.999), (0.02, 0.6, 0.1)])
def test_stops_rise_from_end_to_end_through_the_start(low, high, start):
    stops = stops_of(low, high, start)
    assert (np.diff(stops) > 0).all()
    assert (stops[0], stops[-1]) == (low, high) and start in stops


SLIDERS = [(-90, 90, 40), (-180, 180, 50), (0.3, 1.2, 0.8), (-40, 75, 30), (-60, 120, 40), (0.0, 0.3, 0.2), (0, 4, 4)]


@pytest.mark.parametrize("low, high, start", [*SLIDERS, (-179, 178, -60), (0.02, 0.6, 0.1), (-1.0, 1.0, 0.35)])
def test_a_slider_reaches_its_ends_its_start_and_zero(low, high, start):
    step = interactive.step_of(low, high, start)
    assert (high - low) / 400 < step <= (high - low) / 50
    reachable = {round(low + k * step, 9) for k in range(round((high - low) / step) + 1)}
    assert {low, high, start} <= reachable
    assert 0 in reachable or low > 0 or high < 0


def test_a_range_of_odd_numbers_has_a_hundred_steps():
    assert interactive.step_of(0, 1, 1 / 3) == pytest.approx(0.01)


def planar(t1, t2):
    return draw_planar_arm((0.5, 0.4), (t1, t2))


def in_space(t1, t2):
    return draw_chain([[0, 0, 0, 0.3, t1], [0, 0.5, 1.2, 0, t2], [0, 0.4, 0, 0, 0]], tool=True, frames=())


@pytest.mark.slow
@pytest.mark.slow
@pytest.mark.parametrize("draw", [planar, in_space])
def test_pictures_keep_scale_and_place_when_sliders_move(draw):
    camera = interactive._Camera(draw)
    turns = (0.3, 3.0)
    for t1 in turns:
        camera.picture({"t1": t1, "t2": 0.5})
    seen = [camera.picture({"t1": t1, "t2": 0.5}) for t1 in (*turns, 0.3)]
    assert seen[0] == seen[-1] != seen[1]
    pictures = [plt.imread(BytesIO(png)) for png in seen]
    assert len({picture.shape for picture in pictures}) == 1
    assert not plt.get_fignums()


def base(draw, camera, t1) -> list[float]:
    """Where the base is in the picture, in pixels from its corner."""
    with view.held(camera._frame):
        ax = draw(t1, 0.5)
    camera._frame.hold_planes(ax.figure)
    at = view.to_pixels(ax, [(0, 0, 0)])[0] if draw is in_space else ax.transData.transform((0, 0))
    plt.close("all")
    return [round(float(coordinate), 6) for coordinate in at]


@pytest.mark.slow
@pytest.mark.parametrize("draw", [planar, in_space])
def test_the_base_does_not_jump(draw):
    camera = interactive._Camera(draw)
    for t1 in (0.3, 3.0):
        camera.picture({"t1": t1, "t2": 0.5})
    assert base(draw, camera, 0.3) == base(draw, camera, 3.0)
    assert base(draw, interactive._Camera(draw), 0.3) != base(draw, interactive._Camera(draw), 3.0)
