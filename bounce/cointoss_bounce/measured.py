"""What was measured of given contact settings, whether they were asked for or found."""

from dataclasses import dataclass

from cointoss_bounce.rest import Rest


@dataclass(frozen=True, kw_only=True)
class Measured:
    """Contact settings of MuJoCo, and the motion of a body on a plane that was measured with them."""

    solref: tuple[float, float]
    """The solref of the contact, which MuJoCo mixes of both geoms'; below 0: -stiffness and -damping."""
    solimp: str
    """The solimp of the contact, which MuJoCo mixes of both geoms'."""
    timestep: float
    """The step of the simulation [s]."""
    integrator: str
    """The integrator of MuJoCo, by its name in a model."""
    body: str
    """The body that comes down flat on a plane: its type and size in a <geom>."""
    mass: float
    """The mass of the body [kg]."""
    gravity: float
    """Downward [m/s²]."""
    depth: float
    """The greatest depth in the plane at 1 m/s without weight, whatever the mass [m]."""
    rest: Rest
    """The rest of the body after its bounces."""
