"""The MuJoCo engine: an MJCF cylinder, its drag and its stiff contact; imports models alone."""

from pathlib import Path
from runpy import run_path

run_path(str(Path(__file__).parents[1] / "models" / "siblings.py"))

from coin_mj.ensemble import MANY, toss_many
from coin_mj.model.settings import ContactSettings, Friction, Realisation
from coin_mj.toss import impacts_of, toss

__all__ = ["MANY", "ContactSettings", "Friction", "Realisation", "impacts_of", "toss", "toss_many"]
