"""Pictures of maps, for a file and for a report."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties, findfont, get_font
from numpy.typing import NDArray

from cointoss.compare.basins import picture
from cointoss.compare.basins.fractions import fractions
from cointoss.compare.basins.picture_style import Palette, PictureStyle
from cointoss.compare.output.plots import axes_or_new, picture_bytes
from cointoss.compare.output.style import GREY
from cointoss.compare.report.map_section import MapSection
from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.describe import AWAY, measure, percent
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import Sweep
from cointoss.compare.sweep.layers import NOT_TOSSED
from cointoss.compare.sweep.tossed_map import TossedMap
from cointoss.models.palette import COLORS
from cointoss.models.records import Array


def png_of(
    maps: list[NDArray[np.int8]],
    sweep: Sweep,
    style: PictureStyle,
    *,
    margins: Array | None = None,
    untrusted: NDArray[np.bool_] | None = None,
) -> bytes:
    """Draw one map, or those of both engines and where they differ, with the numbers of their agreement.

    Args:
        maps: (y, x) each, the first by the analytic engine if there are two.
        sweep: what the first was made of.
        style: how to draw.
        margins: of the first map, (y, x), to be drawn beside it.
        untrusted: the pixels of the first map, (y, x), that are hatched.

    Returns:
        The content of a PNG file.
    """
    x, y = _drawn(sweep.x), _drawn(sweep.y)
    if len(maps) > 1:
        measured = measure(*maps)
        note = f"agree: {percent(measured.away)} away from boundaries,\n{percent(measured.near)} near them"
        figure = picture.draw_comparison(*maps, x=x, y=y, style=style, note=note, untrusted=untrusted)
    else:
        beside = None if margins is None else _margins(margins, sweep)
        figure = picture.draw_map(maps[0], x=x, y=y, style=style, margins=beside, untrusted=untrusted)
    figure.suptitle(_title(sweep), parse_math=False)
    return picture_bytes(figure, dpi=style.dpi)


def section(
    maps: list[NDArray[np.int8]],
    sweeps: Sequence[Sweep],
    style: PictureStyle,
    command: str,
    *,
    untrusted: NDArray[np.bool_] | None = None,
) -> MapSection:
    """Return what a report shows of the maps of both engines.

    Args:
        maps: (y, x) each, the first by the analytic engine.
        sweeps: what each was made of.
        style: how to draw.
        command: that makes the maps.
        untrusted: the pixels of the first map, (y, x), that are hatched.
    """
    sweep = sweeps[0]
    shares = {
        sweep.engine.value: {str(outcome): share for outcome, share in fractions(outcomes).items()}
        for sweep, outcomes in zip(sweeps, maps, strict=True)
    }
    return MapSection(
        picture=png_of(maps, sweep, style, untrusted=untrusted),
        numbers={
            "axes": {"x": asdict(sweep.x), "y": asdict(sweep.y)},
            "after": sweep.after,
            "fractions": shares,
            "agreement": {"distance": AWAY, **asdict(measure(*maps))},
            "untrusted": None if untrusted is None else float(untrusted.mean()),
            "settings": {sweep.engine.value: sweep.settings.as_dict() for sweep in sweeps},
            "command": command,
        },
    )


def _title(sweep: Sweep) -> str:
    """Return the title of a map, with what its font has; a file's name may hold anything."""
    glyphs = get_font(findfont(FontProperties())).get_charmap()
    shown = "" if sweep.after is None else f": face at touch {sweep.after + 1}"
    return "".join(char if ord(char) in glyphs else "?" for char in sweep.title + shown)


def plot_map(made: TossedMap, ax: Axes | None, layer: str, palette: str, *, boundaries: bool) -> Axes:
    """Draw a map into axes; see `cointoss.compare.sweep.accessor.Tosses.plot`.

    Raises:
        SweepError: for a map that is not finished, and for a layer that it has not.
    """
    missing = np.count_nonzero(made.outcome == NOT_TOSSED)
    if missing:
        raise SweepError(
            f"{made.name}: {missing} of {made.outcome.size} pixels are not tossed; "
            "accepted: a whole map (cointoss basin --resume continues one)"
        )
    drawn = {name: made.layers[name] for name in ("outcome", "margin") if name in made.layers}
    for name, value, accepted in (("layer", layer, drawn), ("palette", palette, list(Palette))):
        if value not in accepted:
            raise SweepError(f"{name}: {value!r}, accepted: {', '.join(accepted)}")
    axes = axes_or_new(ax)
    style = PictureStyle(palette=Palette(palette), boundaries=boundaries)
    x, y = _drawn(made.sweep.x), _drawn(made.sweep.y)
    if layer == "outcome":
        patches = picture.draw_panel(axes, made.outcome, x=x, y=y, style=style, untrusted=made.untrusted)
    else:
        patches = picture.draw_margin_panel(axes, _margins(drawn[layer], made.sweep), x=x, y=y)
    if patches:
        axes.legend(handles=patches, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3, frameon=False)
    axes.set_title(_title(made.sweep), parse_math=False)
    return axes


def plot_counts(counts: Mapping[str, int], ax: Axes | None) -> Axes:
    """Draw how many tosses had each outcome, as bars."""
    axes = axes_or_new(ax)
    bars = axes.bar(list(counts), list(counts.values()), color=[COLORS.get(name, GREY) for name in counts])
    axes.bar_label(bars)
    axes.set(xlabel="outcome", ylabel="tosses")
    return axes


def _drawn(axis: Axis) -> picture.MapAxis:
    return picture.MapAxis(name=axis.word, unit=axis.printed_unit, start=axis.start, stop=axis.stop)


def _margins(changes: NDArray[Any], sweep: Sweep) -> picture.MapMargins:
    return picture.MapMargins(changes, sweep.quantity.name, sweep.quantity.unit, most=sweep.quantity.factor)
