"""The paper's mechanics: quaternion equations of motion, air drag, Newton impacts."""

from analytic.toss import toss

__all__ = ["toss"]
