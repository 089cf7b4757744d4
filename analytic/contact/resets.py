"""The resets of a toss: each maps the state at an event to that in which the next mode starts."""

import math
from typing import Any, NamedTuple

from cointoss.analytic.contact import upright
from cointoss.analytic.contact.automaton import Mode, project
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.one_rim import contact_in_flight
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import accelerate, lean_and_rate, rim_contact
from cointoss.analytic.contact.sliding import jams, slips
from cointoss.analytic.flight.state_vector import (
    position_of,
    set_height,
    set_spin,
    set_velocity,
    state_of,
)
from cointoss.analytic.impact.laws import ImpactPoint, impulse, spin_after
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.body import Body, Rules
from cointoss.models.contact_laws.coulomb import coulomb
from cointoss.models.geometry import FLAT_SINE, contact_velocity, evaluate_gap, lowest_point
from cointoss.models.impact_row import write_impact
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, apply, scale, subtract
from cointoss.models.laws import RestitutionKind
from cointoss.models.records import Array, Ending
from cointoss.models.restitution import chatter_restitution, restitution_at_speed, varies
from cointoss.models.state import State

_TIP = 1e-12
"""The angle by which a coin is tipped off the rim that lifts [rad]."""


class ResolvedImpact(NamedTuple):
    """An impact of the floor on a coin, before it is applied."""

    point: Vector
    """A from B, body frame [m]."""
    contact_velocity: Vector
    """v_A before, space frame [m/s]."""
    impulse: Vector
    """Space frame [N s]."""
    after: State
    ending: Ending
    """`Ending.NO_SOLUTION` where the contact law has none, else `Ending.NONE`."""


@compiled
def impact_of(body: Body, rules: Rules, chi: float, before: State) -> ResolvedImpact:
    """Return the `ResolvedImpact` of a coin that touches the floor, at the restitution χ: Newton's law."""
    x, v, e, w, R = before
    point, flat = lowest_point(body, R[2], w)
    arm = apply(R, subtract(point, body.center))
    out = (point[0] ** 2 + point[1] ** 2) ** 0.5
    tau = (0.0, 0.0, 0.0) if flat else apply(R, (-point[1] / out, point[0] / out, 0.0))
    v_A = contact_velocity(body, R, v, w, point)
    A = ImpactPoint(R, arm, tau, v_A, flat)
    S, ending = impulse(body, rules, chi, A)
    v_after = add(v, scale(1 / body.mass, S))
    w_after = spin_after(body, rules, w, A, S)
    return ResolvedImpact(point, v_A, S, State(x, v_after, e, w_after, R), ending)


@compiled
def hit(body: Body, rules: Rules, chi: float, y: Array, row: Any) -> Ending:
    """Let the floor act on the coin in state y, which touches it, and record the impact.

    Args:
        body: the coin.
        rules: floor and ending.
        chi: restitution of this impact.
        y: state at the touch, (13,); becomes the state after the impact.
        row: where the impact is recorded, one `IMPACT_ROW`.

    Returns:
        `Ending.NO_SOLUTION` where the contact law has none, else `Ending.NONE`.
    """
    before = state_of(y)
    struck = impact_of(body, rules, chi, before)
    write_impact(body, struck.impulse, struck.point, before, struck.after, row)
    set_velocity(y, struck.after.velocity)
    set_spin(y, struck.after.spin)
    return struck.ending


@compiled
def restitution_at(body: Body, rules: Rules, y: Array) -> float:
    """Return χ of the touch in the state y, (13,), by its speed of approach."""
    if rules.restitution_threshold == 0 and not varies(rules):
        return rules.restitution
    return restitution_at_speed(rules, -evaluate_gap(body, state_of(y)).speed)


@compiled
def rebound_at(body: Body, rules: Rules, y: Array) -> float:
    """Return χ of a geometric chatter that outlasts the impacts to come of a coin in the state y, (13,).

    By a law of one's own it is no less than -v_Az'/v_Az of the impact there, and at most 1.
    """
    chi = restitution_at(body, rules, y)
    longest = chi
    if chi > 0 and varies(rules):
        longest = chatter_restitution(rules, -evaluate_gap(body, state_of(y)).speed)
    if rules.own.address == 0:
        return longest
    before = state_of(y)
    struck = impact_of(body, rules, chi, before)
    v, w, speed = struck.after.velocity, struck.after.spin, -struck.contact_velocity[2]
    if struck.ending != Ending.NONE or speed <= 0:
        return 1.0
    rebound = min(contact_velocity(body, before.R, v, w, struck.point)[2] / speed, 1.0)
    return max(rebound, longest) if varies(rules) else rebound


@compiled
def bounce(body: Body, rules: Rules, y: Array, row: Any) -> Ending:
    """Let the coin in state y, (13,), bounce off the floor; see `hit`."""
    ending = hit(body, rules, restitution_at(body, rules, y), y, row)
    if ending == Ending.NONE:
        # A step forced at a grazing point may have left the coin a little below the floor.
        set_height(y, position_of(y)[2] - min(evaluate_gap(body, state_of(y)).gap, 0.0))
    return ending


@compiled
def begin_contact(body: Body, rules: Rules, y: Array, row: Any) -> Ending:
    """Let the floor stop the approach of a coin in state y, (13,), whose impacts chatter; see `hit`."""
    ending = hit(body, rules, 0.0, y, row)
    if ending == Ending.NONE:
        tilt_onto_rim(body, y)
    return ending


@compiled
def tilt_onto_rim(body: Body, y: Array) -> None:
    """Tilt a coin that is just passing its edge as it turns: onto the rim that landed.

    Args:
        body: the coin.
        y: state, (13,).
    """
    n_z, rate = lean_and_rate(y)
    if body.thickness > 0 and abs(n_z) < FLAT_SINE and rate != 0:
        upright.tilt(y, n_z - math.copysign(FLAT_SINE / 8, rate))


@compiled
def stop_slip(contact: SustainedContact, following: int, y: Array) -> None:
    """Stop the slip of A, or turn it into incipient slip.

    Args:
        contact: up to here.
        following: number of the `Mode` that starts.
        y: state, (13,).
    """
    body, mu = contact.body, contact.friction.sliding
    A = contact_in_flight(contact, y)
    if slips(contact, A, contact.mode == Mode.SLIDING) and jams(contact, A):
        # Painlevé: an impact without approach stops the slip.
        slow, v_A = SLOW * (body.gravity * body.radius) ** 0.5, A.velocity
        S = coulomb(A.delassus, (v_A[0], v_A[1], -1e-6 * slow), 0.0, mu, RestitutionKind.KINEMATIC)
        accelerate(body, A, S, y)
    project(SustainedContact(body, contact.friction, following, contact.rim), y)


@compiled
def stand_up(contact: SustainedContact, y: Array) -> None:
    """Put a coin near its edge onto both rims; one that stuck takes the slow slip that holds it there.

    Args:
        contact: at one rim, up to here.
        y: state, (13,).
    """
    upright.project(contact, y)
    if contact.mode == Mode.STICKING:
        upright.start_slow_slip(contact, y)


@compiled
def tip_over(body: Body, friction: FloorFriction, y: Array) -> None:
    """Tip an upright coin a little onto the rim that is pressed harder, which stays on the floor.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        y: state, (13,).
    """
    on_tails, on_heads = upright.rim_forces(body, friction, y)
    # Tails' rim is the lower one of a coin with heads up.
    rim = -1.0 if on_tails > on_heads else 1.0
    upright.tilt(y, rim * _TIP)
    set_height(y, -rim_contact(body, y, rim).arm[2])
