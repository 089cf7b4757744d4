"""The certificate of a toss: the residuals of its impacts, and the energy of its flights and contacts.

Both engines measure by the same functions, from the record and the path alone; these functions integrate no
motion. In sustained contacts they measure the gap and the energy gained, which is zero on a passive floor,
but not the work of friction; what each landing of a second rim takes, against the closed form; and on a
smooth floor in vacuum the momenta that it keeps.
"""

from collections.abc import Callable, Iterator
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body, Rules, in_vacuum, is_ideal, resists
from cointoss.models.contact_laws.law import Impact, Recorded, dot_each
from cointoss.models.contact_laws.table import LAWS, is_smooth
from cointoss.models.geometry import lowest_point
from cointoss.models.kernel.vectors import Matrix, Vector, cross, norm
from cointoss.models.laws import RestitutionKind
from cointoss.models.records import Array, Flag, Impacts, Path, Setting, States, raised_flags
from cointoss.models.restitution import restitution_at_speed, varies
from cointoss.models.scenario import Scenario

LAW = "impacts: largest residual of the contact law, relative"
MOMENTUM = "impacts: largest residual of linear and angular momentum, relative"
IMPACT_ENERGY = "impacts: largest difference of energy change and work"
GAIN = "impacts: largest gain of energy"
FLIGHT_ENERGY = "flights: largest difference of energy change and work of the air"
CONTACT_ENERGY = "sustained contacts: largest gain of energy"
KEPT = "sustained contacts: largest change of momenta that the floor keeps, since the release"
LANDINGS = "landings of a second rim"
LANDING = "landings of a second rim: largest error of what one takes, relative"
NORM = "largest deviation of the norm of the Euler parameters from 1"
GAP = "smallest gap, at impacts, sampled in flight and in sustained contacts"
OF_ENERGY = (IMPACT_ENERGY, FLIGHT_ENERGY, CONTACT_ENERGY)
NAMES = (LAW, MOMENTUM, *OF_ENERGY, GAIN, NORM, GAP, KEPT, LANDINGS, LANDING)
"""The names of the measured lines of a certificate."""
FLIGHTS = 10
"""The number of flights that are sampled, the longest ones. In vacuum their energy needs no samples."""
LANDINGS_MEASURED = 100
"""The number of landings that are measured, spread evenly over all; one with friction takes 1 ms."""
NONE_TAKEN = 1e-9
"""A landing that changes (v, ω) by less than this part of it takes nothing but rounding."""
STANDS = 1e-9
"""A coin stands on both rims if n_z changes no faster than this part of |ω|."""
VACUUM_SAMPLES = 4
"""Samples of a flight in vacuum; in air, where they are also the nodes of a quadrature, there are
`AIR_SAMPLES` and two more for each radian of turn, at most `MOST_SAMPLES`. The energy of a flight that would
need more samples, because it turns often or drag slows it many times over, is not measured."""
AIR_SAMPLES = 20
MOST_SAMPLES = 200

Air = Callable[[Body, Vector, Vector], tuple[Vector, Vector]]
"""An engine's own force of the air and its moment about C, from v_C and ω, all in the body frame."""


class Changes(NamedTuple):
    """States before and after each of n changes."""

    before: States
    after: States


class InContact(NamedTuple):
    """An engine's measurements of the sustained contacts of a toss."""

    stretches: Changes
    """At start and end of stretches of sustained contact."""
    landings: Changes
    """Before and after landings of a second rim that the floor stops, each at one place."""
    gaps: Array
    """The gaps in sustained contact, see `gaps`, (k,) [m]."""


def measurements(
    scenario: Scenario,
    impacts: Impacts,
    contacts: Array,
    in_contact: InContact,
    path: Path,
    air: Air,
    residuals: Array | None = None,
) -> tuple[Setting, ...]:
    """Return the measured lines of a toss's certificate, without lines for events that did not occur.

    Args:
        scenario: the scenario of the toss.
        impacts: the impacts of the toss.
        contacts: start and end of every sustained contact, (n, 2) [s].
        in_contact: states and gaps in the contacts.
        path: the path of the toss.
        air: the engine's force of the air, which is measured if b > 0.
        residuals: of a contact law of one's own, (n,), in place of the residuals by the scenario's law.
    """
    body = scenario.body
    if residuals is None:
        residuals = law_residuals(body, scenario.rules, impacts)
    weight = body.mass * body.gravity * body.radius
    lines, lowest = [], in_contact.gaps.min(initial=np.inf)
    if len(impacts):
        states, drift = _flights(scenario, impacts, contacts, path, air)
        touches = States(
            time=impacts.time,
            position=impacts.position,
            velocity=impacts.velocity_before,
            quaternion=impacts.quaternion,
            angular_velocity=impacts.angular_velocity_before,
        )
        norms = [np.linalg.norm(each.quaternion, axis=1) - 1 for each in (states, touches)]
        lowest = min(lowest, *(gaps(body, each).min(initial=np.inf) for each in (states, touches)))
        of_flights = Setting(name=FLIGHT_ENERGY, value=_largest(drift) / weight, unit="m g r")
        gained = impacts.energy_change[raised_flags(impacts, 0.0)[Flag.GAINS_ENERGY]]
        lines += [
            Setting(name=LAW, value=_largest(residuals)),
            Setting(name=MOMENTUM, value=_largest(momentum_residuals(body, impacts))),
            Setting(name=IMPACT_ENERGY, value=_largest(energy_residuals(impacts)) / weight, unit="m g r"),
            *([Setting(name=GAIN, value=_largest(gained) / weight, unit="m g r")] if len(gained) else []),
            *([of_flights] if len(drift) else []),
            Setting(name=NORM, value=_largest(np.concatenate(norms))),
        ]
    if lowest < np.inf:
        lines.append(Setting(name=GAP, value=float(lowest) / body.radius, unit="r"))
    return (*lines, *_of_contacts(scenario, in_contact))


def _of_contacts(scenario: Scenario, in_contact: InContact) -> Iterator[Setting]:
    """Yield the measured lines of sustained contacts, see `measurements`."""
    body, rules, (stretches, landings, _) = scenario.body, scenario.rules, in_contact
    if len(stretches.before.time):
        # Energy with that along a slope, which only the air and the floor's friction change.
        start, end = (
            energies(body, states) - body.mass * body.downhill * states.position[:, 0] for states in stretches
        )
        gained = float((end - start).max()) / (body.mass * body.gravity * body.radius)
        yield Setting(name=CONTACT_ENERGY, value=max(gained, 0.0), unit="m g r")
        if is_smooth(rules.law) and in_vacuum(body) and body.downhill == 0 and not resists(rules):
            yield Setting(
                name=KEPT,
                value=_largest(momenta(body, stretches.after) - momenta(body, _at_release(scenario))),
                unit="m r √(g r)",
            )
    if count := len(landings.before.time):
        yield Setting(name=LANDINGS, value=count)
        yield Setting(name=LANDING, value=_largest(landing_residuals(body, rules, landings)))


def momenta(body: Body, states: States) -> Array:
    """Return what a smooth level floor keeps without air, (n, 4): r m v_x, r m v_y, L_z, and L_ζ if balanced.

    In units of m r √(g r); L_ζ of an unbalanced coin is 0.
    """
    L = states.angular_velocity @ np.array(body.inertia) / (body.mass * body.radius)
    up = turned(_conjugate(states.quaternion), np.broadcast_to([0.0, 0.0, 1.0], L.shape))
    kept = np.column_stack([states.velocity[:, :2], dot_each(up, L), L[:, 2] * is_ideal(body)])
    return kept / (body.gravity * body.radius) ** 0.5


def landing_residuals(body: Body, rules: Rules, landings: Changes) -> Array:
    """Return by how much what a landing takes differs from its closed form, `taken_by_landing`, (k,).

    Relative to the larger of the two changes of (v, ω), or to `NONE_TAKEN` of (v, ω), in the norm of the
    kinetic energy.

    Args:
        body: the coin.
        rules: its floor.
        landings: n of a second rim, of which k are measured, at most `LANDINGS_MEASURED`.
    """
    mass, residuals = _mass(body), []
    before, after = (np.hstack([states.velocity, states.angular_velocity]) for states in landings)
    for i in np.unique(np.linspace(0, len(before) - 1, LANDINGS_MEASURED).astype(int)):
        R, R_after = (rotation_matrix(tuple(states.quaternion[i])) for states in landings)
        stands = abs(cross(R_after[2], tuple(after[i, 3:]))[2]) < STANDS * norm(tuple(after[i, 3:]))
        taken, found = taken_by_landing(body, rules, R, before[i], stands), after[i] - before[i]
        sized = found - taken, found, taken, NONE_TAKEN * before[i]
        missed, *sizes = ((change @ mass @ change) ** 0.5 for change in sized)
        residuals.append(missed / max(sizes) if missed > 0 else 0.0)
    return np.array(residuals)


def taken_by_landing(body: Body, rules: Rules, R: Matrix, u: Array, stands: bool) -> Array:
    """Return the change of (v, ω) by the landing of a second rim, a plastic impact, (6,) [m/s, rad/s].

    The impulse S of the floor's law acts at the lowest point A of the rim that comes down, v_Az' = 0; nothing
    holds the point of the other rim. So on a smooth floor S_z = -v_Az/K_zz, and it takes the energy
    v_Az²/(2 K_zz); on its edge an ideal coin keeps L_z and the part (J_ξ/m - h²/4)/(J_ξ/m + h²/4) of the rate
    of n_z. If the coin then stands, vertical impulses at both rims stop both points.

    Args:
        body: the coin.
        rules: its floor.
        R: rotation matrix, body to space.
        u: v of C, space frame, and ω, body frame, before it, (6,) [m/s, rad/s].
        stands: whether the coin stands on both rims after it.
    """
    up, w, by_mass = R[2], tuple(u[3:]), np.linalg.inv(_mass(body))
    # The rim that comes down is the lower one as soon as n_z has the sign of its rate.
    (x, y, z), _ = lowest_point(body, (up[0], up[1], cross(up, w)[2]), w)
    # v_A = G u: a row of G has a unit impulse along x, y or z, and its moment in the body frame.
    G = np.hstack([np.eye(3), np.cross(np.subtract((x, y, z), body.center), R)])
    tau, K = R @ np.array([-y, x, 0.0]) / body.radius, (G @ by_mass @ G.T).tolist()
    A = Impact(K, tuple(G @ u), tuple(tau), 0.0, rules.friction, rules.restitution_kind)
    taken = by_mass @ G.T @ LAWS[rules.law].impulse(A)[0]
    if stands:
        held = np.vstack([G[2], [0, 0, 1, *np.cross(np.subtract((x, y, -z), body.center), up)]])
        taken -= by_mass @ held.T @ np.linalg.solve(held @ by_mass @ held.T, held @ (u + taken))
    return taken


def _mass(body: Body) -> Array:
    """Return the mass matrix of (v, ω), (6, 6)."""
    none = np.zeros((3, 3))
    return np.block([[body.mass * np.eye(3), none], [none, np.array(body.inertia)]])


def law_residuals(body: Body, rules: Rules, impacts: Impacts) -> Array:
    """Return how far each impact violates its contact law, (n,).

    Velocities relative to |v_A| before the impact, impulses relative to |S|. Newton's v_Az' = -χ v_Az, χ by
    the speed of approach, or with energetic restitution that no energy is gained, and the law's own
    constraint, see its record. A flat landing's impulse is vertical.

    Args:
        body: the coin.
        rules: its floor.
        impacts: of it.
    """
    before, after, S = impacts.contact_velocity_before, impacts.contact_velocity_after, impacts.impulse
    out = np.hypot(impacts.point[:, 0], impacts.point[:, 1])
    edge = np.stack([-impacts.point[:, 1], impacts.point[:, 0], 0 * out], axis=1)
    tau = turned(impacts.quaternion, edge / np.where(out > 0, out, 1)[:, None])
    nu = np.stack([-tau[:, 1], tau[:, 0], 0 * out], axis=1)
    recorded = Recorded(before, after, S, tau, nu, rules.friction)
    speed, size = np.linalg.norm(before, axis=1), recorded.size
    own = np.where(_lands_flat(body, impacts), recorded.horizontal / size, LAWS[rules.law].missed(recorded))
    if rules.restitution_kind == RestitutionKind.ENERGETIC:
        return np.maximum(own, np.maximum(impacts.energy_change, 0) / (size * speed))
    return np.maximum(own, np.abs(after[:, 2] + _restitution(rules, impacts) * before[:, 2]) / speed)


def restitution_residuals(rules: Rules, impacts: Impacts) -> Array:
    """Return how far the normal velocity of the contact point violates Newton's law, (n,).

    Relative to the change (1 + χ)|v_Az| that the law asks for: on a smooth floor that is the relative error
    of an impulse that acts at the contact point. `law_residuals` takes it relative to |v_A|, which fast slip
    makes large.

    Args:
        rules: the floor.
        impacts: on it.
    """
    before, chi = impacts.contact_velocity_before[:, 2], _restitution(rules, impacts)
    return np.abs(impacts.contact_velocity_after[:, 2] + chi * before) / ((1 + chi) * np.abs(before))


def momentum_residuals(body: Body, impacts: Impacts) -> Array:
    """Return by how much m Δv = S and J_C Δω = Rᵀ (a × S) fail, relative to |S| and r |S|, (n,).

    The impulse of a flat landing goes through C: a = 0.
    """
    S, e = impacts.impulse, impacts.quaternion
    size = np.linalg.norm(S, axis=1)
    arm = np.where(_lands_flat(body, impacts)[:, None], 0.0, impacts.point - np.array(body.center))
    linear = body.mass * (impacts.velocity_after - impacts.velocity_before) - S
    gained = (impacts.angular_velocity_after - impacts.angular_velocity_before) @ np.array(body.inertia)
    angular = gained - np.cross(arm, turned(_conjugate(e), S))
    return np.maximum(
        np.linalg.norm(linear, axis=1) / size,
        np.linalg.norm(angular, axis=1) / (size * body.radius),
    )


def energy_residuals(impacts: Impacts) -> Array:
    """Return the energy change of each impact less the work of its impulse, S . (v_A + v_A')/2, (n,) [J]."""
    mean = (impacts.contact_velocity_before + impacts.contact_velocity_after) / 2
    return impacts.energy_change - dot_each(impacts.impulse, mean)


def gaps(body: Body, states: States) -> Array:
    """Return the height of the lowest point at each of the states, (n,) [m]."""
    up = turned(_conjugate(states.quaternion), np.broadcast_to([0.0, 0.0, 1.0], states.position.shape))
    on_normal = body.thickness / 2 * np.abs(up[:, 2]) + up @ np.array(body.center)
    return states.position[:, 2] - on_normal - body.radius * np.hypot(up[:, 0], up[:, 1])


def energies(body: Body, states: States) -> Array:
    """Return the mechanical energy of each state, with height measured from the floor only, (n,) [J]."""
    v, w = states.velocity, states.angular_velocity
    turning = dot_each(w, w @ np.array(body.inertia))
    return body.mass * (dot_each(v, v) / 2 + body.gravity * states.position[:, 2]) + turning / 2


def air_power(body: Body, v: Array, w: Array, air: Air) -> Array:
    """Return the power of the air, (n,) [W]: for b = 0 by the coefficients of `cointoss.models.drag`.

    Args:
        body: the coin.
        v: velocity of C, body frame, (n, 3) [m/s].
        w: angular velocity, body frame, (n, 3) [rad/s].
        air: for b > 0.
    """
    if body.air.exponent is None:
        drag, v_B = body.drag, v - np.cross(w, np.array([body.center]))
        force = [drag.force_tangential, drag.force_tangential, drag.force_normal]
        moment = [drag.moment_tangential, drag.moment_tangential, drag.moment_normal]
        return -(v_B**2 @ force + w**2 @ moment)
    pairs = [(air(body, tuple(a), tuple(b)), a, b) for a, b in zip(v.tolist(), w.tolist(), strict=True)]
    return np.array([np.dot(f, a) + np.dot(m, b) for (f, m), a, b in pairs])


def turned(quaternions: Array, vectors: Array) -> Array:
    """Return vectors turned by Euler parameters, x -> R(e) x, (n, 3)."""
    axis, part = quaternions[:, 1:], quaternions[:, :1]
    across = 2 * np.cross(axis, vectors)
    return vectors + part * across + np.cross(axis, across)


def _flights(
    scenario: Scenario, impacts: Impacts, contacts: Array, path: Path, air: Air
) -> tuple[States, Array]:
    """Return samples of the longest flights, and energy changes of flights less the work of the air [J].

    A flight starts at the release or an impact and ends in an impact. Where b > 0 the power of the air is not
    smooth in time, and the quadrature of its work itself errs by some 1e-7 m g r.
    """
    body = scenario.body
    ends = impacts.time
    starts = np.concatenate([[0.0], ends[:-1]])
    first = energies(body, _at_release(scenario))
    change = impacts.energy - impacts.energy_change - np.concatenate([first, impacts.energy[:-1]])
    change -= (
        body.mass * body.downhill * np.diff(impacts.position[:, 0], prepend=scenario.release.position[0])
    )
    before = np.searchsorted(contacts[:, 0], [starts, ends], side="left")
    free = np.flatnonzero(before[0] == before[1])
    vacuum = in_vacuum(body)
    sampled = free[np.argsort(starts[free] - ends[free], kind="stable")[:FLIGHTS]]
    durations = (ends - starts)[sampled]
    spins = np.linalg.norm(impacts.angular_velocity_before[sampled], axis=1)
    needed = AIR_SAMPLES + (2 * spins * durations).astype(int)
    counts = np.full_like(needed, VACUUM_SAMPLES) if vacuum else np.minimum(needed, MOST_SAMPLES)
    # On [0, 1]: nodes of Gauss's rule, and their weights.
    rules = [(0.5 + x / 2, weights / 2) for x, weights in map(_gauss, counts)]
    times = [t + x * length for t, (x, _), length in zip(starts[sampled], rules, durations, strict=True)]
    states = path.sample(np.concatenate([np.empty(0), *times]))
    if vacuum:
        return states, change[free]
    v = turned(_conjugate(states.quaternion), states.velocity)
    power, w = air_power(body, v, states.angular_velocity, air), states.angular_velocity
    motion = body.mass * dot_each(v, v) + dot_each(w, w @ np.array(body.inertia))
    decay = np.divide(-power, motion, out=np.zeros_like(power), where=motion > 0)
    of_flight = np.repeat(np.arange(len(counts)), counts)
    turn = np.linalg.norm(w, axis=1) * durations[of_flight]
    enough = AIR_SAMPLES + 2 * np.maximum(turn, decay * durations[of_flight]) <= MOST_SAMPLES
    measured = np.bincount(of_flight, ~enough, len(counts)) == 0
    weights = np.concatenate([np.empty(0), *(of_rule for _, of_rule in rules)])
    work = np.bincount(of_flight, weights * power, len(counts)) * durations
    return states, (change[sampled] - work)[measured]


def _at_release(scenario: Scenario) -> States:
    release = scenario.release
    return States(
        time=np.zeros(1),
        position=np.array([release.position]),
        velocity=np.array([release.velocity]),
        quaternion=np.array([release.attitude]),
        angular_velocity=np.array([release.angular_velocity]),
    )


_gauss = cache(np.polynomial.legendre.leggauss)


def _lands_flat(body: Body, impacts: Impacts) -> NDArray[np.bool_]:
    """Return whether the coin touches with a face, without turning, and not with its rim, (n,)."""
    return np.hypot(impacts.point[:, 0], impacts.point[:, 1]) < body.radius * (1 - 1e-9)


def _restitution(rules: Rules, impacts: Impacts) -> Array:
    """Return χ of each impact by its speed of approach, (n,)."""
    speeds = -impacts.contact_velocity_before[:, 2]
    if varies(rules):
        return np.array([restitution_at_speed(rules, float(speed)) for speed in speeds])
    return np.where(speeds > rules.restitution_threshold, rules.restitution, 0.0)


def _conjugate(quaternions: Array) -> Array:
    return quaternions * [1.0, -1.0, -1.0, -1.0]


def _largest(values: Array) -> float:
    return float(np.abs(values).max(initial=0.0))
