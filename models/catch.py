"""A hand that catches a flying coin at a height: when its mass centre comes down to it."""

from cointoss.models.clearance import fastest_motion, first_root, useful_window
from cointoss.models.kernel.compiled import compiled

NEAR = 1e-14
"""The mass centre is at a height within this part of it."""


@compiled
def approach_hand(body, height, is_above, z, v, w, longest):
    """Return how a flight goes on towards the height at which the coin is caught.

    The vertical acceleration of C is at most A = g + k p/m, with k and p of `drag_bound`: at a distance f
    from the height, which changes at the rate f', it stays on its side up to the positive root of
    f + f' t - A t²/2. Steps of that length are a Newton iteration, which passes no crossing.

    Args:
        body: the coin.
        height: of the catch [m].
        is_above: whether C is above it; rounding may hide that where it has just come up.
        z: height of C [m].
        v: velocity of C, space frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        longest: the longest step wanted [s].

    Returns:
        Whether the coin is caught now, having come down; whether it is above the height; and a time in which
        it surely stays on its side, at most `longest` [s].
    """
    near, above = NEAR * height, z - height
    if is_above and above <= near and v[2] < 0:
        return True, True, 0.0
    is_above = is_above or (above >= -near and v[2] > 0)
    window = useful_window(body, v, w, longest)
    drag, _, _, speed, _ = fastest_motion(body, v, w, window)
    side = 1 if is_above else -1
    step = first_root(max(side * above, 0.0), side * v[2], body.gravity + drag * speed / body.mass)
    # Where it turns at the height itself a step might have no length.
    least = (near / body.gravity) ** 0.5 if abs(above) <= near else 0.0
    return False, is_above, min(max(min(step, window), least), longest)
