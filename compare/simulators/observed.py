"""What states alone show of a toss: touches, impulses, faces, and how it ends."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cointoss import analytic
from cointoss.compare.metrics.impulses import errors_of_impacts
from cointoss.compare.metrics.sequences import agreement_horizon
from cointoss.models.barriers import barrier
from cointoss.models.certificate import energies, gaps, turned
from cointoss.models.ending import face_up
from cointoss.models.geometry import gap, lowest_point
from cointoss.models.impact_row import write_impact
from cointoss.models.kernel.vectors import Vector
from cointoss.models.records import (
    IMPACT_ROW,
    Array,
    Ending,
    Impacts,
    Outcome,
    Setting,
    States,
    Toss,
    TrustEnd,
)
from cointoss.models.scenario import Scenario, euler_parameters, vector
from cointoss.models.state import State, state

HELD = 0.3
"""The floor acts in an interval in which it gives more than this part of the weight's impulse."""
STRUCK = 5.0
"""An interval holds an impact if the floor gives more than `SLOWEST`, and more than this many times the
weight's impulse."""
SLOWEST = 0.02
"""The smallest change of speed that is an impact, against √(g r)."""
NEAR = 0.5
"""How near the floor a coin must be for it to act, against r, beside the way of an interval."""
RAMP = 3
"""Intervals of a soft contact's rise and fall that belong to its impact."""
STILL = 1e-2
"""A coin is at rest below this part of √(g r) and √(g/r)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ObservedToss:
    """What an engine's states show of a toss."""

    scenario: Scenario
    states: States
    """The states from the release on, at times close enough to separate the impacts."""
    told: tuple[Array, Array] | None = None
    """The times of the impacts, (k,) [s], and their impulses, (k, 3) [N s], where the engine gives them."""
    stiffness: float = np.inf
    """The stiffness k of the engine's contact, in which the coin lies m g/k deep [N/m]."""
    processor_time: float = 0.0
    """How long the engine took [s]."""

    @cached_property
    def gains(self) -> Array:
        """The change of velocity in each interval beyond weight and air, (n - 1, 3) [m/s]."""
        free = _free_acceleration(self.scenario, self.states)
        dt = np.diff(self.states.time)[:, None]
        return np.diff(self.states.velocity, axis=0) - dt * (free[1:] + free[:-1]) / 2

    @cached_property
    def stretches(self) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
        """The first and last sample around each impact, and around each sustained contact."""
        body, time = self.scenario.body, self.states.time
        dt = np.diff(time)
        weight, up = body.gravity * dt, self.gains[:, 2]
        above = gaps(body, self.states)
        speed = np.abs(self.states.velocity[:, 2]) + body.radius * np.linalg.norm(
            self.states.angular_velocity[:, :2], axis=1
        )
        near = np.minimum(above[1:], above[:-1]) < NEAR * body.radius + (speed[1:] + speed[:-1]) * dt
        acts = near & (up > HELD * weight)
        strikes = acts & (up > np.maximum(STRUCK * weight, SLOWEST * (body.gravity * body.radius) ** 0.5))
        if self.told is not None:
            at = np.clip(np.searchsorted(time, self.told[0], side="right") - 1, 0, len(dt) - 1)
            acts[at] = False
            return [(i, i + 1) for i in at.tolist()], [run for run in _runs(acts) if run[1] - run[0] > RAMP]
        impacts, contacts = [], []
        for first, last in _runs(acts):
            done = first
            for start, end in _runs(strikes[first:last]):
                a, b = first + start, first + end
                b = last if last - b <= RAMP else b
                if a - done > RAMP:
                    contacts.append((done, a))
                elif done > first:  # it goes on
                    a, _ = impacts.pop()
                else:
                    a = first
                impacts.append((a, b))
                done = b
            contacts += [(done, last)] if last - done > RAMP else []
        return impacts, contacts

    @cached_property
    def impacts(self) -> Impacts:
        """The impacts, each between two samples; at first touch, by free flight from the first.

        The impulse is the change of momentum beyond weight and air.
        """
        found = self.stretches[0]
        rows = np.recarray(len(found), IMPACT_ROW)
        for number, (row, (a, b)) in enumerate(zip(rows, found, strict=True)):
            self._write(row, number, a, b)
        rows.sort(order="time")
        return Impacts.from_rows(rows)

    def _write(self, row: "np.record", number: int, a: int, b: int) -> None:
        scenario, states = self.scenario, self.states
        body, span = scenario.body, float(states.time[b] - states.time[a])
        late, before = _touch(scenario, _state(states, a), span)
        gain = self.gains[a:b].sum(axis=0) if self.told is None else self.told[1][number] / body.mass
        after = state(
            before.position,
            vector(np.array(before.velocity) + gain),
            before.attitude,
            _spun_back(body.inertia, states.angular_velocity[b], span - late),
        )
        point, _ = lowest_point(body, before.R[2], before.spin)
        write_impact(body, vector(body.mass * gain), point, before, after, row)  # pyright: ignore[reportArgumentType]
        row["time"] = states.time[a] + late if self.told is None else self.told[0][number]

    def is_still(self, k: int) -> bool:
        """Return whether the coin is at rest at a sample."""
        body, states = self.scenario.body, self.states
        speed = np.linalg.norm(states.velocity[k]) / (body.gravity * body.radius) ** 0.5
        spin = np.linalg.norm(states.angular_velocity[k]) * (body.radius / body.gravity) ** 0.5
        return bool(max(speed, spin) < STILL)

    @cached_property
    def spans(self) -> Array:
        """How early or late each touch may be, for the spacing of the times, (n,) [s]."""
        found = self.stretches[0]
        if self.told is not None or not found:
            return np.zeros(len(found))
        a, b = np.array(found).T
        return self.states.time[b] - self.states.time[a]

    @cached_property
    def ended(self) -> tuple[int, Outcome, Ending]:
        """The sample at which the toss ends, its outcome, and why: its energy can turn it no more."""
        scenario, states = self.scenario, self.states
        body, n_z = scenario.body, states.normal[:, 2]
        caught = scenario.ending.caught
        last = len(states.time) - 1
        if caught is not None:
            down = (states.position[:-1, 2] > caught) & (states.position[1:, 2] <= caught)
            if down.any():
                last = int(np.argmax(down)) + 1
                return last, Outcome(face_up(n_z[last])), Ending.CAUGHT
            return last, Outcome.UNDECIDED, Ending.MAX_TIME
        passes = np.array([barrier(body, 1.0), barrier(body, -1.0)])
        low = energies(body, states) < np.where(n_z > 0, *passes)
        half = body.thickness / 2
        if abs(n_z[-1]) < half / np.hypot(body.radius, half) and low[-1]:
            return last, Outcome.EDGE, Ending.STANDING
        if low[-1]:
            settled = last - int(np.argmin(low[::-1])) + 1 if not low.all() else 0
            return settled, Outcome(face_up(n_z[-1])), Ending.SETTLED
        if self.is_still(-1) and abs(n_z[-1]) < 0.5:
            return last, Outcome.EDGE, Ending.STANDING
        return last, Outcome.UNDECIDED, Ending.MAX_TIME

    def toss(self, engine: str, settings: dict[str, str | float]) -> Toss:
        """Return the record of the toss, up to its ending.

        Its impacts are trusted as far as neither errors such as those of its impulses, nor a touch that comes
        early or late by the spacing of the times, change a face of the analytic toss.

        Args:
            engine: its name.
            settings: what it says of itself.
        """
        last, outcome, ending = self.ended
        time, impacts = self.states.time, self.impacts
        end, kept = float(time[last]), impacts.time <= time[last]
        most = self.scenario.ending.max_impacts
        if most is not None and kept.sum() >= most:
            kept[np.flatnonzero(kept)[most:]] = False
            end, outcome, ending = float(impacts.time[kept][-1]), Outcome.UNDECIDED, Ending.MAX_IMPACTS
        contacts = np.array([(time[a], min(time[b], end)) for a, b in self.stretches[1] if time[a] < end])
        late = float(np.max(self.spans, initial=0.0))
        toss = Toss(
            engine=engine,
            scenario=self.scenario,
            impacts=Impacts(**{name: column[kept] for name, column in vars(impacts).items()}),
            contacts=contacts.reshape(-1, 2),
            outcome=outcome,
            ending=ending,
            end_time=end,
            outcome_certain=None,
            other_outcome=None,
            trusted_impacts=0,
            trust_end=TrustEnd.NONE,
            certificate=(
                *(Setting(name=name, value=value) for name, value in settings.items()),
                Setting(name="spacing of the times", value=float(np.diff(time).max(initial=0.0)), unit="s"),
                Setting(
                    name="time from the state before an impact to that after it, at most",
                    value=late,
                    unit="s",
                ),
            ),
            path=Samples(self.states, self.scenario.coin.mass * self.gains / np.diff(time)[:, None]),
        )
        errors, measure = errors_of_impacts(toss), analytic.toss(self.scenario)
        trusted, count = agreement_horizon(measure, errors, self.spans[kept]), len(toss.impacts)
        return replace(
            toss,
            trusted_impacts=trusted,
            trust_end=TrustEnd.of(trusted, before_contact=count, count=count),
        )


@dataclass(frozen=True, eq=False)
class Samples:
    """A path between samples: linear, but for the attitude, which is of norm 1."""

    states: States
    forces: Array
    """The force of the floor in each interval, (n - 1, 3) [N]."""

    def sample(self, times: Array) -> States:
        """Return the states at `times` [s]."""
        known = self.states
        turns_sign = np.sum(known.quaternion[1:] * known.quaternion[:-1], axis=1) < 0
        signs = np.cumprod(np.where(np.append(False, turns_sign), -1.0, 1.0))

        def between(column: Array) -> Array:
            return np.column_stack([np.interp(times, known.time, part) for part in column.T])

        mixed = between(known.quaternion * signs[:, None])
        return States(
            time=times,
            position=between(known.position),
            velocity=between(known.velocity),
            quaternion=mixed / np.linalg.norm(mixed, axis=1)[:, None],
            angular_velocity=between(known.angular_velocity),
        )

    def floor_force(self, times: Array) -> Array:
        """Return the mean force of the floor in the interval of each time, (n, 3) [N]."""
        i = np.searchsorted(self.states.time, times, side="right") - 1
        return self.forces[np.clip(i, 0, len(self.forces) - 1)]


def _free_acceleration(scenario: Scenario, states: States) -> Array:
    """Return the acceleration by weight and linear air, (n, 3) [m/s²]."""
    body = scenario.body
    weight = np.broadcast_to([0.0, 0.0, -body.gravity], states.velocity.shape)
    if not any(body.drag) or scenario.air.exponent:
        return weight
    back = states.quaternion * [1, -1, -1, -1]
    v = turned(back, states.velocity) - np.cross(states.angular_velocity, body.center)
    drag = np.array([body.drag.force_tangential, body.drag.force_tangential, body.drag.force_normal])
    return weight - turned(states.quaternion, drag * v) / body.mass


def _runs(flags: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return where each run of flags begins, and where it has ended."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def _state(states: States, i: int) -> State:
    return state(
        vector(states.position[i]),
        vector(states.velocity[i]),
        euler_parameters(states.quaternion[i]),
        vector(states.angular_velocity[i]),
    )


def _touch(scenario: Scenario, at: State, span: float) -> tuple[float, State]:
    """Return how long after a state a coin touches the floor [s], and its state then.

    Where free flight does not touch within a span, or the coin is in the floor, that is at once.
    """
    release = dict(zip(("position", "velocity", "quaternion", "angular_velocity"), at[:4], strict=True))
    if gap(scenario.body, at.position[2], at.R[2]) <= 0:
        return 0.0, at
    first = scenario.replace("release", release, "ending", {"max_impacts": 1, "max_time": span})
    if not len(rows := analytic.toss(first).impacts):
        return 0.0, at
    return float(rows.time[0]), state(
        vector(rows.position[0]),
        vector(rows.velocity_before[0]),
        euler_parameters(rows.quaternion[0]),
        vector(rows.angular_velocity_before[0]),
    )


def _spun_back(inertia: object, w: Array, span: float) -> Vector:
    """Return the angular velocity a span earlier, by Euler's equations, body frame, (3,) [rad/s]."""
    J = np.asarray(inertia)
    steps = 8
    for _ in range(steps):
        half = w - span / steps / 2 * np.linalg.solve(J, np.cross(J @ w, w))
        w = w - span / steps * np.linalg.solve(J, np.cross(J @ half, half))
    return vector(w)
