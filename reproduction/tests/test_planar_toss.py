"""Planar tosses in long arithmetic: against the engine and closed forms."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from flint import arb, ctx

from cointoss import analytic
from cointoss.analytic.contact.automaton import Event, Mode
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.models.records import Outcome
from cointoss_reproduction.precision import planar_toss
from cointoss_reproduction.precision.magnified import magnify
from cointoss_reproduction.precision.planar_coin import PlanarRelease, planar_coin, units
from cointoss_reproduction.precision.planar_numbers import energy_left, spread, toss_many
from cointoss_reproduction.precision.planar_state import State, in_own_units, released
from cointoss_reproduction.precision.planar_toss import BITS, PlanarToss
from cointoss_reproduction.setups.planar_maps import case, planar_rows
from planar import coin_of, drawn, scenario_of
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


def toss_one(coin, own, height, spin=41.0):
    (toss,) = toss_many(coin, own, [PlanarRelease(Fraction(height), Fraction(spin))])
    return toss


@pytest.fixture
def long_arithmetic():
    with ctx.workprec(BITS):
        yield


@pytest.mark.slow_after_first
@pytest.mark.parametrize(("chi", "air", "law"), COINS)
def test_outcomes_are_the_engines(chi, air, law):
    """Its own horizon ends some tosses before they are decided: of those that bounce little, none."""
    coin, own = coin_of(chi, air, law)
    z, w, starts = drawn(150)
    found = toss_many(coin, own, starts)
    engine = analytic.toss_rows(planar_rows(scenario_of(chi, air, law), z, w)).outcome
    outcomes = np.array([toss.outcome for toss in found])
    assert np.mean(outcomes == engine) > 0.99
    assert 0.4 < np.mean(outcomes == Outcome.HEADS) < 0.6
    assert sum(len(toss.contacts) for toss in found) > 0


@pytest.mark.parametrize(("chi", "air", "law"), COINS)
def test_first_impacts_are_the_engines(chi, air, law):
    coin, own = coin_of(chi, air, law)
    scenario = scenario_of(chi, air, law).replace(
        "release.position.z", 0.43, "release.angular_velocity.xi", 37.0
    )
    theirs = analytic.toss(scenario).impacts[:4]
    unit = scenario.coin.mass * np.sqrt(scenario.gravity * scenario.coin.radius)
    mine = toss_one(coin, own, 0.43, 37.0).impacts[: len(theirs)]
    assert [2 - impact.heads for impact in mine] == theirs.face.tolist()
    impulses = [unit * float(impact.impulse) for impact in mine]
    assert impulses == pytest.approx(theirs.impulse[:, 2], rel=1e-9)


@pytest.mark.parametrize("law", ["smooth", "perfectly_rough"])
def test_bounces_that_are_passed_over_have_no_energy_to_lose(law, monkeypatch):
    """It is of second order in how short they are, 1e-20 m g r or less."""
    coin, own = coin_of(0.3, law=law)
    found = toss_many(coin, own, drawn(8)[2], to_contact=True)
    for name in ("CHATTERING", "CHATTERING_ROUGH"):
        monkeypatch.setattr(planar_toss, name, 1e-18)
    finer = toss_many(coin, own, drawn(8)[2], to_contact=True)
    for one, other in zip(found, finer, strict=True):
        assert len(one.impacts) < len(other.impacts)
        lost = one.impacts[-1].energy - other.impacts[-1].energy
        assert abs(float(lost)) < 1e-20


def test_air_that_is_not_linear_is_refused():
    with pytest.raises(ValueError, match=r"^air\.exponent: 0\.5, accepted: 0$"):
        planar_coin(case(air=True).replace("air.exponent", 0.5))


def in_contact(coin, e, s, rises):
    """Return the state of a coin in contact, of the energy e, whose mass centre is at the height s."""
    w = -((2 * (arb(e) - s) / (float(coin.inertia) + 1 - s * arb(s))).sqrt()) * (1 if rises else -1)
    tilt = (-arb(s)).asin()
    return State(z=arb(s), v=-tilt.cos() * w, tilt=tilt, w=w, u=arb(0))


@pytest.mark.usefixtures("long_arithmetic")
@pytest.mark.parametrize("rises", [True, False])
@pytest.mark.parametrize("excess", [0.3, 0.1, 0.05, 1e-3, 1e-12, -1e-12, -1e-3, -0.1])
def test_contact_is_followed_alike_by_its_closed_form_and_its_equations(excess, rises):
    """A coin that rises comes to its energy's difference from the upright; one that falls is as it was."""
    coin, _ = coin_of(0.5)
    e, s, flight = 1 + excess, 0.2, float(coin.inertia) / 2
    state, slid = (in_contact(coin, e, s, rises) for _ in range(2))
    toss, other = PlanarToss(coin), PlanarToss(coin._replace(in_air=True))
    at_start = toss.from_upright(state)
    assert at_start == pytest.approx(e - s + 1 - s)
    left, start = toss.contact(state, 1)
    followed, soon = other.contact(slid, 1)
    assert followed == left == ((1,) if rises and excess > flight else ())
    assert slid.heads == state.heads == (not (rises and 0 < excess < flight))
    for name in ("z", "v", "tilt", "w", "u"):
        assert float(getattr(slid, name)) == pytest.approx(float(getattr(state, name)), abs=1e-12), name
    if left:
        assert float(toss.energy(state)) == pytest.approx(e, rel=1e-14)
        assert float(soon) == pytest.approx(float(start) / 2)
        assert start > 0
        # Free flight would neither press nor lift the point.
        assert float(state.z * state.w**2) == pytest.approx(1, rel=1e-12)
    else:
        assert toss.nearest == pytest.approx(abs(excess) if rises else at_start, rel=1e-3)
        # Steps of up to 0.4 pass the nearest place by 0.2: there it is cosh(0.4)² times as far.
        assert toss.nearest * 0.999 < other.nearest < 1.3 * toss.nearest + 1e-15


@pytest.mark.usefixtures("long_arithmetic")
@pytest.mark.parametrize(("e", "s", "rises"), [(0.9, 0.5, True), (1.4, 0.6, True), (1.4, 0.6, False)])
def test_a_coin_rolls_on_a_rough_floor_until_it_would_be_pulled(e, s, rises):
    """The floor presses while 3 s² - 2 e s + J > 0; the energy of rolling is kept."""
    coin, _ = coin_of(0.5, law="perfectly_rough")
    J = float(coin.inertia)
    toss, tilt = PlanarToss(coin), (-arb(s)).asin()
    w = (2 * (arb(e) - s) / (J + 1)).sqrt() * (-1 if rises else 1)
    state = State(z=arb(s), v=-tilt.cos() * w, tilt=tilt, w=w, u=tilt.sin() * w)
    assert float(toss.energy(state)) == pytest.approx(e)
    rates, (_, _, force) = toss.rates([state.tilt, state.w, state.u], 1, True)
    assert float(force) == pytest.approx((3 * s * s - 2 * e * s + J) / (J + 1))
    assert float(rates[1]) == pytest.approx(float(tilt.cos()) / (J + 1))
    left, _ = toss.contact(state, 1)
    if e < 1:
        assert (left, state.heads) == ((), True)
    elif left:
        # It left with no more than its energy, where free flight would not press it.
        assert float(toss.energy(state)) <= e * (1 + 1e-12)


@pytest.mark.usefixtures("long_arithmetic")
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
    z, v = -np.sin(tilt), -np.cos(tilt) * spin
    state = State(z=arb(z), v=arb(v), tilt=arb(tilt), w=arb(spin), u=arb(drift))
    assert PlanarToss(coin).contact(state, 1) == ((), None)
    assert state.heads
    assert float(state.w) / second == pytest.approx(y[10], rel=1e-6)
    assert float(state.u) * length / second == pytest.approx(y[4], rel=1e-6)
    unhindered = np.sqrt(spin**2 + 2 * -np.sin(tilt) / (float(coin.inertia) + 1))
    assert float(state.w) < 0.99 * unhindered


@pytest.mark.usefixtures("long_arithmetic")
def test_a_flight_in_air_follows_its_equations():
    """With no difference of the drags the height has a closed form."""
    coin, own = coin_of(0.6, air=True)
    alike = coin._replace(drag_difference=Fraction(0))
    state = released(*in_own_units(own, PlanarRelease(Fraction(0.4), Fraction(40))))
    height, spin = float(state.z), float(state.w)
    assert PlanarToss(alike).fly(state, (), None) in (-1, 1)
    k, a = float(alike.slowing), float(alike.drag_mean)
    t = -np.log(float(state.w) / spin) / k
    fallen = (t - (1 - np.exp(-a * t)) / a) / a
    assert float(state.z) == pytest.approx(height - fallen, abs=1e-10)
    assert float(state.tilt) == pytest.approx(spin * (1 - np.exp(-k * t)) / k, rel=1e-11)
    assert float(state.z - abs(state.tilt.sin())) == pytest.approx(0, abs=1e-30)


@pytest.mark.usefixtures("long_arithmetic")
def test_a_coin_that_lands_flat_touches_first_with_the_rim_point_that_is_lower():
    """The other one follows sooner than doubles of the time tell apart."""
    coin, own = coin_of(0.3)
    toss = PlanarToss(coin)

    def touch(height):
        state = released(*in_own_units(own, PlanarRelease(height * own.length, Fraction(40))))
        side = toss.fly(state, (), None)
        toss.turn_within(state)
        return side, state

    low, high = Fraction(18), Fraction(27)
    first, state = touch(low)
    assert touch(high)[0] != first
    for _ in range(90):
        middle = (low + high) / 2
        side, state = touch(middle)
        low, high = (middle, high) if side == first else (low, middle)
        assert min(float(state.z + side * state.tilt.sin()) for side in (-1, 1)) > -1e-30
    assert abs(float(state.tilt)) < 1e-20


def test_neighbours_have_diverged_with_the_larger_energy_after_the_first_face_that_differs():
    coin, own = coin_of(0.6)
    one, other = (toss_one(coin, own, height) for height in (0.35, 0.38))
    turned = replace(one, impacts=(one.impacts[0]._replace(heads=True), *one.impacts[1:]))
    assert energy_left(one, one) == 0
    assert energy_left(one, turned) == float(one.impacts[0].energy)
    assert energy_left(one, other) == max(float(toss.impacts[0].energy) for toss in (one, other))


def test_an_impact_limit_leaves_a_toss_undecided(monkeypatch):
    monkeypatch.setattr(planar_toss, "MOST_IMPACTS", 2)
    coin, own = coin_of(0.6)
    for toss in toss_many(coin, own, drawn(20)[2]):
        assert toss.outcome == Outcome.UNDECIDED
        assert len(toss.impacts) == 2


def test_releases_are_spread_in_exact_steps_from_the_first():
    found = spread(PlanarRelease(Fraction(1, 3), Fraction(2)), "spin", Fraction(1, 10**25), 3)
    assert found == [PlanarRelease(Fraction(1, 3), 2 + Fraction(k, 10**25)) for k in range(3)]


@pytest.mark.slow
@pytest.mark.parametrize(("air", "points", "windows"), [(False, 24, 20), (True, 12, 12)])
def test_a_boundary_is_magnified_until_it_is_alone_and_its_coin_stands(air, points, windows):
    coin, own = coin_of(0.3, air)
    start = PlanarRelease(Fraction(0.2), Fraction(41))
    seen = magnify(coin, own, start, length=Fraction(2, 5), windows=windows, points=points)
    assert seen.counts[0] > 1
    assert seen.isolated_from is not None
    assert seen.isolated_from < windows - 2
    off = seen.from_upright.max(axis=1)
    assert off[-1] < 1e-6
    assert off[-1] < 1e-3 * off[seen.isolated_from]
    with pytest.raises(ValueError, match="no boundary"):
        magnify(coin, own, start, length=Fraction(1, 10**11), windows=1, points=3)


@pytest.mark.usefixtures("long_arithmetic")
@pytest.mark.parametrize("excess", [1e-3, 5e-7, 1e-12])
def test_a_coin_that_lifts_off_almost_upright_touches_again_soon(excess):
    """There the gap is nearly zero with three derivatives."""
    coin, _ = coin_of(0.0)
    toss, state = PlanarToss(coin), in_contact(coin, 1 + float(coin.inertia) / 2 + excess, 0.2, rises=True)
    left, start = toss.contact(state, 1)
    assert len(left) == 1
    tilt, expected = state.tilt, 4 * float(state.v / abs(state.w))
    assert toss.fly(state, left, start) == left[0]
    # The gap is about v w² t³/6 - w⁴ t⁴/24, upright.
    assert abs(float(state.tilt - tilt)) == pytest.approx(expected, rel=0.05)
