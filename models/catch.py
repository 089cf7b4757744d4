"""A hand that catches a flying coin when its mass centre comes down to the height of the catch."""

from typing import NamedTuple

from cointoss.models.body import Body
from cointoss.models.clearance import fastest_motion, first_root, useful_window
from cointoss.models.kernel.compiled import compiled
from cointoss.models.state import State

NEAR = 1e-14
"""The mass centre counts as at the height within this relative tolerance."""


class Approach(NamedTuple):
    """The position of a flying coin relative to the height of its catch."""

    is_caught: bool
    """Whether the coin has now come down to the height."""
    is_above: bool
    """Whether C is above the height; rounding may hide this just after C has passed it upwards."""
    step: float
    """A time during which C certainly stays on its side of the height [s]."""


@compiled
def approach_hand(body: Body, height: float, is_above: bool, state: State, longest: float) -> Approach:
    """Return the `Approach` of a flight in one state.

    The vertical acceleration of C is at most A = g + k p/m, with k and p of `drag_bound`: at a distance f
    from the height, which changes at the rate f', C stays on its side up to the positive root of
    f + f' t - A t²/2. Steps of that length are a Newton iteration, which passes no crossing.

    Args:
        body: the coin.
        height: of the catch [m].
        is_above: of the `Approach` before.
        state: of the coin.
        longest: the longest step [s].
    """
    z, v = state.position[2], state.velocity
    near, above = NEAR * height, z - height
    if is_above and above <= near and v[2] < 0:
        return Approach(True, True, 0.0)
    is_above = is_above or (above >= -near and v[2] > 0)
    window = useful_window(body, v, state.spin, longest)
    drag, _, _, speed, _ = fastest_motion(body, v, state.spin, window)
    side = 1 if is_above else -1
    step = first_root(max(side * above, 0.0), side * v[2], body.gravity + drag * speed / body.mass)
    # If C turns back at the height itself, the step could have length 0.
    least = (near / body.gravity) ** 0.5 if abs(above) <= near else 0.0
    return Approach(False, is_above, min(max(min(step, window), least), longest))
