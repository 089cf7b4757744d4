"""Coulomb's law in a step: the mean friction for a normal force that gives way to it."""

import math

from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled

PARTS = 512
"""Parts of a step in which the slip may turn or stop."""
STEADY = 0.1
"""Slip that changes by less than this part of itself does not turn much."""
ROUNDS = 60
"""Most rounds in which the direction of the slip in a step is found."""
SAME = 1e-13
"""Two directions that differ by less are one."""


@compiled
def coulomb_force(
    K: Array, mu: float, normal: float, slip: tuple[float, float], slip_free: tuple[float, float], dt: float
) -> tuple[float, float]:
    """Return the mean friction of a step that Coulomb's law asks for.

    MuJoCo prescribes the vertical acceleration of the contact, whatever else acts on it: a friction f lowers
    the normal force by K_zt · f/K_zz, and changes the slip at the rate (K_tt - K_tz K_zt/K_zz) f. Where the
    slip may turn much in the step it is followed in `PARTS` of it.

    Args:
        K: Delassus matrix of the contact point, space frame, (3, 3) [1/kg].
        mu: coefficient of friction μ.
        normal: mean normal force of the step without friction [N].
        slip: velocity of the contact point in the floor at the start of the step, (2,) [m/s].
        slip_free: at the end of the step without friction, (2,) [m/s].
        dt: length of the step [s].

    Returns:
        f: (2,) [N].
    """
    g = (K[0, 2] / K[2, 2], K[1, 2] / K[2, 2])
    xx, yy, xy = K[0, 0] - g[0] * K[0, 2], K[1, 1] - g[1] * K[1, 2], K[0, 1] - g[0] * K[1, 2]
    driven_x, driven_y = slip_free[0] - slip[0], slip_free[1] - slip[1]
    change = math.hypot(driven_x, driven_y) + mu * normal * (xx + yy) * dt
    parts = PARTS if change > STEADY * math.hypot(slip[0], slip[1]) else 1
    part = dt / parts
    v_x, v_y, sum_x, sum_y = slip[0], slip[1], 0.0, 0.0
    for _ in range(parts):
        free = (v_x + driven_x / parts, v_y + driven_y / parts)
        f_x, f_y = force_in_cone(g, (xx * part, yy * part, xy * part), mu, normal, (v_x, v_y), free)
        v_x = free[0] + (xx * f_x + xy * f_y) * part
        v_y = free[1] + (xy * f_x + yy * f_y) * part
        sum_x, sum_y = sum_x + f_x, sum_y + f_y
    return sum_x / parts, sum_y / parts


@compiled
def force_in_cone(
    g: tuple[float, float],
    resistance: tuple[float, float, float],
    mu: float,
    normal: float,
    slip: tuple[float, float],
    slip_free: tuple[float, float],
) -> tuple[float, float]:
    """Return the friction that stops the slip, where that lies within the cone; else that of sliding.

    It is -μ N s, s the direction of the mean slip, N the normal force as the friction has left it. Where no
    such N is positive (Painlevé's case) the slip stops at once.

    Args:
        g: part of a friction that the normal force gives way to, (2,).
        resistance: xx, yy and xy of the symmetric matrix from friction to the change of the slip [s/kg].
        mu: coefficient of friction μ.
        normal: normal force without friction [N].
        slip: at the start, (2,) [m/s].
        slip_free: at the end without friction, (2,) [m/s].
    """
    xx, yy, xy = resistance
    determinant = xx * yy - xy * xy
    stop_x = -(yy * slip_free[0] - xy * slip_free[1]) / determinant
    stop_y = -(xx * slip_free[1] - xy * slip_free[0]) / determinant
    if math.hypot(stop_x, stop_y) <= mu * (normal - g[0] * stop_x - g[1] * stop_y):
        return stop_x, stop_y
    s_x, s_y = slip if math.hypot(slip[0], slip[1]) > 0 else slip_free
    size = math.hypot(s_x, s_y)
    f_x, f_y = 0.0, 0.0
    for turn in range(ROUNDS):
        s_x, s_y = s_x / size, s_y / size
        share = 1 - mu * (g[0] * s_x + g[1] * s_y)
        if share <= 0:
            return stop_x, stop_y
        f_x, f_y = -mu * normal / share * s_x, -mu * normal / share * s_y
        mean_x = slip[0] + slip_free[0] + xx * f_x + xy * f_y
        mean_y = slip[1] + slip_free[1] + xy * f_x + yy * f_y
        size = math.hypot(mean_x, mean_y)
        if size == 0:
            break
        change_x, change_y = mean_x / size - s_x, mean_y / size - s_y
        if math.hypot(change_x, change_y) < SAME:
            break
        # Where the slip nearly stops the full way may overshoot for ever.
        way = 1.0 if turn < ROUNDS / 2 else 0.5
        s_x, s_y = s_x + way * change_x, s_y + way * change_y
        size = math.hypot(s_x, s_y)
        if size == 0:
            break
    return f_x, f_y
