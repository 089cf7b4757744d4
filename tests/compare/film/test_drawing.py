"""A film shows the coin where its path is, the floor's action as arrows, and says what it shows.

The tosses are made by formulas, and drawn small.
"""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import itertools
from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest

from cointoss.compare.film.captions import caption_of, written
from cointoss.compare.film.drawing import (
    FIELD_OF_VIEW,
    LONGEST_FAR,
    LONGEST_NEAR,
    MARGIN,
    PUSHES,
    VIEWS,
    Box,
    Camera,
    Drawer,
    _aimed,
    box_of,
)
from cointoss.compare.film.filmed import Filmed
from cointoss.compare.film.play import SHOWN_FOR, Play, Shown, play_of
from cointoss.models.records import Ending
from tests.helpers.draws import ZLOTY
from tests.helpers.films import (
    FLAT,
    UPRIGHT,
    MadePath,
    blue,
    center,
    drawn,
    golden,
    green,
    made,
    pink,
    shown,
)

R = ZLOTY["radius"]


@pytest.mark.parametrize(
    ("camera", "thickness", "tilts"),
    [
        (Camera.CLOSE_UP, 2e-3, (35.0, -35.0)),
        (Camera.OVERVIEW, 2e-3, (20.0, -20.0)),
        (Camera.TOP, 0.0, (0.0,)),
    ],
)
def test_the_face_that_is_seen_is_the_face_that_is_up(camera, thickness, tilts):
    """It is so on a coin that is tilted towards the camera or away from it, and on a thin one."""
    for up, color, other in ((0.0, golden, blue), (180.0, blue, golden)):
        for tilt in tilts:
            half = np.radians(up + tilt) / 2
            path = MadePath(position=(0, 0, 0.02), quaternion=(np.cos(half), np.sin(half), 0, 0))
            (picture,) = drawn(made(path, coin={"thickness": thickness}), [0], camera, height=96, width=128)
            assert color(picture).sum() > 10, (up, tilt)
            assert not other(picture).any(), (up, tilt)


def test_the_coin_is_where_its_path_is_seen_from_above():
    """From afar, so a length is the same number of pixels at every height."""
    toss = made(MadePath(position=(0, 0, 0.3), velocity=(0.06, 0.04, -0.25)))
    first, last = drawn(toss, [0, 1], Camera.TOP)
    deep = 0.04 + 4 * R
    scale = 48 / (MARGIN * max(deep / VIEWS[Camera.TOP].part, (0.06 + 4 * R) * 48 / 64))
    assert center(golden(last)) - center(golden(first)) == pytest.approx(
        [-0.04 * scale, 0.06 * scale], abs=0.7
    )
    assert golden(last).sum() == pytest.approx(golden(first).sum(), rel=0.15)


@pytest.mark.parametrize("high", [(0.02, 0.02, 0.5), (0.02, 0.6, 0.1), (0.6, 0.02, 0.1)], ids=str)
def test_the_overview_is_filled_by_the_box_that_it_must_see(high):
    """Some corner stands where a pinhole camera, nearer by the margin, has the edge of its part."""
    box, view = Box(np.array([-0.02, -0.02, -0.02]), np.array(high)), VIEWS[Camera.OVERVIEW]
    aimed, seen = _aimed(Camera.OVERVIEW, box, R, 4 / 3)
    c, s = np.cos(np.radians(view.elevation)), np.sin(np.radians(view.elevation))
    corners = np.array(list(itertools.product(*zip(box.low, box.high, strict=True)))) - aimed.lookat
    right, above, deep = (corners @ np.array([[1, 0, 0], [0, -s, c], [0, c, s]]).T).T
    part = np.maximum(np.abs(above) / view.part, np.abs(right) / (4 / 3)) / (deep + aimed.distance / MARGIN)
    assert part.max() == pytest.approx(np.tan(np.radians(FIELD_OF_VIEW / 2)))
    assert seen == pytest.approx(2 * aimed.distance * part.max())


@pytest.mark.parametrize("camera", [Camera.OVERVIEW, Camera.TOP])
def test_a_camera_at_rest_shows_the_path_up_to_now(camera):
    toss = made(MadePath(position=(0, 0, 0.2), velocity=(0.3, 0.002, -0.002)))
    # The shadow, which is dark too, moves with the coin.
    with patch("cointoss.compare.film.drawing.add_shadow"):
        pictures = drawn(toss, [0, 0.5, 1], camera, height=192, width=256)
    first, middle, last = (picture.sum(axis=2) for picture in pictures)
    # Between where the coin is at these times, which is some ten pixels large.
    at = [round(center(golden(picture))[1]) for picture in pictures]
    early, late = slice(at[0] + 15, at[1] - 15), slice(at[1] + 15, at[2] - 15)
    # The floor's texture is rounded one way or the other; the path is darker than it by more than 60.
    assert np.abs(middle[:, early] - last[:, early]).max() <= 3
    assert np.abs(first[:, late] - middle[:, late]).max() <= 3
    for columns in (early, late):
        darker = np.argwhere(first[:, columns] - last[:, columns] > 60)
        assert len(set(darker[:, 1])) > 0.9 * (columns.stop - columns.start) > 30
        assert np.ptp(darker[:, 0]) < 4


def test_the_close_up_follows_the_coin():
    toss = made(MadePath(position=(0, 0, 0.3), velocity=(0.3, 0.2, -0.25)))
    for picture in drawn(toss, [0, 0.5, 1], Camera.CLOSE_UP):
        assert center(golden(picture)) == pytest.approx([48 * (0.5 + VIEWS[Camera.CLOSE_UP].aim), 32], abs=2)


def test_a_coin_high_up_is_seen_close_by():
    """The nearest that a camera draws is a part of the scene's extent."""
    toss = made(MadePath(position=(0, 0, 1000.0), velocity=(0, 0, -1000.0)))
    box = box_of([play_of(shown(toss), np.array([0, 0.99]))])
    (picture,) = drawn(toss, [0], Camera.CLOSE_UP, box=box)
    assert golden(picture).any()


@pytest.mark.parametrize(
    ("z", "quaternion", "acts", "color", "times"),
    [
        (0.001, FLAT, {"impacts": [(0.5, 1e-3)]}, pink, (0.499, 0.5, 0.5 + 1.01 * SHOWN_FOR)),
        (R, UPRIGHT, {"contacts": [(0.4, 0.6)]}, green, (0.3, 0.5, 0.7)),
    ],
    ids=["impulse", "force"],
)
def test_what_the_floor_does_is_an_arrow_while_it_is_done(z, quaternion, acts, color, times):
    toss = made(MadePath(position=(0, 0, z), quaternion=quaternion), **acts)
    seen = [color(picture).sum() for picture in drawn(toss, times, Camera.CLOSE_UP, height=192, width=128)]
    assert seen[0] == seen[2] == 0
    assert seen[1] > 10


@pytest.mark.parametrize(
    ("camera", "part"), [(Camera.CLOSE_UP, LONGEST_NEAR), (Camera.OVERVIEW, LONGEST_FAR)]
)
def test_an_arrow_is_as_long_as_the_impulse_is_large(camera, part):
    toss = made(MadePath(position=(0, 0, 0.001)), impacts=[(0.4, 2e-3), (0.6, 1e-3)])
    high, box = [], Box(np.array([-0.1, -0.02, -0.02]), np.array([0.1, 0.02, 0.5]))
    for picture in drawn(toss, [0.4, 0.6], camera, height=192, width=192, box=box):
        rows = np.argwhere(pink(picture))[:, 0]
        high.append(rows.max() - rows.min())
    assert high[1] / high[0] == pytest.approx(0.5, abs=0.1)
    # It is seen from above, and the floor is farther away than what the camera aims at.
    assert high[0] == pytest.approx(192 * part * np.cos(np.radians(VIEWS[camera].elevation)), rel=0.2)


def test_the_coin_does_not_hide_an_arrow():
    toss = made(MadePath(position=(0, 0, R), quaternion=UPRIGHT), impacts=[(0.5, 1e-3)])
    with_arrow = pink(drawn(toss, [0.5], Camera.CLOSE_UP)[0]).sum()
    away = made(MadePath(position=(0, 0, 20 * R), quaternion=UPRIGHT), impacts=[(0.5, 1e-3)])
    assert pink(drawn(away, [0.5], Camera.CLOSE_UP)[0]).sum() == pytest.approx(with_arrow, rel=0.3)


@pytest.mark.parametrize(("weights", "length"), [(1, 0.5), (2, 1.0), (200, 1.0)])
def test_a_force_pushes_from_below_by_its_weights_up_to_two(weights, length):
    view, force = VIEWS[Camera.CLOSE_UP], (0, 0, weights * ZLOTY["mass"] * 9.81)
    toss = made(MadePath(position=(0, 0, R), quaternion=UPRIGHT, force=force), contacts=[(0.4, 0.6)])
    (picture,) = drawn(toss, [0.5], Camera.CLOSE_UP, height=192, width=192)
    rows = np.argwhere(green(picture))[:, 0]
    # The camera looks at the mass centre.
    assert rows.min() > 192 * (0.5 + view.aim + view.part / 2 * 0.5)
    longest = 192 * LONGEST_NEAR * PUSHES * np.cos(np.radians(view.elevation))
    assert np.ptp(rows) == pytest.approx(length * longest, rel=0.25)


@pytest.mark.parametrize("width", [160, 320])
def test_the_longest_arrows_stay_clear_of_the_caption(width):
    """They are where they reach highest in the picture: at the rim behind."""
    path, impacts = MadePath(position=(0, 0, 0.001), force=(0, 0, 1.0)), [(0.5, 1e-3)]
    settled = made(path, impacts=impacts, end=0.5)
    goes_on = made(path, impacts=impacts, contacts=[(0.5, 0.51)], end=0.51, ending=Ending.MAX_TIME)
    behind = np.array([0, ZLOTY["radius"], 0])
    play = play_of(Filmed(toss=settled, motion=goes_on), np.array([0.5, 0.51]))
    play = replace(play, lowest_points=np.tile(behind, (2, 1)))
    impulse = Shown(point=behind, impulse=np.array([0, 0, 1e-3]), freshness=1.0)
    with (
        patch.object(Play, "impulses", lambda *_: [impulse]),
        Drawer(play, Camera.CLOSE_UP, box_of([play]), height=180, width=width) as drawer,
    ):
        picture, caption = drawer.draw(1), caption_of(play, 1)
    assert len(caption.lines) == 4
    words = np.flatnonzero((picture != written(picture, [caption], "")).any(axis=(1, 2)))
    arrows = pink(picture.astype(int)) | green(picture.astype(int))
    assert np.argwhere(arrows)[:, 0].min() > words.max()
