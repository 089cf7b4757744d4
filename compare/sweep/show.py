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


def png_of(made: Sequence[TossedMap], style: PictureStyle) -> bytes:
    """Draw one map, or those of both engines and where they differ, with the numbers of their agreement.

    Args:
        made: the map, beside which its margins are drawn, or two, the first by the analytic engine. Pixels of
            the first that are not trusted are hatched.
        style: how to draw.

    Returns:
        The content of a PNG file.
    """
    first, maps = made[0], [each.outcome for each in made]
    sweep, untrusted = first.sweep, first.untrusted
    x, y = _drawn(sweep.x), _drawn(sweep.y)
    if len(maps) > 1:
        measured = measure(*maps)
        note = f"agree: {percent(measured.away)} away from boundaries,\n{percent(measured.near)} near them"
        figure = picture.draw_comparison(*maps, x=x, y=y, style=style, note=note, untrusted=untrusted)
    else:
        beside = None if sweep.margin is None else _margins(first.layers["margin"], sweep)
        figure = picture.draw_map(first.outcome, x=x, y=y, style=style, margins=beside, untrusted=untrusted)
    figure.suptitle(_title(sweep), parse_math=False)
    return picture_bytes(figure, dpi=style.dpi)


def section(made: Sequence[TossedMap], style: PictureStyle, command: str) -> MapSection:
    """Return what a report shows of the maps of both engines.

    Args:
        made: the maps, the first by the analytic engine.
        style: how to draw.
        command: that makes the maps.
    """
    sweep, untrusted = made[0].sweep, made[0].untrusted
    return MapSection(
        picture=png_of(made, style),
        numbers={
            "axes": {"x": asdict(sweep.x), "y": asdict(sweep.y)},
            "after": sweep.after,
            "fractions": {
                each.sweep.engine.value: {
                    str(outcome): share for outcome, share in fractions(each.outcome).items()
                }
                for each in made
            },
            "agreement": {"distance": AWAY, **asdict(measure(*(each.outcome for each in made)))},
            "untrusted": None if untrusted is None else float(untrusted.mean()),
            "settings": {each.sweep.engine.value: each.sweep.settings.as_dict() for each in made},
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
