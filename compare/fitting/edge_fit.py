"""The value of a field that explains how often coins end on their edge, or that none does."""

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import nan
from typing import Any

import numpy as np
from scipy.stats import chi2

from cointoss.compare.fitting.edges import Edges
from cointoss.compare.fitting.errors import ObservationError
from cointoss.compare.fitting.people import interval_of, log_binomial
from cointoss.compare.fitting.search import LEVEL
from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.shares.plan import FIELDS
from cointoss.compare.shares.shares import shares
from cointoss.compare.sweep.axes import HAND, Span, spans_of
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.devices import Device
from cointoss.models.errors import ScenarioError
from cointoss.models.hand import Hand
from cointoss.models.records import Array, Outcome
from cointoss.models.scenario import Scenario
from cointoss.models.stages import counted
from cointoss.models.unlikely import UnitWarning, unlikely_units

VALUES = 9
"""Number of values of the field at which coins are tossed; between them the share is interpolated."""
TRIED = 401
"""Number of values of the field at which the likelihood is evaluated."""
_FIELDS = {name: unit for name, unit in FIELDS.items() if name not in (*HAND, "coin.thickness")}
_LYING = (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE)
_EXAMPLE = '{"floor.restitution": (0.1, 0.6)}'


@dataclass(frozen=True, kw_only=True, eq=False)
class EdgeFit:
    """The value of a field that explains best how often coins ended on their edge."""

    edges: Edges
    span: Span
    value: Estimate
    """The value of the field [SI]; the ends are NaN where the model cannot do what was counted."""
    shares: Array
    """Simulated shares of the edge at this value, (n,)."""
    chi_square: float
    """Sum of the squares of the residuals, in standard deviations of counts and simulation."""
    left_out: float
    """Share of the simulated tosses that end neither on a face nor on the edge; they count nowhere."""
    scenario: Scenario
    """The scenario with this value."""

    @property
    def at_end(self) -> bool:
        """Whether the value is at an end of its span, where the true one may be outside."""
        return self.span.ends_at(self.value.value)

    @property
    def is_cut(self) -> bool:
        """Whether the interval ends where its span does, and may go on outside."""
        return any(map(self.span.ends_at, self.value.ends[1:]))

    @property
    def degrees(self) -> int:
        """Thicknesses less the one value."""
        return len(self.shares) - 1

    @property
    def p_value(self) -> float:
        """How likely chance makes the right model miss by as much; NaN where nothing is left to test it."""
        return float(chi2.sf(self.chi_square, self.degrees)) if self.degrees else float("nan")

    @property
    def is_possible(self) -> bool:
        """Whether the model can have made these counts."""
        return not self.p_value < 1 - LEVEL

    @property
    def verdict(self) -> str:
        """Whether the model can do what was counted, in words."""
        if not self.degrees:
            return "nothing is left to test the model: one value is fitted to one thickness"
        can = "can" if self.is_possible else "cannot"
        found = f"chi-square {self.chi_square:.4g} for {self.degrees}, p = {self.p_value:.2g}"
        return f"this model {can} do what was counted: {found}"

    def as_dict(self) -> dict[str, Any]:
        """Return it in the form of `cointoss fit --json`, which has null for what is NaN."""
        value, low, high = self.value.ends
        return {
            "values": {
                self.span.field: {
                    "value": value,
                    "interval": [low, high],
                    "unit": self.span.unit,
                    "at_end": self.at_end,
                    "cut": self.is_cut,
                }
            },
            "thickness": self.edges.thickness.tolist(),
            "edge": self.edges.edge.tolist(),
            "tosses_seen": self.edges.tosses.tolist(),
            "share": self.shares.tolist(),
            "left_out": self.left_out,
            "chi_square": self.chi_square,
            "degrees": self.degrees,
            "p_value": self.p_value,
            "possible": self.is_possible,
            "verdict": self.verdict,
            "scenario": self.scenario.as_tables(),
        }


def fit_edges(
    edges: Edges,
    scenario: Scenario,
    vary: Mapping[str, Any],
    *,
    hand: Hand | None,
    tosses: int,
    seed: int,
    device: Device | str,
) -> EdgeFit:
    """Return the value of a field that explains edges best, by simulated likelihood: see `fit`."""
    span, *others = spans_of(vary, scenario, _FIELDS, _EXAMPLE)
    if others:
        raise SweepError(f"vary: {1 + len(others)} fields; accepted: one, of counts of edges")
    tossed = np.linspace(min(span.start, span.stop), max(span.start, span.stop), VALUES)
    usual = Hand.people(up="either") if hand is None else hand
    thickest = float(edges.thickness.max())
    doubted = unlikely_units(
        scenario.gravity, scenario.coin, scenario.release, scenario.ending, {"coin.thickness": thickest}
    )
    if "coin.thickness" in doubted:
        is_it = f'thickness = {thickest:g} m: is it mm? name the column "thickness (mm)"'
        warnings.warn(is_it, UnitWarning, stacklevel=2)
    met, made, left = np.empty((3, len(edges.thickness), VALUES))
    thicknesses = counted("fitting the edges", "thicknesses", edges.thickness.tolist())
    for n, thickness in enumerate(thicknesses):
        try:
            coin = scenario.replace("coin.thickness", thickness)
        except ScenarioError:
            accepted = 'a coin that this scenario can release; in mm, name the column "thickness (mm)"'
            raise ObservationError(f"thickness = {thickness:g} m: accepted: {accepted}") from None
        ranges = {span.field: (tossed[0], tossed[-1], VALUES)}
        shown = shares(coin, ranges, hand=usual, tosses=tosses, seed=seed + n, device=device)
        if not shown.attrs["complete"]:
            raise KeyboardInterrupt
        met[n] = shown["count"].sel(outcome=str(Outcome.EDGE))
        made[n] = shown["count"].sel(outcome=[str(one) for one in _LYING]).sum("outcome")
        left[n] = shown["count"].sum("outcome") - made[n]
    if not made.all():
        accepted = "values and thicknesses of which some do"
        raise SweepError(
            f"{span.field}: of one value no toss ends on a face or the edge; accepted: {accepted}"
        )
    each = (met + 1 / 2) / (made + 1)

    def likelihood(values: Array) -> Array:
        p = np.array([np.interp(values, tossed, row) for row in each])
        return log_binomial(edges.edge[:, None], edges.tosses[:, None], p, float(made.min())).sum(axis=0)

    value, low, high = interval_of(likelihood, np.linspace(tossed[0], tossed[-1], TRIED))
    share = np.array([np.interp(value, tossed, row) for row in each])
    variance = edges.tosses * share * (1 - share) * (1 + edges.tosses / made.min())
    chi_square = float(np.sum((edges.edge - edges.tosses * share) ** 2 / variance))
    found = EdgeFit(
        edges=edges,
        span=span,
        value=Estimate(value, low, high, int(edges.tosses.sum())),
        shares=share,
        left_out=float(left.sum() / (made + left).sum()),
        chi_square=chi_square,
        scenario=scenario.replace(span.field, value),
    )
    return found if found.is_possible else replace(found, value=replace(found.value, low=nan, high=nan))
