"""How often, and by how much, each contact law does in random impacts what no passive floor could."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss import ContactLaw, Flag, Impacts, RestitutionKind, load
from cointoss.study import Array, Body, Progress, Rules, raised_flags, stepping, strike
from cointoss_reproduction.studies.contact_laws.random_impacts import draw_states
from cointoss_reproduction.studies.contact_laws.thresholds import onset_of_gain, onset_without_solution

COUNT, SEED = 20_000, 2008
LAWS = {
    **{str(law): (law, RestitutionKind.KINEMATIC) for law in ContactLaw if law != ContactLaw.COULOMB},
    "coulomb, kinematic": (ContactLaw.COULOMB, RestitutionKind.KINEMATIC),
    "coulomb, energetic": (ContactLaw.COULOMB, RestitutionKind.ENERGETIC),
}
COINS = {
    "thin ideal": (0.0, (0.0, 0.0, 0.0)),
    "thick ideal": (2e-3, (0.0, 0.0, 0.0)),
    "thin imperfect": (0.0, (-1e-3, -1e-3, 0.0)),
    "thick imperfect": (2e-3, (-1e-3, -1e-3, -2e-4)),
}
"""Thickness and mass centre of the coins; the last is the paper's, section 5.1."""
RESTITUTIONS = tuple(tenth / 10 for tenth in range(1, 11))
FRICTIONS_SUFFICIENT = tuple(round(0.05 * step, 2) for step in range(61))
FRICTIONS_OF_ONSETS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0)
FRICTIONS_WITHOUT_SOLUTION = (0.5, 1.0, 1.5, 2.0, 3.0)


@dataclass(frozen=True, kw_only=True)
class LawRecord:
    """What one law did to the impacts of all coins, for each of `RESTITUTIONS`; shares are of impacts."""

    gains: list[float]
    """Share that gains energy."""
    gains_by_coin: list[list[float]]
    """The same for each coin."""
    median_gain: list[float | None]
    """Median of the gains, over the kinetic energy before; None where there is none."""
    largest_change: list[float]
    """Largest change of the energy, over the kinetic energy before."""
    pulls: list[float]
    """Share that pulls, S_z < 0."""
    leaves_cone: list[float]
    """Share with |S_t| > μ S_z, μ drawn from 0 to 1."""
    without_solution: list[float]
    """Share for which the law has no solution."""
    friction_sufficient: list[float]
    """Share with |S_t| <= μ S_z and S_z > 0, for each μ of `FRICTIONS_SUFFICIENT`, over all restitutions."""
    friction_for_half: float | None
    """The μ that suffices for half of all impacts; None where none does."""
    friction_for_most: float | None
    """The μ that suffices for 95 % of all impacts; None where none does."""


@dataclass(frozen=True, kw_only=True)
class Onsets:
    """The extremes over all impacts, found by search."""

    sharp_edge: dict[str, float]
    """Least restitution at which the law adds energy, for each coin."""
    perfectly_rough: dict[str, float]
    """The same."""
    without_solution: dict[str, float]
    """Least friction with which sliding_friction has no solution, for each coin."""
    sliding_friction: list[float]
    """Least restitution at which the law adds energy to the thin ideal coin, for each of
    `FRICTIONS_OF_ONSETS`."""
    coulomb: list[float]
    """The same, with kinematic restitution."""


@dataclass(frozen=True, kw_only=True)
class ContactRecord:
    """What all laws did, and where each first fails."""

    count: int
    """Impacts for each law and restitution, a quarter of them of each coin."""
    seed: int
    laws: dict[str, LawRecord]
    onsets: Onsets
    share_without_solution: list[float]
    """Share of impacts for which sliding_friction has no solution, for each of
    `FRICTIONS_WITHOUT_SOLUTION`."""


def compute(progress: Progress, count: int = COUNT, seed: int = SEED) -> ContactRecord:
    """Try every law on random impacts, and search for the onsets.

    Args:
        progress: called after each part.
        count: impacts for each law and restitution.
        seed: of the draws and of the searches.
    """
    step = stepping(progress, len(LAWS) + 3 * len(COINS) + 2 * len(FRICTIONS_OF_ONSETS))
    rng = np.random.default_rng(seed)
    bodies = {name: body_of(name) for name in COINS}
    any_floor = rules_of("smooth")
    states = [draw_states(body, any_floor, count // len(COINS), rng) for body in bodies.values()]
    frictions = [rng.uniform(0, 1, len(drawn)) for drawn in states]
    impacts = [Drawn(*drawn) for drawn in zip(bodies.values(), states, frictions, strict=True)]
    laws = {name: step(record_of(rules_of(name), impacts)) for name in LAWS}

    def onsets_of(law: str) -> dict[str, float]:
        rules = rules_of(law)
        return {name: step(onset_of_gain(body, rules, 0.0, seed)) for name, body in bodies.items()}

    def onsets_with_friction(law: str) -> list[float]:
        thin, rules = bodies["thin ideal"], rules_of(law)
        return [step(onset_of_gain(thin, rules, mu, seed)) for mu in FRICTIONS_OF_ONSETS]

    sliding = rules_of("sliding_friction")
    onsets = Onsets(
        sharp_edge=onsets_of("sharp_edge"),
        perfectly_rough=onsets_of("perfectly_rough"),
        without_solution={
            name: step(onset_without_solution(body, sliding, seed)) for name, body in bodies.items()
        },
        sliding_friction=onsets_with_friction("sliding_friction"),
        coulomb=onsets_with_friction("coulomb, kinematic"),
    )
    unsolved = [
        1 - np.mean([strike(d.body, sliding, d.states, restitution=1.0, friction=mu)[1] for d in impacts])
        for mu in FRICTIONS_WITHOUT_SOLUTION
    ]
    return ContactRecord(
        count=count,
        seed=seed,
        laws=laws,
        onsets=onsets,
        share_without_solution=[float(share) for share in unsolved],
    )


def body_of(coin: str) -> Body:
    """Return one of `COINS`, without air."""
    thickness, center = COINS[coin]
    scenario = load("fig18_3d_ideal")
    return scenario.replace("coin.thickness", thickness, "coin.center_of_mass", center).body


def rules_of(name: str) -> Rules:
    """Return the rules of one of `LAWS`."""
    law, kind = LAWS[name]
    return load("fig18_3d_ideal").rules._replace(law=law, restitution_kind=kind)


@dataclass(frozen=True, eq=False)
class Drawn:
    """The impacts drawn for one coin."""

    body: Body
    states: Array
    friction: Array


def record_of(rules: Rules, drawn: list[Drawn]) -> LawRecord:
    """Try one law on the impacts drawn for each coin, at every restitution."""
    gains, changes, pulls, leaves, unsolved, needed = [], [], [], [], [], []
    for chi in RESTITUTIONS:
        tried = [strike(d.body, rules, d.states, restitution=chi, friction=d.friction) for d in drawn]
        flags = [raised_flags(impacts, d.friction) for (impacts, _), d in zip(tried, drawn, strict=True)]
        gains.append([raised[Flag.GAINS_ENERGY] for raised in flags])
        pulls.append(np.mean([raised[Flag.PULLS] for raised in flags]))
        leaves.append(np.mean([raised[Flag.LEAVES_CONE] for raised in flags]))
        unsolved.append(1 - np.mean([solved for _, solved in tried]))
        changes.append(np.concatenate([relative_change(impacts) for impacts, _ in tried]))
        needed.append(np.concatenate([friction_needed(impacts) for impacts, _ in tried]))
    every_needed = np.concatenate(needed)
    return LawRecord(
        gains=[float(np.mean(of_coins)) for of_coins in gains],
        gains_by_coin=[[float(np.mean(of_chi[i])) for of_chi in gains] for i in range(len(drawn))],
        median_gain=[
            _median(change[np.concatenate(gained)]) for change, gained in zip(changes, gains, strict=True)
        ],
        largest_change=[float(change.max()) for change in changes],
        pulls=[float(share) for share in pulls],
        leaves_cone=[float(share) for share in leaves],
        without_solution=[float(share) for share in unsolved],
        friction_sufficient=[float(np.mean(every_needed <= mu)) for mu in FRICTIONS_SUFFICIENT],
        friction_for_half=_quantile(every_needed, 0.5),
        friction_for_most=_quantile(every_needed, 0.95),
    )


def relative_change(impacts: Impacts) -> Array:
    """Return the change of the energy over the kinetic energy before, of impacts with C at height 0, (n,)."""
    return impacts.energy_change / (impacts.energy - impacts.energy_change)


def friction_needed(impacts: Impacts) -> Array:
    """Return |S_t|/S_z, the least μ whose cone holds the impulse, (n,); infinite where S_z <= 0."""
    along, up = np.hypot(impacts.impulse[:, 0], impacts.impulse[:, 1]), impacts.impulse[:, 2]
    return np.where(up > 0, along / np.where(up > 0, up, 1.0), math.inf)


def _median(values: Array) -> float | None:
    return float(np.median(values)) if len(values) else None


def _quantile(values: NDArray[Any], part: float) -> float | None:
    quantile = float(np.quantile(values, part, method="higher"))
    return quantile if math.isfinite(quantile) else None
