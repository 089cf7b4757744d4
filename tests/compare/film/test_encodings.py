"""Every format of a film, and encoders that stop, complain or are interrupted."""

import mediapy
import pytest

from cointoss.compare.film import video
from cointoss.compare.film.drawing import Camera
from cointoss.compare.film.encodings import ENCODINGS, Format
from cointoss.compare.film.video import frame_count, write_video
from tests.helpers.films import MadePath, Written, film_written, made, shown

TINY = Format(64, 48, 4, longest=2.0)


@pytest.mark.slow_after_first
@pytest.mark.parametrize("suffix", ENCODINGS)
def test_a_film_is_written_in_every_format(tmp_path, suffix):
    toss = made(MadePath(position=(0, 0, 0.1), velocity=(0, 0, 0.2)), impacts=[(0.1, 1e-3)], end=0.3)
    path, told = tmp_path / f"film{suffix}", []
    poster = write_video([shown(toss)] * 2, Camera.TOP, TINY, path, lambda *done: told.append(done))
    assert poster.shape == (48, 64, 3)
    count = frame_count([shown(toss)], TINY)
    assert told == [(i + 1, count) for i in range(count)]
    codec = {".mp4": "h264", ".webm": "vp9", ".gif": "gif"}[suffix]
    assert film_written(path) == Written(codec=codec, size=(64, 48), rate=4, frames=count)


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
        monkeypatch.setattr(video.time, "sleep", interrupt)
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
