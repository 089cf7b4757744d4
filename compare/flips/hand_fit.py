"""The wobble of a hand that explains how often its coins show the first side, or that none does."""

import math
from dataclasses import asdict, dataclass, fields, replace
from os import PathLike
from typing import Any

import numpy as np

from cointoss.compare.fitting.errors import ObservationError
from cointoss.compare.flips.caught import caught, has_closed_form
from cointoss.compare.flips.counts import Flips
from cointoss.compare.flips.people import (
    SameSide,
    chance_of_spread,
    chances_of_shares,
    estimate_of,
    fit_people,
    spread_interval,
    wobbling,
)
from cointoss.compare.flips.table import read_flips
from cointoss.compare.flips.tossed import heads_along
from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import LEVEL, share_of
from cointoss.compare.output.language import entry_of
from cointoss.compare.sweep.errors import MOST_SEED, SweepError, require_whole
from cointoss.models.devices import Device
from cointoss.models.hand import Hand, load_hand
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.scenario import Scenario
from cointoss.models.writing import toml

LARGEST = math.pi / 2
"""The largest |90° - ψ| [rad]."""
ANGLES = np.linspace(0.0, LARGEST, 901)
"""Angles |90° - ψ| at which the likelihood of one person's counts is tried first [rad]."""
SIMULATED = 31
"""Angles at which a coin that bounces is tossed; between them its share is interpolated."""
TOSSES = 1000


@dataclass(frozen=True, kw_only=True)
class PersonFit:
    """What a person's counts say of ψ."""

    person: str
    share: Estimate
    """Share of flips with the side up that was up at the release; NaN without flips."""
    psi: Estimate
    """ψ from 0 to 90° [rad]; NaN where the interval has them all. Where the model cannot do what was counted
    it has no interval: the ends are NaN."""


@dataclass(frozen=True, kw_only=True)
class HandFit:
    """The wobble of a hand that explains counts of flips best."""

    flips: Flips
    people: tuple[PersonFit, ...]
    """What each person's counts say, in the order of the counts."""
    scatter: Estimate | None
    """Root of the mean square of 90° - ψ over people, |90° - ψ| being half-normal [rad]; None for one person.
    Its interval is as that of ψ."""
    hand: Hand
    """The hand as fitted, as `Hand.people` is; with its own ψ where it is one person's."""
    chances: dict[str, float]
    """How likely chance makes the right model miss by as much, by what is tested."""
    scenario: Scenario | None
    """The scenario whose coin it is; None for an ideal coin that is caught."""

    @property
    def p_value(self) -> float:
        """How likely chance makes the right model miss by as much in any of its tests."""
        return min(1.0, len(self.chances) * min(self.chances.values()))

    @property
    def is_possible(self) -> bool:
        """Whether such a hand can have made these counts."""
        return self.p_value >= 1 - LEVEL

    @property
    def verdict(self) -> str:
        """Whether the model can do what was counted, in words."""
        if self.is_possible:
            return f"this model can do what was counted: p = {self.p_value:.2g}"
        what = min(self.chances, key=self.chances.__getitem__)
        return f"this model cannot do what was counted with any psi: {what}, p = {self.p_value:.2g}"

    def __getitem__(self, person: str) -> PersonFit:
        """Return what was found for a person.

        Raises:
            KeyError: for another name.
        """
        return entry_of({one.person: one for one in self.people}, person)

    def __repr__(self) -> str:
        """Return the hand and the verdict."""
        return f"<HandFit: {self.hand.in_words}; {self.verdict}>"

    def as_dict(self) -> dict[str, Any]:
        """Return it in the form of `cointoss flips --json`, angles in rad; null stands for what is NaN."""
        counts = zip(self.people, self.flips.same.tolist(), self.flips.flips.tolist(), strict=True)
        return {
            "people": [
                {"person": one.person, "same": same, "flips": flips}
                | {"share": _ends(one.share), "psi": _ends(one.psi)}
                for one, same, flips in counts
            ],
            "scatter": self.scatter and _ends(self.scatter),
            "hand": asdict(self.hand),
            "chances": self.chances,
            "p_value": self.p_value,
            "possible": self.is_possible,
            "verdict": self.verdict,
            "scenario": self.scenario and self.scenario.as_tables(),
        }

    def hand_toml(self) -> str:
        """Return the file of the hand, with what is not as by default."""
        usual = {item.name: item.default for item in fields(Hand)}
        return toml({name: value for name, value in asdict(self.hand).items() if value != usual[name]})


def flips(
    counts: Flips | str | PathLike[str],
    scenario: ScenarioSource | None = None,
    *,
    hand: Hand | str | PathLike[str] | None = None,
    tosses: int = TOSSES,
    seed: int = 0,
    device: Device | str = Device.CPU,
) -> HandFit:
    """Find the wobble of a hand from how often its coins show the side that was up at the release.

        cointoss.flips("counts.csv")

    The counts determine each person's ψ, and its scatter over people: by a closed form for coins that are
    caught in vacuum after many turns, by tosses for others.

    Args:
        counts: how often each person's coin showed that side, or the path of a CSV file that has it.
        scenario: whose coin it is: a scenario, the path of its file, or a name such as "fig24a"; its own
            release is not used. Without one the coins are caught, and have two equal moments of inertia.
        hand: that tosses a scenario's coin, or the path of its file; its ψ is not used. By default `Hand()`;
            a coin that is caught in vacuum is tossed only with a hand.
        tosses: of a scenario's coin, for each of some 30 ψ.
        seed: for the tosses.
        device: that tosses a scenario's coin, as in `shares`.

    Raises:
        ObservationError: for a file or counts that can't be used.
        SweepError: for an option that can't be used.
        ScenarioError: for a scenario or a hand that can't be used.
    """
    require_whole("seed", seed, 0, MOST_SEED)
    seen = read_flips(counts) if isinstance(counts, str | PathLike) else counts
    if not isinstance(seen, Flips):
        raise ObservationError(f"counts: {seen!r}, accepted: Flips, or the path of a CSV file")
    described = None if scenario is None else scenario_of(scenario)
    is_closed = has_closed_form(described, hand)
    unused = {"hand": (hand, None), "tosses": (tosses, TOSSES), "device": (device, Device.CPU)}
    for name, (value, usual) in unused.items():
        if is_closed and value != usual:
            raise SweepError(
                f"`{name}` {value}: accepted: only with a scenario whose coin is tossed, "
                "or is caught in vacuum, given a `hand`"
            )
    usual = Hand() if hand is None else hand if isinstance(hand, Hand) else load_hand(hand)
    if usual.spun:
        raise SweepError(
            "hand.spun = True: accepted: false, or counts of heads, for an offset of the mass centre"
        )
    side = (
        caught(described)
        if described is None or is_closed
        else simulated(described, usual, tosses, seed, device)
    )
    return _hand_fit(seen, described, usual, side, seed)


def _hand_fit(counts: Flips, scenario: Scenario | None, usual: Hand, side: SameSide, seed: int) -> HandFit:
    """Return the hand that explains counts of a side as likely as `side` says."""
    each = tuple(
        PersonFit(
            person=name,
            share=share_of(same, count, "flips"),
            psi=_psi_of(estimate_of(same, count, side, ANGLES)),
        )
        for name, same, count in zip(counts.people, counts.same.tolist(), counts.flips.tolist(), strict=True)
    )
    chances, scatter = chances_of_shares(counts, side.probability(ANGLES)), None
    psi = each[0].psi.value
    fitted = replace(usual, psi=usual.psi if math.isnan(psi) else psi, psi_scatter=0.0)
    if len(each) > 1:
        people = fit_people(counts, wobbling(side))
        low, high = spread_interval(counts, people)
        scatter = Estimate(float(people.parameters[0]), float(low), float(high), len(each), "people")
        fitted = replace(usual, psi=math.pi / 2, psi_scatter=scatter.value)
        chances["people differ too much"] = chance_of_spread(counts, people, np.random.default_rng(seed))
    found = HandFit(
        flips=counts, people=each, scatter=scatter, hand=fitted, chances=chances, scenario=scenario
    )
    return found if found.is_possible else _without_intervals(found)


def simulated(scenario: Scenario, hand: Hand, tosses: int, seed: int, device: Device | str) -> SameSide:
    """Return how likely the first side comes up for a hand's tosses of a scenario, by |90° - ψ|.

    Each toss begins with heads up.

    Args:
        scenario: whose coin is tossed, until it rests or is caught.
        hand: that tosses, but for its ψ.
        tosses: of each angle.
        seed: of the releases.
        device: that tosses.
    """
    flat = replace(hand, up="heads", psi_scatter=0.0)
    values = (0.0, LARGEST, SIMULATED)
    psi, share, behind = heads_along(scenario, "hand.psi", values, flat, tosses, seed, device)
    return SameSide(lambda off: np.interp(off, LARGEST - psi[::-1], share[::-1]), behind)


def _psi_of(off: Estimate) -> Estimate:
    """Return ψ of |90° - ψ| [rad]."""
    return replace(off, value=LARGEST - off.value, low=LARGEST - off.high, high=LARGEST - off.low)


def _without_intervals(found: HandFit) -> HandFit:
    """Return a fit of a model that cannot be right: no value of it is the true one."""

    def bare(one: Estimate) -> Estimate:
        return replace(one, low=math.nan, high=math.nan)

    people = tuple(replace(one, psi=bare(one.psi)) for one in found.people)
    return replace(found, people=people, scatter=found.scatter and bare(found.scatter))


def _ends(one: Estimate) -> dict[str, float]:
    return {"value": one.value, "low": one.low, "high": one.high}
