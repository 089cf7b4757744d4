"""What is tossed: a coin, its air, floor, release and ending, told once; frozen, and validated when made."""

import math
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import (
    ValidationError,
    model_validator,
)

from cointoss.models.attitude import Quaternion, rotation_matrix
from cointoss.models.barriers import highest_on_floor
from cointoss.models.body import AirLaw, Body, Rules
from cointoss.models.clearance import damping_rate
from cointoss.models.drag import linear_drag, sliding_share
from cointoss.models.errors import FieldError, ScenarioError, describe, require_type
from cointoss.models.fields import put
from cointoss.models.geometry import gap
from cointoss.models.kernel.vectors import Matrix, Vector
from cointoss.models.parts import (
    FASTEST_DRAG,
    FASTEST_SPIN,
    MOST_IMPACTS,
    MOST_LOSSLESS,
    RESISTANCES,
    Acceleration,
    Air,
    Coin,
    EndingCriteria,
    Floor,
    Part,
    Release,
)
from cointoss.models.unused import warn_of_unused_fields
from cointoss.models.writing import toml


class Scenario(Part):
    """One toss, told once for both engines."""

    gravity: Acceleration = 9.81
    """g [m/s²]."""
    coin: Coin
    air: Air = Air()
    floor: Floor
    release: Release
    ending: EndingCriteria = EndingCriteria()

    def __init__(self, **fields: Any) -> None:
        """Make it of its parts, checked as a scenario file is.

        Raises:
            ScenarioError: naming field, value and what is accepted.

        Warns:
            UnusedFieldWarning: for a field that nothing uses.
        """
        super().__init__(**fields)
        warn_of_unused_fields(self.floor, self.air)

    # A map's scenario, and one that `replace` returns, are validated without it.
    __init__.__dict__["__pydantic_base_init__"] = True

    @model_validator(mode="after")
    def _above_the_floor(self) -> Self:
        numbers = np.hstack([np.ravel(part) for part in self.body if not isinstance(part, AirLaw)])
        if not np.all(np.isfinite(numbers)):
            raise FieldError(
                "coin", self.coin, "a coin whose inertia, its inverse and drag are finite numbers"
            )
        R = rotation_matrix(self.release.attitude)
        clearance = gap(self.body, self.release.position[2], R[2])
        if clearance < -1e-12 * self.coin.radius:
            z = self.release.position[2]
            raise FieldError("release.position.z", z, f"a coin above the floor: z >= {z - clearance:.6g} m")
        return self

    @model_validator(mode="after")
    def _within_reach(self) -> Self:
        rate = (self.gravity / self.coin.radius) ** 0.5
        w = self.release.angular_velocity
        if not math.hypot(*w) <= FASTEST_SPIN * rate:
            accepted = f"a spin of at most {FASTEST_SPIN:g} sqrt(g/r) = {FASTEST_SPIN * rate:.3g} rad/s"
            raise FieldError("release.angular_velocity", w, accepted)
        fall = (2 * max(self.release.position[2], 0) / self.gravity) ** 0.5
        if not damping_rate(self.body, self.release.velocity, w, fall) <= FASTEST_DRAG * rate:
            accepted = f"air that slows the coin at a rate of at most {FASTEST_DRAG:g} sqrt(g/r)"
            raise FieldError("air", self.air, accepted)
        return self

    @model_validator(mode="after")
    def _pressed_in_one_way(self) -> Self:
        sizes = [getattr(self.floor, name) for name in RESISTANCES]
        if not any(sizes):
            return self
        # Up to there K + q ẑᵀ is positive definite: see analytic/contact/resistance.py.
        most = 2 * (self.body.inertia_smallest / self.coin.mass) ** 0.5
        if not math.hypot(*sizes) < most:
            name, size = max(zip(RESISTANCES, sizes, strict=True), key=lambda pair: pair[1])
            accepted = (
                "lengths with sqrt(rolling_friction^2 + pivoting_friction^2) < 2 sqrt(J/m) "
                f"= {most:.6g} m, J the least moment of inertia: beyond, the floor's force has no solution"
            )
            raise FieldError(f"floor.{name}", size, accepted)
        return self

    @model_validator(mode="after")
    def _caught_in_flight(self) -> Self:
        caught, reach = self.ending.caught, highest_on_floor(self.body)
        if caught is not None and not caught > reach:
            accepted = f"more than {reach:.6g} m, so that the coin is caught in flight"
            raise FieldError("ending.caught", caught, accepted)
        return self

    def replace(self, field: str, value: Any, /, *more: Any) -> "Scenario":
        """Return a scenario with other values of some fields, checked as a scenario file is.

            scenario.replace("floor.restitution", 0.5, "release.position.z", "40 cm", "air", Air())

        Values take their places in turn. `release.angles` and `release.quaternion` replace each other.

        Args:
            field: a dotted path, components by name; without a dot, gravity or a whole part.
            value: as a scenario file gives it, or a part such as a `Coin`.
            more: further fields, each with its value.

        Raises:
            ScenarioError: naming field, value and what is accepted.
            TypeError: for a field without a value.
        """
        pairs = (field, value, *more)
        if len(pairs) % 2:
            raise TypeError(
                f"Scenario.replace: {pairs[-1]} without a value; accepted: fields and values in turn"
            )
        data = self.model_dump()
        for name, new in zip(pairs[::2], pairs[1::2], strict=True):
            require_type("field", name, str, 'a dotted path, such as "floor.restitution"')
            put(data, name, new)
        try:
            return Scenario.model_validate(data)
        except ValidationError as error:
            raise ScenarioError(describe(error, Scenario)) from None

    def as_tables(self) -> dict[str, Any]:
        """Return the scenario as a file has it: numbers in SI, lists, words for what has a name."""
        return self.model_dump(mode="json", exclude_none=True)

    def to_toml(self) -> str:
        """Return the text of a scenario file, defaults included, that `parse` reads as this very scenario."""
        return toml(self.as_tables())

    @cached_property
    def body(self) -> Body:
        """The coin in its air and gravity, for compiled code."""
        coin, air = self.coin, self.air
        J = coin.inertia_about_C
        moments = np.linalg.eigvalsh(J)
        drag = linear_drag(coin.radius, coin.thickness, air.normal, air.tangential)
        is_linear = air.exponent == 0 or air.normal == air.tangential == 0
        return Body(
            mass=coin.mass,
            radius=coin.radius,
            thickness=coin.thickness,
            center=coin.center_of_mass,
            inertia=_rows(J),
            inertia_inverse=_rows(np.linalg.inv(J)),
            inertia_smallest=float(moments[0]),
            inertia_largest=float(moments[-1]),
            air=AirLaw(None if is_linear else air.exponent, normal=air.normal, tangential=air.tangential),
            drag=drag,
            sliding_share=sliding_share(drag, float(np.linalg.norm(coin.center_of_mass))),
            gravity=self.gravity,
        )

    @property
    def rules(self) -> Rules:
        """The floor and the ending, for compiled code."""
        floor, ending = self.floor, self.ending
        most = ending.max_impacts
        if most is None:
            most = MOST_IMPACTS if floor.takes_energy else MOST_LOSSLESS
        return Rules(
            law=floor.contact,
            restitution=floor.restitution,
            restitution_threshold=floor.restitution_threshold,
            restitution_kind=floor.restitution_kind,
            friction=floor.friction,
            rolling_friction=floor.rolling_friction,
            pivoting_friction=floor.pivoting_friction,
            test=ending.test,
            max_impacts=most,
            max_time=ending.max_time,
            caught=math.inf if ending.caught is None else ending.caught,
        )


def _rows(M: NDArray[np.floating]) -> Matrix:
    first, second, third = (vector(row) for row in M)
    return first, second, third


def vector(row: NDArray[np.floating]) -> Vector:
    """Return three numbers of an array as a tuple, as a scenario keeps them."""
    x, y, z = row.tolist()
    return x, y, z


def euler_parameters(row: NDArray[np.floating]) -> Quaternion:
    """Return four numbers of an array as a tuple, as a scenario keeps them."""
    e0, e1, e2, e3 = row.tolist()
    return e0, e1, e2, e3
