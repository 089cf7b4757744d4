"""What came of the suite for one engine: as lines, as JSON, as a page."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib import resources
from typing import Any

import jinja2
import numpy as np

from cointoss_yardstick.simulators.simulator import Simulator
from cointoss_yardstick.suite.hints import hints
from cointoss_yardstick.suite.running import Result, Run, Status

ROUNDING = 1e-12
"""An error below this is shown as 0."""
MOST_SHOWN = 6
"""Numbers of a value that are shown."""


@dataclass(frozen=True, kw_only=True)
class Card:
    """An engine, and what came of the cases."""

    name: str
    dt: float | None
    """The engine's own step [s]; None for an engine that goes from event to event."""
    settings: dict[str, str | float]
    results: tuple[Result, ...]

    @classmethod
    def of(cls, engine: Simulator, results: Sequence[Result]) -> "Card":
        """Make the card of an engine."""
        about = engine.answering.about
        return cls(name=engine.name, dt=engine.dt, settings=dict(about["settings"]), results=tuple(results))

    @property
    def missed(self) -> tuple[Result, ...]:
        """The cases whose error is above its tolerance, and those that failed."""
        return tuple(each for each in self.results if each.own.status in (Status.MISSED, Status.FAILED))

    @property
    def told(self) -> str:
        """How many cases the engine passes, in one line."""
        counts = {status: sum(each.own.status == status for each in self.results) for status in Status}
        more = [f"{count} {status}" for status, count in counts.items() if count and status != Status.MET]
        return ", ".join([f"{counts[Status.MET]} of {len(self.results)} cases met", *more])

    @cached_property
    def hints(self) -> list[str]:
        """The likely causes of what is missed; see `cointoss_yardstick.suite.hints`."""
        return hints(self.results)

    @property
    def steps(self) -> str:
        """How the engine steps, in words."""
        return "from event to event" if self.dt is None else f"steps of {1e3 * self.dt:g} ms"

    def as_json(self) -> dict[str, Any]:
        """Return it for JSON, in full precision."""
        return {
            "engine": self.name,
            "dt": self.dt,
            "settings": self.settings,
            "cases": [_as_json(result) for result in self.results],
            "hints": self.hints,
        }

    def as_lines(self) -> str:
        """Return it as text: a line for each case, and what was found for right where it is missed."""
        head = [
            *(f"  {name} = {value}" for name, value in self.settings.items()),
            "",
            "error: relative to the scale of the case; order: of the error in the step",
            f"{'case':18} {'error':>8} {'limit':>8} {'order':>5}",
        ]
        rows = [line for result in self.results for line in _lines(result)]
        likely = [f"likely: {each}" for each in self.hints]
        return "\n".join([f"{self.name}, {self.steps}", *head, *rows, "", *likely, self.told])

    def page(self) -> str:
        """Return it as a page of HTML, which needs no other file."""
        folder = resources.files("cointoss_yardstick.suite")
        environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
        template = environment.from_string((folder / "card.html.j2").read_text(encoding="utf-8"))
        return template.render(
            card=self,
            value=value,
            error=error_told,
            order=order_told,
            lasting=lasting_told,
            height=height_told,
        )


def _as_json(result: Result) -> dict[str, Any]:
    case = result.case
    return {
        "name": case.name,
        "title": case.title,
        "quantity": case.quantity,
        "right": case.right,
        "source": case.source,
        "tolerance": result.tolerance,
        "reason": case.reason,
        "order": result.order,
        "lasting": result.lasting,
        **_run_as_json(result.own),
        "runs": [{"dt": run.dt, **_run_as_json(run)} for run in result.runs],
    }


def _run_as_json(run: Run) -> dict[str, Any]:
    return {
        "status": str(run.status),
        "found": run.found,
        "error": run.error if run.found else None,
        "height": run.height if run.found else None,
        "processor_time": run.processor_time,
        "why": run.why,
    }


def _lines(result: Result) -> list[str]:
    own, case = result.own, result.case
    order = order_told(result)
    lines = [f"{case.name:18} {error_told(own):>8} {result.tolerance:>8g} {order:>5}  {own.status}"]
    if own.status == Status.MISSED:
        lines += [
            f"  {case.title}",
            f"  found {value(own.found)}, right {value(case.right)}{height_told(own)}",
        ]
    elif own.why:
        lines += [f"  {own.why}"]
    return [*lines, *(f"  {told}" for told in [lasting_told(result)] if told)]


def value(numbers: Sequence[float]) -> str:
    """Return a value as text, its first numbers where there are many."""
    least = 1e-9 * max(map(abs, numbers), default=0.0)
    told = [f"{number if abs(number) > least else 0:.5g}" for number in numbers[:MOST_SHOWN]]
    return ", ".join([*told, *(["..."] if len(numbers) > MOST_SHOWN else [])]) or "nothing"


def error_told(run: Run) -> str:
    """Return the error of a run as text."""
    if run.error < ROUNDING:
        return "0"
    return f"{run.error:.1e}" if np.isfinite(run.error) else "-"


def height_told(run: Run) -> str:
    """Return at which height the lowest point touches or lies, as text; "" where that is allowed."""
    return f"; the lowest point touches or lies at {1e3 * run.height:+.3g} mm" if run.height else ""


def lasting_told(result: Result) -> str:
    """Return the error that lasts, as text; "" where none does."""
    return (
        f"an error of {result.lasting:.1e} does not shrink with the step: the law differs"
        if result.lasting
        else ""
    )


def order_told(result: Result) -> str:
    """Return the order of a case's error in the step as text."""
    return "-" if result.order is None else f"{result.order:.1f}"
