"""A coin whose roll the floor's resistance stops: whether it rests on its edge, or rolls on there."""

from cointoss.analytic.automaton import Mode
from cointoss.analytic.contact.edge import on_edge, stands
from cointoss.analytic.contact.one_rim import lower_rim_of
from cointoss.analytic.contact.resistance import has_resistance
from cointoss.analytic.contact.rim_contact import rim_contact
from cointoss.analytic.flight.state_vector import state_of
from cointoss.models.kernel.compiled import compiled
from cointoss.models.rest import is_held


@compiled
def rests(body, friction, mode, y):
    """Return whether resistance to rolling holds a coin in contact where it is; see `is_held`.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        y: state, (13,).
    """
    if not friction.rolling > 0:
        return False
    A = rim_contact(body, y, lower_rim_of(y))
    return is_held(body, friction.rolling, friction.sliding, state_of(y), A.arm, mode == Mode.UPRIGHT)


@compiled
def rolls_upright(body, friction, mode, y):
    """Return whether a coin rolls upright against resistance, and would be turned back on either rim."""
    if not has_resistance(friction):
        return False
    at_one_rim = Mode.SLIDING.value if mode == Mode.UPRIGHT else mode
    return on_edge(body, y) and stands(body, friction, at_one_rim, y)
