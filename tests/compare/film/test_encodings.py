"""Every format of a film, and encoders that stop, complain or are interrupted."""

from contextlib import nullcontext
from unittest.mock import Mock

import mediapy
import numpy as np
import pytest

from cointoss.compare.film import video
from cointoss.compare.film.drawing import Camera
from cointoss.compare.film.encodings import ENCODINGS, Format
from cointoss.compare.film.slow_motion import film_times
from cointoss.compare.film.video import frames, poster_number, write_video
from tests.helpers.films import MadePath, Written, film_written, made, shown

TINY = Format(64, 48, 4, longest=2.0)
TOSS = made(MadePath(position=(0, 0, 0.1), velocity=(0, 0, 0.2)), impacts=[(0.1, 1e-3)], end=0.3)


@pytest.mark.slow_after_first
@pytest.mark.parametrize("suffix", ENCODINGS)
def test_a_film_is_written_in_every_format(tmp_path, monkeypatch, suffix):
    path, tosses, told = tmp_path / f"film{suffix}", [shown(TOSS)] * 2, []
    monkeypatch.setattr(video, "stage", lambda *_: nullcontext(lambda *done: told.append(done)))
    poster = write_video(tosses, Camera.TOP, TINY, path)
    drawn = list(frames(tosses, Camera.TOP, TINY))
    count = len(drawn)
    assert told == [(i + 1, count) for i in range(count)]
    times, _ = film_times(tosses, TINY.frames_per_second, TINY.longest)
    assert np.array_equal(poster, drawn[poster_number(tosses, times) - 1])
    codec = {".mp4": "h264", ".webm": "vp9", ".gif": "gif"}[suffix]
    assert film_written(path) == Written(codec=codec, size=(64, 48), rate=4, frames=count)


HIDDEN = RuntimeError("Error writing 'film.mp4': Immediate exit requested")
"""The encoder's complaint of a pipe that breaks as an interruption closes it."""
HIDDEN.__context__ = BrokenPipeError()
HIDDEN.__context__.__context__ = KeyboardInterrupt()


@pytest.mark.parametrize(
    ("killed", "error", "where", "soon", "raised"),
    [
        (False, HIDDEN, "add_image", None, KeyboardInterrupt),
        (False, BrokenPipeError, "add_image", KeyboardInterrupt, KeyboardInterrupt),
        (True, None, "add_image", None, OSError),
        (True, KeyboardInterrupt, "add_image", None, KeyboardInterrupt),
        (True, SystemExit(143), "add_image", None, SystemExit),
        (False, KeyboardInterrupt, "__enter__", None, KeyboardInterrupt),
        (False, SystemExit(143), "close", None, SystemExit),
    ],
)
def test_what_ends_the_encoding_is_raised_and_the_encoder_is_waited_for(
    tmp_path, monkeypatch, killed, error, where, soon, raised
):
    """It may be behind other errors, or heeded soon after; a killed encoder is an error of the file."""
    encoders, enter, strike = [], mediapy.VideoWriter.__enter__, Mock(side_effect=error)

    def entered(writer):
        enter(writer)
        encoders.append(writer._popen)
        if killed:
            encoders[0].kill()
            encoders[0].wait()
        return strike() if where == "__enter__" else writer

    monkeypatch.setattr(mediapy.VideoWriter, "__enter__", entered)
    if where != "__enter__":
        monkeypatch.setattr(mediapy.VideoWriter, where, strike)
    monkeypatch.setattr(video.time, "sleep", Mock(side_effect=soon))
    with pytest.raises(raised) as told:
        write_video([shown(TOSS)], Camera.TOP, TINY, tmp_path / "film.mp4")
    assert raised is not OSError or "ffmpeg: stopped, or the disk is full" in str(told.value)
    assert encoders[0].returncode is not None
