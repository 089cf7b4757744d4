"""An axis of a map: a field of the scenario and its values."""

import difflib
import math
from dataclasses import dataclass

import numpy as np

from cointoss.compare.sweep.errors import SweepError
from cointoss.models.fields import UNITS, WORDS, lambda_unit, printed_unit
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from cointoss.models.units import in_si

MOST_VALUES = 1_000_000
"""On one axis: a map of more than 1e12 pixels fits no disk."""
FORM = "FIELD=START:STOP:N, such as release.position.z=0.2:0.6:400"


@dataclass(frozen=True, kw_only=True)
class Axis:
    """A field that varies along one side of a map, evenly from `start` to `stop`, both included."""

    field: str
    unit: str
    """SI, in pint's spelling."""
    start: float
    stop: float
    count: int

    @property
    def is_of_release(self) -> bool:
        """Whether its field is of the release, which may differ between the tosses of one coin."""
        return self.field.startswith("release.")

    @property
    def word(self) -> str:
        """What a person calls its field."""
        return WORDS[self.field]

    @property
    def printed_unit(self) -> str:
        """Its unit as a person writes it."""
        return printed_unit(self.unit)

    @property
    def values(self) -> Array:
        """The field's values, (count,) [unit]."""
        return np.linspace(self.start, self.stop, self.count)


def parse_axis(text: str, scenario: Scenario) -> Axis:
    """Read an axis from FIELD=START:STOP:N; numbers are SI, or carry a unit: "coin.mass=2 g:5 g:100".

    Raises:
        SweepError: naming what is wrong and what is accepted.
    """
    field, equals, span = text.partition("=")
    field = field.strip()
    parts = span.split(":")
    if not equals or len(parts) != 3:
        raise SweepError(f"{text}: accepted: {FORM}")
    unit = _unit_of(field, scenario)
    start, stop = (_number(field, part, unit) for part in parts[:2])
    if start == stop:
        raise SweepError(f"{text}: START = STOP; accepted: two numbers that differ")
    try:
        count = int(parts[2])
    except ValueError:
        count = 0
    if not 2 <= count <= MOST_VALUES:
        raise SweepError(f"{text}: N = {parts[2]}; accepted: a whole number from 2 to {MOST_VALUES}")
    axis = Axis(field=field, unit=unit, start=start, stop=stop, count=count)
    if field == "ending.max_impacts" and not np.all(np.mod(axis.values, 1) == 0):
        raise SweepError(f"{text}: accepted: START, STOP and N that give whole numbers only, such as 1:9:9")
    return axis


def _unit_of(field: str, scenario: Scenario) -> str:
    if field not in UNITS:
        near = difflib.get_close_matches(field, UNITS, n=1)
        hint = f" (did you mean {near[0]}?)" if near else ""
        raise SweepError(f"{field}: no numeric field of a scenario; accepted: {', '.join(UNITS)}{hint}")
    return lambda_unit(scenario.air.exponent) if field in ("air.normal", "air.tangential") else UNITS[field]


def _number(field: str, text: str, unit: str) -> float:
    try:
        number = float(text)
    except ValueError:
        try:
            number = in_si(text, unit)
        except ValueError as error:
            raise SweepError(f"{field} = {text}: accepted: {error}") from None
    if not math.isfinite(number):
        raise SweepError(f"{field} = {text}: accepted: a finite number")
    return number
