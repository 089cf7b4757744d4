"""The MuJoCo engine: an MJCF cylinder, its drag and its stiff contact; imports models alone."""

from pathlib import Path
from runpy import run_path

run_path(str(Path(__file__).parents[1] / "models" / "siblings.py"))

from coin_mj.bounce import Bounce, solref
from coin_mj.ensemble import toss_many
from coin_mj.model.settings import FINE, MANY, Friction, Realisation, Settings
from coin_mj.toss import impacts_of, require_supported, toss

__all__ = [
    "FINE",
    "MANY",
    "Bounce",
    "Friction",
    "Realisation",
    "Settings",
    "impacts_of",
    "require_supported",
    "solref",
    "toss",
    "toss_many",
]
