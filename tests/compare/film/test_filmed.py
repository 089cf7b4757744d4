"""How a film ends: the coin lies still, or is caught."""

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.film.captions import caption_of
from cointoss.compare.film.drawing import Camera
from cointoss.compare.film.filmed import FOLLOWED_FOR, Filmed, followed
from cointoss.compare.film.play import play_of
from cointoss.compare.film.slow_motion import FAST, SETTLED, SLOW, SPEEDS_UP_FOR, film_times
from cointoss.models.ending import face_up
from cointoss.models.reading import load
from cointoss.models.records import Ending, Outcome
from tests.helpers.draws import ZLOTY
from tests.helpers.films import TURNED, MadePath, blue, drawn, made, shown

pytestmark = pytest.mark.usefixtures("without_horizon")


@pytest.mark.parametrize("engine", list(Engine))
@pytest.mark.parametrize(("name", "ending"), [("fig12_ideal", Ending.LYING), ("fig24a", Ending.MAX_TIME)])
def test_a_coin_is_followed_until_it_lies_still_and_keeps_its_settled_face(engine, name, ending):
    toss = engine.package.toss(load(name))
    motion = followed(toss).motion
    assert motion.ending == ending
    assert toss.end_time < motion.end_time <= toss.end_time + FOLLOWED_FOR
    assert np.array_equal(motion.impacts.impulse[: len(toss.impacts)], toss.impacts.impulse)
    rest = motion.sample(np.linspace(toss.end_time, motion.end_time, 500))
    assert {face_up(n_z) for n_z in rest.normal[:, 2]} == {toss.outcome}
    tilt = np.degrees(np.arccos(np.abs(rest.normal[-1, 2])))
    assert tilt < 0.1 if ending == Ending.LYING else tilt > 0.5


@pytest.mark.parametrize(
    "how",
    [
        {"ending": Ending.CAUGHT},
        {"ending": Ending.LYING},
        {"ending": Ending.PERIODIC},
        {"ending": Ending.PERPETUAL},
        {"ending": Ending.MAX_IMPACTS},
        {"engine": "off"},
    ],
    ids=str,
)
def test_what_has_ended_otherwise_or_is_of_another_engine_is_filmed_as_it_is(how):
    toss = made(MadePath(position=(0, 0, 0.1)), **how)
    assert followed(toss).motion is toss


def going_on(end=1.0, until=2.0, then=Ending.LYING):
    path = MadePath(position=(0, 0, 0.1))
    toss = made(path, impacts=[(0.3, 1e-3)], end=end)
    return Filmed(toss=toss, motion=made(path, impacts=[(0.3, 1e-3), (1.5, 9e-4)], end=until, ending=then))


def test_the_film_goes_on_at_real_speed_when_all_faces_are_settled():
    later = shown(made(MadePath(position=(0, 0, 0.1)), end=1.2))
    times, speeds = film_times([going_on(), later], 60)
    slow, fast = (speeds[np.abs(times - at).argmin()] for at in (0.3, 1.15))
    assert (times[-1], slow, fast) == (2, pytest.approx(SLOW, rel=0.05), pytest.approx(FAST, rel=1e-9))
    assert speeds[times > 1.2 + SPEEDS_UP_FOR] == pytest.approx(SETTLED, rel=1e-9)


@pytest.mark.parametrize(("then", "says"), [(Ending.LYING, "lies still"), (Ending.MAX_TIME, "still moves")])
def test_the_caption_marks_when_the_face_was_settled(then, says):
    play = play_of(going_on(then=then), np.array([0.9, 1.0, 1.7, 2.0]))
    captions = [caption_of(play, i) for i in range(4)]
    assert [caption.label for caption in captions] == ["HEADS UP", "HEADS", "HEADS", "HEADS"]
    lines = [[line.text for line in caption.lines if "settled" in line.text] for caption in captions]
    assert lines == [[], ["settled at 1.000 s"], ["settled at 1.000 s"], [f"settled at 1.000 s, {says}"]]


def test_a_hand_catches_the_coin():
    """It is under the coin at the end, and was not there when the coin came up."""
    path = MadePath(position=(0, 0, 0.1), velocity=(0, 0, 1), acceleration=(0, 0, -9.81), quaternion=TURNED)
    toss = made(path, end=0.11, ending=Ending.CAUGHT, outcome=Outcome.HEADS)
    _, speeds = film_times([shown(toss)], 60)
    assert speeds[-1] == pytest.approx(SLOW, rel=0.05)
    pictures = drawn(toss, [0.0, 0.02, 0.11], Camera.CLOSE_UP, height=96, width=128)
    palm = [np.argwhere((np.abs(picture - [200, 155, 125]) < 40).all(axis=-1)) for picture in pictures]
    assert [len(found) > 100 for found in palm] == [False, False, True]
    assert palm[2][:, 0].mean() > 48
    assert blue(pictures[2]).sum() > 100
    caption = caption_of(play_of(shown(toss), np.array([0.11])), 0)
    assert caption.lines[1].text == "caught at 0.110 s"


def test_a_coin_that_wobbles_too_low_to_turn_over_is_filmed_at_real_speed():
    """Over the face from which its mass centre is farther it turns with less energy: m g times that edge."""
    offset = 4e-4
    edge = np.hypot(ZLOTY["radius"], ZLOTY["thickness"] / 2 - offset)
    low, high = (
        made(
            MadePath(position=(0, 0, part * edge)),
            impacts=[(0.5, 1e-3)],
            ending=Ending.LYING,
            coin={"center_of_mass": [0, 0, offset]},
        )
        for part in (0.999, 1.001)
    )
    times, speeds = film_times([shown(low)], 60)
    assert speeds[times > SPEEDS_UP_FOR] == pytest.approx(SETTLED, rel=1e-9)
    _, speeds = film_times([shown(low), shown(high)], 60)
    assert max(speeds) == pytest.approx(FAST, rel=1e-9)
