"""The frame of a notebook in which one or two tosses are played."""

from typing import Any

from cointoss.compare.engines import Engine
from cointoss.compare.web.playable import playable
from cointoss.compare.web.scripts import POLICY, files_of, one_file
from cointoss.models.notebook import Frame
from cointoss.models.records import Toss
from cointoss.models.title import title_of_toss


def play(toss: Toss, other: Toss | None = None) -> Frame:
    """Return a frame that plays a toss, or two together.

    Raises:
        TypeError: for another that is no toss.
    """
    if not isinstance(other, Toss | None):
        raise TypeError(f"other: {other!r}, accepted: a toss")
    title = " and ".join(title_of_toss(one.scenario, "") for one in (toss, other) if one)
    text = one_file(files_of("cointoss.compare.web.play"), _played(toss, other), POLICY)
    return Frame(f"toss of {title}", text)


def _played(toss: Toss, other: Toss | None) -> list[dict[str, Any]]:
    """Return what is played; of two tosses by one engine the second has the colours of the other engine."""
    if other is None:
        return [playable(toss)]
    first, second = playable(toss), playable(other)
    if toss.engine == other.engine:
        colours = next(engine.value for engine in Engine if engine != other.engine)
        first |= {"label": "this toss"}
        second |= {"label": "other toss", "engine": colours}
    return [first, second]
