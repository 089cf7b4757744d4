"""One toss in MuJoCo, with its certificate and its horizon of trust."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import warnings
from dataclasses import replace
from typing import NamedTuple

import mujoco
import numpy as np

from cointoss.coin_mj.entries import air_force, go_on, toss_coin
from cointoss.coin_mj.model.machine import Machine, machine_of
from cointoss.coin_mj.model.scene import shape_thickness
from cointoss.coin_mj.model.settings import FINE, ROUGH, Friction, MujocoSettings, Realisation
from cointoss.coin_mj.path import Knots
from cointoss.coin_mj.steps.held_step import contact_restitution
from cointoss.coin_mj.trust import lawful_impacts, shared_impacts
from cointoss.models.body import Body, Rules
from cointoss.models.certificate import InContact, gaps, measurements
from cointoss.models.contact_laws.table import is_rough, laws_that, quoted
from cointoss.models.errors import require_type
from cointoss.models.impact_row import FIRST_ROOM
from cointoss.models.interruptible import interruptible
from cointoss.models.kernel.vectors import Vector, cross, subtract
from cointoss.models.laws import RestitutionKind
from cointoss.models.parts import RESISTANCES
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import (
    IMPACT_ROW,
    ApproximationWarning,
    Array,
    Ending,
    Impacts,
    Later,
    Outcome,
    Setting,
    Toss,
    TrustEnd,
    UnsupportedError,
)
from cointoss.models.scenario import Scenario, keeping_all
from cointoss.models.stages import reached, stage

REALISABLE = laws_that(lambda law: law.is_in_mujoco)
SOFTER = (10.0, 30.0)
"""The factors by which contacts are softened to find how far a toss can be trusted."""
_INTEGRATORS = "Tsitouras 5, in sustained contact RK4"


class MujocoRun(NamedTuple):
    """What the event loop returns for one toss."""

    rows: np.ndarray
    """Impacts, (n,) of `IMPACT_ROW`."""
    knots: Array
    """The table of the path, see `Knots`."""
    contacts: Array
    """Start and end of every sustained contact, (n, 2) [s]."""
    outcome: Outcome
    ending: Ending
    end_time: float


def run(machine: Machine, rules: Rules) -> MujocoRun:
    """Toss the coin from its present state until the toss is decided."""
    room, impacts = np.zeros(FIRST_ROOM, IMPACT_ROW), np.zeros(1)
    with stage("tossing by MuJoCo", detail=lambda: reached(int(impacts[0]), machine.data.time)):
        n, rows, knots, contacts, outcome, ending, end_time = toss_coin(
            machine.coin, machine.plastic, rules, machine.settings.budgets, room, True, impacts
        )
    rows = rows[:n].copy()
    for told in ("impulse", "energy", "energy_change"):
        rows[told] *= machine.mass_unit
    return MujocoRun(rows, knots, contacts, Outcome(outcome), Ending(ending), end_time)


def require_supported(scenario: Scenario, *, settings: MujocoSettings) -> None:
    """Refuse scenarios that this engine can't realise.

    Raises:
        UnsupportedError: naming field, value and what is accepted.
    """
    floor = scenario.floor
    if floor.contact not in REALISABLE:
        raise UnsupportedError(
            f'floor.contact = "{floor.contact}": accepted by the MuJoCo engine: {quoted(REALISABLE)}'
        )
    if floor.restitution_kind != RestitutionKind.KINEMATIC:
        raise UnsupportedError(
            f'floor.restitution_kind = "{floor.restitution_kind}": accepted by the MuJoCo engine: '
            '"kinematic" (its contacts prescribe how the normal speed changes, whatever the work)'
        )
    resisting = {f"floor.{name}": getattr(floor, name) for name in RESISTANCES}
    resisting["air.viscosity"] = scenario.air.viscosity
    for name, value in resisting.items() if settings.friction == Friction.NATIVE else ():
        if value > 0:
            raise UnsupportedError(
                f"{name} = {value:g}: accepted by the MuJoCo engine with its native friction: 0; "
                "more with explicit friction"
            )


def toss(scenario: ScenarioSource, *, settings: MujocoSettings = FINE) -> Toss:
    """Toss a coin in MuJoCo.

    A spring's contact lasts about π/√stiffness, in which the coin turns a little: the impulse differs from
    Newton's by a part that falls with 1/√stiffness. A one-step contact is Newton's law at the attitude of
    the touch. A coin that stays in contact is followed there, until the toss is decided.

    `trusted_impacts` counts the leading impacts that meet Newton's law for the point that touched, see
    `cointoss.coin_mj.trust`, and that keep their faces, and their impulses to `IMPULSE_ERROR` there, when the
    contact is softer, or its one step longer, by each of `SOFTER`: that makes a spring's error three and five
    times larger. The count is an estimate, no bound. This engine does not find whether the outcome is
    certain: `outcome_certain` is None.

    Args:
        scenario: what to toss; or a file's path, or a name such as "fig24a".
        settings: how MuJoCo realises the floor, and how finely it steps.

    Raises:
        ScenarioError: for a file or a name that can't be used, and for more impacts than can be kept.
        UnsupportedError: for contact laws other than "smooth", "coulomb" and "perfectly_rough"; energetic
            restitution; resistance to motion in contact beside native friction.

    Warns:
        ApproximationWarning: for a perfectly rough floor, which is one of friction `ROUGH`.
    """
    require_type("settings", settings, MujocoSettings, "coin_mj.MujocoSettings, such as coin_mj.FINE")
    described = scenario_of(scenario)
    require_supported(described, settings=settings)
    rules = keeping_all(described.rules, described)
    warn_of_approximation(described)
    with stage("tossing by MuJoCo"):
        return interruptible(lambda: _toss(described, rules, settings))


def _toss(scenario: Scenario, rules: Rules, settings: MujocoSettings) -> Toss:
    machine = machine_of(scenario, settings)
    answer = run(machine, rules)
    impacts = Impacts.from_rows(answer.rows)
    path = Knots(machine=machine, knots=answer.knots, restitution=contact_restitution(machine.coin, rules))
    followed, later = _followed(machine, rules, answer, scenario.ending.until)
    trusted, trust_end = _trust(scenario, settings, impacts, answer.contacts)
    return Toss(
        engine="mujoco",
        scenario=scenario,
        impacts=impacts,
        contacts=answer.contacts,
        outcome=answer.outcome,
        ending=answer.ending,
        end_time=answer.end_time,
        outcome_certain=None,
        other_outcome=None,
        trusted_impacts=trusted,
        trust_end=trust_end,
        certificate=(
            Setting(name="MuJoCo", value=mujoco.__version__),
            *_contact_certificate(machine),
            Setting(name="largest turn in a step of flight", value=machine.coin.flight_angle, unit="rad"),
            Setting(name="thickness of the shape", value=machine.coin.shape.thickness, unit="m"),
            Setting(name="steps", value=len(answer.knots) - 1),
            *measurements(
                scenario,
                impacts,
                answer.contacts,
                InContact(
                    path.stretches(answer.contacts),
                    path.landings(),
                    np.concatenate([gaps(scenario.body, states) for states in path.contact_states()]),
                ),
                path,
                _force_and_moment,
            ),
        ),
        path=replace(path, knots=followed),
        later=later,
    )


def _followed(machine: Machine, rules: Rules, answer: MujocoRun, until: float | None) -> tuple[Array, Later]:
    """Return the knots of the path, continued after the toss if asked for, and the events there."""
    if until is None:
        return answer.knots, Later()
    knots, touches = go_on(
        machine.coin, machine.plastic, rules, machine.settings.budgets, answer.knots, answer.ending, until
    )
    held = touches[:, 2] == 1
    return knots, Later(end=float(knots[-1, 0]), times=touches[~held, 0], contacts=touches[held, :2])


def warn_of_approximation(scenario: Scenario) -> None:
    """Warn of properties that this engine approximates."""
    law = scenario.floor.contact
    if is_rough(law):
        warnings.warn(
            f'floor.contact = "{law}": MuJoCo tosses on a floor of friction {ROUGH:g}',
            ApproximationWarning,
            stacklevel=3,
        )


def impacts_of(
    scenario: Scenario,
    *,
    settings: MujocoSettings = FINE,
    thickness: float | None = None,
    softer: float = 1.0,
) -> Impacts:
    """Toss a coin for its impacts alone: no path, no certificate, no horizon of trust.

    Args:
        scenario: what to toss.
        settings: how MuJoCo realises the floor.
        thickness: of the coin's shape, by default `shape_thickness` [m].
        softer: by which the contacts are softened, see `MujocoSettings.softened`.
    """
    machine = machine_of(scenario, settings, thickness, softer)
    return Impacts.from_rows(interruptible(lambda: run(machine, scenario.rules)).rows)


def _contact_certificate(machine: Machine) -> tuple[Setting, ...]:
    settings, rebound, friction = machine.settings, machine.coin.rebound, machine.coin.friction
    if settings.contact == Realisation.ONE_STEP:
        made = (
            Setting(name="integrator", value=f"{_INTEGRATORS}, in an impact semi-implicit Euler"),
            Setting(name="contact", value="one step"),
            Setting(name="contact damping", value=rebound.damping, unit="1/s"),
            Setting(name="length of the step", value=rebound.step, unit="s"),
        )
    else:
        made = (
            Setting(name="integrator", value=_INTEGRATORS),
            Setting(name="contact", value="spring"),
            Setting(name="contact stiffness", value=rebound.stiffness, unit="1/s²"),
            Setting(name="contact damping", value=rebound.damping, unit="1/s"),
            Setting(name="half a period of the contact", value=rebound.duration, unit="s"),
            Setting(name="steps in it", value=settings.steps),
        )
    if friction == 0:
        return made
    maker = "MuJoCo's native friction cone" if settings.friction == Friction.NATIVE else "Coulomb's force"
    return (
        *made,
        Setting(name="friction by", value=maker),
        Setting(name="coefficient of friction", value=friction),
    )


def _force_and_moment(body: Body, v: Vector, w: Vector) -> tuple[Vector, Vector]:
    """Return the air's force and its moment about C for b > 0; see `cointoss.models.certificate.Air`."""
    c = body.center
    f, m_B = air_force(body.radius, body.thickness, body.air, subtract(v, cross(w, c)), w)
    return f, subtract(m_B, cross(c, f))


def _trust(
    scenario: Scenario, settings: MujocoSettings, impacts: Impacts, contacts: Array
) -> tuple[int, TrustEnd]:
    """Count the leading impacts that meet the contact law and stay the same with softer contacts.

    The contacts are softened by `SOFTER`; a thin coin's shape, of invented thickness, is ten times as thick.
    No impact after the first sustained contact is counted.

    Returns:
        The count, and why the trust ends.
    """
    before_contact = int(np.sum(impacts.time < contacts[0, 0])) if len(contacts) else len(impacts)
    trusted, end = lawful_impacts(scenario, impacts, before_contact)
    thickness = scenario.coin.thickness or 10 * shape_thickness(scenario)
    for part in SOFTER:
        if trusted == 0:
            break
        shorter = scenario.replace("ending.max_impacts", trusted)
        softer = impacts_of(shorter, settings=settings, thickness=thickness, softer=part)
        shared = shared_impacts(impacts, softer, trusted)
        if shared < trusted:
            trusted, end = shared, TrustEnd.ERRORS
    return trusted, end
