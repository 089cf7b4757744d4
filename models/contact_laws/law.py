"""What a contact law is: one record, with the impulse that it gives and what holds of it.

Strzalko et al. 2008, section 4.3 and Fig. 17. The velocity of the contact point A has the parts v_Aτ along
the coin's edge, v_Aν across it, both in the floor, and v_Az.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.vectors import Matrix, Vector
from cointoss.models.laws import RestitutionKind

NO_IMPULSE = (0.0, 0.0, 0.0)


class Impact(NamedTuple):
    """What a contact law is given of an impact at the point A, space frame."""

    delassus: Matrix
    """K, the inverse effective mass of A, symmetric: an impulse S gives v_A' = v_A + K S [1/kg]."""
    velocity: Vector
    """v_A before the impact, v_Az < 0 [m/s]."""
    tau: Vector
    """Unit vector along the coin's edge at A, horizontal."""
    restitution: float
    """χ of this impact."""
    friction: float
    """The floor's coefficient of friction μ."""
    restitution_kind: RestitutionKind
    """What χ compares."""


class Recorded(NamedTuple):
    """Impacts as a toss records them, on which a law's constraint is measured: n of them, space frame."""

    before: Array
    """v_A before each impact, (n, 3) [m/s]."""
    after: Array
    """v_A after it, (n, 3) [m/s]."""
    impulse: Array
    """S, (n, 3) [N s]."""
    tau: Array
    """Unit vectors along the coin's edge at A, (n, 3)."""
    nu: Array
    """Horizontal unit vectors across it, (n, 3)."""
    friction: float
    """The floor's μ."""

    @property
    def horizontal(self) -> Array:
        """The size of the impulse's horizontal part, (n,) [N s]."""
        return np.hypot(self.impulse[:, 0], self.impulse[:, 1])

    @property
    def size(self) -> Array:
        """|S|, (n,) [N s]."""
        return np.linalg.norm(self.impulse, axis=1)

    def changed(self, direction: Array) -> Array:
        """Return by how much the velocity in a direction has changed, relative to |v_A| before, (n,)."""
        return np.abs(dot_each(self.after - self.before, direction)) / self._speed

    def left(self, direction: Array) -> Array:
        """Return how much velocity is left in a direction, relative to |v_A| before, (n,)."""
        return np.abs(dot_each(self.after, direction)) / self._speed

    @property
    def _speed(self) -> Array:
        return np.linalg.norm(self.before, axis=1)


def dot_each(a: Array, b: Array) -> Array:
    """Return the dot products of vectors, (n,)."""
    return np.sum(a * b, axis=-1)


class Law(NamedTuple):
    """A contact law: how the impulse follows from the impact, and what holds of it.

    With kinematic restitution every law keeps Newton's v_Az' = -χ v_Az, eq. (85). A coin that lands flat
    gets a vertical impulse through C by each of them, which is not asked of the law.
    """

    impulse: Callable[[Impact], tuple[Vector, bool]]
    """Compiled: S, space frame [N s], and whether there is one; `NO_IMPULSE` where there is none."""
    missed: Callable[[Recorded], Array]
    """By how much recorded impacts miss the law's own constraint, (n,): velocities relative to |v_A|,
    impulses to |S|."""
    uses_friction: bool = False
    """Whether the impulse depends on the floor's μ, with a kink where A does not slip or does not close."""
    jumps_without_slip: bool = False
    """Whether with μ > 0 the impulse has no limit as the slip before the impact goes to zero."""
    is_smooth: bool = False
    """Whether every impulse is vertical, so that C keeps its horizontal velocity in vacuum."""
    spares_spin: bool = False
    """Whether an ideal coin gets no impulse along its edge, so that it keeps its spin about ζ: its K couples
    τ to neither ν nor z."""
    is_rough: bool = False
    """Whether it is the limit of Coulomb friction as μ grows."""
    is_followed: bool = False
    """Whether it holds in sustained contact too, with the floor's friction if it uses that; without it, a
    toss that chatters ends there as `chatter`, and the floor resists no rolling or pivoting."""
    never_adds_energy: bool = False
    """Whether it is proved that no impact adds energy."""
    hardly_adds_energy: bool = False
    """Whether with little restitution hardly an impact adds energy; see `cointoss.models.making`."""
    may_be_energetic: bool = False
    """Whether it can go with energetic restitution."""
    is_in_mujoco: bool = False
    """Whether the MuJoCo engine has it, on a floor of large friction if it is rough."""
