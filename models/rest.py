"""Whether a floor's resistance to rolling and pivoting holds a coin on its edge, or is still to stop it."""

import math

from cointoss.models.body import Body, friction_can_hold, slope_feeds
from cointoss.models.geometry import FLAT_SINE
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, apply, dot
from cointoss.models.state import State

SLOW = 1e-3
"""A spin slower than this part of √(g/r) counts as none."""


@compiled
def slow_spin(body: Body) -> float:
    """Return the spin below which a coin counts as not spinning [rad/s]."""
    return SLOW * (body.gravity / body.radius) ** 0.5


@compiled
def holding_arm(rolling: float, contour: float, on_line: bool) -> float:
    """Return the arm over the normal force of the moment that holds a coin on its edge from rolling [m].

    Contour friction resists only the roll of a coin that stands on a line. It cannot hold a coin on one rim
    point, which may fall.

    Args:
        rolling: δ [m].
        contour: c [m].
        on_line: whether the coin stands on a line, both rims on the floor.
    """
    return rolling + contour if on_line else rolling


@compiled
def is_held(body: Body, rolling: float, sliding: float, state: State, arm: Vector, on_line: bool) -> bool:
    """Return whether resistance to rolling holds a coin in contact where it is, on its edge.

    At rest the weight's moment about the line of contact is m g a, a the horizontal distance of C from it:
    it stays while a <= δ. All motion is slower than `SLOW`, and its energy is a quarter of what resistance
    takes from it before a can grow to δ, at most. On a smooth floor the coin may slide on. On a slope, which
    friction must bear, a is the distance to where the weight through C meets the floor, between the
    rims if it stands on both. There a coin on one point may pivot: a is then the largest of all directions,
    and what the slope gives it counts as motion.

    Args:
        body: the coin.
        rolling: δ, or `holding_arm` [m].
        sliding: μ in sustained contact.
        state: of the coin.
        arm: of the contact point A from C, space frame, (3,) [m].
        on_line: whether the coin stands on a line, both rims on the floor.
    """
    v, w = state.velocity, state.spin
    slow, lever = slow_spin(body), lever_of(state.R, arm, on_line)
    leaning, given = 0.0, 0.0
    if not rolling > 0 or dot(w, w) > slow * slow:
        return False
    if slope_feeds(body, sliding == 0):
        if not friction_can_hold(body, sliding):
            return False
        leaning = body.downhill / body.gravity
        if on_line:
            # Else the coin topples over a rim: the weight meets the floor beyond the line.
            aside = leaning * arm[2] * state.R[0][2] - body.center[2]
            if not abs(aside) < body.thickness / 2:
                return False
            lever = lever_of(state.R, (arm[0] + leaning * arm[2], arm[1], arm[2]), True)
        else:
            given = 2 * body.mass * body.downhill * lever
            lever += leaning * abs(arm[2])
    spare = rolling - lever
    if not spare > 0 or (sliding > 0 and math.hypot(v[0], v[1]) > slow * body.radius):
        return False
    energy = given + (body.mass * v[2] * v[2] + dot(w, apply(body.inertia, w))) / 2
    if sliding > 0:
        energy += body.mass * (v[0] * v[0] + v[1] * v[1]) / 2
    # C and A move apart by less than this for each radian of turn: nearly flat, A runs round the rim.
    running = max(1.0, 0.5 / max(math.hypot(state.R[2][0], state.R[2][1]), FLAT_SINE))
    longest = 2 * (dot(arm, arm) ** 0.5 + body.radius * running) * (1 + leaning)
    if body.thickness > 0 and not on_line:
        # Beyond upright A is on the other rim.
        longest = max(longest, spare / max(abs(state.R[2][2]), FLAT_SINE))
    return energy < body.mass * body.gravity * spare * spare / (4 * longest)


@compiled
def lever_of(R: Matrix, arm: Vector, on_line: bool) -> float:
    """Return the horizontal distance of C from A, or from the line on which a thick coin stands [m].

    Args:
        R: rotation matrix, body to space.
        arm: of A from C, space frame, (3,) [m].
        on_line: whether the coin stands on that line.
    """
    if not on_line:
        return math.hypot(arm[0], arm[1])
    return abs(R[0][2] * arm[1] - R[1][2] * arm[0])


@compiled
def is_slowing(body: Body, rolling: float, pivoting: float, w: Vector) -> bool:
    """Return whether resistance will bring a coin that stands to rest, or is still to stop its roll.

    Without resistance to rolling it may roll on for ever; without that to pivoting, spin.

    Args:
        body: the coin.
        rolling: what resists the roll of an upright coin, δ + c [m].
        pivoting: p [m].
        w: angular velocity, space frame, (3,) [rad/s].
    """
    if not rolling > 0:
        return False
    return pivoting > 0 or math.hypot(w[0], w[1]) > slow_spin(body)
