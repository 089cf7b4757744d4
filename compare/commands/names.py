"""Arguments and options that a shell can complete with names."""

from collections.abc import Callable, Iterable
from importlib import import_module
from typing import Any

import click

from cointoss.models.sources import named_scenarios


def completing(known: Callable[[], Iterable[str]], *, files: bool = False) -> dict[str, Any]:
    """Return what makes a parameter be completed with names, and where none begins so perhaps with files."""

    def complete(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[Any]:
        from click.shell_completion import CompletionItem

        items = [CompletionItem(incomplete, type="file")] if files else []
        return [*items, *(CompletionItem(name) for name in known() if name.startswith(incomplete))]

    return {"shell_complete": complete}


def settable() -> list[str]:
    """Return what a setting of a field of a scenario begins with."""
    from cointoss.compare.sweep.batch import KNOWN
    from cointoss.models.fields import ROLLS

    return [f"{field}=" for field in (*KNOWN, ROLLS)]


def fields_in(module: str, table: str = "FIELDS") -> Callable[[], list[str]]:
    """Return a function that lists `FIELD=` for each field in a table of a module.

    The module, which takes long to import, is imported when a shell asks.
    """
    return lambda: [f"{field}=" for field in getattr(import_module(module), table)]


_named: dict[str, Any] = {"is_eager": True, **completing(named_scenarios, files=True)}
scenario_argument = click.argument("scenario", **_named)
named_scenario_argument = click.argument(
    "name", required=False, metavar="[NAME]", **completing(named_scenarios)
)
optional_scenario_argument = click.argument("scenario", default=None, **_named)
spared_scenario_argument = click.argument("scenario", default="fig24a", **_named)


def varied(texts: Iterable[str]) -> dict[str, str]:
    """Return what --vary says, by field.

    Raises:
        UsageError: for what has no field, or one that was given before.
    """
    found: dict[str, str] = {}
    for text in texts:
        field, equals, span = text.partition("=")
        if not equals or field.strip() in found:
            raise click.UsageError(f"--vary {text}: accepted: FIELD=START:STOP, each field once")
        found[field.strip()] = span
    return found
