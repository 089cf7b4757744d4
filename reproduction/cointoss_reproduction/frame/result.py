"""A figure, claim or study that can be reproduced, and the result of its run."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cointoss_reproduction.frame.claim import Claim
from cointoss_reproduction.frame.files import CLAIMS, PAGE, PROVENANCE, SHEETS, TABLE

if TYPE_CHECKING:  # names are listed without it
    from matplotlib.figure import Figure


@dataclass(frozen=True, kw_only=True)
class Result:
    """The result of a run."""

    claims: Sequence[Claim]
    data: Any
    """What its pictures show: a table, or arrays by name."""
    tables: str = ""
    """More of what it found, in Markdown, to be printed before the claims."""


@dataclass(frozen=True, kw_only=True)
class Reproduction:
    """A figure, a claim or a study that can be reproduced."""

    title: str
    """The subject, in a few words."""
    seconds: float
    """Roughly how long it takes on two cores [s]."""
    make: Callable[..., Result]
    """Computes the result, from a `Progress`; if it `resumes`, also from a folder `kept` with the work done
    before."""
    read: Callable[[Path], Result] | None = None
    """Reads what a run of it left in its folder, where that is more than claims."""
    draw: "Mapping[str, Callable[[Any], Figure]]"
    """Its pictures, by name, each drawn from the data."""
    quick: Callable[..., Result] | None = None
    """Computes a smaller size, where there is one."""
    quick_seconds: float | None = None
    """Roughly how long that takes on two cores [s]."""
    paper: str = ""
    """Its place in the paper, as in "Fig. 3"; empty for a study of this project."""
    resumes: bool = False
    """Whether it keeps what it has done in its folder, so that an interrupted run goes on."""
    timed: bool = False
    """Whether its numbers are times, which no two runs share."""
    usual: Mapping[str, Any] = field(default_factory=dict)
    """The default sizes of a run, by name."""
    assumed: str = ""
    """The assumptions where the paper says nothing."""

    @property
    def files(self) -> tuple[str, ...]:
        """Names of all files that it may write."""
        pictures = (f"{name}.png" for name in self.draw)
        return (CLAIMS, "data.npz", TABLE, PROVENANCE, PAGE, *SHEETS, *pictures)
