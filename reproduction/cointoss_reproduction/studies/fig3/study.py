"""Fig. 3: coins dropped from 186 cm flat and at 45 degrees keep their attitude, if they are ideal."""

import numpy as np
from matplotlib.figure import Figure

from cointoss import analytic, coin_mj, load
from cointoss.study import BLUE, ORANGE, SKY, VERMILION, Progress, attitude_angle
from cointoss_reproduction.frame.declared import Data, Findings, declared

DROPS = {
    "ideal, flat": "fig3_flat",
    "ideal, at 45°": "fig3_tilted",
    "imperfect, flat": "fig3_flat_imperfect",
    "imperfect, at 45°": "fig3_tilted_imperfect",
}
UNKNOWN = {"missing": "the paper does not say where the mass centre of the dropped coin is", "expected": None}
"""Of an imperfect coin."""


def make(progress: Progress) -> Findings:
    """Drop the ideal and the imperfect coin by both engines until they touch the floor."""
    data: Data = {}
    found = Findings(data=data, drops={})
    for done, (name, scenario) in enumerate(DROPS.items(), start=1):
        tosses = [engine(load(scenario)) for engine in (analytic.toss, coin_mj.toss)]
        t = np.linspace(0, min(toss.impacts.time[0] for toss in tosses), 200)
        turned = [np.degrees(attitude_angle(toss.sample(t), toss.sample(0 * t))) for toss in tosses]
        data |= {f"{name}, time": t, f"{name}, analytic": turned[0], f"{name}, MuJoCo": turned[1]}
        known = {"missing": "", "expected": True} if name.startswith("ideal") else UNKNOWN
        found.drops[name] = {"turned": turned, "most": np.max(turned), "time": t, **known}
        progress(done, len(DROPS))
    return found


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(7, 3.4))
    axes = picture.subplots()
    for name, color in zip(DROPS, (BLUE, SKY, VERMILION, ORANGE), strict=True):
        t = data[f"{name}, time"]
        axes.plot(t, data[f"{name}, analytic"], color=color, label=name)
        axes.plot(t[::10], data[f"{name}, MuJoCo"][::10], "o", color=color, markersize=3)
    axes.set(xlabel="time [s]", ylabel="turned from the release [°]")
    axes.legend(title="lines: analytic; dots: MuJoCo")
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
