"""The back ends that step a model, and the settings for a bounce that each accepts."""

from enum import StrEnum

OWN = ("drake", "gazebo", "isaaclab", "pybullet")
"""Engines with a law of restitution of their own, which MuJoCo can't measure."""


class Backend(StrEnum):
    """What steps a model."""

    MUJOCO = "mujoco"
    """MuJoCo itself."""
    MJX = "mjx"
    """mujoco-mjx, in JAX."""
    WARP = "warp"
    """mujoco-warp, in NVIDIA Warp."""
    NEWTON = "newton"
    """SolverMuJoCo of Newton, which is mujoco-warp with shapes of Newton."""
    GENESIS = "genesis"
    """The rigid solver of Genesis, whose contacts are MuJoCo's springs."""

    @property
    def takes_diagexact(self) -> bool:
        """Whether it takes the flag diagexact, which mjx and warp refuse (NotImplementedError)."""
        return self is Backend.MUJOCO

    @property
    def takes_xml(self) -> bool:
        """Whether its settings are lines of a model of MuJoCo."""
        return self in (Backend.MUJOCO, Backend.MJX, Backend.WARP)

    @property
    def remark(self) -> str:
        """Findings about the back end on a CPU, with mujoco-mjx 3.17, mujoco-warp 4.0 and Newton 1.8."""
        return {
            Backend.MUJOCO: "in double precision",
            Backend.MJX: "in float32 e errs by up to 3e-3, with jax_enable_x64 by no more than MuJoCo's",
            Backend.WARP: "in float32, e errs by 4e-7 more than MuJoCo's",
            Backend.NEWTON: "in float32, Newton 1.8 has 0.7996 to 0.8004 for 0.8 at 2 ms, as MuJoCo has",
            Backend.GENESIS: "names of Genesis 1.4, not run",
        }[self]
