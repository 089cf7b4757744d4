"""The public names of this project, each brought from its home when it is first used; nothing lives here."""

from functools import cache
from importlib import import_module
from pathlib import Path
from runpy import run_path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import analytic as analytic
    import coin_mj as coin_mj
    from coin_mj.bounce import solref as solref
    from compare.engines import Engine as Engine
    from compare.engines import toss as toss
    from compare.film.back_end import BackEndError as BackEndError
    from compare.report.comparison import Comparison as Comparison
    from compare.report.comparison import compare as compare
    from compare.sweep.errors import MapError as MapError
    from compare.sweep.errors import SweepError as SweepError
    from compare.sweep.in_memory import basin as basin
    from compare.sweep.outcome_map import OutcomeMap as OutcomeMap
    from compare.sweep.reading import read_map as read_map
    from models.errors import ScenarioError as ScenarioError
    from models.hand import Hand as Hand
    from models.laws import ContactLaw as ContactLaw
    from models.laws import EndingTest as EndingTest
    from models.laws import RestitutionKind as RestitutionKind
    from models.outcomes import Outcomes as Outcomes
    from models.reading import load as load
    from models.reading import named_scenarios as named_scenarios
    from models.reading import parse as parse
    from models.records import ApproximationWarning as ApproximationWarning
    from models.records import Ending as Ending
    from models.records import Face as Face
    from models.records import Flag as Flag
    from models.records import Impacts as Impacts
    from models.records import Outcome as Outcome
    from models.records import Setting as Setting
    from models.records import States as States
    from models.records import Toss as Toss
    from models.records import UnsupportedError as UnsupportedError
    from models.records import UnusableEngineError as UnusableEngineError
    from models.releases import Releases as Releases
    from models.scenario import Air as Air
    from models.scenario import Coin as Coin
    from models.scenario import EndingCriteria as EndingCriteria
    from models.scenario import Floor as Floor
    from models.scenario import Release as Release
    from models.scenario import Scenario as Scenario
    from models.unused import UnusedFieldWarning as UnusedFieldWarning

    __version__: str

_PACKAGES = ("analytic", "coin_mj")
_NAMES = {
    "coin_mj.bounce": ("solref",),
    "compare.engines": ("Engine", "toss"),
    "compare.film.back_end": ("BackEndError",),
    "compare.report.comparison": ("Comparison", "compare"),
    "compare.sweep.errors": ("MapError", "SweepError"),
    "compare.sweep.in_memory": ("basin",),
    "compare.sweep.outcome_map": ("OutcomeMap",),
    "compare.sweep.reading": ("read_map",),
    "models.errors": ("ScenarioError",),
    "models.hand": ("Hand",),
    "models.laws": ("ContactLaw", "EndingTest", "RestitutionKind"),
    "models.outcomes": ("Outcomes",),
    "models.reading": ("load", "named_scenarios", "parse"),
    "models.records": (
        "ApproximationWarning",
        "Ending",
        "Face",
        "Flag",
        "Impacts",
        "Outcome",
        "Setting",
        "States",
        "Toss",
        "UnsupportedError",
        "UnusableEngineError",
    ),
    "models.releases": ("Releases",),
    "models.scenario": ("Air", "Coin", "EndingCriteria", "Floor", "Release", "Scenario"),
    "models.unused": ("UnusedFieldWarning",),
}
_HOMES = {name: home for home, names in _NAMES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return import_module("importlib.metadata").version(import_module("models.distribution").DISTRIBUTION)
    if name not in (*_PACKAGES, *_HOMES):
        near = import_module("difflib").get_close_matches(name, __dir__(), n=1)
        hint = f" (did you mean {near[0]}?)" if near else ""
        raise AttributeError(f"cointoss has no {name}; accepted: {', '.join(__dir__())}{hint}")
    _require_siblings()
    import_module("compare.output.progress")  # What takes long says so in a terminal or a notebook.
    return import_module(name) if name in _PACKAGES else getattr(import_module(_HOMES[name]), name)


@cache
def _require_siblings() -> None:
    """Refuse a foreign package that stands for one of ours, once."""
    run_path(str(Path(__file__).parents[1] / "models" / "siblings.py"))


def __dir__() -> list[str]:
    return sorted([*_PACKAGES, *_HOMES, "__version__"])
