"""A study: axes, a cell, claims. Its table is computed; measures, tables and pictures select from it."""

from collections.abc import Callable, Mapping
from inspect import signature
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from cointoss.study import Progress
from cointoss_reproduction.frame.declared import Findings, declared, result
from cointoss_reproduction.frame.files import TABLE, said_by
from cointoss_reproduction.frame.result import Reproduction, Result
from cointoss_reproduction.frame.tables import paragraphs

if TYPE_CHECKING:  # names are listed without it
    import pandas as pd
    from matplotlib.figure import Figure

    from cointoss_reproduction.frame.cells import Cells


def study(
    module: str,
    *parts: "Cells",
    found: "Callable[[pd.DataFrame], Mapping[str, Any]]" = lambda _cells: {},
    draw: "Mapping[str, Callable[[pd.DataFrame], Figure]]" = MappingProxyType({}),
) -> Reproduction:
    """Return a study, as the TOML file beside its module declares it.

    Beside what `declared` reads, the file has measures by name, each `[measure.NAME]`, tables, each
    `[[table]]`, and pictures of lines, each `[picture.NAME]`; `selection` says what they select.

    Args:
        module: its full name.
        parts: cells with the axes that they are computed over.
        found: gives what the claims name and no measure selects, from the table; and `tables` after those of
            the file.
        draw: the pictures that are more than lines, by name, each drawn from the table.
    """
    from cointoss_reproduction.frame.cells import read_table, table_of
    from cointoss_reproduction.frame.selection import measured, picture_of, tables_of

    said = said_by(module)
    usual = {
        name: one.default
        for part in parts
        for name, one in signature(part.cell).parameters.items()
        if name not in part.axes
    }

    def findings(cells: "pd.DataFrame", **sizes: Any) -> Findings:
        measures = {name: measured(cells, one) for name, one in said.get("measure", {}).items()}
        own = {"tables": "", **found(cells)}
        own["tables"] = paragraphs(tables_of(cells, said.get("table", ())), own["tables"])
        return Findings(data=cells, **{**usual, **sizes, **measures, **own})

    def make(progress: Progress, *, kept: Path | None = None, **sizes: Any) -> Findings:
        # A cell may name `out`, the folder of all results, to be held against another study's.
        asked = sizes if kept is None else {"out": kept.parents[2], **sizes}
        return findings(table_of(parts, progress, asked, kept=kept), **sizes)

    def read(folder: Path) -> Result:
        return result(module, findings(read_table(folder / TABLE)))

    pictures = {
        name: (lambda cells, one=one: picture_of(cells, one)) for name, one in said.get("picture", {}).items()
    }
    return declared(module, make, read=read, draw={**draw, **pictures}, usual=usual, resumes=True)
