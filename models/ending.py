"""How a toss ends: whether the face that is up can still change, by one function for both engines."""

import math

from models.barriers import barrier, energy, rim_offset, spin_barrier, spin_barrier_bound
from models.body import in_vacuum
from models.clearance import drag_bound
from models.geometry import tilt_sine_of
from models.kernel.compiled import compiled
from models.kernel.vectors import apply, dot, norm
from models.laws import ContactLaw, EndingTest, RestitutionKind
from models.perpetual import energy_loss_converges
from models.records import Ending, Face, Outcome

# What is left of the energy of tilting, against m g r, in a coin that lies flat.
WOBBLE = 1e-9


@compiled
def face_up(n_z):
    """Return the face that is up, from the upward component of the coin's normal, eq. (4)."""
    return Face.HEADS if n_z > 0 else Face.TAILS


@compiled
def classify_ending(body, rules, state, time, history, no_loss):
    """Return how a toss in this state ends; `Outcome.UNDECIDED` and `Ending.NONE` where it goes on.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
        time: now [s].
        history: `EnergyHistory` of the toss; kept up.
        no_loss: a loss in the time √(r/g) that an engine cannot tell from none, against the energy.
    """
    outcome, ending = final_face(body, rules, state)
    if ending == Ending.NONE and energy_loss_converges(body, rules, state, time, history, no_loss):
        return Outcome.PERPETUAL, Ending.PERPETUAL
    return outcome, ending


@compiled
def final_face(body, rules, state):
    """Return the face that stays up and why, or the edge; UNDECIDED and NONE where either may still come.

    "rigorous": the energy is below the pass to the other face (or, on a smooth floor in vacuum, below it with
    what the conserved spin needs) and the tilt is on this face's side of the pass; or the coin lies flat. A
    thick coin may also be caught on its edge. Only the smooth law, and `coulomb` with energetic restitution,
    never add energy; for every other the same test ends the toss as `Ending.PAPER`. "paper" is E < m g r and
    "paper_smooth" is eq. (20) of Strzalko et al. 2008.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
    """
    z, v, w, up = state.position[2], state.velocity, state.spin, state.R[2]
    E = energy(body, z, v, w)
    face = Outcome.HEADS if up[2] > 0 else Outcome.TAILS
    mgr = body.mass * body.gravity * body.radius
    if rules.test == EndingTest.PAPER:
        if E < mgr:
            return face, Ending.PAPER
        return Outcome.UNDECIDED, Ending.NONE
    if rules.test == EndingTest.PAPER_SMOOTH:
        kept = body.mass * (v[0] * v[0] + v[1] * v[1]) / 2 + body.inertia[2][2] * w[2] * w[2] / 2
        if E - kept < mgr:
            return face, Ending.PAPER_SMOOTH
        return Outcome.UNDECIDED, Ending.NONE

    smooth = rules.law == ContactLaw.SMOOTH
    energetic = rules.restitution_kind == RestitutionKind.ENERGETIC
    ending = Ending.SETTLED if smooth or energetic else Ending.PAPER
    tilt_sine = tilt_sine_of(up)
    out, high = rim_offset(body, up[2])
    on_face = tilt_sine * high < out * abs(up[2])
    if E < barrier(body, up[2]):
        if on_face:
            return face, ending
        if E < barrier(body, -up[2]) and _beyond_the_pass(body, up, tilt_sine):
            return Outcome.EDGE, ending
    if smooth and in_vacuum(body):
        E_turning = E - body.mass * (v[0] * v[0] + v[1] * v[1]) / 2
        # Off the face's side of the pass a coin may be just upright, within rounding of what it needs.
        E_turning += 0.0 if on_face else WOBBLE * mgr
        if not E_turning > spin_barrier_bound(body, up, w) and E_turning < spin_barrier(body, up, w):
            return face, Ending.SETTLED
    if _lies(body, rules, state):
        return face, Ending.LYING
    return Outcome.UNDECIDED, Ending.NONE


@compiled
def _beyond_the_pass(body, up, tilt_sine):
    """Return whether C is on the edge's side of the pass over the rim point that is lowest."""
    if tilt_sine == 0:
        return False
    c = body.center
    out = body.radius + (c[0] * up[0] + c[1] * up[1]) / tilt_sine
    high = rim_offset(body, up[2])[1]
    return tilt_sine * high > out * abs(up[2])


@compiled
def _lies(body, rules, state):
    """Return whether the coin lies flat for good, whatever it has of sliding and of spin about its normal.

    What is left of its tilt, of its turning about diameters and of its vertical motion is nothing, and the
    floor can balance all moments that spin, drag and friction make about diameters by pressing inside the
    rim. As sliding and spinning never grow, neither do these moments.
    """
    z, v, w, up = state.position[2], state.velocity, state.spin, state.R[2]
    c, J = body.center, body.inertia
    flat_z = rim_offset(body, up[2])[1]
    across = (w[0], w[1], 0.0)
    wobble = (
        body.mass * (v[2] * v[2] / 2 + body.gravity * abs(z - flat_z)) + dot(across, apply(J, across)) / 2
    )
    weight = body.mass * body.gravity
    if wobble > WOBBLE * weight * body.radius:
        return False
    mu = rules.friction if rules.law == ContactLaw.COULOMB else 0.0
    if rules.law != ContactLaw.COULOMB and rules.law != ContactLaw.SMOOTH:
        return False
    k, arm, turn_drag = drag_bound(body, body.air.exponent, v, w, 0.0)
    drag = k * (norm(v) + arm * norm(w))
    slowing = (mu * weight * body.radius + turn_drag * abs(w[2]) + drag * arm) / J[2][2]
    moment = math.hypot(J[0][2], J[1][2]) * (w[2] * w[2] + slowing)
    moment += mu * weight * flat_z + drag * arm
    return moment < weight * (body.radius - math.hypot(c[0], c[1]))
