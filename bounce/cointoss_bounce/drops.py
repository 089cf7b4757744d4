"""Restitution, duration and depth of a body's touches on a plane, at all phases of a step."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from cointoss_bounce.arrays import Array
from cointoss_bounce.bodies import BALL, FlatBody
from cointoss_bounce.contact import ContactSettings
from cointoss_bounce.unlogged import unlogged

LONGEST = 2000
"""A contact that goes on for more steps is no rebound."""
MOST_STEPS = 20_000
"""The most steps of a contact that is measured."""
SLOW, LYING = 1e-3, 100
"""A body that is slower than this part of its speed for so many steps has come to lie."""
PHASES = 16
"""Heights of release, spread over the way of one step: a touch falls anywhere between two steps."""
SPEED = 2.0
"""The speed of the body at the touch [m/s]."""


@dataclass(frozen=True)
class Drops:
    """The bounces of a body on a plane, one for each of the `PHASES` of its touch."""

    restitutions: Array
    """Ratio of the speeds after and before, where the body meets the plane; 0 if it does not leave, (n,)."""
    durations: Array
    """The times for which the contacts push, (n,) [s]."""
    depth: float
    """The greatest depths [m]."""


def drops_of(contact: ContactSettings, body: FlatBody = BALL, gravity: float = 0.0) -> Drops:
    """Let a body come down flat on a plane with plain `mj_step`, which touches at `SPEED` within three steps.

    Args:
        contact: the settings.
        body: without spin.
        gravity: downward [m/s²]; by default the contact alone acts.
    """
    with unlogged():
        found = [_drop(contact, body, gravity, (number + 0.5) / PHASES) for number in range(PHASES)]
    restitutions, durations, depths = (np.array(column) for column in zip(*found, strict=True))
    return Drops(restitutions, durations, float(depths.max()))


def _drop(
    contact: ContactSettings, body: FlatBody, gravity: float, phase: float
) -> tuple[float, float, float]:
    """Return the restitution, the duration of the contact [s] and the depth [m] of one touch."""
    flight = contact.timestep * (2 + phase)
    model = body.compiled(contact, body.height + (SPEED - gravity * flight / 2) * flight)
    data = mujoco.MjData(model)
    model.opt.gravity[2] = -gravity
    data.qvel[2] = gravity * flight - SPEED

    # Integrators but RK4 keep v² + 2 g z - g dt v in free flight: their v is that of half a step before.
    late = 0.0 if contact.integrator == "RK4" else gravity * contact.timestep

    def speed_at_plane() -> float:
        """Return the speed that the body in free flight has where it meets the plane."""
        v, height = data.qvel[2], data.qpos[2] - body.height
        return math.sqrt(max(v**2 - late * v + 2 * gravity * height, 0.0))

    before, pushing, slow, depth = speed_at_plane(), 0, 0, 0.0
    for _ in range(MOST_STEPS):
        mujoco.mj_step(model, data)
        pushed = data.nefc > 0 and data.efc_force.max() > 0
        pushing += pushed
        slow = slow + 1 if abs(data.qvel[2]) < SLOW * SPEED else 0
        depth = max(depth, body.height - data.qpos[2])
        if pushing and not pushed and data.qvel[2] > 0 and (data.ncon == 0 or gravity == 0):
            return speed_at_plane() / before, pushing * contact.timestep, depth
        if pushing and slow == LYING:
            break
    return 0.0, pushing * contact.timestep, depth
