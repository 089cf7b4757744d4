"""The paper's mechanics: quaternion equations of motion, air drag, Newton impacts."""

from analytic.ensemble import toss_many
from analytic.toss import toss

__all__ = ["toss", "toss_many"]
