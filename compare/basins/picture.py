"""Pictures of outcome maps."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm, to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import ArrayLike, NDArray

from cointoss.compare.basins.boundary import boundary_pixels
from cointoss.compare.basins.maps import OutcomeCodes, measured, outcome_map
from cointoss.compare.basins.picture_style import Palette, PictureStyle
from cointoss.compare.output.style import (
    BLUE,
    GREEN,
    GREY,
    GRID,
    ORANGE,
    OUTCOMES,
    PALE,
    PURPLE,
    SKY,
    VERMILION,
)
from cointoss.models.records import Outcome

PLAIN = PictureStyle()
PANEL_SIZE = (5.0, 4.5)
"""Width and height of one map [inches]."""
COMPARISON_SIZE = (3 * PANEL_SIZE[0], PANEL_SIZE[1])
"""Width and height of three maps side by side [inches]."""
MARGINS_SIZE = (2 * PANEL_SIZE[0] + 0.8, PANEL_SIZE[1])
"""Width and height of a map and its margins [inches]."""
_ENTRY_WIDTH = 1.3  # of the legend [inches]
_MARGINS, _NO_MARGIN = "cividis", GRID
_TAIL = 0.005
"""The part of the margins at either end that shares the last colour."""
_HATCH_SIDE, _HATCH_PERIOD, _HATCH_WIDTH = 1200, 24, 6
"""The hatch over a panel: dots along both sides, and the distance and the width of its lines [dots]."""
_HATCH_TINT = 0.3
"""Opacity between its lines, so that a single pixel is seen there too."""
_SAME, _DIFFERENT = "#e6e9ed", VERMILION


# Undecided is a hue in print, since fine stripes of black and white make every grey.
_COLORS = {
    Palette.SAFE: OUTCOMES,
    Palette.PAPER: {
        Outcome.UNDECIDED: PURPLE,
        Outcome.HEADS: "#000000",
        Outcome.TAILS: "#FFFFFF",
        Outcome.EDGE: GREEN,
        Outcome.PERPETUAL: SKY,
        Outcome.TRANSIENT: BLUE,
    },
}
_BOUNDARY = {Palette.SAFE: "#000000", Palette.PAPER: VERMILION}
_HATCH = {Palette.SAFE: "#FFFFFF", Palette.PAPER: ORANGE}


@dataclass(frozen=True, kw_only=True)
class MapAxis:
    """What a map's columns, or rows, stand for; they are evenly spaced."""

    name: str
    unit: str
    start: float
    """The field's value at the first pixel's centre."""
    stop: float
    """The field's value at the last pixel's centre."""


class MapMargins(NamedTuple):
    """The margins of the pixels of a map."""

    changes: ArrayLike
    """The smallest change of each pixel that changes its outcome, infinite where none does, (y, x)."""
    quantity: str
    """What changes."""
    unit: str
    most: float
    """The largest change that was tried [unit]."""


def draw_map(
    outcomes: ArrayLike,
    *,
    x: MapAxis,
    y: MapAxis,
    style: PictureStyle = PLAIN,
    margins: MapMargins | None = None,
    untrusted: NDArray[np.bool_] | None = None,
) -> Figure:
    """Draw a map, and beside it the sizes of its margins, where it has them.

    Args:
        outcomes: the map, (y, x).
        x: of the columns.
        y: of the rows.
        style: how to draw.
        margins: of its pixels.
        untrusted: the pixels that the horizon of trust does not cover, (y, x), which are hatched.
    """
    figure = Figure(
        figsize=style.size or (PANEL_SIZE if margins is None else MARGINS_SIZE), layout="constrained"
    )
    panels = figure.subplots(1, 1 if margins is None else 2, sharex=True, sharey=True, squeeze=False)[0]
    patches = draw_panel(panels[0], outcomes, x=x, y=y, style=style, untrusted=untrusted)
    if margins is not None:
        patches += draw_margin_panel(panels[1], margins, x=x, y=y)
        panels[0].set_title("outcome")
        panels[1].set_title(f"change of {margins.quantity} that changes it")
        panels[1].label_outer()
    _legend(figure, patches)
    return figure


def draw_panel(
    axes: Axes,
    outcomes: ArrayLike,
    *,
    x: MapAxis,
    y: MapAxis,
    style: PictureStyle = PLAIN,
    untrusted: NDArray[np.bool_] | None = None,
) -> list[Patch]:
    """Draw a map into `axes`, and return what its legend has; see `draw_map` for the other arguments."""
    codes = outcome_map(outcomes)
    _show(axes, _colored(codes, style), x, y)
    axes.set_ylabel(_label(y))
    return [*_outcome_patches([codes], style), *_hatched(axes, untrusted, x, y, codes.shape, style)]


def _hatched(
    axes: Axes,
    untrusted: NDArray[np.bool_] | None,
    x: MapAxis,
    y: MapAxis,
    shape: tuple[int, ...],
    style: PictureStyle,
) -> list[Patch]:
    """Hatch the untrusted pixels of a map of this shape; return what the legend has of them."""
    if untrusted is None:
        return []
    color, label = _HATCH[style.palette], f"untrusted: {100 * untrusted.mean():.3g} %"
    _show(axes, _hatch(untrusted, color), x, y, shape=shape)
    return [Patch(facecolor=PALE, edgecolor=color, hatch="/////", linewidth=0.6, label=label)]


def _hatch(mask: NDArray[np.bool_], color: str) -> NDArray[np.uint8]:
    """Return tint and lines of one colour over the pixels of a mask, transparent elsewhere, (side, side, 4).

    The lines are drawn as dots, not as paths, so that a mask of many single pixels costs no more than
    another.
    """
    dots = np.arange(_HATCH_SIDE)
    rows, columns = (dots * count // _HATCH_SIDE for count in mask.shape)
    lines = (dots[None, :] - dots[:, None]) % _HATCH_PERIOD < _HATCH_WIDTH
    shades = np.zeros((_HATCH_SIDE, _HATCH_SIDE, 4), dtype=np.uint8)
    shades[..., :3] = _rgb(color)
    shades[..., 3] = mask[rows][:, columns] * np.where(lines, 255, round(255 * _HATCH_TINT))
    return shades


def draw_margin_panel(axes: Axes, margins: MapMargins, *, x: MapAxis, y: MapAxis) -> list[Patch]:
    """Draw the sizes of margins on a logarithmic scale, and return what their legend has."""
    sizes = np.abs(np.asarray(margins.changes, dtype=float))
    found, most, unit = sizes[np.isfinite(sizes)], margins.most, margins.unit
    ends = np.quantile(found, [_TAIL, 1 - _TAIL]) if found.size else np.array([most / 10, most])
    norm = LogNorm(*10.0 ** np.array([np.floor(np.log10(ends[0])), np.ceil(np.log10(ends[1]) + 1e-9)]))
    shades = np.round(255 * colormaps[_MARGINS](norm(np.minimum(sizes, most)))[..., :3]).astype(np.uint8)
    shades[np.isinf(sizes)] = _rgb(_NO_MARGIN)
    _show(axes, shades, x, y)
    axes.set_ylabel(_label(y))
    shown, figure = ScalarMappable(norm, colormaps[_MARGINS]), axes.figure
    label = f"smallest change of {margins.quantity} [{unit}]"
    figure.colorbar(shown, ax=axes, extend="both", label=label)
    return [_patch(_NO_MARGIN, f"none found up to {most:g} {unit}")] if found.size < sizes.size else []


def draw_comparison(
    analytic: ArrayLike,
    mujoco: ArrayLike,
    *,
    x: MapAxis,
    y: MapAxis,
    style: PictureStyle = PLAIN,
    note: str = "",
    untrusted: NDArray[np.bool_] | None = None,
) -> Figure:
    """Draw the maps of both engines and where they differ, side by side.

    Args:
        analytic: the map by the analytic engine, (y, x).
        mujoco: the map by MuJoCo on the same grid, (y, x).
        x: of the columns.
        y: of the rows.
        style: how to draw.
        note: more lines over the difference.
        untrusted: the pixels of the analytic map, (y, x), that are hatched.

    Raises:
        ValueError: for maps of two shapes.
    """
    a, b = outcome_map(analytic), outcome_map(mujoco)
    if a.shape != b.shape:
        raise ValueError(f"mujoco: shape {b.shape}, accepted: that of analytic, {a.shape}")
    figure = Figure(figsize=style.size or COMPARISON_SIZE, layout="constrained")
    panels = figure.subplots(1, 3, sharex=True, sharey=True)
    decided = (measured(a) != Outcome.UNDECIDED) & (measured(b) != Outcome.UNDECIDED)
    different = decided & (a != b)
    difference = np.where(different[..., None], _rgb(_DIFFERENT), _rgb(_SAME))
    difference[~decided] = _rgb(_COLORS[style.palette][Outcome.UNDECIDED])
    told = "difference: no pixel decided by both"
    if decided.any():
        told = f"different: {100 * different.sum() / decided.sum():.3g} % of the pixels both decide"
    for axes, title, colors in zip(
        panels,
        ("analytic", "MuJoCo", f"{told}\n{note}".rstrip()),
        (_colored(a, style), _colored(b, style), difference),
        strict=True,
    ):
        _show(axes, colors, x, y)
        axes.set_title(title)
    panels[0].set_ylabel(_label(y))
    patches = [*_outcome_patches([a, b], style), _patch(_SAME, "both alike"), _patch(_DIFFERENT, "different")]
    _legend(figure, [*patches, *_hatched(panels[0], untrusted, x, y, a.shape, style)])
    return figure


def _colored(codes: OutcomeCodes, style: PictureStyle) -> NDArray[np.uint8]:
    """Return each pixel's colour, (y, x, 3)."""
    colors = np.array([_rgb(_COLORS[style.palette][outcome]) for outcome in Outcome])[codes]
    if style.boundaries:
        colors[boundary_pixels(codes)] = _rgb(_BOUNDARY[style.palette])
    return colors


def _rgb(color: str) -> NDArray[np.uint8]:
    return np.round(255 * np.array(to_rgb(color))).astype(np.uint8)


def _show(
    axes: Axes,
    colors: NDArray[np.uint8],
    x: MapAxis,
    y: MapAxis,
    *,
    shape: tuple[int, ...] | None = None,
) -> None:
    """Draw colours, (rows, columns, 3 or 4), where the pixels of a map are, of their own shape by default."""
    ny, nx = shape or colors.shape[:2]
    # Where several pixels share a dot, their colours are mixed: dropping some would make patterns.
    axes.imshow(
        colors, origin="lower", aspect="auto", extent=(*_ends(x, nx), *_ends(y, ny)), interpolation="auto"
    )
    axes.set_xlabel(_label(x))
    axes.tick_params(color=GREY)
    axes.spines[:].set_color(GREY)


def _ends(axis: MapAxis, n: int) -> tuple[float, float]:
    """Return the outer edges of the first and the last of n pixels."""
    half = (axis.stop - axis.start) / (n - 1) / 2 if n > 1 else 0.5
    return axis.start - half, axis.stop + half


def _label(axis: MapAxis) -> str:
    return f"{axis.name} [{axis.unit}]" if axis.unit else axis.name


def _outcome_patches(maps: list[OutcomeCodes], style: PictureStyle) -> list[Patch]:
    present = [outcome for outcome in Outcome if any((codes == outcome).any() for codes in maps)]
    present.sort(key=lambda outcome: outcome is Outcome.UNDECIDED)
    patches = [_patch(_COLORS[style.palette][outcome], str(outcome)) for outcome in present]
    return [*patches, *([_patch(_BOUNDARY[style.palette], "boundary")] if style.boundaries else [])]


def _patch(color: str, label: str) -> Patch:
    return Patch(facecolor=color, edgecolor=GREY, linewidth=0.6, label=label)


def _legend(figure: Figure, patches: list[Patch]) -> None:
    rows = -(-len(patches) // max(1, int(figure.get_figwidth() / _ENTRY_WIDTH)))
    figure.legend(handles=patches, loc="outside lower center", ncols=-(-len(patches) // rows), frameon=False)
