"""The last of a slip that stops in an impact, as one power series, however long it takes to die away.

Slip of speed q in the direction s, t across it, has dq/dp = g = s · a and q du/dp = h = t · a, where
a = K_tz - μ K_tt s depends on its direction alone. It stops in a direction s* in which h = 0 and g < 0,
towards which it turns. With u the angle from s* and m = tan(u/2), H = (1 + m²)² h and G = (1 + m²)² g are
polynomials of m, and

    (1 + m²) H dq/dm = 2 G q,     H dS/dm = 2 (1 + m²) q (-μ s, 1),     H dX/dm = 2 (1 + m²) q²

with X = ∫ q dp, of which friction's work is -μ X. So q and S are m^γ times power series of m, with
γ = g/(dh/du) at s*, and X is m^(2γ) times one. Each coefficient follows from the few before it.
"""

import math
from typing import NamedTuple

import numpy as np

from cointoss.models.kernel.arrays import Array, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector

# Columns of the series: q; S along s*, across it, and S_z; q² and X.
Q, ALONG, ACROSS, NORMAL, SQUARE, PATH, COLUMNS = range(7)
# Its rows: some of zeros, from which the first terms follow, then at most so many terms.
BEFORE, MOST_TERMS = 5, 64
# The last terms are at most this part of the first, the largest term so many times the sum.
_CONVERGED, _LARGEST = 2.0**-56, 8.0
# No other direction is kept within so many times the slope: so the terms fall by half, or faster.
_CLEAR = 2.0
# Newton's steps to s*: how many, the first of them at most, and one after which there is none [rad].
_STEPS, _FIRST, _LAST = 8, 1.0, 1e-8


class SlipStop(NamedTuple):
    """How slip dies away: as x^γ times a power series of x, which is 1 now and 0 where slip has stopped."""

    direction: tuple[float, float]
    """s*, space frame, (2,)."""
    exponent: float
    """γ."""
    end: int
    """The number of rows of the series; 0 where slip does not die away, or it converges too slowly."""


class StopEquations(NamedTuple):
    """The polynomials of slip that dies away, in powers of x."""

    H: tuple[float, float, float, float]
    """Coefficients of H/m."""
    G: tuple[float, float, float, float, float, float]
    """Coefficients of G, the last 0."""
    mu: float
    """Coefficient of friction μ."""
    m: float
    """Slope now."""


@compiled
def room_for_stop() -> Array:
    """Return room for the series of `expand_stop`, (BEFORE + MOST_TERMS, COLUMNS)."""
    series = np.empty((BEFORE + MOST_TERMS, COLUMNS))
    series[:BEFORE] = 0.0
    return series


@compiled
def expand_stop(K: Matrix, mu: float, slip: tuple[float, float], with_path: bool, series: Array) -> SlipStop:
    """Expand what is left of a slip that dies away.

    Args:
        K: Delassus matrix of A, space frame, a tuple of rows [1/kg].
        mu: coefficient of friction μ.
        slip: v_t, space frame, (2,), not 0 [m/s].
        with_path: whether X is wanted.
        series: where the coefficients go; see `room_for_stop`.

    Returns:
        The `SlipStop`.
    """
    speed = math.hypot(slip[0], slip[1])
    s, is_kept = kept_direction(K, mu, (slip[0] / speed, slip[1] / speed))
    if not is_kept:
        return SlipStop(s, 0.0, 0)
    m = (s[0] * slip[1] - s[1] * slip[0]) / (speed + s[0] * slip[0] + s[1] * slip[1])
    # K_tz along s*, and μ K_tt: its mean, half the difference of its diagonal, and what couples both axes,
    # in the frame of s*, where K_tz across s* is C.
    k = s[0] * K[0][2] + s[1] * K[1][2]
    M, half = mu * (K[0][0] + K[1][1]) / 2, mu * (K[1][1] - K[0][0]) / 2
    cosine, sine = s[0] * s[0] - s[1] * s[1], 2 * s[0] * s[1]
    D, C = half * cosine - mu * K[0][1] * sine, half * sine + mu * K[0][1] * cosine
    H = (-2 * k - 4 * D, 6 * C * m, (4 * D - 2 * k) * m**2, -2 * C * m**3)
    G = (k + D - M, -2 * C * m, -(2 * M + 6 * D) * m**2, 6 * C * m**3, (D - M - k) * m**4, 0.0)
    others = _CLEAR * (abs(H[1]) + _CLEAR * (abs(H[2]) + _CLEAR * abs(H[3])))
    if not (H[0] < 0 and G[0] < 0 and others < -H[0] and _CLEAR * abs(m) < 1):
        return SlipStop(s, 0.0, 0)
    # The terms of x⁰, of which that of q is 1, G[0] being dq/dp at the stop.
    # In the order of the columns: q; S along s*, across it, and S_z; q² and X.
    copy_into(series[BEFORE], (1.0, -mu / G[0], 0.0, 1 / G[0], 1.0, 1 / (2 * G[0])))
    end = BEFORE + 1
    while not _converges(series, end):
        if end == len(series):
            return SlipStop(s, 0.0, 0)
        _next_term(StopEquations(H, G, mu, m), with_path, series, end)
        end += 1
    return SlipStop(s, 2 * G[0] / H[0], end if _scaled(series, end, speed) else 0)


@compiled
def kept_direction(K: Matrix, mu: float, s: tuple[float, float]) -> tuple[tuple[float, float], bool]:
    """Return the direction near s that slip keeps once it has it, h = 0, and whether one was found.

    Args:
        K: Delassus matrix of A, space frame [1/kg].
        mu: coefficient of friction μ.
        s: unit vector, space frame, (2,).
    """
    for _ in range(_STEPS):
        a = (
            K[0][2] - mu * (K[0][0] * s[0] + K[0][1] * s[1]),
            K[1][2] - mu * (K[0][1] * s[0] + K[1][1] * s[1]),
        )
        kappa = mu * (s[1] * s[1] * K[0][0] - 2 * s[0] * s[1] * K[0][1] + s[0] * s[0] * K[1][1])
        # -dh/du: it is positive where slip turns towards the direction.
        restoring = s[0] * a[0] + s[1] * a[1] + kappa
        turn = (s[0] * a[1] - s[1] * a[0]) / restoring
        if not (restoring > 0 and abs(turn) < _FIRST):
            return s, False
        length = math.hypot(1.0, turn)
        s = ((s[0] - turn * s[1]) / length, (s[1] + turn * s[0]) / length)
        if abs(turn) < _LAST:
            return s, True
    return s, False


@compiled
def _next_term(equations: StopEquations, with_path: bool, series: Array, row: int) -> None:
    """Write the next term of the series.

    Args:
        equations: of the slip.
        with_path: whether X is wanted.
        series: see `expand_stop`.
        row: of the term.
    """
    H, G, mu, m = equations
    # Of (1 + m²) H/m.
    B = (H[0], H[1], H[2] + m**2 * H[0], H[3] + m**2 * H[1], m**2 * H[2], m**2 * H[3])
    gamma, k = 2 * G[0] / H[0], row - BEFORE
    q, square = 0.0, 0.0
    along = -2 * mu * -(m**2) * series[row - 2, Q]
    across = -4 * mu * m * series[row - 1, Q]
    normal, path = 2 * m**2 * series[row - 2, Q], 2 * m**2 * series[row - 2, SQUARE]
    for j in range(1, 6):
        before, power = series[row - j], gamma + k - j
        q += (2 * G[j] - B[j] * power) * before[Q]
        if j < 4:
            along -= H[j] * power * before[ALONG]
            across -= H[j] * power * before[ACROSS]
            normal -= H[j] * power * before[NORMAL]
        if with_path:
            square += (4 * G[j] - B[j] * (gamma + power)) * before[SQUARE]
            path -= H[j] * (gamma + power) * before[PATH] if j < 4 else 0.0
    q /= B[0] * k
    square /= B[0] * k
    share, share_of_path = 1 / (H[0] * (gamma + k)), 1 / (H[0] * (2 * gamma + k))
    term = series[row]
    term[Q], term[SQUARE] = q, square
    term[ALONG], term[ACROSS] = (along - 2 * mu * q) * share, across * share
    term[NORMAL], term[PATH] = (normal + 2 * q) * share, (path + 2 * square) * share_of_path


@compiled
def _converges(series: Array, end: int) -> bool:
    """Return whether the last two terms are small against the first."""
    for column in (Q, NORMAL):
        most = _CONVERGED * abs(series[BEFORE, column])
        if not (abs(series[end - 1, column]) <= most and abs(series[end - 2, column]) <= most):
            return False
    return True


@compiled
def _scaled(series: Array, end: int, speed: float) -> bool:
    """Scale the series such that q is the speed of slip now; return whether its sum is exact to rounding."""
    total, largest = 0.0, 0.0
    for row in range(BEFORE, end):
        total += series[row, Q]
        largest = max(largest, abs(series[row, Q]))
    scale = speed / total
    for row in range(BEFORE, end):
        for column in range(COLUMNS):
            series[row, column] *= scale if column < SQUARE else scale * scale
    return largest <= _LARGEST * total


@compiled
def impulse_until(stop: SlipStop, series: Array, x: float) -> tuple[Vector, float]:
    """Return the impulse from now until x.

    Args:
        stop: the `SlipStop`.
        series: see `expand_stop`.
        x: from 1, now, to 0, where slip has stopped.

    Returns:
        S: space frame, (3,) [N s].
        X [J].
    """
    at_x, now, first = _sums(series, stop.end, x), _sums(series, stop.end, 1.0), series[BEFORE]
    # Of slip that hardly dies away the first terms are large, and change little.
    logarithm = stop.exponent * math.log(x) if x > 0 else -np.inf
    power, change = math.exp(logarithm), math.expm1(logarithm)
    along = first[ALONG] * change + power * at_x[0] - now[0]
    across = first[ACROSS] * change + power * at_x[1] - now[1]
    normal = first[NORMAL] * change + power * at_x[2] - now[2]
    path = first[PATH] * math.expm1(2 * logarithm) + power * power * at_x[3] - now[3]
    s = stop.direction
    return (s[0] * along - s[1] * across, s[1] * along + s[0] * across, normal), path


@compiled
def _sums(series: Array, end: int, x: float) -> tuple[float, float, float, float]:
    """Return the sums from x on, without x⁰, of S along s*, across it and vertical, and of X."""
    along, across, normal, path = 0.0, 0.0, 0.0, 0.0
    for row in range(end - 1, BEFORE, -1):
        along, across = (along + series[row, ALONG]) * x, (across + series[row, ACROSS]) * x
        normal, path = (normal + series[row, NORMAL]) * x, (path + series[row, PATH]) * x
    return along, across, normal, path
