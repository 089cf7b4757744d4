"""Arguments and options that a shell can complete with names."""

from collections.abc import Callable, Iterable
from typing import Any

import click


def completing(known: Callable[[], Iterable[str]], *, files: bool = False) -> dict[str, Any]:
    """Return what makes a parameter be completed with names, and where none begins so perhaps with files."""

    def complete(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[Any]:
        from click.shell_completion import CompletionItem

        items = [CompletionItem(incomplete, type="file")] if files else []
        return [*items, *(CompletionItem(name) for name in known() if name.startswith(incomplete))]

    return {"shell_complete": complete}


def _scenarios() -> list[str]:
    from cointoss.models.sources import named_scenarios

    return named_scenarios()


def settable() -> list[str]:
    """Return what a setting of a field of a scenario begins with."""
    from cointoss.compare.sweep.batch import KNOWN
    from cointoss.models.fields import ROLLS

    return [f"{field}=" for field in (*KNOWN, ROLLS)]


def axes() -> list[str]:
    """Return what an axis of a map begins with."""
    from cointoss.models.fields import UNITS

    return [f"{field}=" for field in UNITS]


def ranging() -> list[str]:
    """Return what an axis of a count begins with."""
    from cointoss.compare.shares.plan import FIELDS

    return [f"{field}=" for field in FIELDS]


def varying() -> list[str]:
    """Return what a span of a search begins with."""
    from cointoss.compare.find.fields import FIELDS

    return [f"{field}=" for field in FIELDS]


def fitted() -> list[str]:
    """Return what a span of a fit begins with."""
    return ["clock=", *(axis for axis in axes() if not axis.startswith(("ending.", "release.quaternion.")))]


_named: dict[str, Any] = {"is_eager": True, **completing(_scenarios, files=True)}
scenario_argument = click.argument("scenario", **_named)
named_scenario_argument = click.argument("name", required=False, metavar="[NAME]", **completing(_scenarios))
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
