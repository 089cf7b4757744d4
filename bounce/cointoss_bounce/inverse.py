"""The restitution of given contact settings: as MuJoCo mixes those of two geoms, measured, and by formula."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from numbers import Real

import mujoco

from cointoss_bounce.accepted import require, require_bounds
from cointoss_bounce.bodies import BALL, body_of
from cointoss_bounce.contact import DEFAULT, GRAVITY, INTEGRATORS, ContactSettings, text_of
from cointoss_bounce.drops import SPEED, drops_of
from cointoss_bounce.measured import Measured
from cointoss_bounce.rest import rest_of
from cointoss_bounce.spring import contact_duration, end_of, restitution_of

TWO = "two numbers as in a <geom>: both above 0, or both at most 0, such as 0.02 1 or -1000 -10"
SOFTEST, HARDEST_IMPEDANCE = 1e-4, 0.9999
"""Impedances to which MuJoCo limits those of a solimp."""
_PAIR = """<mujoco>
  <worldbody>
    <geom type="sphere" size="1" {one}/>
    <body pos="0 0 1"><freejoint/><geom type="sphere" size="1" {two}/></body>
  </worldbody>
</mujoco>"""


@dataclass(frozen=True, kw_only=True)
class Formula:
    """The bounce that theory predicts for a damped spring, or for one step of it."""

    restitution: float
    duration: float
    """The duration of a contact [s]."""
    depth: float
    """The depth at 1 m/s [m]."""
    rest: float
    """Depth at rest [m]; infinite if the contact does not hold a body at rest."""


@dataclass(frozen=True, kw_only=True)
class Rebounds(Measured):
    """The bounces and the rest of a body on a plane, with given settings of MuJoCo."""

    restitution: float
    """Mean restitution of `PHASES` touches at `SPEED` without weight, anywhere between two steps."""
    lowest: float
    """The lowest restitution of these touches."""
    highest: float
    restitution_with_weight: float
    """Mean restitution of a body that touches at `SPEED` under `gravity`."""
    duration: float
    """Mean duration of a contact without weight [s]."""
    formula: Formula | None
    """The prediction of theory for one point under the mass centre; None without a formula, as for one-step
    contacts by RK4 or discrete."""


def solref_of(
    solref: Sequence[float],
    timestep: float,
    *,
    other: Sequence[float] | None = None,
    integrator: str = "Euler",
    solimp: str = DEFAULT,
    body: str | None = None,
    mass: float = BALL.mass,
    gravity: float = GRAVITY,
) -> Rebounds:
    """Return the restitution of given settings: measured on a body over a plane, and by formula.

    The model has none of MuJoCo's flags.

    Args:
        solref: of one geom, two numbers.
        timestep: dt of the simulation [s].
        other: the solref of the other geom, of equal priority, with MuJoCo's own solimp; None if `solref` and
            `solimp` hold alone, as for a geom with priority="1".
        integrator: of MuJoCo, by its name in a model; Euler is MuJoCo's own choice.
        solimp: of the geom with `solref`; by default MuJoCo's own.
        body: that is measured, by its type and size in a <geom>, such as "box 0.1 0.1 0.002"; by default a
            ball of 1 cm.
        mass: of the body [kg].
        gravity: downward, of what is measured with weight and at rest [m/s²].

    Raises:
        ValueError: naming the argument, its value and what is accepted.
    """
    require_bounds(timestep, mass=mass, gravity=gravity)
    require("integrator", integrator, integrator in INTEGRATORS, ", ".join(INTEGRATORS))
    given = ContactSettings(
        solref=_solref("solref", solref),
        timestep=timestep,
        integrator=integrator,
        solimp=_solimp(solimp),
        exact=False,
        gravity=gravity,
    )
    chosen = body_of(body, mass)
    contact = given if other is None else _mixed(given, _solref("other", other))
    drops, weighing = drops_of(contact, chosen), drops_of(contact, chosen, gravity)
    return Rebounds(
        solref=contact.solref,
        solimp=contact.solimp,
        timestep=timestep,
        integrator=integrator,
        body=str(chosen),
        mass=mass,
        gravity=gravity,
        restitution=float(drops.restitutions.mean()),
        lowest=float(drops.restitutions.min()),
        highest=float(drops.restitutions.max()),
        restitution_with_weight=float(weighing.restitutions.mean()),
        duration=float(drops.durations.mean()),
        depth=drops.depth / SPEED,
        rest=rest_of(contact, chosen),
        formula=formula_of(contact),
    )


def _solref(name: str, numbers: Sequence[float]) -> tuple[float, float]:
    """Return a solref of MuJoCo, or refuse what is none."""
    given = list(numbers) if isinstance(numbers, Sequence) and not isinstance(numbers, str) else []
    fits = len(given) == 2 and all(isinstance(n, Real) and math.isfinite(n) for n in given)
    require(name, numbers, fits and (min(given) > 0 or max(given) <= 0), TWO)
    first, second = given
    return float(first), float(second)


def _solimp(text: str) -> str:
    """Return a solimp with all of its five numbers, or refuse what is none."""
    accepted = "up to five numbers as in a <geom>, such as 0.9 0.95 0.001: dmin dmax width midpoint power"
    words = text.split() if isinstance(text, str) else []
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    fits = 1 <= len(numbers) <= 5 and all(math.isfinite(number) and number >= 0 for number in numbers)
    require("solimp", text, fits, accepted)
    return " ".join([*words, *DEFAULT.split()[len(words) :]])


def _mixed(contact: ContactSettings, other: tuple[float, float]) -> ContactSettings:
    """Return the settings that MuJoCo makes of those of two geoms of equal priority."""
    xml = _PAIR.format(one=contact.geom, two=f'solref="{text_of(other)}"')
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    touch = data.contact[0]
    return replace(
        contact,
        solref=(float(touch.solref[0]), float(touch.solref[1])),
        solimp=" ".join(f"{number:.12g}" for number in touch.solimp),
    )


def formula_of(contact: ContactSettings) -> Formula | None:
    """Return what theory says of settings.

    A contact pushes with the acceleration -d (b v + k x), d the impedance. Where b dt reaches 1 it ends
    within one step of Euler: v' = (1 - b dt) v + k dt x, x anything from 0 to v dt. Otherwise it is a damped
    spring that lets go when its force vanishes: its greatest depth is v √(e/k). At rest d k x = (1 - d) g,
    with the impedance at that depth.
    """
    stiffness, damping = _spring_of(contact)
    dt = contact.timestep
    rest = _depth_at_rest(contact, stiffness) if stiffness else math.inf
    root = math.sqrt(stiffness)
    if damping * dt >= 1 or not stiffness:
        if contact.integrator in ("RK4", "discrete"):
            return None
        rebound = max(damping * dt - 1 + stiffness * dt**2 / 2, 0.0)
        return Formula(restitution=rebound, duration=dt if rebound else math.inf, depth=dt, rest=rest)
    zeta = damping / (2 * root)
    e = restitution_of(zeta)
    return Formula(
        restitution=e, duration=contact_duration(zeta) / root, depth=math.sqrt(e) / root, rest=rest
    )


def _depth_at_rest(contact: ContactSettings, stiffness: float) -> float:
    """Return x = (1 - d) g (D/d)²/k, d the impedance at the depth x and D that of a deep contact [m]."""
    solimp, deep = contact.solimp, _impedance(contact.solimp, math.inf)

    def held(depth: float) -> float:
        d = _impedance(solimp, depth)
        return (1 - d) * contact.gravity * (deep / d) ** 2 / stiffness

    return end_of(lambda depth: held(depth) > depth, 0.0, max(held(0.0), held(math.inf)))


def _impedance(solimp: str, depth: float) -> float:
    """Return the impedance at a depth [m], as MuJoCo has it: from d0 to d_width, by a curve of two powers."""
    shallow, deep, width, middle, power = (float(number) for number in solimp.split())
    part = min(depth / width, 1.0) if width > 0 else 1.0
    middle, power = min(max(middle, SOFTEST), HARDEST_IMPEDANCE), max(power, 1.0)
    if part <= middle:
        part = part**power / middle ** (power - 1)
    else:
        part = 1 - (1 - part) ** power / (1 - middle) ** (power - 1)
    shallow, deep = (min(max(d, SOFTEST), HARDEST_IMPEDANCE) for d in (shallow, deep))
    return shallow + part * (deep - shallow)


def _spring_of(contact: ContactSettings) -> tuple[float, float]:
    """Return the stiffness [1/s²] and the damping [1/s] with the impedance that a deep contact has.

    MuJoCo raises a time constant below two steps to two steps (the flag refsafe).
    """
    first, second = contact.solref
    if first <= 0:
        return -first, -second
    constant = max(first, 2 * contact.timestep)
    return 1 / (constant * second) ** 2, 2 / constant
