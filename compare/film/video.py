"""A toss, or two side by side, as a video file."""

import errno
import itertools
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import NamedTuple

import imageio_ffmpeg
import mediapy
import numpy as np

from compare.film.captions import caption_of, written
from compare.film.drawing import Camera, Drawer, box_of
from compare.film.play import play_of
from compare.film.slow_motion import LONGEST, film_times
from models.records import Toss

HELD = 1.5
"""How long the last picture stays [s]."""


class Format(NamedTuple):
    """Of a film."""

    width: int
    """[pixels]."""
    height: int
    """[pixels]."""
    frames_per_second: int
    longest: float = LONGEST
    """A film that would take longer is sped up to this length [s]."""
    samples: int = 2
    """Points of a pixel at which the coin's border is looked for; two take twice the time of one."""


FULL, SMALL = Format(1280, 720, 60), Format(960, 540, 24, longest=15.0, samples=1)
"""Of a film that stands alone, and of one in a page, whose reader waits for it."""


def frame_count(tosses: Sequence[Toss], form: Format) -> int:
    """Return the number of frames of a film."""
    return len(film_times(tosses, form.frames_per_second, form.longest)[0]) + _held(form)


def frames(tosses: Sequence[Toss], camera: Camera, form: Format) -> Iterator[np.ndarray]:
    """Draw the frames of a film, one at a time, (height, width, 3) of uint8.

    Args:
        tosses: by either engine, of coins of one radius; they stand side by side and are drawn by MuJoCo.
        camera: from where.
        form: of the film.
    """
    times, speeds = film_times(tosses, form.frames_per_second, form.longest)
    plays = [play_of(toss, times) for toss in tosses]
    box, width = box_of(plays), form.width // len(tosses)
    with ExitStack() as stack:
        drawers = [
            stack.enter_context(
                Drawer(play, camera, box, height=form.height, width=width, samples=form.samples)
            )
            for play in plays
        ]
        for i, (time, speed) in enumerate(zip(times, speeds, strict=True)):
            picture = np.concatenate([drawer.draw(i) for drawer in drawers], axis=1)
            captions = [caption_of(play, i) for play in plays]
            frame = written(picture, captions, f"t = {time:.4f} s    shown at {_told(speed)} speed")
            held = _held(form) if i == len(times) - 1 else 0
            yield from itertools.repeat(frame, 1 + held)


def write_video(
    tosses: Sequence[Toss], camera: Camera, form: Format, path: Path, progress: Callable[[int, int], None]
) -> None:
    """Write a film as an mp4 file.

    Args:
        tosses: by either engine, of one coin; they stand side by side.
        camera: from where.
        form: of the film.
        path: of the file.
        progress: called after each frame with their number so far and in all.

    Raises:
        OSError: if the encoder can't write the file.
    """
    mediapy.set_ffmpeg(imageio_ffmpeg.get_ffmpeg_exe())
    count, shape = frame_count(tosses, form), (form.height, form.width)
    try:
        with mediapy.VideoWriter(str(path), shape, fps=form.frames_per_second, crf=21) as writer:
            for number, frame in enumerate(frames(tosses, camera, form), start=1):
                writer.add_image(frame)
                progress(number, count)
    except (RuntimeError, BrokenPipeError) as error:
        # Ctrl-C ends the encoder too, whose complaint would hide it.
        if isinstance(error.__context__, KeyboardInterrupt | SystemExit):
            raise error.__context__ from None
        told = "" if isinstance(error, BrokenPipeError) else str(error).partition("': ")[2].strip()
        reason = told.splitlines()[-1] if told else "stopped, or the disk is full"
        raise OSError(errno.EIO, f"ffmpeg: {reason}", str(path)) from error


def _held(form: Format) -> int:
    """Return how many frames longer the last picture stays."""
    return round(HELD * form.frames_per_second)


def _told(speed: float) -> str:
    return f"1/{1 / speed:.2g}" if speed < 1 else f"{speed:.3g} times"
