"""A toss, or several side by side, as a film in a file."""

import errno
import itertools
import re
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import imageio_ffmpeg
import mediapy
import numpy as np

from cointoss.compare.film.captions import caption_of, written
from cointoss.compare.film.drawing import Camera, Drawer, box_of
from cointoss.compare.film.encodings import ENCODINGS, Format
from cointoss.compare.film.filmed import Filmed
from cointoss.compare.film.play import play_of
from cointoss.compare.film.slow_motion import film_times
from cointoss.models.records import Array
from cointoss.models.stages import stage

HELD = 1.0
"""How long the last picture stays [s]."""
SOON = 0.1
"""How long after ffmpeg stopped the signal may be heeded here that stopped it, as Ctrl-C does [s]."""


def frames(shown: Sequence[Filmed], camera: Camera, form: Format) -> Iterator[np.ndarray]:
    """Draw the frames of a film, one at a time, (height, width, 3) of uint8.

    Args:
        shown: tosses by any engines, of coins of one radius; they stand side by side.
        camera: from where.
        form: of the film.
    """
    times, speeds = film_times(shown, form.frames_per_second, form.longest)
    plays = [play_of(each, times) for each in shown]
    box, width = box_of(plays), _width(shown, form) // len(shown)
    with ExitStack() as stack:
        drawers = [
            stack.enter_context(Drawer(play, camera, box, height=form.height, width=width)) for play in plays
        ]
        for i, (time, speed) in enumerate(zip(times, speeds, strict=True)):
            picture = np.concatenate([drawer.draw(i) for drawer in drawers], axis=1)
            captions = [caption_of(play, i) for play in plays]
            frame = written(picture, captions, f"t = {time:.4f} s    at {_told(speed)}")
            held = _held(form) if i == len(times) - 1 else 0
            yield from itertools.repeat(frame, 1 + held)


def write_video(shown: Sequence[Filmed], camera: Camera, form: Format, path: Path) -> np.ndarray:
    """Write a film to a file, and show how far it is.

    Args:
        shown: tosses by any engines, of one coin; they stand side by side.
        camera: from where.
        form: of the film.
        path: of the file, with a suffix of `ENCODINGS`.

    Returns:
        The frame that stands for the film, (height, width, 3) of uint8.

    Raises:
        OSError: if the encoder can't write the file.
    """
    mediapy.set_ffmpeg(imageio_ffmpeg.get_ffmpeg_exe())
    encoding = ENCODINGS[path.suffix.lower()]
    times, _ = film_times(shown, form.frames_per_second, form.longest)
    count, shape = len(times) + _held(form), (form.height, _width(shown, form))
    chosen, poster = poster_number(shown, times), np.zeros((*shape, 3), np.uint8)
    writer = mediapy.VideoWriter(
        str(path),
        shape,
        codec=encoding.codec,
        fps=form.frames_per_second,
        crf=encoding.rate,
        ffmpeg_args=encoding.arguments,
    )
    with stage("drawing the film", "frames") as progress, _encoding(writer):
        for number, frame in enumerate(frames(shown, camera, form), start=1):
            writer.add_image(frame)
            poster = frame if number == chosen else poster
            progress(number, count)
    return poster


@contextmanager
def _encoding(writer: mediapy.VideoWriter) -> Iterator[None]:
    """Run an encoder, and wait for it however the film ends; mediapy leaves one that fails running."""
    try:
        with writer:
            yield
    except (RuntimeError, BrokenPipeError) as error:
        told = (_last_words(writer) or str(error).partition("': ")[2]).strip()
        behind: BaseException | None = error
        while behind is not None and not isinstance(behind, KeyboardInterrupt | SystemExit):
            behind = behind.__context__
        if behind is not None:
            raise behind from None
        time.sleep(SOON)
        reason = told.splitlines()[-1] if told else "stopped, or the disk is full"
        reason = re.sub(r" @ 0x[0-9a-f]+", "", reason)  # where in memory a part of ffmpeg lies
        raise OSError(errno.EIO, f"ffmpeg: {reason}", str(writer.path)) from error
    finally:
        if (encoder := writer._popen) is not None:
            encoder.kill()
            with suppress(BrokenPipeError), encoder:
                pass


def _last_words(writer: mediapy.VideoWriter) -> str:
    """Return what an encoder that failed says to its end."""
    encoder = writer._popen
    return "" if encoder is None or encoder.stderr is None else encoder.stderr.read().decode(errors="replace")


def poster_number(shown: Sequence[Filmed], times: Array) -> int:
    """Return the number of the frame that stands for a film.

    It shows the faces best of those in the second half of the first flight, or of all where nothing touches.

    Args:
        shown: the tosses of the film.
        times: of its frames, (n,) [s].
    """
    until = min(np.append(each.motion.impacts.time, each.motion.end_time)[0] for each in shown)
    first, last = np.searchsorted(times, (until / 2, until))
    flight = times[first : last + 1]
    paths = (each.motion.sample(np.minimum(flight, each.motion.end_time)) for each in shown)
    return 1 + int(first + np.argmax(np.sum([np.abs(path.normal[:, 2]) for path in paths], axis=0)))


def _width(shown: Sequence[Filmed], form: Format) -> int:
    """Return the width of a film: of more than two tosses each has the half of its form [pixels]."""
    return form.width // 2 * max(2, len(shown))


def _held(form: Format) -> int:
    """Return how many frames longer the last picture stays."""
    return round(HELD * form.frames_per_second)


def _told(speed: float) -> str:
    if abs(speed - 1) < 0.05:
        return "real speed"
    return f"1/{1 / speed:.2g} of real speed" if speed < 1 else f"{speed:.2g} times real speed"
