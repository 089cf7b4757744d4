"""The sizes of films, and the kinds of files that they are written to."""

from typing import NamedTuple

LONGEST = 30.0
"""A longer film is sped up to this length, if no other is asked for [s]."""


class Format(NamedTuple):
    """The size and the speed of a film."""

    width: int
    """The width of a picture of one toss or two [pixels]."""
    height: int
    """The height of a picture [pixels]."""
    frames_per_second: int
    longest: float = LONGEST
    """A film that would take longer is sped up to this length [s]."""


FULL, SMALL = Format(1280, 720, 30), Format(960, 540, 24, longest=12.5)
"""The formats of a film that stands alone, and of one in a page, whose reader waits for it."""


class Encoding(NamedTuple):
    """How a film is written to a file of one kind."""

    codec: str
    form: Format
    """The format of a film that stands alone."""
    rate: float | None
    """Constant rate factor: the larger, the smaller the file."""
    arguments: str = ""
    """Further arguments of ffmpeg."""


ENCODINGS = {
    ".mp4": Encoding("h264", FULL, 21, "-preset veryfast -movflags +faststart"),
    ".webm": Encoding("libvpx-vp9", FULL, 31, "-deadline good -cpu-used 5 -row-mt 1"),
    ".gif": Encoding("gif", Format(640, 360, 20, longest=15.0), None),  # without compression in time
}
"""The encodings by the suffix of the file."""
