"""Planar tosses in 106 bits and in intervals: against exact arithmetic, the engine, heyoka, each other."""

from fractions import Fraction

import numpy as np
import pytest
from flint import arb, ctx

from cointoss import analytic
from cointoss.analytic.contact.automaton import Event, Mode
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.models.records import Outcome
from cointoss_reproduction.precision import double_double, planar_state, planar_toss
from cointoss_reproduction.precision.certified import (
    PlanarRelease,
    certified_toss,
    outcome_within,
    proved_part,
)
from cointoss_reproduction.precision.double_double import add, pair_of, scale
from cointoss_reproduction.precision.magnified import magnify
from cointoss_reproduction.precision.planar_coin import planar_coin, units
from cointoss_reproduction.precision.planar_contact import keep_contact, nearest_upright
from cointoss_reproduction.precision.planar_flight import fly, room_for_series
from cointoss_reproduction.precision.planar_slide import slide
from cointoss_reproduction.precision.planar_state import (
    DRIFT,
    FALL,
    HEIGHT,
    SPIN,
    TILT,
    release,
    turned_within,
)
from cointoss_reproduction.precision.planar_toss import toss_many
from cointoss_reproduction.setups.planar_maps import case, planar_rows
from tests.helpers.contacts import follow_step as contact_step

pytestmark = pytest.mark.usefixtures("without_horizon")

COINS = [
    (0.6, False, "smooth"),
    (0.6, True, "smooth"),
    (0.3, False, "smooth"),
    (0.0, False, "smooth"),
    (0.3, True, "smooth"),
    (0.6, False, "perfectly_rough"),
    (0.2, False, "perfectly_rough"),
]


def scenario_of(chi, air=False, law="smooth"):
    return case(air=air, restitution=chi).replace("floor.contact", law)


def coin_of(chi, air=False, law="smooth"):
    scenario = scenario_of(chi, air, law)
    return planar_coin(scenario), units(scenario)


def drawn(units, number, seed=1):
    rng = np.random.default_rng(seed)
    z, w = rng.uniform(0.2, 0.6, number), rng.uniform(20, 60, number)
    return z, w, np.array([release(units, height=a, spin=b) for a, b in zip(z, w, strict=True)])


def error(pair, truth, size=None):
    """Return an error in parts of 2**104 of the size."""
    with_size = abs(truth) if size is None else arb(size)
    return float(abs(arb(pair[0]) + arb(pair[1]) - truth) / with_size) * 2.0**104


@pytest.fixture
def long_arithmetic(monkeypatch):
    monkeypatch.setattr(ctx, "prec", 300)


@pytest.mark.usefixtures("long_arithmetic")
def test_pairs_are_exact_to_104_bits():
    rng, worst = np.random.default_rng(1), 0.0
    for _ in range(200):
        a, b = (pair_of(Fraction(rng.normal() * 10) + Fraction(rng.normal() * 1e-17)) for _ in range(2))
        A, B = (arb(x[0]) + arb(x[1]) for x in (a, b))
        positive = a if a[0] > 0 else (-a[0], -a[1])
        sine, cosine = double_double.sine_cosine(a)
        small = (b[0] * 1e-5, 0.0)
        worst = max(
            worst,
            error(double_double.add(a, b), A + B),
            error(double_double.multiply(a, b), A * B),
            error(double_double.divide(a, b), A / B),
            error(double_double.square_root(positive), abs(A).sqrt()),
            error(sine, A.sin(), 1.0),
            error(cosine, A.cos(), 1.0),
            error(
                double_double.sine_minus_angle(small, double_double.sine_cosine(small)[0]),
                arb(small[0]).sin() - arb(small[0]),
            ),
        )
    assert 0 < worst < 8


@pytest.mark.parametrize(("chi", "air", "law"), COINS)
def test_outcomes_are_the_engines(chi, air, law):
    """Its own horizon ends some tosses before they are decided: of those that bounce little, none."""
    coin, own = coin_of(chi, air, law)
    z, w, starts = drawn(own, 300)
    found = toss_many(coin, starts)
    engine = analytic.toss_rows(planar_rows(scenario_of(chi, air, law), z, w)).outcome
    assert np.mean(found.outcome == engine) > 0.99
    assert 0.4 < np.mean(found.outcome == Outcome.HEADS) < 0.6
    assert found.contacts.sum() > 0


@pytest.mark.parametrize(("chi", "air", "law"), COINS)
def test_faces_are_proved_and_the_same(chi, air, law):
    coin, own = coin_of(chi, air, law)
    z, w, starts = drawn(own, 8 if air else 25, seed=2)
    found = toss_many(coin, starts).outcome
    proved = [
        certified_toss(coin, own, height=a, spin=b, most_bits=200).outcome for a, b in zip(z, w, strict=True)
    ]
    decided = [outcome != Outcome.UNDECIDED for outcome in proved]
    # Contact that lasts is proved to end for a smooth floor in vacuum only.
    assert sum(decided) >= (len(z) if law == "smooth" and not air else len(z) // 4)
    assert all(a == b for a, b, is_so in zip(proved, found, decided, strict=True) if is_so)


@pytest.mark.parametrize("air", [False, True])
def test_impacts_are_heyokas_to_the_last_digit_of_a_double(air):
    pytest.importorskip("heyoka", reason="heyoka has wheels for Linux on x86-64 only")
    from tests.helpers.extended import Extended

    scenario = scenario_of(0.6, air).replace("release.position.z", 0.43, "release.angular_velocity.xi", 37.0)
    coin, own = coin_of(0.6, air)
    known = certified_toss(coin, own, height=0.43, spin=37.0).impacts
    unit = scenario.coin.mass * np.sqrt(scenario.gravity * scenario.coin.radius)
    compared = 0
    for mine, theirs in zip(known, Extended(scenario).toss(), strict=False):
        assert mine.heads == theirs.heads
        assert float(mine.impulse) * unit == pytest.approx(theirs.impulse[2], rel=1e-13)
        compared += 1
    assert compared >= 6


def boundary(coin, own, digits):
    """Bisect the heights between two faces; return both ends, exact."""

    def face(height):
        return toss_many(coin, release(own, height=height, spin=41.0)[None]).outcome[0]

    low = Fraction(0.41)
    at_low = face(low)
    high = next(low + Fraction(k, 1000) for k in range(1, 30) if face(low + Fraction(k, 1000)) != at_low)
    while high - low > Fraction(10) ** -digits:
        middle = (low + high) / 2
        low, high = (middle, high) if face(middle) == at_low else (low, middle)
    return low, high


def test_both_sides_of_a_boundary_are_proved_at_1e_27_m():
    coin, own = coin_of(0.6)
    ends = boundary(coin, own, 27)
    tosses = [certified_toss(coin, own, height=height, spin=41.0) for height in ends]
    assert sorted(toss.outcome for toss in tosses) == [Outcome.HEADS, Outcome.TAILS]
    # One passes, the other does not reach, the upright coin's energy by little.
    for toss, height in zip(tosses, ends, strict=True):
        assert abs(float(toss.energy) - 1) < 1e-6
        pairs = toss_many(coin, release(own, height=height, spin=41.0)[None])
        assert pairs.energy[0] == pytest.approx(float(toss.energy), rel=1e-12)


@pytest.mark.parametrize(
    ("chi", "law"), [(0.0, "smooth"), (0.3, "smooth"), (0.6, "smooth"), (0.3, "perfectly_rough")]
)
def test_releases_within_a_proved_change_have_the_outcome_of_the_middle_one(chi, law):
    coin, own = coin_of(chi, law=law)
    rng, parts = np.random.default_rng(7), []
    for _ in range(6):
        middle = PlanarRelease(height=Fraction(rng.uniform(0.2, 0.6)), spin=Fraction(rng.uniform(20, 60)))
        change = PlanarRelease(height=Fraction(1, 1000), spin=Fraction(-1, 10), tilt=Fraction(1, 1000))
        parts.append(proved_part(coin, own, release=middle, change=change))
        at = [parts[-1] * Fraction(p) for p in (0, *rng.uniform(-1, 1, 40), 1, -1)]
        starts = [
            release(
                own, **{name: a + p * b for name, a, b in zip(middle._fields, middle, change, strict=True)}
            )
            for p in at
        ]
        assert len({*toss_many(coin, np.array(starts)).outcome}) == 1
    # Without restitution a rim point stays on the floor, which is proved of single releases only.
    assert sum(part > 0 for part in parts) >= (6 if chi else 1)


def test_no_outcome_is_proved_across_a_boundary():
    coin, own = coin_of(0.6)
    low, high = boundary(coin, own, 9)
    middle, half = PlanarRelease(height=(low + high) / 2, spin=Fraction(41)), (high - low) / 2
    for size in (1, 2, 10, 1000):
        change = PlanarRelease(height=size * half)
        assert outcome_within(coin, own, release=middle, change=change) == Outcome.UNDECIDED
    beside = PlanarRelease(height=low - 5000 * half, spin=Fraction(41))
    change = PlanarRelease(height=half)
    found = outcome_within(coin, own, release=beside, change=change)
    assert found == certified_toss(coin, own, height=beside.height, spin=41.0).outcome != Outcome.UNDECIDED


def test_releases_about_another_one_are_not_enclosed_in_air():
    coin, own = coin_of(0.6, air=True)
    with pytest.raises(ValueError, match="in vacuum only"):
        proved_part(coin, own, release=PlanarRelease(Fraction(1)), change=PlanarRelease(Fraction(1, 100)))


def test_contact_without_drag_in_air_is_that_in_vacuum():
    vacuum, own = coin_of(0.3)
    airless = vacuum._replace(in_air=True)
    _, _, starts = drawn(own, 300, seed=3)
    one, other = toss_many(vacuum, starts), toss_many(airless, starts)
    lasting = one.contacts > 0
    assert 2 <= lasting.sum() < 30
    assert (one.outcome == other.outcome).all()
    assert other.energy[lasting] == pytest.approx(one.energy[lasting], rel=1e-12)


def in_contact(coin, e, s, rises, drift=0.0):
    """Return the state of a coin in contact, of the energy e, whose mass centre is at the height s."""
    w = -np.sqrt(2 * (e - s) / (coin.inertia[0] + 1 - s * s)) * (1 if rises else -1)
    state, tilt = np.zeros((5, 2)), float(np.arcsin(-s))
    state[:, 0] = [-np.sin(tilt), -np.cos(tilt) * w, tilt, w, drift]
    return state


@pytest.mark.parametrize("rises", [True, False])
@pytest.mark.parametrize("e", [1.05, 1.3])
def test_contact_keeps_its_energy_and_ends_where_the_force_does(e, rises):
    coin, _ = coin_of(0.5)
    state = in_contact(coin, e, 0.2, rises)
    slid = state.copy()
    lifts, passes, corner, start = keep_contact(coin, state, 1.0)
    assert passes == (rises and e < 1 + coin.inertia[0] / 2)
    assert lifts == (rises and not passes)
    assert planar_state.energy(coin, state)[0] == pytest.approx(e, rel=1e-14)
    assert (start > 0) == lifts
    if lifts:
        # Free flight would neither press nor lift the point.
        assert state[HEIGHT, 0] * state[SPIN, 0] ** 2 == pytest.approx(1, rel=1e-12)
    airless = coin._replace(in_air=True)
    found = slide(airless, slid, 1.0)
    assert (found[0], found[1], found[2]) == (bool(lifts), passes, corner)
    assert slid[[HEIGHT, FALL, TILT, SPIN], 0] == pytest.approx(
        state[[HEIGHT, FALL, TILT, SPIN], 0], abs=1e-9
    )


def test_contact_in_air_is_the_engines():
    """A tilted coin that drifts falls flat."""
    scenario = scenario_of(0.3, air=True).replace("air.normal", 8.0).replace("air.tangential", 2.0)
    coin, own = planar_coin(scenario), units(scenario)
    tilt, spin, drift = -0.5, 0.3, 0.7
    length, second = float(own.length), np.sqrt(float(own.length / own.gravity))
    y = np.zeros(13)
    y[2], y[4], y[5] = np.array([-np.sin(tilt), drift / second, -np.cos(tilt) * spin / second]) * length
    y[6], y[7], y[10] = np.cos(tilt / 2), np.sin(tilt / 2), spin / second
    step = contact_step(scenario.body, FloorFriction(0.0), Mode.SLIDING, y, np.inf)
    while not step.is_over:
        step = contact_step(scenario.body, FloorFriction(0.0), Mode.SLIDING, y, step.next_dt)
    assert step.event == Event.FACE_LANDS
    state = np.zeros((5, 2))
    state[:, 0] = [-np.sin(tilt), -np.cos(tilt) * spin, tilt, spin, drift]
    assert slide(coin, state, 1.0)[:4] == (False, False, 1.0, True)
    assert state[SPIN, 0] / second == pytest.approx(y[10], rel=1e-6)
    assert state[DRIFT, 0] * length / second == pytest.approx(y[4], rel=1e-6)
    unhindered = np.sqrt(spin**2 + 2 * -np.sin(tilt) / (coin.inertia[0] + 1))
    assert state[SPIN, 0] < 0.99 * unhindered


def test_a_flight_in_air_follows_its_equations():
    """Energy falls by the drag's work; with no difference of the drags the height has a closed form."""
    coin, own = coin_of(0.6, air=True)
    alike = coin._replace(drag_difference=(0.0, 0.0))
    state = release(own, height=0.4, spin=40.0)
    height, spin = state[HEIGHT, 0], state[SPIN, 0]
    series = room_for_series()
    assert fly(alike, state, 0, 0.0, series) in (-1, 1)
    k, a = alike.slowing[0], alike.drag_mean[0]
    t = -np.log(state[SPIN, 0] / spin) / k
    fallen = (t - (1 - np.exp(-a * t)) / a) / a
    assert state[HEIGHT, 0] == pytest.approx(height - fallen, abs=1e-10)
    assert state[TILT, 0] == pytest.approx(spin * (1 - np.exp(-k * t)) / k, rel=1e-11)
    assert state[HEIGHT, 0] == pytest.approx(abs(np.sin(state[TILT, 0])), abs=1e-13)


def test_a_coin_that_lands_flat_touches_first_with_the_rim_point_that_is_lower():
    """The other one follows sooner than doubles of the time tell apart."""
    coin, own = coin_of(0.3, air=True)
    series = room_for_series()

    def touch(height):
        state = release(own, height=0.4, spin=40.0)
        state[HEIGHT] = height
        side = fly(coin, state, 0, 0.0, series)
        turned_within(state)
        return side, state

    low, high = pair_of(Fraction(18)), pair_of(Fraction(27))
    first, state = touch(low)
    assert touch(high)[0] != first
    for _ in range(90):
        middle = scale(add(low, high), 0.5)
        side, state = touch(middle)
        low, high = (middle, high) if side == first else (low, middle)
        gaps = state[HEIGHT, 0] + np.array([-1, 1]) * np.sin(state[TILT, 0])
        assert gaps.min() > -1e-28 - 1e-15 * abs(state[HEIGHT, 0])
    assert abs(state[TILT, 0]) < 1e-20


def test_a_coin_of_no_plane_is_refused():
    for field, value in (
        ("coin.thickness", 1e-3),
        ("air.exponent", 0.5),
        ("floor.contact", "coulomb"),
        ("floor.restitution_threshold", 0.01),
    ):
        scenario = case(air=True).replace(field, value)
        with pytest.raises(ValueError, match=f"{field}: .*, accepted: "):
            planar_coin(scenario)


def test_an_impact_limit_leaves_a_toss_undecided():
    coin, own = coin_of(0.6)
    _, _, starts = drawn(own, 20)
    found = planar_toss.toss_many(coin, starts, most_impacts=2)
    assert (found.outcome == Outcome.UNDECIDED).all()
    assert (found.impacts == 2).all()


def test_neighbours_diverge_with_the_energy_that_the_engine_finds():
    """Where the faces of the first touch differ already; the same toss does not."""
    coin, own = coin_of(0.6)
    scenario = scenario_of(0.6)
    mgr = scenario.body.mass * scenario.gravity * scenario.coin.radius
    heights = np.linspace(0.2, 0.6, 24)
    starts = np.array([release(own, height=z, spin=41.0) for z in heights])
    many = toss_many(coin, starts)
    tosses = [
        analytic.toss(
            scenario.replace("release.position.z", z).replace("release.angular_velocity.xi", 41.0)
        ).impacts
        for z in heights
    ]
    energies = np.array([impacts.energy[0] / mgr for impacts in tosses])
    other_face = np.diff([impacts.face[0] for impacts in tosses]) != 0
    larger = np.maximum(energies[1:], energies[:-1])
    assert other_face.sum() == 2
    assert many.left[1:][other_face] == pytest.approx(larger[other_face], rel=1e-9)
    assert (toss_many(coin, np.repeat(starts, 2, axis=0)).left[1::2] == 0).all()


@pytest.mark.parametrize(("air", "points"), [(False, 100), (True, 20)])
def test_a_boundary_is_magnified_until_it_is_alone_and_its_coin_stands(air, points):
    coin, own = coin_of(0.3, air)
    start = release(own, height=0.2, spin=41.0)
    seen = magnify(coin, start, row=HEIGHT, length=Fraction(2, 5) / own.length, windows=20, points=points)
    assert seen.counts[0] > 1
    assert seen.isolated_from is not None
    assert seen.isolated_from < 18
    off = seen.from_upright.max(axis=1)
    assert off[-1] < 1e-6
    assert off[-1] < 1e-3 * off[seen.isolated_from]
    with pytest.raises(ValueError, match="no boundary"):
        magnify(coin, start, row=HEIGHT, length=Fraction(1, 10**9), windows=1, points=3)


@pytest.mark.parametrize("excess", [0.1, 1e-3, 1e-12, -1e-12, -1e-3, -0.1])
@pytest.mark.parametrize("rises", [True, False])
def test_a_contact_is_as_near_to_standing_as_its_energy_and_its_course_say(excess, rises):
    """A coin that rises comes to its energy's difference from the upright; one that falls is as it was."""
    coin, _ = coin_of(0.3)
    s = 0.7
    state = in_contact(coin, 1 + excess, s, rises, drift=0.5)
    at_start = planar_state.from_upright(coin, state)
    assert at_start == pytest.approx(1 + excess - s + 1 - s)
    start, slid = state.copy(), state.copy()
    ends, passes, _, _ = keep_contact(coin, state, 1.0)
    assert passes == (rises and excess > 0)
    nearest = nearest_upright(coin, start, state, ends, passes)
    assert nearest == pytest.approx(abs(excess) if rises else at_start, rel=1e-3)
    airless = coin._replace(in_air=True)
    lifts, over, _, ended, near = slide(airless, slid, 1.0)
    assert (lifts, over, ended) == (False, passes, True)
    # Between steps of 0.05 the coin moves by e^(0.1) or less.
    assert nearest * 0.999 < near < 1.3 * nearest + 1e-15


@pytest.mark.parametrize("excess", [1e-3, 5e-7, 1e-12])
def test_a_coin_that_lifts_off_almost_upright_touches_again_soon(excess):
    """There the gap is nearly zero with three derivatives."""
    coin, _ = coin_of(0.0)
    state = in_contact(coin, 1 + coin.inertia[0] / 2 + excess, 0.2, rises=True)
    lifts, _, corner, start = keep_contact(coin, state, 1.0)
    assert lifts
    lifted = state.copy()
    series = room_for_series()
    assert fly(coin, state, int(corner), start, series) == corner
    turned = state[TILT, 0] - lifted[TILT, 0]
    # The gap is about v w² t³/6 - w⁴ t⁴/24, upright.
    assert abs(turned) == pytest.approx(4 * lifted[FALL, 0] / abs(lifted[SPIN, 0]), rel=0.05)
