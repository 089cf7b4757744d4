"""The table of modes and events: what can follow what, and that a toss keeps to it."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.contact.automaton import Event, Mode, margin_event, mode_after
from cointoss.analytic.contact.edge.guards import comes_upright, stands_for_good
from cointoss.analytic.contact.edge.rocking import rocks_on_edge
from cointoss.analytic.contact.edge.standing import stands
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.landing import landing, time_to_landing
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rest import rests, rolls_upright
from cointoss.analytic.events import NO_LOSS, Setup, Spent, TossEnd, hold_to_event
from cointoss.analytic.runs import run
from cointoss.analytic.settings import AnalyticSettings, contact_limits
from cointoss.analytic.toss import state_at_release
from cointoss.models.perpetual import energy_history
from cointoss.models.records import Ending, Outcome
from tests.helpers.contacts import held, put_on_floor, upright_coin
from tests.helpers.draws import AIR, IMPERFECT, LONG_TRANSIENT, PAPER_OFFSET, THIN, ZLOTY, scenario

ONE_RIM = {Mode.SLIDING, Mode.INCIPIENT_SLIP, Mode.STICKING}
CONTACT = ONE_RIM | {Mode.UPRIGHT}
WAYS = {
    Event.IMPACT: ({Mode.FLIGHT}, Mode.FLIGHT),
    Event.CHATTERS: ({Mode.FLIGHT}, Mode.TOUCHING),
    Event.LIFTS_OFF: (ONE_RIM | {Mode.TOUCHING}, Mode.FLIGHT),
    Event.SECOND_RIM_LANDS: (ONE_RIM, Mode.FLIGHT),
    Event.FACE_LANDS: (ONE_RIM, Mode.FLIGHT),
    Event.FALLS_FLAT: (ONE_RIM, Mode.FLIGHT),
    Event.SLIDES: (ONE_RIM | {Mode.TOUCHING}, Mode.SLIDING),
    Event.SLIP_STARTS: (ONE_RIM | {Mode.TOUCHING}, Mode.INCIPIENT_SLIP),
    Event.SLIP_STOPS: (ONE_RIM | {Mode.TOUCHING}, Mode.STICKING),
    Event.COMES_UPRIGHT: (ONE_RIM, Mode.UPRIGHT),
    Event.TIPS_OVER: ({Mode.UPRIGHT}, Mode.TOUCHING),
    Event.NO_SOLUTION: (CONTACT | {Mode.LYING}, Mode.ENDED),
    Event.ENDS: (CONTACT | {Mode.FLIGHT, Mode.LYING, Mode.RESTING}, Mode.ENDED),
    Event.LIES: (CONTACT | {Mode.FLIGHT}, Mode.LYING),
    Event.RESTS: (CONTACT | {Mode.LYING}, Mode.RESTING),
}
"""Which modes an event can end, and the mode after it."""


@pytest.mark.parametrize("event", Event)
def test_an_event_leads_from_the_modes_that_it_can_end_to_one_and_from_no_other(event):
    ended, following = WAYS.get(event, (set(), None))
    for mode in Mode:
        if mode in ended:
            assert mode_after(mode.value, event) == following
        else:
            with pytest.raises(ValueError, match="cannot end this mode"):
                mode_after(mode.value, event)


def contacts_with_states():
    """Give a contact in every mode, and its state."""
    body, friction = scenario(coin=IMPERFECT).body, FloorFriction(0.3)
    for mode in sorted(CONTACT | {Mode.TOUCHING}):
        y = upright_coin(body, 0.4, 3.0, 20.0)
        if mode != Mode.UPRIGHT:
            y[6:10] = state_at_release(scenario(release={"angles": [0.2, 1.2, 0.4]}).release)[6:10]
            put_on_floor(body, friction, mode, y)
        yield held(body, friction, mode, y), y


GUARDS = {
    "landing": landing,
    "time to landing": lambda contact, y: time_to_landing(contact, y, np.ones(13)),
    "margin event": margin_event,
    "comes upright": comes_upright,
    "stands for good, tried": lambda contact, y: stands_for_good(contact, 1, True, y),
    "stands for good, untried": lambda contact, y: stands_for_good(contact, 64, False, y),
    "stands": stands,
    "rocks on edge": rocks_on_edge,
    "rests": rests,
    "rolls upright": rolls_upright,
}


@pytest.mark.parametrize("guard", GUARDS.values(), ids=GUARDS)
def test_a_guard_of_a_contact_never_writes_to_the_state(guard):
    for contact, y in contacts_with_states():
        as_given = y.copy()
        guard(contact, y)
        assert np.array_equal(y, as_given)


@pytest.mark.parametrize("changed", [{}, {"thickness": 0.0}, {"center_of_mass": PAPER_OFFSET}])
def test_a_toss_passes_through_its_modes_in_time_and_ends_once(changed):
    coin, seen = {**ZLOTY, **changed}, set()
    for spin in (20.0, 30.0, 40.0):
        case = scenario(
            coin=coin,
            floor={"contact": "coulomb", "restitution": 0.5, "friction": 0.3},
            release={"position": [0, 0, 0.1], "angles": [0, 1.0, 0], "angular_velocity": [3.0, spin, 5.0]},
        )
        log = run(case.body, case.rules, state_at_release(case.release))
        assert log.started.modes[-1] == Mode.ENDED
        assert Mode.ENDED not in log.started.modes[:-1]
        assert log.started.modes[0] == Mode.FLIGHT
        assert np.all(np.diff(log.started.times) >= 0)
        seen |= {Mode(mode) for mode in log.started.modes}
    assert {Mode.FLIGHT, Mode.SLIDING, Mode.STICKING, Mode.ENDED} <= seen


STEPPED = {
    "on its edge": scenario(
        coin=IMPERFECT,
        air=AIR,
        floor={"contact": "smooth", "restitution": 0.3},
        release={
            "position": [0.0, 0.0, 0.0145],
            "velocity": [0.0, 0.0, 0.0],
            "angles": [0.0, 1.57, 4.7],
            "angular_velocity": [-2.0, 2.0, -50.0],
        },
    ),
    "in a long transient": scenario(**LONG_TRANSIENT),
    # `lying` waits until it lies, which its steps may not reach.
    "settled before it lies": scenario(
        coin=THIN,
        floor={"contact": "coulomb", "restitution": 0.35211072081587824, "friction": 0.5235770795992176},
        release={
            "position": [0.0, 0.0, 0.15322121712898534],
            "velocity": [0.19395121082161892, -0.20564430774957326, -0.05694080828330428],
            "quaternion": [
                0.5053240878680411,
                -0.19510325410976284,
                -0.47532927851883044,
                -0.6932851963217459,
            ],
            "angular_velocity": [-34.12213505541779, 28.643114495841388, 26.30384567812179],
        },
        ending={"test": "lying"},
    ),
}


@pytest.mark.parametrize(
    ("name", "limits", "outcome", "ending"),
    [
        ("on its edge", {"contact_steps": 3}, Outcome.UNDECIDED, Ending.CONTACT_STEPS),
        ("on its edge", {"contact_steps": 250_000}, Outcome.EDGE, Ending.STANDING),
        ("in a long transient", {"contact_steps": 4500}, Outcome.UNDECIDED, Ending.CONTACT_STEPS),
        ("in a long transient", {"contact_steps": 6000}, Outcome.TRANSIENT, Ending.TRANSIENT),
        ("in a long transient", {"contact_steps": 8000}, Outcome.TRANSIENT, Ending.TRANSIENT),
        ("in a long transient", {"contact_steps": 20_000}, Outcome.TAILS, Ending.SETTLED),
        # Its steps are longer.
        (
            "in a long transient",
            {"contact_steps": 4500, "contact_tolerance": 1e-6},
            Outcome.TAILS,
            Ending.SETTLED,
        ),
        ("settled before it lies", {"contact_steps": 1000}, Outcome.UNDECIDED, Ending.CONTACT_STEPS),
        ("settled before it lies", {"contact_steps": 20_000}, Outcome.HEADS, Ending.PAPER),
    ],
)
def test_a_toss_whose_contact_steps_are_spent_ends_as_is_known_by_then(name, limits, outcome, ending):
    tossed = analytic.toss(STEPPED[name], settings=AnalyticSettings(**limits))
    assert (tossed.outcome, tossed.ending) == (outcome, ending)


def test_steps_of_flights_and_events_after_the_first_contact_are_counted_and_none_before():
    case = scenario(**LONG_TRANSIENT)
    log = run(case.body, case.rules, state_at_release(case.release), AnalyticSettings(contact_steps=100))
    after = log.started.times >= log.contacts[0, 0]
    flights = after & (log.started.modes == Mode.FLIGHT)
    assert np.sum(log.started.steps[~after]) > 10
    assert np.sum(flights) > 1
    # In contact there are steps too, so that flights and their events alone do not spend it all; with them
    # and the events of contacts hardly more is spent than there is.
    spent = np.sum(log.started.steps[flights] + 4) + 4 * np.sum(after & ~flights)
    assert spent < 100 + 8 + np.max(log.started.steps[flights])
    assert np.sum(after) < 100 / 4


def test_a_contact_that_no_step_is_short_enough_to_follow_has_no_solution():
    case = scenario(floor={"contact": "coulomb", "friction": 0.3})
    y = state_at_release(case.release)
    y[6:10], y[12] = (0.8, 0.6, 0.0, 0.0), np.inf
    friction, limits = friction_in_contact(case.rules), contact_limits(AnalyticSettings())
    toss = Setup(case.body, case.rules, friction, limits, energy_history(NO_LOSS), False, np.zeros(2))
    with np.errstate(all="ignore"):
        passage = hold_to_event(toss, Mode.SLIDING.value, y, Spent(2.0, 0, 0))
    assert (passage.event, passage.spent) == (Event.NO_SOLUTION, Spent(2.0, 0, 0))
    assert passage.verdict == TossEnd(Outcome.UNDECIDED, Ending.NO_SOLUTION)


def test_a_coin_whose_axis_all_but_passes_the_vertical_slaps_down_on_the_other_side():
    """In contact its lowest point would run around the rim at 3e10 rad/s, in ever shorter steps."""
    case = scenario(
        coin=THIN,
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
    tossed = analytic.toss(case, settings=AnalyticSettings(contact_steps=2000))
    assert tossed.ending == Ending.SETTLED
    slap = np.argmax(tossed.impacts.time > tossed.contacts[0, 1] - 1e-9)
    assert tossed.impacts.contact_velocity_before[slap, 2] < -1
    assert tossed.impacts.energy_change[slap] < 0
