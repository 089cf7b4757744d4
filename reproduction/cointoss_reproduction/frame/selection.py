"""What a study selects from its table: measures for its claims, tables and pictures for its page."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import ceil
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from cointoss.study import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PURPLE,
    SKY,
    VERMILION,
    Estimate,
    chance_alike,
    in_words,
    percent,
    share_of,
    table,
)
from cointoss_reproduction.frame.cells import ENDS, estimate
from cointoss_reproduction.frame.tables import paragraphs

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Declared = Mapping[str, Any]
"""A table of the TOML file."""
TAKEN = {
    "max": lambda values: float(np.max(values)),
    "min": lambda values: float(np.min(values)),
    "farthest": lambda values: float(np.max(np.abs(values))),
    "median": lambda values: float(np.median(values)),
    "mean": lambda values: float(np.mean(values)),
    "sum": lambda values: np.sum(values).item(),
    "range": lambda values: float(np.ptp(values)),
}
"""The functions that make one number of several."""
COLORS = (BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY, INK, GREY)
"""The colours of the lines of a picture."""


def selected(cells: pd.DataFrame, said: Declared) -> pd.DataFrame:
    """Return the rows that a declaration selects by its `where`, of pandas' query; all without.

    `per` has columns: the numbers of rows that are the same there are added up.
    """
    rows = cells.query(said["where"], engine="python") if "where" in said else cells
    if "per" in said:
        return pd.DataFrame(rows.groupby(said["per"], sort=False, as_index=False).sum(numeric_only=True))
    return rows


def measured(cells: pd.DataFrame, said: Declared) -> Any:
    """Return what a measure selects: one number or estimate, or several by what distinguishes their rows.

    A measure has `value`, a column or an expression of columns, or `share`, the columns of a part and of its
    whole. If some of the part is undecided, `share` has three columns: the part that is known, the part with
    all that is undecided, and the whole; the interval then goes from the low end of the first share to the
    high end of the second. `less` is subtracted: a number or, without `take`, a column of the row. `take`
    names one of `TAKEN`, which makes one number of all rows, or of the rows of each `key`. `key` has the
    columns that name the rows, by default none where one row is selected. `alike` has columns of counts: the
    probability by chance that rows of the same `key` differ as they do. A row of another cell, which has no
    such value, is not selected.

    Raises:
        ValueError: where nothing is selected.
    """
    rows = _having(selected(cells, said), said)
    if rows.empty:
        raise ValueError(f"{said}: selects no row")
    groups = _groups(rows, said.get("key"))
    if "alike" in said:
        return {_name(key): chance_alike(each[said["alike"]].to_numpy(dtype=int)) for key, each in groups}
    if "take" in said:
        taken = {_name(key): _shifted(_taken(each, said), said) for key, each in groups}
        return taken if "key" in said else taken[""]
    found = [_shifted(_one(row, said), said, row) for row in rows.to_dict("records")]
    if "key" not in said:
        if len(found) != 1:
            raise ValueError(f"{said}: selects {len(found)} rows, and has no key")
        return found[0]
    return dict(zip(_names(rows, said["key"]), found, strict=True))


def _taken(rows: pd.DataFrame, said: Declared) -> Any:
    if "share" in said:
        return _one({column: np.sum(rows[column]) for column in said["share"]}, said)
    return TAKEN[said["take"]](rows[said["value"]].to_numpy(dtype=float))


def _having(rows: pd.DataFrame, said: Declared) -> pd.DataFrame:
    """Return the rows that have what a measure takes, with its value as a column; an estimate may be NaN."""
    valued = _with_value(rows, said)
    columns = said.get("alike") or said.get("share") or [said["value"]]
    counted = [one + ENDS[-1] for one in columns if one + ENDS[-1] in valued]
    return valued.loc[valued[columns].notna().all(axis=1) | valued[counted].notna().any(axis=1)]


def _with_value(rows: pd.DataFrame, said: Declared) -> pd.DataFrame:
    value = said.get("value")
    if value is None or value in rows:
        return rows
    return rows.assign(**{value: rows.eval(value, engine="python")})


def _one(row: Mapping[Any, Any], said: Declared) -> Any:
    if "share" in said:
        *parts, whole = (int(row[column]) for column in said["share"])
        known, most = (share_of(part, whole, said.get("counted", "tosses")) for part in (parts[0], parts[-1]))
        return replace(known, high=most.high)
    return estimate(row, said["value"])


def _shifted(found: Any, said: Declared, row: Mapping[Any, Any] = MappingProxyType({})) -> Any:
    return found - row.get(said["less"], said["less"]) if "less" in said else found


def _names(rows: pd.DataFrame, columns: list[str]) -> list[str]:
    return [_name(tuple(row)) for row in rows[columns].itertuples(index=False)]


def _name(key: Any) -> str:
    """Return what distinguishes a row from the others, in words."""
    parts = key if isinstance(key, tuple) else (key,)
    return ", ".join(f"{one:g}" if isinstance(one, float) else str(one) for one in parts)


def tables_of(cells: pd.DataFrame, declared: Sequence[Declared]) -> str:
    """Return the declared tables in Markdown.

    A table has the sentence that it `says`, `where`, and `columns`: each a heading, a column or an expression
    or a pair whose share is shown, and a format; or a heading and words with columns in them, as in
    "{median:.0e} ({worst:.0e})". The last is spread `across` the names on an axis.
    """
    return paragraphs(*(block for said in declared for block in (said["says"], _table(cells, said))))


def _table(cells: pd.DataFrame, said: Declared) -> str:
    rows = selected(cells, said)
    heads = [head for head, *_ in said["columns"]]
    shown = [_column(rows, *what) for _, *what in said["columns"]]
    body = [list(row) for row in zip(*shown, strict=True)]
    if "across" in said:
        heads, body = _across(heads, body, [_name((one,)) for one in rows[said["across"]]])
    return table(heads, body)


def _column(rows: pd.DataFrame, what: str | list[str], form: str = "") -> list[str]:
    if "{" in what:
        return [str(what).format(**row) for row in rows.to_dict("records")]
    measure = {"share": what} if isinstance(what, list) else {"value": what}
    found = [_one(row, measure) for row in _with_value(rows, measure).to_dict("records")]
    return [_cell(one, form) for one in found]


def _across(heads: list[str], body: list[list[str]], names: list[str]) -> tuple[list[str], list[list[str]]]:
    spread: dict[tuple[str, ...], dict[str, str]] = {}
    for (*key, last), name in zip(body, names, strict=True):
        spread.setdefault(tuple(key), {})[name] = last
    columns = list(dict.fromkeys(names))
    return [*heads[:-1], *columns], [
        [*key, *(row.get(one, "") for one in columns)] for key, row in spread.items()
    ]


def _cell(found: Any, form: str = "") -> str:
    if pd.isna(found.value if isinstance(found, Estimate) else found):
        return ""
    if isinstance(found, Estimate):
        return in_words(found, form) if form else percent(found)
    return format(found, form or ("g" if isinstance(found, float) else ""))


def picture_of(cells: pd.DataFrame, said: Declared | Sequence[Declared]) -> "Figure":
    """Draw lines: `y`, an expression or the columns of a share, over `x`, one for each of what is in `lines`.

    In place of `x` there may be `names`, columns that name the rows down the side of the picture. `panels`
    names an axis that has a panel for each name. `levels` are drawn as grey lines, `style` is of Matplotlib;
    of lines whose rows are of several `kinds`, a column, each kind has its own. `legend` is the title of
    a panel's own; all else is what `Axes.set` takes. Several declarations are drawn side by side, more than
    three in two rows.
    """
    from matplotlib.figure import Figure

    panels = [
        (name, rows, part)
        for part in ([said] if isinstance(said, Mapping) else said)
        for name, rows in _groups(_having(selected(cells, part), _drawn(part)), part.get("panels"))
    ]
    down = 1 if len(panels) < 4 else 2
    across = ceil(len(panels) / down)
    drawn = Figure(figsize=(7 if across == 1 else 4.5 * across, 3.8 * down))
    grid = drawn.subplots(down, across, squeeze=False)
    for empty in grid.flat[len(panels) :]:
        empty.remove()
    for axes, (name, rows, part) in zip(grid.flat, panels, strict=False):
        names = list(dict.fromkeys(_names(rows, part.get("names", []))))
        for number, style, line, (value, low, high) in _lines(rows, part):
            ends = [value - low, high - value] if np.any(low < high) else None
            if "names" in part:
                at = [names.index(name) + number / 5 for name in _names(line, part["names"])]
                axes.errorbar(value, at, xerr=ends, **style)
            else:
                x = line.eval(part["x"], engine="python")
                axes.errorbar(x, value, ends, **style)
                if not pd.api.types.is_numeric_dtype(x):
                    axes.tick_params(axis="x", rotation=20)
        if "names" in part:
            axes.set_yticks(range(len(names)), names)
            axes.invert_yaxis()
        for level in part.get("levels", ()):
            (axes.axvline if "names" in part else axes.axhline)(level, color="grey", linewidth=0.8)
        axes.set(
            **({"title": str(name)} | {key: one for key, one in part.items() if key not in _OF_PICTURES})
        )
    labels = [axes.get_legend_handles_labels()[1] for axes in drawn.axes]
    for axes, own, (_, _, part) in zip(drawn.axes, labels, panels, strict=True):
        if own and ("legend" in part or own != labels[-1]):
            axes.legend(title=part.get("legend"), fontsize="x-small")
    if labels[-1] and "legend" not in panels[-1][-1]:
        drawn.axes[-1].legend(loc="upper left", bbox_to_anchor=(1, 1))
    return drawn


_OF_PICTURES = {"where", "per", "x", "y", "names", "lines", "kinds", "panels", "levels", "style", "legend"}


def _lines(rows: pd.DataFrame, said: Declared) -> Iterator[tuple[int, dict[str, Any], pd.DataFrame, Any]]:
    styles = said.get("style", "o-")
    for number, (key, line) in enumerate(_groups(rows, said.get("lines"))):
        label = _name(key)
        for kind, part in _groups(line, said.get("kinds")):
            found = [_one(row, _drawn(said)) for row in part.to_dict("records")]
            ends = [one.ends if isinstance(one, Estimate) else (one, one, one) for one in found]
            style = styles[kind] if isinstance(styles, Mapping) else styles
            shown = {"fmt": style, "color": COLORS[number % len(COLORS)], "label": label, "capsize": 2}
            yield number, shown, part, np.array(ends, dtype=float).T
            label = ""


def _groups(rows: pd.DataFrame, by: Any) -> Iterable[tuple[Any, pd.DataFrame]]:
    return rows.groupby(by, sort=False) if by else [("", rows)]


def _drawn(said: Declared) -> Declared:
    return {"share" if isinstance(said["y"], list) else "value": said["y"]}
