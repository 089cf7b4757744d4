"""MuJoCo's warnings while something unstable is measured: not in a file, not on the terminal."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from collections.abc import Iterator
from contextlib import contextmanager

import mujoco


@contextmanager
def unlogged() -> Iterator[None]:
    """Keep MuJoCo from appending its warnings to MUJOCO_LOG.TXT in the working directory."""
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(_ignored)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)


def _ignored(message: str) -> None:
    """Ignore a warning: what is unstable is seen in what is measured."""
