"""The bounce of two geoms of a user's own model, over speed and the phase of the step."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import NamedTuple, SupportsIndex

import mujoco
import numpy as np

from cointoss_bounce.accepted import require
from cointoss_bounce.approach import Pair
from cointoss_bounce.arrays import Array
from cointoss_bounce.contact import INTEGRATORS
from cointoss_bounce.errors import FieldError
from cointoss_bounce.inverse import TWO
from cointoss_bounce.pair_rest import PairRest, rest_between
from cointoss_bounce.points import SHARE, Instant, Points, gravity_in
from cointoss_bounce.states import copied
from cointoss_bounce.unlogged import unlogged
from cointoss_bounce.user_model import geom_of, load_model, require_measurable

SPEEDS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
"""Speeds at which the geoms come together [m/s]."""
PHASES = 8
"""Phases of the touch between two steps."""
LONGEST = 4000
"""A contact that goes on for more steps is no rebound."""
AHEAD = 2
"""Steps before the touch at which the geoms start, or up to one more."""
SLOW, LYING = 1e-3, 100
"""Geoms slower than this part of their speed for so many steps lie on each other, or stick in each other."""
MISSED = 60
"""Geoms that have not touched after so many steps do not touch."""
DEEP = 0.05
"""Geoms are deep in each other from this part of half the thickness of the thinner one."""


class PairOutcome(StrEnum):
    """The result of a touch of two geoms."""

    REBOUNDS = "rebound"
    """They part."""
    STAYS = "stay"
    """They do not part: they lie on each other, or stick in each other."""
    LASTS = "touch on and on"
    """They touch for more than `LONGEST` steps, and still move."""
    PASSES = "go through"
    """They part on the wrong sides, or one is beyond the other's middle after a step."""
    MISSES = "do not touch"
    TURNED = "meet at a turned normal"
    """The normal of the first contact is not that along which they came: one is already deep in the other."""
    ASIDE = "are pushed aside"
    """They are not deep in each other, and MuJoCo's normal is not, or does not stay, that of the approach."""
    OTHER_SPEED = "come at another speed"
    """Something else brakes or accelerates them by more than `SHARE` of their speed on the way."""
    CHANGES = "change speed in a step"
    """They part, and in the step in which they meet or part their speed changes by more than `SHARE`."""
    UNSTABLE = "become unstable"


@dataclass(frozen=True, kw_only=True)
class PairBounce:
    """How two geoms of a model bounce off each other."""

    geoms: tuple[str, str]
    timestep: float
    """The step of the simulation [s]."""
    integrator: str
    solref: tuple[float, float]
    """The solref that MuJoCo mixes for their contact."""
    solimp: str
    condim: int
    friction: float
    margin: float
    """The distance from which the contact pushes [m]: the margin since MuJoCo 3.9, before it margin - gap."""
    gap: float
    """The distance beyond the margin over which MuJoCo since 3.9 lists the contact without a push [m]."""
    turning: float
    """The largest angle by which a body turns on each metre of the approach [rad/m]; 0 if thrown straight."""
    thinnest: float
    """Half of the thickness of the thinner geom, where it is thinnest; a plane has none [m]."""
    speeds: Array
    """The speeds at which the geoms come together, (n,) [m/s]."""
    restitutions: Array
    """Without gravity: the normal speed of the points that touched first, where both geoms touch, after over
    before, (n, `PHASES`), at the instants at which these points meet and part. 0 where the geoms stay; NaN
    where they neither part nor stay."""
    with_gravity: Array
    """The restitutions under the model's gravity, (n, `PHASES`)."""
    outcomes: tuple[tuple[PairOutcome, ...], ...]
    """What came of each touch without gravity, (n, `PHASES`)."""
    outcomes_with_gravity: tuple[tuple[PairOutcome, ...], ...]
    """What came of each touch under the model's gravity, (n, `PHASES`)."""
    energy_kept: Array
    """Share of the model's kinetic energy that is left at the instant of the restitution, without gravity,
    (n, `PHASES`); NaN if the geoms do not part. For a turning body it shows what the restitution of a point
    does not."""
    durations: Array
    """The time for which the geoms push, without gravity, (n, `PHASES`) [s]."""
    depths: Array
    """The greatest depths, without gravity, (n,) [m]."""
    rest: PairRest | None
    """The motion of one geom on the other after the bounces, under the model's gravity."""
    no_rest: str
    """Why `rest` was not measured, in words."""
    notes: tuple[str, ...]
    """Other properties of the model on which the numbers depend, in words."""


class _Touch(NamedTuple):
    """What came of one touch."""

    outcome: PairOutcome
    restitution: float = math.nan
    kept: float = math.nan
    duration: float = math.nan
    depth: float = math.nan


def bounce(
    model: mujoco.MjModel | Path | str,
    one: str | SupportsIndex,
    two: str | SupportsIndex,
    *,
    speeds: Sequence[float] = SPEEDS,
) -> PairBounce:
    """Return how two geoms of a model bounce off each other, by plain `mj_step` and the model's own options.

    Other geoms do not touch these two. A geom whose joints let it move along the normal of the contact while
    no body turns, such as those of a free body, approaches straight, with all that hangs on those joints. If
    neither can, the joints move as an impulse between both would move them. Bodies that active equality
    constraints couple move along. The model's joints, springs, actuators and limits act. Nothing is written.

    Args:
        model: of MuJoCo, or the path of its XML.
        one: a geom, by its name or number.
        two: another.
        speeds: at which they come together [m/s].

    Raises:
        ValueError: naming what does not load, exist or touch, and what is accepted.
    """
    loaded = model if isinstance(model, mujoco.MjModel) else load_model(model)
    require_measurable(loaded)
    require(
        "speeds", speeds, len(speeds) > 0 and all(0 < v < math.inf for v in speeds), "finite speeds above 0"
    )
    first, second = geom_of(loaded, one), geom_of(loaded, two)
    require("geoms", f"{one} and {two}", first != second, "two different geoms")
    with unlogged():
        pair = Pair(loaded, first, second)
        touch = pair.contact
        solref = (float(touch.solref[0]), float(touch.solref[1]))
        if min(solref) <= 0 < max(solref):
            raise _no_solref(loaded, (first, second), solref)
        gravity = pair.model.opt.gravity.copy()
        pair.model.opt.gravity[:] = 0
        free = _touches(pair, speeds)
        pair.model.opt.gravity[:] = gravity
        pulled = _touches(pair, speeds)
        rest = rest_between(pair)
    acts_on = (
        f"a soft constraint ({', '.join(pair.soft)}) goes on acting after the contact: "
        "the speed and the energy are those at the parting"
    )
    return PairBounce(
        geoms=(str(one), str(two)),
        timestep=float(pair.model.opt.timestep),
        integrator=INTEGRATORS[pair.model.opt.integrator],
        solref=solref,
        solimp=" ".join(f"{number:.12g}" for number in touch.solimp),
        condim=int(touch.dim),
        friction=float(touch.friction[0]),
        margin=float(touch.includemargin),
        gap=pair.gap,
        turning=pair.turning,
        thinnest=pair.thinnest,
        speeds=np.array(speeds),
        restitutions=_column(free, "restitution"),
        with_gravity=_column(pulled, "restitution"),
        outcomes=_outcomes(free),
        outcomes_with_gravity=_outcomes(pulled),
        energy_kept=_column(free, "kept"),
        durations=_column(free, "duration"),
        depths=_column(free, "depth").max(axis=1),
        rest=rest if isinstance(rest, PairRest) else None,
        no_rest="" if isinstance(rest, PairRest) else rest,
        notes=(acts_on,) if pair.soft else (),
    )


def _no_solref(model: mujoco.MjModel, geoms: tuple[int, int], mixed: tuple[float, float]) -> FieldError:
    """Return that a solref is none: that of a geom, or both mixed; MuJoCo would take its own."""
    name, numbers = "solref", mixed
    for geom in geoms:
        own = model.geom_solref[geom]
        if own.min() <= 0 < own.max():
            name, numbers = f"geom {model.geom(geom).name or geom} solref", (float(own[0]), float(own[1]))
    return FieldError(name, " ".join(f"{number:g}" for number in numbers), TWO)


def _touches(pair: Pair, speeds: Sequence[float]) -> list[list[_Touch]]:
    """Return every touch, by speed and phase."""
    return [[_touch(pair, speed, (n + 0.5) / PHASES) for n in range(PHASES)] for speed in speeds]


def _column(touches: list[list[_Touch]], name: str) -> Array:
    return np.array([[getattr(touch, name) for touch in row] for row in touches])


def _outcomes(touches: list[list[_Touch]]) -> tuple[tuple[PairOutcome, ...], ...]:
    return tuple(tuple(touch.outcome for touch in row) for row in touches)


def _touch(pair: Pair, speed: float, phase: float) -> _Touch:
    """Return what comes of one touch."""
    pair.set_apart(speed, AHEAD + phase)
    came = _come(pair, speed)
    return _Touch(came) if isinstance(came, PairOutcome) else _part(pair, *came)


def _come(pair: Pair, speed: float) -> tuple[Points, Instant] | PairOutcome:
    """Step until both geoms touch, at about a speed [m/s]; return where and how, or why there is no touch."""
    model, data = pair.model, pair.data
    for _ in range(MISSED):
        mujoco.mj_forward(model, data)
        touches = pair.touches()
        if touches:
            break
        if pair.has_passed():
            return PairOutcome.PASSES
        pair.apart = copied(model, data, pair.apart)
        mujoco.mj_step(model, data)
    else:
        return PairOutcome.UNSTABLE if _is_unstable(pair) else PairOutcome.MISSES
    if data.time == 0:
        return PairOutcome.OTHER_SPEED
    points = Points(pair, list(touches.values()))
    along = (points.normals @ pair.normal).mean()
    if along < 0:
        return PairOutcome.PASSES
    if along < 1 - SHARE:
        return _if_deep(pair, -min(contact.dist for contact in touches.values()), PairOutcome.TURNED)
    met = points.at_touch(pair.apart, points.speed(data))
    allowed = SHARE * speed + gravity_in(model) * model.opt.timestep
    return (points, met) if abs(met.speed + speed) <= allowed else PairOutcome.OTHER_SPEED


def _if_deep(pair: Pair, depth: float, outcome: PairOutcome) -> PairOutcome:
    """Return an outcome of geoms that are deep in each other, or at a lesser depth [m] that of an edge."""
    return outcome if depth > DEEP * pair.thinnest else PairOutcome.ASIDE


def _part(pair: Pair, points: Points, met: Instant) -> _Touch:
    """Step until both geoms part, and return what they did.

    A geom that rolls pushes on after the points that touched first have parted.
    """
    model, data, dt = pair.model, pair.data, float(pair.model.opt.timestep)
    depth, pushing, slow, parted = 0.0, 0, 0, None
    last = rate = deep = middle = math.nan

    def ended(outcome: PairOutcome, restitution: float = math.nan, kept: float = math.nan) -> _Touch:
        if _is_unstable(pair):
            return _Touch(PairOutcome.UNSTABLE)
        return _Touch(outcome, restitution, kept, pushing * dt, depth)

    for step in range(LONGEST):
        mujoco.mj_forward(model, data)
        touches, gap, before = pair.touches(), points.gap(data), deep
        # This compares the geoms, not the points that touched first: a geom that rolls stays.
        deep = max((-float(contact.dist) for contact in touches.values()), default=-gap)
        depth = max(depth, deep) if touches else depth
        middle = deep if step == LONGEST // 2 else middle
        slow = slow + 1 if abs(deep - before) < SLOW * -met.speed * dt else 0
        pushes = pair.push(touches) > 0
        pushing += pushes
        if slow == LYING:
            return ended(PairOutcome.STAYS, 0.0)
        if parted is None and pushing and gap > 0:
            parted = points.at_touch(data, rate)
        if parted is not None and not pushes:
            outcome = PairOutcome.CHANGES if met.is_coarse or parted.is_coarse else PairOutcome.REBOUNDS
            return ended(outcome, -parted.speed / met.speed, parted.energy / met.energy)
        if not touches and gap < last:
            return ended(_if_deep(pair, depth, PairOutcome.PASSES))
        last, rate = gap, (gap - last) / dt
        mujoco.mj_step(model, data)
    # What trembles on, or creeps, stays.
    stays = abs(deep - middle) < SLOW * -met.speed * dt * LONGEST / 2
    return ended(PairOutcome.STAYS, 0.0) if stays else ended(PairOutcome.LASTS)


def _is_unstable(pair: Pair) -> bool:
    return any(warning.number for warning in pair.data.warning)
