"""What the study of the rotor shows: a rotor that hops, the map of its touches, f and α; and a contact."""

from math import pi

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss import analytic
from cointoss.study import BLUE, GREEN, GREY, INK, ORANGE, PURPLE, VERMILION
from cointoss_reproduction.setups.planar_maps import case
from cointoss_reproduction.studies.rotor.chain import (
    MOMENTUM,
    NORMAL,
    POSITION,
    VELOCITY,
    Coin,
    States,
    above,
    dot,
    fly,
    next_touch,
    spin,
    strike,
)
from cointoss_reproduction.studies.rotor.splitting import coin_of, planar, started

SLIDES = case(air=True, restitution=0.3).replace(
    "release.position.z", 0.3, "release.angular_velocity", (2.0, 36.0, 6.0)
)
"""A coin whose bounces die out while it can still go over its rim."""
COLORS = {0.3: GREEN, 0.6: BLUE, 0.8: ORANGE, 0.9: PURPLE}
"""Restitutions whose curves are drawn."""
SHOWN = Coin(inertia=0.25, half=0.0, restitution=0.6, rough=False, slowing=0.0, drag=0.0)
ROTOR = planar(SHOWN, 1.0, 0.8, 1.06, 10.0)
"""A rotor that has just left the floor."""
TOUCHES = 3
SLOW, SPUN = 1e-3, 2000.0
"""ν and ω of the rotor whose next touch is mapped."""


def draw_contact(_cells: pd.DataFrame) -> Figure:
    """Draw the tilt of a coin that comes into contact above the pass, in its potential and over time."""
    picture, tossed = Figure(figsize=(11, 4)), analytic.toss(SLIDES)
    well, over_time = picture.subplots(1, 2)
    times = np.linspace(0, tossed.end_time, 4000)
    path = tossed.path.sample(times)
    states = started(
        SLIDES, np.hstack([path.position, path.velocity, path.quaternion, path.angular_velocity])
    )
    coin, tilt = coin_of(SLIDES), np.arccos(states[:, NORMAL, 2].real)
    # It is in contact between an odd and an even number of its beginnings and ends.
    held = np.searchsorted(np.ravel(tossed.contacts), times, side="right") % 2 == 1
    first, s = states[held][0], np.linspace(0.02, pi - 0.02, 400)
    across = (first[MOMENTUM, 2] - dot(first, MOMENTUM, NORMAL) * np.cos(s)).real / np.sin(s)
    well.plot(s, np.sin(s) + across**2 / (2 * coin.inertia), color=INK)
    for part, color, name in ((~held, BLUE, "flight"), (held, ORANGE, "contact")):
        energies = [above(coin, state) + 1 for state in states[part]]
        well.plot(tilt[part], energies, ".", color=color, markersize=2, label=name)
        over_time.plot(times[part], tilt[part], ".", color=color, markersize=2)
    well.axhline(1, color=GREY, linestyle="--")
    well.set(title="the line is V(s)", xlabel="tilt s", ylabel="energy [m g r]", ylim=(0, 2.5))
    well.legend(fontsize="small")
    over_time.axhline(pi / 2, color=GREY, linestyle="--")
    over_time.set(title="dashed: the pass", xlabel="time [s]", ylabel="tilt s")
    return picture


def draw(cells: pd.DataFrame) -> Figure:
    """Draw the rotor, the map of its touches, f and α."""
    picture = Figure(figsize=(11, 7.6))
    hopping, mapped, shares, slopes = picture.subplots(2, 2).flat
    draw_rotor(hopping)
    draw_map(mapped)
    draw_shares(shares, cells)
    draw_slopes(slopes, cells)
    return picture


def draw_rotor(axes: Axes) -> None:
    """Draw the heights of a rotor's centre and ends over time, and where it touches."""
    state, now = ROTOR.copy(), 0.0
    for _ in range(TOUCHES):
        length = next_touch(SHOWN, state)
        time = np.linspace(0, length, 400)
        centre = (state[POSITION, 2] + state[VELOCITY, 2] * time - time**2 / 2).real
        turned = np.arctan2(-state[NORMAL, 1].real, state[NORMAL, 2].real)
        turned += state[MOMENTUM, 0].real / SHOWN.inertia * time
        axes.plot(now + time, centre, color=INK, linewidth=1.5)
        for end, color in ((1, BLUE), (-1, VERMILION)):
            axes.plot(now + time, centre + end * np.sin(turned), color=color, linewidth=0.8)
        fly(SHOWN, state, length)
        now += length
        strike(SHOWN, state)
        axes.plot(now, 0.0, "o", color=INK, markersize=5)
    axes.axhline(0, color=GREY)
    axes.axhline(1, color=GREY, linewidth=0.8, linestyle="--")
    axes.set(title="a rotor: its centre hops, its ends turn", xlabel="time [√(r/g)]", ylabel="height [r]")


def touch(state: States) -> float:
    """Return ν' after the next touch of a rotor that falls."""
    fly(SHOWN, state, next_touch(SHOWN, state))
    strike(SHOWN, state)
    return float(state[VELOCITY, 2].real / spin(SHOWN, state))


def draw_map(axes: Axes) -> None:
    """Draw ν' over the depth of the first dip, and what the equations of motion give."""
    share = np.linspace(0.002, 0.998, 60)
    # Upright at the time at which the gap is least, half a turn after a passage that dips by D - π ν.
    angle = pi / 2 + SLOW - pi
    height = 1 - (share - 1) * pi * SLOW - SLOW**2 / 2
    found = [touch(planar(SHOWN, z, -SLOW * SPUN, angle, SPUN)) for z in height]
    axes.plot(share, np.array(found) / SLOW, ".", color=INK, label="equations of motion")
    axes.plot(
        share,
        (1 + SHOWN.restitution) * np.sqrt(2 * pi * share / SLOW) - 1,
        color=BLUE,
        label="(1 + χ) √(2D)/ν - 1",
    )
    axes.axhline(0, color=GREY, linewidth=0.8)
    axes.set(title="the map of a touch", xlabel="depth of the dip D/(π ν)", ylabel="ν'/ν")
    axes.legend(fontsize="small")


def draw_shares(axes: Axes, cells: pd.DataFrame) -> None:
    """Draw f as it is predicted and counted, on a smooth floor in vacuum."""
    for chi, color in COLORS.items():
        rows = cells.query(f"floor == 'smooth, vacuum' and chi == {chi}")
        axes.loglog(rows["accuracy"], rows["predicted"], color=color, label=f"χ = {chi:g}")
        if "counted" in rows:
            axes.loglog(rows["accuracy"], rows["counted"], "o", color=color, markersize=3)
    axes.set(title="f(ε): lines predicted, dots counted", xlabel="accuracy ε [m]", ylim=(1e-14, 2))
    axes.invert_xaxis()
    axes.legend(fontsize="small")


def draw_slopes(axes: Axes, cells: pd.DataFrame) -> None:
    """Draw α by the chain, with its intervals, and by the law of the limit."""
    for chi in cells["far"].dropna().unique().tolist():
        rows, color = cells.query(f"far == {chi}"), COLORS[chi]
        value, low, high = (rows[f"far_alpha{end}"] for end in ("", " low", " high"))
        axes.errorbar(
            rows["decades"], value, [value - low, high - value], fmt="o", color=color, markersize=3, capsize=2
        )
        axes.plot(rows["decades"], rows["law"], color=color, label=f"χ = {chi:g}")
    axes.set(
        title="α: dots the chain, lines the law of its limit",
        xlabel="decades of accuracy, -log10 ε",
        ylim=(0, 1),
    )
    axes.axhline(1, color=GREY, linewidth=0.8)
    axes.legend(fontsize="small")
