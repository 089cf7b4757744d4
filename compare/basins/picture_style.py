"""How a picture of a map is drawn, without what draws it."""

from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated, NamedTuple, Self

from cointoss.compare.output.accepted import Form, Within

DPI = 150


class Palette(StrEnum):
    """Colours of the outcomes."""

    SAFE = "safe"
    """Heads gold and tails blue, as on the coin; the colour-blind can distinguish all."""
    PAPER = "paper"
    """Heads black and tails white, as in Figs 29 to 31."""


class Size(NamedTuple):
    """The size of a picture [inches]."""

    width: float
    height: float

    def __str__(self) -> str:
        """Return the text that `read` reads."""
        return f"{self.width:.17g}x{self.height:.17g}"

    @classmethod
    def read(cls, text: str) -> Self:
        """Return the size of WIDTHxHEIGHT.

        Raises:
            ValueError: saying what is accepted.
        """
        try:
            width, height = (float(part) for part in text.split("x"))
        except ValueError:
            width = height = 0.0
        if not (1 <= width <= 100 and 1 <= height <= 100):
            raise ValueError("WIDTHxHEIGHT in inches, each from 1 to 100, as in 6x4.5")
        return cls(width, height)


@dataclass(frozen=True, kw_only=True)
class PictureStyle:
    """How a picture is drawn."""

    palette: Palette = Palette.SAFE
    """safe: gold and blue, for the colour-blind too; paper: black and white."""
    boundaries: bool = False
    """Colour the pixels at a boundary."""
    size: Annotated[tuple[float, float] | None, Form("WIDTHxHEIGHT", Size.read)] = None
    """Size of the picture in inches."""
    dpi: Annotated[float, Within(10, 2400)] = DPI
    """Pixels per inch of the picture."""
