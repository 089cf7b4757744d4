"""A thick coin that stays upright on the floor, on the rims of both faces."""

import math

import numpy as np

from analytic.contact.floor_force import SLOW, contact, give_impulse, holding_force, holds
from analytic.flight.equations_of_motion import STATE_SIZE, attitude_of, derivative, normalise
from analytic.impact.laws import spin_gained, velocity_gained
from analytic.numerics.rotation import quaternion_rate
from models.attitude import rotation_matrix
from models.kernel.compiled import compiled
from models.kernel.vectors import add, apply, cross, dot, scale, subtract

# The angle by which a coin is tipped off the rim that lifts.
_TIP = 1e-12


@compiled
def rim_forces(body, mu, y):
    """Give the floor's vertical forces on the lowest points of tails' and of heads' rim, (2,) [N].

    They hold both points on the floor; a negative one would have to pull.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        y: state of an upright coin, (13,).
    """
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    tails, heads = contact(body, y, dy, 1.0), contact(body, y, dy, -1.0)
    N, _, _ = _holding(body, mu, tails, heads, (tails[3][2], heads[3][2]))
    return N


@compiled
def upright_rate(body, mu, y, dy):
    """Write the rate of change of the state y of an upright coin into dy; both (13,).

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor; it acts on each rim against that rim's slip.
        y: state, (13,).
        dy: where its rate of change goes, (13,).
    """
    derivative(body, y, dy)
    tails, heads = contact(body, y, dy, 1.0), contact(body, y, dy, -1.0)
    _, F, turned = _holding(body, mu, tails, heads, (tails[3][2], heads[3][2]))
    for i in range(3):
        dy[3 + i] += F[i] / body.mass
        dy[10 + i] += turned[i]


@compiled
def put_upright(body, y):
    """Turn a coin near its edge onto it, bring both rims to the floor, and stop them there.

    Args:
        body: the coin.
        y: state, (13,).
    """
    _tilt(y, rotation_matrix(attitude_of(y))[2][2])
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    tails, heads = contact(body, y, dy, 1.0), contact(body, y, dy, -1.0)
    _, S, turned = _holding(body, 0.0, tails, heads, (tails[4][2], heads[4][2]))
    y[2] = -tails[1][2]
    y[5] += S[2] / body.mass
    for i in range(3):
        y[10 + i] += turned[i]


@compiled
def tip_over(body, mu, y):
    """Tip an upright coin a little onto the rim that is pressed harder.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        y: state, (13,).
    """
    on_tails, on_heads = rim_forces(body, mu, y)
    # Tails' rim is the lower one of a coin with heads up.
    _tilt(y, -_TIP if on_tails > on_heads else _TIP)


@compiled
def start_creep(body, mu, side, y):
    """Give the rim that stuck before the other landed the slow slip at which friction is what holds it there.

    Without it that rim would have no friction at first, and the other might lift at once. Where no friction
    can hold it, or the floor would have to pull, nothing is changed.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        side: of the rim that stuck.
        y: state of an upright coin, (13,).
    """
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    held, other = contact(body, y, dy, side), contact(body, y, dy, -side)
    F, N = _gripping(body, held, other, _with_friction(body, mu, other[4]), held[3], other[3][2])
    if N < 0 or not holds(mu, F):
        return
    slip = -_slow_slip(body, mu) / (mu * F[2])
    change = subtract(held[4], (slip * F[0], slip * F[1], 0.0))
    S, S_other = _gripping(body, held, other, (0.0, 0.0, 1.0), change, other[4][2])
    give_impulse(body, held[0], held[1], S, y)
    give_impulse(body, other[0], other[1], (0.0, 0.0, S_other), y)


@compiled
def _gripping(body, held, other, along, motion, fall):
    """Give what takes all motion from one rim's lowest point, and the vertical one from the other's.

    Args:
        body: the coin.
        held: `contact` of the one rim.
        other: `contact` of the other.
        along: a force at the other with the vertical part 1, (3,).
        motion: acceleration, or velocity, of the one, (3,).
        fall: vertical acceleration, or velocity, of the other.

    Returns:
        The force, or impulse, on the one, space frame, (3,), and the vertical one on the other.
    """
    R, arm, K, _, _ = held
    _, arm_other, K_other, _, _ = other
    # The force on the one for its own motion, and for each unit of the other's.
    F, more = holding_force(K, motion), holding_force(K, velocity_gained(body, R, arm_other, along, arm))
    rise = dot(K_other[2], along) + velocity_gained(body, R, arm, more, arm_other)[2]
    N = -(fall + velocity_gained(body, R, arm, F, arm_other)[2]) / rise
    return add(F, scale(N, more)), N


@compiled
def _holding(body, mu, tails, heads, fall):
    """Give what takes the vertical motion `fall` of both points from them.

    Args:
        body: the coin.
        mu: coefficient of friction μ.
        tails: `contact` of tails' rim.
        heads: `contact` of heads' rim.
        fall: accelerations, or velocities, (2,).

    Returns:
        The vertical forces, or impulses, (2,), both with their friction, space frame, (3,), and the change of
        the angular velocity, body frame, (3,).
    """
    R, arm_tails, K_tails, _, v_tails = tails
    _, arm_heads, K_heads, _, v_heads = heads
    along_tails, along_heads = _with_friction(body, mu, v_tails), _with_friction(body, mu, v_heads)
    by_tails = spin_gained(body, R, arm_tails, along_tails)
    by_heads = spin_gained(body, R, arm_heads, along_heads)
    # The vertical motion of the first point by a unit force at the second.
    tails_tails, heads_heads = dot(K_tails[2], along_tails), dot(K_heads[2], along_heads)
    tails_heads = 1 / body.mass + cross(apply(R, by_heads), arm_tails)[2]
    heads_tails = 1 / body.mass + cross(apply(R, by_tails), arm_heads)[2]
    determinant = tails_tails * heads_heads - tails_heads * heads_tails
    N_tails = (tails_heads * fall[1] - heads_heads * fall[0]) / determinant
    N_heads = (heads_tails * fall[0] - tails_tails * fall[1]) / determinant
    F = add(scale(N_tails, along_tails), scale(N_heads, along_heads))
    return (N_tails, N_heads), F, add(scale(N_tails, by_tails), scale(N_heads, by_heads))


@compiled
def _with_friction(body, mu, v_A):
    """Give a force with the vertical part 1 and its friction at a point with velocity v_A, (3,).

    A rigid body leaves open how two points share the force that holds both: friction on slow slip grows in
    proportion to it.
    """
    slip = max(math.hypot(v_A[0], v_A[1]), _slow_slip(body, mu))
    return -mu * v_A[0] / slip, -mu * v_A[1] / slip, 1.0


@compiled
def _slow_slip(body, mu):
    """Give the speed of a slip up to which friction grows in proportion to it [m/s].

    At a friction as large as the weight it is `SLOW`, however rough the floor: larger coefficients would only
    make the motion stiff.
    """
    return SLOW * max(mu, 1.0) * (body.gravity * body.radius) ** 0.5


@compiled
def _tilt(y, angle):
    """Turn the coin about the horizontal axis in its plane so that n_z falls by a small `angle`."""
    up = rotation_matrix(attitude_of(y))[2]
    turn = quaternion_rate(attitude_of(y), scale(angle, cross(up, (0.0, 0.0, 1.0))))
    for i in range(4):
        y[6 + i] += turn[i]
    normalise(y)
