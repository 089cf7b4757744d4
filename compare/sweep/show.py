"""Pictures of maps, for a file and for a report."""

import io
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont, get_font
from numpy.typing import NDArray

from cointoss.compare.basins import picture
from cointoss.compare.basins.fractions import fractions
from cointoss.compare.basins.picture_style import PictureStyle
from cointoss.compare.metrics.margin import quantity_of
from cointoss.compare.report.map_section import MapSection
from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.describe import AWAY, measure, percent
from cointoss.compare.sweep.grid import Sweep
from cointoss.models.records import Array


def write(
    png: Path,
    maps: list[NDArray[np.int8]],
    sweep: Sweep,
    style: PictureStyle,
    *,
    margins: Array | None = None,
) -> None:
    """Draw one map, or those of both engines and where they differ, with the numbers of their agreement.

    Args:
        png: the file.
        maps: (y, x) each, the first by the analytic engine if there are two.
        sweep: what the first was made of.
        style: how to draw.
        margins: of the first map, (y, x), to be drawn beside it.

    Raises:
        UnwritableError: naming the file and why.
    """
    picture.write_png(figure_of(maps, sweep, style, margins), png, dpi=style.dpi)


def section(
    maps: list[NDArray[np.int8]], sweeps: Sequence[Sweep], style: PictureStyle, command: str
) -> MapSection:
    """Return what a report shows of the maps of both engines.

    Args:
        maps: (y, x) each, the first by the analytic engine.
        sweeps: what each was made of.
        style: how to draw.
        command: that makes the maps.
    """
    drawn, sweep = io.BytesIO(), sweeps[0]
    figure_of(maps, sweep, style).savefig(drawn, format="png", dpi=style.dpi)
    shares = {
        sweep.engine.value: {str(outcome): share for outcome, share in fractions(outcomes).items()}
        for sweep, outcomes in zip(sweeps, maps, strict=True)
    }
    return MapSection(
        picture=drawn.getvalue(),
        numbers={
            "axes": {"x": asdict(sweep.x), "y": asdict(sweep.y)},
            "after": sweep.after,
            "fractions": shares,
            "agreement": {"distance": AWAY, **asdict(measure(*maps))},
            "settings": {sweep.engine.value: sweep.settings.as_dict() for sweep in sweeps},
            "command": command,
        },
    )


def figure_of(
    maps: list[NDArray[np.int8]], sweep: Sweep, style: PictureStyle, margins: Array | None = None
) -> Figure:
    """Draw one map, its margins beside it, or those of both engines; see `write` for the arguments."""
    figure = _panels(maps, sweep, style, margins)
    figure.suptitle(_title(sweep), parse_math=False)
    return figure


def _title(sweep: Sweep) -> str:
    """Return the title of a map, with what its font has; a file's name may hold anything."""
    glyphs = get_font(findfont(FontProperties())).get_charmap()
    shown = "" if sweep.after is None else f": face at touch {sweep.after + 1}"
    return "".join(char if ord(char) in glyphs else "?" for char in sweep.title + shown)


def _panels(maps: list[NDArray[np.int8]], sweep: Sweep, style: PictureStyle, margins: Array | None) -> Figure:
    x, y = _drawn(sweep.x), _drawn(sweep.y)
    common: Any = {"x": x, "y": y, "palette": style.palette, "boundaries": style.boundaries}
    if len(maps) > 1:
        measured = measure(*maps)
        return picture.draw_comparison(
            *maps,
            **common,
            size=style.size or picture.COMPARISON_SIZE,
            note=f"agree: {percent(measured.away)} away from boundaries,\n{percent(measured.near)} near them",
        )
    if margins is not None:
        quantity = quantity_of(sweep.margin or "")
        return picture.draw_margins(
            maps[0],
            margins,
            **common,
            size=style.size or picture.MARGINS_SIZE,
            quantity=quantity.name,
            unit=quantity.unit,
            most=quantity.factor,
        )
    return picture.draw_map(maps[0], **common, size=style.size or picture.PANEL_SIZE)


def draw_layer(axes: Axes, layer: Array | NDArray[np.int8], sweep: Sweep, style: PictureStyle) -> None:
    """Draw the outcomes of a map, or its margins, into `axes`, with a legend below.

    Args:
        axes: where.
        layer: outcomes, of int8, or margins, (y, x).
        sweep: what the map is made of.
        style: how to draw.
    """
    x, y = _drawn(sweep.x), _drawn(sweep.y)
    if layer.dtype == np.int8:
        shown = picture.draw_panel(axes, layer, x=x, y=y, palette=style.palette, boundaries=style.boundaries)
    else:
        quantity = quantity_of(sweep.margin or "")
        about: Any = {"quantity": quantity.name, "unit": quantity.unit, "most": quantity.factor}
        shown = picture.draw_margin_panel(axes, layer, x=x, y=y, **about)
    picture.legend_below(axes, shown)
    axes.set_title(_title(sweep), parse_math=False)


def _drawn(axis: Axis) -> picture.MapAxis:
    return picture.MapAxis(name=axis.word, unit=axis.printed_unit, start=axis.start, stop=axis.stop)
