"""What shows records: records draw nothing themselves, and the package's front names here what does."""

from collections.abc import Callable
from typing import Any


class Views:
    """The functions that show records; `cointoss/__init__.py` sets each when the package is imported."""

    plot_toss: Callable[..., Any]
    """Plots a toss in matplotlib's Axes and returns them."""
    play_toss: Callable[..., Any]
    """Returns the frame of a notebook that plays a toss, and beside it another or None."""
    gltf_of_toss: Callable[..., bytes]
    """Returns a toss as the content of a file of glTF."""


views = Views()
"""The views of this process."""
