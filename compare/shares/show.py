"""The dataset of shares, as a table, as files, and compared between both engines."""

import json
from collections.abc import Hashable, Iterator
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import chance_alike, percent, wilson
from cointoss.compare.output.tables import sheet, table
from cointoss.compare.sweep.axes import word_of
from cointoss.models.units import printed_unit

_FACES, _LAST = ["heads", "tails"], "undecided"


def shares_of(
    counts: NDArray[np.int64], dims: tuple[Hashable, ...], coordinates: Any, attributes: Any
) -> xr.Dataset:
    """Return a dataset of shares and their 99 % intervals.

    Args:
        counts: of each outcome, (..., 6).
        dims: of the counts.
        coordinates: of these.
        attributes: of the dataset.
    """
    values, low, high = wilson(counts, counts.sum(axis=-1, keepdims=True))
    about = {
        "count": (counts, "number of tosses"),
        "share": (values, "share of the tosses"),
        "low": (low, "low end of its 99 % interval"),
        "high": (high, "high end of its 99 % interval"),
    }
    variables = {name: (dims, array, {"long_name": text}) for name, (array, text) in about.items()}
    return xr.Dataset(variables, coordinates, attributes)


def over_engines(shares: xr.Dataset) -> xr.Dataset:
    """Return shares over engine, the fields that vary, and outcome, in this order."""
    whole = shares if "engine" in shares.dims else shares.expand_dims("engine")
    return whole.transpose("engine", ..., "outcome")


def fields_of(shares: xr.Dataset) -> list[str]:
    """Return the fields that vary, in their order."""
    return [str(dim) for dim in shares["count"].dims if dim not in ("engine", "outcome")]


def outcomes_of(shares: xr.Dataset) -> list[str]:
    """Return heads, tails, and the other outcomes that there were."""
    met = shares["count"].sum([dim for dim in shares["count"].dims if dim != "outcome"])
    others = [str(one) for one in shares.outcome.values if one not in _FACES and met.sel(outcome=one)]
    faces = [one for one in _FACES if one in shares.outcome.values]
    return [*faces, *sorted(others, key=lambda one: one == _LAST)]


def alike(shares: xr.Dataset) -> NDArray[np.float64]:
    """Return the probability, for each setting, that both engines' counts differ by chance as much as these.

    It is that of a χ² test; NaN where an engine tossed nothing. With one engine there is none, (0,).
    """
    counts = over_engines(shares)["count"].values
    if len(counts) < 2:
        return np.empty(0)
    flat = counts.reshape(len(counts), -1, counts.shape[-1])
    both = (flat[:, i] for i in range(flat.shape[1]))
    return np.array([chance_alike(one) if one.any(axis=1).all() else np.nan for one in both])


def least_alike(shares: xr.Dataset) -> float:
    """Return the probability that the smallest of `alike` is by chance as small as it is."""
    known = alike(shares)
    known = known[~np.isnan(known)]
    return float(1 - (1 - known.min()) ** len(known)) if len(known) else np.nan


class _Row(NamedTuple):
    """A setting by one engine."""

    at: tuple[int, ...]
    """Its place in the grid."""
    engine: str
    tosses: int
    """How many were counted."""
    not_caught: int
    counts: dict[str, int]
    shares: dict[str, Estimate]


def _rows(shares: xr.Dataset) -> Iterator[_Row]:
    """Yield each setting by each engine, the engine varying fastest."""
    whole, names = over_engines(shares), [str(one) for one in shares.outcome.values]
    ends = np.stack([whole[name].values for name in ("share", "low", "high")], axis=-1)
    counts = whole["count"].values
    missed = whole["not_caught"].values if "not_caught" in whole else np.zeros(counts.shape[:-1], dtype=int)
    for *at, engine in np.ndindex(*counts.shape[1:-1], len(counts)):
        place = (engine, *at)
        own, tosses = dict(zip(names, counts[place].tolist(), strict=True)), int(counts[place].sum())
        found = [Estimate(value, low, high, tosses) for value, low, high in ends[place].tolist()]
        told = dict(zip(names, found, strict=True))
        yield _Row(tuple(at), str(whole.engine.values[engine]), tosses, int(missed[place]), own, told)


def markdown(shares: xr.Dataset) -> str:
    """Return the shares with their 99 % intervals, as a table in Markdown."""
    fields, outcomes, chances = fields_of(shares), outcomes_of(shares), alike(shares)
    both = len(chances) > 0
    texts, rows = [texts_of(shares[field].values) for field in fields], []
    for i, row in enumerate(_rows(shares)):
        setting, is_second = divmod(i, 2) if both else (i, 0)
        values = ["" if is_second else text[k] for text, k in zip(texts, row.at, strict=True)]
        cells = [percent(row.shares[one]) if row.tosses else "-" for one in outcomes]
        chance = [f"{chances[setting]:.2g}" if is_second else ""] * both
        rows.append([*values, *[row.engine] * both, f"{row.tosses:,d}", *cells, *chance])
    heads = [labelled(shares, field) for field in fields]
    return table([*heads, *["engine"] * both, "tosses", *outcomes, *["by chance"] * both], rows)


def texts_of(values: NDArray[np.float64]) -> list[str]:
    """Return values in as few digits as keep them different from each other."""
    if values.dtype.kind not in "iuf":
        return [str(value) for value in values.tolist()]
    written = ([f"{value:.{digits}g}" for value in values.tolist()] for digits in range(6, 18))
    return next(texts for texts in written if len(set(texts)) == len(values))


def labelled(shares: xr.Dataset, field: str) -> str:
    """Return what a person calls a field that varies, with its unit."""
    unit = printed_unit(shares[field].attrs.get("units", ""))
    return f"{word_of(field)} [{unit}]" if unit else word_of(field)


def csv(shares: xr.Dataset) -> str:
    """Return a row for each setting and engine as comma-separated values, in SI and full precision."""
    fields, outcomes = fields_of(shares), outcomes_of(shares)
    units = [printed_unit(shares[field].attrs["units"]) for field in fields]
    heads = [f"{field} [{unit}]" if unit else field for field, unit in zip(fields, units, strict=True)]
    names = [f"{one}{part}" for one in outcomes for part in ("", " low", " high", " count")]
    rows = []
    for row in _rows(shares):
        values = [repr(float(shares[field].values[k])) for field, k in zip(fields, row.at, strict=True)]
        cells = [[*map(repr, row.shares[one].ends), str(row.counts[one])] for one in outcomes]
        rows.append([*values, row.engine, str(row.tosses), *(cell for each in cells for cell in each)])
    return sheet([*heads, "engine", "tosses", *names], rows)


def as_json(shares: xr.Dataset) -> dict[str, Any]:
    """Return what `cointoss shares --json` prints, but for the names of what was asked for."""
    fields, chances, settings = fields_of(shares), alike(shares), []
    for row in _rows(shares):
        ends = {one: {"value": x.value, "low": x.low, "high": x.high} for one, x in row.shares.items()}
        settings.append(
            {
                **{field: float(shares[field].values[k]) for field, k in zip(fields, row.at, strict=True)},
                "engine": row.engine,
                "tosses": row.tosses,
                "not_caught": row.not_caught,
                "shares": ends if row.tosses else dict.fromkeys(ends),
            }
        )
    along = [
        {"field": field, "unit": shares[field].attrs["units"], "values": shares[field].values}
        for field in fields
    ]
    told = {"hand": json.loads(shares.attrs["hand"]), "seed": shares.attrs["seed"], "along": along}
    return told | {"settings": settings} | ({"by_chance": chances} if len(chances) else {})
