"""How contacts of MuJoCo bounce: settings for a restitution, and the bounce of two geoms of a model.

It imports nothing of cointoss. A name is brought from its module when it is first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cointoss_bounce.errors import DeepContactWarning as DeepContactWarning
    from cointoss_bounce.inverse import Rebounds as Rebounds
    from cointoss_bounce.inverse import solref_of as solref_of
    from cointoss_bounce.own_law import EngineBounce as EngineBounce
    from cointoss_bounce.own_law import engine_bounce as engine_bounce
    from cointoss_bounce.pair import PairBounce as PairBounce
    from cointoss_bounce.pair import bounce as bounce
    from cointoss_bounce.pair_rest import PairRest as PairRest
    from cointoss_bounce.recipe import Bounce as Bounce
    from cointoss_bounce.recipe import solref as solref

_HOMES = {
    "Bounce": "recipe",
    "DeepContactWarning": "errors",
    "EngineBounce": "own_law",
    "PairBounce": "pair",
    "PairRest": "pair_rest",
    "Rebounds": "inverse",
    "bounce": "pair",
    "engine_bounce": "own_law",
    "solref": "recipe",
    "solref_of": "inverse",
}
__all__ = list(_HOMES)  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"{__name__} has no {name}; accepted: {', '.join(_HOMES)}", obj=None)
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
