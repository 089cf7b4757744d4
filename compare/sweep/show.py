"""Pictures of maps, for a file and for a report."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties, findfont, get_font

from cointoss.compare.basins import picture
from cointoss.compare.basins.agreement import agreement
from cointoss.compare.basins.fractions import fractions
from cointoss.compare.basins.picture_style import Palette, PictureStyle
from cointoss.compare.metrics.margin import quantity_of
from cointoss.compare.output.plots import axes_or_new, picture_bytes
from cointoss.compare.output.style import GREY
from cointoss.compare.report.map_section import MapSection
from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.describe import AWAY, percent
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.maps import after_of, axes_of, name_of, outcomes_in, title_of, untrusted_in
from cointoss.models.answers import NOT_TOSSED
from cointoss.models.palette import COLORS


def png_of(made: Sequence[xr.Dataset], style: PictureStyle) -> bytes:
    """Draw one map, or those of both engines and where they differ, with the numbers of their agreement.

    Args:
        made: the map, beside which its margins are drawn, or two, the first by the analytic engine. Pixels of
            the first that are not trusted are hatched.
        style: how to draw.

    Returns:
        The content of a PNG file.
    """
    first, maps = made[0], [outcomes_in(each) for each in made]
    untrusted, (y, x) = untrusted_in(first), map(_drawn, axes_of(first))
    if len(maps) > 1:
        measured = agreement(*maps, distance=AWAY)
        note = f"agree: {percent(measured.away)} away from boundaries,\n{percent(measured.near)} near them"
        figure = picture.draw_comparison(*maps, x=x, y=y, style=style, note=note, untrusted=untrusted)
    else:
        beside = _margins(first) if "margin" in first else None
        figure = picture.draw_map(maps[0], x=x, y=y, style=style, margins=beside, untrusted=untrusted)
    figure.suptitle(_title(first), parse_math=False)
    return picture_bytes(figure, dpi=style.dpi)


def section(made: Sequence[xr.Dataset], style: PictureStyle, command: str) -> MapSection:
    """Return what a report shows of the maps of both engines.

    Args:
        made: the maps, the first by the analytic engine.
        style: how to draw.
        command: that makes the maps.
    """
    engines, maps = [each.attrs["engine"] for each in made], [outcomes_in(each) for each in made]
    untrusted, (y, x) = untrusted_in(made[0]), axes_of(made[0])
    shares = [{str(one): share for one, share in fractions(codes).items()} for codes in maps]
    settings = [json.loads(each.attrs["engine_settings"]) for each in made]
    return MapSection(
        picture=png_of(made, style),
        numbers={
            "axes": {"x": asdict(x), "y": asdict(y)},
            "after": after_of(made[0]),
            "fractions": dict(zip(engines, shares, strict=True)),
            "agreement": {"distance": AWAY, **asdict(agreement(*maps, distance=AWAY))},
            "untrusted": None if untrusted is None else float(untrusted.mean()),
            "settings": dict(zip(engines, settings, strict=True)),
            "command": command,
        },
    )


def _title(made: xr.Dataset) -> str:
    """Return the title of a map, with what its font has; a file's name may hold anything."""
    glyphs = get_font(findfont(FontProperties())).get_charmap()
    after = after_of(made)
    shown = "" if after is None else f": face at touch {after + 1}"
    return "".join(char if ord(char) in glyphs else "?" for char in title_of(made) + shown)


def plot_map(made: xr.Dataset, ax: Axes | None, layer: str, palette: str, *, boundaries: bool) -> Axes:
    """Draw a map into axes; see `cointoss.compare.accessor.Tosses.plot`.

    Raises:
        SweepError: for a map that is not finished, and for a layer that it has not.
    """
    codes = outcomes_in(made)
    if missing := np.count_nonzero(codes == NOT_TOSSED):
        raise SweepError(
            f"{name_of(made)}: {missing} of {codes.size} pixels are not tossed; "
            "accepted: a whole map (cointoss basin --resume continues one)"
        )
    drawn = [name for name in ("outcome", "margin") if name in made]
    for name, value, accepted in (("layer", layer, drawn), ("palette", palette, list(Palette))):
        if value not in accepted:
            raise SweepError(f"{name}: {value!r}, accepted: {', '.join(accepted)}")
    axes, (y, x) = axes_or_new(ax), map(_drawn, axes_of(made))
    if layer == "outcome":
        style = PictureStyle(palette=Palette(palette), boundaries=boundaries)
        patches = picture.draw_panel(axes, codes, x=x, y=y, style=style, untrusted=untrusted_in(made))
    else:
        patches = picture.draw_margin_panel(axes, _margins(made), x=x, y=y)
    if patches:
        axes.legend(handles=patches, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3, frameon=False)
    axes.set_title(_title(made), parse_math=False)
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


def _margins(made: xr.Dataset) -> picture.MapMargins:
    quantity = quantity_of(made.attrs["margin_along"])
    return picture.MapMargins(made["margin"].values, quantity.name, quantity.unit, most=quantity.factor)
