"""Does a coin land on the side it started from? 350,757 flips, and what is left of it after bounces."""

from collections.abc import Iterator
from functools import cache
from itertools import product
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from cointoss import Engine, Hand
from cointoss.study import (
    TOUCHES,
    Array,
    Estimate,
    PeopleFit,
    chance_of_spread,
    first_side,
    fit_people,
    log_likelihoods,
    rows_from_states,
    share,
    share_of,
    spread_interval,
)
from cointoss_reproduction.frame.cells import Cells, Rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import jackknife
from cointoss_reproduction.setups.general_coins import CoinClass
from cointoss_reproduction.studies.same_side.people import (
    EXPONENTIAL,
    NORMAL,
    WOBBLING,
    quantiles,
    read_flips,
    read_started,
    spread_of,
    without,
)

SEED = 2025
STEPS = ("first touch", *(f"touch {n + 1}" for n in TOUCHES[1:]), "at rest")
CHIS, HEIGHTS = (0.2, 0.5, 0.8), (0.3, 1.0)
PSI = 60
"""The ψ of a coin that wobbles much [deg]."""
MUCH, PEOPLE = f"{PSI}°", "as of people"
"""The names of this ψ, and of people's."""
CHI = 0.5
"""The restitution of the floor on which people's tosses bounce."""
SMOOTH, ROUGH = FLOORS = ("smooth", "rough, μ = 0.2")
CLOSE, SMALL = 0.01, 0.05
"""A share within `CLOSE` of another is the same to the per cent; a share within `SMALL` differs little."""
WOBBLE = "wobble, |90° - ψ| half-normal"
FAMILIES = {WOBBLE: WOBBLING, "p normal": NORMAL, "p - 1/2 exponential": EXPONENTIAL}
"""How p may be distributed over people."""
DEGREE = float(np.degrees(1))


class Job(NamedTuple):
    """A floor, and a hand that tosses onto it by one of the engines."""

    floor: str
    chi: float
    height: float
    psi: str
    engine: str

    @property
    def name(self) -> str:
        """Floor, restitution, height and wobble."""
        return f"{self.floor}, χ = {self.chi:g}, {self.height:g} m, ψ = {self.psi}"


JOBS = (
    *(Job(*one, MUCH, str(Engine.ANALYTIC)) for one in product(FLOORS, CHIS, HEIGHTS)),
    *(Job(floor, CHI, HEIGHTS[1], PEOPLE, str(Engine.ANALYTIC)) for floor in FLOORS),
    *(Job(floor, CHI, HEIGHTS[0], MUCH, str(Engine.MUJOCO)) for floor in FLOORS),
)


def flipped() -> Iterator[Rows]:
    """Return how often people catch the side that was up, together and each, beside the fitted models."""
    flips, (heads, tails) = read_flips(), read_started()

    def same(kept: NDArray[np.bool_]) -> float:
        return flips.same[kept].sum() / flips.flips[kept].sum()

    def heads_more(kept: NDArray[np.bool_]) -> float:
        from_heads, from_tails = (one.same[kept].sum() / one.flips[kept].sum() for one in (heads, tails))
        return from_heads - from_tails

    people = len(flips.flips)
    yield {"same": jackknife(same, people, "people"), "heads_more": jackknife(heads_more, people, "people")}
    part = (np.arange(people) + 0.5) / people
    each = [
        share_of(int(up), int(all_of), "flips") for up, all_of in zip(flips.same, flips.flips, strict=True)
    ]
    ordered = sorted(each, key=lambda one: one.value)
    yield pd.DataFrame({"of": "a person", "part": part, "p": ordered})
    for name, family in FAMILIES.items():
        p = quantiles(family, _fitted(name)[0].parameters, part)
        yield pd.DataFrame({"of": name, "part": part, "p": p})


def modelled(family: str) -> dict[str, Any]:
    """Compare a distribution of p with wobble, whose logarithm of the likelihood is larger by `behind`.

    They are compared by all people, without each in turn, and in the prediction of each from the others.
    """
    flips, (found, left), (wobble, wobble_left) = read_flips(), _fitted(family), _fitted(WOBBLE)

    def predicted(refitted: list[PeopleFit]) -> float:
        """Return the likelihood of each person's counts by what was fitted to the others', summed."""
        each = enumerate(refitted)
        return sum(log_likelihoods(flips, one.people, one.parameters)[person] for person, one in each)

    low, high = spread_interval(flips, found)
    first = Estimate(float(found.parameters[0]), float(low), float(high), len(left), "people")
    return {
        "parameters": len(found.parameters),
        "first": first,
        "rms": first * DEGREE if family == WOBBLE else None,
        "spread": spread_of(found),
        "behind": wobble.log_likelihood - found.log_likelihood,
        "behind_without": min(
            one.log_likelihood - own.log_likelihood for one, own in zip(wobble_left, left, strict=True)
        ),
        "behind_in_prediction": predicted(wobble_left) - predicted(left),
        "chance": chance_of_spread(flips, found, np.random.default_rng(SEED)),
    }


@cache
def _fitted(family: str) -> tuple[PeopleFit, list[PeopleFit]]:
    """Return a family fitted to all people, and to all but each."""
    flips, people = read_flips(), FAMILIES[family]
    return fit_people(flips, people), [
        fit_people(without(flips, person), people) for person in range(len(flips.flips))
    ]


def bounced(job: int, count: int = 3000, people: int = 8000, mujoco: int = 400) -> pd.DataFrame:
    """Toss a hand's releases onto a floor, and count the first side up after 0, 1, 2, ... impacts."""
    asked = JOBS[job]
    kind = CoinClass(thick=True, imperfect=False, air=True, coulomb=asked.floor == ROUGH)
    scenario = kind.scenario.replace("floor.restitution", asked.chi)
    found = first_side(rows_from_states(scenario, _states(count, people, mujoco)[job]), Engine(asked.engine))
    sides = [share(up) for up in (*found.touches, found.at_rest)]
    return pd.DataFrame({**asked._asdict(), "name": asked.name, "step": STEPS, "first_side": sides})


@cache
def _states(count: int, people: int, mujoco: int) -> list[Array]:
    """Return the releases of each of `JOBS`, which are drawn one after the other."""
    body = CoinClass(thick=True, imperfect=False, air=True, coulomb=False).scenario.body
    hands = {
        MUCH: lambda height: Hand(height=height, psi=np.radians(PSI)),
        PEOPLE: lambda height: Hand(height=height, psi_scatter=float(_fitted(WOBBLE)[0].parameters[0])),
    }
    sizes = {(MUCH, Engine.ANALYTIC): count, (PEOPLE, Engine.ANALYTIC): people, (MUCH, Engine.MUJOCO): mujoco}
    rng = np.random.default_rng(SEED)
    return [hands[one.psi](one.height).states(body, rng, sizes[one.psi, Engine(one.engine)]) for one in JOBS]


REPRODUCTION = study(
    __name__,
    Cells(flipped, {}),
    Cells(modelled, {"family": tuple(FAMILIES)}),
    Cells(bounced, {"job": range(len(JOBS))}),
)
