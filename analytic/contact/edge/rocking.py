"""Whether a coin that rocks on its edge, rim by rim, has too little energy to leave it."""

import math

import numpy as np

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.edge.restoring import TRIAL, restoring_acceleration
from cointoss.analytic.contact.edge.rolling import PHASES, roll_by, set_roll_rate, to_lowest
from cointoss.analytic.contact.rim_contact import lean_and_rate
from cointoss.analytic.flight.state_vector import STATE_SIZE, attitude_of, spin_of
from cointoss.analytic.numerics.tolerances import STEADY
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import apply, dot
from cointoss.models.records import Array

# While the accelerations a₋ and a₊ that restore either rim change slowly, the action of rocking,
# J ~ E^(3/2) (1/a₋ + 1/a₊), is an adiabatic invariant: its energy E grows by less than this factor until it
# meets the weaker rim.
_GROWTH = 1.5874010519681994  # 2^(2/3)


@compiled
def rocks_on_edge(contact: SustainedContact, y: Array) -> bool:
    """Return whether a coin that rocks on its edge, rim by rim, has too little energy of rocking to leave it.

    In every phase of its roll that it can reach, C lowest among them, the floor must turn it back from
    either rim up to `steady_lean`. The least work of that must be more than the energy of its rocking can
    become. That is now at most the energy of n_z's rate plus the work of the strongest restoring force over
    its lean. As its rims land the coin loses energy, and on a rough floor also L_z: there all of its energy
    may go into its roll. The answer is no while friction acts on slip, because friction tips the coin across
    the rim as soon as the slip turns that way.

    Args:
        contact: the contact, at one rim.
        y: state, (13,).
    """
    body, friction = contact.body, contact.friction
    n_z, n_z_rate = lean_and_rate(y)
    most_lean, moving = steady_lean(body), n_z_rate * n_z_rate / 2
    slips = friction.sliding > 0 and contact.mode != Mode.STICKING
    if slips or not abs(n_z) < most_lean:
        return False
    least_work, strongest, phase = np.inf, 0.0, np.empty(STATE_SIZE)
    L_z = dot(rotation_matrix(attitude_of(y))[2], apply(body.inertia, spin_of(y)))
    for i in range(PHASES):
        half_angle = to_lowest(body, y) / 2 + math.pi * i / PHASES
        roll_rate = roll_by(contact, friction.sliding == 0, y, half_angle, phase)
        if roll_rate < 0:
            continue
        for share in (1.0, -1.0, 0.0):
            set_roll_rate(body, L_z, False, share * roll_rate, phase)
            for rim in (1.0, -1.0):
                weakest, mean, force = turning_back(contact, rim, most_lean, phase)
                strongest = max(strongest, force)
                least_work = min(least_work, mean * most_lean)
                energy = moving + abs(n_z) * strongest
                if not (weakest > 0 and _GROWTH * energy < least_work):
                    return False
    return least_work < np.inf


@compiled
def turning_back(
    contact: SustainedContact, rim: float, most_lean: float, y: Array
) -> tuple[float, float, float]:
    """Return the least, the mean, from below, and the largest acceleration back from leans up to one [1/s²].

    Of coins the acceleration is concave in the lean, so that the trapezoid lies below it; of rods it may be
    convex, and what is in the middle lies below.

    Args:
        contact: the contact, at one rim.
        rim: the lower one, see `restoring_acceleration`.
        most_lean: the largest |n_z|.
        y: state that is tried so, (13,).
    """
    at_edge, middle, leaning = (
        restoring_acceleration(contact, rim, TRIAL, y),
        restoring_acceleration(contact, rim, most_lean / 2, y),
        restoring_acceleration(contact, rim, most_lean, y),
    )
    mean = min((at_edge + leaning) / 2, middle)
    return min(at_edge, middle, leaning), mean, max(at_edge, middle, leaning)


@compiled
def steady_lean(body: Body) -> float:
    """Return the |n_z| up to which a coin may be lifted by its rocking on its edge; see `STEADY`.

    A coin at rest has C above its lowest point at about 1/`STEADY` of it, or more. It is 0 for a coin that
    has no thickness, or C beyond a face.
    """
    x, y, z = body.center
    return STEADY * max(body.thickness / 2 - abs(z), 0.0) / (body.radius + math.hypot(x, y))
