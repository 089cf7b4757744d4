"""What states alone show of a toss: touches, impulses, faces, and how it ends."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss import Ending, Face, Impacts, Outcome, Scenario, Setting, States, Toss, TrustEnd, analytic
from cointoss.study import Against, Array, agreement_horizon, barrier, energies, turned
from cointoss_yardstick.simulators.worker import STATE

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
    def heights(self) -> Array:
        """The height of the lowest point at each state, (n,) [m]."""
        return self.states.lowest_points(self.scenario)[:, 2]

    @cached_property
    def stretches(self) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
        """The first and last sample around each impact, and around each sustained contact."""
        body, time = self.scenario.body, self.states.time
        dt = np.diff(time)
        weight, up = body.gravity * dt, self.gains[:, 2]
        above = self.heights
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
        body, states, found = self.scenario.body, self.states, self.stretches[0]
        a, b = np.array(found, dtype=int).reshape(-1, 2).T
        rows = np.array([self._touch(*ends) for ends in found]).reshape(-1, 14)
        late, *at_touch = np.split(rows, [1, 4, 8, 11], axis=1)
        touching = {name: part.copy() for name, part in zip(STATE, at_touch, strict=True)}
        before = States(time=states.time[a] + late[:, 0], **touching)
        time, gain = before.time, np.array([self.gains[slice(*ends)].sum(axis=0) for ends in found])
        if self.told is not None:
            time, gain = self.told[0], self.told[1] / body.mass
        gain = gain.reshape(-1, 3)
        spin = _spun_back(body.inertia, states.angular_velocity[b], (states.time[b] - before.time)[:, None])
        after = replace(before, velocity=before.velocity + gain, angular_velocity=spin)
        arm = before.lowest_points(self.scenario) - before.position
        columns = {
            "impulse": body.mass * gain,
            "point": turned(_conjugate(before), arm) + body.center,
            "energy": energies(body, after),
            "energy_change": energies(body, after) - energies(body, before),
        }
        for when, each in (("before", before), ("after", after)):
            columns[f"velocity_{when}"] = each.velocity
            columns[f"angular_velocity_{when}"] = each.angular_velocity
            turning = turned(each.quaternion, each.angular_velocity)
            columns[f"contact_velocity_{when}"] = each.velocity + np.cross(turning, arm)
        return Impacts(
            time=time,
            face=np.where(before.normal[:, 2] > 0, Face.HEADS, Face.TAILS).astype(np.int8),
            position=before.position,
            quaternion=before.quaternion,
            **columns,
        )

    def _touch(self, a: int, b: int) -> Array:
        """Return how long after one state, before another, the coin touches the floor, and its state then.

        Where free flight does not touch before that, or the coin is in the floor, it touches at once.
        """
        at = {name: getattr(self.states, name)[a] for name in STATE}
        if self.heights[a] > 0:
            span = float(self.states.time[b] - self.states.time[a])
            free = self.scenario.replace("release", at, "ending", {"max_impacts": 1, "max_time": span})
            for one in analytic.toss(free).impacts:
                before = one.velocity_before, one.angular_velocity_before
                return np.hstack([one.time, one.position, one.quaternion, *before])
        return np.hstack([0.0, *at.values()])

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
        body, n_z, height = self.scenario.body, self.states.normal[:, 2], self.states.position[:, 2]
        last, caught = len(n_z) - 1, self.scenario.ending.caught
        faces = np.where(n_z > 0, Outcome.HEADS, Outcome.TAILS)
        if caught is not None:
            down = np.flatnonzero((height[:-1] > caught) & (height[1:] <= caught)) + 1
            return next(
                ((k, Outcome(faces[k]), Ending.CAUGHT) for k in down.tolist()),
                (last, Outcome.UNDECIDED, Ending.MAX_TIME),
            )
        low = energies(body, self.states) < np.where(n_z > 0, barrier(body, 1.0), barrier(body, -1.0))
        edge = body.thickness / 2 / np.hypot(body.radius, body.thickness / 2)
        if abs(n_z[-1]) < edge if low[-1] else self.is_still(-1) and abs(n_z[-1]) < 0.5:
            return last, Outcome.EDGE, Ending.STANDING
        if low[-1]:
            settled = int(np.max(np.flatnonzero(~low), initial=-1)) + 1
            return settled, Outcome(faces[-1]), Ending.SETTLED
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
            impacts=impacts[kept],
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
        measure, count = analytic.toss(self.scenario), len(toss.impacts)
        errors = Against(measure=measure, toss=toss).errors
        trusted = agreement_horizon(measure, errors, self.spans[kept])
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
    v = turned(_conjugate(states), states.velocity) - np.cross(states.angular_velocity, body.center)
    drag = np.array([body.drag.force_tangential, body.drag.force_tangential, body.drag.force_normal])
    return weight - turned(states.quaternion, drag * v) / body.mass


def _runs(flags: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return where each run of flags begins, and where it has ended."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def _conjugate(states: States) -> Array:
    """Return the Euler parameters of the turns from space to body, (n, 4)."""
    return states.quaternion * [1, -1, -1, -1]


def _spun_back(inertia: ArrayLike, w: Array, span: Array) -> Array:
    """Return angular velocities spans earlier, by Euler's equations, body frame, (n, 3) [rad/s]."""
    J, steps, early = np.asarray(inertia), 8, np.array(w)
    inverse = np.linalg.inv(J)
    for _ in range(steps):
        half = early - span / steps / 2 * np.cross(early @ J, early) @ inverse
        early = early - span / steps * np.cross(half @ J, half) @ inverse
    return early
