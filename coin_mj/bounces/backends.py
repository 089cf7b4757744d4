"""What steps a model on a GPU, and what of the settings for a bounce it takes."""

from enum import StrEnum


class Backend(StrEnum):
    """What steps a model."""

    MUJOCO = "mujoco"
    """MuJoCo itself."""
    MJX = "mjx"
    """mujoco-mjx, in JAX."""
    WARP = "warp"
    """mujoco-warp, in NVIDIA Warp."""

    @property
    def takes_diagexact(self) -> bool:
        """Whether it takes the flag diagexact, which it refuses otherwise (NotImplementedError)."""
        return self is Backend.MUJOCO

    @property
    def remark(self) -> str:
        """What was found of it on a CPU, of mujoco-mjx 3.17 and mujoco-warp 4.0."""
        return {
            Backend.MUJOCO: "in double precision",
            Backend.MJX: "in float32 e errs by up to 3e-3, with jax_enable_x64 by no more than MuJoCo's",
            Backend.WARP: "in float32, e errs by 4e-7 more than MuJoCo's",
        }[self]
