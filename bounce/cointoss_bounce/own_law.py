"""Settings of engines that have a restitution, or a law of contact, of their own."""

import math
import tomllib
from dataclasses import dataclass
from importlib import resources

from cointoss_bounce.accepted import require, require_bounds
from cointoss_bounce.backends import OWN
from cointoss_bounce.bodies import BALL
from cointoss_bounce.contact import GRAVITY
from cointoss_bounce.drops import SPEED
from cointoss_bounce.recipe import LEAST
from cointoss_bounce.spring import dissipation_of, rebound_of

STEPS = 4
"""Steps of the simulation in a contact of Drake, whose integrator takes shorter ones."""
_LAWS = tomllib.loads((resources.files("cointoss_bounce") / "own_laws.toml").read_text(encoding="utf-8"))


@dataclass(frozen=True, kw_only=True)
class EngineBounce:
    """Settings of an engine for a restitution, by a law of its own. Nothing is measured now."""

    backend: str
    """drake, gazebo, isaaclab or pybullet."""
    restitution: float
    timestep: float
    """The step of the simulation [s]."""
    gravity: float
    """Downward [m/s²]."""
    mass: float
    """The mass of the body, for Drake's stiffness [kg]."""

    @property
    def threshold(self) -> float:
        """Speed below which a touch does not bounce: what gravity adds in two steps [m/s]."""
        return 2 * self.gravity * self.timestep

    @property
    def dissipation(self) -> float:
        """Hunt and Crossley's d, with which a touch at `SPEED` has the restitution [s/m]."""
        return dissipation_of(self.restitution) / SPEED

    @property
    def stiffness(self) -> float:
        """The stiffness of each of two bodies, half of which the pair has: it touches for `STEPS` [N/m]."""
        return 2 * self.mass * (math.pi / (STEPS * self.timestep)) ** 2

    @property
    def settings(self) -> str:
        """What to set, in the words of the engine."""
        return _LAWS[self.backend]["settings"].format(self).strip()

    @property
    def notes(self) -> dict[str, str]:
        """What to know of it, by the name of each line."""
        more = {
            "rebounds": ", ".join(
                f"{rebound_of(self.dissipation * v):.3g} at {v:g} m/s" for v in (0.5, 1, SPEED, 5)
            ),
            "rest": 2e3 * self.mass * self.gravity / self.stiffness,
        }
        return {name: text.format(self, **more) for name, text in _LAWS[self.backend]["notes"].items()}


def engine_bounce(
    restitution: float,
    timestep: float,
    *,
    backend: str,
    gravity: float = GRAVITY,
    mass: float = BALL.mass,
) -> EngineBounce:
    """Return the settings with which an engine is asked for a restitution by a law of its own.

    Args:
        restitution: e, from 0 to 1; of drake from 0.01.
        timestep: dt of the simulation [s].
        backend: drake, gazebo (SDFormat), isaaclab (PhysX) or pybullet.
        gravity: downward [m/s²].
        mass: of the body, which drake's stiffness takes [kg].

    Raises:
        ValueError: naming the argument, its value and what is accepted.
    """
    require_bounds(timestep, restitution=restitution, gravity=gravity, mass=mass)
    require("backend", backend, backend in OWN, ", ".join(OWN))
    has_law = backend != "drake" or restitution >= LEAST
    require("restitution", restitution, has_law, f"a number from {LEAST} to 1 by drake")
    return EngineBounce(
        backend=backend, restitution=restitution, timestep=timestep, gravity=gravity, mass=mass
    )
