"""The MuJoCo engine: an MJCF cylinder, its drag and its stiff contact; imports models alone."""

from cointoss.coin_mj.bounces.inverse import Rebounds, solref_of
from cointoss.coin_mj.bounces.pair import PairBounce, bounce
from cointoss.coin_mj.bounces.pair_rest import PairRest
from cointoss.coin_mj.bounces.physx import PhysxBounce, physx_bounce
from cointoss.coin_mj.bounces.recipe import Bounce, solref
from cointoss.coin_mj.many import require_rows, toss_rows
from cointoss.coin_mj.model.settings import FINE, MANY, Friction, MujocoSettings, Realisation
from cointoss.coin_mj.release_fields import release_fields
from cointoss.coin_mj.toss import impacts_of, require_supported, toss

__all__ = [
    "FINE",
    "MANY",
    "Bounce",
    "Friction",
    "MujocoSettings",
    "PairBounce",
    "PairRest",
    "PhysxBounce",
    "Realisation",
    "Rebounds",
    "bounce",
    "impacts_of",
    "physx_bounce",
    "release_fields",
    "require_rows",
    "require_supported",
    "solref",
    "solref_of",
    "toss",
    "toss_rows",
]

if __name__ == "coin_mj":  # by its bare name, in a checkout
    from cointoss.bare_names import open_as_part

    open_as_part(__name__)
