"""The engines by their names, imported only when they are used."""

from enum import StrEnum
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol, cast

from cointoss.models.answers import Answers
from cointoss.models.distribution import versions_of
from cointoss.models.kernel.arrays import Array
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.records import Toss, UnsupportedError
from cointoss.models.rests import with_rest
from cointoss.models.rows import row_of
from cointoss.models.scenario import Scenario

if TYPE_CHECKING:
    from cointoss.analytic import OwnLaw


class EngineSettings(Protocol):
    """An engine's settings: a frozen dataclass."""

    def as_dict(self) -> dict[str, str | float]:
        """Return the settings on which a toss depends, by name."""
        ...


class Package(Protocol):
    """What each engine offers under the same names; settings are those of the same engine."""

    FINE: Any
    """Settings of one toss."""
    MANY: Any
    """Settings of many tosses."""

    def toss(self, scenario: ScenarioSource, *, settings: Any = ...) -> Toss:
        """Toss a coin; raise `UnsupportedError` for what the engine doesn't model."""
        ...

    def toss_rows(self, rows: Array, **how: Any) -> Answers:
        """Toss the scenarios of rows; see `cointoss.analytic.toss_rows`."""
        ...

    def rest_rows(self, rows: Array, **how: Any) -> Array:
        """Return where the coins of rows come to rest; see `cointoss.analytic.rest_rows`."""
        ...

    def require_rows(self, rows: Array, **how: Any) -> None:
        """Raise `UnsupportedError` for rows that the engine doesn't toss so, before the first toss."""
        ...

    def require_supported(self, scenario: Scenario, *, settings: Any) -> None:
        """Raise `UnsupportedError` for what the engine doesn't model, before the first toss."""
        ...


class Engine(StrEnum):
    """An engine's name."""

    ANALYTIC = "analytic"
    MUJOCO = "mujoco"

    @classmethod
    def _missing_(cls, value: object) -> "Engine":
        raise ValueError(f"engine: {value!r}, accepted: {', '.join(cls)}")

    @property
    def package(self) -> Package:
        """The package that tosses, imported when first asked for."""
        return cast("Package", import_module(_PACKAGES[self]))

    @property
    def versions(self) -> dict[str, str]:
        """The versions of what makes its tosses."""
        return versions_of(_MADE_OF[self])


def is_own(engine: str) -> bool:
    """Return whether an engine is one of this package's."""
    return engine in tuple(Engine)


def label_of(engine: str) -> str:
    """Return what an engine is called in words."""
    return "MuJoCo" if engine == Engine.MUJOCO else engine


_PACKAGES = {Engine.ANALYTIC: "cointoss.analytic", Engine.MUJOCO: "cointoss.coin_mj"}
_MADE_OF = {Engine.ANALYTIC: ("cointoss", "numpy"), Engine.MUJOCO: ("cointoss", "numpy", "mujoco")}


def toss(
    scenario: ScenarioSource,
    engine: Engine | str = "analytic",
    *,
    settings: Any = None,
    law: "OwnLaw | None" = None,
    rest: bool = False,
) -> Toss:
    """Toss a coin by one engine.

    Args:
        scenario: what to toss; or a file's path, or a name such as "fig24a".
        engine: "analytic" or "mujoco".
        settings: `analytic.AnalyticSettings` or `coin_mj.MujocoSettings`; by default those of one toss.
        law: a contact law of one's own, in place of the scenario's, for the engine "analytic".
        rest: whether to find where the coin comes to rest, `Toss.rest`; its path goes on up to there, as by
            `ending.until = "rest"`.

    Raises:
        ScenarioError: for a scenario, a file or a name that can't be used.
        UnsupportedError: for a scenario that the engine can't toss.
        ValueError: for another engine.
        TypeError: for settings of another engine.
    """
    name = Engine(engine)
    package = name.package
    more: dict[str, Any] = {} if law is None else {"law": law}
    if more and name != Engine.ANALYTIC:
        raise UnsupportedError(
            f'law: given, accepted: none with the engine {name}; engine = "analytic" takes one'
        )
    more["settings"] = package.FINE if settings is None else settings
    if not rest:
        return package.toss(scenario, **more)
    found = package.toss(scenario_of(scenario).replace("ending.until", "rest"), **more)
    return with_rest(found, package.rest_rows(row_of(found.scenario)[None], **more))
