"""How MuJoCo's contacts tend to the hard limit: errors of single impacts over every setting."""

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cointoss.coin_mj import MujocoSettings
from cointoss.coin_mj.bounces.contact import DEFAULT, HARDEST, one_step_solref, spring_solref
from cointoss.coin_mj.bounces.drops import restitutions_of_a_ball
from cointoss.compare.output.progress import Progress, stepping
from cointoss.compare.output.tables import paragraphs, table
from cointoss.compare.reproduction.setups.mujoco_impacts import draw_touches, restitution_errors
from cointoss.compare.reproduction.setups.mujoco_study import (
    IMPULSE,
    LIMIT,
    RUBBED,
    ConeFormula,
    NativeCone,
    Spread,
    StiffnessErrors,
    cone_formula,
    default_errors,
    draw_spreads,
    native_cone,
    over_kinds,
    over_steps,
    over_stiffness,
    over_tilt,
    smooth_and_rubbed,
    spread,
)
from cointoss.compare.reproduction.setups.mujoco_study import (
    RESTITUTIONS as DRAWN,
)
from cointoss.compare.reproduction.setups.study import study

SEED = 4
STIFFNESSES = tuple(10.0**power for power in range(6, 17))
STEPS, MOST_STEPS = (10, 20, 40, 80, 160, 320, 640), 2000
RESTITUTIONS = (0.01, 0.03, 0.1, 0.3, 0.5, 0.8, 1.0)
FRICTIONS = (0.0, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0)
SPINS = (3.0, 10.0, 30.0, 100.0, 300.0)
TILTS = (5.0, 20.0, 45.0, 70.0, 85.0)
CONE_TILTS, CONE_RESTITUTION = (20.0, 45.0, 70.0), 0.5
INTEGRATORS = ("Euler", "implicitfast", "RK4")
SPIN, TILT = f"spin up to [rad/s], μ = {RUBBED:g}", f"tilt [deg], μ = {RUBBED:g}"
"""What is varied."""
STYLES = ("o-", "s--", "^:", "x-", "d-.", "v-.")
USERS_STEP = 1e-3
"""Of the table for `mj_step` [s]; the restitution does not depend on it."""
USERS_RESTITUTIONS, USERS_STEPS = (0.1, 0.3, 0.5, 0.8, 1.0), (10, 20, 40, 80, 160)


@dataclass(frozen=True, kw_only=True)
class ImpactErrors:
    """All parts of the study; see `cointoss.compare.reproduction.setups.mujoco_study` for each."""

    kinds: dict[str, dict[str, Spread]]
    stiffness: dict[str, StiffnessErrors]
    steps: dict[str, dict[int, float]]
    """Median change of the impulse against that of `MOST_STEPS`, by floor and by the steps in a contact."""
    restitution: dict[float, Spread]
    """|χ' - χ|, χ' the restitution that the default spring gives on a smooth floor, by χ."""
    friction: dict[float, Spread]
    spin: dict[float, Spread]
    tilt: dict[float, Spread]
    cone: NativeCone
    formula: ConeFormula
    users: dict[str, list[float]]
    """Largest |e' - e| of a ball stepped by `mj_step`, for each of `USERS_RESTITUTIONS`, by contact."""


def compute(
    progress: Progress, impacts: int = 24, kinds: int = 150, cells: int = 13, seed: int = SEED
) -> ImpactErrors:
    """Return the errors of all parts of the study, of so many impacts each."""
    rng = np.random.default_rng(seed)
    floors = smooth_and_rubbed(draw_touches(rng, impacts, (0.3, 1.0)))
    half = max(4, impacts // 2)
    axis = np.linspace(0, 1, cells).tolist()
    step = stepping(progress, len(fields(ImpactErrors)))

    def by_restitution(chi: float) -> Spread:
        return spread(restitution_errors(draw_touches(rng, half, (chi, chi)), MujocoSettings()))

    return ImpactErrors(
        kinds=step(over_kinds(kinds, rng)),
        stiffness=step({name: over_stiffness(cases, STIFFNESSES) for name, cases in floors.items()}),
        steps=step({name: over_steps(cases[:half], STEPS, MOST_STEPS) for name, cases in floors.items()}),
        restitution=step({chi: by_restitution(chi) for chi in RESTITUTIONS}),
        friction=step(
            {
                mu: default_errors(touches, mu)
                for touches in [draw_touches(rng, impacts, DRAWN)]
                for mu in FRICTIONS
            }
        ),
        spin=step({spin: default_errors(draw_touches(rng, half, DRAWN, spin)) for spin in SPINS}),
        tilt=step(over_tilt(half, TILTS, rng)),
        cone=step(native_cone(CONE_RESTITUTION, CONE_TILTS, axis, [2 * part for part in axis])),
        formula=step(cone_formula(kinds, rng)),
        users=step(_users()),
    )


def _users() -> dict[str, list[float]]:
    def worst(e: float, solref: tuple[float, float], integrator: str, solimp: str = HARDEST) -> float:
        return float(np.abs(restitutions_of_a_ball(solref, USERS_STEP, integrator, solimp) - e).max())

    answers = {
        f"one step, {integrator}": [
            worst(e, one_step_solref(e, USERS_STEP), integrator) for e in USERS_RESTITUTIONS
        ]
        for integrator in INTEGRATORS
    }
    answers["one step, Euler, MuJoCo's default solimp"] = [
        worst(e, one_step_solref(e, USERS_STEP), "Euler", DEFAULT) for e in USERS_RESTITUTIONS
    ]
    for integrator in (INTEGRATORS[0], INTEGRATORS[-1]):
        for n in USERS_STEPS:
            answers[f"spring of {n} steps, {integrator}"] = [
                worst(e, spring_solref(e, USERS_STEP, n), integrator) for e in USERS_RESTITUTIONS
            ]
    return answers


def measures(found: ImpactErrors) -> dict[str, Any]:
    """Return what the claims name."""
    explicit = [fit for name in ("spring", "one step") for fit in found.kinds[name].values()]
    native = [fit for name, kinds in found.kinds.items() if "cone" in name for fit in kinds.values()]
    smooth, orders = found.stiffness["smooth"], [part.order for part in found.stiffness.values()]
    return {
        "median": max(fit.median for fit in explicit),
        "worst": max(fit.worst for fit in explicit),
        "native": min(fit.median for fit in native),
        "orders": (min(orders), max(orders)),
        "nearer": max(
            limit / error
            for k, error, limit in zip(
                smooth.stiffness, smooth.errors[IMPULSE], smooth.errors[LIMIT], strict=True
            )
            if k <= 1e12
        ),
        "steps": max(part[STEPS[0]] for part in found.steps.values()),
        "formula": found.formula,
        "gain": found.formula.gains["one step, native cone"][0],
        "one_step": max(found.users["one step, Euler"]),
    }


def tables(found: ImpactErrors) -> str:
    """Return the tables, in Markdown."""
    kinds = list(next(iter(found.kinds.values())))
    of_kinds = [[name, *(_of_kind(fits.get(kind)) for kind in kinds)] for name, fits in found.kinds.items()]
    parts = ["Errors of impulses by kind of impact, median (worst; number):"]
    parts.append(table(["contact", *kinds], of_kinds))
    for name, part in found.stiffness.items():
        rows = zip(part.stiffness, *part.errors.values(), strict=True)
        parts += [
            f"Median errors over the stiffness, {name}; order {part.order:.2f}:",
            table(["k [1/s²]", *part.errors], [[f"{k:.0e}", *map(_short, errors)] for k, *errors in rows]),
        ]
    for name, part in found.steps.items():
        rows = [[str(n), _short(error)] for n, error in part.items()]
        parts += [f"Change of the impulse against {MOST_STEPS} steps, {name}:", table("steps | median", rows)]
    parts += ["Restitution asked for, and |obtained - asked|, smooth:", _spreads("χ", found.restitution)]
    for name, spreads in {"μ": found.friction, SPIN: found.spin, TILT: found.tilt}.items():
        parts += ["Error of the impulse at the default settings:", _spreads(name, spreads)]
    users = [[name, *(f"{error:.0e}" for error in errors)] for name, errors in found.users.items()]
    return paragraphs(
        *parts,
        *_cone_parts(found),
        "Largest |e' - e| of a ball, mj_step with a fixed step:",
        table(["contact", *(f"e = {e:g}" for e in USERS_RESTITUTIONS)], users),
    )


def _of_kind(fit: Spread | None) -> str:
    return f"{fit.median:.1e} ({fit.worst:.1e}; {fit.number})" if fit else "as frictionless"


def _short(error: float) -> str:
    return f"{error:.1e}"


def _spreads(name: str, spreads: dict[float, Spread]) -> str:
    rows = [[f"{value:g}", _short(fit.median), _short(fit.worst)] for value, fit in spreads.items()]
    return table([name, "median", "worst"], rows)


def _cone_parts(found: ImpactErrors) -> list[str]:
    cone, formula = found.cone, found.formula
    rows = []
    for tilt, plane in zip(cone.tilts, cone.obtained, strict=True):
        slip, mu = divmod(int(plane.argmax()), plane.shape[1])
        at = f"{cone.frictions[mu]:.2f}", f"{cone.slips[slip]:.2f}"
        rows.append([f"{tilt:g}", f"{plane.max():.3f}", *at])
    return [
        f"Largest restitution of the spring with MuJoCo's native cone, {cone.restitution:g} asked for:",
        table("tilt [deg] | restitution | at μ | at slip/normal speed", rows),
        "In one step with the native cone:",
        f"- v_n' = χ |v_n| + μ |v_t' + χ v_t| holds to {formula.normal_speed.worst:.0e} |v_n|\n"
        f"- ΔE = (1 - χ) S · v_A/2 holds to {formula.energy.worst:.0e} E\n"
        f"- v_n' reaches {formula.pushed:.2f} χ |v_n|",
        table(
            "contact | impacts that gain energy | largest change over the energy before",
            [[name, f"{part:.0%}", f"{largest:+.1e}"] for name, (part, largest) in formula.gains.items()],
        ),
    ]


def draw_convergence(found: ImpactErrors) -> Figure:
    """Draw errors over the stiffness, over the steps, and over restitution, friction, spin and tilt."""
    picture = Figure(figsize=(12, 7.4))
    axes = picture.subplots(2, 3)
    for place, (name, part) in zip(axes[0], found.stiffness.items(), strict=False):
        for (label, column), style in zip(part.errors.items(), STYLES, strict=True):
            place.loglog(part.stiffness, column, style, label=label, markersize=4)
        place.set(title=f"{name}: order {part.order:.2f}", xlabel="stiffness k [1/s²]", ylabel="median error")
    picture.legend(*axes[0][0].get_legend_handles_labels(), loc="outside upper left", ncols=6, fontsize=8)
    for name, part in found.steps.items():
        axes[0][2].loglog(list(part), list(part.values()), "o-", label=name)
    axes[0][2].set(title=f"against {MOST_STEPS} steps", xlabel="steps in a contact")
    axes[0][2].set_ylabel("median change of the impulse")
    axes[0][2].legend()
    panels = (found.friction, "friction μ", "linear"), (found.spin, SPIN, "log"), (found.tilt, TILT, "linear")
    for place, (spreads, label, scale) in zip(axes[1], panels, strict=True):
        draw_spreads(place, spreads)
        place.set(xscale=scale, yscale="log", ylim=(1e-6, 2e-3), title="default settings")
        place.set(xlabel=label, ylabel="error of the impulse")
    picture.legend(*axes[1][0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return picture


def draw_cone(found: ImpactErrors) -> Figure:
    """Draw the restitution that MuJoCo's native friction gives."""
    cone = found.cone
    picture = Figure(figsize=(12, 3.6))
    axes = picture.subplots(1, len(cone.tilts), sharey=True)
    style: Any = {"vmin": cone.restitution, "vmax": cone.obtained.max(), "cmap": "viridis"}
    meshes = []
    for place, tilt, plane in zip(axes, cone.tilts, cone.obtained, strict=True):
        meshes.append(place.pcolormesh(cone.frictions, cone.slips, plane, shading="nearest", **style))
        place.set(title=f"tilt {tilt:g}°", xlabel="friction μ")
    axes[0].set_ylabel("slip over normal speed")
    picture.colorbar(meshes[0], ax=axes, label=f"restitution; {cone.restitution:g} asked for")
    return picture


REPRODUCTION = study(
    __name__,
    compute,
    measures=measures,
    tables=tables,
    draw={"convergence": draw_convergence, "native-cone": draw_cone},
)
