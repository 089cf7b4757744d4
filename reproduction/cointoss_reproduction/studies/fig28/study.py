"""Fig. 28: the two kinds of impacts that change the coin's face, distinguished by rule and counted."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss import ContactLaw, Scenario, analytic
from cointoss.coin_mj import impacts_of
from cointoss.study import HEADS, INK, TAILS, Array, run, state_at_release
from cointoss_reproduction.frame.cells import Cells, Rows, column
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import ratio_of_medians
from cointoss_reproduction.setups.face_changes import changes, share_after_row
from cointoss_reproduction.setups.fig24_readings import READINGS, Reading, clustering

SEED = 28
BINS = np.geomspace(1e-3, 1e2, 26)
"""Ends of the classes that are drawn [mN s, µN m s]; what is less is in the first."""
SPREAD = 0.02
"""Part by which height and spin of the tosses differ from those of Fig. 24(a)."""
KINDS = {
    "after a row": "(a) after a row of soft impacts",
    "after one": "(b) after a single impact",
}
"""The kinds of changes, and their titles."""
EARLIER = {"after a row": 3, "after one": 1}
"""Impacts before the last one from which a change is drawn."""
CLEAR = {"after a row": 0.0, "after one": 0.5}
"""Least |cos| of the tilt at the touches before and after the change that is drawn."""
SEEN = 0.05
"""The shortest time drawn [s]."""
BEFORE = 0.01
"""How long before their first impact the drawn paths begin, and how long after their last they end [s]."""
STROBES = 28
"""How many positions of a path are drawn."""


def count_changes(reading: Reading, count: int = 1000) -> Iterator[Rows]:
    """Toss coins like that of Fig. 24(a), and sort their changes of face.

    Yields:
        Of the last impacts before a change the share after a row, and of their impulse and the angular
        momentum that it gives the median after a row over that after one; then how many there are in each
        of `BINS`. Nothing for a reading whose impacts do not cluster as printed.
    """
    if reading not in clustering():
        return
    number = clustering().index(reading)
    spreads = _spreads((number + 1) * count)[-count:]
    tossed = [_changes(_scenario(reading, each)) for each in spreads]
    row, one = (np.concatenate(kind) for kind in zip(*tossed, strict=True))
    rng = np.random.default_rng([SEED, number])
    yield {
        "share": share_after_row(np.array([[len(kind) for kind in both] for both in tossed])),
        "impulse": ratio_of_medians(row[:, 0], one[:, 0], rng, "changes"),
        "momentum": ratio_of_medians(row[:, 1], one[:, 1], rng, "changes"),
    }
    for kind, given in zip(KINDS, (row, one), strict=True):
        for quantity, values in (("S", 1e3 * given[:, 0]), ("L", 1e6 * given[:, 1])):
            counted, ends = np.histogram(values.clip(BINS[0], BINS[-1]), BINS)
            sizes = {f"size_{quantity}": ends[:-1], f"changes_{quantity}": counted}
            yield pd.DataFrame({"kind": kind, **sizes}).loc[counted > 0]


def toss_by_mujoco(count: int = 1000, count_mujoco: int = 60) -> dict[str, str]:
    """Return how many changes follow a row in tosses by MuJoCo, in words."""
    # MuJoCo realises the law "coulomb" alone of those that cluster so.
    reading = next(one for one in clustering() if one.law == ContactLaw.COULOMB)
    spreads = _spreads(len(clustering()) * count + count_mujoco)[-count_mujoco:]
    tossed = [changes(impacts_of(_scenario(reading, each)).face) for each in spreads]
    row, one = (sum(map(len, kind)) for kind in zip(*tossed, strict=True))
    return {"mujoco": f"{row} of {row + one} in {count_mujoco} tosses ({reading.name})"}


def show() -> Iterator[dict[str, Any]]:
    """Yield the shortest paths to a change of each kind that can be seen, of tosses near Fig. 24's."""
    # Of the paper's own coin, where it is among them.
    reading = max(clustering(), key=lambda one: "imperfect" in one.name)
    shown: dict[str, tuple[float, list[dict[str, Any]]]] = {}
    for height in np.linspace(0.39, 0.41, 21):
        toss = analytic.toss(reading.scenario.replace("release.position.z", float(height)))
        for kind, numbers in zip(KINDS, changes(toss.impacts.face), strict=True):
            for change in numbers.tolist():
                times = toss.impacts.time[max(change - EARLIER[kind], 0) : change + 2]
                lasts = float(times[-1] - times[0])
                e = toss.impacts.quaternion[change : change + 2]
                steep = np.abs(1 - 2 * (e[:, 1] ** 2 + e[:, 2] ** 2)).min() < CLEAR[kind]
                if SEEN < lasts < shown.get(kind, (np.inf,))[0] and not steep:
                    t = np.linspace(times[0] - BEFORE, times[-1] + BEFORE, STROBES)
                    states = toss.sample(t)
                    path = zip(t, states.position[:, 2], *states.normal[:, [0, 2]].T, strict=True)
                    rows = [{"time": t, "height": z, "n_x": x, "n_z": n} for t, z, x, n in path]
                    shown[kind] = lasts, [*rows, *({"touch": time} for time in times)]
    for kind, (_, rows) in shown.items():
        yield from ({"shown": kind, **row} for row in rows)


def _spreads(count: int) -> Array:
    """Return by which parts the height and the spins of some tosses differ, (count, 4)."""
    return np.random.default_rng(SEED).uniform(-SPREAD, SPREAD, (count, 4))


def _scenario(reading: Reading, spread: Array) -> Scenario:
    height, *spins = spread
    w = (40 * spins[0], 40.15 * (1 + spins[1]), 40 * spins[2])
    return reading.scenario.replace(
        "release.position", (0.0, 0.0, 0.4 * (1 + height)), "release.angular_velocity", w
    )


def _changes(scenario: Scenario) -> tuple[Array, Array]:
    """Return the last impacts before the changes of one toss, by kind.

    Returns:
        Their impulse [N s] and the angular momentum that it gives [kg m²/s], (n, 2), after a row of impacts
        and after a single one.
    """
    rows = run(scenario.body, scenario.rules, state_at_release(scenario.release)).rows
    turned = (rows["angular_velocity_after"] - rows["angular_velocity_before"]) @ np.array(
        scenario.body.inertia
    )
    given = np.column_stack([np.linalg.norm(rows["impulse"], axis=1), np.linalg.norm(turned, axis=1)])
    row, one = changes(rows["face"])
    return given[row], given[one]


def _found(cells: pd.DataFrame) -> dict[str, Any]:
    return {
        "mujoco": column(cells, "mujoco").item(),
        "readings": len(column(cells, "momentum count")),
        "holding": int(np.sum(column(cells, "momentum high") < 1)),
        "failing": int(np.sum(column(cells, "momentum low") > 1)),
    }


def _draw(cells: pd.DataFrame) -> Figure:
    picture = Figure(figsize=(10, 3.4))
    for axes, (kind, title) in zip(picture.subplots(1, 2), KINDS.items(), strict=True):
        shown = cells.query(f"shown == '{kind}'")
        if not shown.empty:
            _draw_path(axes, shown)
        axes.set(title=title, xlabel="time [ms]", ylabel="height [mm]")
    return picture


def _draw_path(axes: Axes, rows: pd.DataFrame) -> None:
    """Draw a coin edge on at successive times, its heads gold and its tails blue."""
    path = rows.dropna(subset=["time"])
    n_x, n_z = path["n_x"].to_numpy(), path["n_z"].to_numpy()
    begin, z, r = path["time"].min(), 1e3 * path["height"].to_numpy(), 12.5
    t = 1e3 * (path["time"].to_numpy() - begin)
    # A millimetre is as long as a millisecond times this, so that the coin keeps its shape.
    stretch = (t[-1] - t[0]) / (4 * r * 2)
    for side, color in ((0.4, HEADS), (-0.4, TAILS)):
        x = t + stretch * (side * n_x + r * n_z * np.array([[-1], [1]]))
        axes.plot(x, z + side * n_z - r * n_x * np.array([[-1], [1]]), color=color, linewidth=1)
    axes.axhline(0, color=INK, linewidth=1)
    touches = 1e3 * (rows["touch"].dropna() - begin)
    axes.plot(touches, 0 * touches, "^", color=INK, markersize=5)


REPRODUCTION = study(
    __name__,
    Cells(count_changes, {"reading": {one.name: one for one in READINGS}}),
    Cells(toss_by_mujoco, {}),
    Cells(show, {}),
    found=_found,
    draw={"figure": _draw},
)
