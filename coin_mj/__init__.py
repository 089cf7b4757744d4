"""The MuJoCo coin: an MJCF cylinder with an inertia offset, drag, and a tuned stiff contact."""

from coin_mj.contact import Friction, Realisation
from coin_mj.toss import toss

__all__ = ["Friction", "Realisation", "toss"]
