"""Records of columns, checked, and labelled for xarray and pandas; both are imported where asked for."""

from collections.abc import Mapping
from dataclasses import field, fields
from typing import TYPE_CHECKING, Any, cast

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
"""The name of the dimension of a vector's components, and the name of each component."""


class EqualByValue:
    """A record that equals another of its kind whose fields are equal, arrays number by number.

    Fields that are left out by `compare=False` are not asked. NaN equals NaN.
    """

    def __eq__(self, other: object) -> bool:
        """Return whether the other is of this kind, and all fields are equal."""
        names = [item.name for item in fields(cast("Any", self)) if item.compare]
        return type(self) is type(other) and all(
            np.array_equal(one, two, equal_nan=True) if isinstance(one, np.ndarray | float) else one == two
            for one, two in ((getattr(self, name), getattr(other, name)) for name in names)
        )

    def __hash__(self) -> int:
        """Return the hash of what it prints, which equal records share."""
        return hash(repr(self))


class ReadOnlyArrays:
    """A record whose fields that are arrays are read-only."""

    def __post_init__(self) -> None:
        """Make them so."""
        for value in vars(self).values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)


def column(
    axes: str = "",
    unit: str | None = None,
    *,
    kind: type = np.float64,
    long_name: str = "",
    labels: Mapping[int, str] | None = None,
) -> Any:
    """Return a field of a record of columns.

    Args:
        axes: one of `AXES`; empty for a number.
        unit: "" for a pure number, None for what is no quantity.
        kind: of its numbers.
        long_name: by default the field's name.
        labels: what its numbers mean.
    """
    shape = (len(AXES[axes][1]),) if axes else ()
    attributes = {"long_name": long_name} if long_name else {}
    attributes |= {} if unit is None else {"units": unit}
    attributes |= {} if labels is None else meanings_of(labels)
    metadata = {"shape": shape, "kind": kind, "axes": axes, "attributes": attributes}
    return field(metadata=metadata)


def freeze(record: Any) -> None:
    """Check that the columns of a record have one length and their shapes, and make them read-only.

    Raises:
        ValueError: naming the record, the column, its shape and what is expected.
    """
    n = len(getattr(record, fields(record)[0].name))
    for item in fields(record):
        array, expected = getattr(record, item.name), (n, *item.metadata["shape"])
        if array.shape != expected:
            raise ValueError(f"{type(record).__name__}.{item.name}: shape {array.shape}, expected {expected}")
        array.setflags(write=False)


def meanings_of(labels: Mapping[int, str]) -> dict[str, Any]:
    """Return the attributes in which the CF conventions keep what the values of a variable mean."""
    return {"flag_values": list(labels), "flag_meanings": " ".join(labels.values())}


def dataset(record: Any, row: str, *, first: int | None = None) -> "xr.Dataset":
    """Return a record of columns as a dataset of xarray.

    Args:
        record: a dataclass whose fields are of `column`.
        row: the name of the dimension of the rows; a column of this name is its coordinate.
        first: from which the rows are counted along that dimension, where no column has its name.
    """
    import xarray

    variables: dict[str, Any] = {}
    coordinates: dict[str, Any] = {}
    if first is not None:
        coordinates[row] = (row, first + np.arange(len(record)), {"long_name": row})
    for item in fields(record):
        name, dimensions = item.name, [row]
        if item.metadata["axes"]:
            dimension, components = AXES[item.metadata["axes"]]
            dimensions.append(dimension)
            coordinates[dimension] = list(components)
        attributes = {"long_name": name.replace("_", " "), **item.metadata["attributes"]}
        (coordinates if name == row else variables)[name] = (dimensions, getattr(record, name), attributes)
    return xarray.Dataset(variables, coordinates)


def table(record: Any, row: str, *, first: int | None = None) -> "pd.DataFrame":
    """Return a record as a table of pandas: a column for each component, words for values that mean one.

    Its `attrs["units"]` has the unit of each column that has one. The arguments are those of `dataset`.
    """
    import pandas

    arrays = dataset(record, row, first=first)
    columns = {row: arrays[row]}
    for name, each in arrays.data_vars.items():
        if each.ndim > 1:
            columns |= {
                f"{name}_{part.item()}": each.sel({each.dims[1]: part}) for part in each[each.dims[1]]
            }
        else:
            columns[str(name)] = each
    frame = pandas.DataFrame({name: _words(one) for name, one in columns.items()}).set_index(row)
    frame.attrs["units"] = {
        name: one.attrs["units"] for name, one in columns.items() if one.attrs.get("units")
    }
    return frame


def _words(array: "xr.DataArray") -> NDArray[Any]:
    if "flag_values" not in array.attrs:
        return array.values
    words = dict(zip(array.attrs["flag_values"], array.attrs["flag_meanings"].split(), strict=True))
    return np.array([words[value] for value in array.values.tolist()], dtype=object)
