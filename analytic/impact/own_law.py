"""A contact law of one's own: a function in plain Python that is compiled, and tried before it is used."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, fields
from functools import cache, partial
from importlib.util import find_spec
from inspect import Parameter, signature
from itertools import cycle, product
from types import FunctionType
from typing import Any, NamedTuple, TypeGuard

import numpy as np

from cointoss.analytic.impact.breach import Breach, breach_of
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.body import EXACT, Body, OwnCode, Rules
from cointoss.models.errors import require_type
from cointoss.models.geometry import lowest_point
from cointoss.models.kernel.address import Function, NotCompiledError, call_at, place
from cointoss.models.kernel.vectors import Matrix, Vector
from cointoss.models.laws import ContactLaw
from cointoss.models.making import MOST_LOSSLESS
from cointoss.models.parts import RESISTANCES, Coin, Floor, Release
from cointoss.models.records import Array, Impacts, UnsupportedError
from cointoss.models.restitution import largest_restitution, restitution_at_speed
from cointoss.models.scenario import Scenario, euler_parameters, vector

FORM = "a function (K, v_A, tau, chi, mu) -> (S_x, S_y, S_z) of plain arithmetic"
_DECORATE = " (decorate that function with @numba.njit)"
AGREES = 1e-9
"""The largest relative difference of the compiled law from its function, unless its tolerance is larger."""
COARSEST = 1e-3
"""The largest tolerance accepted."""
_ACCEPTED = {
    Breach.NOT_FINITE: "three finite numbers",
    Breach.SINKS: "an impulse after which A does not go into the floor, v_Az' >= 0",
    Breach.PULLS: "S_z >= 0, or may_pull=True",
    Breach.ADDS_ENERGY: "S . (v_A + K S/2) <= 0, or may_add_energy=True",
}


class LawArguments(NamedTuple):
    """The arguments of a contact law at an impact."""

    K: Matrix
    velocity: Vector
    """v_A before the impact [m/s]."""
    tau: Vector
    """The unit vector along the coin's edge at A; zero where the coin lands flat without turning."""
    chi: float
    mu: float


@dataclass(frozen=True)
class OwnLaw:
    """A contact law of one's own, for `toss` and `toss_many` of the analytic engine.

    A function in plain Python gives the impulse S of the floor on the coin at the contact point A, space
    frame, (3,) [N s]. Its arguments are K, the Delassus matrix of A, inverse effective mass, space frame, a
    tuple of three rows [1/kg], an impulse S changing v_A by K S; v_A, the velocity of A before the impact,
    space frame, a tuple of three numbers, the third negative [m/s]; tau, the unit vector along the coin's
    edge at A, horizontal, a tuple; chi, the restitution of this impact; mu, the scenario's friction.
    Where a coin lands flat without turning, S acts at C: K is 1/m times the identity, and tau is zero.

    The function is compiled by numba, with the sine and the logarithm of the system, and tried at impacts of
    many kinds. Whatever the coin, each impulse
    must be finite, must not drive A into the floor, and must neither add energy nor pull, unless that is
    asked for; else the toss ends there, as `no_solution`. What chatters ends as `chatter`: no such law is
    followed into sustained contact.

    Args:
        function: of those five arguments, S as a tuple of three numbers.
        may_add_energy: whether impacts may add energy; the certificate of a toss then says how much.
        may_pull: whether S_z may be negative.
        max_restitution: the largest chi that the law is meant for; a scenario with a larger one is refused.
        tolerance: up to which the law's impulses err, relative to |S|, |K S| and |S| |v_A|: 1e-10, that of
            rounding, to 1e-3. A law with more may add energy so far, and proves no face.

    Raises:
        ImportError: where numba is missing.
        TypeError: for what is no such function or number.
        ValueError: for a number out of its range; for a function that numba can't compile, or that breaks a
            condition, naming K and v_A.
    """

    function: Function
    may_add_energy: bool = field(default=False, kw_only=True)
    may_pull: bool = field(default=False, kw_only=True)
    max_restitution: float = field(default=1.0, kw_only=True)
    tolerance: float = field(default=EXACT, kw_only=True)
    code: OwnCode = field(init=False, repr=False, compare=False)
    """The law in the form that compiled code of this process calls."""

    def __post_init__(self) -> None:
        """Compile the function and try it."""
        if find_spec("numba") is None:
            raise ImportError('OwnLaw: needs numba: pip install "cointoss-dynamics[laws]"')
        plain = getattr(self.function, "py_func", self.function)
        require_type("law", plain, FunctionType, FORM)
        for name in ("may_add_energy", "may_pull"):
            require_type(name, getattr(self, name), bool, "True or False")
        for name, least, most in (("max_restitution", 0.0, 1.0), ("tolerance", EXACT, COARSEST)):
            _require_between(name, getattr(self, name), least, most)
        if not _takes_five(plain):
            raise TypeError(f"law {self.name}: takes {signature(plain)}, accepted: {FORM}")
        object.__setattr__(self, "function", plain)
        tried = [contact._replace(chi=contact.chi * self.max_restitution) for contact in _contacts()]
        _require_vector(self, tried[0])
        try:
            address = place(plain)
        except NotCompiledError as error:
            more = _DECORATE if "<class 'function'>" in str(error) else ""
            raise ValueError(f"law {self.name}: {error}{more}; accepted: {FORM}") from None
        object.__setattr__(self, "code", OwnCode(address, self.may_add_energy, self.may_pull, self.tolerance))
        agrees = max(AGREES, self.tolerance)
        for contact in tried:
            S = _require_vector(self, contact)
            if told := self.breach(contact) or _difference(S, call_at(address, *contact), agrees):
                raise ValueError(f"law {self.name}: {told}")

    def __reduce__(self) -> tuple[Callable[[], "OwnLaw"], tuple[()]]:
        """Return the law as another process makes it, at an address of its own."""
        given = {one.name: getattr(self, one.name) for one in fields(self) if one.init}
        return partial(OwnLaw, **given), ()

    @property
    def name(self) -> str:
        """The function's."""
        return getattr(self.function, "__name__", "law")

    def breach(self, contact: LawArguments) -> str:
        """Return the condition that the law breaks at a contact, in words; empty if it breaks none."""
        S = call_at(self.code.address, *contact)
        breach = Breach(breach_of(self.code, contact.K, contact.velocity, S))
        if breach == Breach.NONE:
            return ""
        K, v_A = np.array(contact.K), np.array(contact.velocity)
        meant = f" (max_restitution = {self.max_restitution:g}, tolerance = {self.tolerance:g})"
        match breach:
            case Breach.SINKS:
                does = f"v_Az' = {(v_A + K @ S)[2]:.3g} m/s"
            case Breach.ADDS_ENERGY:
                does = f"adds {S @ (v_A + K @ S / 2):.3g} J"
            case Breach.PULLS:
                does, meant = f"pulls, S = {_shown(S)} N s", ""
            case _:
                does, meant = f"S = {_shown(S)}", ""
        return f"{does}{_at(contact)}; accepted: {_ACCEPTED[breach]}{meant}"


def contact_of(body: Body, R: Array, point: Array | None, v_A: Array, chi: float, mu: float) -> LawArguments:
    """Return what a law is asked of a coin that touches the floor.

    Args:
        body: the coin.
        R: rotation matrix, body to space, (3, 3).
        point: A from B, body frame, (3,) [m]; None for a coin that lands flat without turning.
        v_A: velocity of A before the impact, space frame, (3,) [m/s].
        chi: restitution of the impact.
        mu: friction of the floor.
    """
    K, tau = np.eye(3) / body.mass, np.zeros(3)
    if point is not None:
        x, y, z = R @ (point - np.array(body.center))
        arm = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        K -= arm @ R @ np.array(body.inertia_inverse) @ R.T @ arm
        tau = R @ np.array([-point[1], point[0], 0.0]) / body.radius
    a, b, c = K.tolist()
    return LawArguments((tuple(a), tuple(b), tuple(c)), tuple(v_A.tolist()), vector(tau), chi, mu)


def contact_in(body: Body, rules: Rules, R: Matrix, v: Array, w: Array) -> LawArguments:
    """Return what a law is asked of a coin that touches the floor.

    Args:
        body: the coin.
        rules: the floor.
        R: rotation matrix, body to space.
        v: velocity of C, space frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
    """
    lowest, is_flat = lowest_point(body, R[2], vector(w))
    turn, point = np.array(R), np.array(lowest)
    v_A = v + turn @ np.cross(w, point - np.array(body.center))
    chi = restitution_at_speed(rules, -v_A[2])
    return contact_of(body, turn, None if is_flat else point, v_A, chi, rules.friction)


def rules_by(law: OwnLaw | None, scenario: Scenario) -> Rules:
    """Return a scenario's rules, with a law of one's own, if given, in place of the scenario's law.

    Raises:
        TypeError: for what is no such law.
        UnsupportedError: for a floor that resists motion in contact, which is a matter of contact, or with
            more restitution than the law is meant for.
    """
    rules = scenario.rules
    if law is None:
        return rules
    require_type("law", law, OwnLaw, "a cointoss.OwnLaw; a named law is the scenario's floor.contact")
    require_floor(law, scenario)
    most = scenario.ending.max_impacts or MOST_LOSSLESS
    return rules._replace(law=ContactLaw.SHARP_EDGE, own=law.code, max_impacts=most)


def require_floor(law: OwnLaw, scenario: Scenario) -> None:
    """Refuse a floor that a law of one's own can't be used with; see `rules_by`."""
    floor = scenario.floor
    largest = largest_restitution(scenario.rules)
    if largest > law.max_restitution:
        by_speed = f" (restitution {largest:g} at a low speed)" if largest > floor.restitution else ""
        raise UnsupportedError(
            f"floor.restitution = {floor.restitution:g}{by_speed}: accepted: up to max_restitution, "
            f"{law.max_restitution:g}, of the law {law.name}"
        )
    for key in RESISTANCES:
        if getattr(floor, key) > 0:
            raise UnsupportedError(
                f"floor.{key} = {getattr(floor, key):g}: accepted: 0 with the law {law.name}, "
                "which is not followed into sustained contact"
            )


def residuals(law: OwnLaw, body: Body, rules: Rules, impacts: Impacts) -> Array:
    """Return by how much each impulse misses what the law gives as it is written, relative to |S|, (n,).

    Args:
        law: of the impacts.
        body: the coin.
        rules: the floor.
        impacts: by the law.
    """
    missed = np.zeros(len(impacts))
    for i, S in enumerate(impacts.impulse):
        R = rotation_matrix(euler_parameters(impacts.quaternion[i]))
        v, w = impacts.velocity_before[i], impacts.angular_velocity_before[i]
        asked = np.array(law.function(*contact_in(body, rules, R, v, w)))
        missed[i] = np.linalg.norm(S - asked) / np.linalg.norm(S)
    return missed


def _require_between(name: str, value: object, least: float, most: float) -> None:
    accepted = f"a number from {least:g} to {most:g}"
    if not _is_number(value):
        raise TypeError(f"{name}: of type {type(value).__name__}, accepted: {accepted}")
    if not least <= value <= most:
        raise ValueError(f"{name} = {value}: accepted: {accepted}")


def _takes_five(function: FunctionType) -> bool:
    kinds = [one.kind for one in signature(function).parameters.values()]
    return len(kinds) == len(LawArguments._fields) and {*kinds} <= _POSITIONAL


def _require_vector(law: OwnLaw, contact: LawArguments) -> Array:
    """Return S of the function as it is written, refused unless it is a tuple of three numbers."""
    try:
        S = law.function(*contact)
    except Exception as error:
        why = ": ".join(filter(None, [f"raises {type(error).__name__}", " ".join(str(error).split())]))
        raise ValueError(f"law {law.name}: {why}{_at(contact)}; accepted: {FORM}") from None
    if type(S) is not tuple or len(S) != 3 or not all(_is_number(one) for one in S):
        raise TypeError(f"law {law.name}: returns {S!r:.60}, accepted: {FORM}")
    return np.array(S, dtype=float)


def _is_number(one: object) -> TypeGuard[float]:
    return isinstance(one, float) or (type(one) is int and abs(one) < 2**63)


def _difference(S: Array, compiled: Vector, agrees: float) -> str:
    """Return in words by how much the compiled law differs from the function as it is written."""
    if np.linalg.norm(S - compiled) <= agrees * np.linalg.norm(S):
        return ""
    return (
        f"gives S = {_shown(S)} N s as it is written and {_shown(compiled)} N s as it is compiled; "
        "accepted: a function of its arguments alone, or a larger tolerance for a law that integrates"
    )


def _at(contact: LawArguments) -> str:
    """Return a contact in words."""
    K = ", ".join(_shown(row) for row in contact.K)
    v_A, tau = _shown(contact.velocity), _shown(np.round(contact.tau, 3))
    return f" at K = ({K}) 1/kg, v_A = {v_A} m/s, tau = {tau}, chi = {contact.chi:g}, mu = {contact.mu:g}"


def _shown(numbers: Vector | Array) -> str:
    return f"({', '.join(f'{one + 0.0:.3g}' for one in numbers)})"


_POSITIONAL = {Parameter.POSITIONAL_ONLY, Parameter.POSITIONAL_OR_KEYWORD}
_COINS: tuple[dict[str, Any], ...] = (
    {"mass": 2e-3, "radius": 1.25e-2, "thickness": 0.0},
    {"mass": 2e-3, "radius": 1.25e-2, "thickness": 2e-3, "center_of_mass": (-1e-3, -1e-3, -2e-4)},
    {"mass": 0.5, "radius": 0.1, "thickness": 0.15},
    # Turns as a ball: 2/5 m r² about every axis.
    {"mass": 0.05, "radius": 0.025, "thickness": 1e-3, "inertia": tuple((1.25e-5 * np.eye(3)).tolist())},
)
_ALOFT = Release(position=(0.0, 0.0, 1.0))
_TILTS = (0.01, 0.5, 0.8, 1.2, 1.56, 0.0)
"""Angles between the coin and the floor [rad]."""
_SPEEDS = ((0.0, 0.0, 1.0), (1.0, 0.0, 1.0), (0.0, -1.0, 1.0), (-0.6, 0.8, 0.05), (0.02, 0.03, 1.0))
"""Slip along the edge and across it, and approach, in units of the coin's speed of fall [m/s]."""


@cache
def _contacts() -> tuple[LawArguments, ...]:
    """Return the contacts at which every law is tried."""
    return tuple(_draw_contacts())


def _draw_contacts() -> Iterator[LawArguments]:
    rng, chis, mus = np.random.default_rng(2008), cycle((1.0, 0.5, 0.0, 0.8)), cycle((0.3, 0.0, 1.0))
    for tilt, coin, _ in product(_TILTS, _COINS, range(3)):
        body = Scenario(
            coin=Coin(**coin), floor=Floor(restitution=1.0, contact=ContactLaw.SMOOTH), release=_ALOFT
        ).body
        side = rng.choice([-1.0, 1.0])
        psi, phi = rng.uniform(0, 2 * np.pi, 2)
        R = np.array(rotation_matrix(quaternion_from_angles((psi, tilt if side > 0 else np.pi - tilt, phi))))
        lowest, is_flat = lowest_point(body, vector(R[2]), (0.0, 0.0, 0.0))
        point = None if is_flat else np.array(lowest)
        tau, nu = np.array([np.cos(psi), np.sin(psi), 0.0]), np.array([-np.sin(psi), np.cos(psi), 0.0])
        for along, across, down in _SPEEDS:
            v_A = rng.uniform(0.1, 3) * (along * tau + across * nu - np.array([0.0, 0.0, down]))
            yield contact_of(body, R, point, v_A, next(chis), next(mus))
