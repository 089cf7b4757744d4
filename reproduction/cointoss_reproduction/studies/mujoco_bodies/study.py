"""Restitution of bodies of other mass and shape, of several contacts at once, and of other settings."""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cointoss.study import (
    DEFAULT,
    GRAVITY,
    HARDEST,
    PHASES,
    SPEED,
    SPRING_STEPS,
    Progress,
    one_step_solref,
    paragraphs,
    recipe_of,
    spring_solref,
    table,
)
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.studies.mujoco_bodies.bodies import (
    SHAPES,
    SIZE,
    BodyRebounds,
    Touch,
    rebounds,
    resting_depth,
)

RESTITUTION = 0.8
STEP, FINE = 1e-3, 1e-4
"""Of the simulation [s]."""
MASSES = (0.01, 1.0, 100.0)
"""[kg]."""
WAYS = (0.1, 0.5, 1.5, 3.0)
"""Of a ball in one step, over its radius; speculative contacts act where it goes further than its size."""
FLAT = ("ball", "box flat", "box flat, C off its middle")
MIXED = {
    'body: priority="1"': ('priority="1"', ""),
    "equal priorities, plane by default": ("", ""),
    'the same, body: solmix="1e6"': ('solmix="1e6"', ""),
    'plane: priority="1", by default': ("", 'priority="1"'),
    "equal priorities, plane with the body's settings": ("", "same"),
}
"""Attributes of the two geoms."""


@dataclass(frozen=True)
class BodyErrors:
    """What bodies did that touched anywhere between two steps."""

    error: float
    """Largest |e' - e| of a point."""
    unevenness: float
    """Largest difference of e' between the points of one body."""
    depth: float
    """Greatest, over the speed and the length of the contact."""


@dataclass(frozen=True)
class Bodies:
    """What the study found."""

    shapes: dict[str, dict[str, BodyErrors]]
    """By shape and contact."""
    by_mass: dict[str, float]
    """Largest difference of e', and of the depth over itself, between `MASSES`, by contact."""
    flat: dict[str, dict[str, BodyErrors]]
    """By settings and shape."""
    mixed: dict[str, float]
    """Mean e' of a ball, by the priorities."""
    resting: dict[str, list[float]]
    """Depth over (1 - d) g/k of a ball at rest, by the recommended settings, for each of `MASSES`."""
    speculative: dict[str, list[tuple[float, float]]]
    """Least and largest e' of a ball with speculative contacts, by contact, for each of `WAYS`."""


def touch_of(contact: str, dt: float, **others) -> Touch:
    """Return the settings of "one step" or of a "spring"."""
    if contact == "one step":
        solref, integrator = one_step_solref(RESTITUTION, dt), "implicitfast"
    else:
        solref, integrator = spring_solref(RESTITUTION, dt, SPRING_STEPS), "RK4"
    return Touch(solref=solref, timestep=dt, integrator=integrator, **others)


CONTACTS = {
    f"{contact}, {1e3 * dt:g} ms": (contact, dt) for contact in ("one step", "spring") for dt in (STEP, FINE)
}
FLATS = {
    f"{contact}, solimp {name}, {'with' if exact else 'without'} diagexact": (contact, solimp, exact)
    for contact in ("one step", "spring")
    for name, solimp in (("0.9999", HARDEST), ("by default", DEFAULT))
    for exact in (True, False)
}


def errors_of(found: BodyRebounds, contact: str, dt: float) -> BodyErrors:
    """Return the errors of what was found."""
    length = dt * (SPRING_STEPS if contact == "spring" else 1)
    return BodyErrors(
        error=float(np.abs(found.restitutions - RESTITUTION).max()),
        unevenness=float(np.ptp(found.restitutions, axis=1).max()),
        depth=found.depth / length,
    )


def compute(progress: Progress) -> Bodies:
    """Let every body come down by every contact."""
    shapes, by_mass = {}, {}
    for done, (name, shape) in enumerate(SHAPES.items(), start=1):
        shapes[name] = {
            label: errors_of(rebounds(shape, touch_of(contact, dt)), contact, dt)
            for label, (contact, dt) in CONTACTS.items()
        }
        for contact in ("one step", "spring"):
            light, *heavier = (rebounds(shape, touch_of(contact, FINE, mass=mass)) for mass in MASSES)
            change = max(
                max(float(np.abs(each.restitutions - light.restitutions).max()) for each in heavier),
                max(abs(each.depth / light.depth - 1) for each in heavier),
            )
            by_mass[contact] = max(change, by_mass.get(contact, 0.0))
        progress(done, len(SHAPES))
    flat = {
        label: {
            name: errors_of(
                rebounds(SHAPES[name], touch_of(contact, STEP, solimp=solimp, exact=exact)), contact, STEP
            )
            for name in FLAT
        }
        for label, (contact, solimp, exact) in FLATS.items()
    }
    resting = {
        contact: [_resting(mass, steps) for mass in MASSES]
        for contact, steps in (("one step", None), ("spring", SPRING_STEPS))
    }
    return Bodies(shapes, by_mass, flat, _mixed(), resting, _speculative())


def _mixed() -> dict[str, float]:
    found = {}
    for name, (body, plane) in MIXED.items():
        touch = touch_of("one step", STEP, body=body)
        if plane == "same":
            plane = f'solref="0 {touch.solref[1]!r}" solimp="{HARDEST}"'
        drops = rebounds(SHAPES["ball"], touch_of("one step", STEP, body=body, plane=plane))
        found[name] = float(drops.restitutions.mean())
    return found


def _speculative() -> dict[str, list[tuple[float, float]]]:
    found = {}
    for contact in ("one step", "spring"):
        found[contact] = []
        for way in WAYS:
            touch = touch_of(contact, way * SIZE / SPEED, speculative=True)
            e = rebounds(SHAPES["ball"], touch).restitutions
            found[contact].append((float(e.min()), float(e.max())))
    return found


def _resting(mass: float, steps: int | None) -> float:
    """Return the depth at rest with the recommended settings, over (1 - d) g/k."""
    contact = recipe_of(RESTITUTION, STEP, steps)
    soft = 1 - float(contact.solimp.split()[0])
    return resting_depth(Touch(**asdict(contact), mass=mass)) / (soft * GRAVITY / -contact.solref[0])


def measures(found: Bodies) -> dict[str, Any]:
    """Return what the claims name."""
    shapes = found.shapes.values()
    turning = [found.shapes[name] for name in SHAPES if name != "ball" and "flat" not in name]
    coarse, fine, _, spring = CONTACTS
    orders = [each[coarse].error / each[fine].error for each in turning]
    ball = found.shapes["ball"]
    depths = [each[label].depth / ball[label].depth for label in (fine, spring) for each in shapes]
    hard = [each["box flat"] for label, each in found.flat.items() if "0.9999" in label and "one" in label]
    default = "one step, solimp by default, {} diagexact"
    best, equal, weighted, plane, same = found.mixed.values()
    return {
        "by_mass": max(found.by_mass.values()),
        "depth": max(abs(ratio - 1) for ratio in depths),
        "depths": len(depths),
        "orders": (min(orders), max(orders)),
        "hard": max(each.error for each in hard),
        "uneven": max(each.unevenness for each in hard),
        "inexact": found.flat[default.format("without")]["box flat"].error,
        "exact": found.flat[default.format("with")]["box flat"].error,
        "twice": 2 * found.flat[default.format("without")]["box flat"].error,
        "mixed": [abs(e - RESTITUTION) for e in (best, equal, weighted, same)],
        "plane": plane - np.exp(-2),
        "one_step": max(abs(e - RESTITUTION) for pair in found.speculative["one step"] for e in pair),
        "spring": min(RESTITUTION - most for _, most in found.speculative["spring"][-2:]),
        "resting": max(abs(part - 1) for parts in found.resting.values() for part in parts),
    }


def tables(found: Bodies) -> str:
    """Return the tables, in Markdown."""
    shapes = [
        [
            name,
            *(f"{each[label].error:.0e}" for label in CONTACTS),
            *(f"{each[label].depth:.4f}" for label in list(CONTACTS)[1::2]),
        ]
        for name, each in found.shapes.items()
    ]
    flat = [
        [label, *(f"{each[name].error:.0e}, {each[name].unevenness:.0e}" for name in FLAT)]
        for label, each in found.flat.items()
    ]
    speculative = [
        [f"{contact}: e' from, to", *(f"{least:.3f}, {most:.3f}" for least, most in each)]
        for contact, each in found.speculative.items()
    ]
    resting = "; ".join(
        f"{contact} {', '.join(f'{part:.5f}' for part in parts)}" for contact, parts in found.resting.items()
    )
    masses = ", ".join(f"{mass:g}" for mass in MASSES)
    depths = "depth, one step [v dt]", f"depth, spring [v × {SPRING_STEPS} dt]"
    return paragraphs(
        f"Bodies of about {1e2 * SIZE:g} cm that come down at {SPEED:g} m/s without spin and weight, "
        f"{PHASES} touches anywhere between two steps; one step without its stiffness, a spring of "
        f"{SPRING_STEPS} steps with solimp 0.9999:",
        table(["error of e = 0.8", *CONTACTS, *depths], shapes),
        f"Largest change of e' and of the depth, over itself, with masses of {masses} kg: "
        + ", ".join(f"{contact} {change:.0e}" for contact, change in found.by_mass.items())
        + f". At rest, with the recommended settings, these balls lie this many (1 - d) g/k deep: {resting}.",
        f"Several contacts at once, {1e3 * STEP:g} ms:",
        table(["error of e = 0.8, unevenness", *FLAT], flat),
        table("a ball, one step, e = 0.8 | e'", [[name, f"{e:.4f}"] for name, e in found.mixed.items()]),
        table(
            ["a ball with speculative contacts that goes, in a step", *(f"{way:g} r" for way in WAYS)],
            speculative,
        ),
    )


def draw(found: Bodies) -> Figure:
    """Draw the errors of the bodies by contact."""
    picture = Figure(figsize=(8, 3.2))
    axes = picture.subplots()
    rows = np.arange(len(found.shapes))
    for number, label in enumerate(CONTACTS):
        errors = [max(each[label].error, 1e-12) for each in found.shapes.values()]
        axes.barh(rows + 0.2 * (number - 1.5), errors, height=0.18, left=1e-13, label=label)
    axes.set_yticks(rows, list(found.shapes))
    axes.invert_yaxis()
    axes.set(xscale="log", xlim=(1e-12, 1), xlabel="largest error of e = 0.8")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    return picture


REPRODUCTION = recorded(
    __name__, compute, record=Bodies, measures=measures, tables=tables, draw={"errors": draw}
)
