"""A coin whose roll the floor's resistance stops: whether it rests on its edge, or rolls on there."""

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.contact import SustainedContact, lower_rim_of
from cointoss.analytic.contact.edge.standing import on_edge, stands
from cointoss.analytic.contact.resistance import has_resistance
from cointoss.analytic.contact.rim_contact import rim_contact
from cointoss.analytic.contact.upright import margin
from cointoss.analytic.flight.state_vector import spin_of, state_of
from cointoss.models.body import slope_feeds
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import norm
from cointoss.models.records import Array
from cointoss.models.rest import holding_arm, is_held, slow_spin


@compiled
def rests(contact: SustainedContact, y: Array) -> bool:
    """Return whether resistance to rolling holds a coin in contact in the state y, (13,); see `is_held`."""
    body, friction = contact.body, contact.friction
    on_line = contact.mode == Mode.UPRIGHT
    rolling = holding_arm(friction.rolling, friction.contour.friction, on_line)
    if not rolling > 0 or norm(spin_of(y)) > slow_spin(body):
        return False
    A = rim_contact(body, y, lower_rim_of(y))
    return is_held(body, rolling, friction.sliding, state_of(y), A.arm, on_line)


@compiled
def rolls_upright(contact: SustainedContact, y: Array) -> bool:
    """Return whether a coin rolls upright against resistance or on a slope, and is held on both rims."""
    body, friction = contact.body, contact.friction
    if slope_feeds(body, friction.sliding == 0):
        return contact.mode == Mode.UPRIGHT and margin(body, friction, y) > 0
    return has_resistance(friction) and on_edge(body, y) and stands(contact, y)
