"""One toss by the paper's mechanics, and its path."""

from dataclasses import dataclass

import numpy as np

from analytic.events import run
from analytic.flight import STATE_SIZE, TOLERANCE, sample_flight
from analytic.horizon import SAFETY, STEP_ERROR, TURN_ERROR, trusted_impacts
from models.body import Body
from models.records import Array, Impacts, Setting, States, Toss
from models.scenario import Release, Scenario


@dataclass(frozen=True, kw_only=True, eq=False)
class Flights:
    """The path of a toss: the state at the start of each flight, integrated again where it is asked for."""

    body: Body
    start_times: Array
    """(n,) [s]."""
    start_states: Array
    """(n, 13)."""

    def sample(self, times: Array) -> States:
        """Give the states at `times` [s], in the order of `times`."""
        order = np.argsort(times, kind="stable")
        rows = np.empty((len(times), STATE_SIZE))
        flight = np.searchsorted(self.start_times, times[order], side="right") - 1
        for number in np.unique(flight):
            chosen = order[flight == number]
            states = np.empty((len(chosen), STATE_SIZE))
            start = self.start_states[number]
            sample_flight(self.body, start, self.start_times[number], times[chosen], states)
            rows[chosen] = states
        return States(
            time=times.copy(),
            position=rows[:, 0:3].copy(),
            velocity=rows[:, 3:6].copy(),
            quaternion=rows[:, 6:10].copy(),
            angular_velocity=rows[:, 10:13].copy(),
        )


def state_of(release: Release) -> Array:
    """Give the state at release, (13,)."""
    return np.array([*release.position, *release.velocity, *release.attitude, *release.angular_velocity])


def toss(scenario: Scenario) -> Toss:
    """Toss a coin by the paper's mechanics.

    Free flight by eqs (21)-(22) of Strzalko et al. 2008 in Euler parameters, air drag by eqs (49)-(74),
    impacts by eqs (85)-(92) and the contact laws of Fig. 17, or Routh's law.

    `trusted_impacts` counts the leading impacts that the engine's own errors, carried forward by the tangent
    map of the toss, cannot change. Up to there time is good to `horizon.TIME_ERROR` and impulse to
    `horizon.IMPULSE_ERROR`.

    Args:
        scenario: what to toss.
    """
    body, rules, start = scenario.body, scenario.rules, state_of(scenario.release)
    answer = run(body, rules, start)
    impacts = Impacts.from_rows(answer.rows)
    return Toss(
        engine="analytic",
        scenario=scenario,
        impacts=impacts,
        contacts=np.empty((0, 2)),
        outcome=answer.outcome,
        ending=answer.ending,
        end_time=answer.end_time,
        trusted_impacts=trusted_impacts(body, rules, answer),
        certificate=(
            Setting(
                name="integrator", value="Dormand-Prince of order 8(5,3), Euler parameters kept at norm 1"
            ),
            Setting(name="error allowed in a step, relative", value=TOLERANCE),
            Setting(name="error of a step carried to the horizon: of the motion, relative", value=STEP_ERROR),
            Setting(name="error of a step carried to the horizon: of the attitude", value=TURN_ERROR),
            Setting(name="safety factor of the horizon", value=SAFETY),
        ),
        path=Flights(body=body, start_times=answer.start_times, start_states=answer.start_states),
    )
