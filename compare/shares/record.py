"""The shares of outcomes along fields of a scenario, with their intervals, as one record."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import chance_alike, percent, share_of
from cointoss.compare.output.tables import sheet, table
from cointoss.compare.shares.counting import Counts
from cointoss.compare.shares.plan import Plan
from cointoss.compare.sweep.layers import axis_attributes
from cointoss.models.records import Outcome
from cointoss.models.units import printed_unit

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


class Row(NamedTuple):
    """A setting, by one engine."""

    values: tuple[float, ...]
    """Of the fields that vary, in SI."""
    engine: Engine
    counts: Counts
    """By code of `Outcome`, (6,); none of a coin that was not caught where a hand catches it."""
    made: int
    """How many tosses were made."""

    @property
    def tosses(self) -> int:
        """How many were counted."""
        return int(self.counts.sum())

    @property
    def shares(self) -> dict[Outcome, Estimate]:
        """The share of every outcome, with its 99 % interval; NaN, from 0 to 1, without tosses."""
        return {one: share_of(int(self.counts[one]), self.tosses) for one in Outcome}


@dataclass(frozen=True, kw_only=True, eq=False)
class Shares:
    """How many tosses of a hand ended how, along fields of a scenario; `shares` makes it."""

    plan: Plan
    """The scenario, the hand, the fields that vary, the engines and the seed."""
    counts: Counts
    """Numbers of tosses, (engines, values of each field that varies, 6), the last by code of `Outcome`; those
    that a hand was to catch and did not are undecided, and no share is of them."""

    def __post_init__(self) -> None:
        """Check the shape and make the array read-only.

        Raises:
            ValueError: for another shape.
        """
        expected = (len(self.plan.engines), *self.plan.shape, len(Outcome))
        if self.counts.shape != expected:
            raise ValueError(f"Shares.counts: shape {self.counts.shape}, expected {expected}")
        own = self.counts.copy()
        own.setflags(write=False)
        object.__setattr__(self, "counts", own)

    @property
    def is_complete(self) -> bool:
        """Whether every setting was tossed; counting may have been interrupted before."""
        return bool(self.counts.any(axis=-1).all())

    @property
    def not_caught(self) -> int:
        """How many tosses were left out, because the hand did not catch the coin."""
        return int(self.counts.sum() - self.plan.counted(self.counts).sum())

    @property
    def outcomes(self) -> tuple[Outcome, ...]:
        """Heads, tails, and the other outcomes that there were."""
        counts = self.plan.counted(self.counts)
        faces = (Outcome.HEADS, Outcome.TAILS)
        others = [one for one in Outcome if one not in faces and counts[..., one].any()]
        return (*faces, *sorted(others, key=lambda one: (one == Outcome.UNDECIDED, one)))

    @property
    def rows(self) -> list[Row]:
        """Each setting by each engine, the engine varying fastest."""
        return [
            Row(values, engine, self.plan.counted(counts), int(counts.sum()))
            for values, both in self._settings()
            for engine, counts in zip(self.plan.engines, both, strict=True)
        ]

    @property
    def alike(self) -> list[float]:
        """The probability by chance of counts that differ so much between both engines, for each setting.

        It is that of a χ² test; NaN where an engine tossed nothing, none with one engine.
        """
        if len(self.plan.engines) < 2:
            return []
        return [chance_alike(both) if both.any(axis=1).all() else np.nan for _, both in self._settings()]

    @property
    def least_alike(self) -> float:
        """The probability that the smallest of the settings' probabilities is by chance as small as it is."""
        known = [one for one in self.alike if not np.isnan(one)]
        return 1 - (1 - min(known)) ** len(known) if known else np.nan

    def _settings(self) -> Iterator[tuple[tuple[float, ...], Counts]]:
        """Yield the values of the fields, and the counts of each engine, (engines, 6)."""
        shape = self.plan.shape
        for at in np.ndindex(shape):
            values = tuple(float(axis.values[i]) for axis, i in zip(self.plan.along, at, strict=True))
            yield values, self.counts[(slice(None), *at)]

    def table(self) -> str:
        """Return the shares with their 99 % intervals, as a table in Markdown."""
        engines, chances = self.plan.engines, self.alike
        both = len(engines) > 1
        head = [*self._heads(), *["engine"] * both, "tosses", *map(str, self.outcomes), *["by chance"] * both]
        settings = list(product(*(axis.texts for axis in self.plan.along)))
        rows = []
        for i, row in enumerate(self.rows):
            setting, engine = divmod(i, len(engines))
            values = ["" if engine else text for text in settings[setting]]
            shares = row.shares
            cells = [percent(shares[one]) if row.tosses else "-" for one in self.outcomes]
            of_engine = [row.engine.value] if both else []
            chance = [f"{chances[setting]:.2g}" if engine else ""] if both else []
            rows.append([*values, *of_engine, f"{row.tosses:,d}", *cells, *chance])
        return table(head, rows)

    def _heads(self) -> list[str]:
        return [f"{axis.word} [{axis.printed_unit}]" if axis.unit else axis.word for axis in self.plan.along]

    def to_csv(self) -> str:
        """Return a row for each setting and engine as comma-separated values, in SI and full precision."""
        fields = [f"{axis.field} [{printed_unit(axis.unit)}]".removesuffix(" []") for axis in self.plan.along]
        names = [f"{one}{part}" for one in self.outcomes for part in ("", " low", " high", " count")]
        rows = []
        for row in self.rows:
            shares = row.shares
            cells = [[*map(repr, shares[one].ends), str(row.counts[one])] for one in self.outcomes]
            values = [repr(value) for value in row.values]
            rows.append(
                [*values, row.engine.value, str(row.tosses), *(cell for each in cells for cell in each)]
            )
        return sheet([*fields, "engine", "tosses", *names], rows)

    def as_json(self) -> dict[str, Any]:
        """Return what `cointoss shares --json` prints, but for the scenario's name."""
        plan = self.plan
        along = [{"field": a.field, "unit": a.unit, "values": a.values.tolist()} for a in plan.along]
        told: dict[str, Any] = {
            "hand": asdict(plan.hand),
            "seed": plan.seed,
            "to": plan.to,
            "along": along,
            "settings": [
                {
                    **{axis.field: value for axis, value in zip(plan.along, row.values, strict=True)},
                    "engine": row.engine.value,
                    "tosses": row.tosses,
                    "not_caught": row.made - row.tosses,
                    "shares": {str(one): _plain(part) for one, part in row.shares.items()},
                }
                for row in self.rows
            ],
        }
        if len(plan.engines) > 1:
            told["by_chance"] = [None if np.isnan(one) else one for one in self.alike]
        return told

    def to_xarray(self) -> "xr.Dataset":
        """Return the shares as a dataset of xarray, over engine, the fields that vary, and outcome.

        Its variables are `count`, and `share` with the ends `low` and `high` of its 99 % interval.
        """
        import xarray

        dimensions = ["engine", *(axis.field for axis in self.plan.along), "outcome"]
        counted = self.plan.counted(self.counts)
        flat = [Row((), Engine.ANALYTIC, counts, 0).shares for counts in counted.reshape(-1, len(Outcome))]
        ends = np.array([shares[one].ends for shares in flat for one in Outcome])
        names = {"share": "share of the tosses", "low": "low end of its 99 % interval"}
        names["high"] = "high end of its 99 % interval"
        variables: dict[str, Any] = {"count": (dimensions, self.counts, {"long_name": "number of tosses"})}
        for (name, about), values in zip(names.items(), ends.T, strict=True):
            variables[name] = (dimensions, values.reshape(self.counts.shape), {"long_name": about})
        coordinates: dict[str, Any] = {
            "engine": [engine.value for engine in self.plan.engines],
            "outcome": list(Outcome.by_value().values()),
        }
        for axis in self.plan.along:
            coordinates[axis.field] = (axis.field, axis.values, axis_attributes(axis))
        return xarray.Dataset(
            variables, coordinates, {"scenario": self.plan.scenario.to_toml(), "seed": self.plan.seed}
        )

    def to_dataframe(self) -> "pd.DataFrame":
        """Return a table of pandas, a row for each engine, setting and outcome."""
        return self.to_xarray().to_dataframe().reset_index()

    def plot(self, ax: Any = None) -> Any:
        """Plot the shares with their intervals over the first field, a panel for each value of the second.

        Args:
            ax: matplotlib's Axes where to draw, by default in a new figure of pyplot; with two fields that
                vary there are several.

        Returns:
            The axes, or an array of them.

        Raises:
            ValueError: for one Axes where several are due.
        """
        from cointoss.compare.shares.picture import plot_shares

        found: Any = self  # which the picture's module imports
        return plot_shares(found, ax)

    def __repr__(self) -> str:
        """Return how many tosses of what there are."""
        along = " by ".join(f"{axis.count} values of {axis.field}" for axis in self.plan.along) or "1 setting"
        return f"<Shares {self.plan.name or 'of a scenario'}: {along}, {int(self.counts.sum()):,d} tosses>"


def _plain(part: Estimate) -> dict[str, float] | None:
    return {"value": part.value, "low": part.low, "high": part.high} if part.count else None
