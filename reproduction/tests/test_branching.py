"""The branching: against a map whose f is known, against pairs of tosses, and what its dead parts hold."""

from fractions import Fraction
from itertools import cycle, pairwise, product
from typing import Any

import numpy as np
import pytest

from cointoss import analytic
from cointoss.models.records import Outcome
from cointoss_reproduction.precision import branching
from cointoss_reproduction.precision.branching import PARTS, branch, chances, expand, what_lies_there
from cointoss_reproduction.precision.planar_coin import PlanarRelease
from cointoss_reproduction.precision.planar_numbers import Toss, spread, toss_many
from cointoss_reproduction.precision.planar_state import Impact
from cointoss_reproduction.setups.planar_maps import case, planar_rows
from cointoss_reproduction.setups.uncertain_shares import share_at, uncertain_shares
from planar import coin_of, drawn

LAST = 24
"""Digits of a release of the map."""
NO_COIN: Any = None
"""What is tossed by the map."""


def ends_at(digits):
    """Return where the map ends: at the first digit below 5, which is even for heads."""
    return next((n for n, digit in enumerate(digits) if digit < 5), len(digits) - 1)


def toss_by_digits(_coin, _units, releases, *, to_contact=False):
    """Toss by the map: each decade ends half of the tosses, and the others go on with more energy."""
    assert not to_contact
    return [by_digits(release) for release in releases]


def by_digits(release):
    number = int(release.height * 10**LAST)
    digits = [int(x) for x in f"{number:0{LAST}d}"[-LAST:]]
    end = ends_at(digits)
    return tossed(Outcome(1 + digits[end] % 2), number // 10 ** (LAST - 1 - end), 1.0 + end)


def tossed(outcome, itinerary, energy):
    """Return a toss of one impact that parts from all of another itinerary."""
    return Toss(
        outcome=outcome,
        impacts=(Impact(heads=True, corner=1, impulse=0, state=(itinerary, 0, 0), energy=energy),),
        contacts=(),
        from_upright=0.0,
        flattest=0.0,
    )


def share_by_digits(decades):
    """Return f at 10^-decades: three neighbours share all digits that follow, of which 3 in 5 are heads."""

    def outcome(number, after):
        digits = [int(x) for x in f"{number % 10**decades:0{decades}d}"]
        end = ends_at(digits)
        return digits[end] % 2 if digits[end] < 5 else after

    total = 0.0
    for number, (after, chance) in product(range(10**decades), ((0, 0.6), (1, 0.4))):
        here = outcome(number, after)
        total += chance * (here != outcome(number - 1, after) or here != outcome(number + 1, after))
    return total / 10**decades


def branched(heights, rng, **sizes):
    starts = [PlanarRelease(Fraction(z)) for z in heights]
    return branch(NO_COIN, NO_COIN, starts, quantity="height", largest=Fraction(1, 100), rng=rng, **sizes)


@pytest.mark.slow
def test_a_map_whose_share_is_known(monkeypatch):
    """f is exact at first; then it halves each decade but for 10^-k, so that α tends to log10 2."""
    monkeypatch.setattr(branching, "toss_many", toss_by_digits)
    found = []
    for seed in range(8):
        rng = np.random.default_rng(seed)
        heights = rng.uniform(0.1, 0.9, 120)
        heights -= np.round(heights, 1) - rng.integers(0, 10, 120) / 10
        made = branched(heights % 1, rng, levels=16, population=40)
        assert np.all((made.parted <= made.energy) & (made.energy <= (LAST + 1) * made.parted))
        found.append(made.shares.mean(axis=0))
    shares, errors = np.mean(found, axis=0), np.std(found, axis=0, ddof=1) / len(found) ** 0.5
    known = [share_by_digits(k) for k in (2, 3, 4)]
    assert shares[:3] == pytest.approx(known, abs=4 * errors[:3].max())
    expected = known[2] / 2.0 ** np.arange(14)
    assert (np.abs(shares[2:] - expected) < 4 * errors[2:] + 0.02 * expected).all()
    assert (errors < 0.25 * shares).all()


def test_where_no_toss_parts_all_weight_is_in_dead_parts(monkeypatch):
    def toss_alike(_coin, _units, releases):
        return [tossed(Outcome.HEADS, 0, 1.0) for _ in releases]

    monkeypatch.setattr(branching, "toss_many", toss_alike)
    made = branched(np.zeros(20), np.random.default_rng(0), levels=4, population=5)
    assert made.whole == pytest.approx(1)
    assert not made.shares.any()


class Told(np.random.Generator):
    """Keeps the chances of what is drawn."""

    chances: list[np.ndarray]

    def choice(self, *given: Any, **chances: Any) -> Any:
        self.chances.append(chances["p"])
        return super().choice(*given, **chances)


def test_boundaries_are_drawn_by_weight(monkeypatch):
    """A part has the weight of one over the chances by which it came so far, and no two have the same."""
    monkeypatch.setattr(branching, "toss_many", toss_by_digits)
    answers = cycle([(True, False), (True, False), (False, True), (False, False)])
    monkeypatch.setattr(branching, "what_lies_there", lambda *_: next(answers))
    rng = Told(np.random.PCG64(1))
    rng.chances = []
    made = branched(rng.uniform(0.1, 0.9, 120), rng, levels=8, population=20, followed=8)
    first, *_, last = (np.unique(p[p > 0]) for p in rng.chances)
    assert len(rng.chances) == 8
    assert np.ptp(first) == pytest.approx(0)
    assert last[-1] > 1.5 * last[0]
    assert made.boundaries.sum(axis=0).tolist() == [6] * 8
    assert made.flat.sum(axis=0).tolist() == [2] * 8
    assert (made.flat <= made.boundaries).all()


@pytest.mark.parametrize(
    ("scores", "population"),
    [
        ([1.0, 1.0, 1.0, 1.0], 2),
        ([9.0, 1.0, 1.0, 1.0], 2),
        ([1.0, 2.0], 5),
        ([5.0, 4.0, 1e-9, 1e-9, 1e-9], 3),
    ],
)
def test_chances_sum_to_the_population_and_follow_the_scores(scores, population):
    found = chances(np.array(scores), population)
    assert found.sum() == pytest.approx(min(population, len(scores)))
    assert (found <= 1).all()
    below = found < 1
    assert np.ptp(found[below] / np.array(scores)[below]) == pytest.approx(0) if below.any() else True


@pytest.mark.slow
@pytest.mark.parametrize(("chi", "law", "intervals"), [(0.0, "smooth", 60), (0.3, "perfectly_rough", 8)])
def test_no_dead_part_holds_a_boundary(chi, law, intervals):
    """Parts of it, and parts of these, are tossed."""
    coin, own = coin_of(chi, law=law)
    rng, count, parents = np.random.default_rng(5), 0, drawn(intervals)[2]

    def some(releases, most):
        return [releases[i] for i in rng.permutation(len(releases))[:most]]

    for level in range(6):
        step = Fraction(1, 1000 * PARTS**level)
        made = [expand(coin, own, "height", step, parent) for parent in parents]
        parts = [pair for one in made for pair in zip(one.points[:-1], one.lives, strict=True)]
        dead = some([low for low, lives in parts if not lives], 4)
        count += len(dead)
        for part in dead:
            inside = expand(coin, own, "height", step / PARTS, part)
            (finer,) = some(inside.points[:-1], 1)
            assert not inside.differs.any()
            assert not expand(coin, own, "height", step / PARTS**2, finer).differs.any()
        parents = some([low for low, lives in parts if lives], intervals)
    assert count > 15


def test_runs_agree_down_to_an_atoms_size_with_each_other_and_with_pairs_of_tosses():
    """Without any preference they scatter more."""
    scenario = case(air=False, restitution=0.6)
    runs = [
        uncertain_shares(scenario, np.random.default_rng([9, run]), levels=7, population=20)
        for run in range(5)
    ]
    assert 0.05 < np.std([np.log10(run.shares[:, -1].mean()) for run in runs]) < 0.5
    shares, whole = (np.concatenate([getattr(run, name) for run in runs]) for name in ("shares", "whole"))
    z, w, _ = drawn(20_000)
    for level in (0, 3, 6):
        found, step = share_at(shares, whole, level), 1e-3 / 10**level
        lower, middle, higher = (
            analytic.toss_rows(planar_rows(scenario, z + by, w)).outcome for by in (-step, 0, step)
        )
        assert found.low < np.mean((lower != middle) | (higher != middle)) < found.high


@pytest.mark.slow
def test_boundaries_are_told_apart_by_what_the_coin_does_there():
    """Both kinds are met on a fine line of the paper's coin that bounces much.

    A coin that lands flat at its first touch: the height at which either rim point is first.
    """
    coin, own = coin_of(0.8)
    step = Fraction(1, 10**5)
    line = spread(drawn(1, seed=2)[2][0], "height", step, 25)
    tosses = toss_many(coin, own, line)
    changes = [n for n, (one, other) in enumerate(pairwise(tosses)) if one.outcome != other.outcome]
    stands, lands = np.array([what_lies_there(coin, own, "height", step, line[n]) for n in changes]).T
    assert not (stands & lands).any()
    assert stands.sum() > 0.7 * len(changes)
    assert 0 < lands.sum() < 0.25 * len(changes)
