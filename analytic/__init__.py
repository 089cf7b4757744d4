"""The analytic engine: equations of motion, air drag, impact laws; imports models alone."""

from cointoss.analytic.ensemble import toss_many
from cointoss.analytic.settings import FINE, MANY, Settings
from cointoss.analytic.toss import require_supported, toss

__all__ = ["FINE", "MANY", "Settings", "require_supported", "toss", "toss_many"]

if __name__ == "analytic":  # by its bare name, in a checkout
    from cointoss.bare_names import open_as_part

    open_as_part(__name__)
