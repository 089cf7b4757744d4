"""The analytic engine: quaternion equations of motion, air drag, impact laws; imports models alone."""

from pathlib import Path
from runpy import run_path

run_path(str(Path(__file__).parents[1] / "models" / "siblings.py"))

from analytic.ensemble import toss_many
from analytic.toss import toss

__all__ = ["toss", "toss_many"]
