"""Arrays with their axes and units, for xarray and pandas; both are imported where they are asked for."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

AXES = {
    "space": ("axis", ("x", "y", "z")),
    "body": ("body_axis", ("xi", "eta", "zeta")),
    "attitude": ("parameter", ("e0", "e1", "e2", "e3")),
}
"""Of a vector's components: the name of the dimension, and that of each component."""


class Column(NamedTuple):
    """One quantity of many rows."""

    values: NDArray[Any]
    """(n,), or (n, components)."""
    attributes: dict[str, Any]
    """As CF has them: long_name, units, flag_values, flag_meanings."""
    axes: str = ""
    """One of `AXES`; empty for a number."""


def meanings_of(labels: Mapping[int, str]) -> dict[str, Any]:
    """Return the attributes in which the CF conventions keep what the values of a variable mean."""
    return {"flag_values": list(labels), "flag_meanings": " ".join(labels.values())}


def dataset(row: str, columns: Mapping[str, Column], about: Mapping[str, Any]) -> "xr.Dataset":
    """Return columns as a dataset of xarray.

    Args:
        row: the name of the dimension of the rows; a column of this name is its coordinate.
        columns: by name.
        about: attributes of the whole.
    """
    import xarray

    variables, coordinates = {}, {}
    for name, column in columns.items():
        dimensions = [row]
        if column.axes:
            dimension, components = AXES[column.axes]
            dimensions.append(dimension)
            coordinates[dimension] = list(components)
        (coordinates if name == row else variables)[name] = (dimensions, column.values, column.attributes)
    return xarray.Dataset(variables, coordinates, dict(about))


def table(row: str, columns: Mapping[str, Column]) -> "pd.DataFrame":
    """Return columns as a table of pandas: a column for each component, words for values that mean one.

    Its `attrs["units"]` has the unit of each column that has one.

    Args:
        row: the column that is the table's index.
        columns: by name.
    """
    import xarray

    plain: dict[str, Any] = {}
    units: dict[str, str] = {}
    for name, column in columns.items():
        parts = (
            {f"{name}_{part}": column.values[:, i] for i, part in enumerate(AXES[column.axes][1])}
            if column.axes
            else {name: _words(column)}
        )
        plain |= parts
        if unit := column.attributes.get("units"):
            units |= dict.fromkeys(parts, str(unit))
    index = {row: plain.pop(row)}
    frame = xarray.Dataset({name: (row, values) for name, values in plain.items()}, index).to_dataframe()
    frame.attrs["units"] = units
    return frame


def _words(column: Column) -> NDArray[Any]:
    values: Sequence[int] | None = column.attributes.get("flag_values")
    if values is None:
        return column.values
    words = dict(zip(values, column.attributes["flag_meanings"].split(), strict=True))
    return np.array([words[value] for value in column.values.tolist()], dtype=object)
