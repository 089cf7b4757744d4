"""MuJoCo's settings for a bounce by MJX and Warp: what each takes, and what a body does."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import mujoco
import numpy as np

from cointoss.study import (
    BALL,
    GRAVITY,
    SPEED,
    SPRING_STEPS,
    Array,
    ContactSettings,
    FlatBody,
    Progress,
    one_step_solref,
    paragraphs,
    recipe_of,
    table,
)
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.setups.mujoco_situations import RECIPE
from cointoss_reproduction.studies.mujoco_backends.backends import BACKENDS, Stepped, require_backends

E, STEP = 0.8, 2e-3
"""Restitution; step [s]."""
PHASES = 4
"""Of the touch between two steps."""
AT_REST = {"one step": 16.0, "spring": 8.0}
"""Duration of the rest, whose last quarter is looked at [s]: what one step has pressed in rises slowly."""
SLIP, FRICTION, SLIDING = 1.0, 0.3, FlatBody("sphere", (0.1,))
"""Of a ball that slides [m/s]; coefficient; the ball."""
EXACT = recipe_of(E, STEP)
ONE_STEP = replace(EXACT, exact=False)
SPRING = replace(recipe_of(E, STEP, SPRING_STEPS), exact=False)
Path = tuple[mujoco.MjModel, Array, Array, int]
"""A model, positions, velocities, and steps."""


@dataclass(frozen=True)
class Cell:
    """What one backend did with one setting."""

    refused: str
    """Name of the error; empty where it ran."""
    numbers: list[float]
    """What was measured."""


@dataclass(frozen=True)
class Backends:
    """What the study found."""

    versions: str
    cells: dict[str, dict[str, Cell]]
    """By setting, and by backend."""


def drop(contact: ContactSettings, body: FlatBody = BALL, more: str = "") -> Path:
    """Return a body that comes down flat without weight at `PHASES` of a step.

    Args:
        contact: the settings.
        body: it comes down flat.
        more: further attributes of <option>.
    """
    text = body.model(contact, body.height).replace("<option ", f"<option {more} ")
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.gravity[:] = 0
    qpos, qvel = np.zeros((PHASES, 7)), np.zeros((PHASES, 6))
    qpos[:, 2] = body.height + SPEED * STEP * (2 + (np.arange(PHASES) + 0.5) / PHASES)
    qpos[:, 3], qvel[:, 2] = 1.0, -SPEED
    return model, qpos, qvel, 120 if contact.integrator in ("RK4", "discrete") else 12


def lying(contact: ContactSettings, duration: float) -> Path:
    """Return a ball that falls as fast as `rest_of` lets it fall, for a duration [s]."""
    model = BALL.compiled(contact, BALL.height)
    qvel = np.zeros((1, 6))
    qvel[0, 2] = -50 * GRAVITY * STEP
    return model, np.array([[0, 0, BALL.height, 1, 0, 0, 0]]), qvel, round(duration / STEP)


def sliding() -> Path:
    """Return a ball that slides as it comes down, with restitution and friction together."""
    pair = (
        f'<contact><pair geom1="floor" geom2="ball" condim="3" friction="{FRICTION} {FRICTION} 0 0 0" '
        f'{ONE_STEP.geom} solreffriction="0 {-1 / STEP!r}"/></contact>'
    )
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{STEP}" integrator="implicitfast" gravity="0 0 0" {RECIPE}/>'
        '<worldbody><geom name="floor" type="plane" size="0 0 1"/>'
        f'<body><freejoint/><geom name="ball" size="{SLIDING.height}" mass="1"/></body></worldbody>'
        f"{pair}</mujoco>"
    )
    _, qpos, qvel, steps = drop(ONE_STEP, SLIDING)
    qvel[:, 0] = SLIP
    return model, qpos, qvel, steps


def restitution(paths: Array) -> list[float]:
    """Return the smallest and the largest restitution."""
    e = paths[-1, :, 9] / SPEED
    return [float(e.min()), float(e.max())]


def rest(paths: Array) -> list[float]:
    """Return the mean depth in the last quarter and the hop then [m]."""
    heights = paths[-(len(paths) // 4) :, 0, 2]
    return [float(BALL.height - heights.mean()), float(np.ptp(heights))]


def slip(paths: Array) -> list[float]:
    """Return the mean slip that is left [m/s], and the largest error of e."""
    end = paths[-1]
    left = end[:, 7] - SLIDING.height * end[:, 11]
    return [float(left.mean()), float(np.abs(end[:, 9] / SPEED - E).max())]


def nothing(_paths: Array) -> list[float]:
    """Return nothing: it ran."""
    return []


SETTINGS: dict[str, tuple[Callable[[], Path], Callable[[Array], list[float]]]] = {
    '`<flag diagexact="enable"/>`': (lambda: drop(EXACT), nothing),
    "one step, `implicitfast`": (lambda: drop(ONE_STEP), restitution),
    "the same, `Euler`": (lambda: drop(replace(ONE_STEP, integrator="Euler")), restitution),
    "the same, `implicit`": (lambda: drop(replace(ONE_STEP, integrator="implicit")), restitution),
    "the same, `RK4`": (lambda: drop(replace(ONE_STEP, integrator="RK4")), restitution),
    "one step, no stiffness": (
        lambda: drop(replace(ONE_STEP, solref=one_step_solref(E, STEP))),
        restitution,
    ),
    "one step, at rest": (lambda: lying(ONE_STEP, AT_REST["one step"]), rest),
    "spring of 40 steps, `RK4`": (lambda: drop(SPRING), restitution),
    "the same, `discrete`": (lambda: drop(replace(SPRING, integrator="discrete")), restitution),
    "spring, at rest": (lambda: lying(SPRING, AT_REST["spring"]), rest),
    "box flat, one step": (lambda: drop(ONE_STEP, FlatBody("box", (0.1, 0.1, 0.05))), restitution),
    "capsule, one step": (lambda: drop(ONE_STEP, FlatBody("capsule", (0.02, 0.05))), restitution),
    "ellipsoid, one step": (lambda: drop(ONE_STEP, FlatBody("ellipsoid", (0.1, 0.1, 0.05))), restitution),
    '`cone="elliptic"`, condim 1': (lambda: drop(ONE_STEP, more='cone="elliptic"'), nothing),
    "restitution and friction together": (sliding, slip),
    '`<flag speculative="enable"/>`': (lambda: _speculative(), nothing),
}
"""What is stepped, and what is measured of it."""


def _speculative() -> Path:
    path = drop(ONE_STEP)
    path[0].opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
    return path


def measured(step: Stepped, name: str) -> Cell:
    """Return what a backend does with one of the `SETTINGS`; whatever it raises is its refusal."""
    make, measure = SETTINGS[name]
    try:
        return Cell("", measure(step(*make())))
    except Exception as error:
        return Cell(type(error).__name__, [])


def compute(progress: Progress) -> Backends:
    """Measure every setting by every backend."""
    versions, cells = require_backends(), {}
    for done, name in enumerate(SETTINGS, start=1):
        cells[name] = {backend: measured(step, name) for backend, step in BACKENDS.items()}
        progress(done, len(SETTINGS))
    return Backends(versions, cells)


def measures(found: Backends) -> dict[str, Any]:
    """Return what the claims name."""
    flag, step = found.cells['`<flag diagexact="enable"/>`'], found.cells["one step, `implicitfast`"]
    mjx, exact = found.cells["one step, `implicitfast`"]["MJX, float64"], step["MuJoCo"]
    lie = [
        found.cells[name][backend]
        for name in ("one step, at rest", "spring, at rest")
        for backend in BACKENDS
    ]
    return {
        "refusing": sum(bool(cell.refused) for backend, cell in flag.items() if backend != "MuJoCo"),
        "single": max(_errors(step, "MJX, float32")),
        "warp": max(_errors(step, "Warp, float32")),
        "double": max(abs(a - b) for a, b in zip(mjx.numbers, exact.numbers, strict=True)),
        "hop": max(cell.numbers[1] for cell in lie),
        "depth": max(cell.numbers[0] for cell in lie[: len(BACKENDS)]),
        "spring_depth": max(cell.numbers[0] for cell in lie[len(BACKENDS) :]),
    }


def _errors(cells: dict[str, Cell], backend: str) -> Iterator[float]:
    yield from (abs(e - E) for e in cells[backend].numbers)


def tables(found: Backends) -> str:
    """Return the table, in Markdown."""
    rows = [
        [name, *(_shown(name, cells[backend]) for backend in BACKENDS)] for name, cells in found.cells.items()
    ]
    return paragraphs(
        f"By {found.versions}, on a CPU: e = {E:g}, steps of {1e3 * STEP:g} ms; e' of bodies that come down "
        f"at {PHASES} phases of a step, depth (and hop) of a ball at rest, slip of {SLIP:g} m/s "
        "after its impact:",
        table(["setting", *BACKENDS], rows, words=True),
    )


def _shown(name: str, cell: Cell) -> str:
    if cell.refused:
        return f"refused: {cell.refused}"
    measure = SETTINGS[name][1]
    if measure is restitution:
        low, high = (f"{e:.4f}" for e in cell.numbers)
        return low if low == high else f"{low} to {high}"
    if measure is rest:
        depth, hop = cell.numbers
        return f"{1e6 * depth:.3g} µm" + (f", hops by {1e6 * hop:.2g} µm" if hop > 1e-9 else "")
    if measure is slip:
        return f"slip {cell.numbers[0]:.4f} m/s, e errs by {cell.numbers[1]:.0e}"
    return "runs"


REPRODUCTION = recorded(__name__, compute, record=Backends, measures=measures, tables=tables, draw={})
