"""One toss in MuJoCo: fly, press, record, until the toss is decided."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import warnings
from typing import NamedTuple

import mujoco
import numpy as np

from coin_mj.contact import ROUGH, ContactSettings, Friction, Realisation
from coin_mj.impact import Contact, press
from coin_mj.machine import Knots, Machine, fly, machine_of
from coin_mj.scene import shape_thickness
from coin_mj.stepping import FLIGHT_ANGLE
from models.attitude import rotation_matrix
from models.body import Rules
from models.ending import energy, face_up, judge
from models.geometry import contact_velocity, lowest_point
from models.laws import ContactLaw, RestitutionKind
from models.records import (
    IMPACT_ROW,
    ApproximationWarning,
    Array,
    Ending,
    Impacts,
    Outcome,
    Setting,
    Toss,
    UnsupportedError,
)
from models.scenario import Scenario

REALISABLE = (ContactLaw.SMOOTH, ContactLaw.COULOMB, ContactLaw.PERFECTLY_ROUGH)
HEAVY = 10
"""A touch-down is no impact when gravity alone gives its speed in so many times the duration of a contact."""

SOFTER = (10.0, 30.0)
"""How many times softer the contacts are that tell how far a toss can be trusted."""
IMPULSE_CHANGE = 0.03
"""Within the horizon no softer contact changes an impulse by more than this part."""


class Run(NamedTuple):
    """What the event loop gives for one toss."""

    rows: np.ndarray
    """Impacts, (n,) of `IMPACT_ROW`."""
    contacts: list[tuple[float, float]]
    """Contacts that last [s]."""
    outcome: Outcome
    ending: Ending


def run(machine: Machine, rules: Rules) -> Run:
    """Toss the coin from its present state until the toss is decided."""
    rows: list[np.ndarray] = []
    contacts: list[tuple[float, float]] = []
    outcome, ending = Outcome.UNDECIDED, Ending.NONE
    heavy = HEAVY * machine.body.gravity * machine.rebound.duration
    while ending == Ending.NONE:
        if len(rows) == rules.max_impacts:
            ending = Ending.MAX_IMPACTS
        elif not fly(machine, rules.max_time):
            ending = Ending.MAX_TIME
        elif -machine.outlook().speed < heavy:
            outcome, ending = _at_rest(machine, rules)
        else:
            touch = machine.state()
            contact = press(machine)
            if contact is None:
                continue
            if contact.lasts:
                contacts.append((contact.start, contact.end))
                outcome, ending = _at_rest(machine, rules)
                continue
            rows.append(_row(machine, contact, touch))
            outcome, ending = _decided(machine, rules)
    return Run(
        np.concatenate(rows) if rows else np.zeros(0, IMPACT_ROW), contacts, Outcome(outcome), Ending(ending)
    )


def _decided(machine: Machine, rules: Rules) -> tuple[Outcome, Ending]:
    """Judge the present state."""
    x, v, e, w = machine.state()
    return judge(machine.body, rules, x[2], v, rotation_matrix(e)[2], w)


def _at_rest(machine: Machine, rules: Rules) -> tuple[Outcome, Ending]:
    """Judge a coin that stays in contact: what is not decided ends as chatter."""
    outcome, ending = _decided(machine, rules)
    return outcome, Ending.CHATTER if ending == Ending.NONE else ending


def _row(machine: Machine, contact: Contact, touch: tuple[Array, Array, Array, Array]) -> np.ndarray:
    """Record an impact: the state at first touch, the velocities at release, the impulse in between."""
    body = machine.body
    x, v, e, w = touch
    x_after, v_after, e_after, w_after = machine.state()
    R, R_after = rotation_matrix(e), rotation_matrix(e_after)
    point, _ = lowest_point(body, R[2], w)
    E_before, E_after = energy(body, x[2], v, w), energy(body, x_after[2], v_after, w_after)
    row = np.zeros(1, IMPACT_ROW)
    row["time"] = contact.start
    row["face"] = face_up(R[2][2])
    row["impulse"] = contact.impulse
    row["point"] = point
    row["position"], row["quaternion"] = x, e
    row["velocity_before"], row["velocity_after"] = v, v_after
    row["angular_velocity_before"], row["angular_velocity_after"] = w, w_after
    row["contact_velocity_before"] = contact_velocity(body, R, v, w, point)
    row["contact_velocity_after"] = contact_velocity(body, R_after, v_after, w_after, point)
    row["energy"], row["energy_change"] = E_after, E_after - E_before
    return row


def require_supported(scenario: Scenario, realisation: Realisation) -> None:
    """Refuse what this engine doesn't realise.

    Raises:
        UnsupportedError: naming field, value and what is accepted.
    """
    floor = scenario.floor
    if floor.contact not in REALISABLE:
        accepted = ", ".join(f'"{law.label}"' for law in REALISABLE)
        raise UnsupportedError(
            f'floor.contact = "{floor.contact.label}": accepted by the MuJoCo engine: {accepted}'
        )
    if floor.restitution_kind != RestitutionKind.KINEMATIC:
        raise UnsupportedError(
            f'floor.restitution_kind = "{floor.restitution_kind.label}": accepted by the MuJoCo engine: '
            '"kinematic" (its contacts prescribe how the normal speed changes, whatever the work)'
        )
    if floor.restitution == 0 and realisation == Realisation.SPRING:
        raise UnsupportedError(
            "floor.restitution = 0: accepted by the MuJoCo engine: a number > 0 (a damped spring rebounds), "
            "or one-step contacts"
        )


def toss(
    scenario: Scenario,
    *,
    realisation: Realisation = Realisation.SPRING,
    friction: Friction = Friction.EXPLICIT,
    stiffness: float = ContactSettings().stiffness,
) -> Toss:
    """Toss a coin in MuJoCo.

    A spring's contact lasts about π/√stiffness, in which the coin turns a little: the impulse differs from
    Newton's by a part that falls with 1/√stiffness. A one-step contact is Newton's law at the attitude of
    the touch.

    `trusted_impacts` counts the leading impacts that keep their faces, and their impulses to
    `IMPULSE_CHANGE`, when the contact is softer, or its one step longer, by each of `SOFTER`: that makes a
    spring's error three and five times larger. It is an estimate, no bound.

    Args:
        scenario: what to toss.
        realisation: how a contact gives the restitution.
        friction: who makes the friction of a floor that has one.
        stiffness: of the spring, per unit of effective mass [1/s²].

    Raises:
        UnsupportedError: for contact laws other than "smooth", "coulomb" and "perfectly_rough"; energetic
            restitution; restitution 0 of a spring.

    Warns:
        ApproximationWarning: for a perfectly rough floor, which is one of friction `ROUGH`.
    """
    require_supported(scenario, realisation)
    if scenario.floor.contact == ContactLaw.PERFECTLY_ROUGH:
        warnings.warn(
            f'floor.contact = "perfectly_rough": MuJoCo tosses on a floor of friction {ROUGH:g}',
            ApproximationWarning,
            stacklevel=2,
        )
    settings = ContactSettings(realisation=realisation, friction=friction, stiffness=stiffness)
    rules, machine = scenario.rules, machine_of(scenario, settings, shape_thickness(scenario))
    answer = run(machine, rules)
    machine.keep()
    machine.set_contacts(False)  # from here on the model only samples flights
    impacts = Impacts.from_rows(answer.rows)
    return Toss(
        engine="mujoco",
        scenario=scenario,
        impacts=impacts,
        contacts=np.array(answer.contacts).reshape(-1, 2),
        outcome=answer.outcome,
        ending=answer.ending,
        end_time=machine.data.time,
        trusted_impacts=_trusted_impacts(scenario, settings, impacts),
        certificate=(
            Setting(name="MuJoCo", value=mujoco.__version__),
            *_contact_certificate(machine),
            Setting(name="largest turn in a step of flight", value=FLIGHT_ANGLE, unit="rad"),
            Setting(name="thickness of the shape", value=machine.shape.thickness, unit="m"),
            Setting(name="steps", value=len(machine.knots) - 1),
        ),
        path=Knots(model=machine.model, body=machine.body, knots=tuple(machine.knots)),
    )


def impacts_of(scenario: Scenario, settings: ContactSettings, thickness: float | None = None) -> Impacts:
    """Toss a coin for its impacts alone: no path, no certificate, no horizon of trust.

    Args:
        scenario: what to toss.
        settings: how MuJoCo realises the floor.
        thickness: of the coin's shape, by default `shape_thickness` [m].
    """
    machine = machine_of(scenario, settings, thickness or shape_thickness(scenario))
    return Impacts.from_rows(run(machine, scenario.rules).rows)


def _contact_certificate(machine: Machine) -> tuple[Setting, ...]:
    settings, rebound = machine.settings, machine.rebound
    if settings.realisation == Realisation.ONE_STEP:
        made = (
            Setting(name="integrator", value="RK4, in a contact semi-implicit Euler"),
            Setting(name="contact", value="one step"),
            Setting(name="contact damping", value=rebound.damping, unit="1/s"),
            Setting(name="length of the step", value=rebound.step, unit="s"),
        )
    else:
        made = (
            Setting(name="integrator", value="RK4"),
            Setting(name="contact", value="spring"),
            Setting(name="contact stiffness", value=rebound.stiffness, unit="1/s²"),
            Setting(name="contact damping", value=rebound.damping, unit="1/s"),
            Setting(name="half a period of the contact", value=rebound.duration, unit="s"),
            Setting(name="steps in it", value=settings.steps),
        )
    if machine.friction == 0:
        return made
    maker = "MuJoCo's cone" if settings.friction == Friction.NATIVE else "Coulomb's force"
    return (
        *made,
        Setting(name="friction by", value=maker),
        Setting(name="coefficient of friction", value=machine.friction),
    )


def _trusted_impacts(scenario: Scenario, settings: ContactSettings, impacts: Impacts) -> int:
    """Count the leading impacts that all coins share that are further from the hard limit.

    Their contacts are softened by `SOFTER`; where a thin coin's shape is made up it is ten times as thick.
    """
    thickness = scenario.coin.thickness or 10 * shape_thickness(scenario)
    trusted = len(impacts)
    for part in SOFTER:
        ending = scenario.ending.model_copy(update={"max_impacts": trusted})
        shorter = scenario.model_copy(update={"ending": ending})
        softer = impacts_of(shorter, settings.softened(part), thickness)
        n = min(trusted, len(softer))
        change = np.linalg.norm(softer.impulse[:n] - impacts.impulse[:n], axis=1)
        agrees = (impacts.face[:n] == softer.face[:n]) & (
            change <= IMPULSE_CHANGE * np.linalg.norm(impacts.impulse[:n], axis=1)
        )
        trusted = n if agrees.all() else int(np.argmin(agrees))
        if trusted == 0:
            break
    return trusted
