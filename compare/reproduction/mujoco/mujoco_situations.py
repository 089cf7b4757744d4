"""Bodies that rest, are pressed, tumble, hit each other and slide, by MuJoCo's settings for a bounce."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cointoss.coin_mj.bounces.contact import HARDEST, INTEGRATORS, Contact, one_step_solref, spring_solref
from cointoss.coin_mj.bounces.drops import GRAVITY, drops_of
from cointoss.coin_mj.bounces.flight import energy_change
from cointoss.coin_mj.bounces.recipe import SPRING_STEPS, recipe_of
from cointoss.coin_mj.bounces.rest import Rest, rest_of
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.tables import paragraphs, table
from cointoss.compare.reproduction.setups.mujoco_situations import (
    RADIUS,
    RECIPE,
    ball,
    falling_balls,
    hits,
    rod,
    sliding,
    stack,
)
from cointoss.compare.reproduction.setups.study import study

E, STEP = 0.8, 2e-3
"""Restitution; step [s]."""
FALLEN = 0.01
"""Depth of a stack that has fallen [m]."""
STANDING = 1e-7
"""Speed below which a stack stands [m/s]."""
PRESSED = 500.0
"""Force on a body of 1 kg [N]."""
STEPS = (2e-3, 1e-3, 1e-4)
"""Of the flights [s]."""
FALLS = (1e-2, 1e-3)
"""Of the falling balls [s]."""
FRICTION = ((0.1, 0.5), (0.1, 5.0), (0.3, 0.5), (0.3, 5.0), (1.0, 5.0))
"""μ and slip [m/s]."""
OPTIONS = {"MuJoCo's elliptic cone": 'cone="elliptic"', "the recipe": RECIPE}
EXPECTED = {
    "a ball on a ball": (0.1, 0.9),
    "a ball on a hinged rod": (-5 / 13,),
    "three in a row": (0.091, 0.099, 0.81),
}
"""Velocities by Newton's law, impact after impact; of a rod only the ball's [m/s]."""
CONTACTS = {
    "one step": recipe_of(E, STEP),
    "one step, no stiffness": Contact(
        solref=one_step_solref(E, STEP), timestep=STEP, integrator="implicitfast"
    ),
    "spring": recipe_of(E, STEP, SPRING_STEPS),
    "spring, solimp 0.9999": Contact(
        solref=spring_solref(E, STEP, SPRING_STEPS), timestep=STEP, integrator="RK4", solimp=HARDEST
    ),
}


@dataclass(frozen=True)
class Situations:
    """What the study found."""

    errors: dict[str, float]
    """Largest |e' - e| of a ball without weight, by contact."""
    rest: dict[str, Rest]
    """Of a ball under its weight, by contact."""
    pressed: dict[str, Rest]
    """Of 1 kg under `PRESSED` and its weight, by contact."""
    stack: dict[str, tuple[float, float]]
    """Depth [m] and speed of sinking [m/s] of the uppermost of five boxes, by contact."""
    flight: dict[str, list[float]]
    """Change of a tumbling brick's energy, by integrator, for each of `STEPS`."""
    hits: dict[str, list[float]]
    """Velocities after a ball came at 1 m/s [m/s]."""
    friction: dict[str, list[tuple[float, float]]]
    """Largest errors of e and of the slip over the normal speed, by option, for each of `FRICTION`."""
    falling: dict[str, float]
    """Change of energy over itself in 10 s of balls with e = 1, by step."""


def compute(progress: Progress) -> Situations:
    """Measure every situation."""
    errors, rest, pressed, stacked = {}, {}, {}, {}
    for done, (name, contact) in enumerate(CONTACTS.items(), start=1):
        errors[name] = float(np.abs(drops_of(contact).restitutions - E).max())
        rest[name] = rest_of(contact)
        pressed[name] = rest_of(contact, gravity=GRAVITY + PRESSED)
        stacked[name] = stack(contact)
        progress(done, len(CONTACTS))
    contact = CONTACTS["one step"]
    row = {
        "a ball on a ball": ball(0, contact) + ball(3 * RADIUS, contact),
        "a ball on a hinged rod": ball(0, contact) + rod(contact),
        "three in a row": ball(0, contact) + ball(3 * RADIUS, contact) + ball(5 * RADIUS, contact),
    }
    return Situations(
        errors,
        rest,
        pressed,
        stacked,
        flight={name: [energy_change(name, dt) for dt in STEPS] for name in INTEGRATORS},
        hits={name: list(map(float, hits(contact, bodies))) for name, bodies in row.items()},
        friction={
            name: [sliding(contact, mu, slip, option) for mu, slip in FRICTION]
            for name, option in OPTIONS.items()
        },
        falling={f"{1e3 * dt:g} ms": falling_balls(recipe_of(1.0, dt)) for dt in FALLS},
    )


def measures(found: Situations) -> dict[str, Any]:
    """Return what the claims name."""
    recommended = ("one step", "spring")
    exact = found.rest["one step, no stiffness"]
    hit = [
        abs(velocity - expected)
        for name, expectations in EXPECTED.items()
        for velocity, expected in zip(found.hits[name], expectations, strict=False)
    ]
    native, recipe = found.friction.values()
    return {
        "error": found.errors["one step"],
        "moving": max(max(found.rest[name].hop, abs(found.rest[name].sinking)) for name in recommended),
        "depth": _depth_of(found.rest["one step"], "one step", GRAVITY),
        "spring_depth": _depth_of(found.rest["spring"], "spring", GRAVITY),
        "pressed": _depth_of(found.pressed["one step"], "one step", GRAVITY + PRESSED),
        "sinking": exact.sinking / (1e-4 * GRAVITY * STEP / (1 + E)) - 1,
        "hop": found.rest["spring, solimp 0.9999"].hop,
        "stack": abs(found.stack["one step"][1]),
        "sinking_stack": found.stack["one step, no stiffness"][1],
        "implicit": found.flight["implicitfast"][0],
        "rk4": max(abs(change) for change in found.flight["RK4"]),
        "hits": max(hit),
        "native": max(e for e, _ in native),
        "recipe": max(max(pair) for pair in recipe),
        "falling": max(abs(change) for change in found.falling.values()),
    }


def _depth_of(rest: Rest, name: str, gravity: float) -> float:
    """Return the depth over (1 - d) g/k, less 1."""
    contact = CONTACTS[name]
    soft = 1 - float(contact.solimp.split()[0])
    return rest.depth / (soft * gravity / -contact.solref[0]) - 1


def tables(found: Situations) -> str:
    """Return the tables, in Markdown."""
    rest = [
        [
            name,
            f"{found.errors[name]:.0e}",
            _rest(found.rest[name]),
            _rest(found.pressed[name]),
            _stack(*found.stack[name]),
        ]
        for name in CONTACTS
    ]
    flight = [[name, *(f"{change:+.0e}" for change in found.flight[name])] for name in sorted(found.flight)]
    hit = [
        [
            name,
            ", ".join(f"{velocity:.5f}" for velocity in found.hits[name][: len(EXPECTED[name])]),
            ", ".join(f"{velocity:.5f}" for velocity in EXPECTED[name]),
        ]
        for name in EXPECTED
    ]
    friction = [[name, *(f"{e:.0e}, {slip:.0e}" for e, slip in found.friction[name])] for name in OPTIONS]
    return paragraphs(
        f"e = {E:g}, steps of {1e3 * STEP:g} ms; the stack: boxes of 0.1, 0.1, 0.1, 0.1, 10 kg, after 40 s:",
        table(["contact", "error of e", "a ball at rest", "1 kg pressed by 500 N", "top of a stack"], rest),
        "Energy gained in half a second of flight, over itself, by a brick (1:2:4) at ten turns a second:",
        table(["integrator", *(f"{1e3 * dt:g} ms" for dt in STEPS)], flight),
        "A ball that comes at 1 m/s, in one step, e = 0.8; of the rod only the ball's velocity is given:",
        table("situation | velocities after [m/s] | by Newton's law", hit),
        "A ball that slides, in one step: errors of e, and of the slip over the normal speed:",
        table(["cone", *(f"μ = {mu:g}, {slip:g} m/s" for mu, slip in FRICTION)], friction),
        "SimBenchmark's bouncing test, 49 balls of 10 kg with e = 1: change of energy in 10 s, over itself: "
        + ", ".join(f"{change:+.0e} in steps of {name}" for name, change in found.falling.items())
        + ".",
    )


def _rest(rest: Rest) -> str:
    if rest.hop:
        return f"hops by {1e6 * rest.hop:.3g} µm"
    if rest.sinking:
        return f"sinks {1e6 * rest.sinking:.3g} µm/s"
    return f"{1e6 * rest.depth:.3g} µm deep"


def _stack(depth: float, sinking: float) -> str:
    if abs(depth) > FALLEN:
        return "falls over"
    speed = f", sinks {1e6 * sinking:.2g} µm/s" if sinking > STANDING else ""
    return f"{1e3 * depth:.2g} mm deep{speed}"


def draw(found: Situations) -> Figure:
    """Draw the change of energy in flight over the step."""
    picture = Figure(figsize=(6, 3.2))
    axes = picture.subplots()
    for name, changes in found.flight.items():
        axes.loglog([1e3 * dt for dt in STEPS], np.abs(changes), "o-", label=name)
    axes.set(xlabel="step [ms]", ylabel="change of energy in half a second")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    return picture


REPRODUCTION = study(
    __name__, compute, record=Situations, measures=measures, tables=tables, draw={"flight": draw}
)
