"""Contact settings of MuJoCo with which a body bounces, and comes to rest."""

import math
from dataclasses import dataclass

from cointoss_bounce.spring import damping_ratio_of

HARDEST = "0.9999 0.9999 0.001 0.5 2"
"""The largest impedance MuJoCo takes, as solimp."""
DEFAULT = "0.9 0.95 0.001 0.5 2"
"""MuJoCo's own solimp."""
INTEGRATORS = ("Euler", "RK4", "implicit", "implicitfast", "discrete")
"""MuJoCo's integrators, by their names in a model and in the order of its numbers."""
STIFFENED = 1e-3
"""k dt² of a stiffness beside the damping of a one-step contact, which keeps a body at rest from sinking."""
CARRIED = 0.1 * math.pi
"""(1 - d) n (1 - e) of a spring of n steps that lets a body come to rest, d its impedance; found by trial."""
GRAVITY = 9.81
"""The acceleration of weight, by default [m/s²]."""
SOFTEST = 0.1
"""The largest 1 - d of a spring."""


@dataclass(frozen=True, kw_only=True)
class ContactSettings:
    """Settings of a contact and of the simulation that steps it."""

    solref: tuple[float, float]
    """Positive: time constant [s] and damping ratio; else -stiffness [1/s²] and -damping [1/s]."""
    timestep: float
    """The step of the simulation [s]."""
    integrator: str
    """The integrator by its name in a model."""
    solimp: str = HARDEST
    exact: bool = True
    """Whether the flag diagexact is set."""
    gravity: float = GRAVITY
    """Downward [m/s²]."""

    @property
    def option(self) -> str:
        """The element <option>."""
        opening = f'option timestep="{self.timestep!r}" integrator="{self.integrator}"'
        opening += f' gravity="0 0 {-float(self.gravity)!r}"' if self.gravity != GRAVITY else ""
        return f'<{opening}><flag diagexact="enable"/></option>' if self.exact else f"<{opening}/>"

    @property
    def geom(self) -> str:
        """The attributes of one of the two geoms that touch."""
        return f'solref="{text_of(self.solref)}" solimp="{self.solimp}"'

    def pasted(self, condim: int = 1) -> str:
        """Return the attributes as they are printed: by its priority one geom's hold alone.

        Args:
            condim: 1 without friction; 3 with MuJoCo's own, as for what stands on something.
        """
        return f'condim="{condim}" {self.geom} priority="1"'


def text_of(solref: tuple[float, float]) -> str:
    """Return a solref as it stands in a model."""
    return " ".join(f"{number!r}" if number else "0" for number in solref)


def one_step_solref(restitution: float, dt: float) -> tuple[float, float]:
    """Return the solref that makes an impact within one step: "0 -(1 + e)/dt"."""
    return 0.0, -(1 + restitution) / dt


def resting_solref(restitution: float, dt: float) -> tuple[float, float]:
    """Return that with a stiffness beside it: v' = -e v to half of `STIFFENED`, and a body at rest is held.

    A touch of depth x gives v' = (1 - b dt) v + k dt x. Since x is anything from 0 to v dt, b is reduced by
    half of the most that k adds. A body that never loses energy never rests, so k vanishes with 1 - e.
    """
    part = min(STIFFENED, 1 - restitution)
    return -_rounded(part / dt**2), -_rounded((1 + restitution - part / 2) / dt)


def spring_solref(restitution: float, dt: float, steps: int) -> tuple[float, float]:
    """Return the solref of a damped spring that is resolved by so many steps: k = (π/(n dt))², d = 2 ζ √k."""
    stiffness = (math.pi / (steps * dt)) ** 2
    return -stiffness, -2 * damping_ratio_of(restitution) * math.sqrt(stiffness)


def spring_solimp(restitution: float, steps: int) -> str:
    """Return the solimp with which a spring of so many steps carries a part of the weight.

    With solimp 0.9999 the contact carries the whole weight, and the spring pushes off a body that should lie
    still.
    """
    soft = CARRIED / (steps * (1 - restitution)) if restitution < 1 else SOFTEST
    impedance = round(1 - min(max(soft, 1e-4), SOFTEST), 4)
    return f"{impedance} {impedance} 0.001 0.5 2"


def _rounded(number: float) -> float:
    """Return a number as it is printed: 250 rather than 249.99999999999997."""
    return float(f"{number:.12g}")
