"""One toss by the analytic engine, and its path."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.entries import certainty_of, floor_forces, force_and_moment, sample_pieces
from cointoss.analytic.events import Started
from cointoss.analytic.flight.state_vector import STATE_SIZE, attitude_of, state_of
from cointoss.analytic.horizon.horizon import CLOSED_FORM, SAFETY, STEP_ERROR, TURN_ERROR
from cointoss.analytic.impact.own_law import OwnLaw, contact_in, residuals, rules_by
from cointoss.analytic.runs import EventLog, horizon_of, later_part, other_outcome, run
from cointoss.analytic.settings import FINE, AnalyticSettings
from cointoss.models.attitude import rotation_matrix
from cointoss.models.barriers import barrier, energy
from cointoss.models.body import Body, Rules, in_vacuum, is_ideal, never_adds_energy
from cointoss.models.certificate import Changes, InContact, gaps, measurements
from cointoss.models.errors import require_type
from cointoss.models.interruptible import interruptible
from cointoss.models.parts import Release
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import Array, Ending, Impacts, Setting, States, Toss, TrustEnd
from cointoss.models.scenario import Scenario, keeping_all
from cointoss.models.stages import reached, stage

_INTEGRATED = "Dormand-Prince of order 8(5,3), Euler parameters kept at norm 1"
# A coin is on its edge where |n_z| is below.
_UPRIGHT = 1e-6


@dataclass(frozen=True, kw_only=True, eq=False)
class Pieces:
    """The path of a toss: where flights and contacts start; each is integrated again when asked for."""

    body: Body
    friction: FloorFriction
    """The floor's friction in sustained contact."""
    contact_tolerance: float
    """Error allowed in a step of contact, relative."""
    started: Started
    """Where flights and contacts start, and where the path ends."""

    def sample(self, times: Array) -> States:
        """Return the states at `times` [s], in the order of `times`."""
        order, found = np.argsort(times, kind="stable"), np.empty((len(times), STATE_SIZE))
        sample_pieces(self.body, self.friction, self.contact_tolerance, self.started, times[order], found)
        rows = np.empty_like(found)
        rows[order] = found
        return States.from_rows(times, rows)

    def floor_force(self, times: Array) -> Array:
        """Return the floor's force at `times` in sustained contacts, space frame, (n, 3) [N]."""
        piece = np.searchsorted(self.started.times, times, side="right") - 1
        # At its very end a contact still holds the coin.
        piece = np.where(np.isin(self.started.modes[piece], (Mode.FLIGHT, Mode.ENDED)), piece - 1, piece)
        states = self.sample(times)
        rows = np.hstack([states.position, states.velocity, states.quaternion, states.angular_velocity])
        forces = np.empty((len(times), 3))
        floor_forces(self.body, self.friction, self.started.modes[piece], rows, forces)
        return forces


def state_at_release(release: Release) -> Array:
    """Return the state at release, (13,)."""
    return np.array([*release.position, *release.velocity, *release.attitude, *release.angular_velocity])


def require_supported(scenario: Scenario, *, settings: AnalyticSettings) -> None:
    """Refuse nothing: this engine tosses every scenario."""


def toss(scenario: ScenarioSource, *, settings: AnalyticSettings = FINE, law: OwnLaw | None = None) -> Toss:
    """Toss a coin by the analytic engine.

    Free flight by eqs (21)-(22) of Strzalko et al. 2008 in Euler parameters, air drag by eqs (49)-(74),
    impacts by eqs (85)-(92) and the contact laws of Fig. 17, or Coulomb friction integrated
    through the impact.

    `trusted_impacts` counts the leading impacts that the engine's own errors, carried forward by the tangent
    map of the toss, cannot change. Their times are accurate to `horizon.TIME_ERROR`, their impulses to
    `horizon.IMPULSE_ERROR`.

    `outcome_certain` says whether these errors cannot change the outcome either: neighbours of the toss end
    as it does, see `cointoss.analytic.horizon.certainty`. If a neighbour has another outcome, `other_outcome`
    gives that outcome and about the smallest change that leads to it.

    Args:
        scenario: what to toss; or a file's path, or a name such as "fig24a".
        settings: of the engine.
        law: a contact law of one's own, in place of the scenario's.

    Raises:
        ScenarioError: for a file or a name that can't be used, and for more impacts than can be kept.
        UnsupportedError: for a floor that a law of one's own can't be used with.
    """
    require_type("settings", settings, AnalyticSettings, "analytic.AnalyticSettings, such as analytic.FINE")
    described = scenario_of(scenario)
    rules = keeping_all(rules_by(law, described), described)
    so_far = np.zeros(2)
    with stage("tossing by the analytic engine", detail=lambda: reached(int(so_far[0]), so_far[1])):
        return interruptible(lambda: _toss(described, rules, settings, law, so_far))


def _toss(
    scenario: Scenario, rules: Rules, settings: AnalyticSettings, law: OwnLaw | None, so_far: Array
) -> Toss:
    body, start = scenario.body, state_at_release(scenario.release)
    answer = run(body, rules, start, settings, scenario.ending.until, so_far)
    impacts, end = Impacts.from_rows(answer.rows), state_of(answer.started.states[-1])
    horizon, contacts = horizon_of(body, rules, answer), answer.contacts
    certainty = certainty_of(body, rules, answer.rows, answer.started, answer.verdict, horizon)
    before_contact = np.sum(impacts.time < contacts[0, 0]) if len(contacts) else len(impacts)
    path = Pieces(
        body=body,
        friction=friction_in_contact(rules),
        contact_tolerance=settings.contact_tolerance,
        started=answer.started,
    )
    return Toss(
        engine="analytic",
        scenario=scenario,
        impacts=impacts,
        contacts=contacts,
        outcome=answer.outcome,
        ending=answer.ending,
        end_time=answer.end_time,
        outcome_certain=certainty.certain,
        other_outcome=other_outcome(body, rules, answer, horizon, certainty),
        trusted_impacts=horizon.impacts,
        trust_end=TrustEnd.of(horizon.impacts, before_contact=int(before_contact), count=len(impacts)),
        certificate=(
            Setting(name="flight", value=_flight(body)),
            Setting(name="error allowed in a step of flight, relative", value=settings.tolerance),
            Setting(name="error allowed in a step of contact, relative", value=settings.contact_tolerance),
            Setting(name="error of a step carried to the horizon: of the motion, relative", value=STEP_ERROR),
            Setting(name="error of a step carried to the horizon: of the attitude", value=TURN_ERROR),
            Setting(name="part of these errors in a step in closed form", value=CLOSED_FORM),
            Setting(name="safety factor of the horizon", value=SAFETY),
            Setting(
                name="energy at the end",
                value=energy(body, end.position[2], end.velocity, end.spin),
                unit="J",
            ),
            Setting(
                name="energy of the lowest pass to the other face", value=barrier(body, end.R[2][2]), unit="J"
            ),
            *measurements(
                scenario,
                impacts,
                contacts,
                _in_contact(body, answer.started),
                path,
                force_and_moment,
                None if law is None else residuals(law, body, rules, impacts),
            ),
            *(() if law is None else _of_own_law(law, body, rules, impacts, answer)),
        ),
        path=replace(path, started=answer.path),
        later=later_part(answer),
    )


def _of_own_law(
    law: OwnLaw, body: Body, rules: Rules, impacts: Impacts, answer: EventLog
) -> Iterator[Setting]:
    """Yield the lines of a certificate about a law of one's own."""
    yield Setting(name="contact law of one's own, in place of the scenario's", value=law.name)
    if not never_adds_energy(rules):
        gained = np.maximum(impacts.energy_change, 0).sum() / (body.mass * body.gravity * body.radius)
        yield Setting(name="impacts: energy that this law adds, in all", value=float(gained), unit="m g r")
    if answer.ending == Ending.NO_SOLUTION:
        y = answer.started.states[-1]
        touched = contact_in(body, rules, rotation_matrix(attitude_of(y)), y[3:6], y[10:13])
        yield Setting(name="the impulse refused", value=law.breach(touched))


def _flight(body: Body) -> str:
    if not is_ideal(body) or body.air.exponent is not None:
        return _INTEGRATED
    if in_vacuum(body):
        return "closed form of the symmetric top"
    return f"power series without spin about the normal, else {_INTEGRATED}"


def _in_contact(body: Body, started: Started) -> InContact:
    """Return states and gaps at start and end of each stretch of contact in one mode, and the landings.

    Where a second rim lands, on its edge, a flight that takes no time ends in contact.
    """
    times, states = started.times, started.states
    stays = (started.modes != Mode.FLIGHT) & (started.modes != Mode.ENDED)
    n_z = 1 - 2 * (states[:, 7] ** 2 + states[:, 8] ** 2)
    lands = ~stays[:-1] & stays[1:] & (np.diff(times) == 0) & (np.abs(n_z[:-1]) < _UPRIGHT)

    def at_both_ends(of: NDArray[np.bool_]) -> Changes:
        first = np.flatnonzero(of)
        return Changes(*(States.from_rows(times[i], states[i]) for i in (first, first + 1)))

    stretches = at_both_ends(stays[:-1])
    found = np.concatenate([gaps(body, each) for each in stretches])
    return InContact(stretches, at_both_ends(lands), found)
