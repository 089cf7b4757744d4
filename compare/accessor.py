"""What a dataset of tosses can be asked: `ds.cointoss`, an accessor of xarray."""

from collections.abc import Hashable
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.maps import as_map, field_along, untrusted_in
from cointoss.compare.sweep.words import codes_of, in_words, words_of
from cointoss.models.notebook import Frame
from cointoss.models.reading import parse
from cointoss.models.records import Outcome
from cointoss.models.scenario import Scenario


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
        from cointoss.compare.shares.show import shares_of  # loads scipy

        codes = xr.DataArray(self.codes, dims=self._dataset["outcome"].dims)
        dims = codes.dims
        for dim in along:
            if dim not in dims:
                raise SweepError(f"along: {dim!r}, accepted: {', '.join(map(str, dims))}")
        over = [dim for dim in dims if dim not in along]
        counts = xr.concat([(codes == one).sum(over) for one in Outcome], "outcome").transpose(
            *along, "outcome"
        )
        kept = {
            **{name: one for name, one in self._dataset.coords.items() if set(one.dims) <= set(along)},
            "engine": self._dataset.attrs["engine"],
            "outcome": list(Outcome.by_value().values()),
        }
        return shares_of(counts.values, (*along, "outcome"), kept, self._dataset.attrs)

    @property
    def _is_of_shares(self) -> bool:
        """Whether the dataset is of shares, not of tosses."""
        return "share" in self._dataset

    def table(self) -> pd.DataFrame | str:
        """Return a table of pandas, a row for each toss, in words, with units in `attrs["units"]`.

        Of shares it is a text: a row for each setting, with 99 % intervals, in Markdown.
        """
        if self._is_of_shares:
            from cointoss.compare.shares.show import markdown

            return markdown(self._dataset)
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
        return untrusted_in(self._dataset)

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
        from cointoss.compare.shares.picture import plot_shares  # loads matplotlib
        from cointoss.compare.sweep import show

        if self._is_of_shares:
            return plot_shares(self._dataset, ax)
        dims = self._dataset["outcome"].dims
        along = {dim: field_along(self._dataset, str(dim)) for dim in dims if self._dataset.sizes[dim] > 1}
        fields = {dim: field for dim, field in along.items() if field}
        if len(dims) == len(fields) == 2:
            return show.plot_map(self._dataset, ax, layer, palette, boundaries=boundaries)
        if len(fields) == 1 < len(dims):
            return plot_shares(self.shares(*fields).swap_dims(fields), ax)
        return show.plot_counts(self.counts, ax)

    def page(self) -> Frame:
        """Return what a notebook shows as the page of `cointoss explore --static`: pixels can be clicked.

        MuJoCo tosses a grid of the pixels first, and the analytic engine any pixel in the page; of a large
        map every second, third, ... is shown.

        Returns:
            A frame, whose `page` is the HTML of a page that needs no other file and no network.

        Raises:
            SweepError: for tosses that are not over two fields.
            UnusableEngineError: where the engine for a browser was not built.
        """
        from cointoss.compare.lab.static import explore  # loads the film's

        return explore(as_map(self._dataset))

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
        from cointoss.compare.sweep.reading import save_map  # loads zarr

        save_map(self._dataset, Path(path), overwrite=overwrite)
        return Path(path)

    def __repr__(self) -> str:
        """Return how many tosses there are, and how many of each outcome."""
        if self._is_of_shares:
            return f"<shares of {int(self._dataset['count'].sum()):,d} tosses>"
        told = ", ".join(f"{count:,d} {name}" for name, count in self.counts.items())
        return f"<{self._dataset['outcome'].size:,d} tosses: {told}>"
