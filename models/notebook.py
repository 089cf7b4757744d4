"""How records look in a notebook, by the macros of notebook.html.j2, and sequences for a person."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

from cointoss.models.palette import COLORS

MOST_SHOWN = 60
"""Faces of a sequence, and impacts, in one line or picture."""


@dataclass(frozen=True)
class Frame:
    """A page that a notebook shows in a frame: its scripts reach neither the notebook nor other frames."""

    title: str
    page: str
    """HTML that needs no other file."""
    height: int = 860
    """The height of the frame [px]."""

    def __repr__(self) -> str:
        """Return what is shown, and where."""
        return f"<Frame: {self.title}; a notebook shows it>"

    def _repr_html_(self) -> str:
        """Return the frame."""
        return str(_macros().frame(self.title, self.page, self.height))


def shortened(sequence: str, most: int = MOST_SHOWN) -> str:
    """Return a sequence for a person: its first `most` symbols and how many are left out."""
    left_out = len(sequence) - most
    return sequence if left_out <= 0 else f"{sequence[:most]} ... and {left_out} more"


def with_bar(sequence: str, trusted: int) -> str:
    """Return a sequence with a bar after the impacts that can be trusted, where others follow."""
    return sequence if trusted >= len(sequence) else f"{sequence[:trusted]}|{sequence[trusted:]}"


def path_block(
    title: str,
    facts: Mapping[str, str],
    times: Sequence[float],
    heights: Sequence[float],
    touches: Sequence[tuple[float, float, str]],
    trusted_until: float | None,
) -> str:
    """Return a title, the height of a coin over time, marked where it touches the floor, and facts as HTML.

    Args:
        title: of the block.
        facts: by their names, for a table.
        times: of the path [s].
        heights: at these times [m].
        touches: time [s], height [m] and the face that is up, "heads" or "tails"; the first are drawn.
        trusted_until: where the horizon of trust is drawn [s]; None for nowhere.
    """
    picture = _macros().path(times, heights, touches[:MOST_SHOWN], trusted_until, COLORS)
    return str(_macros().block(title, picture, facts))


@cache
def _macros() -> Any:
    import jinja2

    text = (resources.files("cointoss.models") / "notebook.html.j2").read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
    return environment.from_string(text).module
