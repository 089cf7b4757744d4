"""Shares of outcomes drawn over a field, a panel for each value of a second."""

import math
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss.compare.engines import Engine
from cointoss.compare.output.plots import axes_or_new, picture_bytes
from cointoss.compare.output.style import GREY, OUTCOMES, STYLE
from cointoss.compare.shares.show import fields_of, labelled, outcomes_of, over_engines
from cointoss.compare.sweep.axes import word_of
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.reading import parse
from cointoss.models.records import Outcome
from cointoss.models.title import title_of_toss
from cointoss.models.units import printed_unit

MOST_PANELS, IN_A_ROW = 30, 3
OF_THE_HAND = "release.position.z"
"""The field of the scenario's own release that a title leaves out, because the hand releases the coin."""
_LINES: dict[Engine, Any] = {
    Engine.ANALYTIC: {"linestyle": "-", "marker": "o", "markersize": 3.5},
    Engine.MUJOCO: {"linestyle": "--", "marker": "s", "markersize": 4, "markerfacecolor": "none"},
}


def plot_shares(shares: xr.Dataset, ax: Axes | None = None) -> Any:
    """Draw shares with their intervals over the first field, a panel for each value of the second.

    Args:
        shares: of `cointoss.shares`.
        ax: where; by default in a new figure of pyplot. With two fields there are several.

    Returns:
        The axes, or an array of them.

    Raises:
        ValueError: for one Axes where several are due.
    """
    if len(fields_of(shares)) < 2:
        return _whole(axes_or_new(ax), shares)
    if ax is not None:
        raise ValueError("ax: one Axes, accepted: None where two fields vary, which have a panel each")
    from matplotlib import pyplot

    return _panels(pyplot.figure(layout="constrained"), shares)


def picture_of(shares: xr.Dataset, suffix: str) -> bytes:
    """Draw shares as the content of a file of that suffix, as in ".png"; see `require_drawable`."""
    fields = fields_of(shares)
    with rc_context(STYLE):
        figure = Figure(figsize=_size(shares))
        if len(fields) > 1:
            _panels(figure, shares)
        else:
            _whole(figure.subplots(), shares)
        scenario = parse(shares.attrs["scenario"], "attribute scenario")
        title = title_of_toss(scenario, shares.attrs["name"], varied=[*fields, OF_THE_HAND])
        figure.suptitle(title, parse_math=False)
        return picture_bytes(figure, suffix)


def require_drawable(shape: tuple[int, ...]) -> None:
    """Refuse more panels than can be seen.

    Raises:
        SweepError: naming how many are accepted.
    """
    if len(shape) > 1 and shape[1] > MOST_PANELS:
        raise SweepError(f"{shape[1]} values of the second field; accepted: at most {MOST_PANELS}")


def _size(shares: xr.Dataset) -> tuple[float, float]:
    fields = fields_of(shares)
    if len(fields) < 2:
        return 6.0, 3.8
    panels = shares.sizes[fields[1]]
    return 3.2 * min(panels, IN_A_ROW), 2.7 * math.ceil(panels / IN_A_ROW) + 0.8


def _whole(axes: Axes, shares: xr.Dataset) -> Axes:
    """Draw shares over one field, or of none."""
    _draw(axes, shares, outcomes_of(shares))
    axes.legend()
    return axes


def _panels(figure: Figure, shares: xr.Dataset) -> Any:
    """Draw a panel for each value of the second field."""
    second = fields_of(shares)[1]
    values, unit = shares[second].values, printed_unit(shares[second].attrs["units"])
    columns = min(len(values), IN_A_ROW)
    rows = math.ceil(len(values) / columns)
    each = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    for axes in each[len(values) :]:
        axes.remove()
    for i, (axes, value) in enumerate(zip(each, values, strict=False)):
        _draw(axes, shares.isel({second: i}), outcomes_of(shares))
        axes.set_title(f"{word_of(second)} {value:.4g} {unit}".rstrip())
        is_lowest = i + columns >= len(values)
        axes.tick_params(labelbottom=is_lowest)
        axes.set(
            xlabel=axes.get_xlabel() if is_lowest else "", ylabel="" if i % columns else axes.get_ylabel()
        )
    figure.legend(*each[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return each[: len(values)]


def _draw(axes: Axes, shares: xr.Dataset, outcomes: list[str]) -> None:
    """Draw the shares of some outcomes over the field that is left, if any."""
    fields, whole = fields_of(shares), over_engines(shares)
    x = shares[fields[0]].values if fields else np.zeros(1)
    for engine in map(Engine, whole.engine.values.tolist()):
        for outcome in outcomes:
            of_engine = whole.sel(engine=engine.value, outcome=outcome)
            share, low, high = (np.atleast_1d(of_engine[name].values) for name in ("share", "low", "high"))
            code = Outcome(outcome)
            axes.errorbar(
                x,
                share,
                yerr=np.maximum([share - low, high - share], 0.0),
                color=GREY if code == Outcome.UNDECIDED else OUTCOMES[code],
                capsize=2,
                elinewidth=0.9,
                label=outcome if whole.sizes["engine"] == 1 else f"{outcome}, {engine}",
                **_LINES[engine],
            )
    axes.set(ylabel="share of the tosses", ylim=(-0.02, None))
    if fields:
        axes.set_xlabel(labelled(shares, fields[0]))
    else:
        axes.set_xticks([])
