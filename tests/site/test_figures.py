"""The figures of the site: the dark ones, and each leads to its full size."""

import re
from importlib import import_module

import numpy as np
import pytest

from cointoss.models.palette import HEADS, TAILS
from tests.helpers.site import SITE

figures = import_module("figures")


def test_greys_change_places_and_the_faces_keep_their_colors():
    faces = np.array([list(bytes.fromhex(color[1:])) for color in (HEADS, TAILS)]) / 255
    found = figures.darkened(np.array([[1.0, 1, 1], [0, 0, 0], *faces]))
    assert found == pytest.approx(np.array([[figures.GROUND] * 3, [figures.INK] * 3, *faces]))


def test_what_names_no_color_in_a_drawing_is_light():
    dark = figures.dark_drawing('<svg width="1"><path fill="white"/><text fill="#0d5ca8"/></svg>')
    assert dark == '<svg fill="#ebebeb" width="1"><path fill="#141414"/><text fill="#127ee6"/></svg>'


def test_a_picture_in_pale_colors_has_no_dark_one():
    colors = [1, 1, 0.85], [1, 1, 1]
    assert [figures.is_pale(np.full((2, 2, 3), color)) for color in colors] == [True, False]


@pytest.mark.parametrize("name", ["HANDS.html", "DESIGN.html", "reproduction/fig24/index.html"])
def test_a_figure_leads_to_its_full_size_on_light_and_on_dark(name):
    text = (SITE / name).read_text(encoding="utf-8")
    shown = re.findall(r'<a class="figure only-(\w+)" href="([^"]+)"><img [^>]*src="([^"]+)"', text)
    assert [kind for kind, *_ in shown[:2]] == ["light", "dark"]
    assert all(address == source for _, address, source in shown)
    assert all(((SITE / name).parent / source).is_file() for *_, source in shown)
