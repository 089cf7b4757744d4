"""A contact law of one's own: as the named laws where it is one of them, a superball, and what is refused."""

# ruff: noqa: ARG001

import math
import pickle
import tomllib
from pathlib import Path

import numba
import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.analytic import OwnLaw, solve
from cointoss.analytic.entries import strike_each
from cointoss.analytic.flight.state_vector import STATE_SIZE
from cointoss.analytic.horizon.touch_derivatives import touch_derivatives
from cointoss.analytic.impact import own_law
from cointoss.analytic.impact.own_law import rules_by
from cointoss.models.batch import rows_of, scenario_of_row
from cointoss.models.certificate import IMPACT_ENERGY, LAW
from cointoss.models.making import MOST_LOSSLESS
from cointoss.models.records import IMPACT_ROW, Ending, Outcome, UnsupportedError
from tests.helpers.draws import THIN, draw_coin, draw_release, scenario
from tests.helpers.own_laws import (
    FREE,
    NAMED,
    REFUSED,
    of,
    perfectly_rough,
    smooth,
    superball,
)

GAINED = "impacts: energy that this law adds, in all"


@pytest.fixture(scope="module", params=NAMED, ids=lambda law: law.__name__)
def same(request):
    """A law that is a named one."""
    return OwnLaw(request.param, **NAMED[request.param])


@pytest.mark.slow_after_first
def test_a_named_law_written_again_gives_the_same_tosses_to_the_bit(same):
    rng = np.random.default_rng(42)
    for number in range(12):
        floor = {"restitution": 0.7, "contact": same.name, "friction": 0.2 if "friction" in same.name else 0}
        case = scenario(
            coin=draw_coin(rng),
            floor={**floor, "restitution_threshold": 0.05 * (number % 2)},
            release=draw_release(rng),
        )
        named, own = analytic.toss(case), analytic.toss(case, law=same)
        n = (
            int(np.sum(named.impacts.time < named.contacts[0, 0]))
            if len(named.contacts)
            else len(named.impacts)
        )
        n = min(n, len(own.impacts))
        for column in ("time", "impulse", "angular_velocity_after"):
            assert np.array_equal(getattr(named.impacts, column)[:n], getattr(own.impacts, column)[:n])
        assert n >= 3
        assert min(own.trusted_impacts, n) == min(named.trusted_impacts, n)
        assert of(own, LAW) < 1e-12
        assert own.ending in (Ending.SETTLED, Ending.PAPER, Ending.CHATTER)
        assert len(own.contacts) == 0


def along_the_edge(K, v_A, tau, chi, mu):
    return solve(K, (1e-3 * v_A[2] * tau[0], 1e-3 * v_A[2] * tau[1], -(1 + chi) * v_A[2]))


def test_the_certificate_asks_the_law_what_the_engine_has_asked():
    """The edge has two directions; a coin that lands flat takes the engine's own impulse."""
    law = OwnLaw(along_the_edge, **FREE)
    tilted = scenario(release={"position": [0, 0, 0.4], "angles": [0.3, 0.5, 0.2]}, ending={"max_impacts": 2})
    assert of(analytic.toss(tilted, law=law), LAW) < 1e-12
    flat = analytic.toss(tilted.replace("release.angles", [0, 0, 0]), law=law)
    v = flat.impacts.velocity_before[0, 2]
    assert flat.impacts.impulse[0] == pytest.approx([0, 0, -1.8 * flat.scenario.coin.mass * v])
    assert of(flat, LAW) < 1e-12


def test_a_toss_by_a_law_is_given_up_as_where_impacts_may_take_no_energy():
    floor = {"restitution": 0.5, "contact": "coulomb", "friction": 0.3}
    law, case = OwnLaw(smooth), scenario(floor=floor)
    assert case.rules.max_impacts > MOST_LOSSLESS
    assert rules_by(law, case).max_impacts == MOST_LOSSLESS
    assert rules_by(law, case.replace("ending.max_impacts", 7)).max_impacts == 7


def test_only_a_law_that_may_not_add_energy_settles_a_face():
    settled, may_add = (
        analytic.toss("fig24a", law=OwnLaw(smooth, may_add_energy=may)) for may in (False, True)
    )
    assert (settled.outcome, settled.ending) == (Outcome.HEADS, Ending.SETTLED)
    assert (may_add.outcome, may_add.ending) == (Outcome.HEADS, Ending.PAPER)
    assert np.array_equal(settled.impacts.time, may_add.impacts.time)


def test_many_tosses_are_those_of_one(same):
    case = cointoss.load("fig24a").replace("floor.friction", 0.2, "floor.contact", "sliding_friction")
    rows = rows_of(case, 8, {"release.angular_velocity.eta": np.linspace(20, 40, 8)})
    outcomes = analytic.toss_rows(rows, law=same, trust="certain")
    assert outcomes.trusted_impacts is not None
    assert outcomes.outcome_certain is not None
    for i in range(8):
        toss = analytic.toss(scenario_of_row(rows[i]), law=same)
        assert (outcomes.outcome[i], outcomes.ending[i]) == (toss.outcome, toss.ending)
        assert outcomes.impacts[i] == len(toss.impacts)
        assert outcomes.trusted_impacts[i] == toss.trusted_impacts
        assert bool(outcomes.outcome_certain[i]) == toss.outcome_certain


def wheel(speed, spin, **floor):
    """A thin coin upright that turns about its normal as it falls: below C touches A, and K is diagonal."""
    return scenario(
        coin=THIN,
        floor={"restitution": 1.0, "contact": "smooth", **floor},
        release={
            "position": [0.0, 0.0, 0.3],
            "velocity": [speed, 0.0, 0.0],
            "quaternion": [math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0],
            "angular_velocity": [0.0, 0.0, spin],
        },
        ending={"max_impacts": 12},
    )


ALPHA = 0.5
"""J/(m r²) of a coin about its normal."""


def test_two_bounces_of_a_superball_give_back_speed_and_spin():
    """Garwin, Am. J. Phys. 37 (1969) 88: v_A is reversed, and so is what that did by the next bounce."""
    case, r = wheel(0.3, 70.0), THIN["radius"]
    toss = analytic.toss(case, law=OwnLaw(superball(1, 1), **FREE))
    impacts = toss.impacts
    assert len(impacts) == 12
    before = impacts.contact_velocity_before
    assert impacts.contact_velocity_after == pytest.approx(-before, abs=1e-13)
    # ω about ζ, which lies along -y: at A below C it is -r ω along x.
    slip = 0.3 - r * impacts.angular_velocity_before[0, 2] * np.sign(0.3 - before[0, 0])
    assert before[0, 0] == pytest.approx(slip, rel=1e-12)
    speeds = [0.3, 0.3 - 2 * ALPHA / (1 + ALPHA) * slip]
    assert impacts.velocity_before[:, 0] == pytest.approx(np.tile(speeds, 6), abs=1e-12)
    assert np.ptp(impacts.angular_velocity_before[::2, 2]) < 1e-11
    assert impacts.energy == pytest.approx(impacts.energy[0], rel=1e-13)
    assert of(toss, GAINED) < 1e-12


def test_a_superball_without_angular_momentum_about_its_spot_hops_to_and_fro():
    r, g = THIN["radius"], 9.81
    spin = 60.0
    # m r v = J ω about A, in the sense in which ω slips forward: both turn round at every bounce.
    for sense in (1, -1):
        toss = analytic.toss(
            wheel(sense * ALPHA * r * spin, sense * spin), law=OwnLaw(superball(1, 1), **FREE)
        )
        x = toss.impacts.position[:, 0]
        if abs(toss.impacts.velocity_after[0, 0] + toss.impacts.velocity_before[0, 0]) < 1e-12:
            break
    hop = 2 * np.sqrt(2 * (0.3 - r) / g) * abs(ALPHA * r * spin)
    assert np.diff(x) == pytest.approx(-np.sign(x[0]) * hop * np.tile([1, -1], 6)[:11], abs=1e-12)


@pytest.mark.slow_after_first
@pytest.mark.parametrize(("along", "up"), [(0.76, 0.9), (0.0, 0.9), (-1.0, 0.8), (1.0, 0.5)])
def test_what_each_bounce_leaves_of_the_slip_and_of_the_height_is_a_power(along, up):
    """v_At' = -along v_At, v_Az' = -up v_Az; without slip, along = -1, nothing is changed of it."""
    toss = analytic.toss(wheel(0.3, 70.0, restitution=0.9), law=OwnLaw(superball(along, up), **FREE))
    before = toss.impacts.contact_velocity_before
    n = np.arange(len(before))
    assert len(n) == 12
    assert before[:, 0] == pytest.approx(before[0, 0] * (-along) ** n, abs=1e-12)
    assert before[:, 2] == pytest.approx(before[0, 2] * up**n, rel=1e-10)
    assert of(toss, LAW) < 1e-12


@pytest.mark.parametrize("chi", [1.0, 0.6])
def test_what_gives_back_one_part_of_all_of_the_velocity_adds_no_energy_to_any_coin(chi):
    """The change is -(1 - χ²)/2 v_A · K⁻¹ v_A: none at χ = 1."""

    def law(K, v_A, tau, chi, mu):
        return solve(K, (-(1 + chi) * v_A[0], -(1 + chi) * v_A[1], -(1 + chi) * v_A[2]))

    own, rng = OwnLaw(law, may_pull=True), np.random.default_rng(7)
    for _ in range(5):
        case = scenario(
            coin=draw_coin(rng),
            floor={"restitution": chi, "contact": "smooth"},
            release=draw_release(rng),
            ending={"max_impacts": 20},
        )
        toss = analytic.toss(case, law=own)
        assert len(toss.impacts) >= 3
        change = toss.impacts.energy_change / toss.impacts.energy
        assert change.max() < 1e-12
        if chi == 1:
            assert np.abs(change).max() < 1e-12
        assert of(toss, IMPACT_ENERGY) < 1e-11


def gains_when_fast(K, v_A, tau, chi, mu):
    size = -(1 + chi) * v_A[2] / K[2][2]
    return 0.0, 0.0, size * 2.5 if v_A[2] < -20 else size


def test_a_law_that_breaks_a_condition_outside_the_sample_ends_the_toss_at_that_impact():
    fast = scenario(release={"position": [0, 0, 1.0], "velocity": [0, 0, -25.0], "angles": [0, 0.5, 0]})
    toss = analytic.toss(fast, law=OwnLaw(gains_when_fast))
    assert (toss.outcome, toss.ending, len(toss.impacts)) == (Outcome.UNDECIDED, Ending.NO_SOLUTION, 0)
    assert of(toss, REFUSED).startswith("adds ")
    assert "v_A = (0, " in of(toss, REFUSED)
    allowed = analytic.toss(
        fast.replace("ending.max_impacts", 3), law=OwnLaw(gains_when_fast, may_add_energy=True)
    )
    assert len(allowed.impacts) == 3
    weight = fast.coin.mass * fast.gravity * fast.coin.radius
    gained = allowed.impacts.energy_change[allowed.impacts.energy_change > 0].sum() / weight
    assert gained > 100
    assert of(allowed, GAINED) == pytest.approx(gained, rel=1e-12)


def fails_when_fast(K, v_A, tau, chi, mu):
    if v_A[2] < -20:
        raise ValueError
    return 0.0, 0.0, -(1 + chi) * v_A[2] / K[2][2]


def test_an_error_in_a_compiled_law_ends_the_toss_with_no_number():
    fast = scenario(release={"position": [0, 0, 1.0], "velocity": [0, 0, -25.0], "angles": [0, 0.5, 0]})
    toss = analytic.toss(fast, law=OwnLaw(fails_when_fast))
    assert (toss.ending, len(toss.impacts)) == (Ending.NO_SOLUTION, 0)
    assert of(toss, REFUSED).startswith("S = (nan, nan, nan) at K = ")


def adds(K, v_A, tau, chi, mu):
    return 0.0, 0.0, -2.5 * v_A[2] / K[2][2]


@pytest.mark.parametrize("name", ["may_pull", "may_add_energy"])
def test_what_a_law_may_do_is_true_or_false(name):
    with pytest.raises(TypeError, match=f"^{name}: of type str, accepted: True or False$"):
        OwnLaw(smooth, **{name: "no"})  # pyright: ignore[reportArgumentType]


def test_a_law_may_call_other_functions_that_numba_compiles():
    decorated = numba.njit(not_decorated)

    def law(K, v_A, tau, chi, mu):
        return 0.0, 0.0, -decorated(chi) * v_A[2] / K[2][2]

    assert analytic.toss("fig24a", law=OwnLaw(law)).sequence == analytic.toss("fig24a").sequence


def test_a_law_refused_for_its_energy_is_taken_where_that_is_asked_for():
    assert OwnLaw(adds, may_add_energy=True).may_add_energy
    with pytest.raises(ValueError, match=r"^law perfectly_rough: adds "):
        OwnLaw(perfectly_rough, may_pull=True)


def not_decorated(chi):
    return 1 + chi


NO_LAWS = tomllib.loads(Path(__file__).with_name("refused_laws.toml").read_text(encoding="utf-8"))


@pytest.mark.slow_after_first
@pytest.mark.parametrize("law", NO_LAWS)
def test_what_breaks_a_condition_or_is_no_law_is_refused_in_one_line_when_it_is_made(law):
    found = {"math": math, "np": np, "calls": [0.0], "not_decorated": not_decorated, "solve": solve}
    exec(f"def {law}", found)
    with pytest.raises((ValueError, TypeError), match=f"^law law: {NO_LAWS[law]}") as raised:
        OwnLaw(found["law"])  # pyright: ignore[reportArgumentType]
    assert "\n" not in str(raised.value)
    assert isinstance(raised.value, TypeError) == NO_LAWS[law].startswith(("takes", "returns"))


@pytest.mark.parametrize("law", [3, math.hypot])
def test_what_is_no_function_in_python_is_no_law(law):
    with pytest.raises(TypeError, match=r"^law: of type \w+, accepted: a function \(K, v_A, tau, chi, mu\) "):
        OwnLaw(law)


def test_a_law_that_depends_on_more_than_its_arguments_is_found_out():
    """Compiled, a law keeps the numbers around it as they were: the certificate asks it as it is written."""
    factor = np.array([1.0])

    def drifting(K, v_A, tau, chi, mu):
        return 0.0, 0.0, -(1 + factor[0] * chi) * v_A[2] / K[2][2]

    law_now = OwnLaw(drifting)
    factor[0] = 0.5
    case = scenario(ending={"max_impacts": 2}, release={"position": [0, 0, 0.4], "angles": [0, 0.4, 0]})
    assert of(analytic.toss(case, law=law_now), LAW) > 0.1


def test_only_the_analytic_engine_takes_one_and_only_where_the_floor_does_not_resist():
    law = OwnLaw(smooth)
    with pytest.raises(UnsupportedError, match=r"^law: given, accepted: none with the engine mujoco; "):
        cointoss.toss("fig24a", "mujoco", law=law)
    rolling = cointoss.load("fig24a").replace("floor.rolling_friction", 1e-4)
    with pytest.raises(
        UnsupportedError, match=r"^floor.rolling_friction = 0.0001: accepted: 0 with the law sm"
    ):
        cointoss.toss(rolling, law=law)
    with pytest.raises(TypeError, match=r"^law: of type str, accepted: a cointoss.OwnLaw; a named law is "):
        analytic.toss("fig24a", law="smooth")  # pyright: ignore[reportArgumentType]
    with pytest.raises(TypeError, match=r"^law: of type function, accepted: a cointoss.OwnLaw; "):
        analytic.toss_rows(rows_of(rolling, 1), law=smooth)  # pyright: ignore[reportArgumentType]


def test_a_law_is_pickled_by_its_function_and_made_anew():
    law = pickle.loads(pickle.dumps(OwnLaw(adds, may_add_energy=True)))
    assert law == OwnLaw(adds, may_add_energy=True)
    assert law.code.may_add_energy


def jumps(K, v_A, tau, chi, mu):
    return 0.0, 0.0, -(1 + chi * (1.0 if v_A[0] < 0.25 else 0.9)) * v_A[2] / K[2][2]


@pytest.mark.parametrize(("slip", "is_smooth"), [(0.1, True), (0.25 - 1e-9, False), (0.4, True)])
def test_beside_a_jump_of_a_law_nothing_is_trusted(slip, is_smooth):
    case = scenario(coin=THIN)
    y = np.zeros(STATE_SIZE)
    y[2], y[3], y[5], y[6:8] = 0.1, slip, -1.0, (math.cos(0.3), math.sin(0.3))
    touch = touch_derivatives(case.body, rules_by(OwnLaw(jumps), case), y)
    assert np.isfinite(touch.impulse).all() == is_smooth
    if slip == 0.1:
        named = touch_derivatives(case.body, case.rules, y)
        assert touch.impulse == pytest.approx(named.impulse, abs=1e-9)


@pytest.mark.slow
def test_the_engine_as_it_is_written_gives_the_same_bits():
    case = cointoss.load("fig24a")
    state = np.array(
        [[0, 0, 0.1, 0.3, 0.2, -1, np.cos(0.3), 0.6 * np.sin(0.3), 0.8 * np.sin(0.3), 0, 20, 30, 5]]
    )
    laws = {**NAMED, superball(0.5, 0.8): FREE}
    found = []
    for law, more in laws.items():
        rules = rules_by(OwnLaw(law, **more), case)
        for run in (strike_each, strike_each.function):
            rows = np.zeros(1, IMPACT_ROW)
            (solved,) = run(case.body, rules, np.array([0.7]), np.array([0.2]), state.copy(), rows)
            assert solved
            found.append(rows["impulse"].tobytes())
    assert found[::2] == found[1::2]
    assert len(set(found)) == len(laws)


def test_without_numba_a_law_says_what_to_install(monkeypatch):
    monkeypatch.setattr(own_law, "find_spec", lambda _: None)
    with pytest.raises(ImportError, match=r'^OwnLaw: needs numba: pip install "cointoss-dynamics\[laws\]"$'):
        OwnLaw(superball(1, 1))
