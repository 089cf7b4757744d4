"""How a picture of a map is drawn, without what draws it."""

from dataclasses import dataclass
from enum import StrEnum

DPI = 150


class Palette(StrEnum):
    """Colours of the outcomes."""

    SAFE = "safe"
    """Heads gold and tails blue, as on the coin; the colour-blind can distinguish all."""
    PAPER = "paper"
    """Heads black and tails white, as in Figs 29 to 31."""


@dataclass(frozen=True, kw_only=True)
class PictureStyle:
    """How a picture is drawn."""

    palette: Palette = Palette.SAFE
    boundaries: bool = False
    """Whether pixels at a boundary are coloured as such."""
    size: tuple[float, float] | None = None
    """Width and height of the whole, by default those of `cointoss.compare.basins.picture` [inches]."""
    dpi: float = DPI
    """Pixels per inch."""
