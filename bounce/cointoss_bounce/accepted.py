"""What is accepted of arguments that settings and measurements share."""

from numbers import Real

from cointoss_bounce.drops import SPEED
from cointoss_bounce.errors import FieldError

BOUNDS = {
    "restitution": (0.0, 1.0, "a number from 0 to 1"),
    "timestep": (1e-7, 0.1, "a number of seconds from 1e-7 to 0.1, such as 0.002"),
    "mass": (1e-6, 1e6, "from 1e-06 to 1e+06 kg"),
    "gravity": (1e-3, 1e3, "from 0.001 to {:g} m/s^2 at this step"),
}
"""The least and the largest value of an argument, and what is accepted, in words."""


def require(name: str, value: object, holds: bool, accepted: str) -> None:
    """Refuse an argument that does not hold.

    Raises:
        FieldError: naming the argument, its value and what is accepted.
    """
    if not holds:
        raise FieldError(name, value, accepted)


def require_bounds(timestep: float, **others: float) -> None:
    """Refuse arguments that are no numbers, or out of their bounds; see `require`.

    In a step gravity may change the speed by half of that of a touch.
    """
    for name, value in {"timestep": timestep, **others}.items():
        require(name, value, isinstance(value, Real) and not isinstance(value, bool), "a number")
        least, most, accepted = BOUNDS[name]
        most = min(most, SPEED / 2 / timestep) if name == "gravity" else most
        require(name, value, least <= value <= most, accepted.format(most))
