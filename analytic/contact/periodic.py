"""Sustained contact that repeats itself for ever: one period of it is proof."""

from typing import NamedTuple

import numpy as np

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.resistance import has_resistance
from cointoss.analytic.contact.rim_contact import lean_and_rate
from cointoss.models.body import in_vacuum, is_ideal, slope_feeds
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import Array

# A rate of n_z below this part of √(g/r) has no sign: it may be rounding.
_NOTICEABLE = 1e-6


class TiltHistory(NamedTuple):
    """How often the tilt of a coin has turned back; the arrays are written to as the contact goes on."""

    periodic: bool
    """Whether the tilt is periodic while the mode lasts."""
    slowest: float
    """Slower changes of n_z count as zero [1/s]."""
    rate: Array
    """The last rate of n_z that was not slower, (1,) [1/s]."""
    turns: Array
    """Extremes of n_z so far, (1,)."""


@compiled
def start_tilt_history(contact: SustainedContact) -> TiltHistory:
    """Return the `TiltHistory` of a contact that starts."""
    return tilt_history(contact, np.zeros(2))


@compiled
def tilt_history(contact: SustainedContact, kept: Array) -> TiltHistory:
    """Return the `TiltHistory` of a contact, which lies in `kept`, (2,), zeros at its start.

    An ideal coin in vacuum that slides without friction, or rolls without slip, has one degree of freedom,
    its tilt: L_z and L_ζ, or what takes their place in rolling, are functions of it (S. A. Chaplygin 1897;
    P. Appell and D. J. Korteweg 1900). Its energy is kept, so the tilt goes to and fro between two extremes
    for ever, if the contact holds from one extreme to the other and back. This is also true while the coin
    slides down a slope without friction, but not while it rolls there.
    """
    body, friction, mode = contact.body, contact.friction, contact.mode
    lossless = mode == Mode.STICKING or (mode == Mode.SLIDING and friction.sliding == 0)
    lossless = lossless and not (has_resistance(friction) or slope_feeds(body, friction.sliding == 0))
    periodic = lossless and is_ideal(body) and in_vacuum(body)
    slowest = _NOTICEABLE * (body.gravity / body.radius) ** 0.5
    return TiltHistory(periodic, slowest, kept[:1], kept[1:])


@compiled
def record_tilt(history: TiltHistory, y: Array) -> None:
    """Add the state at the end of a step, (13,), to the history."""
    if history.periodic:
        _, rate = lean_and_rate(y)
        if abs(rate) > history.slowest:
            if rate * history.rate[0] < 0:
                history.turns[0] += 1
            history.rate[0] = rate


@compiled
def repeats(history: TiltHistory) -> bool:
    """Return whether a contact has gone through a whole period of its tilt."""
    return history.turns[0] >= 3
