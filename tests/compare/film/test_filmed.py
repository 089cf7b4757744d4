"""How a film ends: the coin lies still, or is caught; and the files it is written to."""

import mediapy
import numpy as np
import pytest
from PIL import Image

from cointoss.compare.engines import Engine
from cointoss.compare.film.captions import caption_of
from cointoss.compare.film.drawing import Camera
from cointoss.compare.film.encodings import ENCODINGS, Format
from cointoss.compare.film.filmed import FOLLOWED_FOR, Filmed, followed
from cointoss.compare.film.play import play_of
from cointoss.compare.film.slow_motion import FAST, SETTLED, SLOW, SPEEDS_UP_FOR, film_times
from cointoss.compare.film.video import write_video
from cointoss.compare.output import interruption
from cointoss.models.ending import face_up
from cointoss.models.reading import load, scenario_text
from cointoss.models.records import Ending, Outcome
from tests.helpers.command_line import cointoss, refused
from tests.helpers.films import FLAT, MadePath, drawn, film_written, made, shown

pytestmark = pytest.mark.usefixtures("without_horizon")

TINY = Format(64, 48, 4, longest=2.0)


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


@pytest.mark.parametrize("ending", [Ending.CAUGHT, Ending.LYING, Ending.PERPETUAL, Ending.MAX_IMPACTS])
def test_what_has_ended_otherwise_is_filmed_as_it_is(ending):
    toss = made(MadePath(position=(0, 0, 0.1)), ending=ending)
    assert followed(toss).motion is toss


def going_on(end=1.0, until=2.0, then=Ending.LYING):
    path = MadePath(position=(0, 0, 0.1))
    toss = made(path, impacts=[(0.3, 1e-3)], end=end)
    return Filmed(toss=toss, motion=made(path, impacts=[(0.3, 1e-3), (1.5, 9e-4)], end=until, ending=then))


def test_the_film_goes_on_at_real_speed_when_all_faces_are_settled():
    later = shown(made(MadePath(position=(0, 0, 0.1)), end=1.2))
    times, speeds = film_times([going_on(), later], 60)
    assert times[-1] == 2
    assert speeds[np.abs(times - 0.3).argmin()] == pytest.approx(SLOW, rel=0.05)
    assert speeds[np.abs(times - 1.15).argmin()] == pytest.approx(FAST, rel=1e-9)
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
    path = MadePath(position=(0, 0, 0.1), velocity=(0, 0, 2), acceleration=(0, 0, -9.81), quaternion=FLAT)
    toss = made(path, end=0.38, ending=Ending.CAUGHT, outcome=Outcome.HEADS)
    _, speeds = film_times([shown(toss)], 60)
    assert speeds[-1] == pytest.approx(SLOW, rel=0.05)
    pictures = drawn(toss, [0.0, 0.02, 0.38], Camera.CLOSE_UP, height=96, width=128)
    palm = [np.argwhere((np.abs(picture - [200, 155, 125]) < 40).all(axis=-1)) for picture in pictures]
    assert [len(found) > 100 for found in palm] == [False, False, True]
    assert palm[2][:, 0].mean() > 48
    caption = caption_of(play_of(shown(toss), np.array([0.38])), 0)
    assert caption.lines[1].text == "caught at 0.380 s"


@pytest.mark.parametrize("suffix", ENCODINGS)
def test_a_film_is_written_in_every_format(tmp_path, suffix):
    toss = made(MadePath(position=(0, 0, 0.1), velocity=(0, 0, 0.2)), impacts=[(0.1, 1e-3)], end=0.3)
    path = tmp_path / f"film{suffix}"
    poster = write_video([shown(toss)], Camera.TOP, TINY, path, lambda *_: None)
    assert poster.shape == (48, 64, 3)
    written = film_written(path)
    assert written.size == (64, 48)
    assert written.codec == {".mp4": "h264", ".webm": "vp9", ".gif": "gif"}[suffix]


@pytest.fixture
def encoders(monkeypatch):
    """The processes of the encoders that are started."""
    started = []

    class Writer(mediapy.VideoWriter):
        def __enter__(self):
            super().__enter__()
            started.append(self._popen)
            return self

    monkeypatch.setattr(mediapy, "VideoWriter", Writer)
    return started


def stop(encoder):
    """Stop an encoder as a signal does."""
    encoder.kill()
    encoder.wait()


def write_small(path, progress=lambda *_: None):
    """Write a film of few frames."""
    toss = made(MadePath(position=(0, 0, 0.1)), end=0.3)
    write_video([shown(toss)], Camera.TOP, TINY, path / "film.mp4", progress)


def test_an_encoder_that_stopped_is_an_error_of_the_file(tmp_path, encoders):
    with pytest.raises(OSError, match="ffmpeg: stopped, or the disk is full"):
        write_small(tmp_path, lambda *_: stop(encoders[0]))


@pytest.mark.parametrize("strike", [KeyboardInterrupt(), SystemExit(143)])
def test_an_encoder_that_an_interruption_stopped_is_no_error(tmp_path, encoders, strike):
    def interrupt(*_):
        stop(encoders[0])
        raise strike

    with pytest.raises(type(strike)) as raised:
        write_small(tmp_path, interrupt)
    assert raised.value is strike


def test_an_interruption_is_found_behind_several_errors(tmp_path, encoders, monkeypatch):
    """The pipe breaks as the interruption closes it, and the encoder complains of that."""

    def broken(*_):
        try:
            try:
                raise KeyboardInterrupt
            finally:
                raise BrokenPipeError
        finally:
            raise RuntimeError("Error writing 'film.mp4': Immediate exit requested")

    monkeypatch.setattr(mediapy.VideoWriter, "add_image", broken)
    with pytest.raises(KeyboardInterrupt):
        write_small(tmp_path)
    assert len(encoders) == 1


def test_an_encoder_that_complains_before_the_signal_is_heeded_is_no_error(tmp_path, encoders, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    def broken(*_):
        monkeypatch.setattr(interruption.time, "sleep", interrupt)
        raise BrokenPipeError

    monkeypatch.setattr(mediapy.VideoWriter, "add_image", broken)
    with pytest.raises(KeyboardInterrupt):
        write_small(tmp_path)
    assert len(encoders) == 1


@pytest.mark.parametrize("where", ["__enter__", "add_image", "close"])
@pytest.mark.parametrize("strike", [KeyboardInterrupt, SystemExit])
def test_an_encoder_is_waited_for_wherever_an_interruption_strikes(
    tmp_path, encoders, monkeypatch, where, strike
):
    method = getattr(mediapy.VideoWriter, where)

    def interrupted(*arguments):
        if where == "__enter__":
            method(*arguments)
        raise strike

    monkeypatch.setattr(mediapy.VideoWriter, where, interrupted)
    with pytest.raises(strike):
        write_small(tmp_path)
    (encoder,) = encoders
    assert encoder.returncode is not None


def test_the_command_writes_a_poster_and_refuses_other_suffixes(tmp_path, monkeypatch):
    monkeypatch.setitem(ENCODINGS, ".gif", ENCODINGS[".gif"]._replace(form=TINY))
    text = scenario_text("fig24a").replace("0.40001", "0.05") + "\n[ending]\nmax_impacts = 1\n"
    (tmp_path / "short.toml").write_text(text)
    film, poster = tmp_path / "film.GIF", tmp_path / "film.png"
    said = cointoss("video", tmp_path / "short.toml", "--out", film, "--poster", poster)
    assert (said.exit_code, said.stdout) == (0, f"{film}\n"), said.stderr
    assert film.read_bytes().startswith(b"GIF89a")
    with Image.open(poster) as picture:
        assert picture.size == (64, 48)
    for out, wanted in (("film.avi", ".mp4 or .webm or .gif"), ("film", ".mp4 or .webm or .gif")):
        told = refused("video", tmp_path / "short.toml", "--out", tmp_path / out)
        assert told.endswith(f"/{out}: another kind of file; accepted: a name that ends in {wanted}\n")
    told = refused("video", tmp_path / "short.toml", "--out", film, "--poster", tmp_path / "b.jpg")
    assert "b.jpg: another kind of file; accepted: a name that ends in .png" in told
