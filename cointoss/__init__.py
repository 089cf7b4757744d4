"""The public names of this project, each brought from its home when it is first used; nothing lives here."""

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cointoss.homes import brought, homes_of

if TYPE_CHECKING:
    from cointoss import analytic as analytic
    from cointoss import coin_mj as coin_mj
    from cointoss import models as models
    from cointoss.analytic.impact.own_law import OwnLaw as OwnLaw
    from cointoss.compare.engines import Engine as Engine
    from cointoss.compare.engines import toss as toss
    from cointoss.compare.film.back_end import BackEndError as BackEndError
    from cointoss.compare.find.find import Found as Found
    from cointoss.compare.find.find import find as find
    from cointoss.compare.fitting.errors import ObservationError as ObservationError
    from cointoss.compare.fitting.fit import Fit as Fit
    from cointoss.compare.fitting.fit import Fitted as Fitted
    from cointoss.compare.fitting.fit import fit as fit
    from cointoss.compare.fitting.observed import Observed as Observed
    from cointoss.compare.flips.counts import Flips as Flips
    from cointoss.compare.flips.hand_fit import HandFit as HandFit
    from cointoss.compare.flips.hand_fit import PersonFit as PersonFit
    from cointoss.compare.flips.hand_fit import flips as flips
    from cointoss.compare.flips.offset import offset as offset
    from cointoss.compare.flips.sides import Sides as Sides
    from cointoss.compare.lab.lab import lab as lab
    from cointoss.compare.report.comparison import Comparison as Comparison
    from cointoss.compare.report.comparison import compare as compare
    from cointoss.compare.shares.shares import shares as shares
    from cointoss.compare.sweep.basin import basin as basin
    from cointoss.compare.sweep.errors import MapError as MapError
    from cointoss.compare.sweep.errors import SweepError as SweepError
    from cointoss.compare.sweep.reading import read_map as read_map
    from cointoss.compare.sweep.toss_many import toss_many as toss_many
    from cointoss.models.devices import DeviceError as DeviceError
    from cointoss.models.devices import DeviceWarning as DeviceWarning
    from cointoss.models.errors import ScenarioError as ScenarioError
    from cointoss.models.hand import Hand as Hand
    from cointoss.models.hand import load_hand as load_hand
    from cointoss.models.laws import ContactLaw as ContactLaw
    from cointoss.models.laws import EndingTest as EndingTest
    from cointoss.models.laws import RestitutionKind as RestitutionKind
    from cointoss.models.parts import Air as Air
    from cointoss.models.parts import Coin as Coin
    from cointoss.models.parts import EndingCriteria as EndingCriteria
    from cointoss.models.parts import Floor as Floor
    from cointoss.models.parts import Release as Release
    from cointoss.models.reading import load as load
    from cointoss.models.reading import parse as parse
    from cointoss.models.records import ApproximationWarning as ApproximationWarning
    from cointoss.models.records import Ending as Ending
    from cointoss.models.records import Face as Face
    from cointoss.models.records import Flag as Flag
    from cointoss.models.records import Impacts as Impacts
    from cointoss.models.records import Outcome as Outcome
    from cointoss.models.records import Setting as Setting
    from cointoss.models.records import States as States
    from cointoss.models.records import Toss as Toss
    from cointoss.models.records import TrustEnd as TrustEnd
    from cointoss.models.records import UnsupportedError as UnsupportedError
    from cointoss.models.records import UnusableEngineError as UnusableEngineError
    from cointoss.models.resting_place import Rest as Rest
    from cointoss.models.resting_place import RestReason as RestReason
    from cointoss.models.scenario import Scenario as Scenario
    from cointoss.models.sources import named_scenarios as named_scenarios
    from cointoss.models.unlikely import UnitWarning as UnitWarning
    from cointoss.models.unused import UnusedFieldWarning as UnusedFieldWarning

    __version__: str

_PACKAGES = ("models", "analytic", "coin_mj", "compare")
_HOMES = homes_of(__file__)

# In a checkout the four folders lie beside this one, and links lead to them. Where a system or an archive has
# lost the links, they are found there all the same.
if not (Path(__file__).parent / "models").is_dir():
    __path__.append(str(Path(__file__).parents[1]))
    if not (Path(__path__[-1]) / "models").is_dir():
        raise ImportError(
            f"{Path(__file__).parent}: without its folders {', '.join(_PACKAGES)}; "
            "accepted: these in it, or beside it (get the project again, or install it by pip)"
        )


# Here and not in `__getattr__`, so that a toss has its views whichever module of the package made it.
import_module("cointoss.models.views").HOMES.update(
    plot_toss="cointoss.compare.output.plots",
    play="cointoss.compare.web.play.frame",
    gltf="cointoss.compare.film.gltf",
)


def __getattr__(name: str) -> Any:
    if name == "__all__":  # as `from cointoss import *` asks; type checkers take the names above
        return [*_PACKAGES, *_HOMES]
    if name == "__version__":
        return import_module("cointoss.models.distribution").versions_of(["cointoss"])["cointoss"]
    if name in ("basin", "read_map", "shares", "toss_many"):  # whose datasets have `.cointoss`
        from cointoss.compare import accessor as accessor
    return import_module(f"cointoss.{name}") if name in _PACKAGES else brought(_HOMES, name, __name__)


def __dir__() -> list[str]:
    return sorted({*_PACKAGES, *_HOMES, "__version__"})
