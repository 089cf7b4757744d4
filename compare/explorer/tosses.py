"""The toss of a pixel by one engine, as the explorer's page reads it."""

import warnings
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from cointoss.compare.engines import Engine
from cointoss.compare.film.back_end import BackEndError, require_mujoco
from cointoss.compare.film.filmed import followed
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.maps import asked_of, axes_of
from cointoss.compare.web.playable import MOST_SYMBOLS, SAMPLES, path_of, playable, rounded
from cointoss.models.records import ApproximationWarning, UnsupportedError, UnusableEngineError
from cointoss.models.scenario import Scenario

if TYPE_CHECKING:
    import xarray as xr

MOST_IMPACTS = {Engine.ANALYTIC: 20_000, Engine.MUJOCO: 500}
"""A toss is followed up to this number of impacts: some seconds of work."""


def toss_pixel(
    found: "xr.Dataset",
    x: float,
    y: float,
    engine: Engine,
    *,
    samples: int = SAMPLES,
    most_symbols: int = MOST_SYMBOLS,
) -> dict[str, Any]:
    """Return the toss at a point of a map, to its end also where the map shows an earlier touch.

    Args:
        found: the map.
        x: value of the field of the columns.
        y: value of the field of the rows.
        engine: that tosses, with its settings of one toss.
        samples: of the path.
        most_symbols: of the sequence.

    Raises:
        SweepError: for values that make no valid scenario.
    """
    scenario = scenario_at(found, x, y)
    most = MOST_IMPACTS[engine]
    limited = scenario.replace("ending.max_impacts", min(most, scenario.rules.max_impacts))
    with warnings.catch_warnings(record=True, action="always", category=ApproximationWarning) as raised:
        try:
            require_mujoco(engine)
            toss = engine.package.toss(limited, settings=_settings(found, engine))
            shown = followed(toss, _settings(found, engine))
            played = playable(toss, 2, most_symbols)
        except (UnsupportedError, UnusableEngineError, BackEndError, FloatingPointError) as error:
            return {"engine": engine.value, "problem": str(error)}
    notes = [str(one.message) for one in raised if issubclass(one.category, ApproximationWarning)]
    cut = len(toss.impacts) == most < scenario.rules.max_impacts
    ending = {"ending": f"It is shown up to impact {most}."} if cut else {}
    later = {
        "later_times": rounded(shown.later_times[:most_symbols], 7),
        "path": path_of(shown.longest, samples),
    }
    return {**played, **later, **ending, "notes": notes}


def scenario_at(found: "xr.Dataset", x: float, y: float) -> Scenario:
    """Return the scenario of the toss at a point of a map.

    Raises:
        ScenarioError: for values that make no valid scenario, naming them.
    """
    batch, _ = asked_of(found)
    given = zip([one.field for one in batch.varied], (y, x), strict=True)
    # A number of impacts is whole on every axis.
    pairs = ((field, int(at) if field == "ending.max_impacts" else at) for field, at in given)
    first, second = pairs
    return batch.scenario.replace(*first, *second)


def _settings(found: "xr.Dataset", engine: Engine) -> Any:
    """Return an engine's settings of one toss, MuJoCo's with the contact of the map where it made that."""
    fine, (_, how) = engine.package.FINE, asked_of(found)
    return replace(fine, contact=how.settings.contact) if how.engine == engine == Engine.MUJOCO else fine


def require_inside(found: "xr.Dataset", x: float, y: float) -> None:
    """Refuse a point outside of a map.

    Raises:
        SweepError: naming the field, its value and what is accepted.
    """
    for axis, value in zip(axes_of(found), (y, x), strict=True):
        low, high = sorted((axis.start, axis.stop))
        if not low <= value <= high:
            raise SweepError(f"{axis.field} = {value:g}: accepted: a number from {low!r} to {high!r}")
        if axis.field == "ending.max_impacts" and value != int(value):
            raise SweepError(f"{axis.field} = {value:g}: accepted: a whole number")
