"""A floor as contact settings of MuJoCo: its restitution as a solref, and the source of its friction."""

import itertools
import math
from dataclasses import asdict, dataclass, replace
from enum import StrEnum
from numbers import Integral
from typing import NamedTuple

from cointoss.models.contact_laws.table import is_rough, uses_friction
from cointoss.models.entries import damping_ratio_of
from cointoss.models.parts import Floor

ROUGH = 100.0
"""Coefficient of friction that stands for a perfectly rough floor."""
NO_DAMPING = 1e-9
"""A damping that damps nothing in the time of a contact [1/s]."""


class Realisation(StrEnum):
    """How a contact gives the restitution."""

    SPRING = "spring"
    """A stiff damped spring, solref = "-stiffness -damping", resolved in time; 0 < χ <= 1."""
    ONE_STEP = "one_step"
    """One step of semi-implicit Euler, solref = "0 -(1 + χ)/dt": Newton's law at once; 0 <= χ <= 1."""


class Friction(StrEnum):
    """The source of a contact's friction."""

    EXPLICIT = "explicit"
    """A frictionless contact, and Coulomb's force against the slip, μ times the normal force measured."""
    NATIVE = "native"
    """MuJoCo's native friction cone, the elliptic one."""


def _require(name: str, value: object, holds: bool, accepted: str) -> None:
    if not holds:
        raise ValueError(f"coin_mj.MujocoSettings.{name} = {value}: accepted: {accepted}")


class Budgets(NamedTuple):
    """The most steps that a toss may take."""

    contact_steps: int
    flight_steps: int


@dataclass(frozen=True, kw_only=True)
class MujocoSettings:
    """How MuJoCo realises a floor, and how finely it steps."""

    contact: Realisation = Realisation.SPRING
    """How a contact gives the restitution."""
    friction: Friction = Friction.EXPLICIT
    """Who makes the friction of a floor that has one."""
    stiffness: float = 1e14
    """k of the spring, per unit of effective mass [1/s²]."""
    steps: int = 64
    """Steps in half a period of the spring."""
    step: float = 1e-7
    """Length of the one step [s]."""
    slip_damping: float | None = None
    """The damping of the slip by MuJoCo's own friction, by default that of the normal motion [1/s]."""
    flight_angle: float = 0.05
    """Largest turn of the coin in a step of free flight [rad]; of a coin that is no balanced symmetric top at
    most `cointoss.coin_mj.model.machine.UNSYMMETRIC`."""
    contact_steps: int = 250_000
    """The most steps in the sustained contacts of a toss, a fiftieth of it in air with b > 0."""
    flight_steps: int = 250_000
    """The most steps in the flights of a toss, a fiftieth of it in air with b > 0."""

    def __post_init__(self) -> None:
        """Check each setting; `contact` and `friction` may be given by their values.

        Raises:
            ValueError: naming the setting, its value and what is accepted.
        """
        for name, kind in (("contact", Realisation), ("friction", Friction)):
            value, accepted = getattr(self, name), [item.value for item in kind]
            _require(name, value, value in accepted, " or ".join(f'"{item}"' for item in accepted))
            object.__setattr__(self, name, kind(value))
        for name in ("stiffness", "step", "flight_angle"):
            value = getattr(self, name)
            _require(name, value, 0 < value < math.inf, "a finite number > 0")
        counts = {
            "steps": self.steps,
            "contact_steps": self.contact_steps,
            "flight_steps": self.flight_steps,
        }
        for name, count in counts.items():
            _require(name, count, isinstance(count, Integral) and count >= 1, "a whole number >= 1")
        damping = self.slip_damping
        _require("slip_damping", damping, damping is None or 0 <= damping < math.inf, "a finite number >= 0")

    def softened(self, part: float) -> "MujocoSettings":
        """Return settings with a spring softer by `part`, or with one step longer by `part`."""
        return replace(self, stiffness=self.stiffness / part, step=self.step * part)

    @property
    def budgets(self) -> Budgets:
        """The most steps of a toss."""
        return Budgets(self.contact_steps, self.flight_steps)

    def as_dict(self) -> dict[str, str | float]:
        """Return the settings on which a toss depends, by name; without those of another contact."""
        unused = ("stiffness", "steps") if self.contact == Realisation.ONE_STEP else ("step",)
        return {
            name: value
            for name, value in asdict(self).items()
            if name not in unused and value is not None  # as `slip_damping`, by default
        }


FINE = MujocoSettings()
"""The settings of one toss."""
MANY = MujocoSettings(stiffness=1e11, steps=3, flight_angle=0.8)
"""The settings of many tosses: a softer spring, fewer and larger steps."""


LARGE = 44.0
"""Rate √(g/r) up to which a coin is large: the stiffness of its spring is as asked for [1/s]."""
LOSS = 0.08
"""An impact that takes 1 - χ² of the normal motion's energy hides errors of a few hundredths of that loss. An
impact that takes less than `LOSS` gets a harder spring, up to `HARDEST`, and smaller steps, down to those for
`LEAST_LOSS`."""
LEAST_LOSS = 2.5e-3
LEAST_SPRING = 0.01
"""The least χ of a spring: the damping of one with less is too fast for its steps."""
HARDEST = FINE.stiffness
STEPS_OF_LOSS = 3
"""Steps in half a period that change the energy by 7e-4, a hundredth of `LOSS`: an error of order 5."""


def resolved(settings: MujocoSettings, restitution: float, rate: float) -> MujocoSettings:
    """Return settings with which a coin gains no energy in its contacts, whatever its size and restitution.

    While a coin turns in a contact its effective mass changes, and with it the energy of the spring. So the
    contacts of a small coin are shorter as its own time √(r/g) is, and those that lose little energy shorter
    still; they take more steps, too. No spring has a χ below `LEAST_SPRING`: that is one step, as long as one
    of the spring's.

    Args:
        settings: as asked for.
        restitution: χ of the floor, the largest where it varies with the speed.
        rate: √(g/r) of the coin [1/s].
    """
    if settings.contact == Realisation.ONE_STEP:
        return settings
    part = min(max(1 - restitution * restitution, LEAST_LOSS) / LOSS, 1.0)
    asked, larger = settings.stiffness, max(rate / LARGE, 1.0)
    stiffness = max(asked, min(asked / (part * part), HARDEST)) * (larger * larger)
    if restitution < LEAST_SPRING:
        step = math.pi / math.sqrt(stiffness) / settings.steps
        return replace(settings, contact=Realisation.ONE_STEP, step=step)
    steps = next(n for n in itertools.count(settings.steps) if n**5 * (part * part) >= STEPS_OF_LOSS**5)
    return replace(settings, stiffness=stiffness, steps=steps)


class Rebound(NamedTuple):
    """The acceleration a = -k x - d ẋ that MuJoCo gives a contact while it pushes, and how to step it."""

    stiffness: float
    """k [1/s²]."""
    damping: float
    """d [1/s]."""
    slip_damping: float
    """The damping of the slip by MuJoCo's own friction [1/s]."""
    step: float
    """Length of a step in contact [s]."""
    duration: float
    """The duration of a contact: half a period of the undamped spring, π/√k, or the one step [s]."""


def rebound_of(restitution: float, settings: MujocoSettings) -> Rebound:
    """Return the rebound with `restitution` χ at every point of the rim.

    Raises:
        ValueError: for a χ out of the realisation's reach.
    """
    if settings.contact == Realisation.ONE_STEP:
        stiffness, damping = 0.0, (1 + restitution) / settings.step
        step, duration = settings.step, settings.step
    elif not 0 < restitution <= 1:
        raise ValueError(f"restitution = {restitution}: accepted: 0 < restitution <= 1")
    else:
        root = math.sqrt(settings.stiffness)
        stiffness, damping = settings.stiffness, 2 * damping_ratio_of(restitution) * root
        step, duration = math.pi / root / settings.steps, math.pi / root
    slip_damping = damping if settings.slip_damping is None else settings.slip_damping
    return Rebound(stiffness, damping, slip_damping, step, duration)


def friction_of(floor: Floor) -> float:
    """Return the coefficient of friction μ with which MuJoCo stands for a floor."""
    if is_rough(floor.contact):
        return ROUGH
    return floor.friction if uses_friction(floor.contact) else 0.0
