"""Settings of MuJoCo that give a restitution, and their effect on bodies that bounce, rest and tumble."""

import math
import warnings
from dataclasses import dataclass, replace
from numbers import Integral

import numpy as np

from cointoss_bounce.accepted import require, require_bounds
from cointoss_bounce.backends import OWN, Backend
from cointoss_bounce.bodies import BALL, FlatBody, body_of
from cointoss_bounce.contact import (
    GRAVITY,
    HARDEST,
    ContactSettings,
    one_step_solref,
    resting_solref,
    spring_solimp,
    spring_solref,
)
from cointoss_bounce.drops import LONGEST, SPEED, drops_of
from cointoss_bounce.errors import DeepContactWarning
from cointoss_bounce.flight import energy_change
from cointoss_bounce.measured import Measured
from cointoss_bounce.other_engines import FIRMEST, genesis_settings, newton_settings
from cointoss_bounce.rest import rest_of

SPRING_STEPS = 40
"""Steps in a contact by a spring, by default."""
LEAST = 0.01
"""The least restitution by a spring, or by the dissipation of Drake."""


@dataclass(frozen=True, kw_only=True)
class Bounce(Measured):
    """Settings of MuJoCo that give a restitution, and the measured motion of a body with them."""

    restitution: float
    """The restitution asked for, e."""
    spring: bool
    """Whether a contact is a spring that lasts several steps."""
    backend: Backend
    """The back end for which the settings are. MuJoCo itself measured the numbers below."""
    error: float
    """Largest |e' - e| over `PHASES` touches without weight, anywhere between two steps."""
    error_with_weight: float
    """Largest error of a body that touches at `SPEED` under `gravity`, by its heights; at other speeds v the
    error goes as 1/v, see `weight_cost`."""
    flight: float
    """Change of a tumbling brick's energy, over itself, in half a second at ten turns a second."""

    @property
    def settings(self) -> str:
        """The settings in the terms of the back end."""
        write = {Backend.NEWTON: newton_settings, Backend.GENESIS: genesis_settings}.get(self.backend)
        return write(self.contact) if write else f"{self.option}\n<geom {self.geom}/>"

    @property
    def option(self) -> str:
        """The element <option>."""
        return self.contact.option

    @property
    def geom(self) -> str:
        """The attributes of one of the two geoms that touch; by its priority they hold alone."""
        return self.contact.pasted()

    @property
    def model(self) -> str:
        """A whole model: the body falls from half a metre."""
        body = body_of(self.body, self.mass)
        return body.model(self.contact, body.height + 0.5)

    @property
    def thickest_passed(self) -> float:
        """Largest thickness of a floor, but no plane, that the body passes at `SPEED` [m]; below 0: none.

        A contact deeper than half of both thicknesses sends the body out on the other side.
        """
        return 2 * (SPEED * self.depth - body_of(self.body).thinnest)

    @property
    def weight_cost(self) -> float:
        """The loss of e by weight in one step, over g dt/v, to first order: (1 - e)(2 + e)/(2 e).

        A ball that comes at v touches s v dt deep, s from 0 to 1, and is e v dt higher after the step. By its
        heights before and after, e' = √(h'/h) = e + ((1 - e)/2 - s (1/e - e)) g dt/v. Where e² is not far
        above 2 g dt/v it may stay on the floor.
        """
        e = self.restitution
        return (1 - e) * (2 + e) / (2 * e) if e else math.inf

    @property
    def creep(self) -> float:
        """Speed at which a body slips that MuJoCo's friction holds against its weight, about [m/s].

        Friction is a damping, too: it carries the fraction d of the weight, and the slip b v = (1 - d) g the
        rest.
        """
        damping = -self.solref[1]
        return (1 - float(self.solimp.split()[0])) * self.gravity / damping if damping else math.inf

    @property
    def contact(self) -> ContactSettings:
        """The settings alone."""
        return ContactSettings(
            solref=self.solref,
            timestep=self.timestep,
            integrator=self.integrator,
            solimp=self.solimp,
            exact=self.backend.takes_diagexact,
            gravity=self.gravity,
        )


def solref(
    restitution: float,
    timestep: float,
    *,
    spring: bool = False,
    steps: int = SPRING_STEPS,
    body: str | None = None,
    backend: Backend | str = Backend.MUJOCO,
    mass: float = BALL.mass,
    gravity: float = GRAVITY,
) -> Bounce:
    """Return settings with which contacts have a restitution, with their effects measured by MuJoCo now.

    By default a contact takes one step, v' = -e v, with a small stiffness that holds a body at rest. A spring
    takes `steps` steps, which resolve its force, and works with RK4, which keeps the energy of a tumbling
    body. MUJOCO_MEASURED of cointoss derives both. They hold for every mass, and for every shape that hardly
    turns in the contact, without MuJoCo's own friction.

    Args:
        restitution: e, from 0 to 1; for a spring from 0.01, below which its error is as large.
        timestep: dt of the simulation [s].
        spring: whether a contact is a spring, resolved in time.
        steps: of the simulation in the contact of a spring.
        body: that is measured, by its type and size in a <geom>, such as "box 0.1 0.1 0.002"; by default a
            ball of 1 cm.
        backend: mujoco, mjx, warp, newton or genesis. Only MuJoCo accepts the flag diagexact, and Genesis
            accepts only springs.
        mass: of the body [kg].
        gravity: downward, of what is measured with weight and at rest [m/s²].

    Raises:
        ValueError: naming the argument, its value and what is accepted.

    Warns:
        DeepContactWarning: where a contact of `body` at `SPEED` is deeper than half of its thickness.
    """
    require_bounds(timestep, restitution=restitution, mass=mass, gravity=gravity)
    known = [item.value for item in Backend]
    own = f"; engine_bounce has the settings of {backend}" if backend in OWN else ""
    require("backend", backend, backend in known, ", ".join(known) + own)
    engine = Backend(backend)
    spring = spring or engine is Backend.GENESIS
    most, by = (FIRMEST, "genesis") if engine is Backend.GENESIS else (1, "a spring")
    springs = not spring or LEAST <= restitution <= most
    require("restitution", restitution, springs, f"a number from {LEAST} to {most} by {by}")
    whole = isinstance(steps, Integral) and 5 <= steps <= LONGEST // 4
    require("steps", steps, whole, f"a whole number from 5 to {LONGEST // 4}")
    contact = replace(
        recipe_of(restitution, timestep, steps if spring else None),
        exact=engine.takes_diagexact,
        gravity=gravity,
        **({"integrator": "implicitfast"} if engine is Backend.GENESIS else {}),
    )
    chosen = body_of(body, mass)
    drops = drops_of(contact, chosen)
    weighing = drops_of(contact, chosen, gravity)
    if body is not None:
        _warn_if_deep(chosen, drops.depth / SPEED)
    return Bounce(
        restitution=restitution,
        spring=spring,
        timestep=timestep,
        integrator=contact.integrator,
        solref=contact.solref,
        solimp=contact.solimp,
        backend=engine,
        body=str(chosen),
        mass=mass,
        gravity=gravity,
        error=float(np.abs(drops.restitutions - restitution).max()),
        error_with_weight=float(np.abs(weighing.restitutions - restitution).max()),
        depth=drops.depth / SPEED,
        rest=rest_of(contact, chosen),
        flight=energy_change(contact.integrator, timestep),
    )


def recipe_of(restitution: float, timestep: float, steps: int | None = None) -> ContactSettings:
    """Return the settings for a restitution: of one step, or of a spring of so many."""
    if steps is None:
        return ContactSettings(
            solref=resting_solref(restitution, timestep), timestep=timestep, integrator="implicitfast"
        )
    return ContactSettings(
        solref=spring_solref(restitution, timestep, steps),
        timestep=timestep,
        integrator="RK4",
        solimp=spring_solimp(restitution, steps),
    )


def exact_of(bounce: Bounce) -> ContactSettings:
    """Return the settings of one step without a stiffness: exact to rounding, and never at rest."""
    return ContactSettings(
        solref=one_step_solref(bounce.restitution, bounce.timestep),
        timestep=bounce.timestep,
        integrator=bounce.integrator,
        solimp=HARDEST,
        gravity=bounce.gravity,
    )


def _warn_if_deep(body: FlatBody, depth: float) -> None:
    """Warn where a body goes deeper into the floor than half its thickness: only a plane sends it back.

    Args:
        body: that touches.
        depth: at 1 m/s [m].
    """
    fastest = body.thinnest / depth if depth else math.inf
    if fastest < SPEED:
        warnings.warn(
            f"{body}: a contact at {SPEED:g} m/s is {1e3 * SPEED * depth:.3g} mm deep, and the body is "
            f"{1e3 * 2 * body.thinnest:.3g} mm thick: above {fastest:.2g} m/s it may go through a floor that "
            "is no plane; accepted: slower touches, a floor thicker than "
            f"{2e3 * (SPEED * depth - body.thinnest):.3g} mm, or a step at most {fastest / SPEED:.2g} times "
            "as long",
            DeepContactWarning,
            stacklevel=3,
        )
