"""The restitution between two geoms over their speed, as a picture."""

import numpy as np
from matplotlib.figure import Figure

from cointoss_bounce.pair import PairBounce

BLUE, VERMILION = "#0072B2", "#D55E00"
"""Okabe and Ito's colours, which the colour-blind can distinguish."""


def draw_bounce(found: PairBounce) -> Figure:
    """Draw the restitution over the speed: the range over the phases of a step, and its mean."""
    picture = Figure(figsize=(6, 3.6), layout="constrained")
    axes = picture.subplots()
    for values, label, color in (
        (found.restitutions, "without gravity", BLUE),
        (found.with_gravity, "with the model's gravity", VERMILION),
    ):
        seen = ~np.isnan(values).all(axis=1)
        speeds, shown = found.speeds[seen], values[seen]
        axes.fill_between(speeds, np.nanmin(shown, axis=1), np.nanmax(shown, axis=1), color=color, alpha=0.25)
        axes.plot(speeds, np.nanmean(shown, axis=1), "o-", color=color, label=label)
    axes.set(xscale="log", xlabel="speed [m/s]", ylabel="restitution")
    axes.set_title(f"{found.geoms[0]} on {found.geoms[1]}, {found.integrator}, {found.timestep:g} s")
    axes.grid(color="#d9dee5")
    axes.legend(frameon=False)
    return picture
