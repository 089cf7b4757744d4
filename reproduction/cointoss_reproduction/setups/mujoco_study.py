"""How far MuJoCo's impacts are from the paper's laws, as functions of the contact's settings."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import mujoco
import numpy as np
from matplotlib.axes import Axes

from cointoss import ContactLaw, Impacts, Scenario
from cointoss.coin_mj import Friction, MujocoSettings, Realisation
from cointoss.study import Array, machine_of, run_mujoco, shape_thickness
from cointoss_reproduction.setups.mujoco_impacts import (
    by_law,
    by_mujoco,
    draw_touches,
    first,
    impulse_errors,
    on_floor,
    relative_errors,
    touch,
    velocity_at_touch,
)

RESTITUTIONS = (0.2, 1.0)
FRICTIONS = (0.0, 1.0)
RUBBED = 0.3
"""Coefficient of friction where one stands for all."""
NO_SLIP = 1e-9
"""Slip below this part of the speed of the contact point is none."""
GAIN = 1e-5
"""An energy that grows by less than this part of itself is the same."""
FINE = 640
"""Steps in a contact that is resolved finely."""
KINDS = ("frictionless", "sticking", "sliding", "turning")
CONTACTS = {
    "spring": MujocoSettings(),
    "one step": MujocoSettings(contact=Realisation.ONE_STEP),
    "spring, native cone": MujocoSettings(friction=Friction.NATIVE),
    "one step, native cone": MujocoSettings(contact=Realisation.ONE_STEP, friction=Friction.NATIVE),
}


class Spread(NamedTuple):
    """Median and worst of some errors."""

    median: float
    worst: float
    number: int


def spread(errors: Array) -> Spread:
    """Return median and worst of errors, (n,)."""
    return Spread(float(np.median(errors)), float(errors.max()), len(errors))


def draw_spreads(axes: Axes, spreads: Mapping[float, Any]) -> None:
    """Draw the median and the worst of some errors over what they depend on."""
    for name, style in (("median", "o-"), ("worst", "s--")):
        axes.plot(list(spreads), [getattr(fit, name) for fit in spreads.values()], style, label=name)


def order(sizes: Sequence[float], errors: Sequence[float]) -> float:
    """Return the order p of errors that fall as sizes^-p, by least squares of the logarithms."""
    return -float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


def smooth_and_rubbed(cases: Sequence[Scenario]) -> dict[str, list[Scenario]]:
    """Return touches of a smooth floor on that, and on Coulomb's with friction `RUBBED`."""
    return {
        "smooth": list(cases),
        f"coulomb, μ = {RUBBED:g}": [on_floor(case, ContactLaw.COULOMB, RUBBED) for case in cases],
    }


IMPULSE, LIMIT = "impulse", "impulse 2 S(k) − S(k/4)"
"""Of what errs: |ΔS|/|S|, and the same of Richardson's limit of errors like k^(-1/2)."""


@dataclass(frozen=True, kw_only=True)
class StiffnessErrors:
    """Median errors of impacts against the law, over the stiffness of the spring."""

    stiffness: list[float]
    """k [1/s²]."""
    errors: dict[str, list[float]]
    """Of the impulse, of C's velocity and of the spin, the last two over their change; of the impulse without
    MuJoCo's `diagexact`, and in the limit, also with `FINE` steps in a contact."""
    order: float
    """p of errors of the impulse like k^-p, over the stiffnesses from 1e8 to 1e14."""


def over_stiffness(cases: Sequence[Scenario], stiffnesses: Sequence[float]) -> StiffnessErrors:
    """Compute the errors of impacts over the stiffness."""
    law = by_law(cases)
    S = first(law, "impulse")

    def median_error(found: list[Impacts]) -> float:
        return _median(relative_errors(S, first(found, "impulse")))

    settings = [MujocoSettings(stiffness=k) for k in stiffnesses]
    hard = [by_mujoco(cases, one) for one in settings]
    impulse = [median_error(found) for found in hard]
    fitted = [i for i, k in enumerate(stiffnesses) if 0.9e8 < k < 1.1e14]
    errors = {
        IMPULSE: impulse,
        "velocity": [_median(_change_error(law, found, "velocity")) for found in hard],
        "spin": [_median(_change_error(law, found, "angular_velocity")) for found in hard],
        "impulse, mass guessed (no diagexact)": [
            median_error([_with_guessed_mass(case, one) for case in cases]) for one in settings
        ],
    }
    for name, steps in ((LIMIT, MujocoSettings().steps), (f"the same with {FINE} steps", FINE)):
        errors[name] = [_median(relative_errors(S, _limit(cases, k, steps))) for k in stiffnesses]
    return StiffnessErrors(
        stiffness=list(stiffnesses),
        errors=errors,
        order=order([stiffnesses[i] for i in fitted], [impulse[i] for i in fitted]),
    )


def _limit(cases: Sequence[Scenario], stiffness: float, steps: int) -> Array:
    hard, soft = (
        first(by_mujoco(cases, MujocoSettings(stiffness=k, steps=steps)), "impulse")
        for k in (stiffness, stiffness / 4)
    )
    return 2 * hard - soft


def _median(errors: Array) -> float:
    return float(np.median(errors))


def _change_error(law: list[Impacts], found: list[Impacts], name: str) -> Array:
    before, after = first(law, f"{name}_before"), first(law, f"{name}_after")
    change = np.linalg.norm(after - before, axis=1)
    return np.linalg.norm(first(found, f"{name}_after") - after, axis=1) / change


def _with_guessed_mass(case: Scenario, settings: MujocoSettings) -> Impacts:
    machine = machine_of(case, settings, shape_thickness(case))
    machine.model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_DIAGEXACT)
    return Impacts.from_rows(run_mujoco(machine, case.rules).rows)


def over_steps(cases: Sequence[Scenario], steps: Sequence[int], most: int) -> dict[int, float]:
    """Return the median change of the impulse against that of the most steps, for each number of steps."""
    S = first(by_mujoco(cases, MujocoSettings(steps=most)), "impulse")
    return {
        n: _median(relative_errors(S, first(by_mujoco(cases, MujocoSettings(steps=n)), "impulse")))
        for n in steps
    }


def over_kinds(count: int, rng: np.random.Generator) -> dict[str, dict[str, Spread]]:
    """Return the errors of impulses by each of `CONTACTS`, apart for each of `KINDS`.

    An impact sticks where its slip stops for good, slides where the slip after has a part along the slip
    before, and turns elsewhere.
    """
    smooth = draw_touches(rng, count, RESTITUTIONS)
    rubbed = [on_floor(case, ContactLaw.COULOMB, float(rng.uniform(*FRICTIONS))) for case in smooth]
    answers = {}
    for name, settings in CONTACTS.items():
        answers[name] = {}
        for cases, kinds in ((smooth, KINDS[:1]), (rubbed, KINDS[1:])):
            if kinds == KINDS[:1] and settings.friction == Friction.NATIVE:
                continue
            law = by_law(cases)
            errors = relative_errors(first(law, "impulse"), first(by_mujoco(cases, settings), "impulse"))
            kind = np.array([_kind(one) for one in law]) if len(kinds) > 1 else np.full(len(cases), kinds[0])
            answers[name] |= {one: spread(errors[kind == one]) for one in kinds if np.any(kind == one)}
    return answers


def _kind(impacts: Impacts) -> str:
    before, after = impacts.contact_velocity_before[0], impacts.contact_velocity_after[0]
    if np.hypot(after[0], after[1]) < NO_SLIP * np.linalg.norm(before):
        return "sticking"
    return "sliding" if before[:2] @ after[:2] > 0 else "turning"


def over_tilt(count: int, tilts: Sequence[float], rng: np.random.Generator) -> dict[float, Spread]:
    """Return the errors of impulses of the default spring for coins at each tilt [deg]."""

    def drawn(tilt: float) -> Scenario:
        return tilted_touch(tilt, rng.uniform(-1, 1, 2), float(rng.uniform(*RESTITUTIONS)))

    return {tilt: default_errors([drawn(tilt) for _ in range(count)]) for tilt in tilts}


def default_errors(touches: Sequence[Scenario], friction: float = RUBBED) -> Spread:
    """Return the errors of impulses by the default contact, of touches of a floor with Coulomb's friction."""
    cases = [on_floor(case, ContactLaw.COULOMB, friction) for case in touches]
    return spread(impulse_errors(cases, MujocoSettings()))


def tilted_touch(tilt: float, slip: Array, restitution: float) -> Scenario:
    """Return a touch of the ideal coin that does not turn, 1 m/s down.

    Args:
        tilt: of its normal from the vertical [deg].
        slip: across and along the rim, (2,) [m/s].
        restitution: χ.
    """
    half = math.radians(tilt) / 2
    # Turned about x: the rim runs along x where it touches.
    return touch(
        attitude=np.array([math.cos(half), math.sin(half), 0, 0]),
        velocity=np.array([slip[1], slip[0], -1.0]),
        spin=np.zeros(3),
        restitution=restitution,
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class NativeCone:
    """What MuJoCo's native friction cone does to a restitution."""

    restitution: float
    """That asked for."""
    tilts: list[float]
    """[deg]."""
    frictions: list[float]
    slips: list[float]
    """Across the rim, over the normal speed."""
    obtained: Array
    """Restitutions, (tilts, slips, frictions)."""


def native_cone(
    restitution: float, tilts: Sequence[float], frictions: Sequence[float], slips: Sequence[float]
) -> NativeCone:
    """Map the restitution that a spring with MuJoCo's native friction gives."""
    settings = MujocoSettings(friction=Friction.NATIVE)
    cases = [
        on_floor(tilted_touch(tilt, np.array([slip, 0.0]), restitution), ContactLaw.COULOMB, mu)
        for tilt in tilts
        for slip in slips
        for mu in frictions
    ]
    after = first(by_mujoco(cases, settings), "contact_velocity_after")[:, 2]
    shape = (len(tilts), len(slips), len(frictions))
    return NativeCone(
        restitution=restitution,
        tilts=list(tilts),
        frictions=list(frictions),
        slips=list(slips),
        obtained=(after / -np.array([velocity_at_touch(case)[2] for case in cases])).reshape(shape),
    )


@dataclass(frozen=True, kw_only=True)
class ConeFormula:
    """What MuJoCo's native cone does in one step, against its formulas.

    In a sliding contact the acceleration exceeds the reference along the edge of the dual cone,
    a_n - a_n* = μ |a_t - a_t*|, at a right angle to the force. With the damping (1 + χ)/dt along the floor
    too this is Moreau's law: v_n' = χ |v_n| + μ |v_t' + χ v_t|, and S · (v_A' + χ v_A) = 0, so the energy
    changes by S · (v_A + v_A')/2 = (1 - χ) S · v_A/2, which is never a gain.
    """

    normal_speed: Spread
    """|v_n' - formula|/|v_n|."""
    energy: Spread
    """|ΔE - formula|/E."""
    pushed: float
    """Largest v_n' over χ |v_n|."""
    gains: dict[str, tuple[float, float]]
    """Part of the impacts that gain energy, and the largest gain over the energy before, by contact."""


def cone_formula(count: int, rng: np.random.Generator) -> ConeFormula:
    """Check the formulas over random impacts."""
    cases = [
        on_floor(case, ContactLaw.COULOMB, float(rng.uniform(0.05, 1.0)))
        for case in draw_touches(rng, count, RESTITUTIONS)
    ]
    undamped = MujocoSettings(friction=Friction.NATIVE, slip_damping=0.0)
    found = by_mujoco(cases, CONTACTS["one step, native cone"])
    mu = np.array([case.floor.friction for case in cases])
    chi = np.array([case.floor.restitution for case in cases])
    S = first(found, "impulse")
    before, after = first(found, "contact_velocity_before"), first(found, "contact_velocity_after")
    pushed = after[:, :2] + chi[:, None] * before[:, :2]
    newton = -chi * before[:, 2]
    speed = newton + mu * np.hypot(pushed[:, 0], pushed[:, 1])
    gained = first(found, "energy_change")
    work = (1 - chi) * np.sum(S * before, axis=1) / 2
    return ConeFormula(
        normal_speed=spread(np.abs(after[:, 2] - speed) / -before[:, 2]),
        energy=spread(np.abs(gained - work) / (first(found, "energy") - gained)),
        pushed=float((after[:, 2] / newton).max()),
        gains={
            "coulomb": _gains(by_law(cases)),
            "spring, Coulomb's force": _gains(by_mujoco(cases, CONTACTS["spring"])),
            "one step, native cone": _gains(found),
            "spring, native cone": _gains(by_mujoco(cases, CONTACTS["spring, native cone"])),
            "spring, native cone, slip undamped": _gains(by_mujoco(cases, undamped)),
        },
    )


def _gains(impacts: list[Impacts]) -> tuple[float, float]:
    gained = first(impacts, "energy_change")
    part = gained / (first(impacts, "energy") - gained)
    return float(np.mean(part > GAIN)), float(part.max())
