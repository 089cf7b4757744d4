"""What a film says: labels, impacts, height, the floor's action."""

import numpy as np

from cointoss.compare.film.captions import Line, caption_of, written
from cointoss.compare.film.play import play_of
from cointoss.models.records import Outcome
from tests.helpers.films import FLAT, TURNED, MadePath, blue, golden, made, shown


def test_the_label_has_the_colour_of_the_face_and_then_of_the_outcome():
    blank = np.full((480, 640, 3), 220, np.uint8)
    for quaternion, outcome, labels in (
        (FLAT, Outcome.TAILS, ["HEADS UP", "TAILS"]),
        (TURNED, Outcome.HEADS, ["TAILS UP", "HEADS"]),
        (TURNED, Outcome.UNDECIDED, ["TAILS UP", "UNDECIDED"]),
    ):
        toss = made(MadePath(position=(0, 0, 0.1), quaternion=quaternion), outcome=outcome)
        play = play_of(shown(toss), np.array([0, 1]))
        captions = [caption_of(play, i) for i in range(2)]
        assert [caption.label for caption in captions] == labels
        for caption in captions:
            corner = written(blank, [caption], "").astype(int)[:90, :200]
            assert bool(golden(corner).sum() > 1000) is caption.label.startswith("HEADS")
            assert bool(blue(corner).sum() > 1000) is caption.label.startswith("TAILS")


def test_the_caption_tells_impacts_height_and_the_floors_action():
    path = MadePath(position=(0, 0, 0.123))
    toss = made(path, impacts=[(0.2, 1e-3), (0.5, 2.5e-3)], contacts=[(0.6, 0.8)])
    play = play_of(shown(toss), np.array([0.1, 0.3, 0.5, 0.7, 1]))
    lines = ["; ".join(line.text for line in caption_of(play, i).lines) for i in range(5)]
    assert lines == [
        "0 impacts, height 12.3 cm",
        "1 impact, height 12.3 cm",
        "2 impacts, height 12.3 cm; impulse 2.50 mN s",
        "2 impacts, height 12.3 cm; floor's force 1.00 m g",
        "2 impacts, height 12.3 cm; settled at 1.000 s",
    ]


def test_a_long_name_leaves_its_panel_room_for_the_label():
    """It is written smaller; a name without a colour of its own is written in ink."""
    blank = np.full((480, 640, 3), 220, np.uint8)
    for name in ("off", "an engine of a long name, as documented"):
        toss = made(MadePath(position=(0, 0, 0.1)), engine=name)
        caption = caption_of(play_of(shown(toss), np.array([1])), 0)
        assert (caption.title, caption.label) == (Line(name), "HEADS")
        ground = golden(written(blank, [caption], "").astype(int)[:60])
        assert np.flatnonzero(ground.any(axis=0)).max() < 600
