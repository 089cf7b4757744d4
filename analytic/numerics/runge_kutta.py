"""One step of Dormand and Prince's Runge-Kutta pair of order 8(5,3).

Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, section II.5. The caller computes the
slope at each stage; `stages` holds them, (STAGES, size).
"""

import numpy as np

from analytic.numerics.tableau import E3, E5, STAGES, TERMS, WEIGHTED, WEIGHTS
from models.kernel.compiled import compiled

_SAFETY, _SHRINK_MOST, _GROW_MOST = 0.8, 0.2, 6.0


@compiled
def stage_point(y, dt, stages, stage, point):
    """Write into `point`, an array of its own, the place of stage number `stage`, whose slope is wanted."""
    _advance(y, dt, stages, stage, point)


@compiled
def end_point(y, dt, stages, point):
    """Write into `point`, an array of its own, the end of the step."""
    _advance(y, dt, stages, STAGES, point)


@compiled
def _advance(y, dt, stages, row, point):
    """Write y + dt times the slopes, weighted by a row of the tableau; LLVM vectorises the inner loops."""
    for i in range(len(y)):
        point[i] = 0.0
    for term in range(TERMS[row]):
        weight, slopes = WEIGHTS[row, term], stages[WEIGHTED[row, term]]
        for i in range(len(y)):
            point[i] += weight * slopes[i]
    for i in range(len(y)):
        point[i] = y[i] + dt * point[i]


@compiled
def error_parts(stages, i):
    """Return the estimates of orders 5 and 3 of the error in component i, per unit of step."""
    e5, e3 = 0.0, 0.0
    for j in range(STAGES):
        e5 += E5[j] * stages[j, i]
        e3 += E3[j] * stages[j, i]
    return e5, e3


@compiled
def combined_error(dt, sum_5, sum_3, size):
    """Return the error of a step of a system of `size` components, as Hairer's code combines the estimates.

    Args:
        dt: length of the step.
        sum_5: of the squares of the estimates of order 5, each relative to its component's scale.
        sum_3: of those of order 3.
        size: number of components.
    """
    if sum_5 == 0 and sum_3 == 0:
        return 0.0
    combined = (sum_5 + 0.01 * sum_3) * size
    if not combined < np.inf:
        # Divided by it, any error would be none.
        return np.inf
    return abs(dt) * sum_5 / combined**0.5


@compiled
def step_factor(error):
    """Return the factor from a step to the next, or to its next try.

    Args:
        error: of the step, relative to the error allowed.
    """
    if error == 0:
        return _GROW_MOST
    # An error that is not a number comes from an overflow inside the step.
    if not error >= 0:
        return _SHRINK_MOST
    return min(_GROW_MOST, max(_SAFETY * error ** (-1 / 8), _SHRINK_MOST))
