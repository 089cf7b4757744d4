"""A toss as a hybrid automaton: its modes with flow and projection, its events, and the mode after each.

A flow returns the rate of change of the state and a margin: how far the mode is from its end. A guard finds
the event that ends the mode and never writes. The table names the next mode, and a reset
(`cointoss.analytic.contact.resets`) maps the state to the one in which that mode starts.
"""

from enum import IntEnum

import numpy as np

from cointoss.analytic.contact import incipient_slip, lying, sliding, sticking, upright
from cointoss.analytic.contact.contact import BOTH_RIMS, SustainedContact, lower_rim_of
from cointoss.analytic.contact.one_rim import contact_in_flight
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.records import Array


class Mode(IntEnum):
    """How a coin moves between two events."""

    FLIGHT = 0
    SLIDING = 1
    """The coin touches at one rim point A, which slips; friction acts against the slip."""
    INCIPIENT_SLIP = 2
    """The coin touches at A, whose slip is below `SLOW` and outside what friction can hold."""
    STICKING = 3
    """The coin touches at A, which does not slip."""
    UPRIGHT = 4
    """The coin touches at both rims."""
    ENDED = 5
    TOUCHING = 6
    """The coin touches at one rim, for no time: which mode of contact starts is still to be found."""
    LYING = 7
    """The coin lies flat on a face, and slides or spins; once its toss is decided."""
    RESTING = 8
    """The coin does not move any more; once its toss is decided."""


class Event(IntEnum):
    """What ends a mode."""

    NONE = -1
    """Nothing yet: the mode goes on."""
    IMPACT = 0
    """The coin touches the floor and bounces."""
    CHATTERS = 1
    """The coin touches the floor, and its impacts chatter (Zeno): a sustained contact takes their place."""
    LIFTS_OFF = 2
    """The floor would have to pull: Signorini's condition ends the contact."""
    SECOND_RIM_LANDS = 3
    """The other face's rim comes down to the floor: a touch follows."""
    FACE_LANDS = 4
    """A face comes down to the floor: a touch of the opposite rim point follows."""
    FALLS_FLAT = 5
    """A face comes down to the floor, of a coin so flat already that no step of the contact is left."""
    SLIDES = 6
    """A slips faster than `SLOW`, or goes on slipping faster than half of it; or the floor is smooth."""
    SLIP_STARTS = 7
    """A hardly slips, and the force that would hold it is outside the friction cone."""
    SLIP_STOPS = 8
    """A hardly slips, and friction holds it."""
    COMES_UPRIGHT = 9
    """The coin comes onto its edge and presses both rims."""
    TIPS_OVER = 10
    """One rim of an upright coin would have to be pulled: the coin goes on upon the other."""
    NO_SOLUTION = 11
    """No step of the contact, however short, has a finite end."""
    ENDS = 12
    """The toss is decided, a budget is spent, or the contact law goes no further: see `Ending`."""
    LIES = 13
    """The coin lies flat on a face for good."""
    RESTS = 14
    """The coin comes to rest: on a face, or on its edge by the floor's resistance to rolling."""


IN_LANES = (Mode.SLIDING, Mode.STICKING, Mode.UPRIGHT)
"""The modes whose flow takes the same steps for every coin, so that four coins go side by side."""
_ONE_RIM = (Mode.SLIDING, Mode.INCIPIENT_SLIP, Mode.STICKING)
_CONTACT = (*_ONE_RIM, Mode.UPRIGHT)
_TABLE = {
    # event: the mode after it, and the modes that it can end
    Event.IMPACT: (Mode.FLIGHT, (Mode.FLIGHT,)),
    Event.CHATTERS: (Mode.TOUCHING, (Mode.FLIGHT,)),
    Event.LIFTS_OFF: (Mode.FLIGHT, (*_ONE_RIM, Mode.TOUCHING)),
    Event.SECOND_RIM_LANDS: (Mode.FLIGHT, _ONE_RIM),
    Event.FACE_LANDS: (Mode.FLIGHT, _ONE_RIM),
    Event.FALLS_FLAT: (Mode.FLIGHT, _ONE_RIM),
    Event.SLIDES: (Mode.SLIDING, (*_ONE_RIM, Mode.TOUCHING)),
    Event.SLIP_STARTS: (Mode.INCIPIENT_SLIP, (*_ONE_RIM, Mode.TOUCHING)),
    Event.SLIP_STOPS: (Mode.STICKING, (*_ONE_RIM, Mode.TOUCHING)),
    Event.COMES_UPRIGHT: (Mode.UPRIGHT, _ONE_RIM),
    Event.TIPS_OVER: (Mode.TOUCHING, (Mode.UPRIGHT,)),
    Event.NO_SOLUTION: (Mode.ENDED, (*_CONTACT, Mode.LYING)),
    Event.ENDS: (Mode.ENDED, (Mode.FLIGHT, *_CONTACT, Mode.LYING, Mode.RESTING)),
    Event.LIES: (Mode.LYING, (Mode.FLIGHT, *_CONTACT)),
    Event.RESTS: (Mode.RESTING, (*_CONTACT, Mode.LYING)),
}
_AFTER = np.array([_TABLE[event][0].value for event in sorted(_TABLE)])
_IS_LEGAL = np.array([[mode in _TABLE[event][1] for event in sorted(_TABLE)] for mode in sorted(Mode)])


@compiled
def mode_after(mode: int, event: Event) -> int:
    """Return the mode, as its number, that follows a mode that an event ends.

    Args:
        mode: number of the `Mode`.
        event: the `Event`.

    Raises:
        ValueError: for an event that cannot end this mode.
    """
    if event == Event.NONE or not _IS_LEGAL[mode, event.value]:
        raise ValueError("this event cannot end this mode")
    return _AFTER[event.value]


@compiled
def contact_at(body: Body, friction: FloorFriction, mode: int, y: Array) -> SustainedContact:
    """Return the `SustainedContact` of a coin in the state y, (13,), in this mode of contact."""
    no_rim_lands = mode == Mode.UPRIGHT or mode == Mode.LYING
    return SustainedContact(body, friction, mode, BOTH_RIMS if no_rim_lands else lower_rim_of(y))


@compiled
def flow(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Write the rate of change of the state y of a coin in contact into dy; both (13,).

    Returns:
        The margin of the mode, relative: positive in it, 0 or below past its end.
    """
    return inlined_flow(contact, y, dy)


@inlined
def inlined_flow(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Return what `flow` does, inlined: a call in each step would copy all numbers of the coin."""
    if contact.mode == Mode.INCIPIENT_SLIP:
        return incipient_slip.flow(contact, y, dy)
    if contact.mode == Mode.LYING:
        return lying.flow(contact, y, dy)
    return flow_in_lanes(contact, y, dy)


@inlined
def flow_in_lanes(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Return what `flow` does in the modes `IN_LANES`, for one coin or for four."""
    if contact.mode == Mode.STICKING:
        return sticking.flow(contact, y, dy)
    if contact.mode == Mode.UPRIGHT:
        return upright.flow(contact, y, dy)
    return sliding.flow(contact, y, dy)


@compiled
def project(contact: SustainedContact, y: Array) -> None:
    """Bring the points in contact to the floor, and their velocities to what the mode allows.

    An impulse at these points, without resistance, changes the velocities. This is a reset, and the last part
    of a step.
    """
    if contact.mode == Mode.INCIPIENT_SLIP:
        incipient_slip.project(contact, y)
    elif contact.mode == Mode.LYING:
        lying.project(contact, y)
    else:
        project_in_lanes(contact, y)


@compiled
def project_in_lanes(contact: SustainedContact, y: Array) -> None:
    """Do what `project` does in the modes `IN_LANES`, for one coin or for four."""
    if contact.mode == Mode.STICKING:
        sticking.project(contact, y)
    elif contact.mode == Mode.UPRIGHT:
        upright.project(contact, y)
    else:
        sliding.project(contact, y)


@compiled
def margin_event(contact: SustainedContact, y: Array) -> Event:
    """Return the event of a mode whose margin is zero where nothing lands, or of a coin that is `TOUCHING`.

    This is a guard. Its tests come in an order in which each excludes the later ones: first whether the coin
    lifts off, then whether it slides fast, then whether friction can hold a slow slip.

    Args:
        contact: the contact.
        y: state, (13,), its lowest point on the floor with v_Az = 0.
    """
    if contact.mode == Mode.UPRIGHT:
        return Event.TIPS_OVER
    if contact.mode == Mode.LYING:
        return Event.RESTS
    A = contact_in_flight(contact, y)
    if A.free_acceleration[2] >= 0:
        return Event.LIFTS_OFF
    if sliding.begins(contact, A, contact.mode == Mode.SLIDING):
        return Event.SLIDES
    return Event.SLIP_STOPS if sticking.begins(contact, A) else Event.SLIP_STARTS
