"""The analytic engine: quaternion equations of motion, air drag, impact laws; imports models alone."""

from pathlib import Path
from runpy import run_path

run_path(str(Path(__file__).parents[1] / "models" / "siblings.py"))

from analytic.ensemble import toss_many
from analytic.settings import FINE, MANY, Settings
from analytic.toss import require_supported, toss

__all__ = ["FINE", "MANY", "Settings", "require_supported", "toss", "toss_many"]
