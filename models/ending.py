"""How a toss ends: whether the face that is up can still change, by one function for both engines."""

import math

from cointoss.models.barriers import (
    barrier,
    edge_barrier,
    energy,
    energy_without_spin,
    rim_offset,
    spin_barrier,
    spin_barrier_bound,
)
from cointoss.models.body import (
    Body,
    Rules,
    in_vacuum,
    is_ideal,
    is_linear,
    is_to_be_caught,
    never_adds_energy,
    resists,
    slope_feeds,
)
from cointoss.models.clearance import drag_bound
from cointoss.models.contact_laws.table import is_followed, is_rough, is_smooth, uses_friction
from cointoss.models.geometry import tilt_sine_of
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, apply, dot, norm
from cointoss.models.laws import EndingTest
from cointoss.models.making import AT_REST
from cointoss.models.perpetual import EnergyHistory, can_be_judged, energy_loss_converges, wrongly_lost
from cointoss.models.records import Ending, Face, Outcome
from cointoss.models.state import State

REST_WAIT = 60.0
"""The longest time for which a coin is followed after its toss [s]: some coins never come to rest."""
# The largest energy of tilting, relative to m g r, of a coin that counts as flat; and of a coin that looks
# still, for the test "lying".
WOBBLE, STILL = 1e-9, 1e-3


@compiled
def face_up(n_z: float) -> Face:
    """Return the face that is up, from the upward component of the coin's normal, eq. (4)."""
    return Face.HEADS if n_z > 0 else Face.TAILS


@compiled
def classify_ending(
    body: Body, rules: Rules, state: State, time: float, history: EnergyHistory
) -> tuple[Outcome, Ending]:
    """Return how a toss in this state ends; `Outcome.UNDECIDED` and `Ending.NONE` where it goes on.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
        time: now [s].
        history: `EnergyHistory` of the toss; kept up.
    """
    if cannot_be_caught(body, rules, state):
        return Outcome.UNDECIDED, Ending.NOT_CAUGHT
    outcome, ending = final_face(body, rules, state, wrongly_lost(body, history, time))
    if ending == Ending.NONE and energy_loss_converges(body, rules, state, time, history):
        return endless(body, rules, state, history, Ending.PERPETUAL)
    return outcome, ending


@compiled
def cannot_be_caught(body: Body, rules: Rules, state: State) -> bool:
    """Return whether the energy of the coin can never lift it to the height of its catch.

    On a slope nothing bounds the energy, see `slope_feeds`.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
    """
    if not (is_to_be_caught(rules) and never_adds_energy(rules)) or slope_feeds(body, is_smooth(rules.law)):
        return False
    E = energy(body, state.position[2], state.velocity, state.spin)
    return E < body.mass * body.gravity * rules.caught


@compiled
def unless_caught(rules: Rules, outcome: Outcome, ending: Ending) -> tuple[Outcome, Ending]:
    """Return how a toss ends; if a hand is to catch the coin, its face on the floor is no outcome.

    Args:
        rules: floor and ending.
        outcome: in the hand or on the floor.
        ending: the ending with this outcome.
    """
    lies = outcome == Outcome.HEADS or outcome == Outcome.TAILS or outcome == Outcome.EDGE
    if is_to_be_caught(rules) and lies and ending != Ending.CAUGHT:
        return Outcome.UNDECIDED, Ending.NOT_CAUGHT
    return outcome, ending


@compiled
def endless(
    body: Body, rules: Rules, state: State, history: EnergyHistory, ending: Ending
) -> tuple[Outcome, Ending]:
    """Return how a toss ends whose coin goes on for ever without meeting the test of its scenario.

    If a test of the paper is never met, the face may still be settled.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
        history: of the toss.
        ending: PERIODIC where that is proved, PERPETUAL where it is extrapolated.
    """
    outcome, settled = settled_face(body, rules, state, wrongly_lost(body, history, math.inf))
    if settled != Ending.NONE:
        return outcome, settled
    return Outcome.PERPETUAL, ending


@compiled
def out_of_steps(body: Body, rules: Rules, state: State, history: EnergyHistory) -> tuple[Outcome, Ending]:
    """Return how a toss ends whose steps in contact are spent: in a long transient, or undecided.

    If the test of the scenario is not met, the face may still be settled.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
        history: of the toss.
    """
    outcome, settled = settled_face(body, rules, state, wrongly_lost(body, history, math.inf))
    if settled != Ending.NONE:
        return outcome, settled
    if can_be_judged(history):
        return Outcome.TRANSIENT, Ending.TRANSIENT
    return Outcome.UNDECIDED, Ending.CONTACT_STEPS


@compiled
def followed_until(rules: Rules, ending: Ending, end_time: float, until: float) -> float:
    """Return the time up to which a coin is followed after its toss [s]; `end_time` where it is not.

    A coin is not followed if a budget ended the toss, or a contact law that cannot go on.

    Args:
        rules: floor and ending.
        ending: of the toss.
        end_time: of the toss [s].
        until: that is asked for [s]; `AT_REST`: until the coin is at rest.
    """
    if (
        ending == Ending.MAX_IMPACTS
        or ending == Ending.MAX_TIME
        or ending == Ending.CHATTER
        or ending == Ending.NO_SOLUTION
        or ending == Ending.CONTACT_STEPS
        or ending == Ending.FLIGHT_STEPS
        or ending == Ending.ROLLING
        or ending == Ending.TRANSIENT
    ):
        return end_time
    last = end_time + REST_WAIT if until == AT_REST else until
    return max(min(last, rules.max_time), end_time)


@compiled
def final_face(body: Body, rules: Rules, state: State, doubt: float) -> tuple[Outcome, Ending]:
    """Return the face that stays up and why, or the edge; UNDECIDED and NONE where either may still come.

    "rigorous" is `settled_face`, "paper" is E < m g r and "paper_smooth" is eq. (20) of Strzalko et al. 2008;
    under each a coin may come to lie flat, with energy left that no longer turns it; "lying" waits for that,
    and so does any test on a slope, where no energy proves a face.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
        doubt: see `settled_face`.
    """
    face, mgr = face_outcome(state), body.mass * body.gravity * body.radius
    if rules.test == EndingTest.RIGOROUS:
        outcome, ending = settled_face(body, rules, state, doubt)
        if ending != Ending.NONE:
            return outcome, ending
    elif rules.test == EndingTest.PAPER:
        if energy(body, state.position[2], state.velocity, state.spin) < mgr:
            return face, Ending.PAPER
    elif rules.test == EndingTest.PAPER_SMOOTH and energy_without_spin(body, state) < mgr:
        return face, Ending.PAPER_SMOOTH
    waits = rules.test == EndingTest.LYING or slope_feeds(body, is_smooth(rules.law))
    if lies(body, rules, state, STILL if waits else WOBBLE):
        return face, Ending.LYING
    return Outcome.UNDECIDED, Ending.NONE


@compiled
def face_outcome(state: State) -> Outcome:
    """Return the face that is up, as an outcome."""
    return Outcome.HEADS if state.R[2][2] > 0 else Outcome.TAILS


@compiled
def settled_face(body: Body, rules: Rules, state: State, doubt: float) -> tuple[Outcome, Ending]:
    """Return the face that is proved to stay up and why, or the edge; UNDECIDED and NONE where none is.

    The energy is below the pass to the other face and the tilt is on this face's side of it. On a smooth
    floor, energies that cannot lift the coin are left out: in vacuum the energies of the conserved v_h and
    L_z, in linear air most of the energy of v_h, and for a balanced coin the energy of its spin. A thick coin
    is caught on its edge below the passes on both sides. docs/ENDINGS.md has the proofs.

    On a slope energy and spin are bounded only on a smooth floor in vacuum: see `slope_feeds`.

    The smooth law, `coulomb` with energetic restitution, and a law of one's own that is checked for it never
    add energy. For every other law the same test ends the toss as `Ending.PAPER`.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
        doubt: the part of its energy that the engine may have lost, see `wrongly_lost`.
    """
    smooth = is_smooth(rules.law)
    if slope_feeds(body, smooth):
        return Outcome.UNDECIDED, Ending.NONE
    v, w, up = state.velocity, state.spin, state.R[2]
    E, most, face = energy(body, state.position[2], v, w), 1 + doubt, face_outcome(state)
    ending = Ending.SETTLED if never_adds_energy(rules) else Ending.PAPER
    conserves = smooth and in_vacuum(body) and not resists(rules)
    # A balanced coin that loses nothing may roll on one rim for ever between the passes: see `edge_barrier`.
    idle = 0.0 if not smooth or (conserves and is_ideal(body)) else idle_energy(body, rules, v, w)
    lifting = most * (E - idle)
    on_face = _is_on_face(body, up)
    if lifting < barrier(body, up[2]):
        if on_face:
            return face, ending
        if lifting < barrier(body, -up[2]) and _beyond_the_pass(body, up):
            return Outcome.EDGE, ending
    if conserves:
        E_turning = most * (E - body.mass * (v[0] * v[0] + v[1] * v[1]) / 2)
        # On the other side of the pass a coin may be just upright, within rounding of the energy that it
        # needs.
        E_turning += 0.0 if on_face else WOBBLE * body.mass * body.gravity * body.radius
        if not E_turning > spin_barrier_bound(body, up, w) and E_turning < spin_barrier(body, up, w):
            return face, Ending.SETTLED
        if not on_face and is_ideal(body) and E_turning < edge_barrier(body, up, w):
            return Outcome.EDGE, Ending.SETTLED
    return Outcome.UNDECIDED, Ending.NONE


@compiled
def idle_energy(body: Body, rules: Rules, v: Vector, w: Vector) -> float:
    """Return energy that a coin in air on a smooth floor never turns into height [J].

    In linear air it is (1 - a) m v_h²/2, with a the `sliding_share`, 0 in vacuum, and for a balanced coin
    also J_ζ ω_ζ²/2: the coin's energy without these never grows. In other air no such energy is known. If the
    floor resists rolling or pivoting, its moment turns spin about ζ into other spin, and only the first term
    is returned.

    Args:
        body: the coin.
        rules: floor and ending.
        v: velocity of C, space frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
    """
    if not is_linear(body.air):
        return 0.0
    share = 0.0 if in_vacuum(body) else body.sliding_share
    idle = (1 - share) * body.mass * (v[0] * v[0] + v[1] * v[1]) / 2
    return idle + body.inertia[2][2] * w[2] * w[2] / 2 if is_ideal(body) and not resists(rules) else idle


@compiled
def _is_on_face(body: Body, up: Vector) -> bool:
    """Return whether the tilt is on the face's side of every pass to the other face or to the edge."""
    out, high = rim_offset(body, up[2])
    return tilt_sine_of(up) * high < out * abs(up[2])


@compiled
def _beyond_the_pass(body: Body, up: Vector) -> bool:
    """Return whether C is on the edge's side of the pass over the rim point that is lowest."""
    tilt_sine = tilt_sine_of(up)
    if tilt_sine == 0:
        return False
    c = body.center
    out = body.radius + (c[0] * up[0] + c[1] * up[1]) / tilt_sine
    high = rim_offset(body, up[2])[1]
    return tilt_sine * high > out * abs(up[2])


@compiled
def lies(body: Body, rules: Rules, state: State, left: float) -> bool:
    """Return whether the coin lies flat for good, however fast it slides and spins about its normal.

    Its tilt, its turning about diameters and its vertical motion are negligible. The floor can balance all
    moments that spin, drag and friction make about diameters by pressing inside the rim. Sliding and spinning
    never grow, so neither do these moments, except on a slope: see `moments_may_grow`.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
        left: the most energy of its tilting, against m g r: `WOBBLE` or `STILL`.
    """
    z, v, w, up = state.position[2], state.velocity, state.spin, state.R[2]
    c, J = body.center, body.inertia
    flat_z = rim_offset(body, up[2])[1]
    across = (w[0], w[1], 0.0)
    wobble = (
        body.mass * (v[2] * v[2] / 2 + body.gravity * abs(z - flat_z)) + dot(across, apply(J, across)) / 2
    )
    weight = body.mass * body.gravity
    # A coin as thick as wide is as high upright as flat.
    if wobble > left * weight * body.radius or not _is_on_face(body, up):
        return False
    # On a face, laws without the floor's friction do not act on the slip; resistance to pivoting acts on the
    # spin.
    mu = rules.friction if uses_friction(rules.law) else 0.0
    feeds = slope_feeds(body, is_smooth(rules.law))
    if not is_followed(rules.law) or (feeds and moments_may_grow(body, mu)):
        return False
    k, arm, turn_drag = drag_bound(body, v, w, 0.0)
    drag = k * (norm(v) + arm * norm(w))
    rubbing = mu * weight * body.radius + rules.pivoting_friction * weight
    slowing = (rubbing + turn_drag * abs(w[2]) + drag * arm) / J[2][2]
    moment = math.hypot(J[0][2], J[1][2]) * (w[2] * w[2] + slowing)
    held = body.mass * body.downhill if is_rough(rules.law) else mu * weight
    moment += held * flat_z + drag * arm
    return moment < weight * (body.radius - math.hypot(c[0], c[1]))


@compiled
def moments_may_grow(body: Body, mu: float) -> bool:
    """Return whether a slope may make the moments grow that tilt a coin which slides and spins on a face.

    Of a balanced coin they depend on neither motion. Of any coin the energy of both motions never grows where
    tan(slope) (1 + 3 |c|/(2 r)) <= μ: the slope gives at most m g_x (v + |c| Ω), v the speed of B and Ω the
    rate of the spin, and friction takes μ N times the mean slip of the face, at least v and at least 2/3 r Ω.

    Args:
        body: the coin.
        mu: friction μ that acts on a face.
    """
    return (
        not is_ideal(body)
        and body.downhill * (1 + 3 * norm(body.center) / (2 * body.radius)) > mu * body.gravity
    )
