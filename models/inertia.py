"""The inertia of a coin about its geometric centre B and its mass centre C."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

# A thin coin's principal moments obey A + B = C exactly, so rounding alone can break the inequality.
TRIANGLE_TOLERANCE = 1e-12


def cylinder_inertia(mass: float, radius: float, thickness: float) -> NDArray[np.float64]:
    """Return J_B, the inertia of a uniform cylinder about its centre.

    J_ξ = J_η = m r²/4 + m h²/12 and J_ζ = m r²/2; Strzalko et al. 2008, before eq. (34).

    Args:
        mass: m [kg].
        radius: r [m].
        thickness: h [m].

    Returns:
        J_B: body frame, (3, 3) [kg m²].
    """
    across = mass * (radius**2 / 4 + thickness**2 / 12)
    return np.diag([across, across, mass * radius**2 / 2])


def inertia_about_mass_center(J_B: ArrayLike, mass: float, center: ArrayLike) -> NDArray[np.float64]:
    """Move an inertia from B to C: J_C = J_B - m (|c|² I - c cᵀ).

    The paper leaves the inertia of its imperfect coin unsaid. Here J_B stays the uniform cylinder's,
    whatever the offset c, and the parallel-axis theorem gives J_C.

    Args:
        J_B: inertia about B, body frame, (3, 3) [kg m²].
        mass: m [kg].
        center: c, the vector from B to C, body frame, (3,) [m].

    Returns:
        J_C: body frame, (3, 3) [kg m²]. Not positive definite when c is too long.
    """
    c = np.asarray(center, dtype=float)
    return np.asarray(J_B, dtype=float) - mass * (c @ c * np.eye(3) - np.outer(c, c))


def is_positive_definite(J: ArrayLike) -> bool:
    """Return whether every principal moment of J is positive beyond rounding."""
    if not np.all(np.isfinite(J)):
        return False
    moments = np.linalg.eigvalsh(np.asarray(J, dtype=float))
    return bool(moments[0] > 1e-14 * abs(moments[-1]))


def obeys_triangle_inequality(J: ArrayLike) -> bool:
    """Return whether no principal moment exceeds the sum of the other two, as for every real body."""
    low, middle, high = np.linalg.eigvalsh(np.asarray(J, dtype=float))
    return bool(high <= low + middle + TRIANGLE_TOLERANCE * (low + middle + high))
