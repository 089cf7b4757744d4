"""Complete elliptic integrals, by the arithmetic-geometric mean."""

import math

from cointoss.models.kernel.compiled import compiled

_ROUNDING = 1e-16


@compiled
def complete_elliptic(m: float) -> tuple[float, float]:
    """Return K(m) and E(m) of the parameter m, 0 <= m <= 1; at 1 K is that of the next smaller number.

    Abramowitz and Stegun, Handbook of Mathematical Functions, section 17.6.
    """
    a, b, squares, weight = 1.0, max(1 - m, _ROUNDING) ** 0.5, m / 2, 1.0
    # The mean squares its error: after so many steps it has converged for all m.
    for _ in range(8):
        c = (a - b) / 2
        a, b = (a + b) / 2, (a * b) ** 0.5
        squares += weight * c * c
        weight *= 2
    K = math.pi / (2 * a)
    return K, K * (1 - squares)
