"""What a dataset of tosses can be asked: `ds.cointoss`, an accessor of xarray."""

from collections.abc import Hashable, Mapping
from importlib import import_module
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from cointoss.compare.metrics.estimates import wilson
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import numbers_in
from cointoss.models.answers import COLUMNS, NOT_TOSSED
from cointoss.models.reading import parse
from cointoss.models.records import Outcome
from cointoss.models.scenario import Scenario

if TYPE_CHECKING:
    import pandas as pd

    from cointoss.models.notebook import Frame

WORDED = {name: column.words for name, column in COLUMNS.items() if column.words is not None}
"""The variables that are words in memory and codes in files, with what their codes mean."""


def words_of(name: str, codes: NDArray[Any]) -> NDArray[np.str_]:
    """Return the codes of a variable in words, of NumPy's strings, of any shape; words as they are."""
    if codes.dtype.kind in "UTO":
        return codes.astype(str)
    known = WORDED[name]
    first = min(known)
    words = np.array([known.get(code, "") for code in range(first, max(known) + 1)])
    return words[codes.astype(np.intp) - first]


def codes_of(name: str, words: NDArray[Any]) -> NDArray[np.int8]:
    """Return the words of a variable as codes, of any shape; codes as they are."""
    if words.dtype.kind not in "UTO":
        return words.astype(np.int8)
    known = {word: code for code, word in WORDED[name].items()}
    each, inverse = np.unique(words.astype(str), return_inverse=True)
    # What xarray puts where there was nothing, as after `where`, is no toss.
    codes = np.array([known.get(word, NOT_TOSSED) for word in each.tolist()], dtype=np.int8)
    return codes[inverse].reshape(words.shape)


def in_words(dataset: xr.Dataset) -> xr.Dataset:
    """Return a dataset whose codes are words, those of coordinates too."""
    new: dict[Hashable, Any] = {
        name: (dataset[name].dims, words_of(name, dataset[name].values), _named(COLUMNS[name].attributes))
        for name in WORDED
        if name in dataset
    }
    if (certain := dataset.get("outcome_certain")) is not None:
        new["outcome_certain"] = certain.copy(data=certain.values == 1)
    for name, one in dataset.coords.items():
        if "flag_values" in one.attrs and one.dtype.kind in "iuf":
            known = dict(zip(one.attrs["flag_values"], one.attrs["flag_meanings"].split(), strict=True))
            words = np.array([known[int(code)] for code in one.values.ravel()]).reshape(one.shape)
            new[name] = (one.dims, words, _named(one.attrs))
    return dataset.assign(new)


def in_codes(dataset: xr.Dataset) -> xr.Dataset:
    """Return a dataset whose words are codes of int8, which CF's attributes `flag_values` explain."""
    return dataset.assign(
        {
            name: (dataset[name].dims, codes_of(name, dataset[name].values), COLUMNS[name].attributes)
            for name in WORDED
            if name in dataset
        }
    )


def _named(attributes: Mapping[Any, Any]) -> dict[str, Any]:
    """Return the attributes of words, without those that explain the codes."""
    return {"long_name": attributes["long_name"]}


def opened(path: Path) -> xr.Dataset:
    """Return the dataset of a store, which is read as it is asked for; its words are codes."""
    return xr.open_zarr(path, chunks=None)


@xr.register_dataset_accessor("cointoss")
class Tosses:
    """Counts, shares, tables, pictures and pages of a dataset that `cointoss.toss_many` made."""

    def __init__(self, dataset: xr.Dataset) -> None:
        """Keep the dataset."""
        self._dataset = dataset

    @property
    def scenario(self) -> Scenario:
        """The scenario with the values of all fields that do not vary."""
        return parse(self._dataset.attrs["scenario"], "attribute scenario")

    @property
    def codes(self) -> NDArray[np.int8]:
        """The outcomes by the codes of `Outcome`; below 0 where there is none."""
        if "outcome" not in self._dataset:
            raise SweepError("dataset: no outcome, accepted: a dataset of tosses, as of cointoss.toss_many")
        return codes_of("outcome", self._dataset["outcome"].values)

    @property
    def words(self) -> xr.Dataset:
        """The dataset with words in place of codes, as of a store; in memory."""
        return in_words(self._dataset)

    @property
    def counts(self) -> dict[str, int]:
        """How many tosses had each outcome that there was; those not tossed and refused ones, too."""
        if self._is_of_shares:
            count = self._dataset["count"]
            totals = count.sum([dim for dim in count.dims if dim != "outcome"]).values.tolist()
            return {str(one): n for one, n in zip(count["outcome"].values, totals, strict=True) if n}
        codes, numbers = np.unique(self.codes, return_counts=True)
        return dict(zip(words_of("outcome", codes).tolist(), numbers.tolist(), strict=True))

    def shares(self, *along: Hashable) -> xr.Dataset:
        """Return the share of each outcome, with its 99 % interval (Wilson), along some dimensions.

            ds.cointoss.shares("floor.restitution").share.sel(outcome="heads")

        Args:
            along: dimensions that are kept; all tosses along the others are counted together.

        Returns:
            `count`, `share`, `low` and `high` over these dimensions and `outcome`. Tosses that were not made,
            and what is no scenario, are not counted.

        Raises:
            SweepError: for a dimension that there is none of.
        """
        made = self.codes
        dims = self._dataset["outcome"].dims
        for dim in along:
            if dim not in dims:
                raise SweepError(f"along: {dim!r}, accepted: {', '.join(map(str, dims))}")
        codes = xr.DataArray(made, dims=dims)
        over = [dim for dim in dims if dim not in along]
        counts = xr.concat([(codes == one).sum(over) for one in Outcome], "outcome").transpose(
            *along, "outcome"
        )
        kept = {name: one for name, one in self._dataset.coords.items() if set(one.dims) <= set(along)}
        kept |= {"engine": self._dataset.attrs["engine"], "outcome": list(Outcome.by_value().values())}
        return shares_of(counts.values, (*along, "outcome"), kept, self._dataset.attrs)

    @property
    def _is_of_shares(self) -> bool:
        """Whether the dataset is of shares, not of tosses."""
        return "share" in self._dataset

    def table(self) -> "pd.DataFrame | str":
        """Return a table of pandas, a row for each toss, in words, with units in `attrs["units"]`.

        Of shares it is a text: a row for each setting, with 99 % intervals, in Markdown.
        """
        if self._is_of_shares:
            return _front("shares.show").markdown(self._dataset)
        frame = in_words(self._dataset).to_dataframe().reset_index()
        frame.attrs["units"] = {
            str(name): one.attrs["units"]
            for name, one in self._dataset.variables.items()
            if one.attrs.get("units")
        }
        return frame

    @property
    def untrusted(self) -> NDArray[np.bool_] | None:
        """The pixels of a map that the engine's own errors may have decided; None where that is not known.

        The face at touch n + 1 can be trusted where n + 1 impacts can, but no outcome of a toss that ended
        before. A final outcome can be trusted where it is certain.
        """
        from cointoss.compare.sweep.tossed_map import map_of

        return map_of(self._dataset).untrusted

    def plot(
        self,
        ax: Any = None,
        *,
        layer: str = "outcome",
        palette: str = "safe",
        boundaries: bool = False,
    ) -> Any:
        """Draw outcomes over two fields as a map, over one as shares of what else varies, else as bars.

        A map of one row or one column is drawn as shares.

        A map is hatched where the engine's own errors may have decided.

        Args:
            ax: matplotlib's Axes where to draw, by default in a new figure of pyplot.
            layer: of a map, "outcome" or "margin".
            palette: of a map, "safe" for gold and blue, "paper" for black and white.
            boundaries: whether the pixels of a map at a boundary are coloured as such.

        Returns:
            The axes.

        Raises:
            SweepError: for a map that is not finished, and for a layer that it has not.
        """
        from cointoss.compare.sweep import show
        from cointoss.compare.sweep.tossed_map import field_along, map_of

        if self._is_of_shares:
            return _front("shares.picture").plot_shares(self._dataset, ax)
        dims = self._dataset["outcome"].dims
        along = {dim: field_along(self._dataset, str(dim)) for dim in dims if self._dataset.sizes[dim] > 1}
        fields = {dim: field for dim, field in along.items() if field}
        if len(dims) == len(fields) == 2:
            return show.plot_map(map_of(self._dataset), ax, layer, palette, boundaries=boundaries)
        if len(fields) == 1 < len(dims):
            return _front("shares.picture").plot_shares(self.shares(*fields).swap_dims(fields), ax)
        return show.plot_counts(self.counts, ax)

    def page(self) -> "Frame":
        """Return what a notebook shows as the page of `cointoss explore --static`: pixels can be clicked.

        Both engines toss a grid of the pixels first. The analytic engine tosses any other pixel in the
        page, where the package carries it for a browser; of a large map every second, third, ... is shown.

        Returns:
            A frame, whose `page` is the HTML of a page that needs no other file and no network.

        Raises:
            SweepError: for tosses that are not over two fields.
        """
        from cointoss.compare.sweep.tossed_map import map_of

        return _front("explorer.static").explore(map_of(self._dataset))

    def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> Path:
        """Write a map as `cointoss basin` does: `read_map`, `cointoss explore` and `--resume` take it.

        Args:
            path: of its folder, a new name that ends in .zarr.
            overwrite: whether a map that is there is replaced.

        Returns:
            The path.

        Raises:
            OSError: naming the path and why.
            SweepError: for a map of which only every n-th pixel was read, and for what is no map.
        """
        from cointoss.compare.sweep import store
        from cointoss.compare.sweep.layout import layout_of_map
        from cointoss.compare.sweep.tossed_map import map_of

        made, folder = map_of(self._dataset), Path(path)
        if made.stride > 1:
            raise SweepError(f"{made.name}: one pixel of every {made.stride} is here; accepted: a whole map")
        store.require_place(folder, resume=False, overwrite=overwrite)
        layout = layout_of_map(made.sweep, made.sweep.scenario.to_toml())
        with store.opened(folder, layout, overwrite=overwrite) as kept:
            for tile in kept.tiles:
                numbers = numbers_in(tile, made.sweep.shape).ravel()
                kept.write(numbers, {name: array[tile].ravel() for name, array in made.layers.items()})
        return folder

    def __repr__(self) -> str:
        """Return how many tosses there are, and how many of each outcome."""
        if self._is_of_shares:
            return f"<shares of {int(self._dataset['count'].sum()):,d} tosses>"
        told = ", ".join(f"{count:,d} {name}" for name, count in self.counts.items())
        return f"<{self._dataset['outcome'].size:,d} tosses: {told}>"


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


def _front(name: str) -> Any:
    """Return a module of what stands above the maps and shows their datasets."""
    return import_module(f"cointoss.compare.{name}")
