"""Fig. 28: the two kinds of impacts that change the coin's face, distinguished by rule and counted."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import ContactLaw, Scenario, Toss, analytic
from cointoss.coin_mj import impacts_of
from cointoss.study import (
    BLUE,
    GREY,
    HEADS,
    INK,
    TAILS,
    VERMILION,
    Array,
    Estimate,
    Progress,
    ratio_of_medians,
    run,
    state_at_release,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.face_changes import changes, share_after_row
from cointoss_reproduction.setups.fig24_readings import (
    READINGS,
    Reading,
    clusters_as_printed,
    printed_heights,
    sequences,
)

SEED = 28
LEAST = 1e-3
"""The least value that is drawn [mN s, µN m s]."""
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
"""The paths drawn begin so long before their first impact and end so long after their last [s]."""
STROBES = 28
"""Positions drawn of a path."""


def make(progress: Progress, count: int = 1000, count_mujoco: int = 60) -> Findings:
    """Toss coins like that of Fig. 24(a) by both engines, and sort their changes of face.

    The analytic engine makes `count` tosses of each reading of Fig. 24 whose impacts cluster as printed.
    """
    readings = [one for one in READINGS if clusters_as_printed(sequences(one.scenario, printed_heights()))]
    rng = np.random.default_rng(SEED)
    found: dict[str, Changes] = {}
    whole = len(readings) * count + count_mujoco
    for reading in readings:
        tossed = []
        for _ in range(count):
            tossed.append(_changes(_scenario(reading, rng)))
            progress(len(found) * count + len(tossed), whole)
        found[reading.name] = Changes.of(tossed)
    # MuJoCo realises the law "coulomb" alone of those that cluster so.
    scenario = next(one for one in readings if one.law == ContactLaw.COULOMB)
    by_mujoco = [0, 0]
    for done in range(1, count_mujoco + 1):
        kinds = changes(impacts_of(_scenario(scenario, rng)).face)
        by_mujoco = [n + len(kind) for n, kind in zip(by_mujoco, kinds, strict=True)]
        progress(whole - count_mujoco + done, whole)
    mujoco = f"{by_mujoco[0]} of {sum(by_mujoco)} in {count_mujoco} tosses ({scenario.name})"
    return _findings(found, mujoco)


@dataclass(frozen=True)
class Changes:
    """The changes of face of many tosses of one reading."""

    counts: NDArray[np.int64]
    """Of each toss, after a row of impacts and after a single one, (tosses, 2)."""
    row: Array
    """Of the last impact before each change after a row: its impulse [N s] and the angular momentum that it
    gives [kg m²/s], (n, 2)."""
    one: Array
    """The same after a single impact."""

    @classmethod
    def of(cls, tossed: Sequence[tuple[Array, Array]]) -> Self:
        """Join the changes of many tosses."""
        rows, ones = zip(*tossed, strict=True)
        counts = np.array([[len(row), len(one)] for row, one in tossed])
        return cls(counts, np.concatenate(rows), np.concatenate(ones))


def _changes(scenario: Scenario) -> tuple[Array, Array]:
    """Return the last impacts before the changes of one toss as `Changes` has them, by kind."""
    rows = run(scenario.body, scenario.rules, state_at_release(scenario.release)).rows
    turned = (rows["angular_velocity_after"] - rows["angular_velocity_before"]) @ np.array(
        scenario.body.inertia
    )
    given = np.column_stack([np.linalg.norm(rows["impulse"], axis=1), np.linalg.norm(turned, axis=1)])
    row, one = changes(rows["face"])
    return given[row], given[one]


def _findings(found: dict[str, Changes], mujoco: str) -> Findings:
    rng = np.random.default_rng(SEED)
    impulse, momentum = (
        {name: ratio_of_medians(one.row[:, i], one.one[:, i], rng, "changes") for name, one in found.items()}
        for i in (0, 1)
    )
    shares = {name: share_after_row(one.counts) for name, one in found.items()}
    return Findings(
        data=_data(found, shares),
        mujoco=mujoco,
        shares=shares,
        impulse=impulse,
        momentum=momentum,
        readings=len(found),
        holding=sum(one.high < 1 for one in momentum.values()),
        failing=sum(one.low > 1 for one in momentum.values()),
    )


def _data(found: dict[str, Changes], share_of: dict[str, Estimate]) -> Data:
    data: Data = {
        "names": np.array(list(found)),
        "shares": np.array([each.ends for each in share_of.values()]),
        "after a row": np.concatenate([each.row for each in found.values()]),
        "after one": np.concatenate([each.one for each in found.values()]),
    }
    # The paper's own coin, where it is among them.
    shown = next(one for one in READINGS if one.name == max(found, key=lambda name: "imperfect" in name))
    return data | _paths(shown)


def _paths(reading: Reading) -> Data:
    """Return the shortest paths to a change of each kind that can be seen, of tosses near Fig. 24's."""
    data: Data = {}
    shortest = dict.fromkeys(KINDS, np.inf)
    for height in np.linspace(0.39, 0.41, 21):
        toss = analytic.toss(reading.scenario.replace("release.position.z", float(height)))
        for kind, numbers in zip(KINDS, changes(toss.impacts.face), strict=True):
            for change in numbers.tolist():
                times = toss.impacts.time[max(change - EARLIER[kind], 0) : change + 2]
                lasts = float(times[-1] - times[0])
                e = toss.impacts.quaternion[change : change + 2]
                steep = np.abs(1 - 2 * (e[:, 1] ** 2 + e[:, 2] ** 2)).min() < CLEAR[kind]
                if SEEN < lasts < shortest[kind] and not steep:
                    shortest[kind] = lasts
                    data |= {f"{kind}, {name}": values for name, values in _path(toss, times).items()}
    return data


def _path(toss: Toss, times: Array) -> dict[str, Array]:
    """Return the path of a coin about some of its impacts, at equal times."""
    t = np.linspace(times[0] - BEFORE, times[-1] + BEFORE, STROBES)
    states = toss.sample(t)
    return {"time": t, "height": states.position[:, 2], "normal": states.normal, "impacts": times}


def _scenario(reading: Reading, rng: np.random.Generator) -> Scenario:
    height, *spins = rng.uniform(-SPREAD, SPREAD, 4)
    w = (40 * spins[0], 40.15 * (1 + spins[1]), 40 * spins[2])
    return reading.scenario.replace(
        "release.position", (0.0, 0.0, 0.4 * (1 + height)), "release.angular_velocity", w
    )


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(10, 7))
    grid = picture.add_gridspec(2, 6, height_ratios=(1, 1.1))
    for column, (kind, title) in enumerate(KINDS.items()):
        axes = picture.add_subplot(grid[0, 3 * column : 3 * column + 3])
        if f"{kind}, time" in data:
            _draw_path(
                axes, {name: data[f"{kind}, {name}"] for name in ("time", "height", "normal", "impacts")}
            )
        axes.set(title=title, xlabel="time [ms]", ylabel="height [mm]")
    shares = picture.add_subplot(grid[1, :2])
    value, low, high = data["shares"].T
    at = np.arange(len(value))
    shares.barh(at, value, color=BLUE)
    shares.errorbar(value, at, xerr=[value - low, high - value], fmt="none", ecolor=INK, capsize=2)
    shares.axvline(0.5, color=GREY, linewidth=0.8)
    shares.set_yticks(at, data["names"].tolist(), fontsize=8)
    shares.invert_yaxis()
    shares.set(title="changes after a row", xlabel="share of all changes", xlim=(0, 1), axisbelow=True)
    columns = ((2, 1e3, "impulse [mN s]"), (4, 1e6, "angular momentum [µN m s]"))
    for number, (left, unit, label) in enumerate(columns):
        axes = picture.add_subplot(grid[1, left : left + 2])
        given = {kind: unit * data[kind][:, number] for kind in KINDS}
        bins = np.geomspace(LEAST, max(values.max() for values in given.values()), 40).tolist()
        for (kind, values), color in zip(given.items(), (BLUE, VERMILION), strict=True):
            weights = np.full(len(values), 1 / len(values))
            shown = np.maximum(values, LEAST)
            axes.hist(shown, bins, weights=weights, histtype="step", color=color, label=kind)
        axes.set_xscale("log")
        axes.set(title="last impact before a change", xlabel=label, ylabel="share of the changes")
        axes.legend(loc="upper left", fontsize=8)
    return picture


def _draw_path(axes: Axes, path: dict[str, Array]) -> None:
    """Draw a coin edge on at successive times, its heads gold and its tails blue."""
    t, z = 1e3 * (path["time"] - path["time"][0]), 1e3 * path["height"]
    n_x, n_z = path["normal"][:, 0], path["normal"][:, 2]
    r = 12.5
    # A millimetre is as long as a millisecond times this, so that the coin keeps its shape.
    stretch = (t[-1] - t[0]) / (4 * r * 2)
    for side, color in ((0.4, HEADS), (-0.4, TAILS)):
        x = t + stretch * (side * n_x + r * n_z * np.array([[-1], [1]]))
        axes.plot(x, z + side * n_z - r * n_x * np.array([[-1], [1]]), color=color, linewidth=1)
    axes.axhline(0, color=INK, linewidth=1)
    axes.plot(1e3 * (path["impacts"] - path["time"][0]), 0 * path["impacts"], "^", color=INK, markersize=5)


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
