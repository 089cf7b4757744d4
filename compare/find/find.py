"""Find a toss that shows a sequence of faces or an outcome."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from cointoss import analytic
from cointoss.compare.find.fields import spans
from cointoss.compare.find.search import Hit, Searched, search
from cointoss.compare.find.window import Target
from cointoss.compare.metrics.estimates import share_of
from cointoss.compare.sweep.axes import Span
from cointoss.compare.sweep.errors import MOST_SEED, SweepError, require_whole
from cointoss.compare.sweep.window import Window
from cointoss.models.devices import Device
from cointoss.models.errors import ScenarioError
from cointoss.models.processor import Processor
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import Outcome, Toss
from cointoss.models.scenario import Scenario
from cointoss.models.stages import stage
from cointoss.models.writing import toml

USUAL_TOSSES, MOST_TOSSES = 1 << 16, 1 << 30
LONGEST = 1000
"""The most faces of a sequence."""


@dataclass(frozen=True, kw_only=True)
class Room:
    """How far a field may change, alone, before the toss shows something else."""

    span: Span
    value: float
    """The field's value in the toss that was found [span.unit]."""
    down: float
    up: float
    """The smallest changes to either side that were found to show something else [span.unit]; infinite where
    no change up to the width of the window does."""


@dataclass(frozen=True, kw_only=True)
class Found:
    """What a search for a toss found."""

    target: Target
    window: Window
    tosses: int
    """The number of tosses made over the window."""
    refused: int
    """The number of points of the window that make no scenario, and so no toss."""
    scenario: Scenario | None
    """The scenario of the toss that shows what was asked for; None where no toss does."""
    rooms: tuple[Room, ...]
    """How far each field that varies may change."""
    trusted: int
    """How many of the touches asked for can be trusted in the toss that was found."""
    longest: int
    """The most steps of what was asked for, faces and then outcome, that any toss showed."""

    def __bool__(self) -> bool:
        """Return whether there is such a toss."""
        return self.scenario is not None

    @cached_property
    def toss(self) -> Toss | None:
        """The whole toss that was found, by the analytic engine."""
        return None if self.scenario is None else analytic.toss(self.scenario)

    @property
    def lines(self) -> list[str]:
        """What was found, for a person."""
        wanted, spans = self.target.in_words, self.window.spans
        covering = [f"{x.field} from {x.start:.6g} to {x.stop:.6g} {x.printed_unit}".rstrip() for x in spans]
        made = f"{self.tosses:,d} {'toss' if self.tosses == 1 else 'tosses'}, covering {', '.join(covering)}"
        if self.refused:
            made += f", where {self.refused:,d} more points make no scenario"
        if self.scenario is None:
            most = share_of(0, self.tosses).high
            shown = f"; the longest part shown is {self.target.sequence[: self.longest] or 'nothing'}"
            return [
                f"none in {made}{shown if self.target.sequence else ''}",
                f"at most {100 * most:.2g} % of the tosses in the window show {wanted} (99 %)",
            ]
        lines = [f"{wanted}: found in {made}"]
        for room in self.rooms:
            unit = f" {room.span.printed_unit}".rstrip()
            ends = [
                f"{sign}{end:.3g}{unit}" if math.isfinite(end) else f"none found {side}"
                for sign, end, side in (("-", room.down, "below"), ("+", room.up, "above"))
            ]
            lines.append(f"margin of {room.span.field}: {', '.join(ends)}")
        if self.target.sequence:
            lines.append(f"trusted: {self.trusted} of {len(self.target.sequence)} touches")
        if self.target.outcome is not None and self.toss is not None:
            lines.append(f"outcome: {self.toss.outcome_told}")
        return lines

    def as_json(self) -> dict[str, Any]:
        """Return what `cointoss find --json` prints, but for the scenario's name and the seed."""
        rooms = {one.span.field: {"value": one.value, "down": one.down, "up": one.up} for one in self.rooms}
        target, toss = self.target, self.toss
        return {
            "sequence": target.sequence,
            "outcome": None if target.outcome is None else str(target.outcome),
            "covering": {one.field: [one.start, one.stop] for one in self.window.spans},
            "tosses": self.tosses,
            "refused": self.refused,
            "longest": target.sequence[: self.longest],
            "found": None if self.scenario is None else self.scenario.as_tables(),
            "margins": rooms,
            "trusted": self.trusted,
            "outcome_certain": None if toss is None else toss.outcome_certain,
        }

    def to_toml(self) -> str:
        """Return the scenario file of the toss, what was found before it in comments.

        Raises:
            ValueError: where no toss was found.
        """
        if self.scenario is None:
            raise ValueError("Found: no toss shows it; accepted: one that was found")
        return "".join(f"# {line}\n" for line in self.lines) + "\n" + toml(self.scenario.as_tables())


def find(
    scenario: ScenarioSource,
    vary: Mapping[str, Any],
    *,
    sequence: str = "",
    outcome: Outcome | str | None = None,
    tosses: int = USUAL_TOSSES,
    seed: int = 0,
    device: Device | str = Device.CPU,
) -> Found:
    """Search a window of a scenario for a toss that shows a sequence of faces, an outcome, or both.

        found = find("fig24a", {"height": (0.2, 0.6), "release.angular_velocity.eta": (20, 60)},
                     sequence="HTTH")
        found.scenario, found.rooms

    Of the tosses found, it returns the one farthest from tosses that show something else. The result is
    false, as in `if found`, where no toss shows it.

    Args:
        scenario: a `Scenario`, the path of its file, or the name of one that comes with the package.
        vary: the range of each field that may vary, (START, STOP) or "START:STOP", in numbers in SI or texts
            with a unit. A name may be a part that no other field has.
        sequence: faces up at the first touches, as in "HTTH".
        outcome: such as `Outcome.EDGE` or "edge".
        tosses: the most tosses over the window; where many show it, the search stops earlier.
        seed: for the points of the window.
        device: what computes the outcomes: "cpu", "cuda" or "auto", as in `toss_many`; the CPU always finds
            the faces.

    Raises:
        ScenarioError: naming file, field, value and what is accepted.
        ValueError: naming the argument, its value and what is accepted.
        UnsupportedError: for the device "cuda" and no outcome, or a scenario that no card tosses.
        DeviceError: for the device "cuda" where no card can be used, and where one fails.
    """
    return find_telling(
        lambda _: None,
        scenario,
        vary,
        sequence=sequence,
        outcome=outcome,
        tosses=tosses,
        seed=seed,
        device=device,
    )


def find_telling(
    tell: Callable[[str], None],
    scenario: ScenarioSource,
    vary: Mapping[str, Any],
    *,
    sequence: str,
    outcome: Outcome | str | None,
    tosses: int,
    seed: int,
    device: Device | str,
) -> Found:
    """Find a toss as `find` does, and call `tell` with what was found before the margins are measured."""
    described = scenario_of(scenario)
    require_whole("tosses", tosses, 1, MOST_TOSSES)
    require_whole("seed", seed, 0, MOST_SEED)
    try:
        ending = None if outcome is None else Outcome(outcome)
    except ValueError as error:
        raise SweepError(f"outcome{str(error).removeprefix('Outcome')}") from None
    target = Target(sequence=sequence, outcome=ending, processor=Processor(device))
    if len(sequence) > (most := min(LONGEST, described.rules.max_impacts)):
        raise SweepError(f"sequence: {len(sequence)} faces, accepted: at most {most}, as ending.max_impacts")
    window = Window(scenario=described, spans=spans(vary, described))
    with stage(f"finding {target.in_words}"):
        return _found(window, target, search(window, target, tosses, seed, tell))


def _found(window: Window, target: Target, searched: Searched) -> Found:
    """Return the best of the tosses that the analytic engine, with its own settings, tosses so too."""
    sequence, outcome = target.sequence, target.outcome
    if searched.longest < 0:
        window.scenario_of(window.values(np.full(len(window.spans), 0.5)))  # says why
        raise ScenarioError(
            "no point of the window makes a scenario; accepted: spans in which the coin is free"
        )
    for hit in searched.hits:
        own = window.scenario_of(window.values(hit.point))
        touches = () if outcome is not None else ("ending.max_impacts", len(sequence))
        toss = analytic.toss(own.replace("gravity", own.gravity, *touches))
        if toss.sequence.startswith(sequence) and outcome in (None, toss.outcome):
            trusted = min(toss.trusted_impacts, len(sequence))
            break
    else:
        own, trusted, hit = None, 0, None
    return Found(
        target=target,
        window=window,
        tosses=searched.tosses,
        refused=searched.refused,
        scenario=own,
        rooms=() if hit is None else tuple(_rooms(window, hit)),
        trusted=trusted,
        longest=searched.longest if hit is None else target.steps,
    )


def _rooms(window: Window, hit: Hit) -> Iterator[Room]:
    for span, value, (down, up) in zip(window.spans, window.values(hit.point), hit.margins, strict=True):
        width = span.stop - span.start
        ends = (down, up) if width > 0 else (up, down)
        down, up = (abs(width) * float(end) for end in ends)
        yield Room(span=span, value=float(value), down=down, up=up)
