"""A toss as a hybrid automaton: its modes, the events that end them, and the mode that follows."""

from enum import IntEnum

import numpy as np

from cointoss.models.kernel.compiled import compiled


class Mode(IntEnum):
    """How a coin moves between two events."""

    FLIGHT = 0
    SLIDING = 1
    """In contact at one rim point A, which slips; friction acts against the slip."""
    CREEPING = 2
    """In contact at A, whose slip starts or is hardly left. Friction would turn it at once: it goes in the
    direction in which it grows."""
    STICKING = 3
    """In contact at A, which does not slip."""
    UPRIGHT = 4
    """In contact at both rims."""
    ENDED = 5


class Event(IntEnum):
    """What ends a mode."""

    NONE = -1
    """Nothing yet: the mode goes on."""
    IMPACT = 0
    """The coin touches the floor and bounces."""
    LIFTS_OFF = 1
    """The floor would have to pull."""
    RIM_LANDS = 2
    """The other face's rim comes down to the floor: a touch follows."""
    FACE_LANDS = 3
    """A face comes down to the floor: a touch of the opposite rim point follows."""
    SLIPS = 4
    """A slips faster than `SLOW`, or goes on slipping faster than half of it; or the floor is smooth."""
    SLIP_STARTS = 5
    """A hardly slips, and friction cannot hold it."""
    SLIP_STOPS = 6
    """A hardly slips, and friction holds it."""
    COMES_UPRIGHT = 7
    """The coin comes onto its edge and presses both rims."""
    ENDS = 8
    """The toss is decided, a budget is spent, or the law goes no further: see `Ending`."""


_F, _S, _C, _T, _U, _E, _ = *(mode.value for mode in Mode), -1
_NEXT = np.array(
    [
        # IMPACT, LIFTS_OFF, RIM_LANDS, FACE_LANDS, SLIPS, SLIP_STARTS, SLIP_STOPS, COMES_UPRIGHT, ENDS
        [_F, _F, _, _, _S, _C, _T, _, _E],  # FLIGHT
        [_, _F, _F, _F, _S, _C, _T, _U, _E],  # SLIDING
        [_, _F, _F, _F, _S, _C, _T, _U, _E],  # CREEPING
        [_, _F, _F, _F, _S, _C, _T, _U, _E],  # STICKING
        [_, _F, _, _, _S, _C, _T, _, _E],  # UPRIGHT
        [_, _, _, _, _, _, _, _, _],  # ENDED
    ]
)


@compiled
def mode_after(mode, event):
    """Return the mode, as its number, that follows a mode that an event ends.

    Args:
        mode: number of the `Mode`.
        event: the `Event`.

    Raises:
        ValueError: for an event that cannot end this mode.
    """
    following = -1 if event == Event.NONE else _NEXT[mode, event.value]
    if following < 0:
        raise ValueError("this event cannot end this mode")
    return following
