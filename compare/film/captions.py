"""What a film says in words: the face that is up, the time, what the floor does."""

from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from matplotlib.colors import to_hex
from PIL import Image, ImageDraw, ImageFont

from cointoss.compare.engines import label_of
from cointoss.compare.film.drawing import FORCE_COLOR, IMPULSE_COLOR
from cointoss.compare.film.play import Play
from cointoss.compare.output.style import GREY, INK
from cointoss.models.ending import face_up
from cointoss.models.palette import HEADS, TAILS
from cointoss.models.records import Ending, Outcome

Font = ImageFont.FreeTypeFont | ImageFont.ImageFont
_font = cache(ImageFont.load_default)

TITLES = {"analytic": "#005A8E", "mujoco": "#AA4400"}
"""The colour of each engine's name; another's is written in ink."""
LABELS = {Outcome.HEADS: (HEADS, INK), Outcome.TAILS: (TAILS, "white")}
"""Ground and ink of a face's label; an outcome that is none is grey."""

WIDEST_NAME = 0.4
"""The part of its panel's width that an engine's name takes at most."""


class Line(NamedTuple):
    """A line of a caption."""

    text: str
    color: str = INK


class Caption(NamedTuple):
    """What the film says about one toss at one time."""

    title: Line
    """The engine."""
    label: str
    """The face that is up, or the outcome of a toss that has ended."""
    ground: str
    """The colour of the label's ground."""
    ink: str
    """The colour of the label's letters."""
    lines: Sequence[Line]


_ENDED = {
    Ending.SETTLED: "settled",
    Ending.PAPER: "settled",
    Ending.PAPER_SMOOTH: "settled",
    Ending.CAUGHT: "caught",
    Ending.NOT_CAUGHT: "not caught",
    Ending.LYING: "lies still",
    Ending.STANDING: "stands on its edge",
    Ending.AT_REST: "rests on its edge",
}
"""How a toss ends, and the motion beyond it; what is missing has a name of its own."""


def caption_of(play: Play, i: int) -> Caption:
    """Describe a toss at one of the times of a film."""
    toss, states = play.toss, play.states
    count = int(np.searchsorted(toss.impacts.time, play.times[i], side="right"))
    height = 100 * states.position[i, 2]
    lines = [Line(f"{count} impact{'' if count == 1 else 's'}, height {height:.1f} cm")]
    outcome = Outcome(face_up(states.normal[i, 2]))
    label = f"{outcome} up"
    told = play.filmed.toss
    if play.times[i] >= told.end_time:
        outcome, label = told.outcome, str(told.outcome)
        how = _ENDED.get(told.ending, f"ended: {str(told.ending).replace('_', ' ')},")
        at_last = told is not toss and play.times[i] == toss.end_time
        then = f", {_ENDED.get(toss.ending, 'still moves')}" if at_last else ""
        lines.append(Line(f"{how} at {told.end_time:.3f} s{then}"))
    shown = play.impulses(i)
    if shown:
        size = np.linalg.norm(shown[-1].impulse)
        lines.append(Line(f"impulse {1000 * size:#.3g} mN s", to_hex(IMPULSE_COLOR)))
    if play.forces[i].any():
        weights = np.linalg.norm(play.forces[i]) / (toss.scenario.coin.mass * toss.scenario.gravity)
        lines.append(Line(f"floor's force {weights:.2f} m g", to_hex(FORCE_COLOR)))
    title = Line(label_of(toss.engine), TITLES.get(toss.engine, INK))
    return Caption(title, label.upper(), *LABELS.get(outcome, (GREY, "white")), lines)


def written(frame: np.ndarray, captions: Sequence[Caption], below: str) -> np.ndarray:
    """Write captions into a frame.

    Args:
        frame: panels of one width side by side, (height, width, 3) of uint8.
        captions: one for each panel, at its top left.
        below: one line for all, at the bottom.

    Returns:
        A new frame, of the same shape.
    """
    image = Image.fromarray(frame)
    draw = ImageDraw.Draw(image)
    size = max(image.height / 22, 6)
    large = _font(1.5 * size)
    for number, caption in enumerate(captions):
        left = number * image.width / len(captions) + size / 2
        name = _fitting(draw, caption.title.text, size, WIDEST_NAME * image.width / len(captions))
        draw.text((left, 1.5 * size), caption.title.text, caption.title.color, name, "lm")
        start = left + draw.textlength(caption.title.text, font=name) + size / 2
        end = start + draw.textlength(caption.label, font=large) + size
        draw.rounded_rectangle((start, 0.4 * size, end, 2.6 * size), size / 3, fill=caption.ground)
        draw.text((start + size / 2, 1.5 * size), caption.label, font=large, fill=caption.ink, anchor="lm")
        for i, line in enumerate(caption.lines):
            font = _fitting(draw, line.text, size, image.width / len(captions) - size)
            draw.text((left, (3.5 + 1.3 * i) * size), line.text, line.color, font, "lm")
        if number > 0:
            x = number * image.width // len(captions)
            draw.line((x, 0, x, image.height), fill="white", width=max(2, image.width // 400))
    if below:
        # On a ground of its own, over what divides the panels and over shadows.
        x, half = image.width / 2, draw.textlength(below, font=_font(size)) / 2 + size / 2
        ground = (x - half, image.height - 1.8 * size, x + half, image.height - 0.2 * size)
        draw.rounded_rectangle(ground, size / 3, fill="white")
        draw.text((x, image.height - size), below, INK, _font(size), "mm")
    return np.asarray(image)


def _fitting(draw: ImageDraw.ImageDraw, text: str, size: float, most: float) -> Font:
    """Return the font in which a text is at most `most` wide, and no larger than `size` [pixels]."""
    return _font(size * min(1.0, most / max(draw.textlength(text, font=_font(size)), 1.0)))
