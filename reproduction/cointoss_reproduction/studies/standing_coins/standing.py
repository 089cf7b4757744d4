"""How near an ideal coin on a smooth floor is to standing: steady motion at the top of its potential."""

from dataclasses import dataclass

import numpy as np

from cointoss.study import Array, Body, rotation_matrix

_NEWTON_STEPS = 20
_LEANS = 0.8
"""A coin that would have to lean further does not stand [rad]."""


@dataclass(frozen=True, kw_only=True)
class Standing:
    """How near a coin is to standing, at n moments."""

    lack: Array
    """Energy of its tilting, and that which its tilt lacks to the top, (n,) [m g r]; infinite where the spin
    leaves no top."""
    angle: Array
    """The angle between coin and vertical, + where heads is up, (n,) [rad]."""
    lean: Array
    """The angle between coin and vertical at the top, (n,) [rad]."""
    energy: Array
    """The energy of the coin that stands, horizontal motion aside, (n,) [m g r]."""
    rate: Array
    """The rate at which the standing coin falls, exp(rate t), (n,) [1/s]."""


def standing(body: Body, states: Array) -> Standing:
    """Return how near a coin in contact with a smooth floor is to standing.

    Its spin has L_z and L_ζ, which such a floor never changes, and air slowly. Tilting is a motion with one
    degree of freedom in the potential, at an angle x from the vertical, of
    m g (r cos x + (h/2)|sin x|) + (L_z - L_ζ sin x)²/(2 J_ξ cos² x) (Routh). At its top the coin stands, and
    leans where it has both L_z and L_ζ; without either the top is m g r, for a thin coin.

    Args:
        body: an ideal coin.
        states: (n, 13).
    """
    J, J_normal, m, g = body.inertia[0][0], body.inertia[2][2], body.mass, body.gravity
    up = np.array([rotation_matrix(e)[2] for e in states[:, 6:10]])
    v, w = states[:, 3:6], states[:, 10:13]
    L = w * [J, J, J_normal]
    L_z, L_normal = np.sum(up * L, axis=1), L[:, 2]
    side = np.where(up[:, 2] > 0, 1.0, -1.0)
    height = m * g * np.array([body.radius, body.thickness / 2])

    def potential(x: Array) -> Array:
        spinning = (L_z - L_normal * np.sin(x)) ** 2 / (2 * J * np.cos(x) ** 2)
        return height[0] * np.cos(x) + height[1] * side * np.sin(x) + spinning

    def slopes(x: Array) -> tuple[Array, Array]:
        s, c = np.sin(x), np.cos(x)
        a, b = L_z - L_normal * s, L_z * s - L_normal
        first = -height[0] * s + height[1] * side * c + a * b / (J * c**3)
        curved = ((a * L_z - b * L_normal) * c**2 + 3 * s * a * b) / (J * c**4)
        return first, -height[0] * c - height[1] * side * s + curved

    lean = side * np.arctan2(height[1], height[0])
    with np.errstate(all="ignore"):
        for _ in range(_NEWTON_STEPS):
            first, second = slopes(lean)
            lean = lean - first / second
        first, second = slopes(lean)
        stands = (second < 0) & (np.abs(lean) < _LEANS) & (np.abs(first) < 1e-9 * height[0])
        # The height of C changes with the tilt, but at the top without spin.
        lever = (-height[0] * np.sin(lean) + height[1] * side * np.cos(lean)) / (m * g)
        rate = np.sqrt(-second / (J + m * lever**2))
    x = np.arcsin(np.clip(up[:, 2], -1, 1))
    of_normal = L_normal**2 / (2 * J_normal)
    E = m * (v[:, 2] ** 2 / 2 + g * states[:, 2]) + np.sum(w * L, axis=1) / 2 - of_normal
    top = potential(lean)
    lack = (np.abs(E - potential(x)) + np.abs(top - potential(x))) / height[0]
    return Standing(
        lack=np.where(stands, lack, np.inf),
        angle=x,
        lean=lean,
        energy=(top + of_normal) / height[0],
        rate=rate,
    )
