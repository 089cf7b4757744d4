"""Restitution of bodies of other mass and shape, of several contacts at once, and of other settings."""

from dataclasses import asdict
from typing import Any

import numpy as np

from cointoss.study import Array
from cointoss_bounce.contact import DEFAULT, GRAVITY, HARDEST, one_step_solref, spring_solref
from cointoss_bounce.drops import SPEED
from cointoss_bounce.recipe import SPRING_STEPS, recipe_of
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.studies.mujoco_bodies.bodies import (
    SHAPES,
    SIZE,
    Shape,
    Touch,
    rebounds,
    resting_depth,
)

RESTITUTION = 0.8
STEP, FINE = 1e-3, 1e-4
"""The timesteps of the simulation [s]."""
MASSES = (0.01, 1.0, 100.0)
"""[kg]."""
CONTACTS = ("one step", "spring")
FLAT = ("ball", "box flat", "box flat, C off its middle")
MIXED = {
    "priority of the body": ('priority="1"', ""),
    "equal priorities with a plane by default": ("", ""),
    "equal priorities and solmix 1e6 of the body": ('solmix="1e6"', ""),
    "priority of the plane by default": ("", 'priority="1"'),
    "equal priorities with settings of the body on both": ("", "same"),
}
"""Attributes of the two geoms."""
WAYS = (0.1, 0.5, 1.5, 3.0)
"""The way of a ball in one step, over its radius; speculative contacts act where this way exceeds its
size."""


def touch_of(contact: str, dt: float, **others: Any) -> Touch:
    """Return the settings of "one step" or of a "spring"."""
    solref, integrator = one_step_solref(RESTITUTION, dt), "implicitfast"
    if contact == "spring":
        solref, integrator = spring_solref(RESTITUTION, dt, SPRING_STEPS), "RK4"
    return Touch(solref=solref, timestep=dt, integrator=integrator, **others)


def shaped(shape: Shape, contact: str) -> dict[str, float]:
    """Let a body come down in longer and in shorter steps, and with each of `MASSES`.

    The depths are over the speed and the length of the contact, and over a ball's.
    """
    length = FINE * (SPRING_STEPS if contact == "spring" else 1)
    light, fine, heavy = (rebounds(shape, touch_of(contact, FINE, mass=mass)) for mass in MASSES)
    depth, of_ball = (
        found.depth / length for found in (fine, rebounds(SHAPES["ball"], touch_of(contact, FINE)))
    )
    changes = [
        max(np.abs(each.restitutions - light.restitutions).max(), abs(each.depth / light.depth - 1))
        for each in (fine, heavy)
    ]
    return {
        "error": _error(rebounds(shape, touch_of(contact, STEP)).restitutions),
        "fine_error": _error(fine.restitutions),
        "depth": depth,
        "depth_over": depth / of_ball,
        "by_mass": max(changes),
    }


def _error(restitutions: Array) -> float:
    return float(np.abs(restitutions - RESTITUTION).max())


def landed(flat: str, contact: str, solimp: str, diagexact: bool) -> dict[str, float]:
    """Let a body come down flat, on several points at once."""
    touch = touch_of(contact, STEP, solimp=solimp, exact=diagexact)
    e = rebounds(SHAPES[flat], touch).restitutions
    return {"error": _error(e), "unevenness": float(np.ptp(e, axis=1).max())}


def mixed(mixed: tuple[str, str]) -> dict[str, float]:
    """Let a ball come down whose geom and the plane's have settings of their own."""
    body, plane = mixed
    if plane == "same":
        plane = touch_of("one step", STEP).geom
    drops = rebounds(SHAPES["ball"], touch_of("one step", STEP, body=body, plane=plane))
    return {"e": float(drops.restitutions.mean())}


def resting(contact: str, mass: float) -> dict[str, float]:
    """Lay a ball down with the recommended settings; its depth is over (1 - d) g/k."""
    settings = recipe_of(RESTITUTION, STEP, SPRING_STEPS if contact == "spring" else None)
    soft = 1 - float(settings.solimp.split()[0])
    depth = resting_depth(Touch(**asdict(settings), mass=mass))
    return {"at_rest": depth / (soft * GRAVITY / -settings.solref[0])}


def speculative(contact: str, way: float) -> dict[str, float]:
    """Let a ball that moves a given number of radii in a step come down on speculative contacts."""
    e = rebounds(SHAPES["ball"], touch_of(contact, way * SIZE / SPEED, speculative=True)).restitutions
    return {"least": float(e.min()), "most": float(e.max()), "error": _error(e)}


REPRODUCTION = study(
    __name__,
    Cells(shaped, {"shape": SHAPES, "contact": CONTACTS}),
    Cells(
        landed,
        {
            "contact": CONTACTS,
            "solimp": {"hardest": HARDEST, "default": DEFAULT},
            "diagexact": {"with": True, "without": False},
            "flat": FLAT,
        },
    ),
    Cells(mixed, {"mixed": MIXED}),
    Cells(resting, {"contact": CONTACTS, "mass": MASSES}),
    Cells(speculative, {"contact": CONTACTS, "way": WAYS}),
)
