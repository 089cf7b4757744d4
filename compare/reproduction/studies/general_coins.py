"""What a toss of a general coin costs: 16 classes of coin, air and floor, and where the time goes.

Times are those of the processor on one core. The parts are timed by themselves: compiled loops replay the
flights, impacts and contacts of the same tosses, each loop timed as a whole.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import process_time
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.contact.automaton import Mode, contact_at
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.integrator import contact_work, step_contact
from cointoss.analytic.contact.resets import hit
from cointoss.analytic.entries import toss_coin
from cointoss.analytic.flight.flying import fly
from cointoss.analytic.runs import run
from cointoss.analytic.settings import MANY, contact_limits
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.tables import paragraphs, table
from cointoss.compare.reproduction.setups.ends import ended_as
from cointoss.compare.reproduction.setups.general_coins import CLASSES, CoinClass
from cointoss.compare.reproduction.setups.map_times import map_times
from cointoss.compare.reproduction.setups.study import study
from cointoss.models.body import Body, Rules
from cointoss.models.interruptible import interruptible
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.records import IMPACT_ROW, Array, Ending, Outcome
from cointoss.models.scenario import Scenario

COUNT = 400
"""Tosses of each class."""
CALLS = 101
"""Timed to know what a call from Python takes, which is no part of a toss."""
MOST_PIECES = 100_000
"""Flights and contacts that are replayed together, more or less; each is a state."""
BARS = {"mean": (0.5e-3, True), "percentile_99": (10e-3, True), "median": (1e-3, False)}
"""Of the times of a class: the bar [s], and whether it is one of the classes in air."""
NAMES = {"mean": "mean", "percentile_99": "99th percentile", "median": "median"}
"""Of those times."""
LONGEST = 1.0
"""Bar of the time of any toss [s]."""


@dataclass(frozen=True, kw_only=True)
class TossParts:
    """What a toss is made of, or how long each takes of it on average [s]."""

    flight: float
    """Flying, and locating the touches."""
    impact: float
    """The floor's impulses."""
    contact: float
    """Following sustained contact."""


@dataclass(frozen=True, kw_only=True)
class ClassCosts:
    """Processor times of the tosses of a class [s], and how they ended."""

    tosses: int
    mean: float
    median: float
    percentile_99: float
    worst: float
    parts: TossParts
    ends: dict[str, int]
    """Tosses, by outcome and ending."""

    @property
    def rest(self) -> float:
        """Of the mean: the verdict after each event and step, and the loop [s]."""
        return self.mean - self.parts.flight - self.parts.impact - self.parts.contact


@dataclass(frozen=True)
class GeneralCosts:
    """Processor times of all classes."""

    classes: dict[str, ClassCosts]
    """By the name of the class."""


class FlightsAndContacts(NamedTuple):
    """Flights and contacts of tosses, (n,) each: where they start and when they end."""

    start_times: Array
    modes: NDArray[np.int8]
    states: Array
    """(n, 13)."""
    end_times: Array

    def of(self, chosen: NDArray[np.bool_]) -> "FlightsAndContacts":
        """Return the pieces that are chosen, (n,), as copies."""
        return FlightsAndContacts._make(part[chosen] for part in self)


def compute(progress: Progress, count: int = COUNT) -> GeneralCosts:
    """Toss `count` coins of each class, each by itself, and replay the parts of their tosses."""
    whole = count * len(CLASSES)
    _measured(CLASSES[0], 1, lambda _: None)  # compiles
    classes = {}
    for i, kind in enumerate(CLASSES):

        def tossed(number: int, before: int = i * count) -> None:
            progress(before + number, whole)

        classes[kind.name] = _measured(kind, count, tossed)
    return GeneralCosts(classes)


def _measured(kind: CoinClass, count: int, tossed: Callable[[int], None]) -> ClassCosts:
    return interruptible(lambda: measure(kind, count, tossed))


def measure(kind: CoinClass, count: int, tossed: Callable[[int], None]) -> ClassCosts:
    """Toss coins of a class.

    Args:
        kind: the class.
        count: how many.
        tossed: called with the number of tosses so far, after each.
    """
    scenario, starts = kind.scenario, kind.starts(count)
    times, ends, spent = [], Counter[str](), np.zeros(3)
    kept: list[FlightsAndContacts] = []
    call = call_time(scenario, starts[0])
    for i, start in enumerate(starts):
        time, end = timed_toss(scenario.body, scenario.rules, start)
        times.append(time - call)
        ends[end] += 1
        kept.append(pieces_of(scenario, start))
        if i == count - 1 or sum(len(one.modes) for one in kept) > MOST_PIECES:
            spent += replay(scenario, joined(kept))
            kept = []
        tossed(i + 1)
    flight, impact, contact = (spent / count).tolist()
    return ClassCosts(
        tosses=count,
        mean=float(np.mean(times)),
        median=float(np.median(times)),
        percentile_99=float(np.quantile(times, 0.99)),
        worst=max(times),
        parts=TossParts(flight=flight, impact=impact, contact=contact),
        ends=dict(sorted(ends.items())),
    )


def timed_toss(body: Body, rules: Rules, start: Array) -> tuple[float, str]:
    """Return the processor time of a toss and of its call from Python [s], and its outcome and ending."""
    y, rows = start.copy(), np.zeros(2, IMPACT_ROW)
    began = process_time()
    _, _, _, outcome, ending, _ = toss_coin(body, rules, contact_limits(MANY), y, rows, False)
    return process_time() - began, f"{Outcome(outcome)}, {Ending(ending)}"


def call_time(scenario: Scenario, start: Array) -> float:
    """Return the processor time of a call from Python: of a toss that ends before its first flight [s]."""
    body, rules = scenario.body, scenario.rules._replace(max_impacts=0)
    return float(np.median([timed_toss(body, rules, start)[0] for _ in range(CALLS)]))


def pieces_of(scenario: Scenario, start: Array) -> FlightsAndContacts:
    """Return the flights and contacts of a toss."""
    log = run(scenario.body, scenario.rules, start, MANY)
    return FlightsAndContacts(
        start_times=log.start_times[:-1],
        modes=log.modes[:-1],
        states=log.start_states[:-1],
        end_times=log.start_times[1:],
    )


def joined(kept: Sequence[FlightsAndContacts]) -> FlightsAndContacts:
    """Return the pieces of several tosses as one record."""
    return FlightsAndContacts._make(map(np.concatenate, zip(*kept, strict=True)))


def replay(scenario: Scenario, pieces: FlightsAndContacts) -> Array:
    """Return the processor times of all flights, of the impacts that end them, and of contacts, (3,) [s]."""
    flights, contacts = pieces.of(pieces.modes == Mode.FLIGHT), pieces.of(pieces.modes != Mode.FLIGHT)
    touches = np.zeros(len(flights.modes), dtype=np.bool_)
    body, rules = scenario.body, scenario.rules
    marks = [process_time()]
    replay_flights(body, rules, flights.start_times, flights.states, touches)
    marks.append(process_time())
    replay_impacts(body, rules, flights.states, touches)
    marks.append(process_time())
    replay_contacts(body, rules, MANY.contact_tolerance, *contacts)
    marks.append(process_time())
    return np.diff(marks)


@by_numba
def replay_flights(body, rules, start_times, states, touches):
    """Fly each flight to its touch.

    Args:
        body: the coin.
        rules: floor and ending.
        start_times: (n,) [s].
        states: at the start, (n, 13); become those at the end.
        touches: whether that is a touch, (n,); written to.
    """
    for i in range(len(states)):
        touches[i] = fly(body, states[i], rules.max_time - start_times[i], False).touches


@by_numba
def replay_impacts(body, rules, states, touches):
    """Let the floor act at each touch: states, (n, 13), become those after it; see `replay_flights`."""
    rows = np.zeros(1, IMPACT_ROW)
    for i in range(len(states)):
        if touches[i]:
            hit(body, rules, rules.restitution, states[i], rows[0])


@by_numba
def replay_contacts(body, rules, tolerance, start_times, modes, states, end_times):
    """Follow each contact, by the steps of the toss, to its end.

    Args:
        body: the coin.
        rules: floor and ending.
        tolerance: error allowed in a step, relative to the scales of the coin.
        start_times: (n,) [s].
        modes: numbers of the `Mode`, in contact, (n,).
        states: at the start, (n, 13); become those at the end.
        end_times: (n,) [s].
    """
    friction = friction_in_contact(rules)
    for i in range(len(states)):
        y, mode, time, dt, over = states[i], int(modes[i]), start_times[i], np.inf, False
        stages = contact_work(contact_at(body, friction, mode, y), y)
        while not over:
            contact, longest = contact_at(body, friction, mode, y), min(dt, rules.max_time - time)
            step = step_contact(contact, y, longest, tolerance, stages)
            time += step.elapsed
            dt, over = step.next_dt, step.is_over or not time < end_times[i]


def measures(costs: GeneralCosts) -> dict[str, Any]:
    """Return what the claims name: of each of `BARS` the slowest class, and of all the longest toss."""
    bars = {}
    for which, (most, air) in BARS.items():
        times = {kind.name: getattr(costs.classes[kind.name], which) for kind in CLASSES if kind.air == air}
        slowest = max(times, key=times.__getitem__)
        bars[f"{NAMES[which]} {'in air' if air else 'in vacuum'}"] = {
            "slowest": slowest,
            "time": 1e3 * times[slowest],
            "most": 1e3 * most,
        }
    counts = [one.ends for one in costs.classes.values()]
    return {
        "bars": bars,
        "worst": max(one.worst for one in costs.classes.values()),
        "undecided": sum(ended_as(ends, Outcome.UNDECIDED) for ends in counts),
    }


def tables(costs: GeneralCosts) -> str:
    """Return the tables, in Markdown."""
    classes = costs.classes
    ends = sorted({end for one in classes.values() for end in one.ends})
    media = {
        f"general coin {'in air' if air else 'in vacuum'}": float(
            np.mean([classes[kind.name].mean for kind in CLASSES if kind.air == air])
        )
        for air in (True, False)
    }
    return paragraphs(
        f"Processor time of a toss on one core, over {max(one.tosses for one in classes.values())} tosses of "
        "each class [ms]; flight, impact, contact and the rest (verdict and loop) are parts of the mean.",
        table(
            "coin, air, floor | mean | median | 99 % | worst | flight | impact | contact | rest",
            [[name, *(f"{1e3 * time:.3g}" for time in _times(one))] for name, one in classes.items()],
        ),
        "How they ended.",
        table(
            ["coin, air, floor", *ends],
            [[name, *(str(one.ends.get(end, 0)) for end in ends)] for name, one in classes.items()],
        ),
        "Times of maps, by the mean over the classes.",
        map_times(media),
    )


def _times(costs: ClassCosts) -> tuple[float, ...]:
    parts = costs.parts
    whole = (costs.mean, costs.median, costs.percentile_99, costs.worst)
    return (*whole, parts.flight, parts.impact, parts.contact, costs.rest)


REPRODUCTION = study(__name__, compute, record=GeneralCosts, measures=measures, tables=tables, draw={})
