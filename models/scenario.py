"""What is tossed: coin, air, floor, release and ending; frozen, and validated when made."""

import math
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Annotated, Any, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationError,
    ValidationInfo,
    field_validator,
    model_validator,
)

from models.attitude import Quaternion, quaternion_from_angles, rotation_matrix
from models.barriers import highest_on_floor
from models.body import AirLaw, Body, Rules
from models.clearance import damping_rate
from models.drag import linear_drag, sliding_share
from models.errors import FieldError, ScenarioError, describe, require_type
from models.fields import lambda_unit, put
from models.geometry import gap
from models.inertia import (
    cylinder_inertia,
    inertia_about_mass_center,
    is_positive_definite,
    obeys_triangle_inequality,
)
from models.kernel.vectors import Matrix, Vector
from models.laws import ContactLaw, EndingTest, RestitutionKind
from models.units import in_si
from models.unused import warn_of_unused_fields
from models.words import Word
from models.writing import toml


def _named(kind: type[Word]) -> Callable[[Any], Any]:
    def member(value: Any) -> Any:
        for item in kind:
            if isinstance(value, str | kind) and value == item:
                return item
        raise ValueError("one of " + ", ".join(f'"{item}"' for item in kind))

    return member


def _quantity(unit: str) -> BeforeValidator:
    return BeforeValidator(lambda value: in_si(value, unit) if isinstance(value, str) else value)


def _list_of(count: int, accepted: str) -> BeforeValidator:
    def as_tuple(value: Any) -> Any:
        entries = value.tolist() if isinstance(value, np.ndarray) else value
        if not isinstance(entries, list | tuple) or len(entries) != count:
            raise ValueError(f"a list of {count} {accepted}")
        return tuple(entries)

    return BeforeValidator(as_tuple)


# Sizes beyond all coins, within which products of powers stay far from the range of floating-point numbers.
LARGEST, SMALLEST = 1e9, 1e-9
# Spins and drags beyond all tosses, which would take hours to follow; against √(g/r).
FASTEST_SPIN, FASTEST_DRAG = 1e5, 1e4
# In an angle beyond it the digits that tell one attitude from another are gone [rad].
LARGEST_ANGLE = 1e6
# More impacts than a coin needs that loses energy; and enough of one that may never lose any.
MOST_IMPACTS, MOST_LOSSLESS = 30_000_000, 1_000_000
# Euler parameters whose norm is 1 within rounding stay as they are: made from angles, or brought to norm 1
# before, they would change in their last digit.
NORM_ROUNDING = 1e-15

_within = Field(ge=-LARGEST, le=LARGEST)
_size = Field(ge=SMALLEST, le=LARGEST)
_not_negative = Field(ge=0, le=LARGEST)

Number = Annotated[float, _quantity("")]
Mass = Annotated[float, _quantity("kg")]
Length = Annotated[float, _quantity("m"), _within]
Speed = Annotated[float, _quantity("m/s"), _within]
Angle = Annotated[float, _quantity("rad"), Field(ge=-LARGEST_ANGLE, le=LARGEST_ANGLE)]
Spin = Annotated[float, _quantity("rad/s")]
Inertia = Annotated[float, _quantity("kg*m**2"), _within]
_Lengths = tuple[Length, Length, Length]
Offset = Annotated[_Lengths, _list_of(3, 'lengths, such as [0, 0, "0.1 mm"]')]
Position = Annotated[_Lengths, _list_of(3, "lengths, such as [0, 0, 0.4]")]
Speeds = Annotated[tuple[Speed, Speed, Speed], _list_of(3, 'speeds, such as [0, 0, "2 m/s"]')]
Angles = Annotated[tuple[Angle, Angle, Angle], _list_of(3, 'angles, such as [0, "7 deg", 0]')]
Spins = Annotated[tuple[Spin, Spin, Spin], _list_of(3, 'spins, such as [0, "40 rad/s", 0]')]
EulerParameters = Annotated[
    tuple[Number, Number, Number, Number], _list_of(4, "numbers of norm 1, such as [1, 0, 0, 0]")
]
_Row = Annotated[tuple[Inertia, Inertia, Inertia], _list_of(3, "moments of inertia, such as [8e-8, 0, 0]")]
_Rows = Annotated[
    tuple[_Row, _Row, _Row],
    _list_of(3, "lists of 3 moments of inertia, such as [[8e-8, 0, 0], [0, 8e-8, 0], [0, 0, 1.6e-7]]"),
]
_ZERO = (0.0, 0.0, 0.0)
# Up to this kinematic restitution `coulomb` and its limit add energy in hardly an impact.
_ROUTHS, _TAKING = (ContactLaw.COULOMB, ContactLaw.PERFECTLY_ROUGH), 0.7
_IN_CONTACT = (ContactLaw.SMOOTH, *_ROUTHS)
RESISTANCES = ("rolling_friction", "pivoting_friction")
"""The fields of a floor that resist the motion of a coin in sustained contact."""


class _Part(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    def __init__(self, **fields: Any) -> None:
        """Make it of its fields, checked as those of a scenario file are.

        Raises:
            ScenarioError: naming field, value and what is accepted.
        """
        try:
            super().__init__(**fields)
        except ValidationError as error:
            raise ScenarioError(describe(error, type(self))) from None

    # Parts of a scenario are checked with it, and not made one by one.
    __init__.__dict__["__pydantic_base_init__"] = True

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """Return a copy.

        Raises:
            TypeError: for an update, which would not be checked.
        """
        if update:
            raise TypeError(
                "model_copy: accepted: no update; Scenario.replace changes fields and checks them"
            )
        return super().model_copy(deep=deep)


class Coin(_Part):
    """A cylinder of radius r and thickness h whose mass centre C may lie off its geometric centre B."""

    mass: Annotated[Mass, _size]
    """m [kg]."""
    radius: Annotated[float, _quantity("m"), _size]
    """r [m]."""
    thickness: Annotated[float, _quantity("m"), _not_negative]
    """h [m]; 0 for the thin coin."""
    center_of_mass: Offset = _ZERO
    """c, from B to C, body frame (ξ, η, ζ) [m]."""
    inertia: _Rows | None = None
    """J_C about C, body frame, products of inertia with their minus sign [kg m²]; by default the uniform
    cylinder's about B, moved to C."""

    @field_validator("center_of_mass")
    @classmethod
    def _inside_the_coin(cls, c: Vector, info: ValidationInfo) -> Vector:
        r, h = info.data.get("radius"), info.data.get("thickness")
        if r is not None and not np.hypot(c[0], c[1]) < r:
            raise ValueError(f"a point inside the coin: sqrt(xi^2 + eta^2) < radius = {r} m")
        if h is not None and not abs(c[2]) <= h / 2:
            raise ValueError(f"a point inside the coin: |zeta| <= thickness/2 = {h / 2} m")
        return c

    @field_validator("inertia")
    @classmethod
    def _inertia_of_a_body(cls, inertia: Matrix | None, info: ValidationInfo) -> Matrix | None:
        if inertia is None:
            return None
        J = np.array(inertia)
        if not np.allclose(J, J.T, rtol=0, atol=1e-12 * np.abs(J).max()):
            raise ValueError("a symmetric 3 by 3 matrix")
        if not is_positive_definite(J):
            raise ValueError("a positive definite matrix: every principal moment > 0")
        if not obeys_triangle_inequality(J):
            raise ValueError("a body's inertia: no principal moment above the sum of the other two")
        m, r = info.data.get("mass"), info.data.get("radius")
        if m is not None and r is not None:
            moments = np.linalg.eigvalsh(J) / (m * r * r)
            if not (moments[0] >= 1e-6 and moments[-1] <= 1e6):
                raise ValueError(f"principal moments from 1e-6 to 1e6 m r^2 = {m * r * r:.3g} kg m^2")
        return inertia

    @model_validator(mode="after")
    def _positive_inertia(self) -> Self:
        if self.inertia is None and not is_positive_definite(self.inertia_about_C):
            raise FieldError(
                "center_of_mass",
                self.center_of_mass,
                "a center of mass that leaves a positive definite inertia about it, "
                f"such as sqrt(xi^2 + eta^2) < radius/2 = {self.radius / 2} m, or give coin.inertia",
            )
        if self.inertia is None and not obeys_triangle_inequality(self.inertia_about_C):
            raise FieldError(
                "center_of_mass",
                self.center_of_mass,
                "a center of mass that leaves an inertia about it with no principal moment above the sum of "
                "the other two, so one nearer to (0, 0, 0), or give coin.inertia",
            )
        return self

    @property
    def inertia_about_C(self) -> NDArray[np.float64]:
        """J_C, body frame, (3, 3), read-only [kg m²]."""
        if self.inertia is not None:
            J = np.array(self.inertia)
        else:
            J_B = cylinder_inertia(self.mass, self.radius, self.thickness)
            J = inertia_about_mass_center(J_B, self.mass, self.center_of_mass)
        J.setflags(write=False)
        return J


class Air(_Part):
    """The air's resistance: the force on a surface element is -λ |v|^b v dA."""

    exponent: Annotated[Number, Field(ge=0, le=1)] = 0.0
    """b: 0 for linear, 1 for quadratic resistance."""
    normal: Annotated[float, _not_negative] = 0.0
    """λ_n, of pressure [kg m^(-2-b) s^(b-1)]."""
    tangential: Annotated[float, _not_negative] = 0.0
    """λ_τ, of friction [kg m^(-2-b) s^(b-1)]."""

    @field_validator("normal", "tangential", mode="before")
    @classmethod
    def _unit_of_lambda(cls, value: Any, info: ValidationInfo) -> Any:
        if not isinstance(value, str):
            return value
        b = info.data.get("exponent", 0.0)
        return in_si(value, lambda_unit(b))


class Floor(_Part):
    """The floor at z = 0 and how a coin rebounds from it."""

    restitution: Annotated[Number, Field(ge=0, le=1)]
    """χ: normal speed of the contact point after an impact over that before it."""
    restitution_threshold: Annotated[float, _quantity("m/s"), _not_negative] = 0.0
    """Normal speed of approach up to which a touch is plastic, χ = 0 [m/s]."""
    contact: Annotated[ContactLaw, BeforeValidator(_named(ContactLaw))]
    """The contact law."""
    friction: Annotated[Number, _not_negative] = 0.0
    """μ, for the laws that slide with friction."""
    rolling_friction: Annotated[float, _quantity("m"), _not_negative] = 0.0
    """δ: the moment against rolling in sustained contact, over the normal force [m]."""
    pivoting_friction: Annotated[float, _quantity("m"), _not_negative] = 0.0
    """p: likewise against pivoting about the vertical [m]."""
    restitution_kind: Annotated[RestitutionKind, BeforeValidator(_named(RestitutionKind))] = (
        RestitutionKind.KINEMATIC
    )
    """"kinematic", or "energetic" for the law "coulomb"."""

    @model_validator(mode="after")
    def _kind_of_a_law_that_has_it(self) -> Self:
        if self.restitution_kind == RestitutionKind.ENERGETIC and self.contact != ContactLaw.COULOMB:
            raise FieldError(
                "restitution_kind",
                str(self.restitution_kind),
                f'"kinematic" with contact = "{self.contact}"; "energetic" only with "coulomb"',
            )
        return self

    @model_validator(mode="after")
    def _resistance_of_a_law_in_contact(self) -> Self:
        for name in RESISTANCES:
            if getattr(self, name) > 0 and self.contact not in _IN_CONTACT:
                accepted = ", ".join(f'"{law}"' for law in _IN_CONTACT)
                raise FieldError(
                    name,
                    getattr(self, name),
                    f'0 with contact = "{self.contact}", which is not followed into sustained contact; '
                    f"a length with {accepted}",
                )
        return self

    @property
    def takes_energy(self) -> bool:
        """Whether impacts take energy, and add none or hardly any (docs/CONTACT.md)."""
        if self.contact == ContactLaw.SMOOTH or self.restitution_kind == RestitutionKind.ENERGETIC:
            return self.restitution < 1
        return self.contact in _ROUTHS and self.restitution <= _TAKING


class Release(_Part):
    """The state at time 0."""

    position: Position
    """Of C, space frame [m]."""
    velocity: Speeds = _ZERO
    """Of C, space frame [m/s]."""
    angles: Angles | None = None
    """ψ, θ, φ, the classical Euler angles (z-x-z) [rad]; a flat coin, heads up, by default."""
    quaternion: EulerParameters | None = None
    """Euler parameters e0, e1, e2, e3, body to space, in place of the angles; brought to norm 1."""
    angular_velocity: Spins = _ZERO
    """ω, body frame (ξ, η, ζ) [rad/s]."""

    @field_validator("quaternion")
    @classmethod
    def _unit_norm(cls, e: Quaternion | None) -> Quaternion | None:
        if e is None:
            return None
        size = math.hypot(*e)
        if not abs(size - 1) <= 1e-3:
            raise ValueError(f"four numbers of norm 1 within 1e-3 (the norm here is {size:.6g})")
        if abs(size - 1) <= NORM_ROUNDING:
            return e
        return tuple(x / size for x in e)  # pyright: ignore[reportReturnType]

    @model_validator(mode="after")
    def _one_attitude(self) -> Self:
        if self.angles is not None and self.quaternion is not None:
            raise FieldError("quaternion", self.quaternion, "either angles or quaternion, not both")
        return self

    @property
    def attitude(self) -> Quaternion:
        """Euler parameters e0, e1, e2, e3, body to space, of norm 1."""
        return self.quaternion or quaternion_from_angles(self.angles or _ZERO)


class EndingCriteria(_Part):
    """When a toss is over."""

    test: Annotated[EndingTest, BeforeValidator(_named(EndingTest))] = EndingTest.RIGOROUS
    """What decides that the face up is final."""
    max_impacts: Annotated[int | None, Field(ge=1, le=MOST_IMPACTS)] = None
    """The toss stops after so many impacts; by default after `MOST_IMPACTS`, or after `MOST_LOSSLESS` where
    impacts may take no energy."""
    max_time: Annotated[float, _quantity("s"), _size] = 1_000_000.0
    """The toss stops at this time [s]."""
    caught: Annotated[float | None, _size, _quantity("m")] = None
    """Height at which a hand catches the coin: the toss ends, with the face up, when C first comes down to it
    [m]."""


class Scenario(_Part):
    """One toss, told once for both engines."""

    gravity: Annotated[float, _quantity("m/s**2"), _size] = 9.81
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
        warn_of_unused_fields(self)

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
        return _as_in_a_file(self.model_dump(exclude_none=True))

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


def _as_in_a_file(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _as_in_a_file(entry) for name, entry in value.items()}
    if isinstance(value, tuple):
        return [_as_in_a_file(entry) for entry in value]
    return str(value) if isinstance(value, Word) else value


def _rows(M: NDArray[np.floating]) -> Matrix:
    first, second, third = (vector(row) for row in M)
    return first, second, third


def vector(row: NDArray[np.floating]) -> Vector:
    """Give three numbers of an array as a tuple, as a scenario keeps them."""
    x, y, z = row.tolist()
    return x, y, z


def euler_parameters(row: NDArray[np.floating]) -> Quaternion:
    """Give four numbers of an array as a tuple, as a scenario keeps them."""
    e0, e1, e2, e3 = row.tolist()
    return e0, e1, e2, e3
