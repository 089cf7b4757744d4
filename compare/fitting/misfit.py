"""How far tosses miss what was seen: residuals in standard deviations."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.runs import horizon_of, run
from cointoss.analytic.sightings import Sightings, asked_of, sightings
from cointoss.analytic.toss import state_at_release
from cointoss.compare.fitting.observed import Observed
from cointoss.compare.sweep.axes import Span
from cointoss.models.errors import ScenarioError
from cointoss.models.laws import EndingTest
from cointoss.models.records import Array, Face
from cointoss.models.releases import changed_releases, states_of
from cointoss.models.scenario import Scenario

CLOCK = "clock"
"""The time that the observer's clock shows at the release, fitted as if it were a field [s]."""
_OF_FLOOR = ("restitution", "friction")
"""What of the floor may differ between tosses that are made together, as their releases may."""
FACE_SD = 0.02
"""The normal's vertical part may be this far on the wrong side of 0 where a face was seen: 1 degree."""
MISSING = 10.0
"""Standard deviations that a touch misses at least by which the toss does not make."""
IMPOSSIBLE = 1e6
"""Standard deviations that everything misses by where the values make no scenario."""
BEFORE = 10.0
"""Standard deviations of a touch before it by which a frame is surely before it."""
LATER, SOON = 0.25, 0.02
"""A touch that was seen is waited for longer, by this part of the whole time and by these seconds."""


@dataclass(frozen=True, kw_only=True)
class Predicted:
    """What one toss shows beside what was seen."""

    residuals: Array
    """What was seen less what the toss shows, in standard deviations, (n,) in the order of `Misfit.times`."""
    is_tested: NDArray[np.bool_]
    """Which residuals the horizon of trust includes, (n,)."""
    touch_times: Array
    """Times of the touches seen, by the observer's clock, (m,) [s]; NaN where the toss makes none."""
    trusted: int
    """How many leading impacts are within the horizon of trust."""


@dataclass(frozen=True, kw_only=True)
class Misfit:
    """What was seen, and the scenario that is to explain it."""

    scenario: Scenario
    spans: tuple[Span, ...]
    observed: Observed

    @cached_property
    def times(self) -> Array:
        """When each residual was seen: touches, faces, heights, tilts, three for an attitude, (n,) [s]."""
        seen = self.observed
        frames = [seen.times[rows] for rows in self._frames]
        return np.concatenate([seen.touch_times, seen.touch_times[self._faces], *frames])

    @cached_property
    def is_measured(self) -> NDArray[np.bool_]:
        """Which residuals are of a number, not of a face, (n,)."""
        measured = np.ones(len(self.times), dtype=bool)
        first = len(self.observed.touch_times)
        measured[first : first + len(self._faces)] = False
        return measured

    @cached_property
    def _faces(self) -> NDArray[np.intp]:
        return np.flatnonzero(self.observed.faces)

    @cached_property
    def _frames(self) -> list[NDArray[np.intp]]:
        """Rows of the frames with a height, with a tilt, and three times those with an attitude."""
        seen = self.observed
        columns = (seen.heights, seen.tilts, seen.quaternions[:, 0])
        heights, tilts, attitudes = (np.flatnonzero(np.isfinite(values)) for values in columns)
        return [heights, tilts, np.repeat(attitudes, 3)]

    @cached_property
    def _film(self) -> Array:
        """When frames were taken, in the order of time, (m,) [s]."""
        return np.sort(self.observed.times)

    @cached_property
    def _most(self) -> int:
        """How many touches are asked for."""
        return int(self.observed.touch_numbers.max(initial=0))

    @cached_property
    def most_impacts(self) -> int:
        """After how many impacts nothing is seen any more: the last touch, where the film ends before it."""
        seen, most = self.observed, self.scenario.rules.max_impacts
        last = np.max(seen.touch_times - BEFORE * seen.touch_sd, initial=-np.inf)
        return min(most, self._most) if self._film.max(initial=-np.inf) < last else most

    def scenario_of(self, values: Array) -> Scenario:
        """Return the scenario with these values, (k,); raise `ScenarioError` for what is none."""
        return _replaced(self.scenario, {span.field: v for span, v in zip(self.spans, values, strict=True)})

    def residuals(self, values: Array, until: float = np.inf) -> Array:
        """Return the residuals of many tosses, (p, n); `IMPOSSIBLE` for values that make no scenario.

        Args:
            values: of the fields, a row for each toss, (p, k).
            until: what was seen later may have any residuals, which spares most of the work [s].
        """
        found, columns = np.full((len(values), len(self.times)), IMPOSSIBLE), self._columns(values)
        apart = {field: column for field, column in columns.items() if not _may_differ(field)}
        coins = np.array(list(apart.values())).T if apart else np.zeros((len(values), 1))
        for coin in np.unique(coins, axis=0):
            rows = np.flatnonzero(np.all(coins == coin, axis=1))
            try:
                scenario = _replaced(self.scenario, dict(zip(apart, coin, strict=False)))
            except ScenarioError:
                continue
            of_rows = {field: column[rows] for field, column in columns.items()}
            found[rows] = self._of_one_coin(scenario, of_rows, until)
        return found

    def _columns(self, values: Array) -> dict[str, Array]:
        return {span.field: column for span, column in zip(self.spans, values.T, strict=True)}

    def _of_one_coin(self, scenario: Scenario, columns: dict[str, Array], until: float) -> Array:
        """Return the residuals of tosses of one coin, (p, n), from values of its fields, (p,) each."""
        p = len(next(iter(columns.values())))
        clock = columns.get(CLOCK, np.zeros(p))
        chi, mu = (
            columns.get(f"floor.{name}", np.full(p, getattr(scenario.floor, name))) for name in _OF_FLOOR
        )
        changed = {field: column for field, column in columns.items() if field.startswith("release.")}
        start = states_of(changed_releases(scenario.release, p, changed))
        rules = scenario.rules._replace(test=EndingTest.LYING, max_impacts=self.most_impacts)
        film, ends = self._film[self._film <= until], self._ends(clock, until)
        asked = asked_of(p, restitution=chi, friction=mu, max_time=ends, times=film[None] - clock[:, None])
        shown = sightings(scenario.body, rules, start, asked, most=self._most)
        states = np.pad(shown.states, ((0, 0), (0, len(self._film) - len(film)), (0, 0)))
        residuals = np.hstack([self._missed_touches(shown, clock), self._missed_frames(states)])
        residuals[shown.impacts < 0] = IMPOSSIBLE
        return residuals

    def _ends(self, clock: Array, until: float = np.inf) -> Array:
        """Return when tosses end whose release was at `clock` [s]: after all that was seen, or `until`."""
        return (np.maximum(min(self.times.max(), until) - clock, 0.0) + SOON) * (1 + LATER)

    def predicted(self, values: Array) -> Predicted:
        """Return what the toss with these values, (k,), shows; raise `ScenarioError` for what is none."""
        scenario, clock = self.scenario_of(values), self._columns(values[None]).get(CLOCK, np.zeros(1))[0]
        rules = scenario.rules._replace(test=EndingTest.LYING, max_time=float(self._ends(clock)))
        log = run(scenario.body, rules, state_at_release(scenario.release))
        trusted, numbers = horizon_of(scenario.body, rules, log).impacts, self.observed.touch_numbers
        made = np.append(log.rows["time"] + clock, np.full(self._most, np.nan))
        # A toss is open from the first impact that is not trusted; one that is made too few is no such.
        until = made[trusted] if trusted < len(log.rows) else np.inf
        is_open = (numbers > trusted) & (numbers <= len(log.rows))
        frames = [self.observed.times[rows] < until for rows in self._frames]
        return Predicted(
            residuals=self.residuals(values[None])[0],
            is_tested=np.concatenate([~is_open, ~is_open[self._faces], *frames]),
            touch_times=made[numbers - 1],
            trusted=trusted,
        )

    def _missed_touches(self, shown: Sightings, clock: Array) -> Array:
        """Return the residuals of touches and of faces, (p, n)."""
        seen, number = self.observed, self.observed.touch_numbers
        is_made = number <= shown.impacts[:, None]
        late = (seen.touch_times - shown.touch_times[:, number - 1] - clock[:, None]) / seen.touch_sd
        late = np.where(is_made, late, np.copysign(np.abs(late) + MISSING, late))
        heads = np.where(seen.faces == Face.HEADS, 1.0, -1.0)
        turned = np.maximum(-heads * shown.up[:, number - 1], 0.0) / FACE_SD
        return np.hstack([late, turned[:, self._faces]])

    def _missed_frames(self, states: Array) -> Array:
        """Return the residuals of heights, of tilts and of attitudes, (p, n), from the states, (p, m, 13)."""
        seen, (heights, tilts, attitudes) = self.observed, self._frames
        at = np.argsort(np.argsort(seen.times, kind="stable"))  # the states are in the order of time
        z, e = states[:, at, 2], states[:, at, 6:10]
        tilted = np.arccos(np.clip(1 - 2 * (e[..., 1] ** 2 + e[..., 2] ** 2), -1, 1))
        turned = _turned(e[:, attitudes[::3]], seen.quaternions[attitudes[::3]])
        return np.hstack(
            [
                ((seen.heights - z) / seen.height_sd)[:, heights],
                ((seen.tilts - tilted) / seen.tilt_sd)[:, tilts],
                turned.reshape(len(z), -1) / seen.quaternion_sd[attitudes],
            ]
        )


def _replaced(scenario: Scenario, values: dict[str, float]) -> Scenario:
    """Return a scenario with these values of its fields; raise `ScenarioError` for what is none."""
    pairs: list[object] = [
        x for field, value in values.items() if field != CLOCK for x in (field, float(value))
    ]
    return scenario.replace(*pairs) if pairs else scenario  # pyright: ignore[reportArgumentType]


def _may_differ(field: str) -> bool:
    """Return whether a field may differ between tosses that are made together."""
    return field == CLOCK or field.startswith("release.") or field.removeprefix("floor.") in _OF_FLOOR


def _turned(first: Array, second: Array) -> Array:
    """Return the rotations from attitudes to others as vectors in the frame of the first, (p, m, 3) [rad].

    Args:
        first: Euler parameters, body to space, (p, m, 4).
        second: others, whose norm and sign have no meaning, (m, 4).
    """
    w, u = first[..., :1], first[..., 1:]
    cosine = np.einsum("pmi,mi->pm", first, second)[..., None]
    sine = w * second[:, 1:] - second[:, :1] * u - np.cross(u, second[:, 1:])
    size = np.linalg.norm(sine, axis=-1, keepdims=True)
    angle = 2 * np.arctan2(size, np.abs(cosine)) * np.where(cosine < 0, -1.0, 1.0)
    return sine * (angle / np.maximum(size, np.finfo(float).tiny))
