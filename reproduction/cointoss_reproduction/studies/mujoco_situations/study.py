"""Bodies that rest, are pressed, tumble, hit each other and slide, by MuJoCo's settings for a bounce."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cointoss.coin_mj import PairBounce
from cointoss.study import (
    GRAVITY,
    HARDEST,
    INTEGRATORS,
    SPEED,
    SPEEDS,
    SPRING_STEPS,
    ContactSettings,
    Progress,
    Rest,
    drops_of,
    energy_change,
    one_step_solref,
    paragraphs,
    recipe_of,
    rest_of,
    spring_solref,
    table,
)
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.setups.mujoco_situations import (
    RADIUS,
    RECIPE,
    ball,
    falling_balls,
    hits,
    rod,
    sliding,
    stack,
)
from cointoss_reproduction.studies.mujoco_situations.failures import (
    BALL,
    FALLS,
    creep,
    cylinder,
    falls_through,
    leg,
)
from cointoss_reproduction.studies.mujoco_situations.failures import SPEED as FALLING

E, STEP = 0.8, 2e-3
"""Restitution; step [s]."""
FALLEN = 0.01
"""Depth of a stack that has fallen [m]."""
STANDING = 1e-7
"""Speed below which a stack stands [m/s]."""
STACKS = {"as printed": (1, True), 'with condim="3"': (3, True), "and no diagexact": (3, False)}
"""condim of the printed line, and whether the flag diagexact is set, of stacks."""
PRESSED = 500.0
"""Force on a body of 1 kg [N]."""
STEPS = (2e-3, 1e-3, 1e-4)
"""Of the flights [s]."""
STEPS_OF_FALLS = (1e-2, 1e-3)
"""Of the falling balls [s]."""
RECOMMENDED = ("one step", "spring")
FRICTION = ((0.1, 0.5), (0.1, 5.0), (0.3, 0.5), (0.3, 5.0), (1.0, 5.0))
"""μ and slip [m/s]."""
OPTIONS = {"MuJoCo's elliptic cone": 'cone="elliptic"', "the recipe": RECIPE}
EXPECTED = {
    "a ball on a ball": (0.1, 0.9),
    "a ball on a hinged rod": (-5 / 13,),
    "three in a row": (0.091, 0.099, 0.81),
}
"""Velocities by Newton's law, impact after impact; of a rod only the ball's [m/s]."""
FLOORS = (None, 3e-3, 30e-3, 96e-3, 98e-3)
"""Thicknesses of floors that are boxes [m]; None: a plane."""
TURNING = ((None, 2e-3), (None, 2e-4), (SPRING_STEPS, 2e-3), (SPRING_STEPS, 2e-4), (SPRING_STEPS, 2e-5))
"""Steps in the contact of a spring, None by one step, and the step [s], of bodies that turn."""
BESIDE = 0.03
"""How far the axis of a cylinder passes beside the middle of a ball of 10 cm [m]."""
HELD = {
    "pyramidal cone": ("", False),
    "elliptic": ('cone="elliptic"', False),
    "elliptic, impratio 100": ('cone="elliptic" impratio="100"', False),
    "the same, by pairs": ('cone="elliptic" impratio="100"', True),
}
"""Options, and whether pairs with a damping of the slip hold what is pinched."""
CONTACTS = {
    "one step": recipe_of(E, STEP),
    "one step, no stiffness": ContactSettings(
        solref=one_step_solref(E, STEP), timestep=STEP, integrator="implicitfast"
    ),
    "spring": recipe_of(E, STEP, SPRING_STEPS),
    "spring, solimp 0.9999": ContactSettings(
        solref=spring_solref(E, STEP, SPRING_STEPS), timestep=STEP, integrator="RK4", solimp=HARDEST
    ),
}

Means = tuple[float | None, float | None]
"""Restitution of the point that touches and share of energy kept, means over phases; None where unknown."""


@dataclass(frozen=True)
class Situations:
    """What the study found."""

    errors: dict[str, float]
    """Largest |e' - e| of a ball without weight, by contact."""
    rest: dict[str, Rest]
    """Of a ball under its weight, by contact."""
    pressed: dict[str, Rest]
    """Of 1 kg under `PRESSED` and its weight, by contact."""
    stack: dict[str, list[tuple[float, float]]]
    """Depth [m] and speed of sinking [m/s] of the uppermost of five boxes, for each of `STACKS`."""
    flight: dict[str, list[float]]
    """Change of a tumbling brick's energy, by integrator, for each of `STEPS`."""
    hits: dict[str, list[float]]
    """Velocities after a ball came at 1 m/s [m/s]."""
    friction: dict[str, list[tuple[float, float]]]
    """Largest errors of e and of the slip over the normal speed, by option, for each of `FRICTION`."""
    falling: dict[str, float]
    """Change of energy over itself in 10 s of balls with e = 1, by step."""
    floors: dict[str, list[int]]
    """Balls of `FALLS` that go through each of `FLOORS`, by contact."""
    depths: dict[str, float]
    """Of a ball's contact at 1 m/s [m], by contact."""
    legs: dict[str, list[Means]]
    """Of a hopper's leg at each of `SPEEDS`, by contact and step."""
    cylinders: dict[str, list[list[Means]]]
    """Of a cylinder on a ball: on its middle, and `BESIDE` it."""
    creeping: dict[str, list[float | None]]
    """Speed at which a pinched box creeps [m/s] for each of `HELD`; None where it falls; by contact."""


def compute(progress: Progress) -> Situations:
    """Measure every situation."""
    errors, rest, pressed, stacked = {}, {}, {}, {}
    for done, (name, contact) in enumerate(CONTACTS.items(), start=1):
        errors[name] = float(np.abs(drops_of(contact).restitutions - E).max())
        rest[name] = rest_of(contact)
        pressed[name] = rest_of(contact, gravity=GRAVITY + PRESSED)
        stacked[name] = [stack(replace(contact, exact=exact), condim) for condim, exact in STACKS.values()]
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
        falling={f"{1e3 * dt:g} ms": falling_balls(recipe_of(1.0, dt)) for dt in STEPS_OF_FALLS},
        floors={name: [falls_through(CONTACTS[name], thick) for thick in FLOORS] for name in RECOMMENDED},
        depths={name: drops_of(CONTACTS[name]).depth / SPEED for name in RECOMMENDED},
        legs={_turning(*kind): _means(leg(recipe_of(E, kind[1], kind[0]))) for kind in TURNING},
        cylinders={
            _turning(*kind): [_means(cylinder(recipe_of(E, kind[1], kind[0]), side)) for side in (0, BESIDE)]
            for kind in TURNING
        },
        creeping={
            name: [creep(contact, option, pair) for option, pair in HELD.values()]
            for name, contact in CONTACTS.items()
        },
    )


def _turning(steps: int | None, dt: float) -> str:
    return f"{'one step' if steps is None else 'spring'}, {1e3 * dt:g} ms"


def _means(found: PairBounce) -> list[Means]:
    columns = (found.restitutions.mean(axis=1), found.energy_kept.mean(axis=1))
    return [(_known(e), _known(kept)) for e, kept in zip(*columns, strict=True)]


def _known(number: float) -> float | None:
    return None if np.isnan(number) else float(number)


def _restitutions(means: list[Means]) -> list[float]:
    """Return the restitutions that are known."""
    return [e for e, _ in means if e is not None]


def _kept(means: list[Means]) -> list[float]:
    """Return the shares of energy that are known."""
    return [kept for _, kept in means if kept is not None]


def measures(found: Situations) -> dict[str, Any]:
    """Return what the claims name."""
    exact = found.rest["one step, no stiffness"]
    hit = [
        abs(velocity - expected)
        for name, expectations in EXPECTED.items()
        for velocity, expected in zip(found.hits[name], expectations, strict=False)
    ]
    native, recipe = found.friction.values()
    return {
        "error": found.errors["one step"],
        "moving": max(max(found.rest[name].hop, abs(found.rest[name].sinking)) for name in RECOMMENDED),
        "depth": _depth_of(found.rest["one step"], "one step", GRAVITY),
        "spring_depth": _depth_of(found.rest["spring"], "spring", GRAVITY),
        "pressed": _depth_of(found.pressed["one step"], "one step", GRAVITY + PRESSED),
        "sinking": exact.sinking / (1e-4 * GRAVITY * STEP / (1 + E)) - 1,
        "hop": found.rest["spring, solimp 0.9999"].hop,
        "fallen_stack": min(depth for depth, _ in (found.stack[name][0] for name in RECOMMENDED)),
        "stack": abs(found.stack["one step"][1][1]),
        "stack_depth": max(depth for depth, _ in found.stack["one step"][1:]),
        "sinking_stack": found.stack["one step, no stiffness"][2][1],
        "implicit": found.flight["implicitfast"][0],
        "rk4": max(abs(change) for change in found.flight["RK4"]),
        "hits": max(hit),
        "native": max(e for e, _ in native),
        "recipe": max(max(pair) for pair in recipe),
        "falling": max(abs(change) for change in found.falling.values()),
        "wrong_floors": sum(
            went != (FALLS if thick is not None and found.depths[name] * FALLING > BALL + thick / 2 else 0)
            for name in RECOMMENDED
            for thick, went in zip(FLOORS, found.floors[name], strict=True)
        ),
        "went": sum(found.floors["spring"]),
        "middle": max(
            abs(e - E) for on_middle, _ in found.cylinders.values() for e in _restitutions(on_middle)
        ),
        "turned": max(e for _, beside in found.cylinders.values() for e in _restitutions(beside)),
        "leg_loses": min(_kept(found.legs["spring, 2 ms"])),
        "leg_keeps": max(_kept(found.legs["spring, 2 ms"])),
        "most_kept": max(
            kept
            for means in (*found.legs.values(), *(beside for _, beside in found.cylinders.values()))
            for kept in _kept(means)
        ),
        "turning": max(
            abs(e - E)
            for values in (found.legs["spring, 0.02 ms"], found.cylinders["spring, 0.02 ms"][1])
            for e in _restitutions(values)[:5]
        ),
        "leg_energy": max(abs(kept - E**2) for kept in _kept(found.legs["spring, 0.02 ms"])[:5]),
        "creep": found.creeping["one step"][2],
        "creep_pair": found.creeping["spring"][3],
        "fallen": sum(speed is None for speed in found.creeping["spring"]),
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
            *(_stack(*depth) for depth in found.stack[name]),
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
    floors = [[name, *map(str, found.floors[name])] for name in RECOMMENDED]
    turning = [
        [f"{body}: {kind}", *(_bounce(*means) for means in values)]
        for body, kinds in (
            ("leg", found.legs),
            ("cylinder", {kind: values[1] for kind, values in found.cylinders.items()}),
        )
        for kind, values in kinds.items()
    ]
    on_middle = [e for means, _ in found.cylinders.values() for e in _restitutions(means)]
    creeping = [
        [name, *("falls out" if v is None else f"{1e6 * v:.2g} µm/s" for v in found.creeping[name])]
        for name in CONTACTS
    ]
    friction = [[name, *(f"{e:.0e}, {slip:.0e}" for e, slip in found.friction[name])] for name in OPTIONS]
    return paragraphs(
        f"e = {E:g}, steps of {1e3 * STEP:g} ms; the top of a stack of boxes of 0.1, 0.1, 0.1, 0.1, 10 kg, "
        "after 40 s, with the printed line and with friction:",
        table(
            [
                "contact",
                "error of e",
                "a ball at rest",
                "1 kg pressed by 500 N",
                *(f"a stack {name}" for name in STACKS),
            ],
            rest,
        ),
        "Energy gained in half a second of flight, over itself, by a brick (1:2:4) at ten turns a second:",
        table(["integrator", *(f"{1e3 * dt:g} ms" for dt in STEPS)], flight),
        "A ball that comes at 1 m/s, in one step, e = 0.8; of the rod only the ball's velocity is given:",
        table("situation | velocities after [m/s] | by Newton's law", hit),
        "A ball that slides, in one step: errors of e, and of the slip over the normal speed:",
        table(["cone", *(f"μ = {mu:g}, {slip:g} m/s" for mu, slip in FRICTION)], friction),
        f"Of {FALLS} balls of {1e3 * BALL:g} mm at {FALLING:g} m/s, as many go through a floor that is",
        table(["contact", *("a plane" if t is None else f"a box of {1e3 * t:g} mm" for t in FLOORS)], floors),
        "Bodies that turn in a contact, in the mean over phases of a step: a hopper's leg on a plane, and a "
        f"cylinder that lands flat on a ball of 10 cm, {1e3 * BESIDE:g} mm beside its middle (on its middle: "
        f"{min(on_middle):.3f} to {max(on_middle):.3f}); e' of the point that touched, and the share of the "
        f"kinetic energy that is kept, {100 * E**2:.0f} % of a leg by Newton's law; a dash: the point's "
        "speed changes too much in a step:",
        table(["e', energy", *(f"{speed:g} m/s" for speed in SPEEDS)], turning),
        "A box of 0.1 kg, pinched with 20 N by two plates (μ = 1), creeps down:",
        table(["contact", *HELD], creeping),
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


def _bounce(e: float | None, kept: float | None) -> str:
    shown = "-" if e is None else f"{e:.3f}"
    return shown + ("" if kept is None else f", {100 * kept:.0f} %")


def _stack(depth: float, sinking: float) -> str:
    if abs(depth) > FALLEN:
        return "falls"
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


REPRODUCTION = recorded(
    __name__, compute, record=Situations, measures=measures, tables=tables, draw={"flight": draw}
)
