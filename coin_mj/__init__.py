"""The MuJoCo engine: an MJCF cylinder, its drag and its stiff contact; imports models alone."""

from typing import Any

from cointoss.coin_mj.many import require_rows, toss_rows
from cointoss.coin_mj.model.settings import FINE, MANY, Friction, MujocoSettings, Realisation
from cointoss.coin_mj.release_fields import release_fields
from cointoss.coin_mj.resting import rest_rows
from cointoss.coin_mj.toss import impacts_of, require_supported, toss
from cointoss.homes import brought

__all__ = [
    "FINE",
    "MANY",
    "Friction",
    "MujocoSettings",
    "Realisation",
    "impacts_of",
    "release_fields",
    "require_rows",
    "require_supported",
    "rest_rows",
    "toss",
    "toss_rows",
]


def __getattr__(name: str) -> Any:
    return brought({each: (__name__, each) for each in __all__}, name, __name__)


if __name__ == "coin_mj":  # by its bare name, in a checkout
    from cointoss.bare_names import open_as_part

    open_as_part(__name__)
