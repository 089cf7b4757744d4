"""The restitution between two geoms over their speed, as a picture and a table."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from cointoss.coin_mj.bounces.pair import PairBounce
from cointoss.compare.output.style import BLUE, STYLE, VERMILION
from cointoss.models.records import Array


def draw_bounce(found: PairBounce) -> Figure:
    """Draw the restitution over the speed: the range over the phases of a step, and its mean."""
    with rc_context(STYLE):
        picture = Figure(figsize=(6, 3.6))
        axes = picture.subplots()
        for values, label, color in (
            (found.restitutions, "without gravity", BLUE),
            (found.with_gravity, "with the model's gravity", VERMILION),
        ):
            seen = ~np.isnan(values).all(axis=1)
            speeds, shown = found.speeds[seen], values[seen]
            axes.fill_between(
                speeds, np.nanmin(shown, axis=1), np.nanmax(shown, axis=1), color=color, alpha=0.25
            )
            axes.plot(speeds, np.nanmean(shown, axis=1), "o-", color=color, label=label)
        axes.set(xscale="log", xlabel="speed [m/s]", ylabel="restitution")
        axes.set_title(f"{found.geoms[0]} on {found.geoms[1]}, {found.integrator}, {found.timestep:g} s")
        axes.legend()
        return picture


def bounce_table(found: PairBounce) -> str:
    """Return the restitution at each speed, line by line."""
    head = f"{'speed [m/s]':>11}  {'restitution':23}  {'with gravity':23}  lasts [ms]  depth [mm]"
    lines = [
        f"{speed:11g}  {_range(free):23}  {_range(pulled):23}  {_mean(1e3 * lasts):>10}  {1e3 * depth:10.3g}"
        for speed, free, pulled, lasts, depth in zip(
            found.speeds, found.restitutions, found.with_gravity, found.durations, found.depths, strict=True
        )
    ]
    return "\n".join([head, *lines])


def _range(values: Array) -> str:
    """Return the mean and the range over the phases of a step, or how many have no answer."""
    lost = int(np.isnan(values).sum())
    if lost:
        return f"{lost} of {len(values)} went through"
    return f"{values.mean():.4f} [{values.min():.4f}, {values.max():.4f}]"


def _mean(values: Array) -> str:
    return "-" if np.isnan(values).any() else f"{values.mean():.3g}"
