"""A thick coin that stays upright on a smooth floor, on the rims of both faces."""

import numpy as np

from analytic.flight import STATE_SIZE, attitude_of, derivative, normalise
from analytic.floor_force import contact
from analytic.impact import spin_gained
from analytic.rotation import quaternion_rate
from models.attitude import rotation_matrix
from models.compiled import compiled
from models.vectors import add, apply, cross, scale

# The angle by which a coin is tipped off the rim that lifts.
_TIP = 1e-12


@compiled
def rim_forces(body, y):
    """Give the floor's vertical forces on the lowest points of tails' and of heads' rim, (2,) [N].

    They hold both points on the floor; a negative one would have to pull.

    Args:
        body: the coin.
        y: state of an upright coin, (13,).
    """
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    tails, heads = contact(body, y, dy, 1.0), contact(body, y, dy, -1.0)
    N, _ = _holding(body, tails, heads, (tails[3][2], heads[3][2]))
    return N


@compiled
def upright_rate(body, y, dy):
    """Write the rate of change of the state y of an upright coin into dy; both (13,)."""
    derivative(body, y, dy)
    tails, heads = contact(body, y, dy, 1.0), contact(body, y, dy, -1.0)
    N, turned = _holding(body, tails, heads, (tails[3][2], heads[3][2]))
    dy[5] += (N[0] + N[1]) / body.mass
    for i in range(3):
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
    S, turned = _holding(body, tails, heads, (tails[4][2], heads[4][2]))
    y[2] = -tails[1][2]
    y[5] += (S[0] + S[1]) / body.mass
    for i in range(3):
        y[10 + i] += turned[i]


@compiled
def tip_over(body, y):
    """Tip an upright coin a little onto the rim that is pressed harder.

    Args:
        body: the coin.
        y: state, (13,).
    """
    on_tails, on_heads = rim_forces(body, y)
    # Tails' rim is the lower one of a coin with heads up.
    _tilt(y, -_TIP if on_tails > on_heads else _TIP)


@compiled
def _holding(body, tails, heads, fall):
    """Give what takes the vertical motion `fall` of both points from them.

    Args:
        body: the coin.
        tails: `contact` of tails' rim.
        heads: `contact` of heads' rim.
        fall: accelerations, or velocities, (2,).

    Returns:
        The vertical forces, or impulses, (2,), and the change of the angular velocity, body frame, (3,).
    """
    R, arm_tails, K_tails, _, _ = tails
    _, arm_heads, K_heads, _, _ = heads
    by_tails = spin_gained(body, R, arm_tails, (0.0, 0.0, 1.0))
    by_heads = spin_gained(body, R, arm_heads, (0.0, 0.0, 1.0))
    k_tails, k_heads = K_tails[2][2], K_heads[2][2]
    k_both = 1 / body.mass + cross(apply(R, by_heads), arm_tails)[2]
    determinant = k_tails * k_heads - k_both * k_both
    N_tails = (k_both * fall[1] - k_heads * fall[0]) / determinant
    N_heads = (k_both * fall[0] - k_tails * fall[1]) / determinant
    return (N_tails, N_heads), add(scale(N_tails, by_tails), scale(N_heads, by_heads))


@compiled
def _tilt(y, angle):
    """Turn the coin about the horizontal axis in its plane so that n_z falls by a small `angle`."""
    up = rotation_matrix(attitude_of(y))[2]
    turn = quaternion_rate(attitude_of(y), scale(angle, cross(up, (0.0, 0.0, 1.0))))
    for i in range(4):
        y[6 + i] += turn[i]
    normalise(y)
