"""A toss as an answer: JSON, CSV, and lines to read."""

from dataclasses import asdict, fields
from typing import Any

import numpy as np

from cointoss.compare.output.language import in_options
from cointoss.compare.output.tables import sheet
from cointoss.models import certificate
from cointoss.models.notebook import shortened, with_bar
from cointoss.models.records import (
    Face,
    Impacts,
    OtherOutcome,
    Outcome,
    States,
    Toss,
    UnsupportedError,
)
from cointoss.models.resting_place import SENTENCES, Rest, RestReason
from cointoss.models.scenario import Scenario

_JSON_FIELDS = [item.name for item in fields(Impacts) if item.name not in ("time", "face", "energy_change")]
PATH_COLUMNS = {
    "time": ("t [s]",),
    "position": ("x [m]", "y [m]", "z [m]"),
    "velocity": ("v_x [m/s]", "v_y [m/s]", "v_z [m/s]"),
    "quaternion": ("e0", "e1", "e2", "e3"),
    "angular_velocity": ("w_xi [rad/s]", "w_eta [rad/s]", "w_zeta [rad/s]"),
}
"""Columns of a path's CSV file, by the fields of `States`."""
POINT_COLUMNS = ("A_x [m]", "A_y [m]", "A_z [m]")
"""Columns of the coin's lowest point in a path's CSV file."""
MOST_LINES, FIRST_LINES, LAST_LINES = 20, 8, 2
"""Impacts that are printed for a person who did not ask for all; of more the first and the last ones."""
CERTAIN = "certain: its ending proves it for the exact motion, and rounding errors can't change it"
TRUSTED = "amplified by each impact, can't have changed these"
ROWS_PER_SECOND = 1000
MOST_ROWS = 1_000_000
"""The most rows of a path's CSV file: more would be hundreds of megabytes."""


def as_json(toss: Toss) -> dict[str, Any]:
    """Return a toss in the form of `cointoss toss --json`, but for what made it, in full precision.

    Of an impact `point`, from B, and the angular velocities are in the body frame; all other vectors are in
    the space frame, and `position` is C's.
    """
    return {
        "engine": toss.engine,
        "sequence": toss.sequence,
        "outcome": str(toss.outcome),
        "ending": str(toss.ending),
        "end_time": toss.end_time,
        "outcome_certain": toss.outcome_certain,
        "other_outcome": _other(toss.other_outcome),
        "trusted_impacts": toss.trusted_impacts,
        "trust_end": str(toss.trust_end),
        "trust_reason": toss.trust_reason,
        "impacts": [
            {**_impact(toss.impacts, i), "flags": sorted(flags)} for i, flags in enumerate(toss.flags)
        ],
        "contacts": [{"start": start, "end": end} for start, end in toss.contacts.tolist()],
        **({} if toss.rest_reason is None else rest_as_json(toss)),
        "certificate": [asdict(setting) for setting in toss.certificate],
    }


def rest_as_json(toss: Toss) -> dict[str, Any]:
    """Return where a coin comes to rest, and that it does or why not."""
    return {"rest": toss.rest and asdict(toss.rest), "rest_reason": str(toss.rest_reason)}


def _other(other: OtherOutcome | None) -> dict[str, Any] | None:
    return other and {"outcome": str(other.outcome), "change": other.change, "after_impact": other.impact}


def _impact(impacts: Impacts, i: int) -> dict[str, Any]:
    fields = {name: getattr(impacts, name)[i].tolist() for name in _JSON_FIELDS}
    return {"time": float(impacts.time[i]), "face": Face(impacts.face[i]).symbol, **fields}


def path_times(toss: Toss) -> np.ndarray:
    """Return times evenly spread over a path, and those of its impacts, of the toss's end and its own [s].

    Raises:
        UnsupportedError: if they are more than `MOST_ROWS`.
    """
    if toss.path_end * ROWS_PER_SECOND > MOST_ROWS:
        raise UnsupportedError(
            f"ending.max_time = {toss.scenario.ending.max_time:g}: accepted where the path is written: "
            f"at most {MOST_ROWS / ROWS_PER_SECOND:g} s (this toss lasts {toss.path_end:g} s)"
        )
    even, ends = np.arange(0.0, toss.path_end, 1 / ROWS_PER_SECOND), [toss.end_time, toss.path_end]
    return np.unique(np.concatenate([even, toss.impacts.time, toss.later_times, ends]))


def path_csv(states: States, scenario: Scenario) -> str:
    """Return a path as CSV, one row for each time, columns named with their units.

    The last three columns are the coin's lowest point A in space: the point of contact where it touches.
    """
    rows = np.column_stack(
        [*(getattr(states, field) for field in PATH_COLUMNS), states.lowest_points(scenario)]
    )
    head = [*(name for names in PATH_COLUMNS.values() for name in names), *POINT_COLUMNS]
    return sheet(head, [[repr(number) for number in row] for row in rows.tolist()])


def counted(number: int, thing: str) -> str:
    """Return a number with its noun: 1 impact, 2 impacts."""
    return f"{number} {thing}" if number == 1 else f"{number} {thing}s"


def contact_line(toss: Toss) -> str:
    """Return when a toss is in sustained contact, in one line; empty for a toss that never is."""
    contacts = toss.contacts.tolist()
    if not contacts:
        return ""
    start, end = contacts[-1]
    last = f"from {start:.6f} s to {'the end' if end == toss.end_time else f'{end:.6f} s'}"
    if len(contacts) == 1:
        return last
    total = sum(end - start for start, end in contacts)
    return f"{len(contacts)} times, {total:.6f} s in all, the last {last}"


def rest_told(rest: Rest | None, reason: RestReason) -> str:
    """Return where a coin comes to rest, or why it does not."""
    if rest is None:
        return f"none: {in_options(SENTENCES[reason])}"
    x, y, path = np.round([1e3 * rest.x, 1e3 * rest.y, 1e3 * rest.path], 3) + 0.0
    error = "unknown" if rest.error is None else f"about {1e3 * rest.error:.1g} mm"
    return (
        f"at {rest.time:.6f} s: x {x:.3f} mm, y {y:.3f} mm, heading {np.degrees(rest.heading):.2f} deg\n"
        f"          (after a path of {path:.3f} mm from the first touch; error of the place {error})"
    )


def as_lines(toss: Toss, *, whole: bool = False, checked: bool = False) -> str:
    """Return a toss as text for a person.

    Args:
        toss: by either engine.
        whole: whether every impact and contact has its line, and the sequence all its symbols.
        checked: whether it says which errors the engine measured of itself.
    """
    impacts, shown = toss.impacts, with_bar(toss.sequence, toss.trusted_impacts)
    lines = [
        f"engine    {toss.engine}",
        f"outcome   {toss.outcome_told}",
        *([f"          ({CERTAIN})"] if toss.is_certain else []),
        f"ending    {toss.ending}: {in_options(toss.ending.sentence)}",
        f"end       {toss.end_time:.6f} s after {counted(len(impacts), 'impact')}",
        f"sequence  {shown if whole else shortened(shown)}",
        f"trusted   {toss.trust}",
        *([f"          ({_meaning_of_trust(toss)})"] if toss.trusted_impacts else []),
        *([] if toss.rest_reason is None else [f"rest      {rest_told(toss.rest, toss.rest_reason)}"]),
    ]
    if checked and (residuals := _residuals(toss)):
        lines.append(f"checked   largest residuals: {residuals}")
    if toss.outcome in (Outcome.PERPETUAL, Outcome.TRANSIENT):
        energies = [
            f"{item.name}: {1e3 * float(item.value):.4f} mJ" for item in toss.certificate if item.unit == "J"
        ]
        lines += [f"evidence  {'; '.join(energies)}"] if energies else []
    if in_contact := contact_line(toss):
        lines.append(f"contact   {in_contact}")
    if whole and len(toss.contacts) > 1:
        lines += [f"contact   from {start:.6f} s to {end:.6f} s" for start, end in toss.contacts.tolist()]
    if len(impacts):
        lines += ["", "  n      t [s]  up  S_x [mN s]  S_y [mN s]  S_z [mN s]    E [mJ]  rim [deg]"]
    is_long = not whole and len(impacts) > MOST_LINES
    left_out = range(FIRST_LINES, len(impacts) - LAST_LINES) if is_long else range(0)
    angles = np.degrees(np.arctan2(impacts.point[:, 1], impacts.point[:, 0]))
    # What rounds to zero has no sign.
    impulses = np.round(1e3 * impacts.impulse, 5) + 0.0
    rows = [
        f"{i + 1:3d} {impacts.time[i]:10.6f}   {Face(impacts.face[i]).symbol} "
        f"{S[0]:11.5f} {S[1]:11.5f} {S[2]:11.5f} {1e3 * impacts.energy[i]:9.4f} {angles[i]:10.2f}"
        + "".join(f"  {flag.replace('_', ' ')}" for flag in sorted(flags))
        for i, (S, flags) in enumerate(zip(impulses, toss.flags, strict=True))
        if i not in left_out
    ]
    if left_out:
        told = f"... {len(left_out)} impacts between: --all prints them, --json all their numbers"
        rows.insert(FIRST_LINES, told)
    return "\n".join([*lines, *rows])


def _meaning_of_trust(toss: Toss) -> str:
    """Return what it means that impacts are trusted, and what the bar in the sequence is."""
    errors = "rounding errors" if toss.engine == "analytic" else "errors of the steps"
    if toss.trusted_impacts == len(toss.impacts) == 1:
        return f"{errors}, {TRUSTED.replace('these', 'this')} impact"
    bar = "; the | is the horizon of trust" if toss.trusted_impacts < len(toss.impacts) else " impacts"
    return f"{errors}, {TRUSTED}{bar}"


def _residuals(toss: Toss) -> str:
    """Return what a toss measured of itself, of each kind the largest residual, or an empty text."""
    found = {item.name: float(item.value) for item in toss.certificate if item.name in certificate.NAMES}
    of_law, landings = (certificate.LAW, certificate.MOMENTUM), found.get(certificate.LANDINGS, 0.0)
    kinds = (
        ("contact law {:.0e}", of_law),
        (f"{landings:.0f} landings of a second rim {{:.0e}}", (certificate.LANDING,)),
        ("energy {:.0e} m g r", certificate.OF_ENERGY),
        ("|e| {:.0e}", (certificate.NORM,)),
    )
    told = ", ".join(
        text.format(max(found[name] for name in names if name in found))
        for text, names in kinds
        if found.keys() & names
    )
    gap = f"; smallest gap {found[certificate.GAP]:.0e} r" if certificate.GAP in found else ""
    gain = f", an impact gains {found[certificate.GAIN]:.0e} m g r" if certificate.GAIN in found else ""
    return told + gap + gain
