"""Coulomb's law in a step: the mean friction for a normal force that gives way to it."""

import math

from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled

Pair = tuple[float, float]
PARTS = 4096
"""No part of a step, in which the slip keeps nearly to its direction, is shorter than the step over this."""
BEND = 1e-3
"""Most that the turn of the slip in a part, times its change against the slip itself, may be."""
CHANGE = 1.0
"""Largest change of the slip in a part, against the slip itself."""
STILL = 1e-4
"""A slip below this part of what would drive it in the rest of the step is none."""
ROUNDS = 60
"""Most rounds in which the friction of a part is found."""
SAME = 1e-13
"""A friction that differs from the cone's by less than this part of itself is on it."""


@compiled
def coulomb_force(K: Array, mu: float, normal: float, slip: Pair, slip_free: Pair, dt: float) -> Pair:
    """Return the mean friction of a step that Coulomb's law asks for.

    MuJoCo prescribes the vertical acceleration of the contact, whatever else acts on it: a friction f lowers
    the normal force by K_zt · f/K_zz, and changes the slip at the rate (K_tt - K_tz K_zt/K_zz) f. The slip is
    followed in parts of the step, up to where it surely stops: the mean friction then depends on the way to
    its stop no more.

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
    driven = ((slip_free[0] - slip[0]) / dt, (slip_free[1] - slip[1]) / dt)
    still = STILL * math.sqrt(driven[0] * driven[0] + driven[1] * driven[1])
    stopping = max(stopping_rate(g, (xx, yy, xy), mu, normal, driven), still)
    left, v, sum_x, sum_y = dt, slip, 0.0, 0.0
    while left > 0:
        part = left
        if math.sqrt(v[0] * v[0] + v[1] * v[1]) > stopping * left:
            part = min(left, max(steady_time(g, (xx, yy, xy), mu, normal, v, driven), dt / PARTS))
        free = (v[0] + driven[0] * part, v[1] + driven[1] * part)
        f_x, f_y = force_in_cone(g, (xx * part, yy * part, xy * part), mu, normal, v, free)
        v = (free[0] + (xx * f_x + xy * f_y) * part, free[1] + (xy * f_x + yy * f_y) * part)
        left, sum_x, sum_y = left - part, sum_x + f_x * part, sum_y + f_y * part
    return sum_x / dt, sum_y / dt


@compiled
def stopping_rate(
    g: Pair, resistance: tuple[float, float, float], mu: float, normal: float, driven: Pair
) -> float:
    """Return a rate at which friction surely brings the slip to its stop, where it then stays [m/s²].

    With G the matrix of `resistance` and v' = a + G f, v · G⁻¹ v/2 changes at the rate v · (f - hold), where
    hold = -G⁻¹ a and -v · f >= |v| μ N/(1 + μ |g|). It is at most |v|²/2 over G's least eigenvalue. A rate
    that is not positive means nothing.

    Args:
        g: part of a friction that the normal force gives way to, (2,).
        resistance: xx, yy and xy of G, the symmetric matrix from friction to acceleration of the slip [1/kg].
        mu: coefficient of friction μ.
        normal: normal force without friction [N].
        driven: a, the acceleration of the slip without friction, (2,) [m/s²].
    """
    xx, yy, xy = resistance
    hold_x, hold_y = yy * driven[0] - xy * driven[1], xx * driven[1] - xy * driven[0]
    hold = math.sqrt(hold_x * hold_x + hold_y * hold_y) / (xx * yy - xy * xy)
    least = (xx + yy - math.sqrt((xx - yy) * (xx - yy) + 4 * xy * xy)) / 2
    return least * (mu * normal / (1 + mu * math.sqrt(g[0] * g[0] + g[1] * g[1])) - hold)


@compiled
def steady_time(
    g: Pair, resistance: tuple[float, float, float], mu: float, normal: float, slip: Pair, driven: Pair
) -> float:
    """Return a time in which a slip keeps to `BEND` and `CHANGE` [s]; 0 where it stops at once.

    Args:
        g: see `stopping_rate`, as for the others.
        resistance: from friction to acceleration of the slip.
        mu: coefficient of friction μ.
        normal: normal force without friction [N].
        slip: now, not 0, (2,) [m/s].
        driven: its acceleration without friction, (2,) [m/s²].
    """
    xx, yy, xy = resistance
    size = math.sqrt(slip[0] * slip[0] + slip[1] * slip[1])
    share = size - mu * (g[0] * slip[0] + g[1] * slip[1])
    if share <= 0:
        return 0.0
    f_x, f_y = -mu * normal / share * slip[0], -mu * normal / share * slip[1]
    a_x, a_y = driven[0] + xx * f_x + xy * f_y, driven[1] + xy * f_x + yy * f_y
    change, turn = math.sqrt(a_x * a_x + a_y * a_y), abs(slip[0] * a_y - slip[1] * a_x) / size
    rate = max(change / CHANGE, math.sqrt(turn * change / BEND))
    return size / rate if rate > 0 else math.inf


@compiled
def force_in_cone(
    g: Pair, resistance: tuple[float, float, float], mu: float, normal: float, slip: Pair, slip_free: Pair
) -> Pair:
    """Return the friction that stops the slip, where that lies within the cone; else that of sliding.

    It is -μ N s, s the direction of the mean slip, N the normal force as the friction has left it: with G of
    `resistance`, f = -(G + λ)⁻¹ (slip + slip_free) for the λ >= 0 with which f is on the cone. Where f at
    λ = 0 is within it, that is the friction, which leaves no mean slip.

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
    if math.sqrt(stop_x * stop_x + stop_y * stop_y) <= mu * (normal - g[0] * stop_x - g[1] * stop_y):
        return stop_x, stop_y
    mean_x, mean_y, slower, f_x, f_y = slip[0] + slip_free[0], slip[1] + slip_free[1], 0.0, 0.0, 0.0
    if not mu * normal > 0:
        return f_x, f_y
    for _ in range(ROUNDS):
        a, b = xx + slower, yy + slower
        determinant = a * b - xy * xy
        f_x, f_y = (xy * mean_y - b * mean_x) / determinant, (xy * mean_x - a * mean_y) / determinant
        size = math.sqrt(f_x * f_x + f_y * f_y)
        used = size + mu * (g[0] * f_x + g[1] * f_y)
        over = used - mu * normal
        if abs(over) <= SAME * used or (slower == 0 and over < 0):
            break
        # Newton's step for 1/`used`, nearly linear in λ (Moré and Sorensen 1983).
        less_x, less_y = (b * f_x - xy * f_y) / determinant, (a * f_y - xy * f_x) / determinant
        along = (f_x * less_x + f_y * less_y) / size
        less = along + mu * (g[0] * less_x + g[1] * less_y)
        slower = max(slower + used * over / (mu * normal * (less if less > 0 else along)), slower / 2)
    return f_x, f_y
