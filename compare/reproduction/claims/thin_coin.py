"""A claim of sections 5.1 and 6: the thin ideal coin is sufficient for a real one."""

from dataclasses import dataclass, fields
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import analytic
import coin_mj
from analytic.events import run
from compare.output.progress import Progress
from compare.output.style import BLUE, GREY, SKY, VERMILION
from compare.reproduction.claim import Claim, Criterion
from compare.reproduction.paper.fig28 import changes
from compare.reproduction.runner import Reproduction, Result
from compare.reproduction.setups.hands import releases_of_hands
from compare.reproduction.setups.release_arrays import chosen, moved, states_of
from models.laws import ContactLaw
from models.reading import load
from models.records import Outcome
from models.releases import Releases
from models.scenario import Coin, EndingCriteria, Floor, Scenario

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
MOSTLY = 0.8
"""A part of the tosses that is enough to call a model sufficient for single tosses; 1/2 is chance."""
SELDOM = 0.02
"""A part of the tosses."""
STEP = 1e-5
"""By which the height of a release differs from the next toss of Fig. 24 [m]."""
COLORS = {THIN: BLUE, NEAR: SKY, REAL: VERMILION}


@dataclass(frozen=True, kw_only=True)
class Statistics:
    """What many tosses of one coin on one floor give."""

    heads: float
    """Part of heads."""
    edge: float
    """Part that stays on the edge."""
    impacts: float
    """Mean number of impacts."""
    as_thin: float
    """Part with the outcome of the thin ideal coin."""
    uncertain: float
    """Part whose outcome `STEP` changes."""


NAMES = [item.name for item in fields(Statistics)]


def make(progress: Progress, count: int = 200, followed: int = 100, tosses_mujoco: int = 200) -> Result:
    """Toss the three coins from the same random releases on two floors; follow the faces of some tosses."""
    tossed = releases_of_hands(np.random.default_rng(SEED), count, aside=ASIDE)
    whole = len(FLOORS) * len(COINS) + 2
    done = 0
    first = {coin: _first_faces(_case(coin, SMOOTH), tossed) for coin in COINS}
    progress(done := done + 1, whole)
    found: dict[tuple[str, str], Statistics] = {}
    chatter: dict[str, list[int]] = {}
    for floor in FLOORS:
        thin = np.empty(0)
        for coin in COINS:
            ended = analytic.toss_many(_case(coin, floor), tossed)
            thin = ended.outcome if coin == THIN else thin
            found[coin, floor] = Statistics(
                heads=float(np.mean(ended.outcome == Outcome.HEADS)),
                edge=float(np.mean(ended.outcome == Outcome.EDGE)),
                impacts=float(np.mean(ended.impacts)),
                as_thin=float(np.mean(ended.outcome == thin)),
                uncertain=_uncertain(_case(coin, floor), tossed, ended.outcome, count // 2),
            )
            if floor == SMOOTH:
                chatter[coin] = _changes(_case(coin, floor), tossed, followed)
            progress(done := done + 1, whole)
    by_mujoco = _first_faces_by_mujoco(_case(REAL, SMOOTH), tossed, tosses_mujoco)
    same_by_mujoco = int(np.sum(by_mujoco == first[REAL][:tosses_mujoco]))
    progress(done + 1, whole)
    error = 1 / (2 * np.sqrt(count))
    as_thin = {coin: float(np.mean(first[coin] == first[THIN])) for coin in COINS}
    soft = [row / (row + one) for row, one in chatter.values()]
    claims = (
        Claim(
            claim="the thin ideal coin is sufficient, toss by toss, for the face first up (soft floor)",
            analytic=(
                f"it shows that of the real coin in {as_thin[REAL]:.1%} of {count} tosses, of one whose mass "
                f"centre lies a tenth as far off in {as_thin[NEAR]:.1%}"
            ),
            mujoco=f"{same_by_mujoco} of {tosses_mujoco} faces of the real coin as the analytic engine",
            criteria=[
                Criterion("share of the same faces (c/10)", as_thin[NEAR], ">", MOSTLY, "1/2 is chance")
            ],
        ),
        Claim(
            claim="the thin ideal coin is sufficient, toss by toss, for the outcome after bouncing",
            analytic=_listed("as the thin coin's:", found, "as_thin", (NEAR, REAL)),
            criteria=[
                Criterion(
                    "least share of the same outcomes",
                    min(s.as_thin for s in found.values()),
                    ">",
                    MOSTLY,
                    "1/2 is chance",
                )
            ],
            expected=False,
        ),
        Claim(
            claim="it is sufficient on average, for a mass centre that is close (c/10)",
            analytic=f"{_listed('heads', found, 'heads', (THIN, NEAR))} (± {error:.0%})",
            criteria=[_heads_apart(found, NEAR, error)],
        ),
        Claim(
            claim="it is sufficient on average, for the mass centre that the paper gives (c)",
            analytic=(
                f"{_listed('heads', found, 'heads', (THIN, REAL))} (± {error:.0%}); impacts "
                f"{found[THIN, SMOOTH].impacts:.0f} against {found[REAL, SMOOTH].impacts:.0f} and "
                f"{found[THIN, ROUGH].impacts:.0f} against {found[REAL, ROUGH].impacts:.0f}"
            ),
            criteria=[
                _heads_apart(found, REAL, error),
                Criterion(
                    "impacts over the thin coin's",
                    max(found[REAL, floor].impacts / found[THIN, floor].impacts for floor in FLOORS),
                    "<",
                    2,
                    "of the same size",
                ),
            ],
            expected=False,
        ),
        Claim(
            claim="a coin that is not thin seldom comes to rest on its edge (section 5.2)",
            analytic=_listed("on the edge", found, "edge", (NEAR, REAL)),
            criteria=[
                Criterion(
                    "largest share on the edge",
                    max(statistics.edge for statistics in found.values()),
                    "<",
                    SELDOM,
                    "seldom",
                )
            ],
            expected=False,
        ),
        Claim(
            claim="it is sufficient for how unpredictable a toss is",
            analytic=f"{_listed(f'{1e6 * STEP:.0f} µm of height change', found, 'uncertain', COINS)}",
            criteria=[
                Criterion(
                    "largest difference of the shares",
                    max(abs(s.uncertain - found[THIN, SMOOTH].uncertain) for s in found.values()),
                    "<",
                    8 * error,
                    "four standard errors of a difference between half as many tosses",
                )
            ],  # four standard errors of a difference between half as many tosses
        ),
        Claim(
            claim="the face changes more often after a row of impacts (Fig. 28), whichever the coin",
            analytic=", ".join(f"{share:.0%} ({coin})" for share, coin in zip(soft, COINS, strict=True)),
            criteria=[Criterion("least share after a row", min(soft), ">", 1 / 2, "more often than not")],
        ),
    )
    data: dict[str, NDArray[Any]] = {
        f"{coin}, {floor}": np.array([getattr(statistics, name) for name in NAMES])
        for (coin, floor), statistics in found.items()
    }
    data |= {"first touch as thin": np.array(list(as_thin.values())), "after a row": np.array(soft)}
    return Result(claims=claims, data=data)


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


def _first_touch(scenario: Scenario) -> Scenario:
    return scenario.replace("ending", EndingCriteria(max_impacts=1))


def _first_faces(scenario: Scenario, tossed: Releases) -> NDArray[np.int8]:
    return analytic.toss_many(_first_touch(scenario), tossed).last_face


def _first_faces_by_mujoco(scenario: Scenario, tossed: Releases, count: int) -> NDArray[np.int8]:
    return coin_mj.toss_many(
        _first_touch(scenario), chosen(tossed, slice(count)), settings=coin_mj.FINE
    ).last_face


def _uncertain(scenario: Scenario, tossed: Releases, outcome: NDArray[np.int8], count: int) -> float:
    higher = analytic.toss_many(
        scenario, moved(chosen(tossed, slice(count)), position=np.array([0.0, 0.0, STEP]))
    ).outcome
    return float(np.mean(higher != outcome[:count]))


def _changes(scenario: Scenario, tossed: Releases, count: int) -> list[int]:
    """Count the changes of face after a row of impacts on one face, and after a single one."""
    kinds = [
        changes(run(scenario.body, scenario.rules, state).rows["face"]) for state in states_of(tossed)[:count]
    ]
    return [sum(len(kind[i]) for kind in kinds) for i in (0, 1)]


def _heads_apart(found: dict[tuple[str, str], Statistics], coin: str, error: float) -> Criterion:
    """Return how far the shares of heads of a coin and the thin one differ at most, as a criterion."""
    return Criterion(
        "largest difference of the shares of heads",
        max(abs(found[coin, floor].heads - found[THIN, floor].heads) for floor in FLOORS),
        "<",
        4 * np.sqrt(2) * error,
        "four standard errors of a difference",
    )


def _listed(what: str, found: dict[tuple[str, str], Statistics], name: str, coins: tuple[str, ...]) -> str:
    """Return one statistic of some coins on both floors in words."""
    floors = []
    for floor in FLOORS:
        values = ", ".join(f"{getattr(found[coin, floor], name):.0%} ({coin})" for coin in coins)
        floors.append(f"{values} on a {floor} floor")
    return f"{what} {'; '.join(floors)}"


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
    picture = Figure(figsize=(9, 3.2))
    shown = {"heads": "heads", "as_thin": "as the thin ideal coin", "uncertain": "changed by 10 µm"}
    for axes, (name, title) in zip(picture.subplots(1, 3, sharey=True), shown.items(), strict=True):
        for i, coin in enumerate(COINS):
            at = np.arange(len(FLOORS)) + 0.25 * (i - 1)
            values = [data[f"{coin}, {floor}"][NAMES.index(name)] for floor in FLOORS]
            axes.bar(at, values, 0.22, color=COLORS[coin], label=coin)
        axes.axhline(0.5, color=GREY, linewidth=0.8)
        axes.set(title=title, ylim=(0, 1), axisbelow=True)
        axes.set_xticks(range(len(FLOORS)), [f"{floor} floor" for floor in FLOORS])
    picture.axes[0].set_ylabel("part of the tosses")
    picture.axes[0].legend()
    return picture


REPRODUCTION = Reproduction(
    paper="Claims of section 6",
    title="the thin ideal coin beside real ones: toss by toss, and on average",
    assumed=(
        "The paper does not say sufficient for what. The releases are those of hands that toss from 0.8 to "
        "1.2 m with 20 to 60 rad/s about η and up to 10 rad/s about ξ and ζ; χ = 0.6; smooth, or rough with "
        "Coulomb's friction, μ = 0.2. The real coin is the paper's, 2 mm thick with c = (-1, -1, -0.2) mm; "
        "as such a coin would turn over in the drops of Fig. 3, one with a tenth of c is tossed too."
    ),
    seconds=50,
    make=make,
    draw={"figure": _draw},
    quick_seconds=10,
    quick=partial(make, count=30, followed=10, tosses_mujoco=20),
)
