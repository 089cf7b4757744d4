"""The MuJoCo coin: an MJCF cylinder with an inertia offset, drag, and a tuned stiff contact."""

from coin_mj.ensemble import MANY, toss_many
from coin_mj.model.settings import ContactSettings, Friction, Realisation
from coin_mj.toss import impacts_of, toss

__all__ = ["MANY", "ContactSettings", "Friction", "Realisation", "impacts_of", "toss", "toss_many"]
