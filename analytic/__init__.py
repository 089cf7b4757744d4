"""The analytic engine: equations of motion, air drag, impact laws; imports models alone."""

from cointoss.analytic.impact.own_law import OwnLaw
from cointoss.analytic.many import require_rows, rest_rows, toss_rows
from cointoss.analytic.settings import FINE, MANY, AnalyticSettings
from cointoss.analytic.toss import require_supported, toss
from cointoss.models.kernel.vectors import solve

__all__ = [
    "FINE",
    "MANY",
    "AnalyticSettings",
    "OwnLaw",
    "require_rows",
    "require_supported",
    "rest_rows",
    "solve",
    "toss",
    "toss_rows",
]

if __name__ == "analytic":  # by its bare name, in a checkout
    from cointoss.bare_names import open_as_part

    open_as_part(__name__)
