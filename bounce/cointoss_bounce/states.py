"""Copies of states of MuJoCo."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import copy

import mujoco


def copied(model: mujoco.MjModel, data: mujoco.MjData, spare: mujoco.MjData) -> mujoco.MjData:
    """Return a copy of a state: the spare one, or a new one, which older versions need."""
    if not hasattr(mujoco, "mj_copyData"):
        return copy.copy(data)
    mujoco.mj_copyData(spare, model, data)
    return spare
