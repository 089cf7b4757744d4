"""A fit as text for a person: the values, the verdict, and each touch."""

import numpy as np

from cointoss.compare.fitting.fit import Fit, Fitted
from cointoss.compare.output.answer import counted
from cointoss.models.records import Face

MOST_OTHERS = 5
"""The most other values that are printed."""
_MEANING = "            (p: how likely errors of what was seen alone make a chi-square this large)"
_BEYOND = "beyond the horizon of trust, so they test nothing"


def as_lines(fit: Fit) -> str:
    """Return a fit as text."""
    untested, others = ", ".join(map(str, fit.untested_touches)), len(fit.others)
    return "\n".join(
        [
            *map(_value, fit.values),
            "",
            f"verdict     {fit.verdict}",
            *([_MEANING] if fit.degrees > 0 else []),
            f"seen        {_seen(fit)}",
            *([f"untested    touches {untested}: {_BEYOND}"] if untested else []),
            *(f"correlated  {pair}" for pair in (_correlated(fit) if fit.is_possible else [])),
            *(f"or          {_other(other)}" for other in fit.others[:MOST_OTHERS]),
            *([f"or          {others - MOST_OTHERS} more that explain it"] if others > MOST_OTHERS else []),
            *(_touches(fit) if len(fit.observed.touch_times) else []),
        ]
    )


def _value(each: Fitted) -> str:
    unit = f" [{each.span.printed_unit}]" if each.span.unit else ""
    name = f"{each.span.field}{unit}"
    if not np.isfinite(each.sd):
        return f"{name:34} not determined by what was seen"
    value = f"{name:34} {each.value:.7g}"
    if each.interval is None:
        return value
    low, high = each.interval
    end = "  at the end of its span" if each.at_end else "  cut at the end of its span" if each.is_cut else ""
    return f"{value}  99 % [{low:.7g}, {high:.7g}]{end}"


def _seen(fit: Fit) -> str:
    touches = len(fit.observed.touch_times)
    numbers = {name: int(of.sum()) for name, of in fit.observed.measured.items()}
    parts = [
        *([counted(touches, "touch").replace("touchs", "touches")] if touches else []),
        *(f"{n} {name}" for name, n in numbers.items() if n),
    ]
    return f"{', '.join(parts)}; {counted(len(fit.values), 'value')} fitted"


def _other(other: Fit) -> str:
    values = ", ".join(f"{each.span.field} = {each.value:.6g}" for each in other.values)
    return f"{values}: chi-square {other.chi_square:.4g}"


def _correlated(fit: Fit) -> list[str]:
    """Return the pairs of fields of which the data know a combination far better than either."""
    with np.errstate(invalid="ignore"):
        sd = np.sqrt(np.diag(fit.covariance))
        correlation = fit.covariance / np.outer(sd, sd)
    names = [each.span.field for each in fit.values]
    pairs = [(i, j) for i in range(len(names)) for j in range(i) if abs(correlation[i, j]) > 0.95]
    return [f"{names[j]} and {names[i]}, by {correlation[i, j]:.3f}" for i, j in pairs]


def _touches(fit: Fit) -> list[str]:
    seen, lines = fit.observed, ["", "touch  up  seen [s]   fitted [s]  residual [sd]"]
    for number, time, face, fitted, missed, tested in zip(
        seen.touch_numbers,
        seen.touch_times,
        seen.faces,
        fit.touch_times,
        fit.residuals,
        fit.tested,
        strict=False,
    ):
        shown = f"{fitted:11.6f} {missed:+14.2f}" if np.isfinite(fitted) else f"{'none':>11} {missed:+14.2f}"
        up = Face(face).symbol if face else "-"
        lines.append(f"{number:5d}   {up} {time:9.6f}  {shown}{'' if tested else '  beyond the horizon'}")
    return lines
