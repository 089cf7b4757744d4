"""The guards of a coin near its edge: whether it comes upright, or stands for good."""

from cointoss.analytic.contact import upright
from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.edge.restoring import held_on_edge
from cointoss.analytic.contact.edge.rocking import rocks_on_edge
from cointoss.analytic.contact.edge.standing import on_edge, slows, stands
from cointoss.analytic.contact.resets import stand_up
from cointoss.analytic.contact.resistance import has_resistance
from cointoss.models.body import slope_feeds
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import Array

# The number of steps between two trials of whether an upright coin stands.
_BETWEEN_TRIALS = 64


@compiled
def stands_for_good(contact: SustainedContact, steps: int, early: bool, y: Array) -> bool:
    """Return whether a coin in contact is proved to stand on its edge for good.

    A coin without thickness is not proved to stand, nor is a coin that a slope may give energy.

    Args:
        contact: the contact.
        steps: made in the mode so far; the trials of an upright and of a rocking coin are costly, and made
            only in some of them.
        early: whether a coin that still rocks may be said to stand.
        y: state, (13,).
    """
    body, friction = contact.body, contact.friction
    if slope_feeds(body, friction.sliding == 0):
        return False
    if contact.mode == Mode.UPRIGHT:
        return steps % _BETWEEN_TRIALS == 0 and not slows(body, friction, y) and stands(contact, y)
    if body.thickness == 0:
        return False
    if on_edge(body, y):
        return held_on_edge(contact, y) and not slows(body, friction, y) and stands(contact, y)
    tried = early and steps % _BETWEEN_TRIALS == 1 and not has_resistance(friction)
    return tried and rocks_on_edge(contact, y)


@compiled
def comes_upright(contact: SustainedContact, y: Array) -> bool:
    """Return whether a coin in contact at one rim comes onto its edge and presses both; y: state, (13,)."""
    body = contact.body
    if contact.mode == Mode.UPRIGHT or body.thickness == 0 or not on_edge(body, y):
        return False
    if not held_on_edge(contact, y):
        return False
    both = y.copy()
    stand_up(contact, both)
    return upright.margin(body, contact.friction, both) > 0
