"""The outcomes of tosses over two fields of a scenario, as one record."""

from base64 import b64encode
from dataclasses import dataclass
from functools import cached_property
from html import escape
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.basins.maps import outcome_codes
from cointoss.compare.basins.picture_style import Palette, PictureStyle
from cointoss.compare.output.plots import axes_or_new
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import Sweep
from cointoss.compare.sweep.layers import NOT_TOSSED, axis_attributes, layers_of, trust_layer
from cointoss.compare.sweep.pixels import Pixels
from cointoss.compare.sweep.untrusted import untrusted_pixels
from cointoss.models import notebook
from cointoss.models.drawing import explorer
from cointoss.models.records import Array, Outcome

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes

_HTML_DPI = 80


@dataclass(frozen=True, kw_only=True, eq=False)
class OutcomeMap:
    """The outcomes of tosses over two fields of a scenario; arrays are read-only.

    `basin` makes one, `read_map` reads one that `cointoss basin` made.
    """

    name: str
    sweep: Sweep
    """The scenario, the axes, the engine with its settings, and which face or outcome is shown."""
    outcome: NDArray[np.int8]
    """`Outcome`, or -1 where no toss was made yet, (ny, nx)."""
    impacts: NDArray[np.int32]
    """Number of impacts, or -1, (ny, nx)."""
    margin: Array | None = None
    """The smallest change of `sweep.margin` that was found to change the outcome, (ny, nx)."""
    trusted_impacts: NDArray[np.int32] | None = None
    """Number of leading impacts, up to the touch that is shown, that the engine's own errors cannot have
    changed, or -1, (ny, nx)."""
    outcome_certain: NDArray[np.int8] | None = None
    """Of final outcomes: 1 where the engine's own errors cannot change it, else 0, or -1, (ny, nx)."""
    stride: int = 1
    """Every so many-th pixel of the sweep is here, along both axes."""

    def __post_init__(self) -> None:
        """Check the shapes and make the arrays read-only."""
        if self.stride < 1:
            raise ValueError(f"OutcomeMap.stride: {self.stride}, accepted: a whole number from 1")
        expected = len(self.y), len(self.x)
        for name, array in self.layers.items():
            if array.shape != expected:
                raise ValueError(f"OutcomeMap.{name}: shape {array.shape}, expected {expected}")
            own = array.view()
            own.setflags(write=False)
            object.__setattr__(self, name, own)
        tossed = self.outcome[self.outcome != NOT_TOSSED]
        if tossed.size:
            outcome_codes(tossed)

    @property
    def layers(self) -> dict[str, NDArray[Any]]:
        """The arrays there are, by name."""
        return {name: getattr(self, name) for name in layers_of(self.sweep)}

    @property
    def x(self) -> Array:
        """The values of the field of the columns, `sweep.x.field`, (nx,) [sweep.x.unit]."""
        return self.sweep.x.values[:: self.stride]

    @property
    def y(self) -> Array:
        """The values of the field of the rows, `sweep.y.field`, (ny,) [sweep.y.unit]."""
        return self.sweep.y.values[:: self.stride]

    @cached_property
    def untrusted(self) -> NDArray[np.bool_] | None:
        """The pixels that the engine's own errors may have decided, (ny, nx), where that is known.

        The face at touch n + 1 can be trusted where n + 1 impacts can, but no outcome of a toss that ended
        before. A final outcome can be trusted where it is certain.
        """
        if not self.sweep.trust:
            return None
        after = self.sweep.after
        return untrusted_pixels(after, self.layers[trust_layer(after)])

    @cached_property
    def shares(self) -> dict[str, float]:
        """The share of the pixels that each outcome has, and those not tossed yet, of what there is."""
        codes, counts = np.unique(self.outcome, return_counts=True)
        labels = {NOT_TOSSED: "not tossed", **Outcome.by_value()}
        return {
            labels[code]: count / self.outcome.size
            for code, count in zip(codes.tolist(), counts.tolist(), strict=True)
        }

    def __repr__(self) -> str:
        """Return what the map is of, and the shares of its outcomes."""
        told = ", ".join(f"{share:.1%} {name}" for name, share in self.shares.items())
        x, y = self.sweep.x, self.sweep.y
        size = f"{len(self.x)} x {len(self.y)} over {x.field} and {y.field}"
        return f"<OutcomeMap {self.name} by {self.sweep.engine}: {size}: {told}>"

    def _repr_html_(self) -> str:
        """Return what `repr` says, with a picture."""
        facts = {name: f"{share:.2%}" for name, share in self.shares.items()}
        facts["engine"] = self.sweep.engine.value
        return notebook.block(self.name, self._picture(), {"tosses": self._size, **facts})

    @property
    def _size(self) -> str:
        return f"{len(self.x)} x {len(self.y)} over {self.sweep.x.word} and {self.sweep.y.word}"

    def _picture(self) -> str:
        if NOT_TOSSED in self.outcome:
            return notebook.shares_picture(self.shares)
        from cointoss.compare.sweep.show import png_of

        style = PictureStyle(dpi=_HTML_DPI)
        drawn = png_of([self.outcome], self.sweep, style, margins=self.margin, untrusted=self.untrusted)
        about = escape(f"map of the outcome: {self._size}")
        return f'<img alt="{about}" src="data:image/png;base64,{b64encode(drawn).decode()}">'

    def to_xarray(self) -> "xr.Dataset":
        """Return the map as a dataset of xarray, as it is on disk: coordinates are named by their fields."""
        import xarray

        sweep = self.sweep
        coordinates = {
            axis.field: (dimension, values, axis_attributes(axis))
            for dimension, axis, values in (("y", sweep.y, self.y), ("x", sweep.x, self.x))
        }
        layers = layers_of(sweep)
        arrays = {name: (("y", "x"), array, layers[name].attributes) for name, array in self.layers.items()}
        about = {
            "scenario": sweep.scenario.to_toml(),
            "engine": sweep.engine.value,
            "after": "" if sweep.after is None else sweep.after,
        }
        return xarray.Dataset(arrays, coordinates, about)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return the map as a table of pandas, a row a pixel, in words, with units in `attrs["units"]`."""
        labels = {NOT_TOSSED: "not_tossed", **Outcome.by_value()}
        arrays = self.to_xarray()
        words = [labels[code] for code in self.outcome.ravel().tolist()]
        columns = [self.sweep.y.field, self.sweep.x.field, *self.layers]
        frame = arrays.to_dataframe().reset_index(drop=True)[columns].assign(outcome=words)
        units = {name: arrays[name].attrs.get("units", "") for name in columns}
        frame.attrs["units"] = {name: unit for name, unit in units.items() if unit}
        return frame

    def plot(
        self,
        ax: "Axes | None" = None,
        *,
        layer: str = "outcome",
        palette: str = "safe",
        boundaries: bool = False,
    ) -> "Axes":
        """Draw the outcomes, hatched where the engine's own errors may have decided, or the margins.

        Args:
            ax: where to draw, by default in a new figure of pyplot.
            layer: "outcome" or "margin".
            palette: "safe" for gold and blue, "paper" for black and white.
            boundaries: whether pixels at a boundary are coloured as such.

        Returns:
            The axes.

        Raises:
            SweepError: for a map that is not finished, and for a layer that it has not.
        """
        missing = np.count_nonzero(self.outcome == NOT_TOSSED)
        if missing:
            raise SweepError(
                f"{self.name}: {missing} of {self.outcome.size} pixels are not tossed; "
                "accepted: a whole map (cointoss basin --resume continues one)"
            )
        drawn = {"outcome": self.outcome} | ({} if self.margin is None else {"margin": self.margin})
        for name, value, accepted in (("layer", layer, drawn), ("palette", palette, list(Palette))):
            if value not in accepted:
                raise SweepError(f"{name}: {value!r}, accepted: {', '.join(accepted)}")
        from cointoss.compare.sweep.show import draw_layer

        axes = axes_or_new(ax)
        style = PictureStyle(palette=Palette(palette), boundaries=boundaries)
        draw_layer(axes, drawn[layer], self.sweep, style, untrusted=self.untrusted)
        return axes

    def explore(self) -> notebook.Frame:
        """Return what a notebook shows as the page of `cointoss explore --static`: pixels can be clicked.

        Both engines toss a grid of the pixels first. The analytic engine tosses any other pixel in the
        page, where the package carries it for a browser; of a large map every second, third, ... is shown.

        Returns:
            A frame, whose `page` is the HTML of a page that needs no other file and no network.
        """
        return explorer().explore(self)

    def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> Path:
        """Write the map as `cointoss basin` does: `read_map`, `cointoss explore` and `--resume` take it.

        Args:
            path: of its folder, a new name that ends in .zarr.
            overwrite: whether a map that is there is replaced.

        Returns:
            The path.

        Raises:
            OSError: naming the path and why.
            SweepError: for a map of which only every so many-th pixel was read.
        """
        if self.stride > 1:
            raise SweepError(f"{self.name}: one pixel of every {self.stride} is here; accepted: a whole map")
        from cointoss.compare.sweep import store

        folder = Path(path)
        store.require_place(folder, resume=False, overwrite=overwrite)
        with store.opened(folder, self.sweep, self.sweep.scenario.to_toml(), overwrite=overwrite) as map_:
            for tile in map_.tiles:
                parts = {name: array[tile.rows, tile.columns] for name, array in self.layers.items()}
                map_.write(tile, Pixels(**parts))
        return folder
