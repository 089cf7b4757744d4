"""What is counted: a scenario tossed by a hand, along some fields, by one engine or both."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine
from cointoss.compare.sweep.axes import HAND, Axis, axis_given
from cointoss.compare.sweep.errors import MOST_SEED, SweepError, require_whole
from cointoss.models.batch import STATE, refused, rows_from_states, scenario_of_row
from cointoss.models.devices import Device
from cointoss.models.errors import FieldError, ScenarioError
from cointoss.models.fields import UNITS
from cointoss.models.hand import OF_A_TOSS, Hand
from cointoss.models.parts import Release
from cointoss.models.processor import Processor
from cointoss.models.quantities import LARGEST
from cointoss.models.records import Array, Outcome
from cointoss.models.scenario import Scenario
from cointoss.models.stages import counted
from cointoss.models.unused import warn_of_unused_fields

MOST_AXES = 2
MOST_SETTINGS = 10_000
MOST_TOSSES = 10_000_000
"""The most tosses of a setting."""
USUAL_TOSSES = 1000
"""Tosses of a setting where neither their number nor the width of an interval is given."""
FIELDS = {
    **HAND,
    **{name: unit for name, unit in UNITS.items() if not name.startswith("release.")},
}
"""What may vary, and its unit: the hand releases the coin, so the scenario's release is of no use."""
_HIGH = Release(position=(0.0, 0.0, LARGEST))
_GIVES = {"position": "height", "velocity": "speed", "angular_velocity": "spin"}
"""The number of the hand that gives each part of a release."""


class GridPoint(NamedTuple):
    """A point of the grid."""

    scenario: Scenario
    hand: Hand
    place: str
    """The values in words, after what is wrong there; empty for the one point of no fields."""

    def states(self, rng: np.random.Generator, count: int) -> Array:
        """Draw states at release, (n, 13)."""
        return self.hand.states(self.scenario.body, rng, count)


@dataclass(frozen=True, kw_only=True)
class Plan:
    """What is counted, and until when."""

    scenario: Scenario
    name: str
    """What the scenario is called; empty for one without a name."""
    hand: Hand
    vary: tuple[Axis, ...] = ()
    engines: tuple[Engine, ...] = (Engine.ANALYTIC,)
    seed: int = 0
    tosses: int = USUAL_TOSSES
    """The most tosses of each setting."""
    to: float | None = None
    """Half the width of a setting's widest interval at which its counting stops; None: it does not."""
    processor: Processor = field(default_factory=Processor, compare=False)
    """What tosses, and counts what a card tossed."""

    def __post_init__(self) -> None:
        """Check the numbers, and that the axes go together.

        Raises:
            SweepError, FieldError: naming what is wrong and what is accepted.
        """
        require_whole("seed", self.seed, 0, MOST_SEED)
        require_whole("tosses", self.tosses, 1, MOST_TOSSES)
        if self.to is not None and not (isinstance(self.to, float) and 1e-4 <= self.to <= 0.5):
            raise FieldError("to", self.to, "a part from 0.01 % to 50 %")
        names = [axis.field for axis in self.vary]
        if len(names) > MOST_AXES:
            raise SweepError(f"vary: {len(names)} fields, accepted: at most {MOST_AXES}")
        if len(set(names)) < len(names):
            raise SweepError(f"{names[0]}: on both axes; accepted: two fields")
        for name in names:
            if self.hand.spun and name.removeprefix("hand.").removeprefix("ending.") in OF_A_TOSS:
                raise SweepError(f"{name}: of no use where the coin is spun on its edge; accepted: others")
        if math.prod(self.shape) > MOST_SETTINGS:
            grid = " by ".join(map(str, self.shape))
            raise SweepError(f"vary: {grid} settings, accepted: at most {MOST_SETTINGS}")

    @property
    def shape(self) -> tuple[int, ...]:
        """Values of each field."""
        return tuple(axis.count for axis in self.vary)

    @property
    def catches(self) -> bool:
        """Whether a hand catches the coin."""
        varied = any(axis.field == "ending.caught" for axis in self.vary)
        return varied or self.hand.caught is not None or self.scenario.ending.caught is not None

    @property
    def unvaried(self) -> str:
        """Why all tosses of a setting are alike, in words; empty where something of the hand varies."""
        return "" if any(axis.field in HAND for axis in self.vary) else self.hand.unvaried

    def counted(self, counts: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the counts that enter the shares, (..., 6): a coin that the hand does not catch enters none.

        Args:
            counts: of all tosses, by code of `Outcome`, (..., 6).
        """
        return np.where(self.catches & (np.arange(len(Outcome)) == Outcome.UNDECIDED), 0, counts)

    def setting(self, number: int) -> GridPoint:
        """Return a point of the grid by its number; the last field varies fastest.

        Raises:
            SweepError: for values that make no valid scenario or hand.
        """
        at = np.unravel_index(number, self.shape) if self.vary else ()
        values = {axis.field: float(axis.values[i]) for axis, i in zip(self.vary, at, strict=True)}
        words = ", ".join(f"{name} = {value:g}" for name, value in values.items())
        place = f" (at {words})" if words else ""
        try:
            of_hand = {name.removeprefix("hand."): values[name] for name in values if name in HAND}
            hand = replace(self.hand, **of_hand)
            # The scenario's own release is not used, and is out of the way of any coin.
            scenario = hand.scenario(self.scenario).replace("release", _HIGH)
            for name in (name for name in values if name not in HAND):
                whole = name == "ending.max_impacts"
                scenario = scenario.replace(name, int(values[name]) if whole else values[name])
        except FieldError as error:
            raise SweepError(f"hand.{error}") from None
        except ScenarioError as error:
            raise SweepError(f"{error}{place}") from None
        return GridPoint(scenario, hand, place)


def plan_of(
    vary: Mapping[str, Any], scenario: Scenario, *, tosses: int | None, to: float | None, **others: Any
) -> Plan:
    """Return the plan whose fields vary so.

    Args:
        vary: by field a range START:STOP:N, as text or as (START, STOP, N).
        scenario: whose coin is tossed.
        tosses: the most tosses of each setting; None for the usual number.
        to: as in a plan.
        others: fields of the plan.

    Raises:
        SweepError, FieldError: naming what is wrong and what is accepted.
    """
    if not isinstance(vary, Mapping):
        raise SweepError(f'vary: {vary!r}, accepted: a dict such as {{"hand.height": "0.2:2:10"}}')
    if of_the_release := [name for name in vary if str(name).startswith("release.")]:
        accepted = f"{', '.join(HAND)}, and others"
        raise SweepError(f"{of_the_release[0]}: the hand releases the coin; accepted: {accepted}")
    axes = tuple(axis_given(name, given, scenario, FIELDS) for name, given in vary.items())
    if tosses is None:
        tosses = USUAL_TOSSES if to is None else MOST_TOSSES
    return Plan(scenario=scenario, vary=axes, tosses=tosses, to=to, **others)


def rows_of_releases(setting: GridPoint, states: Array) -> Array:
    """Return a setting's scenario released in each of many states, (n, 13), as rows, (n, m).

    Raises:
        SweepError: for a state that the scenario refuses, naming what of the hand made it.
    """
    rows = rows_from_states(setting.scenario, states)
    wrong = refused(rows, STATE)
    if wrong.any():
        try:
            scenario_of_row(rows[np.argmax(wrong)])
        except ScenarioError as error:
            field, _, why = str(error).partition(" = ")
            name = _GIVES[field.split(".")[1].partition("[")[0]]
            accepted = f"accepted: {why.partition('accepted: ')[2]}{setting.place}"
            raise SweepError(f"hand.{name} = {getattr(setting.hand, name):g}: {accepted}") from None
    return rows


def check(plan: Plan) -> None:
    """Refuse a plan with a setting that can't be tossed.

    Raises:
        SweepError: naming field, value and what is accepted.
        UnsupportedError: for a scenario that an engine can't toss, or not on that device.
        DeviceError: for the device "cuda" without a card that can be used.

    Warns:
        UnusedFieldWarning: for a field that nothing uses.
    """
    setting = plan.setting(0)
    for number in counted("checking the grid", "settings", range(math.prod(plan.shape))):
        setting = plan.setting(number)
        for engine in plan.engines:
            engine.package.require_supported(setting.scenario, settings=engine.package.MANY)
            rows = rows_of_releases(setting, setting.states(np.random.default_rng(plan.seed), 1))
            if plan.processor.device is Device.CUDA:
                engine.package.require_rows(rows, device=plan.processor)
    warn_of_unused_fields(setting.scenario.floor, setting.scenario.air)
