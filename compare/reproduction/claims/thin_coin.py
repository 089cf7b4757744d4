"""A claim of sections 5.1 and 6: the thin ideal coin is sufficient for a real one."""

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import analytic, coin_mj
from cointoss.analytic.events import run
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, GREY, INK, SKY, VERMILION
from cointoss.compare.reproduction.claim import Claim, Criterion, Estimate
from cointoss.compare.reproduction.estimates import difference, jackknife, share
from cointoss.compare.reproduction.paper.fig28 import changes
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.setups.hands import releases_of_hands
from cointoss.compare.reproduction.setups.release_arrays import chosen, moved, states_of
from cointoss.models.laws import ContactLaw
from cointoss.models.parts import Coin, EndingCriteria, Floor
from cointoss.models.reading import load
from cointoss.models.records import Outcome
from cointoss.models.releases import Releases
from cointoss.models.scenario import Scenario

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
SAME_SIZE = 2
"""A ratio below which two numbers, or two shares, are of one size."""
BIAS = 0.01
"""By which 1/2 is off in real tosses (Diaconis and others, section 1): a model of averages errs less."""
SELDOM = 0.02
"""A part of the tosses."""
STEP = 1e-5
"""By which the height of a release differs from the next toss of Fig. 24 [m]."""
HIGHER = np.array([0.0, 0.0, STEP])
COLORS = {THIN: BLUE, NEAR: SKY, REAL: VERMILION}


@dataclass(frozen=True, kw_only=True)
class Tossed:
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
) -> Result:
    """Toss the three coins from the same random releases on two floors; follow the faces of some tosses.

    Args:
        progress: called as the work goes on.
        count: tosses of the two coins whose averages are compared.
        count_real: tosses of the real coin, which take ten times as long.
        followed: tosses of each coin whose faces are followed.
        tosses_mujoco: tosses of MuJoCo's.
    """
    tossed = releases_of_hands(np.random.default_rng(SEED), count, aside=ASIDE)
    whole = len(FLOORS) * len(COINS) + 2
    done = 0
    first = {coin: _first_faces(_case(coin, SMOOTH), chosen(tossed, slice(count_real))) for coin in COINS}
    progress(done := done + 1, whole)
    found: dict[tuple[str, str], Tossed] = {}
    after_row: dict[str, Estimate] = {}
    for floor in FLOORS:
        for coin in COINS:
            scenario = _case(coin, floor)
            some = chosen(tossed, slice(count_real if coin == REAL else count))
            ended = analytic.toss_many(scenario, some)
            few = slice(count_real)
            higher = analytic.toss_many(scenario, moved(chosen(some, few), position=HIGHER))
            found[coin, floor] = Tossed(
                outcome=ended.outcome,
                impacts=ended.impacts,
                uncertain=higher.outcome != ended.outcome[few],
            )
            if floor == SMOOTH:
                after_row[coin] = share_after_row(scenario, chosen(tossed, slice(followed)))
            progress(done := done + 1, whole)
    by_mujoco = _first_faces_by_mujoco(_case(REAL, SMOOTH), tossed, tosses_mujoco)
    same_by_mujoco = int(np.sum(by_mujoco == first[REAL][:tosses_mujoco]))
    progress(done + 1, whole)
    as_thin = {coin: share(first[coin] == first[THIN]) for coin in COINS}
    same = {(coin, floor): _same(found, coin, floor) for coin in (NEAR, REAL) for floor in FLOORS}
    heads = {key: tosses.share(Outcome.HEADS) for key, tosses in found.items()}
    edge = {key: tosses.share(Outcome.EDGE) for key, tosses in found.items() if key[0] != THIN}
    uncertain = {key: share(tosses.uncertain) for key, tosses in found.items()}
    claims = (
        Claim(
            claim="the thin ideal coin is sufficient, toss by toss, for the face first up (soft floor)",
            analytic=(
                f"it shows that of the real coin in {as_thin[REAL].value:.1%} of the tosses, of one whose "
                f"mass centre lies a tenth as far off in {as_thin[NEAR].value:.1%}"
            ),
            mujoco=f"{same_by_mujoco} of {tosses_mujoco} faces of the real coin as the analytic engine",
            criteria=[
                Criterion("share of the same faces (c/10)", as_thin[NEAR], ">", MOSTLY, "1/2 is chance")
            ],
        ),
        Claim(
            claim="the thin ideal coin is sufficient, toss by toss, for the outcome after bouncing",
            analytic=_listed("as the thin coin's:", same, (NEAR, REAL)),
            criteria=[
                Criterion(
                    f"share of the same outcomes (c/10, {floor} floor)",
                    same[NEAR, floor],
                    ">",
                    MOSTLY,
                    "1/2 is chance",
                )
                for floor in FLOORS
            ],
            expected=False,
        ),
        Claim(
            claim="it is sufficient on average, for a mass centre that is close (c/10)",
            analytic=_listed("heads", heads, (THIN, NEAR)),
            criteria=[_heads_apart(found, NEAR, floor) for floor in FLOORS],
            expected=False,
        ),
        Claim(
            claim="it is sufficient on average, for the mass centre that the paper gives (c)",
            analytic=(
                f"{_listed('heads', heads, (THIN, REAL))}; impacts "
                f"{found[THIN, SMOOTH].impacts.mean():.0f} against {found[REAL, SMOOTH].impacts.mean():.0f} "
                f"and {found[THIN, ROUGH].impacts.mean():.0f} against "
                f"{found[REAL, ROUGH].impacts.mean():.0f}"
            ),
            criteria=[
                *(_heads_apart(found, REAL, floor) for floor in FLOORS),
                *(
                    Criterion(
                        f"impacts over the thin coin's ({floor} floor)",
                        _impacts_over(found, floor, count_real),
                        "<",
                        SAME_SIZE,
                        "of the same size",
                    )
                    for floor in FLOORS
                ),
            ],
            expected=False,
        ),
        Claim(
            claim="a thick coin seldom comes to rest on its edge (section 5.2), smooth floor (c/10)",
            criteria=[Criterion("share on the edge", edge[NEAR, SMOOTH], "<", SELDOM, "seldom")],
        ),
        Claim(
            claim="a thick coin seldom comes to rest on its edge (section 5.2), smooth floor (c)",
            analytic="its heavy side down it stands as in a well as wide as the coin is thick",
            criteria=[Criterion("share on the edge", edge[REAL, SMOOTH], "<", SELDOM, "seldom")],
            expected=False,
        ),
        Claim(
            claim="a thick coin seldom comes to rest on its edge (section 5.2), rough floor",
            analytic=(
                f"{edge[NEAR, ROUGH].value:.1%} (c/10) and {edge[REAL, ROUGH].value:.1%} (c) end on the "
                "edge, most by rolling on it, which nothing here but the air resists"
            ),
            missing="no resistance to rolling and pivoting is modelled, in the paper or here",
            expected=None,
        ),
        Claim(
            claim="it is sufficient for how unpredictable a toss is",
            analytic=_listed(f"{1e6 * STEP:.0f} µm of height change", uncertain, COINS),
            criteria=[
                criterion
                for coin in (NEAR, REAL)
                for floor in FLOORS
                for criterion in _uncertain_over(found, coin, floor)
            ],
        ),
        Claim(
            claim="the face changes more often after a row of impacts (Fig. 28), whichever the coin",
            criteria=[
                Criterion(f"share after a row ({coin})", after_row[coin], ">", 1 / 2, "more often than not")
                for coin in COINS
            ],
        ),
    )
    data: dict[str, NDArray[Any]] = {
        f"{coin}, {floor}": np.array([(one.value, one.low, one.high) for one in measured])
        for coin, floor in found
        for measured in [
            (heads[coin, floor], same.get((coin, floor), Estimate(1, 1, 1, count)), uncertain[coin, floor])
        ]
    }
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


def share_after_row(scenario: Scenario, tossed: Releases) -> Estimate:
    """Return the share of the changes of face that follow a row of impacts on one face."""
    kinds = [changes(run(scenario.body, scenario.rules, state).rows["face"]) for state in states_of(tossed)]
    counts = np.array([[len(kind) for kind in both] for both in kinds])

    def share_of(kept: NDArray[np.bool_]) -> float:
        row, one = counts[kept].sum(axis=0)
        return float(row / (row + one))

    return jackknife(share_of, len(counts), parts=min(20, len(counts)))


def _same(found: dict[tuple[str, str], Tossed], coin: str, floor: str) -> Estimate:
    """Return the share of a coin's tosses with the outcome of the thin ideal coin."""
    outcome = found[coin, floor].outcome
    return share(outcome == found[THIN, floor].outcome[: len(outcome)])


def _heads_apart(found: dict[tuple[str, str], Tossed], coin: str, floor: str) -> Criterion:
    """Return how far the shares of heads of a coin and the thin one differ, as a criterion."""
    heads, heads_thin = (found[one, floor].outcome == Outcome.HEADS for one in (coin, THIN))
    return Criterion(
        f"difference of the shares of heads ({floor} floor)",
        difference(heads, heads_thin),
        "within ±",
        BIAS,
        "the bias that Diaconis and others find",
    )


def _impacts_over(found: dict[tuple[str, str], Tossed], floor: str, count: int) -> Estimate:
    """Return the mean number of impacts of the real coin over that of the thin one."""
    real, thin = (found[coin, floor].impacts[:count] for coin in (REAL, THIN))
    return jackknife(lambda kept: float(real[kept].mean() / thin[kept].mean()), count)


def _uncertain_over(
    found: dict[tuple[str, str], Tossed], coin: str, floor: str
) -> tuple[Criterion, Criterion]:
    """Return a coin's share of uncertain tosses over the thin one's, as criteria."""
    own, thin = (found[one, floor].uncertain for one in (coin, THIN))
    ratio = jackknife(lambda kept: float(own[kept].mean() / thin[kept].mean()), len(own))
    quantity = f"share over the thin coin's ({coin}, {floor} floor)"
    return (
        Criterion(quantity, ratio, "<", SAME_SIZE, "of the same size"),
        Criterion(quantity, ratio, ">", 1 / SAME_SIZE, "of the same size"),
    )


def _listed(what: str, found: dict[tuple[str, str], Estimate], coins: tuple[str, ...]) -> str:
    """Return the shares of some coins on both floors in words."""
    floors = []
    for floor in FLOORS:
        values = ", ".join(f"{found[coin, floor].value:.1%} ({coin})" for coin in coins)
        floors.append(f"{values} on a {floor} floor")
    return f"{what} {'; '.join(floors)}"


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
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


REPRODUCTION = Reproduction(
    paper="Claims of section 6",
    title="the thin ideal coin beside real ones: toss by toss, and on average",
    assumed=(
        "The paper does not say sufficient for what. The releases are those of hands that toss from 0.8 to "
        "1.2 m with 20 to 60 rad/s about η and up to 10 rad/s about ξ and ζ; χ = 0.6; smooth, or rough with "
        "Coulomb's friction, μ = 0.2. The real coin is the paper's, 2 mm thick with c = (-1, -1, -0.2) mm; "
        "as such a coin would turn over in the drops of Fig. 3, one with a tenth of c is tossed too."
    ),
    seconds=250,
    make=make,
    draw={"figure": _draw},
    quick_seconds=10,
    quick=partial(make, count=100, count_real=60, followed=20, tosses_mujoco=20),
)
