"""The option `--set`: other values of fields of the scenario."""

from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import wraps
from typing import TYPE_CHECKING, Any

import click

from cointoss.compare.commands.common import TextType, plain_errors, refuse
from cointoss.compare.commands.names import completing, settable
from cointoss.compare.sweep.asked import Source

if TYPE_CHECKING:
    from cointoss.models.scenario import Scenario

FORM = "FIELD=VALUE, such as restitution=0.5, contact=coulomb or 'height=40 cm'"


def _setting(text: str) -> str:
    """Return a setting as it was typed."""
    field, equals, given = text.partition("=")
    if not (equals and field.strip() and given.strip()):
        raise ValueError(FORM)
    return text


set_option = click.option(
    "--set",
    "settings",
    type=TextType("setting", _setting),
    multiple=True,
    metavar="FIELD=VALUE",
    help="Another value of a field of the scenario, as its file would have it: restitution=0.5, "
    "contact=coulomb, 'height=40 cm'; may be given again.",
    **completing(settable),
)


def described(source: str, text: str, settings: Sequence[str]) -> "tuple[Scenario, str]":
    """Return a scenario in which some fields have other values, and the text of its file.

    Args:
        source: its file, or the name of one that comes with the package.
        text: of the file: a pipe can be read only once.
        settings: FIELD=VALUE each, which take their places in turn. A field may be named in part, as
            "restitution"; a value is a number, a text with a unit, a word or a list, as in a file.

    Raises:
        ScenarioError: naming the source, field, value and what is accepted.
        SweepError: for a field that a scenario does not have, naming what is accepted.
    """
    from cointoss.models.errors import ScenarioError
    from cointoss.models.reading import parse
    from cointoss.models.unlikely import warn_of_unlikely_units
    from cointoss.models.unused import warn_of_unused_fields

    pairs = _pairs(settings) if settings else []  # before what reads a scenario, which takes an engine
    scenario = parse(text, source)
    if pairs:
        try:
            scenario = scenario.replace(*pairs)
        except ScenarioError as error:
            raise ScenarioError(f"{source}: {error}") from None
        text = scenario.to_toml()
    warn_of_unused_fields(scenario.floor, scenario.air)
    warn_of_unlikely_units(scenario.gravity, scenario.coin, scenario.release, scenario.ending)
    return scenario, text


def _pairs(settings: Sequence[str]) -> list[Any]:
    """Return the whole name of each field that is set, and after it its value."""
    from cointoss.compare.sweep.axes import named
    from cointoss.compare.sweep.batch import KNOWN
    from cointoss.models.fields import ROLLS
    from cointoss.models.parts import Air

    typed = [setting.partition("=") for setting in settings]
    known = (*KNOWN, ROLLS, *(f"air.{name}" for name in Air.instead))
    return [word for name, _, value in typed for word in (named(name.strip(), known), _value(value))]


def with_scenario(command: Callable[..., None]) -> Callable[..., None]:
    """Return a command that takes a scenario and its settings, which it has as `source`, None without one.

    What is wrong with it, or with the scenario, is said in one line.
    """

    @wraps(command)
    def called(*arguments: Any, scenario: str | None, settings: tuple[str, ...], **asked: Any) -> None:
        if scenario is None and settings:
            raise click.UsageError(f"--set {settings[0]}: accepted: only with a SCENARIO")
        text = "" if scenario is None else _text_of(scenario)
        with plain_errors("cointoss" if scenario is None else scenario):
            command(
                *arguments,
                source=scenario and Source(scenario, *described(scenario, text, settings), settings),
                **asked,
            )

    return called


def _text_of(source: str) -> str:
    """Return a scenario's text, or refuse one that is not there before the slow imports that read it."""
    from cointoss.models.errors import ScenarioError
    from cointoss.models.sources import scenario_text

    try:
        return scenario_text(source)
    except ScenarioError as error:
        refuse(str(error))


def _value(text: str) -> Any:
    """Return what a scenario file's line would say; a text that is no value of TOML is a number or a word."""
    import tomllib

    with suppress(tomllib.TOMLDecodeError, RecursionError):
        found = tomllib.loads(f"value = {text}")
        if found.keys() == {"value"}:
            return found["value"]
    try:
        return float(text)  # such as .5
    except ValueError:
        return text.strip()
