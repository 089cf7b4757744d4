"""A hand: the distribution of its releases."""

import math
from dataclasses import dataclass
from numbers import Real

import numpy as np

from cointoss.models.body import Body
from cointoss.models.errors import FieldError
from cointoss.models.records import Array
from cointoss.models.releases import Releases


@dataclass(frozen=True, kw_only=True)
class Hand:
    """How a hand releases a coin: flat, the first side up, and roughly alike each time.

    The coin's normal keeps the angle ψ to the angular momentum L in flight: at 90° it turns over as Keller's
    coin does, at less it wobbles (P. Diaconis, S. Holmes, R. Montgomery, SIAM Review 49 (2007) 211).
    """

    height: float = 1.0
    """Of C [m]."""
    speed: float = 2.0
    """Of C, upwards [m/s]."""
    spin: float = 120.0
    """L/J_ξ, the rate at which the normal goes round L [rad/s]."""
    psi: float = math.pi / 2
    """ψ [rad]."""
    scatter: float = 0.1
    """Standard deviation of height, speed and spin, relative to each."""
    psi_scatter: float = 0.0
    """Standard deviation of ψ [rad]."""

    def __post_init__(self) -> None:
        """Refuse what no hand does.

        Raises:
            ValueError: naming the field, its value and what is accepted.
        """
        for name, value in vars(self).items():
            if not isinstance(value, Real) or isinstance(value, bool):
                raise FieldError(name, value, "a number")
        accepted = {
            "height": (self.height > 0, "a length above 0, such as 1 m"),
            "speed": (self.speed >= 0, "a speed of 0 or more, such as 2 m/s"),
            "spin": (self.spin >= 0, "a spin of 0 or more, such as 120 rad/s"),
            "psi": (0 <= self.psi <= math.pi / 2, "an angle from 0 to 90 deg"),
            "scatter": (0 <= self.scatter <= 0.3, "a part from 0 to 30 %"),
            "psi_scatter": (0 <= self.psi_scatter <= math.pi / 2, "an angle from 0 to 90 deg"),
        }
        for name, (is_so, what) in accepted.items():
            if not is_so or not math.isfinite(getattr(self, name)):
                raise FieldError(name, getattr(self, name), what)

    def releases(self, body: Body, rng: np.random.Generator, count: int) -> Releases:
        """Draw releases; L is as likely to point to any side.

        Args:
            body: the coin.
            rng: draws them.
            count: how many.
        """
        height, speed, spin = (
            mean * np.maximum(rng.normal(1.0, self.scatter, count), 0.0)
            for mean in (self.height, self.speed, self.spin)
        )
        psi, aside = rng.normal(self.psi, self.psi_scatter, count), rng.uniform(0, 2 * np.pi, count)
        inertia = np.array(body.inertia)
        direction = np.column_stack([np.sin(psi) * np.cos(aside), np.sin(psi) * np.sin(aside), np.cos(psi)])
        momentum = (inertia[0, 0] * spin)[:, None] * direction
        return Releases(
            position=_along_z(height),
            velocity=_along_z(speed),
            quaternion=np.tile((1.0, 0.0, 0.0, 0.0), (count, 1)),
            angular_velocity=np.linalg.solve(inertia, momentum.T).T,
        )


def same_side_probability(psi: Array | float) -> Array:
    """Return how likely an ideal coin is caught with the side up that was up at its release.

    It was released flat, and turns often: 1/2 + asin(cot² ψ)/π for ψ from 45° to 135°, else 1 (Diaconis,
    Holmes and Montgomery 2007, theorem 2).

    Args:
        psi: ψ, of any shape [rad].
    """
    angle = np.asarray(psi, dtype=float)
    off = np.abs(np.cos(angle) / np.maximum(np.abs(np.sin(angle)), 1e-300))
    return 0.5 + np.arcsin(np.minimum(off, 1.0) ** 2) / np.pi


def _along_z(values: Array) -> Array:
    return values[:, None] * np.array([0.0, 0.0, 1.0])
