"""Settings of Isaac Lab for a restitution by PhysX, which has a coefficient of its own."""

from dataclasses import dataclass

from cointoss_bounce.accepted import require_bounds
from cointoss_bounce.contact import GRAVITY


@dataclass(frozen=True, kw_only=True)
class PhysxBounce:
    """Settings of Isaac Lab 2.3 for a restitution by PhysX, which nothing here measures."""

    restitution: float
    timestep: float
    """The step of the simulation [s]."""
    gravity: float
    """Downward [m/s²]."""

    @property
    def threshold(self) -> float:
        """Speed below which a touch does not bounce: what gravity adds in two steps [m/s]."""
        return 2 * self.gravity * self.timestep

    @property
    def settings(self) -> str:
        """What to set: the material of one of the two bodies, and the simulation."""
        return "\n".join(
            [
                "sim_utils.RigidBodyMaterialCfg(  # of one of the two bodies",
                f'    restitution={self.restitution!r}, restitution_combine_mode="max",',
                "    compliant_contact_stiffness=0.0)",
                f"sim_utils.SimulationCfg(dt={self.timestep!r},",
                f"    physx=sim_utils.PhysxCfg(bounce_threshold_velocity={self.threshold:.6g}))",
            ]
        )


def physx_bounce(restitution: float, timestep: float, *, gravity: float = GRAVITY) -> PhysxBounce:
    """Return the settings of Isaac Lab with which PhysX is asked for a restitution.

    Args:
        restitution: e, from 0 to 1.
        timestep: dt of the simulation [s].
        gravity: downward [m/s²].

    Raises:
        ValueError: naming the argument, its value and what is accepted.
    """
    require_bounds(timestep, restitution=restitution, gravity=gravity)
    return PhysxBounce(restitution=restitution, timestep=timestep, gravity=gravity)
