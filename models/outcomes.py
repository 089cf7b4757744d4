"""How many tosses ended."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cointoss.models import notebook
from cointoss.models.drawing import plots
from cointoss.models.labelled import column, dataset, freeze, table
from cointoss.models.records import Array, Ending, Face, Outcome

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def tally(outcomes: NDArray[np.integer]) -> NDArray[np.int64]:
    """Return how many of some outcomes there are of each, by the code of `Outcome`, (6,)."""
    return np.bincount(outcomes.ravel(), minlength=len(Outcome))


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcomes:
    """How many tosses of one coin ended, one row each; arrays are read-only."""

    outcome: NDArray[np.int8] = column(kind=np.int8, labels=Outcome.by_value())
    """`Outcome`, (n,)."""
    ending: NDArray[np.int8] = column(kind=np.int8, labels=Ending.by_value())
    """`Ending`, (n,)."""
    impacts: NDArray[np.int32] = column(kind=np.int32)
    """Number of impacts, (n,)."""
    last_face: NDArray[np.int8] = column(kind=np.int8, labels={0: "none", **Face.by_value()})
    """The `Face` up at the last touch, (n,); 0 where there was none."""
    end_time: Array = column(unit="s")
    """When the toss stopped, (n,) [s]."""
    trusted_impacts: NDArray[np.int32] | None = column(kind=np.int32, optional=True)
    """How many of the leading impacts can be trusted, (n,); None where that was not asked for."""
    outcome_certain: NDArray[np.bool_] | None = column(kind=np.bool_, optional=True)
    """Whether the engine's own errors can't change the outcome, (n,); None where that was not asked for."""

    def __post_init__(self) -> None:
        """Check the shapes and make the arrays read-only."""
        freeze(self)

    def __len__(self) -> int:
        """Return the number of tosses."""
        return len(self.outcome)

    @property
    def is_done(self) -> NDArray[np.bool_]:
        """Which tosses were made, (n,): all, unless they were interrupted."""
        return self.ending != Ending.NONE

    def after(self, impacts: int) -> NDArray[np.int8]:
        """Return the face at the touch after so many impacts, the outcome where the toss ended before, (n,).

        Args:
            impacts: 0 for the first touch. The tosses must have been made with one more as `max_impacts`,
                so that none goes on after that touch.

        Raises:
            ValueError: if a toss went on.
        """
        most = int(self.impacts.max(initial=0))
        if most > impacts + 1:
            raise ValueError(
                f"impacts: {impacts}, but a toss has {most}; accepted: tosses of at most {impacts + 1}, "
                f"so set ending.max_impacts = {impacts + 1}"
            )
        return np.where(self.impacts == impacts + 1, self.last_face, self.outcome)

    @property
    def counts(self) -> dict[str, int]:
        """How many tosses had each outcome that there was."""
        numbers = tally(self.outcome).tolist()
        return {str(outcome): numbers[outcome] for outcome in Outcome if numbers[outcome]}

    def __repr__(self) -> str:
        """Return how many tosses there are, and how many of each outcome."""
        told = ", ".join(f"{count} {name}" for name, count in self.counts.items())
        return f"<Outcomes of {len(self)} tosses{': ' if told else ''}{told}>"

    def _repr_html_(self) -> str:
        """Return what `repr` says, with a picture."""
        shares = {name: count / len(self) for name, count in self.counts.items()}
        facts = {name: f"{count} ({shares[name]:.2%})" for name, count in self.counts.items()}
        return notebook.block(f"{len(self)} tosses", notebook.shares_picture(shares), facts)

    def to_xarray(self) -> "xr.Dataset":
        """Return the outcomes as a dataset of xarray over `toss`, which counts from 0 as the releases do."""
        return dataset(self, "toss", first=0)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return the outcomes as a table of pandas, a row each, in words."""
        return table(self, "toss", first=0)

    def plot(self, ax: Any = None) -> Any:
        """Plot how many tosses had each outcome.

        Args:
            ax: matplotlib's Axes where to draw, by default in a new figure of pyplot.

        Returns:
            The axes.
        """
        return plots().plot_outcomes(self, ax)
