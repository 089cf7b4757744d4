"""The table of modes and events: what can follow what, and that a toss keeps to it."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.automaton import Event, Mode, mode_after
from cointoss.analytic.contact.following import friction_in_contact
from cointoss.analytic.events import NO_LOSS, follow_to_event, run
from cointoss.analytic.settings import Settings, contact_limits
from cointoss.analytic.toss import state_of
from cointoss.models.perpetual import energy_history
from cointoss.models.records import Ending, Outcome
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, scenario

CONTACT = (Mode.SLIDING, Mode.CREEPING, Mode.STICKING, Mode.UPRIGHT)


@pytest.mark.parametrize("mode", [mode for mode in Mode if mode != Mode.ENDED])
def test_every_mode_may_lift_off_slip_stick_and_end(mode):
    expected = {
        Event.LIFTS_OFF: Mode.FLIGHT,
        Event.SLIPS: Mode.SLIDING,
        Event.SLIP_STARTS: Mode.CREEPING,
        Event.SLIP_STOPS: Mode.STICKING,
        Event.ENDS: Mode.ENDED,
    }
    assert {event: mode_after(mode.value, event) for event in expected} == expected


def test_only_a_flying_coin_bounces_and_only_one_in_contact_at_one_rim_comes_upright_or_lands_another():
    possible = {
        event: [mode for mode in Mode if mode != Mode.ENDED and can_end(mode, event)]
        for event in (Event.IMPACT, Event.RIM_LANDS, Event.FACE_LANDS, Event.COMES_UPRIGHT)
    }
    one_rim = [Mode.SLIDING, Mode.CREEPING, Mode.STICKING]
    assert possible == {
        Event.IMPACT: [Mode.FLIGHT],
        Event.RIM_LANDS: one_rim,
        Event.FACE_LANDS: one_rim,
        Event.COMES_UPRIGHT: one_rim,
    }


def can_end(mode, event):
    try:
        mode_after(mode.value, event)
    except ValueError:
        return False
    return True


def test_a_mode_that_goes_on_and_an_ended_toss_have_no_mode_after_them():
    forbidden = {Mode.UPRIGHT: Event.COMES_UPRIGHT, Mode.SLIDING: Event.NONE, Mode.ENDED: Event.ENDS}
    for mode, event in forbidden.items():
        with pytest.raises(ValueError, match="cannot end this mode"):
            mode_after(mode.value, event)


@pytest.mark.parametrize("changed", [{}, {"thickness": 0.0}, {"center_of_mass": PAPER_OFFSET}])
def test_a_toss_passes_through_its_modes_in_time_and_ends_once(changed):
    coin, seen = {**ZLOTY, **changed}, set()
    for spin in (20.0, 30.0, 40.0):
        case = scenario(
            coin=coin,
            floor={"contact": "coulomb", "restitution": 0.5, "friction": 0.3},
            release={"position": [0, 0, 0.1], "angles": [0, 1.0, 0], "angular_velocity": [3.0, spin, 5.0]},
        )
        log = run(case.body, case.rules, state_of(case.release))
        assert log.modes[-1] == Mode.ENDED
        assert Mode.ENDED not in log.modes[:-1]
        assert log.modes[0] == Mode.FLIGHT
        assert np.all(np.diff(log.start_times) >= 0)
        seen |= {Mode(mode) for mode in log.modes}
    assert {Mode.FLIGHT, Mode.SLIDING, Mode.STICKING, Mode.ENDED} <= seen


ON_EDGE = {
    "coin": {**ZLOTY, "center_of_mass": PAPER_OFFSET},
    "air": AIR,
    "floor": {"contact": "smooth", "restitution": 0.3},
    "release": {
        "position": [0.0, 0.0, 0.0145],
        "velocity": [0.0, 0.0, 0.0],
        "angles": [0.0, 1.57, 4.7],
        "angular_velocity": [-2.0, 2.0, -50.0],
    },
}
HIGH = {"release": {"position": [0.0, 0.0, 0.5], "angular_velocity": [0.0, 40.0, 0.0]}}


@pytest.mark.parametrize(
    ("case", "settings", "limits", "ending"),
    [
        (ON_EDGE, Settings(contact_steps=3), {}, Ending.CONTACT_STEPS),
        (HIGH, Settings(), {"max_impacts": 2}, Ending.MAX_IMPACTS),
        (HIGH, Settings(), {"max_time": 0.05}, Ending.MAX_TIME),
    ],
)
def test_a_spent_budget_ends_a_toss_by_its_name(case, settings, limits, ending):
    tossed = analytic.toss(scenario(**case, ending=limits), settings=settings)
    assert (tossed.outcome, tossed.ending) == (Outcome.UNDECIDED, ending)
    assert str(ending) in tossed.ending.sentence
    decided = analytic.toss(scenario(**case))
    assert decided.outcome != Outcome.UNDECIDED


def test_a_contact_that_no_step_is_short_enough_to_follow_has_no_solution():
    case = scenario(floor={"contact": "coulomb", "friction": 0.3})
    y = state_of(case.release)
    y[6:10], y[12] = (0.8, 0.6, 0.0, 0.0), np.inf
    mu, history = friction_in_contact(case.rules), energy_history(NO_LOSS)
    with np.errstate(all="ignore"):
        event, time, _, outcome, ending = follow_to_event(
            case.body, case.rules, mu, Mode.SLIDING.value, y, 2.0, 0, contact_limits(Settings()), history
        )
    assert (event, time, outcome, ending) == (Event.ENDS, 2.0, Outcome.UNDECIDED, Ending.NO_SOLUTION)


def test_a_coin_whose_axis_all_but_passes_the_vertical_slaps_down_on_the_other_side():
    """In contact its lowest point would run around the rim at 3e10 rad/s, in ever shorter steps."""
    case = scenario(
        coin={**ZLOTY, "thickness": 0.0},
        air=AIR,
        floor={"restitution": 0.6},
        release={
            "position": [-4.12166290146489e-06, 1.9874639767390407e-06, 0.4078093587545604],
            "velocity": [4.908879801449538e-05, -5.786803456321336e-05, 7.528228911044744e-05],
            "quaternion": [
                0.9999999946268999,
                -1.7953782491403496e-05,
                9.076534390480717e-05,
                -4.674948368603285e-05,
            ],
            "angular_velocity": [24.692654152520984, -0.0076354518627679705, 0.0010798050343003407],
        },
    )
    tossed = analytic.toss(case, settings=Settings(contact_steps=2000))
    assert tossed.ending == Ending.SETTLED
    slap = np.argmax(tossed.impacts.time > tossed.contacts[0, 1] - 1e-9)
    assert tossed.impacts.contact_velocity_before[slap, 2] < -1
    assert tossed.impacts.energy_change[slap] < 0


@pytest.mark.parametrize("steps", [0, 2.5])
def test_settings_refuse_a_budget_that_is_no_number_of_steps(steps):
    with pytest.raises(ValueError, match=rf"contact_steps: given {steps}, accepted: a whole number >= 1"):
        Settings(contact_steps=steps)


@pytest.mark.parametrize("tolerance", [1e-15, 1e-5, float("nan")])
def test_settings_refuse_a_tolerance_beyond_rounding_or_too_coarse(tolerance):
    with pytest.raises(ValueError, match=rf"contact_tolerance: given {tolerance}, accepted: 1e-14 to 1e-06"):
        Settings(contact_tolerance=tolerance)


def test_a_finer_tolerance_takes_more_of_a_lasting_contact_but_ends_it_alike():
    case = scenario(coin=ZLOTY, floor={"restitution": 0.5}, release=HIGH["release"] | {"angles": [0, 0.8, 0]})
    coarse, fine = (analytic.toss(case, settings=Settings(contact_tolerance=t)) for t in (1e-9, 1e-13))
    assert len(coarse.contacts) > 0
    assert coarse.outcome == fine.outcome
    assert coarse.contacts[0, 0] == fine.contacts[0, 0]
    assert coarse.end_time == pytest.approx(fine.end_time, rel=1e-8)
