"""Whether and where a coin comes to rest, by functions for both engines."""

import math

from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body, Rules, friction_can_hold, in_vacuum, resists
from cointoss.models.contact_laws.table import is_rough, uses_friction
from cointoss.models.ending import followed_until
from cointoss.models.kernel.arrays import Array, Row, Table, copy_into, four, three
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, norm
from cointoss.models.making import AT_REST
from cointoss.models.records import Ending
from cointoss.models.resting_place import RestReason

SLOW = 1e-4
"""Slower than this part of √(g r), a coin is not said to slide for ever."""


@compiled
def unrest(body: Body, rules: Rules, ending: Ending, end_time: float, v: Vector) -> RestReason:
    """Return why a coin will not come to rest, as far as its toss proves it; AT_REST where it may.

    Args:
        body: the coin.
        rules: floor and ending.
        ending: of the toss.
        end_time: of the toss [s].
        v: velocity of C then, (3,) [m/s]; along the floor it stays without friction and air.
    """
    if ending == Ending.CAUGHT:
        return RestReason.CAUGHT
    if followed_until(rules, ending, end_time, AT_REST) == end_time:
        return RestReason.UNDECIDED
    mu = math.inf if is_rough(rules.law) else rules.friction if uses_friction(rules.law) else 0.0
    if not friction_can_hold(body, mu):
        return RestReason.SLOPE
    is_free = mu == 0 and in_vacuum(body) and not resists(rules)
    slides = math.hypot(v[0], v[1]) > SLOW * (body.gravity * body.radius) ** 0.5
    return RestReason.FRICTIONLESS if is_free and slides else RestReason.AT_REST


@compiled
def is_still(motion: Array) -> bool:
    """Return whether a free joint, by its qpos and qvel, (13,), does not move at all."""
    return norm(three(motion, 7)) == 0 and norm(three(motion, 10)) == 0


@compiled
def path_length(times: Row, motions: Table) -> float:
    """Return the length of the path of B seen from above [m], by Simpson's rule on cubics between times.

    Args:
        times: increasing, (n,) [s].
        motions: qpos and qvel of a free joint at these times, (n, 13).
    """
    total = 0.0
    for i in range(len(times) - 1):
        dt, one, two = times[i + 1] - times[i], motions[i], motions[i + 1]
        if dt > 0:
            midway = math.hypot(
                1.5 * (two[0] - one[0]) / dt - (one[7] + two[7]) / 4,
                1.5 * (two[1] - one[1]) / dt - (one[8] + two[8]) / 4,
            )
            total += dt / 6 * (math.hypot(one[7], one[8]) + 4 * midway + math.hypot(two[7], two[8]))
    return total


@compiled
def write_rest(reason: RestReason, time: float, motion: Array, path: float, rest: Row) -> None:
    """Write whether a coin has come to rest, and where.

    Args:
        reason: that it may, or why not.
        time: at which its path ends [s].
        motion: qpos and qvel there, (13,).
        path: the length of its path from the first touch on [m].
        rest: where it goes, see `cointoss.models.resting_place.REST`, (7,); its error is not found here.
    """
    R = rotation_matrix(four(motion, 3))
    axis = 0 if abs(R[2][2]) > 0.5 else 2
    if reason != RestReason.AT_REST or not is_still(motion):
        rest[0] = RestReason.MOVING.value if reason == RestReason.AT_REST else reason.value
    else:
        copy_into(rest[:6], (0.0, time, motion[0], motion[1], math.atan2(R[1][axis], R[0][axis]), path))
