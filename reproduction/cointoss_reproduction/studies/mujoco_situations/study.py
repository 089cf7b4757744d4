"""Bodies that rest, are pressed, tumble, hit each other and slide, by MuJoCo's settings for a bounce."""

from collections.abc import Callable
from dataclasses import asdict, replace
from functools import partial

import numpy as np
import pandas as pd

from cointoss_bounce import PairBounce
from cointoss_bounce.contact import (
    GRAVITY,
    HARDEST,
    INTEGRATORS,
    ContactSettings,
    one_step_solref,
    spring_solref,
)
from cointoss_bounce.drops import SPEED, drops_of
from cointoss_bounce.flight import energy_change
from cointoss_bounce.pair import SPEEDS
from cointoss_bounce.recipe import SPRING_STEPS, recipe_of
from cointoss_bounce.rest import rest_of
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.mujoco_models import RECIPE
from cointoss_reproduction.studies.mujoco_situations.bodies import (
    RADIUS,
    ball,
    falling_balls,
    hits,
    rod,
    sliding,
    stack,
)
from cointoss_reproduction.studies.mujoco_situations.failures import (
    BALL,
    FALLING,
    FALLS,
    creep,
    cylinder,
    falls_through,
    leg,
)

E, STEP = 0.8, 2e-3
"""Restitution; step [s]."""
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
ONE = CONTACTS["one step"]
FORCES = {"its weight": 0.0, "500 N": 500.0}
"""The forces on a body of 1 kg, beside its weight [N]."""
STACKS = {"as printed": (1, True), "with condim 3": (3, True), "and no diagexact": (3, False)}
"""condim of the printed line, and whether the flag diagexact is set, of stacks."""
HITS = {
    "a ball on a ball": (ball(0, ONE) + ball(3 * RADIUS, ONE), (0.1, 0.9)),
    "a ball on a hinged rod": (ball(0, ONE) + rod(ONE), (-5 / 13,)),
    "three in a row": (
        ball(0, ONE) + ball(3 * RADIUS, ONE) + ball(5 * RADIUS, ONE),
        (0.091, 0.099, 0.81),
    ),
}
"""Bodies, and their velocities by Newton's law, impact after impact; of a rod only the ball's [m/s]."""
RUBBED = {
    f"μ = {mu:g}, {slip:g} m/s": (mu, slip)
    for mu, slip in ((0.1, 0.5), (0.1, 5.0), (0.3, 0.5), (0.3, 5.0), (1.0, 5.0))
}
"""μ and slip [m/s]."""
FLOORS = {"a plane": None} | {f"a box of {1e3 * thick:g} mm": thick for thick in (3e-3, 30e-3, 96e-3, 98e-3)}
"""The floors, and their thicknesses [m]."""
TURNED = {
    "leg": leg,
    "cylinder on the middle": partial(cylinder, beside=0),
    "cylinder beside it": partial(cylinder, beside=0.03),
}
"""A leg on a plane, a cylinder on a ball of 10 cm, its axis beside the ball's middle [m]."""
KINDS = {
    f"{'one step' if steps is None else 'spring'}, {1e3 * dt:g} ms": recipe_of(E, dt, steps)
    for steps, dt in (
        (None, 2e-3),
        (None, 2e-4),
        (SPRING_STEPS, 2e-3),
        (SPRING_STEPS, 2e-4),
        (SPRING_STEPS, 2e-5),
    )
}
"""Contacts of bodies that turn."""
HOLDS = {
    "pyramidal cone": ("", False),
    "elliptic": ('cone="elliptic"', False),
    "elliptic, impratio 100": ('cone="elliptic" impratio="100"', False),
    "the same, by pairs": ('cone="elliptic" impratio="100"', True),
}
"""Options, and whether pairs with a damping of the slip hold what is pinched."""


def bounced(bounced: ContactSettings) -> dict[str, float]:
    """Drop a ball without weight."""
    return {"error": float(np.abs(drops_of(bounced).restitutions - E).max())}


def lain(lying: ContactSettings, force: float) -> dict[str, float | None]:
    """Lay a ball down; its depth also over (1 - d) g/k."""
    rest, stiffness = rest_of(replace(lying, gravity=GRAVITY + force)), -lying.solref[0]
    soft = 1 - float(lying.solimp.split()[0])
    over = rest.depth / (soft * (GRAVITY + force) / stiffness) if stiffness else None
    return {**asdict(rest), "over": over}


def stacked(stacked: ContactSettings, stack_of: tuple[int, bool]) -> dict[str, float]:
    """Stack five boxes."""
    condim, exact = stack_of
    top, settling = stack(replace(stacked, exact=exact), condim)
    return {"top": top, "settling": settling}


def flown(integrator: str, step: float) -> dict[str, float]:
    """Let a brick tumble."""
    return {"change": energy_change(integrator, step)}


def hit(hit: tuple[str, tuple[float, ...]]) -> pd.DataFrame:
    """Let a ball hit others."""
    bodies, expected = hit
    return pd.DataFrame({"velocity": hits(ONE, bodies)[: len(expected)], "expected": expected})


def slid(cone: str, rubbed: tuple[float, float]) -> pd.DataFrame:
    """Let a ball slide as it comes down."""
    return pd.DataFrame({"of": ("e", "slip"), "error": sliding(ONE, *rubbed, cone)})


def fallen(fallen: float) -> dict[str, float]:
    """Let balls with e = 1 fall, in steps of a length [s]."""
    return {"change": falling_balls(recipe_of(1.0, fallen))}


def went(contact: str, floor: float | None) -> dict[str, int]:
    """Let balls fall on a floor, which a contact passes that is deeper than half of both."""
    settings = CONTACTS[contact]
    passes = floor is not None and drops_of(settings).depth / SPEED * FALLING > BALL + floor / 2
    return {"through": falls_through(settings, floor), "expected": FALLS if passes else 0}


def turned(turned: Callable[[ContactSettings], PairBounce], kind: ContactSettings) -> pd.DataFrame:
    """Let a body bounce that turns in its contact; means over phases of a step."""
    found = turned(kind)
    means = {"e": found.restitutions.mean(axis=1), "kept": found.energy_kept.mean(axis=1)}
    return pd.DataFrame({"speed": SPEEDS, **means})


def held(held: ContactSettings, hold: tuple[str, bool]) -> dict[str, float | None]:
    """Pinch a box."""
    return {"creep": creep(held, *hold)}


REPRODUCTION = study(
    __name__,
    Cells(bounced, {"bounced": CONTACTS}),
    Cells(lain, {"lying": CONTACTS, "force": FORCES}),
    Cells(stacked, {"stacked": CONTACTS, "stack_of": STACKS}),
    Cells(flown, {"integrator": INTEGRATORS, "step": (2e-3, 1e-3, 1e-4)}),
    Cells(hit, {"hit": HITS}),
    Cells(slid, {"cone": {"elliptic cone": 'cone="elliptic"', "the recipe": RECIPE}, "rubbed": RUBBED}),
    Cells(fallen, {"fallen": {"10 ms": 1e-2, "1 ms": 1e-3}}),
    Cells(went, {"contact": ("one step", "spring"), "floor": FLOORS}),
    Cells(turned, {"turned": TURNED, "kind": KINDS}),
    Cells(held, {"held": CONTACTS, "hold": HOLDS}),
)
