"""A coin whose roll the floor's resistance stops: whether it rests on its edge, rolls on there, or spins."""

import math

from analytic.automaton import Mode
from analytic.contact.edge import on_edge, stands
from analytic.contact.one_rim import lower_rim_of
from analytic.contact.resistance import has_resistance, slow_spin
from analytic.contact.rim_contact import rim_contact
from analytic.flight.state_vector import spin_of, velocity_of
from models.kernel.compiled import compiled
from models.kernel.vectors import apply, dot


@compiled
def rests(body, friction, mode, y):
    """Return whether resistance to rolling holds a coin in contact where it is, on its edge.

    At rest the weight's moment about the line of contact is m g a, a the horizontal distance of C from it:
    it stays while a <= δ. All motion is slower than `SLOW`, and its energy is a quarter of what resistance
    takes from it before a can grow to δ, at most. On a smooth floor the coin may slide on.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        y: state, (13,).
    """
    if not friction.rolling > 0:
        return False
    w, v, slow = spin_of(y), velocity_of(y), slow_spin(body)
    if dot(w, w) > slow * slow:
        return False
    A = rim_contact(body, y, lower_rim_of(y))
    spare = friction.rolling - _lever(A, mode)
    if not spare > 0 or (friction.sliding > 0 and math.hypot(v[0], v[1]) > slow * body.radius):
        return False
    energy = (body.mass * v[2] * v[2] + dot(w, apply(body.inertia, w))) / 2
    if friction.sliding > 0:
        energy += body.mass * (v[0] * v[0] + v[1] * v[1]) / 2
    # C and A move apart by less than twice the lever for each radian of turn.
    lever = 2 * (dot(A.arm, A.arm) ** 0.5 + body.radius)
    return energy < body.mass * body.gravity * spare * spare / (4 * lever)


@compiled
def _lever(A, mode):
    """Return the horizontal distance of C from the line on which the coin stands, or from its one point A."""
    if mode != Mode.UPRIGHT:
        return math.hypot(A.arm[0], A.arm[1])
    axle = (A.R[0][2], A.R[1][2])
    return abs(axle[0] * A.arm[1] - axle[1] * A.arm[0])


@compiled
def rolls_upright(body, friction, mode, y):
    """Return whether a coin rolls upright against resistance, and would be turned back on either rim."""
    if not has_resistance(friction):
        return False
    at_one_rim = Mode.SLIDING.value if mode == Mode.UPRIGHT else mode
    return on_edge(body, y) and stands(body, friction, at_one_rim, y)
