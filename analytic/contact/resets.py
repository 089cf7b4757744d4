"""The resets of a coin in contact: each maps the state at an event to that in which the next mode starts."""

import math

from cointoss.analytic.contact import upright
from cointoss.analytic.contact.automaton import Mode, project
from cointoss.analytic.contact.contact import Contact
from cointoss.analytic.contact.one_rim import contact_in_flight
from cointoss.analytic.contact.periodic import tilt_rate
from cointoss.analytic.contact.rim_contact import accelerate
from cointoss.analytic.contact.sliding import jams, slips
from cointoss.analytic.flight.state_vector import attitude_of, normalise, set_attitude, set_height
from cointoss.analytic.impact.coulomb import coulomb
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body
from cointoss.models.geometry import FLAT_SINE
from cointoss.models.kernel.compiled import compiled
from cointoss.models.laws import RestitutionKind
from cointoss.models.records import Array


@compiled
def stop_slip(contact: Contact, following: int, y: Array) -> None:
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
    project(Contact(body, contact.friction, following, contact.rim), y)


@compiled
def stand_up(contact: Contact, y: Array) -> None:
    """Put a coin near its edge onto both rims; one that stuck takes the slow slip that holds it there.

    Args:
        contact: at one rim, up to here.
        y: state, (13,).
    """
    upright.project(contact, y)
    if contact.mode == Mode.STICKING:
        upright.start_slow_slip(contact, y)


@compiled
def tilt_onto_rim(body: Body, y: Array) -> None:
    """Tilt a coin that is just passing its edge as it turns: onto the rim that landed.

    Args:
        body: the coin.
        y: state, (13,).
    """
    up, rate = rotation_matrix(attitude_of(y))[2], tilt_rate(y)
    if body.thickness > 0 and abs(up[2]) < FLAT_SINE and rate != 0:
        upright.tilt(y, up[2] - math.copysign(FLAT_SINE / 8, rate))


@compiled
def lay_flat(body: Body, y: Array) -> None:
    """Turn a coin that all but lies on a face until it does, and all of the face touches the floor.

    A coin whose axis passes the vertical at a tilt below `FACE_SINE` would go on upon its rim, around which
    the lowest point runs in no time: here the opposite rim point lands, as where the axis passes through it.
    """
    a, b, c, d = attitude_of(y)
    heads_up = rotation_matrix((a, b, c, d))[2][2] > 0
    set_attitude(y, (a, 0.0, 0.0, d) if heads_up else (0.0, b, c, 0.0))
    normalise(y)
    set_height(y, body.thickness / 2 + (body.center[2] if heads_up else -body.center[2]))
