"""A scenario: a coin, its air, floor, release and ending; frozen, and validated when made."""

from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import (
    ValidationError,
    model_validator,
)

from cointoss.models.attitude import Quaternion
from cointoss.models.body import Body, Rules
from cointoss.models.describing import describe
from cointoss.models.errors import FieldError, ScenarioError, require_type
from cointoss.models.faults import Fault, FoundFault
from cointoss.models.fields import put
from cointoss.models.kernel.vectors import Vector
from cointoss.models.making import MOST_LOSSLESS
from cointoss.models.parts import (
    Air,
    Coin,
    EndingCriteria,
    Floor,
    Part,
    Release,
    refuse,
)
from cointoss.models.quantities import Gravity
from cointoss.models.unlikely import unlikely_units, warn_of_unlikely_units
from cointoss.models.unused import warn_of_unused_fields
from cointoss.models.writing import toml

MOST_KEPT, KEPT_BYTES = MOST_LOSSLESS, 416
"""Impacts of a toss that keeps them all, and the memory that each takes, with the flight after it."""
_STILL = (0.0, 0.0, 0.0)


class Scenario(Part):
    """The description of one toss, for both engines."""

    gravity: Gravity = 9.81
    """g [m/s²]."""
    coin: Coin
    air: Air = Air()
    floor: Floor
    release: Release
    ending: EndingCriteria = EndingCriteria()

    def __init__(self, **fields: Any) -> None:
        """Make the scenario from its parts, checked like a scenario file.

        Raises:
            ScenarioError: naming field, value and what is accepted.

        Warns:
            UnusedFieldWarning: for a field that nothing uses.
            UnitWarning: for a number that was probably meant in another unit.
        """
        super().__init__(**fields)
        warn_of_unused_fields(self.floor, self.air)
        warn_of_unlikely_units(self.gravity, self.coin, self.release, self.ending)

    # A map's scenario, and one that `replace` returns, are validated without it.
    __init__.__dict__["__pydantic_base_init__"] = True

    @model_validator(mode="after")
    def _together(self) -> Self:
        from cointoss.models.entries import examine

        if self.release.rolls:
            object.__setattr__(self, "release", self._rolling())
        found = np.empty(3)
        try:
            examine(self._row, found)
            refuse(FoundFault(Fault(int(found[0])), float(found[1])), self)
        except FieldError as error:  # a coin of 12 m is in the floor
            doubted = unlikely_units(self.gravity, self.coin, self.release, self.ending).values()
            asked = "".join(f"{line}; " for line in doubted)
            raise FieldError(error.field, error.value, error.accepted, asked) from None
        return self

    def _rolling(self) -> Release:
        """Return the release on the floor, with the height and the velocity of a coin that rolls.

        Raises:
            FieldError: for another height or velocity.
        """
        from cointoss.models.entries import roll_each
        from cointoss.models.rows import AT

        row, (x, y, height), velocity = self._row, self.release.position, self.release.velocity
        roll_each(row[np.newaxis])
        z, v = float(row[AT.release_position_z]), vector(row[AT.release_velocity_x :][:3])
        if height not in (0, z):
            raise FieldError("release.position.z", height, f"0 with rolls, which sets the coin at {z:.6g} m")
        if velocity not in (_STILL, v):
            raise FieldError("release.velocity", velocity, "no such field with rolls, from which it follows")
        found: dict[str, Any] = dict(self.release) | {"position": (x, y, z), "velocity": v}
        return Release.model_construct(**found)

    def replace(self, field: str, value: Any, /, *more: Any) -> "Scenario":
        """Return a scenario with other values of some fields, checked as a scenario file is.

            scenario.replace("floor.restitution", 0.5, "release.position.z", "40 cm", "air", Air())

        Values are set one after another. `release.angles` and `release.quaternion` replace each other.

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
        if self.release.rolls and dict(zip(pairs[::2], pairs[1::2], strict=True)).get("release.rolls", True):
            data["release"] |= {"position": (*self.release.position[:2], 0.0), "velocity": _STILL}
        for name, new in zip(pairs[::2], pairs[1::2], strict=True):
            require_type("field", name, str, 'a dotted path, such as "floor.restitution"')
            put(data, name, new)
        return Scenario.checked(data)

    @classmethod
    def checked(cls, tables: dict[str, Any]) -> "Scenario":
        """Return the scenario of tables, checked like a scenario file, without warnings of unused fields.

        Raises:
            ScenarioError: naming field, value and what is accepted.
        """
        try:
            return cls.model_validate(tables)
        except ValidationError as error:
            raise ScenarioError(describe(error, cls)) from None

    def as_tables(self) -> dict[str, Any]:
        """Return the scenario as tables, as in a file: numbers in SI, lists, and words."""
        return self.model_dump(mode="json", exclude_none=True)

    def to_toml(self) -> str:
        """Return the text of a scenario file, defaults included, that `parse` reads as the same scenario."""
        return toml(self.as_tables())

    @property
    def _row(self) -> NDArray[np.float64]:
        """The scenario as compiled code reads it, by the rows' own module, which needs this one."""
        from cointoss.models.rows import row_of

        return row_of(self)  # pyright: ignore[reportArgumentType]

    @cached_property
    def body(self) -> Body:
        """The coin in its air and gravity, for compiled code."""
        from cointoss.models.entries import body_in_any_air

        body = body_in_any_air(self._row)
        return body if body.air.exponent else body._replace(air=body.air._replace(exponent=None))

    @cached_property
    def rules(self) -> Rules:
        """The floor and the ending, for compiled code."""
        from cointoss.models.entries import rules_of

        words = {"law": self.floor.contact, "test": self.ending.test}
        return rules_of(self._row)._replace(**words, restitution_kind=self.floor.restitution_kind)


def keeping_all(rules: Rules, scenario: Scenario) -> Rules:
    """Return the rules of a toss that keeps all its impacts, as its trust needs: at most `MOST_KEPT`.

    Raises:
        ScenarioError: where the scenario asks for more.
    """
    asked = scenario.ending.max_impacts or 0
    if asked > MOST_KEPT:
        raise ScenarioError(
            f"ending.max_impacts = {asked}: accepted: at most {MOST_KEPT} where all are kept, as of one toss "
            f"({asked * KEPT_BYTES / 1e9:.3g} GB here); toss_many and maps keep none"
        )
    return rules._replace(max_impacts=min(rules.max_impacts, MOST_KEPT))


def vector(row: NDArray[np.floating]) -> Vector:
    """Return three numbers of an array as a tuple, as a scenario keeps them."""
    x, y, z = row.tolist()
    return x, y, z


def euler_parameters(row: NDArray[np.floating]) -> Quaternion:
    """Return four numbers of an array as a tuple, as a scenario keeps them."""
    e0, e1, e2, e3 = row.tolist()
    return e0, e1, e2, e3
