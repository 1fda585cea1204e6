"""Sliders come with a static picture, and with the picture alone where widgets are missing."""

import base64
import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import pytest

from dhkit import interactive
from dhkit.drawing import draw_planar_arm

PNG = b"\x89PNG"


@pytest.fixture
def shown(monkeypatch):
    seen = []
    monkeypatch.setattr(interactive, "display", lambda content, **options: seen.append(content))
    return seen


def arm(t1, t2):
    return draw_planar_arm((0.5, 0.4), (t1, t2))


def test_sliders_carry_the_start_figure_as_a_static_picture(shown):
    interactive.explore(arm, t1=(-1, 1, 0.3), t2=(-1, 1, 0.5))
    (bundle,) = shown
    assert "application/vnd.jupyter.widget-view+json" in bundle
    assert base64.b64decode(bundle["image/png"]).startswith(PNG)
    assert not plt.get_fignums()


def test_without_widgets_the_static_picture_remains(shown, monkeypatch):
    monkeypatch.setitem(sys.modules, "ipywidgets", None)
    interactive.explore(arm, t1=(-1, 1, 0.3), t2=(-1, 1, 0.5))
    assert shown[0].data.startswith(PNG)


def test_moving_a_slider_redraws(shown, monkeypatch):
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
