"""The analytic engine: equations of motion, air drag, impact laws; imports models alone."""

from cointoss.analytic.ensemble import toss_many
from cointoss.analytic.impact.own_law import OwnLaw
from cointoss.analytic.settings import FINE, MANY, Settings
from cointoss.analytic.toss import require_supported, toss
from cointoss.models.kernel.vectors import solve

__all__ = ["FINE", "MANY", "OwnLaw", "Settings", "require_supported", "solve", "toss", "toss_many"]

if __name__ == "analytic":  # by its bare name, in a checkout
    from cointoss.bare_names import open_as_part

    open_as_part(__name__)
