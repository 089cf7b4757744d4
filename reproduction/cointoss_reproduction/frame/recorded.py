"""A study: it computes a record of numbers, from which its claims, tables and pictures follow."""

from collections.abc import Callable, Mapping
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from cointoss_reproduction.frame.declared import Findings, declared, result
from cointoss_reproduction.frame.result import Reproduction, Result
from cointoss_reproduction.frame.saving import read_numbers

if TYPE_CHECKING:  # names are listed without it
    from matplotlib.figure import Figure


def recorded(
    module: str,
    compute: Callable[..., Any],
    *,
    measures: Callable[[Any], Mapping[str, Any]],
    tables: Callable[[Any], str],
    draw: "Mapping[str, Callable[[Any], Figure]]",
    record: type | None = None,
    **others: Any,
) -> Reproduction:
    """Return a study, as the TOML file beside its module declares it.

    Args:
        module: its full name.
        compute: gives the record, from a `Progress` and the sizes of the run.
        measures: gives what the declared claims name, from the record.
        tables: gives the tables in Markdown.
        draw: the pictures, by name, each drawn from the record.
        record: its type; none where it cannot be read again.
        others: further fields of `Reproduction`.
    """

    def findings(found: Any) -> Findings:
        return Findings(data=found, tables=tables(found), **measures(found))

    @wraps(compute)
    def make(*arguments: Any, **sizes: Any) -> Findings:
        return findings(compute(*arguments, **sizes))

    def read(folder: Path) -> Result:
        return result(module, findings(read_numbers(folder, cast(type, record))))

    return declared(module, make, read=read if record else None, draw=draw, **others)
