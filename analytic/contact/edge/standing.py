"""Whether a coin on its edge stands: the floor holds it in every phase of its roll."""

import math

import numpy as np

from cointoss.analytic.contact.automaton import Mode, contact_at
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.edge.restoring import held_on_edge
from cointoss.analytic.contact.edge.rolling import PHASES, roll_by, set_roll_rate
from cointoss.analytic.contact.floor_force import friction_holds, holding_force, horizontal_size
from cointoss.analytic.contact.resistance import FloorFriction, has_resistance
from cointoss.analytic.contact.rim_contact import both_rims, lean_and_rate
from cointoss.analytic.flight.state_vector import STATE_SIZE, attitude_of, spin_of
from cointoss.analytic.numerics.tolerances import ON_EDGE, SLOW
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body, in_vacuum
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import apply, dot
from cointoss.models.records import Array
from cointoss.models.rest import is_slowing


@compiled
def on_edge(body: Body, y: Array) -> bool:
    """Return whether a coin in contact is on its edge, and does not turn away from it; see `ON_EDGE`."""
    n_z, n_z_rate = lean_and_rate(y)
    most = ON_EDGE * body.thickness / (2 * body.radius)
    return abs(n_z) < most and abs(n_z_rate) < most * (body.gravity / body.radius) ** 0.5


@compiled
def slows(body: Body, friction: FloorFriction, y: Array) -> bool:
    """Return whether the floor's resistance slows a coin that stands; see `is_slowing`."""
    w = apply(rotation_matrix(attitude_of(y)), spin_of(y))
    return is_slowing(body, friction.rolling + friction.contour.friction, friction.pivoting, w)


@compiled
def rolls(body: Body, friction: FloorFriction, y: Array) -> bool:
    """Return whether a coin on its edge rolls straight on: neither rim slips on a rough floor.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        y: state of a coin on its edge, (13,).
    """
    if friction.sliding == 0:
        return False
    tails, heads = both_rims(body, friction, y)
    slip = max(horizontal_size(tails.velocity), horizontal_size(heads.velocity))
    return slip < SLOW * (body.gravity * body.radius) ** 0.5


@compiled
def stands(contact: SustainedContact, y: Array) -> bool:
    """Return whether a coin on its edge is held there however it rolls on.

    Rolling brings C up and down, and so changes the roll rate: the floor must hold the coin in every phase
    that it can reach. Its energy bounds its roll rate there: it reaches the bound in vacuum on a smooth floor
    or without slip, and is slower, in either direction, where it loses energy. L_z determines its rate about
    the vertical, which is 0 if the coin `rolls`.

    Args:
        contact: the contact, at one rim or upright.
        y: state of a coin on its edge, (13,).
    """
    body, friction = contact.body, contact.friction
    straight = rolls(body, friction, y)
    at_rim = tipped(contact, straight, y)
    if not held_on_edge(at_rim, y):
        return False
    lossless = (friction.sliding == 0 or straight) and in_vacuum(body) and not has_resistance(friction)
    one_way = lossless
    phases, roll_rates = np.empty((PHASES, STATE_SIZE)), np.empty(PHASES)
    for i in range(PHASES):
        roll_rates[i] = roll_by(at_rim, not straight, y, math.pi * i / PHASES, phases[i])
        one_way = one_way and roll_rates[i] > 0
    L_z = dot(rotation_matrix(attitude_of(y))[2], apply(body.inertia, spin_of(y)))
    for i in range(PHASES):
        for share in (1.0, -1.0, 0.0):
            if roll_rates[i] < 0 or (one_way and share * spin_of(y)[2] < 0) or (lossless and share == 0):
                continue
            set_roll_rate(body, L_z, straight, share * roll_rates[i], phases[i])
            if not held_on_edge(at_rim, phases[i]) or (straight and not _sticks(body, friction, phases[i])):
                return False
    return True


@compiled
def tipped(contact: SustainedContact, straight: bool, y: Array) -> SustainedContact:
    """Return the contact of a coin on its edge once it is tipped onto its lower rim.

    Args:
        contact: of the coin, at one rim or upright.
        straight: whether it rolls straight on; its rim then sticks. A rim of an upright coin else slides.
        y: state, (13,).
    """
    mode = Mode.SLIDING.value if contact.mode == Mode.UPRIGHT else contact.mode
    return contact_at(contact.body, contact.friction, Mode.STICKING.value if straight else mode, y)


@compiled
def _sticks(body: Body, friction: FloorFriction, y: Array) -> bool:
    """Return whether friction can hold a coin on its edge by either rim; y: state, (13,)."""
    tails, heads = both_rims(body, friction, y)
    return friction_holds(
        friction.sliding, holding_force(tails.delassus, tails.free_acceleration)
    ) and friction_holds(friction.sliding, holding_force(heads.delassus, heads.free_acceleration))
