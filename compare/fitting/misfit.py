"""How far tosses miss what was seen: residuals in standard deviations."""

from dataclasses import dataclass
from functools import cached_property
from itertools import compress

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.runs import horizon_of, run
from cointoss.analytic.seeing import Sightings
from cointoss.analytic.sightings import sightings
from cointoss.analytic.toss import state_at_release
from cointoss.compare.fitting.fields import CLOCK
from cointoss.compare.fitting.observed import Observed
from cointoss.compare.sweep.axes import Span
from cointoss.compare.sweep.window import Window
from cointoss.models.batch import PLACE
from cointoss.models.interruptible import interruptible
from cointoss.models.laws import EndingTest
from cointoss.models.records import Array, Face
from cointoss.models.scenario import Scenario

FACE_SD = 0.02
"""The normal's vertical part may be this far on the wrong side of 0 where a face was seen: 1 degree."""
MISSING = 10.0
"""The least residual of a touch that the toss does not make [standard deviations]."""
IMPOSSIBLE = 1e6
"""The residual of everything where the values make no scenario [standard deviations]."""
BEFORE = 10.0
"""A frame this many standard deviations before a touch is surely before it."""
LATER, SOON = 0.25, 0.02
"""How much longer than seen a toss is followed for a touch: this part of the whole time, and these
seconds."""


@dataclass(frozen=True, kw_only=True)
class Predicted:
    """What one toss shows beside what was seen."""

    residuals: Array
    """What was seen less what the toss shows, in standard deviations, (n,) in the order of `Misfit.times`."""
    is_tested: NDArray[np.bool_]
    """Which residuals the horizon of trust includes, (n,)."""
    touch_times: Array
    """The times of the touches that were seen, by the observer's clock, NaN where the toss makes none, (m,)
    [s]."""


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
        return np.concatenate(
            [seen.touch_times, seen.touch_times[self._faces], *[seen.times[rows] for rows in self._frames]]
        )

    @cached_property
    def is_measured(self) -> NDArray[np.bool_]:
        """Which residuals are of a number, not of a face, (n,)."""
        place = np.arange(len(self.times)) - len(self.observed.touch_times)
        return (place < 0) | (place >= len(self._faces))

    @cached_property
    def _faces(self) -> NDArray[np.intp]:
        return np.flatnonzero(self.observed.faces)

    @cached_property
    def _frames(self) -> list[NDArray[np.intp]]:
        """Rows of the frames with a height, with a tilt, and three times those with an attitude."""
        heights, tilts, attitudes = map(np.flatnonzero, self.observed.measured.values())
        return [heights, tilts, np.repeat(attitudes, 3)]

    @cached_property
    def _most(self) -> int:
        """How many touches of each toss are computed."""
        return int(self.observed.touch_numbers.max(initial=0))

    @cached_property
    def most_impacts(self) -> int:
        """After how many impacts nothing is seen any more: the last touch, where the film ends before it."""
        seen, most = self.observed, self.scenario.rules.max_impacts
        last = np.max(seen.touch_times - BEFORE * seen.touch_sd, initial=-np.inf)
        return min(most, self._most) if seen.times.max(initial=-np.inf) < last else most

    def scenario_of(self, values: Array) -> Scenario:
        """Return the scenario with these values, (k,); raise `ScenarioError` for what is none."""
        return self._window.scenario_of(values[self._is_field])

    def residuals(self, values: Array, until: float = np.inf) -> Array:
        """Return the residuals of many tosses, (p, n); `IMPOSSIBLE` for values that make no scenario.

        Args:
            values: of the fields, a row for each toss, (p, k).
            until: what was seen later may have any residuals, which spares most of the work [s].
        """
        rows, is_toss = self._window.rows(values[:, self._is_field])
        found = np.full((len(values), len(self.times)), IMPOSSIBLE)
        rows, clock = rows[is_toss], self.clock_of(values[is_toss])
        film = np.sort(self.observed.times)
        film, is_awaited = film[film <= until], self.observed.touch_times <= until
        touches = int(self.observed.touch_numbers[is_awaited].max(initial=0))
        rows[:, PLACE["ending.max_impacts"]] = self.most_impacts if len(film) else touches
        rows[:, PLACE["ending.max_time"]] = self._ends(clock, until)
        rows[:, PLACE["ending.test"]] = EndingTest.LYING.value
        shown = sightings(rows, film - clock[:, None], most=self._most)
        states = np.pad(shown.states, ((0, 0), (0, len(self.observed.times) - len(film)), (0, 0)))
        found[is_toss] = np.hstack([self._missed_touches(shown, clock), self._missed_frames(states)])
        return found

    @cached_property
    def known_slopes(self) -> dict[int, Array]:
        """By place among the values, derivatives of all residuals, (n,), that are the same for all tosses.

        Without a film the clock shifts the touches, and nothing else.
        """
        late = np.append(-1.0 / self.observed.touch_sd, np.zeros(len(self._faces)))
        of_clock = np.flatnonzero(~self._is_field).tolist() if not len(self.observed.times) else []
        return dict.fromkeys(of_clock, late)

    def accepts(self, values: Array) -> NDArray[np.bool_]:
        """Return which values make a scenario, (p,), from values of the fields, (p, k)."""
        return self._window.rows(values[:, self._is_field])[1]

    @cached_property
    def _is_field(self) -> NDArray[np.bool_]:
        """Which values are those of fields of the scenario, not of the clock, (k,)."""
        return np.array([span.field != CLOCK for span in self.spans])

    @cached_property
    def _window(self) -> Window:
        """Where the fields of the scenario are looked for."""
        return Window(scenario=self.scenario, spans=tuple(compress(self.spans, self._is_field)))

    def clock_of(self, values: Array) -> Array:
        """Return the time of the observer's clock at each release, (p,) [s], from values, (p, k)."""
        return values[:, ~self._is_field].sum(axis=1)

    def _ends(self, clock: Array, until: float = np.inf) -> Array:
        """Return when tosses end whose release was at `clock` [s]: after all that was seen, or `until`."""
        later = LATER if np.any(self.observed.touch_times <= until) else 0.0
        return (np.maximum(min(self.times.max(), until) - clock, 0.0) + SOON) * (1 + later)

    def predicted(self, values: Array) -> Predicted:
        """Return what the toss with these values, (k,), shows; raise `ScenarioError` for what is none."""
        scenario, clock = self.scenario_of(values), self.clock_of(values[None])
        body, start = scenario.body, state_at_release(scenario.release)
        rules = scenario.rules._replace(test=EndingTest.LYING, max_time=float(self._ends(clock)[0]))
        log = interruptible(lambda: run(body, rules, start))
        trusted = interruptible(lambda: horizon_of(body, rules, log)).impacts
        numbers = self.observed.touch_numbers
        made = np.append(log.rows["time"] + clock, np.full(self._most, np.nan))
        # A toss is open from the first impact that is not trusted; one that is made too few is no such.
        until = made[trusted] if trusted < len(log.rows) else np.inf
        is_open = (numbers > trusted) & (numbers <= len(log.rows))
        frames = [self.observed.times[rows] < until for rows in self._frames]
        return Predicted(
            residuals=self.residuals(values[None])[0],
            is_tested=np.concatenate([~is_open, ~is_open[self._faces], *frames]),
            touch_times=made[numbers - 1],
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
                turned.reshape(len(z), len(attitudes)) / seen.quaternion_sd[attitudes],
            ]
        )


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
