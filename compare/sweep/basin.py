"""Make a map in memory, from Python."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cointoss.compare.engines import Engine
from cointoss.compare.sweep.axes import FORM, Axis, axis_given, parse_axis
from cointoss.compare.sweep.errors import SweepError, require_whole
from cointoss.compare.sweep.layout import map_layers
from cointoss.compare.sweep.maps import asked, map_of
from cointoss.compare.sweep.pieces import check_map, gathered
from cointoss.compare.sweep.reading import MOST_READ
from cointoss.compare.sweep.words import in_words
from cointoss.models.devices import Device
from cointoss.models.reading import ScenarioSource, scenario_of
from cointoss.models.scenario import Scenario

if TYPE_CHECKING:
    import xarray as xr

MOST_AFTER = 999_999
"""The most impacts after which a face can be shown, as in the command."""


def basin(
    scenario: ScenarioSource,
    *,
    x: str | tuple[Any, ...] | Mapping[str, Any],
    y: str | tuple[Any, ...] | Mapping[str, Any],
    engine: Engine | str = "analytic",
    after: int | None = None,
    margin: str | None = None,
    trust: bool = False,
    device: Device | str = Device.CPU,
) -> "xr.Dataset":
    """Toss a coin once for each pair of values of two fields, on all cores, and return the map.

    The command `cointoss basin` makes the same map tile by tile on disk, where a long run can be continued.

    Args:
        scenario: a `Scenario`, the path of its file, or the name of one that comes with the package.
        x: the field of the columns and its values: a text, such as "spin=20:60:100", a tuple, such as
            ("spin", 20, 60, 100), or a dict of one field, such as {"spin": (20, 60, 100)}, with a range or an
            array that is evenly spaced; both ends of a range are included, in SI or with a unit.
        y: the field of the rows and its values.
        engine: "analytic" or "mujoco".
        after: show the face at the touch after this number of impacts; by default the final outcome.
        margin: also find the smallest change of this quantity of the release, such as "height", that changes
            a pixel's outcome; by the analytic engine only.
        trust: also find which pixels the engine's own errors may have decided, in two to three times the
            time with `after`, else in two to seven; by the analytic engine only.
        device: "cpu", "cuda" or "auto", as in `toss_many`.

    Returns:
        `outcome` in words and `impacts`, and where asked for `margin`, and `trusted_impacts` or
        `outcome_certain`, over y and x, whose coordinates are named by their fields. `ds.cointoss` draws,
        shows and saves the map.

    Ctrl-C returns the tosses made so far, with a warning; the others have the outcome "not_tossed".

    Raises:
        ScenarioError: naming file, field, value and what is accepted.
        ValueError: naming the argument, its value and what is accepted.
        UnsupportedError: for a scenario that the engine can't toss, or not on that device.
        DeviceError: for the device "cuda" where no card can be used, and where one fails.
    """
    if not isinstance(margin, str | None):
        raise SweepError(f"margin: {margin!r}, accepted: text")
    if not isinstance(trust, bool):
        raise SweepError(f"trust: {trust!r}, accepted: True or False")
    described, tosser = scenario_of(scenario), Engine(engine)
    if after is not None:
        require_whole("after", after, 0, MOST_AFTER)
    batch, how = asked(
        described,
        _axis("x", x, described),
        _axis("y", y, described),
        engine=tosser,
        after=None if after is None else int(after),
        margin=margin,
        trust=trust,
        device=Device(device),
    )
    ny, nx = batch.shape
    if len(batch) > MOST_READ:
        raise SweepError(
            f"x, y: {nx} by {ny} pixels, accepted: at most {MOST_READ:g}; "
            "cointoss basin makes larger maps on disk"
        )
    check_map(batch, how)
    job, name = ("map", "") if isinstance(scenario, Scenario) else (f"map of {scenario}", Path(scenario).stem)
    made = map_of(batch, how, gathered(batch, how, map_layers(how), job), name)
    return in_words(made).assign_attrs(how.processor.attributes)


def _axis(name: str, given: str | tuple[Any, ...] | Mapping[str, Any], described: Scenario) -> Axis:
    """Return an axis of a map."""
    if isinstance(given, str):
        return parse_axis(given, described)
    if isinstance(given, tuple) and len(given) == 4:
        return axis_given(given[0], given[1:], described)
    if not isinstance(given, Mapping) or len(given) != 1:
        raise SweepError(f'{name}: {given!r}, accepted: {FORM}, or a tuple such as ("spin", 20, 60, 4)')
    ((field, values),) = given.items()
    return axis_given(field, values, described)
