"""The parts of a scenario: coin, air, floor, release and ending; frozen, and validated when made."""

from collections.abc import Mapping
from functools import cached_property
from typing import Annotated, Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    PlainSerializer,
    ValidationError,
    ValidationInfo,
    field_validator,
    model_validator,
)

from cointoss.models.attitude import Quaternion, normalized
from cointoss.models.describing import accepted, describe
from cointoss.models.errors import FieldError, ScenarioError, shown
from cointoss.models.faults import (
    ACCEPTED,
    Fault,
    FoundFault,
    fault_of_coin,
    fault_of_floor,
    fault_of_quaternion,
)
from cointoss.models.kernel.vectors import Matrix
from cointoss.models.laws import ContactLaw, EndingTest, RestitutionKind
from cointoss.models.making import AT_REST, MOST_IMPACTS, Cylinder, moved_inertia
from cointoss.models.quantities import (
    AS_WORD,
    NOT_NEGATIVE,
    SIZE,
    Angles,
    EulerParameters,
    InertiaRows,
    Label,
    Mass,
    Number,
    Offset,
    Position,
    Speeds,
    Spins,
    each_of,
    named,
    quantity,
    time_or_rest,
)
from cointoss.models.units import in_si, lambda_unit
from cointoss.models.words import Word

_ZERO = (0.0, 0.0, 0.0)
BODY = ("xi", "eta", "zeta")
"""The names of the body axes."""
RESISTANCES = ("rolling_friction", "pivoting_friction", "contour_friction", "contour_viscosity")
"""The fields of a floor that resist the motion of a coin in sustained contact."""


class Part(BaseModel):
    """A scenario or a part of one, frozen and checked."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    def __init__(self, **fields: Any) -> None:
        """Make the part from its fields, checked like those of a scenario file.

        Raises:
            ScenarioError: naming field, value and what is accepted.
        """
        try:
            super().__init__(**fields)
        except ValidationError as error:
            raise ScenarioError(describe(error, type(self))) from None

    # Parts of a scenario are checked with it, and not made one by one.
    __init__.__dict__["__pydantic_base_init__"] = True
    instead: ClassVar[tuple[str, ...]] = ()
    """Names that stand for fields as a file or an argument gives them."""

    def __setattr__(self, name: str, value: Any) -> None:
        """Refuse to change a part, also what was computed of it.

        Raises:
            AttributeError: always, naming the way to a changed scenario.
        """
        raise self._frozen(f"{type(self).__name__}.{name} = {shown(value)}", name, shown(value))

    def __delattr__(self, name: str) -> None:
        """Refuse to take a field away.

        Raises:
            AttributeError: always, naming the way to a changed scenario.
        """
        raise self._frozen(f"del {type(self).__name__}.{name}", name)

    def _frozen(self, done: str, name: str, value: str = "...") -> AttributeError:
        """Return that a field can't be changed; a name that is none has the first field for its example."""
        part = type(self)
        field, given = (name, value) if name in part.model_fields else (next(iter(part.model_fields)), "...")
        table = {"Scenario": "", "EndingCriteria": "ending."}.get(part.__name__, f"{part.__name__.lower()}.")
        return AttributeError(
            f"{done}: is frozen; accepted: a scenario with another value, as of "
            f'scenario.replace("{table}{field}", {given})'
        )

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


def refuse(found: FoundFault, part: Part, **words: str) -> None:
    """Refuse a scenario or a part of one, if a fault was found in it.

    Args:
        found: a fault, or none.
        part: that is checked.
        words: of the fault's sentence.

    Raises:
        FieldError: naming field, value and what is accepted.
    """
    if found.fault == Fault.NONE:
        return
    field, accepted = ACCEPTED[found.fault]
    names = field.split(".")
    if names[0] not in type(part).model_fields:
        del names[0]  # the part's own table
    value: Any = part
    components: tuple[str, ...] = ()
    for name in names:
        if components:
            value = value[components.index(name)]
        else:
            value, components = getattr(value, name), _components_of(value, name)
    value = str(value) if isinstance(value, Word) else value
    raise FieldError(".".join(names), value, accepted.format(limit=found.limit, **words))


def _components_of(part: Part, key: str) -> tuple[str, ...]:
    """Return the names of a field's components, none of one that is no list."""
    labels = [each for each in type(part).model_fields[key].metadata if isinstance(each, Label)]
    return tuple(labels[0].each) if labels else ()


class Coin(Part):
    """A cylinder of radius r and thickness h whose mass centre C may lie off its geometric centre B."""

    mass: Annotated[Mass, SIZE, Label("mass")]
    """m [kg]."""
    radius: Annotated[float, quantity("m"), SIZE, Label("radius")]
    """r [m]."""
    thickness: Annotated[float, quantity("m"), NOT_NEGATIVE, Label("thickness")]
    """h [m]; 0 for the thin coin."""
    center_of_mass: Annotated[Offset, each_of("mass centre", xi="ξ", eta="η", zeta="ζ")] = _ZERO
    """c, from B to C, body frame (ξ, η, ζ) [m]."""
    inertia: InertiaRows | None = None
    """J_C about C, body frame, products of inertia with their minus sign [kg m²]; by default the uniform
    cylinder's about B, moved to C."""

    @model_validator(mode="after")
    def _of_a_body(self) -> Self:
        refuse(
            fault_of_coin(self.cylinder, self.center_of_mass, self.moments, self.inertia is not None), self
        )
        return self

    @property
    def cylinder(self) -> Cylinder:
        """The mass and the size."""
        return Cylinder(self.mass, self.radius, self.thickness)

    @property
    def moments(self) -> Matrix:
        """J_C, body frame, as rows [kg m²]."""
        return moved_inertia(self.cylinder, self.center_of_mass) if self.inertia is None else self.inertia

    @property
    def inertia_about_C(self) -> NDArray[np.float64]:
        """J_C, body frame, (3, 3), read-only [kg m²]."""
        J = np.array(self.moments)
        J.setflags(write=False)
        return J


class _QuadraticDrag(Part):
    """Quadratic resistance, given by a drag coefficient."""

    drag_coefficient: Annotated[Number, NOT_NEGATIVE]
    """C_d of a disk that moves along its axis: the force is ρ C_d/2 π r² v²."""
    density: Annotated[float, quantity("kg/m**3"), NOT_NEGATIVE] = 1.2
    """ρ, by default that of air at 20 °C and 1013 hPa [kg/m³]."""


class Air(Part):
    """The air's resistance: the force on a surface element is -λ |v|^b v dA.

    A `drag_coefficient` C_d, with a `density` ρ of 1.2 kg/m³ if not given, stands for the exponent 1 and the
    `normal` ρ C_d/2, with which a disk that moves along its axis meets the force ρ C_d/2 π r² v².
    """

    exponent: Annotated[Number, Field(ge=0, le=1), Label("exponent b of the air")] = 0.0
    """b: 0 for linear, 1 for quadratic resistance."""
    normal: Annotated[float, NOT_NEGATIVE, Label("pressure λ_n of the air", unit=lambda_unit(0))] = 0.0
    """λ_n, of pressure [kg m^(-2-b) s^(b-1)]."""
    tangential: Annotated[float, NOT_NEGATIVE, Label("friction λ_τ of the air", unit=lambda_unit(0))] = 0.0
    """λ_τ, of friction [kg m^(-2-b) s^(b-1)]."""
    viscosity: Annotated[float, quantity("Pa*s"), NOT_NEGATIVE, Label("viscosity of the air")] = 0.0
    """η, of the air that a nearly flat coin in sustained contact squeezes out of the gap [Pa s]."""
    instead = tuple(_QuadraticDrag.model_fields)

    @field_validator("normal", "tangential", mode="before")
    @classmethod
    def _unit_of_lambda(cls, value: Any, info: ValidationInfo) -> Any:
        if not isinstance(value, str):
            return value
        b = info.data.get("exponent", 0.0)
        return in_si(value, lambda_unit(b))

    @model_validator(mode="before")
    @classmethod
    def _of_drag_coefficient(cls, fields: Any) -> Any:
        """Return the fields with λ_n = ρ C_d/2 and b = 1 in place of a drag coefficient and a density."""
        if not isinstance(fields, Mapping) or fields.keys().isdisjoint(cls.instead):
            return fields
        given = {name: fields[name] for name in cls.instead if name in fields}
        rest = {name: value for name, value in fields.items() if name not in given}
        if "drag_coefficient" not in given:
            raise FieldError("density", given["density"], "a drag_coefficient beside it, or no such field")
        if "normal" in rest:
            raise FieldError("normal", rest["normal"], "either normal or drag_coefficient, not both")
        if rest.get("exponent", 1) != 1:
            raise FieldError("exponent", rest["exponent"], "1 with drag_coefficient, or no such field")
        try:
            drag = _QuadraticDrag.model_validate(given)
        except ValidationError as error:
            name = str(error.errors()[0]["loc"][0])
            raise FieldError(name, given[name], accepted((name,), _QuadraticDrag, "missing")) from None
        return {**rest, "exponent": 1.0, "normal": drag.density * drag.drag_coefficient / 2}


class Floor(Part):
    """The floor at z = 0 and how a coin rebounds from it."""

    restitution: Annotated[Number, Field(ge=0, le=1), Label("restitution χ")]
    """χ: normal speed of the contact point after an impact over that before it."""
    restitution_threshold: Annotated[float, quantity("m/s"), NOT_NEGATIVE, Label("restitution threshold")] = (
        0.0
    )
    """Normal speed of approach up to which a touch is plastic, χ = 0 [m/s]."""
    restitution_speed: Annotated[float, quantity("m/s"), SIZE, Label("speed v₀ of restitution")] = 1.0
    """v₀, the normal speed of approach at which χ is `restitution` [m/s]."""
    restitution_exponent: Annotated[Number, Field(ge=0, le=1), Label("exponent p of restitution")] = 0.0
    """p: at the speed v of approach χ is min(1, χ (v/v₀)^-p); 1/4 of plastic, 0 of constant restitution."""
    restitution_viscous: Annotated[
        float, quantity("s**0.2*m**-0.2"), NOT_NEGATIVE, Label("viscous loss a of restitution")
    ] = 0.0
    """a of a viscoelastic contact, whose χ is 1 - a v^(1/5) + O(v^(2/5)) [(s/m)^(1/5)]; both factors act."""
    contact: Annotated[ContactLaw, BeforeValidator(named(ContactLaw)), AS_WORD]
    """The contact law."""
    friction: Annotated[Number, NOT_NEGATIVE, Label("friction μ")] = 0.0
    """μ, for the laws that slide with friction."""
    rolling_friction: Annotated[float, quantity("m"), NOT_NEGATIVE, Label("rolling friction δ")] = 0.0
    """δ: the moment against rolling in sustained contact, over the normal force [m]."""
    pivoting_friction: Annotated[float, quantity("m"), NOT_NEGATIVE, Label("pivoting friction p")] = 0.0
    """p: the moment against pivoting about the vertical, over the normal force [m]."""
    contour_friction: Annotated[float, quantity("m"), NOT_NEGATIVE, Label("contour friction c")] = 0.0
    """c: the power lost over the normal force, as the contact point runs round the rim at 1 rad/s [m]."""
    contour_viscosity: Annotated[
        float, quantity("m*s"), NOT_NEGATIVE, Label("contour viscosity", unit="m*s")
    ] = 0.0
    """The power lost over the normal force and the square of that rate [m s]."""
    slope: Annotated[float, quantity("rad"), Field(ge=0, le=1.5), Label("slope of the floor")] = 0.0
    """The floor's angle to the horizontal [rad]: x is downhill, and z the floor's normal."""
    restitution_kind: Annotated[RestitutionKind, BeforeValidator(named(RestitutionKind)), AS_WORD] = (
        RestitutionKind.KINEMATIC
    )
    """"kinematic", or "energetic" for the law "coulomb"."""

    @model_validator(mode="after")
    def _of_its_law(self) -> Self:
        found = fault_of_floor(
            self.contact,
            self.restitution_kind,
            self.rolling_friction,
            self.pivoting_friction,
            self.contour_friction,
            self.contour_viscosity,
        )
        refuse(found, self, contact=str(self.contact))
        return self


class Release(Part):
    """The state at time 0."""

    position: Annotated[Position, each_of(x="position x", y="position y", z="height")]
    """The position of C, space frame [m]."""
    velocity: Annotated[Speeds, each_of("velocity", x="x", y="y", z="z")] = _ZERO
    """The velocity of C, space frame [m/s]."""
    angles: Annotated[Angles | None, each_of(psi="angle ψ", theta="tilt θ", phi="angle φ")] = None
    """ψ, θ, φ, the classical Euler angles (z-x-z) [rad]; a flat coin, heads up, by default."""
    quaternion: Annotated[
        EulerParameters | None, each_of("Euler parameter", e0="e₀", e1="e₁", e2="e₂", e3="e₃")
    ] = None
    """Euler parameters e0, e1, e2, e3, body to space, in place of the angles; brought to norm 1."""
    angular_velocity: Annotated[Spins, each_of("spin about", xi="ξ", eta="η", zeta="ζ")] = _ZERO
    """ω, body frame (ξ, η, ζ) [rad/s]."""
    rolls: Annotated[bool | None, Field(repr=False)] = None
    """Whether the coin starts on the floor, with its lowest point at rest. The height and the velocity of C
    follow, and are given as 0, or the position not at all."""

    @model_validator(mode="before")
    @classmethod
    def _at_the_origin(cls, given: Any) -> Any:
        if isinstance(given, Mapping) and given.get("rolls") is True:
            return {"position": _ZERO, **given}
        return given

    @field_validator("quaternion")
    @classmethod
    def _unit_norm(cls, e: Quaternion | None) -> Quaternion | None:
        if e is not None and (found := fault_of_quaternion(e)).fault != Fault.NONE:
            raise ValueError(ACCEPTED[found.fault][1].format(limit=found.limit))
        return e and normalized(e)

    @model_validator(mode="after")
    def _one_attitude(self) -> Self:
        if self.angles is not None and self.quaternion is not None:
            raise FieldError("quaternion", self.quaternion, "either angles or quaternion, not both")
        return self

    @cached_property
    def attitude(self) -> Quaternion:
        """Euler parameters e0, e1, e2, e3, body to space, of norm 1."""
        from cointoss.models.entries import quaternion_from_angles

        return self.quaternion or quaternion_from_angles(self.angles or _ZERO)


class EndingCriteria(Part):
    """The conditions that end a toss."""

    test: Annotated[EndingTest, BeforeValidator(named(EndingTest)), AS_WORD] = EndingTest.RIGOROUS
    """What decides that the face up is final."""
    max_impacts: Annotated[int | None, Field(ge=1, le=MOST_IMPACTS), Label("most impacts")] = None
    """The toss stops after so many impacts; by default see
    `cointoss.models.making.most_impacts`."""
    max_time: Annotated[float, quantity("s"), SIZE, Label("time limit")] = 1_000_000.0
    """The toss stops at this time [s]."""
    caught: Annotated[float | None, SIZE, quantity("m"), Label("height of the catch")] = None
    """Height at which a hand catches the coin: the toss ends, with the face up, when C first comes down to it
    [m]."""
    until: Annotated[
        float | None,
        NOT_NEGATIVE,
        time_or_rest(),
        Label("path until"),
        PlainSerializer(lambda time: "rest" if time == AT_REST else time, when_used="json"),
    ] = None
    """The path goes on to this time after the toss is decided [s], or until the coin is at rest, `AT_REST`.
    By default it ends with the toss. The answers are those of the toss."""
