"""The branching: against a map whose f is known, against pairs of tosses, and what its dead parts hold."""

from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest

from cointoss_reproduction.precision import branching
from cointoss_reproduction.precision.branching import PARTS, branch, chances, expand, what_lies_there
from cointoss_reproduction.precision.double_double import exact, pair_of
from cointoss_reproduction.precision.planar_coin import planar_coin, units
from cointoss_reproduction.precision.planar_state import HEIGHT, release, spread
from cointoss_reproduction.precision.planar_toss import PlanarOutcomes, toss_many
from cointoss_reproduction.setups.planar_maps import case
from cointoss_reproduction.setups.uncertain_shares import uncertain_shares

LAST = 24
"""Digits of a release of the map."""
NO_COIN: Any = None
"""What is tossed by the map."""


def coin_of(chi, law="smooth"):
    scenario = case(air=False, restitution=chi).replace("floor.contact", law)
    return planar_coin(scenario), units(scenario)


def drawn(units, number, seed=1):
    rng = np.random.default_rng(seed)
    z, w = rng.uniform(0.2, 0.6, number), rng.uniform(20, 60, number)
    return np.array([release(units, height=a, spin=b) for a, b in zip(z, w, strict=True)])


def ends_at(digits):
    """Return where the map ends: at the first digit below 5, which is even for heads."""
    return next((n for n, digit in enumerate(digits) if digit < 5), len(digits) - 1)


def toss_by_digits(_coin, states, *, to_contact=False):
    """Toss by the map: each decade ends half of the tosses, and the others go on with more energy."""
    assert not to_contact
    found = []
    for state in states:
        number = int(exact(tuple(state[HEIGHT])) * 10**LAST)
        digits = [int(x) for x in f"{number:0{LAST}d}"[-LAST:]]
        end = ends_at(digits)
        found.append((1 + digits[end] % 2, number // 10 ** (LAST - 1 - end), 1.0 + end))
    outcome, itinerary, energy = (np.array(values) for values in zip(*found, strict=True))
    left = np.zeros(len(states))
    parted = itinerary[1:] != itinerary[:-1]
    left[1:][parted] = np.maximum(energy[1:], energy[:-1])[parted]
    nothing = np.zeros(len(states))
    return PlanarOutcomes(
        outcome=outcome.astype(np.int8),
        impacts=np.zeros(len(states), dtype=np.int64),
        itinerary=itinerary,
        contacts=np.zeros(len(states), dtype=np.int64),
        energy=nothing,
        from_upright=nothing,
        flattest=nothing,
        left=left,
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


def test_a_map_whose_share_is_known(monkeypatch):
    """f is exact at first; then it halves each decade but for 10^-k, so that α tends to log10 2."""
    monkeypatch.setattr(branching, "toss_many", toss_by_digits)
    found = []
    for seed in range(8):
        rng = np.random.default_rng(seed)
        starts = np.zeros((120, 5, 2))
        starts[:, HEIGHT, 0] = rng.uniform(0.1, 0.9, 120)
        starts[:, HEIGHT, 0] -= np.round(starts[:, HEIGHT, 0], 1) - rng.integers(0, 10, 120) / 10
        starts[:, HEIGHT, 0] %= 1
        made = branch(
            NO_COIN, starts, row=HEIGHT, largest=Fraction(1, 100), levels=16, population=40, rng=rng
        )
        assert np.all((made.parted <= made.energy) & (made.energy <= (LAST + 1) * made.parted))
        found.append(made.shares.mean(axis=0))
    shares, errors = np.mean(found, axis=0), np.std(found, axis=0, ddof=1) / len(found) ** 0.5
    known = [share_by_digits(k) for k in (2, 3, 4)]
    assert shares[:3] == pytest.approx(known, abs=4 * errors[:3].max())
    expected = known[2] / 2.0 ** np.arange(14)
    assert (np.abs(shares[2:] - expected) < 4 * errors[2:] + 0.02 * expected).all()
    assert (errors < 0.25 * shares).all()


def test_where_no_toss_parts_all_weight_is_in_dead_parts(monkeypatch):
    def toss_alike(coin, states):
        made = toss_by_digits(coin, states)
        return made._replace(
            outcome=np.ones_like(made.outcome),
            itinerary=np.zeros_like(made.itinerary),
            left=np.zeros_like(made.left),
        )

    monkeypatch.setattr(branching, "toss_many", toss_alike)
    made = branch(
        NO_COIN, np.zeros((20, 5, 2)), row=HEIGHT, largest=Fraction(1, 100), levels=4, population=5,
        rng=np.random.default_rng(0),
    )  # fmt: skip
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
    nothing = np.zeros(7, dtype=bool)
    monkeypatch.setattr(branching, "what_lies_there", lambda *_: (nothing, nothing))
    rng = Told(np.random.PCG64(1))
    rng.chances = []
    starts = np.zeros((120, 5, 2))
    starts[:, HEIGHT, 0] = rng.uniform(0.1, 0.9, 120)
    branch(
        NO_COIN, starts, row=HEIGHT, largest=Fraction(1, 100), levels=8, population=20, rng=rng, followed=7
    )
    first, *_, last = (np.unique(p[p > 0]) for p in rng.chances)
    assert len(rng.chances) == 8
    assert np.ptp(first) == pytest.approx(0)
    assert last[-1] > 1.5 * last[0]


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


@pytest.mark.parametrize(("chi", "law"), [(0.0, "smooth"), (0.6, "smooth"), (0.3, "perfectly_rough")])
def test_no_dead_part_holds_a_boundary(chi, law):
    """Parts of it, and parts of these, are tossed."""
    coin, own = coin_of(chi, law)
    rng, count = np.random.default_rng(5), 0
    parents = drawn(own, 150)
    for level in range(6):
        step = Fraction(1, 1000 * PARTS**level) / own.length
        made = expand(coin, parents, HEIGHT, step)
        low = made.points[:, :-1].reshape(-1, 5, 2)
        dead, living = low[~made.lives.ravel()], low[made.lives.ravel()]
        dead = dead[rng.permutation(len(dead))[:60]]
        count += len(dead)
        if len(dead):
            inside = expand(coin, dead, HEIGHT, step / PARTS)
            assert not inside.differs.any()
            finer = inside.points[:, :-1].reshape(-1, 5, 2)
            finer = finer[rng.permutation(len(finer))[:60]]
            assert not expand(coin, finer, HEIGHT, step / PARTS**2).differs.any()
        parents = living[rng.permutation(len(living))[:150]]
    assert count > 200


def test_branching_finds_the_shares_that_pairs_of_tosses_show():
    coin, own = coin_of(0.6)
    rng = np.random.default_rng(11)
    runs = []
    for seed in range(10):
        largest = Fraction(1, 1000) / own.length
        found = branch(
            coin, drawn(own, 100, seed=seed), row=HEIGHT, largest=largest, levels=7, population=40, rng=rng
        )
        runs.append(found.shares.mean(axis=0))
        whole = found.whole.mean(axis=0)
        assert whole[0] == pytest.approx(1)
        assert 0.5 < whole[-1] < 2
        assert (found.parted[:, 1:].sum(axis=0) > found.shares[:, 1:].sum(axis=0)).all()
    shares, errors = np.mean(runs, axis=0), np.std(runs, axis=0) / np.sqrt(9)
    starts = drawn(own, 3000, seed=12)
    for level in (0, 3, 6):
        step = pair_of(Fraction(1, 1000 * 10**level) / own.length)
        outcome = toss_many(coin, spread(starts, HEIGHT, step, 3)).outcome.reshape(-1, 3)
        uncertain = (outcome[:, 1] != outcome[:, 0]) | (outcome[:, 1] != outcome[:, 2])
        p = uncertain.mean()
        assert p * len(uncertain) > 20
        sigma = np.hypot(errors[level], np.sqrt(p / len(uncertain)))
        assert shares[level] == pytest.approx(p, abs=4 * sigma)
        assert sigma < 0.3 * p


def test_runs_agree_at_the_quantum_width():
    """Without any preference they scatter more."""
    scenario = case(air=False, restitution=0.6)
    runs = [
        uncertain_shares(scenario, np.random.default_rng([9, run]), levels=14, population=40)
        for run in range(8)
    ]
    found = [run.shares[:, -1].mean() for run in runs]
    assert 0.05 < np.log10(found).std() < 0.5


def test_boundaries_are_told_apart_by_what_the_coin_does_there():
    """A coin that lands flat at its first touch: the height at which either rim point is first."""
    coin, own = coin_of(0.6)
    rng = np.random.default_rng(3)
    found = uncertain_shares(case(air=False, restitution=0.6), rng, levels=4, population=30, followed=20)
    assert (found.boundaries.sum(axis=0) > 15).all()
    assert (found.flat.sum(axis=0) < 10).all()
    assert (found.flat <= found.boundaries).all()
    # Both kinds are met on a fine line of the paper's coin that bounces much.
    coin, own = coin_of(0.8)
    line = spread(drawn(own, 1, seed=2), HEIGHT, pair_of(Fraction(1, 10**5) / own.length), 3000)
    outcome = toss_many(coin, line).outcome
    low = line[:-1][outcome[1:] != outcome[:-1]][:100]
    stands, lands = what_lies_there(coin, low, HEIGHT, Fraction(1, 10**5) / own.length)
    assert not (stands & lands).any()
    assert stands.sum() > 0.7 * len(low)
    assert 0 < lands.sum() < 0.25 * len(low)
