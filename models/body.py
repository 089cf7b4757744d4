"""A scenario's coin, air and floor as plain numbers for compiled code."""

import math
from collections.abc import Callable
from typing import Annotated, Any, NamedTuple

from cointoss.models.contact_laws.table import never_adds
from cointoss.models.drag import Drag
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector
from cointoss.models.laws import ContactLaw, EndingTest, RestitutionKind


class AirLaw(NamedTuple):
    """The air's resistance: the force on dA is -λ |v|^b v; see `cointoss.models.scenario.Air`."""

    exponent: float | None
    """b, from 0 to 1; None or 0 for linear air and for vacuum. To numba None is a type of its own, so the
    analytic engine compiles linear air apart from the quadrature for b > 0, which would prevent inlining and
    slow every toss. MuJoCo's coin has 0 instead, and is compiled once for all air."""
    normal: float
    """λ_n [kg m^(-2-b) s^(b-1)]."""
    tangential: float
    """λ_τ [kg m^(-2-b) s^(b-1)]."""


class Body(NamedTuple):
    """The numbers of a scenario that the equations of motion and of impact need; SI units, body frame."""

    mass: float
    radius: float
    thickness: float
    center: Vector
    """C from B [m]."""
    inertia: Matrix
    """J_C, about the mass centre [kg m²]."""
    inertia_inverse: Matrix
    inertia_smallest: float
    inertia_largest: float
    air: AirLaw
    drag: Drag
    """The coefficients of linear air; used if `is_linear`."""
    sliding_share: float
    """The share `cointoss.models.drag.sliding_share`; used if `drag` is."""
    gravity: float
    """The part of g along the floor's normal, downwards [m/s²]."""
    downhill: float
    """The part of g along x, 0 on a level floor [m/s²]."""


class OwnCode(NamedTuple):
    """A contact law of one's own, as compiled code calls it."""

    address: int
    """The address of the law's machine code, see `cointoss.models.kernel.address`; 0 for no such law."""
    may_add_energy: bool
    may_pull: bool
    """Whether S_z may be negative."""
    tolerance: float
    """The largest error of the law's impulses, relative to |S|, |K S| and |S| |v_A|."""


EXACT = 1e-10
"""The tolerance of a law that errs only by rounding; solving K S = v_A' - v_A has a smaller error."""
NO_CODE = OwnCode(0, False, False, EXACT)


class Rules(NamedTuple):
    """How a scenario's coin meets the floor and when its toss ends; in compiled code words are integers."""

    law: Annotated[ContactLaw, int]
    """The contact law; `SHARP_EDGE`, which no sustained contact follows, stands for a law of one's own."""
    own: OwnCode
    restitution: float
    restitution_threshold: float
    restitution_speed: float
    restitution_exponent: float
    restitution_viscous: float
    restitution_kind: Annotated[RestitutionKind, int]
    friction: float
    rolling_friction: float
    pivoting_friction: float
    contour_friction: float
    contour_viscosity: float
    viscosity: float
    """η of the air in the gap under a nearly flat coin [Pa s]."""
    test: Annotated[EndingTest, int]
    max_impacts: int
    max_time: float
    caught: float
    """Height of the catch, at which the toss ends when C comes down to it; infinite without a catch."""


def _replacing(name: str) -> Callable[[Rules, Any], Rules]:
    """Return a compiled function that gives the rules with another value of a field."""
    place = Rules._fields.index(name)
    after = place + 1

    @compiled
    def replaced(rules: Rules, value: Any) -> Rules:
        return Rules(*rules[:place], value, *rules[after:])  # pyright: ignore[reportCallIssue]

    return replaced


_with_max_impacts, _with_max_time = _replacing("max_impacts"), _replacing("max_time")
_with_restitution, _with_friction = _replacing("restitution"), _replacing("friction")
_with_caught, _with_law, _with_own = _replacing("caught"), _replacing("law"), _replacing("own")


@compiled
def with_budgets(rules: Rules, max_impacts: int, max_time: float) -> Rules:
    """Return the rules with other budgets."""
    return _with_max_time(_with_max_impacts(rules, max_impacts), max_time)


@compiled
def with_time_alone(rules: Rules, max_time: float) -> Rules:
    """Return the rules with another time limit [s], and without a hand."""
    return _with_caught(_with_max_time(rules, max_time), math.inf)


@compiled
def with_own_law(rules: Rules, own: OwnCode) -> Rules:
    """Return the rules with a contact law of one's own, which is not followed into sustained contact.

    With `NO_CODE` they stay what they are.
    """
    return rules if own.address == 0 else _with_law(_with_own(rules, own), ContactLaw.SHARP_EDGE.value)


@compiled
def with_floor(rules: Rules, chi: float, mu: float) -> Rules:
    """Return the same rules with another restitution χ and friction μ."""
    return _with_friction(_with_restitution(rules, chi), mu)


@compiled
def never_adds_energy(rules: Rules) -> bool:
    """Return whether no impact adds energy: proved, or for an exact law of one's own checked each time."""
    if rules.own.address != 0:
        return not rules.own.may_add_energy and rules.own.tolerance <= EXACT
    return never_adds(rules.law) or rules.restitution_kind == RestitutionKind.ENERGETIC


@compiled
def resists(rules: Rules) -> bool:
    """Return whether floor or air resist rolling, pivoting or the run of the contact point round the rim."""
    by_floor = rules.rolling_friction > 0 or rules.pivoting_friction > 0 or rules.contour_friction > 0
    return by_floor or rules.contour_viscosity > 0 or rules.viscosity > 0


@compiled
def whole_gravity(body: Body) -> float:
    """Return g, from its two components [m/s²]."""
    return body.gravity if body.downhill == 0 else math.hypot(body.gravity, body.downhill)


@compiled
def slope_feeds(body: Body, smooth: bool) -> bool:
    """Return whether a slope may give energy to the motion that turns the coin over.

    On a smooth floor in vacuum only the slope acts along the floor. There C accelerates steadily downhill,
    and all other motion is as on a level floor with the normal part of gravity.

    Args:
        body: the coin.
        smooth: whether the floor acts on it by vertical forces alone.
    """
    return body.downhill > 0 and not (smooth and in_vacuum(body))


@compiled
def friction_can_hold(body: Body, mu: float) -> bool:
    """Return whether friction μ can hold a coin at rest on the floor, which may slope: tan(slope) <= μ."""
    return body.downhill <= mu * body.gravity


@compiled
def is_to_be_caught(rules: Rules) -> bool:
    """Return whether a hand catches the coin."""
    return rules.caught < math.inf


@compiled
def is_ideal(body: Body) -> bool:
    """Return whether the coin is balanced, with the inertia of a symmetric top about its normal."""
    c, J = body.center, body.inertia
    balanced = c[0] == 0 and c[1] == 0 and c[2] == 0
    return balanced and J[0][0] == J[1][1] and J[0][1] == 0 and J[0][2] == 0 and J[1][2] == 0


@compiled
def is_linear(air: AirLaw) -> bool:
    """Return whether the air's force is linear in the velocity, or zero."""
    return air.exponent is None or air.exponent == 0


@compiled
def in_vacuum(body: Body) -> bool:
    """Return whether there is no air."""
    return body.air.normal == 0 and body.air.tangential == 0
