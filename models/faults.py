"""What is wrong with a scenario whose numbers are each within their bounds, but do not go together."""

import math
from enum import IntEnum
from typing import NamedTuple

from cointoss.models.attitude import Quaternion, norm_of
from cointoss.models.barriers import highest_on_floor
from cointoss.models.body import Body, Rules, resists
from cointoss.models.clearance import damping_rate
from cointoss.models.contact_laws.table import is_followed, laws_that, may_be_energetic, quoted
from cointoss.models.geometry import gap
from cointoss.models.inertia import is_positive_definite, obeys_triangle_inequality, principal_moments
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, norm
from cointoss.models.laws import ContactLaw, RestitutionKind
from cointoss.models.making import Cylinder
from cointoss.models.state import State

FASTEST_SPIN, FASTEST_DRAG = 1e5, 1e4
"""Rates against √(g/r) beyond all tosses, which would take hours to follow."""
NORM_ERROR = 1e-3
"""The largest error of the norm of a release's Euler parameters."""
_SYMMETRY, _LEAST_MOMENT, _LARGEST_MOMENT = 1e-12, 1e-6, 1e6
_BELOW = 1e-12  # of the radius: rounding


class Fault(IntEnum):
    """A condition that is not met."""

    NONE = 0
    CENTER_BESIDE = 1
    CENTER_ABOVE = 2
    NOT_SYMMETRIC = 3
    NOT_POSITIVE = 4
    NO_TRIANGLE = 5
    MOMENTS = 6
    CENTER_TOO_FAR = 7
    CENTER_NO_TRIANGLE = 8
    KIND = 9
    ROLLING_LAW = 10
    PIVOTING_LAW = 11
    NORM = 12
    NOT_FINITE = 13
    BELOW_FLOOR = 14
    SPIN = 15
    DRAG = 16
    ROLLING = 17
    PIVOTING = 18
    CAUGHT = 19
    ROW = 20
    CONTOUR_LAW = 21
    CONTOUR = 22
    CONTOUR_VISCOSITY_LAW = 23


_RESISTANCE_LAW = (
    '0 with contact = "{contact}", which is not followed into sustained contact; '
    f"a length with {quoted(laws_that(lambda law: law.is_followed))}"
)
_RESISTANCES = (
    "lengths with sqrt((rolling_friction + contour_friction)^2 + pivoting_friction^2) "
    "< 2 sqrt(J/m) = {limit:.6g} m, "
    "J the least moment of inertia: beyond, the floor's force has no solution"
)
ACCEPTED = {
    Fault.CENTER_BESIDE: (
        "coin.center_of_mass",
        "a point inside the coin: sqrt(xi^2 + eta^2) < radius = {limit} m",
    ),
    Fault.CENTER_ABOVE: ("coin.center_of_mass", "a point inside the coin: |zeta| <= thickness/2 = {limit} m"),
    Fault.NOT_SYMMETRIC: ("coin.inertia", "a symmetric 3 by 3 matrix"),
    Fault.NOT_POSITIVE: ("coin.inertia", "a positive definite matrix: every principal moment > 0"),
    Fault.NO_TRIANGLE: (
        "coin.inertia",
        "a body's inertia: no principal moment above the sum of the other two",
    ),
    Fault.MOMENTS: ("coin.inertia", "principal moments from 1e-6 to 1e6 m r^2 = {limit:.3g} kg m^2"),
    Fault.CENTER_TOO_FAR: (
        "coin.center_of_mass",
        "a center of mass that leaves a positive definite inertia about it, "
        "such as sqrt(xi^2 + eta^2) < radius/2 = {limit} m, or give coin.inertia",
    ),
    Fault.CENTER_NO_TRIANGLE: (
        "coin.center_of_mass",
        "a center of mass that leaves an inertia about it with no principal moment above the sum of "
        "the other two, so one nearer to (0, 0, 0), or give coin.inertia",
    ),
    Fault.KIND: (
        "floor.restitution_kind",
        '"kinematic" with contact = "{contact}"; "energetic" only with '
        + quoted(laws_that(lambda law: law.may_be_energetic)),
    ),
    Fault.ROLLING_LAW: ("floor.rolling_friction", _RESISTANCE_LAW),
    Fault.PIVOTING_LAW: ("floor.pivoting_friction", _RESISTANCE_LAW),
    Fault.CONTOUR_LAW: ("floor.contour_friction", _RESISTANCE_LAW),
    Fault.CONTOUR_VISCOSITY_LAW: ("floor.contour_viscosity", _RESISTANCE_LAW.replace("a length", "more")),
    Fault.NORM: (
        "release.quaternion",
        "four numbers of norm 1 within 1e-3 (the norm here is {limit:.6g})",
    ),
    Fault.NOT_FINITE: ("coin", "a coin whose inertia, its inverse and drag are finite numbers"),
    Fault.BELOW_FLOOR: ("release.position.z", "a coin above the floor: z >= {limit:.6g} m"),
    Fault.SPIN: (
        "release.angular_velocity",
        f"a spin of at most {FASTEST_SPIN:g} sqrt(g/r) = {{limit:.3g}} rad/s",
    ),
    Fault.DRAG: ("air", f"air that slows the coin at a rate of at most {FASTEST_DRAG:g} sqrt(g/r)"),
    Fault.ROLLING: ("floor.rolling_friction", _RESISTANCES),
    Fault.PIVOTING: ("floor.pivoting_friction", _RESISTANCES),
    Fault.CONTOUR: ("floor.contour_friction", _RESISTANCES),
    Fault.ROW: ("row", "a finite number at place {limit:g}; NaN stands for a field that may be left out"),
    Fault.CAUGHT: ("ending.caught", "more than {limit:.6g} m, so that the coin is caught in flight"),
}
"""The field that each fault names, and what is accepted there: `limit` is a number, `contact` the law."""


class FoundFault(NamedTuple):
    """A fault, or `Fault.NONE`."""

    fault: Fault
    limit: float
    """The number in its sentence of `ACCEPTED`."""


_NOTHING = FoundFault(Fault.NONE, 0.0)


@compiled
def fault_of_center(cylinder: Cylinder, center: Vector) -> FoundFault:
    """Return what is wrong with the place of C, from B, body frame [m]."""
    if not math.hypot(center[0], center[1]) < cylinder.radius:
        return FoundFault(Fault.CENTER_BESIDE, cylinder.radius)
    if not abs(center[2]) <= cylinder.thickness / 2:
        return FoundFault(Fault.CENTER_ABOVE, cylinder.thickness / 2)
    return _NOTHING


@compiled
def fault_of_inertia(cylinder: Cylinder, J: Matrix, is_given: bool) -> FoundFault:
    """Return what is wrong with an inertia about C, body frame [kg m²].

    Args:
        cylinder: mass and size.
        J: the inertia.
        is_given: by the scenario; else it is the cylinder's, moved to C.
    """
    if not is_given:
        if not is_positive_definite(J):
            return FoundFault(Fault.CENTER_TOO_FAR, cylinder.radius / 2)
        return _NOTHING if obeys_triangle_inequality(J) else FoundFault(Fault.CENTER_NO_TRIANGLE, 0.0)
    largest = 0.0
    for row in J:
        largest = max(largest, abs(row[0]), abs(row[1]), abs(row[2]))
    apart = max(abs(J[0][1] - J[1][0]), abs(J[0][2] - J[2][0]), abs(J[1][2] - J[2][1]))
    if not apart <= _SYMMETRY * largest:
        return FoundFault(Fault.NOT_SYMMETRIC, 0.0)
    if not is_positive_definite(J):
        return FoundFault(Fault.NOT_POSITIVE, 0.0)
    if not obeys_triangle_inequality(J):
        return FoundFault(Fault.NO_TRIANGLE, 0.0)
    unit, (low, _, high) = cylinder.mass * cylinder.radius * cylinder.radius, principal_moments(J)
    if not (low / unit >= _LEAST_MOMENT and high / unit <= _LARGEST_MOMENT):
        return FoundFault(Fault.MOMENTS, unit)
    return _NOTHING


@compiled
def fault_of_coin(cylinder: Cylinder, center: Vector, J: Matrix, is_given: bool) -> FoundFault:
    """Return what is wrong with a coin, whose inertia the scenario may have given; see the two above."""
    found = fault_of_center(cylinder, center)
    return fault_of_inertia(cylinder, J, is_given) if found.fault == Fault.NONE else found


@compiled
def fault_of_floor(
    law: ContactLaw, kind: RestitutionKind, rolling: float, pivoting: float, contour: float, viscous: float
) -> FoundFault:
    """Return what is wrong with a floor's kind of restitution and its resistances."""
    if kind == RestitutionKind.ENERGETIC and not may_be_energetic(law):
        return FoundFault(Fault.KIND, 0.0)
    for resistance, fault in (
        (rolling, Fault.ROLLING_LAW),
        (pivoting, Fault.PIVOTING_LAW),
        (contour, Fault.CONTOUR_LAW),
        (viscous, Fault.CONTOUR_VISCOSITY_LAW),
    ):
        if resistance > 0 and not is_followed(law):
            return FoundFault(fault, 0.0)
    return _NOTHING


@compiled
def fault_of_quaternion(e: Quaternion) -> FoundFault:
    """Return what is wrong with the Euler parameters of a release."""
    size = norm_of(e)
    return _NOTHING if abs(size - 1) <= NORM_ERROR else FoundFault(Fault.NORM, size)


@compiled
def fault_of_release(body: Body, state: State) -> FoundFault:
    """Return what is wrong with a release: the coin in the floor, or too fast to follow.

    Args:
        body: the coin.
        state: at the release.
    """
    z, w = state.position[2], state.spin
    clearance = gap(body, z, state.R[2])
    if clearance < -_BELOW * body.radius:
        return FoundFault(Fault.BELOW_FLOOR, z - clearance)
    rate = (body.gravity / body.radius) ** 0.5
    if not norm(w) <= FASTEST_SPIN * rate:
        return FoundFault(Fault.SPIN, FASTEST_SPIN * rate)
    fall = (2 * max(z, 0.0) / body.gravity) ** 0.5
    if not damping_rate(body, state.velocity, w, fall) <= FASTEST_DRAG * rate:
        return FoundFault(Fault.DRAG, 0.0)
    return _NOTHING


@compiled
def fault_of_toss(body: Body, rules: Rules, state: State) -> FoundFault:
    """Return what is wrong with a coin, its floor and its release together.

    Args:
        body: the coin.
        rules: floor and ending.
        state: at the release.
    """
    if not is_finite(body):
        return FoundFault(Fault.NOT_FINITE, 0.0)
    found = fault_of_release(body, state)
    if found.fault != Fault.NONE:
        return found
    rolling, pivoting, contour = rules.rolling_friction, rules.pivoting_friction, rules.contour_friction
    # Up to there K + q ẑᵀ is positive definite: see analytic/contact/resistance.py.
    most = 2 * (body.inertia_smallest / body.mass) ** 0.5
    if resists(rules) and not math.hypot(rolling + contour, pivoting) < most:
        if contour > max(rolling, pivoting):
            return FoundFault(Fault.CONTOUR, most)
        return FoundFault(Fault.ROLLING if rolling >= pivoting else Fault.PIVOTING, most)
    reach = highest_on_floor(body)
    return _NOTHING if rules.caught > reach else FoundFault(Fault.CAUGHT, reach)


@compiled
def is_finite(body: Body) -> bool:
    """Return whether inertia, its inverse and drag of a coin are finite numbers."""
    total = body.inertia_smallest + body.inertia_largest + body.sliding_share
    for row in body.inertia + body.inertia_inverse:
        total += abs(row[0]) + abs(row[1]) + abs(row[2])
    for coefficient in body.drag:
        total += abs(coefficient)
    return abs(total) < math.inf
