"""A claim of sections 5.1 and 6: the thin ideal coin is sufficient for a real one."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import Coin, ContactLaw, Floor, Outcome, Scenario, analytic, load
from cointoss.study import (
    BLUE,
    GREY,
    INK,
    SKY,
    VERMILION,
    Array,
    Estimate,
    Progress,
    difference,
    jackknife,
    rows_from_states,
    run,
    share,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.face_changes import changes, share_after_row
from cointoss_reproduction.setups.hands import states_of_hands
from cointoss_reproduction.setups.planar_maps import faces_after, toss_rows_by_mujoco

SEED = 6
ASIDE = 10.0
"""Spins about ξ and ζ, at most [rad/s]."""
COINS = THIN, NEAR, REAL = "thin ideal", "thick, c/10", "thick, c"
"""The paper's model, and its 1 zloty coin with a mass centre as far off as it says and a tenth of that."""
FLOORS = SMOOTH, ROUGH = "smooth", "rough"
FLOOR = {
    SMOOTH: Floor(restitution=0.6, contact=ContactLaw.SMOOTH),
    ROUGH: Floor(restitution=0.6, contact=ContactLaw.COULOMB, friction=0.2),
}
STEP = 1e-5
"""By which the height of a release differs from the next toss of Fig. 24 [m]."""
HIGHER = STEP * np.eye(13)[2]
"""The same of a state."""
COLORS = {THIN: BLUE, NEAR: SKY, REAL: VERMILION}


@dataclass(frozen=True, kw_only=True)
class ThinCoinTosses:
    """Many tosses of one coin on one floor."""

    outcome: NDArray[np.int8]
    impacts: NDArray[np.int32]
    uncertain: NDArray[np.bool_]
    """Of the first tosses, whether `STEP` changes the outcome."""

    def share(self, outcome: Outcome) -> Estimate:
        """Return the share of the tosses that end so."""
        return share(self.outcome == outcome)


def make(
    progress: Progress,
    count: int = 20_000,
    count_real: int = 2000,
    followed: int = 400,
    tosses_mujoco: int = 200,
) -> Findings:
    """Toss the three coins from the same random releases on two floors; follow the faces of some tosses.

    Args:
        progress: called as the work goes on.
        count: tosses of the two coins whose averages are compared.
        count_real: tosses of the real coin, which take ten times as long.
        followed: tosses of each coin whose faces are followed.
        tosses_mujoco: tosses of MuJoCo's.
    """
    tossed = states_of_hands(np.random.default_rng(SEED), count, aside=ASIDE)
    whole = len(FLOORS) * len(COINS) + 2
    done = 0
    few = tossed[:count_real]
    first = {coin: faces_after(rows_from_states(_case(coin, SMOOTH), few), 0) for coin in COINS}
    progress(done := done + 1, whole)
    made: dict[tuple[str, str], ThinCoinTosses] = {}
    after_row: dict[str, Estimate] = {}
    for floor in FLOORS:
        for coin in COINS:
            scenario = _case(coin, floor)
            some = few if coin == REAL else tossed
            ended = analytic.toss_rows(rows_from_states(scenario, some))
            higher = analytic.toss_rows(rows_from_states(scenario, few + HIGHER))
            made[coin, floor] = ThinCoinTosses(
                outcome=ended.outcome,
                impacts=ended.impacts,
                uncertain=higher.outcome != ended.outcome[: len(few)],
            )
            if floor == SMOOTH:
                after_row[coin] = _share_after_row(scenario, tossed[:followed])
            progress(done := done + 1, whole)
    by_mujoco = rows_from_states(_case(REAL, SMOOTH), tossed[:tosses_mujoco])
    first_mujoco = faces_after(by_mujoco, 0, toss_rows_by_mujoco)
    progress(done + 1, whole)
    heads = {key: tosses.share(Outcome.HEADS) for key, tosses in made.items()}
    uncertain = {key: share(tosses.uncertain) for key, tosses in made.items()}
    others = {key: (tosses, made[THIN, key[1]]) for key, tosses in made.items() if key[0] != THIN}
    same = {
        key: share(own.outcome == thin.outcome[: len(own.outcome)]) for key, (own, thin) in others.items()
    }
    shown = {key: (heads[key], same.get(key, Estimate(1, 1, 1, count)), uncertain[key]) for key in made}
    return Findings(
        after_row=after_row,
        same_by_mujoco=int(np.sum(first_mujoco == first[REAL][:tosses_mujoco])),
        as_thin={coin: share(first[coin] == first[THIN]) for coin in COINS},
        same=same,
        same_words=_listed("as the thin coin's:", same, (NEAR, REAL)),
        heads={coin: _listed("heads", heads, (THIN, coin)) for coin in (NEAR, REAL)},
        heads_apart={
            key: difference(*(one.outcome == Outcome.HEADS for one in pair)) for key, pair in others.items()
        },
        impacts={key: tosses.impacts for key, tosses in made.items()},
        impacts_over={
            f"impacts over the thin coin's ({floor} floor)": _ratio_of_means(
                *(one.impacts[:count_real] for one in others[REAL, floor])
            )
            for floor in FLOORS
        },
        edge={key: tosses.share(Outcome.EDGE) for key, (tosses, _) in others.items()},
        uncertain=_listed(f"{1e6 * STEP:.0f} µm of height change", uncertain, COINS),
        uncertain_over={
            key: _ratio_of_means(own.uncertain, thin.uncertain) for key, (own, thin) in others.items()
        },
        data={
            f"{coin}, {floor}": np.array([one.ends for one in three])
            for (coin, floor), three in shown.items()
        },
    )


def _case(coin: str, floor: str) -> Scenario:
    """Return the scenario of a coin, one of `COINS`, on a floor, one of `FLOORS`."""
    zloty = load("zloty")
    if coin == THIN:
        changed = ("coin", Coin(mass=zloty.coin.mass, radius=zloty.coin.radius, thickness=0.0))
    else:
        part = 0.1 if coin == NEAR else 1.0
        x, y, z = zloty.coin.center_of_mass
        changed = ("coin.center_of_mass", (part * x, part * y, part * z))
    return zloty.replace(*changed, "floor", FLOOR[floor])


def _share_after_row(scenario: Scenario, starts: Array) -> Estimate:
    kinds = [changes(run(scenario.body, scenario.rules, state).rows["face"]) for state in starts]
    return share_after_row(np.array([[len(kind) for kind in both] for both in kinds]))


def _ratio_of_means(own: NDArray[Any], thin: NDArray[Any]) -> Estimate:
    """Return a mean of a coin's tosses over that of the thin one's, in the same tosses, (n,) each."""
    return jackknife(lambda kept: float(own[kept].mean() / thin[kept].mean()), len(own))


def _listed(what: str, found: dict[tuple[str, str], Estimate], coins: tuple[str, ...]) -> str:
    """Return the shares of some coins on both floors in words."""
    floors = []
    for floor in FLOORS:
        values = ", ".join(f"{found[coin, floor].value:.1%} ({coin})" for coin in coins)
        floors.append(f"{values} on a {floor} floor")
    return f"{what} {'; '.join(floors)}"


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 3.2))
    shown = ("heads", "as the thin ideal coin", "changed by 10 µm")
    for number, (axes, title) in enumerate(zip(picture.subplots(1, 3, sharey=True), shown, strict=True)):
        for i, coin in enumerate(COINS):
            at = np.arange(len(FLOORS)) + 0.25 * (i - 1)
            values, low, high = np.array([data[f"{coin}, {floor}"][number] for floor in FLOORS]).T
            axes.bar(at, values, 0.22, color=COLORS[coin], label=coin)
            axes.errorbar(at, values, [values - low, high - values], fmt="none", ecolor=INK, capsize=2)
        axes.axhline(0.5, color=GREY, linewidth=0.8)
        axes.set(title=title, ylim=(0, 1), axisbelow=True)
        axes.set_xticks(range(len(FLOORS)), [f"{floor} floor" for floor in FLOORS])
    picture.axes[0].set_ylabel("part of the tosses")
    picture.axes[0].legend()
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
