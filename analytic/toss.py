"""One toss by the paper's mechanics, and its path."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from analytic.contact.contact import friction_in_contact, sample_contact
from analytic.contact.floor_force import Motion
from analytic.contact.force_in_contact import force_in_contact
from analytic.events import Run, run
from analytic.flight.equations_of_motion import STATE_SIZE
from analytic.flight.flying import sample
from analytic.horizon.horizon import CLOSED_FORM, SAFETY, STEP_ERROR, TURN_ERROR, trusted_impacts
from analytic.settings import FINE, Settings
from models.attitude import rotation_matrix
from models.body import Body, in_vacuum, is_ideal
from models.ending import barrier, energy
from models.records import Array, Impacts, Setting, States, Toss
from models.scenario import Release, Scenario

_INTEGRATED = "Dormand-Prince of order 8(5,3), Euler parameters kept at norm 1"


@dataclass(frozen=True, kw_only=True, eq=False)
class Pieces:
    """The path of a toss: where flights and contacts start; each is integrated again when asked for."""

    body: Body
    friction: float
    """μ of a contact, 0 on a smooth floor."""
    start_times: Array
    """(n,) [s]."""
    start_states: Array
    """(n, 13)."""
    motions: NDArray[np.int8]
    """`Motion`, (n,)."""

    def sample(self, times: Array) -> States:
        """Give the states at `times` [s], in the order of `times`."""
        order = np.argsort(times, kind="stable")
        rows = np.empty((len(times), STATE_SIZE))
        piece = np.searchsorted(self.start_times, times[order], side="right") - 1
        for number in np.unique(piece):
            chosen = order[piece == number]
            rows[chosen] = self._piece(number, times[chosen])
        return States(
            time=times.copy(),
            position=rows[:, 0:3].copy(),
            velocity=rows[:, 3:6].copy(),
            quaternion=rows[:, 6:10].copy(),
            angular_velocity=rows[:, 10:13].copy(),
        )

    def floor_force(self, times: Array) -> Array:
        """Return the floor's force at `times` in sustained contacts, space frame, (n, 3) [N]."""
        piece = np.searchsorted(self.start_times, times, side="right") - 1
        # At its very end a contact still holds the coin.
        piece = np.where(self.motions[piece] == Motion.FLIGHT, piece - 1, piece)
        states = self.sample(times)
        rows = np.hstack([states.position, states.velocity, states.quaternion, states.angular_velocity])
        forces = [
            force_in_contact(self.body, self.friction, Motion(self.motions[number]), row)
            for number, row in zip(piece, rows, strict=True)
        ]
        return np.array(forces)

    def _piece(self, number: int, times: Array) -> Array:
        states = np.empty((len(times), STATE_SIZE))
        start, start_time, motion = (
            self.start_states[number],
            self.start_times[number],
            self.motions[number],
        )
        if motion == Motion.FLIGHT:
            sample(self.body, start, start_time, times, states)
        else:
            sample_contact(self.body, self.friction, motion, start, start_time, times, states)
        return states


def state_of(release: Release) -> Array:
    """Give the state at release, (13,)."""
    return np.array([*release.position, *release.velocity, *release.attitude, *release.angular_velocity])


def require_supported(scenario: Scenario, *, settings: Settings) -> None:
    """Refuse nothing: this engine tosses every scenario."""


def toss(scenario: Scenario, *, settings: Settings = FINE) -> Toss:
    """Toss a coin by the paper's mechanics.

    Free flight by eqs (21)-(22) of Strzalko et al. 2008 in Euler parameters, air drag by eqs (49)-(74),
    impacts by eqs (85)-(92) and the contact laws of Fig. 17, or Routh's law.

    `trusted_impacts` counts the leading impacts that the engine's own errors, carried forward by the tangent
    map of the toss, cannot change. Up to there time is good to `horizon.TIME_ERROR` and impulse to
    `horizon.IMPULSE_ERROR`.

    Args:
        scenario: what to toss.
        settings: how finely.
    """
    body, rules, start = scenario.body, scenario.rules, state_of(scenario.release)
    answer = run(body, rules, start)
    impacts, end = Impacts.from_rows(answer.rows), answer.start_states[-1]
    return Toss(
        engine="analytic",
        scenario=scenario,
        impacts=impacts,
        contacts=answer.contacts,
        outcome=answer.outcome,
        ending=answer.ending,
        end_time=answer.end_time,
        trusted_impacts=trusted_impacts(body, rules, _before_contact(answer)),
        certificate=(
            Setting(name="flight", value=_flight(body)),
            Setting(name="error allowed in a step, relative", value=settings.tolerance),
            Setting(name="error of a step carried to the horizon: of the motion, relative", value=STEP_ERROR),
            Setting(name="error of a step carried to the horizon: of the attitude", value=TURN_ERROR),
            Setting(name="part of these errors in a step in closed form", value=CLOSED_FORM),
            Setting(name="safety factor of the horizon", value=SAFETY),
            Setting(name="energy at the end", value=_energy(body, end), unit="J"),
            Setting(name="energy of the lowest pass to the other face", value=_barrier(body, end), unit="J"),
        ),
        path=Pieces(
            body=body,
            friction=friction_in_contact(rules),
            start_times=answer.start_times,
            start_states=answer.start_states,
            motions=answer.motions,
        ),
    )


def _flight(body: Body) -> str:
    if not is_ideal(body) or (body.air.exponent is not None and not in_vacuum(body)):
        return _INTEGRATED
    if in_vacuum(body):
        return "closed form of the symmetric top"
    return f"power series without spin about the normal, else {_INTEGRATED}"


def _before_contact(answer: Run) -> Run:
    """Give the toss up to the first contact that lasts."""
    if len(answer.contacts) == 0:
        return answer
    return answer._replace(rows=answer.rows[answer.rows["time"] < answer.contacts[0, 0]])


def _energy(body: Body, y: Array) -> float:
    return energy(body, y[2], tuple(y[3:6]), tuple(y[10:13]))


def _barrier(body: Body, y: Array) -> float:
    return barrier(body, rotation_matrix(tuple(y[6:10]))[2][2])
