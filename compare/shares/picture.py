"""Shares of outcomes drawn over a field, a panel for each value of a second."""

import io
import math
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss.compare.engines import Engine
from cointoss.compare.output.plots import axes_or_new
from cointoss.compare.output.style import GREY, OUTCOMES, STYLE
from cointoss.compare.shares.record import Row, Shares
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.records import Outcome
from cointoss.models.title import title_of_toss

MOST_PANELS, IN_A_ROW = 30, 3
DPI = 150
OF_THE_HAND = "release.position.z"
"""What a title tells of a scenario's own release, and is not so of a hand's."""
_LINES: dict[Engine, Any] = {
    Engine.ANALYTIC: {"linestyle": "-", "marker": "o", "markersize": 3.5},
    Engine.MUJOCO: {"linestyle": "--", "marker": "s", "markersize": 4, "markerfacecolor": "none"},
}


def plot_shares(found: Shares, ax: Axes | None = None) -> Any:
    """Draw shares into axes, those of a new figure of pyplot by default; see `Shares.plot`."""
    several = len(found.plan.along) > 1
    if several and ax is not None:
        raise ValueError("ax: one Axes, accepted: None where two fields vary, which have a panel each")
    if not several:
        axes = axes_or_new(ax)
        _draw(axes, found, found.rows)
        axes.legend()
        return axes
    from matplotlib import pyplot

    return _panels(pyplot.figure(layout="constrained"), found)


def picture_of(found: Shares, suffix: str) -> bytes:
    """Draw shares as the content of a file of that suffix, as in ".png".

    Raises:
        ValueError: for more panels than can be seen.
    """
    with rc_context(STYLE):
        figure = Figure(figsize=_size(found))
        if len(found.plan.along) > 1:
            _panels(figure, found)
        else:
            _draw(axes := figure.subplots(), found, found.rows)
            axes.legend()
        varied = [*(axis.field for axis in found.plan.along), OF_THE_HAND]
        title = title_of_toss(found.plan.scenario, found.plan.name, varied=varied)
        figure.suptitle(title, parse_math=False)
        drawn = io.BytesIO()
        metadata = {"Date": None} if suffix == ".svg" else None
        figure.savefig(drawn, format=suffix[1:], dpi=DPI, metadata=metadata)
        return drawn.getvalue()


def require_drawable(shape: tuple[int, ...]) -> None:
    """Refuse more panels than can be seen.

    Raises:
        SweepError: naming how many are accepted.
    """
    if len(shape) > 1 and shape[1] > MOST_PANELS:
        raise SweepError(f"{shape[1]} values of the second field; accepted: at most {MOST_PANELS}")


def _size(found: Shares) -> tuple[float, float]:
    if len(found.plan.along) < 2:
        return 6.0, 3.8
    panels = found.plan.shape[1]
    return 3.2 * min(panels, IN_A_ROW), 2.7 * math.ceil(panels / IN_A_ROW) + 0.8


def _panels(figure: Figure, found: Shares) -> Any:
    """Draw a panel for each value of the second field."""
    second, panels = found.plan.along[1], found.plan.shape[1]
    columns = min(panels, IN_A_ROW)
    grid = figure.subplots(math.ceil(panels / columns), columns, sharex=True, sharey=True, squeeze=False)
    each = grid.ravel()
    for axes in each[panels:]:
        axes.remove()
    for i, (axes, value) in enumerate(zip(each, second.values, strict=False)):
        _draw(axes, found, [row for row in found.rows if row.values[1] == value])
        axes.set_title(f"{second.word} {value:.4g} {second.printed_unit}".rstrip())
        is_lowest = i + columns >= panels
        axes.tick_params(labelbottom=is_lowest)
        axes.set(
            xlabel=axes.get_xlabel() if is_lowest else "", ylabel="" if i % columns else axes.get_ylabel()
        )
    figure.legend(*each[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return each[:panels]


def _draw(axes: Axes, found: Shares, rows: list[Row]) -> None:
    """Draw the shares of some settings over the first field."""
    along = found.plan.along
    engines = found.plan.engines
    for engine in engines:
        of_engine = [row for row in rows if row.engine == engine and row.tosses]
        shares = [row.shares for row in of_engine]
        x = np.array([row.values[0] if row.values else 0.0 for row in of_engine])
        for outcome in found.outcomes:
            ends = np.array([one[outcome].ends for one in shares]).reshape(-1, 3)
            color = GREY if outcome == Outcome.UNDECIDED else OUTCOMES[outcome]
            label = str(outcome) if len(engines) == 1 else f"{outcome}, {engine}"
            axes.errorbar(
                x,
                ends[:, 0],
                yerr=np.maximum([ends[:, 0] - ends[:, 1], ends[:, 2] - ends[:, 0]], 0.0),
                color=color,
                capsize=2,
                elinewidth=0.9,
                label=label,
                **_LINES[engine],
            )
    axes.set(ylabel="share of the tosses", ylim=(-0.02, None))
    if along:
        axes.set_xlabel(f"{along[0].word} [{along[0].printed_unit}]" if along[0].unit else along[0].word)
    else:
        axes.set_xticks([])
