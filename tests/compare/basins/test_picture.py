"""Pictures of outcome maps: the right colour at the right place, named axes, and a file that is whole."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from cointoss.compare.basins.picture import MapAxis, draw_comparison, draw_map
from cointoss.compare.basins.picture_style import Palette, PictureStyle
from cointoss.models.records import Outcome
from tests.helpers.made_maps import EDGE, HEADS, TAILS, UNDECIDED, halves, stripes

X = MapAxis(name="release.angular_velocity.eta", unit="rad/s", start=20.0, stop=60.0)
Y = MapAxis(name="floor.restitution", unit="", start=0.5, stop=0.9)
GOLD, BLUE, BLACK, VERMILION = (245, 171, 31), (13, 92, 168), (0, 0, 0), (213, 94, 0)


def drawn(figure, panel=0):
    """Give a function that tells the colour drawn at a point of a panel."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    image = np.asarray(canvas.buffer_rgba())[::-1, :, :3]

    def color(x, y):
        column, row = figure.axes[panel].transData.transform((x, y))
        return tuple(image[int(row), int(column)].tolist())

    return color


def legend(figure):
    return [text.get_text() for text in figure.legends[0].get_texts()]


@pytest.mark.parametrize("axis", [X, replace(X, start=60.0, stop=20.0)])
def test_each_pixel_is_drawn_around_its_coordinates(axis):
    # Spaced by 10 in x and 0.2 in y; row 0 is the lowest.
    outcomes = [[1, 1, 2, 2, 2], [1, 2, 2, 2, 1], [2, 2, 2, 2, 2]]
    color = drawn(draw_map(outcomes, x=axis, y=Y))
    for row, y in enumerate([0.5, 0.7, 0.9]):
        for column, x in enumerate(np.linspace(axis.start, axis.stop, 5)):
            expected = GOLD if outcomes[row][column] == HEADS else BLUE
            for dx, dy in ((0, 0), (-4.5, -0.09), (4.5, 0.09)):
                assert color(x + dx, y + dy) == expected


def test_axes_are_named_with_their_units_and_the_legend_names_what_is_there():
    figure = draw_map([[1, 2, 0], [1, 1, 3]], x=X, y=Y)
    labels = figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()
    assert labels == ("release.angular_velocity.eta [rad/s]", "floor.restitution")
    assert legend(figure) == ["heads", "tails", "edge", "undecided"]
    assert legend(draw_map(halves(2, 4), x=X, y=Y, style=PictureStyle(boundaries=True))) == [
        "heads",
        "tails",
        "boundary",
    ]


@pytest.mark.parametrize("palette", Palette)
def test_a_palette_has_a_colour_for_every_outcome(palette):
    color = drawn(draw_map(np.arange(len(Outcome))[None], x=X, y=Y, style=PictureStyle(palette=palette)))
    assert len({color(x, 0.5) for x in np.linspace(20, 60, len(Outcome))}) == len(Outcome)


@pytest.mark.parametrize("palette", Palette)
@pytest.mark.parametrize("width", [3.0, 5.0])
def test_the_legend_stays_in_the_picture(palette, width):
    style = PictureStyle(palette=palette, boundaries=True, size=(width, 4.0))
    figure = draw_map(np.arange(len(Outcome))[None], x=X, y=Y, style=style)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    box = figure.legends[0].get_window_extent()
    assert 0 <= box.x0 < box.x1 <= figure.bbox.width


def test_boundary_pixels_are_coloured_where_asked():
    plain, marked = (
        drawn(draw_map(halves(2, 5), x=X, y=Y, style=PictureStyle(boundaries=on))) for on in (False, True)
    )
    assert [plain(x, 0.5) for x in (20, 30, 40, 50)] == [GOLD, GOLD, BLUE, BLUE]
    assert [marked(x, 0.5) for x in (20, 30, 40, 50)] == [GOLD, BLACK, BLACK, BLUE]


def test_stripes_finer_than_a_dot_are_mixed():
    color = drawn(draw_map(stripes(1000, 1601, 1), x=X, y=Y))
    seen = np.array([color(x, y) for x in np.linspace(22, 58, 40) for y in (0.55, 0.85)], dtype=float)
    assert np.abs(seen - (np.array(GOLD) + BLUE) / 2).max() <= 2  # rounding


def test_a_comparison_shows_both_maps_and_where_they_differ():
    a = np.array([[HEADS, HEADS, TAILS, TAILS, UNDECIDED]] * 2, dtype=np.int8)
    b = np.array([[HEADS, TAILS, TAILS, EDGE, HEADS]] * 2, dtype=np.int8)
    figure = draw_comparison(a, b, x=X, y=Y)
    titles = [axes.get_title() for axes in figure.axes]
    assert titles == ["analytic", "MuJoCo", "different: 50 % of the pixels both decide"]
    left, middle, right = (drawn(figure, panel) for panel in range(3))
    assert [left(x, 0.6) for x in (20, 30, 40, 50)] == [GOLD, GOLD, BLUE, BLUE]
    assert [middle(x, 0.6) for x in (20, 30, 40, 60)] == [GOLD, BLUE, BLUE, GOLD]
    assert right(30, 0.6) == right(50, 0.6) == VERMILION
    assert right(20, 0.6) == right(40, 0.6) not in {VERMILION, GOLD, BLUE}
    assert right(60, 0.6) == left(60, 0.6)
    assert legend(figure) == ["heads", "tails", "edge", "undecided", "both alike", "different"]


def test_a_comparison_hatches_the_untrusted_pixels_of_the_analytic_map():
    maps, untrusted = [np.full((2, 4), HEADS, np.int8)] * 2, np.array([[True, False, False, False]] * 2)
    figure = draw_comparison(*maps, x=X, y=Y, untrusted=untrusted)
    left, middle = (drawn(figure, panel) for panel in range(2))
    across = np.linspace(20, 60, 120)
    for color, at in ((left, across), (middle, across)):
        hatched = np.array([color(x, 0.6) != GOLD for x in at])
        assert not hatched[40:].any()
        assert hatched[:20].any() == (color is left)
    assert legend(figure)[-1] == "untrusted: 25 %"


def test_a_comparison_leaves_out_what_either_map_has_in_a_transient():
    a, b = np.full((2, 2, 4), HEADS, np.int8)
    a[:, 0], b[:, 1], b[:, 2] = Outcome.TRANSIENT, Outcome.TRANSIENT, TAILS
    title = draw_comparison(a, b, x=X, y=Y).axes[2].get_title()
    assert title == "different: 50 % of the pixels both decide"


def test_a_comparison_of_nothing_says_so():
    figure = draw_comparison(np.zeros((2, 3), int), halves(2, 3), x=X, y=Y)
    assert figure.axes[2].get_title() == "difference: no pixel decided by both"
    with pytest.raises(ValueError, match="that of analytic"):
        draw_comparison(halves(2, 4), halves(4, 2), x=X, y=Y)
