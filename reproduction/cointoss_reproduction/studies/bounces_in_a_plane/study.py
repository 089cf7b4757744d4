"""Section 1, after Zeng-Yuan and Bin: a coin that bounces in air in a plane, and what spin in space adds."""

import numpy as np
from matplotlib.figure import Figure

from cointoss import Outcome, analytic
from cointoss.coin_mj import impacts_of
from cointoss.study import (
    BLUE,
    GREY,
    PLACE,
    VERMILION,
    Array,
    Progress,
    run,
    scenario_of_row,
    share,
    states_of,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.planar_maps import (
    HEIGHTS,
    SPINS,
    case,
    faces_after,
    planar_rows,
    toss_rows_by_mujoco,
)

SEED = 71
ASIDE = np.array([0.0, 0.01, 0.1, 1.0, 3.0, 10.0, 20.0])
"""Spins about ζ that are added to that about ξ, first none [rad/s]."""
SHOWN = 5
"""The spin of `ASIDE` whose effect is shown."""
HEIGHTS_OF_DROP = np.array([0.015, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0])
"""From which coins spin with `DROP_SPINS` [m]."""
DROP_SPINS = (2.0, 20.0)
"""[rad/s]"""
FOLLOWED, IMPACTS = 6, 3
"""Tosses whose places are compared with MuJoCo's, and through so many impacts."""
ACCURACY = 1e-6
"""By which the height of nearby tosses differs [m]."""


def make(progress: Progress, count: int = 2000, tosses_mujoco: int = 200) -> Findings:
    """Toss in a plane; add spin about the normal; drop from ever greater heights."""
    found = Findings()
    scenario = case(air=True)
    rng = np.random.default_rng(SEED)
    flat = planar_rows(scenario, rng.uniform(*HEIGHTS, count), rng.uniform(*SPINS, count))
    found.apart, found.mujoco = _in_plane(flat[:FOLLOWED])
    turned = np.tile(flat, (len(ASIDE), 1))
    turned[:, PLACE["release.angular_velocity.zeta"]] = np.repeat(ASIDE, count)
    by_mujoco = toss_rows_by_mujoco(turned[SHOWN * count :][:tosses_mujoco]).outcome
    found.heads_mujoco = np.mean(by_mujoco == Outcome.HEADS)
    progress(1, 3)
    ended, first = analytic.toss_rows(turned).outcome, faces_after(turned, 0)
    ended, first = (faces.reshape(len(ASIDE), count) for faces in (ended, first))
    found.changed = [share(row != ended[0]) for row in ended]
    found.changed_first = np.mean(first != first[0], axis=1)
    found.heads = np.mean(ended == Outcome.HEADS, axis=1)
    progress(2, 3)
    spins = np.tile(rng.uniform(*DROP_SPINS, count), len(HEIGHTS_OF_DROP))
    one, other = (
        analytic.toss_rows(planar_rows(scenario, np.repeat(HEIGHTS_OF_DROP + step, count), spins)).outcome
        for step in (0.0, ACCURACY)
    )
    found.uncertain = [share(row) for row in (one != other).reshape(-1, count)]
    progress(3, 3)
    found.data = {
        "aside": ASIDE,
        "changed": np.array([one.value for one in found.changed]),
        "changed first": found.changed_first,
        "heads": found.heads,
        "height": HEIGHTS_OF_DROP,
        "uncertain": np.array([one.value for one in found.uncertain]),
    }
    return found


def _in_plane(rows: Array) -> tuple[tuple[float, float], str]:
    """Return how far coins come off their plane and, in it, aside [m], and what MuJoCo finds in words."""
    off, aside, off_mujoco, between = [], [], [], []
    for row, state in zip(rows, states_of(rows), strict=True):
        scenario = scenario_of_row(row)
        places = run(scenario.body, scenario.rules, state).rows["position"]
        off.append(np.abs(places[:, 0]).max())
        aside.append(np.abs(places[:, 1]).max())
        found = impacts_of(scenario.replace("ending.max_impacts", IMPACTS)).position
        off_mujoco.append(np.abs(found[:, 0]).max())
        between.append(np.abs(found[: len(places)] - places[: len(found)]).max())
    by_mujoco = (
        f"leaves it by {max(off_mujoco):.0e} m, within {1e3 * np.max(between):.1g} mm of the analytic "
        f"engine over the first {IMPACTS} impacts"
    )
    return (float(max(off)), float(max(aside))), by_mujoco


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 3.3))
    spin, drop = picture.subplots(1, 2)
    spin.plot(data["aside"], data["changed"], "o-", color=VERMILION, label="outcomes changed")
    spin.plot(data["aside"], data["changed first"], "o-", color=BLUE, label="first touches changed")
    spin.plot(data["aside"], data["heads"], "o:", color=GREY, label="heads")
    spin.set(xlabel="spin about the normal [rad/s]", ylabel="part of the tosses", ylim=(0, 1.02))
    spin.set_xscale("symlog", linthresh=0.01)
    spin.set_xlim(0, 1.2 * ASIDE[-1])
    spin.legend()
    drop.plot(data["height"], data["uncertain"], "o-", color=BLUE)
    drop.set(xlabel="height of release [m]", ylabel="outcomes that 1 µm changes", ylim=(0, None))
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
