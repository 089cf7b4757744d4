"""Results as pages show them, in Markdown: claims and what was measured; long tables fold."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from pathlib import Path

from cointoss.study import table
from cointoss_reproduction.frame.claim import VERDICTS, Claim
from cointoss_reproduction.frame.files import PAGE
from cointoss_reproduction.frame.result import Reproduction, Result
from cointoss_reproduction.frame.tables import folded, sheets, unfolding

MOST_IN_TITLE = 100
"""The most letters of a claim that a title holds."""
MOST_ROWS = 5
"""The most rows of an open table of measurements; a longer table is folded below a heading."""
_PLURAL = {True: "hold", False: "do not hold", None: "cannot be tested"}


def write(folder: Path, name: str, found: Reproduction, result: Result, *, quick: bool = False) -> None:
    """Write the page of a figure or a study, and its long tables, into its folder."""
    for sheet, text in sheets(result.tables).items():
        (folder / sheet).write_text(text, encoding="utf-8")
    (folder / PAGE).write_text(page_of(name, found, result, quick=quick), encoding="utf-8")


def page_of(name: str, found: Reproduction, result: Result, *, quick: bool = False) -> str:
    """Return the page of a figure or a study, which lies beside its pictures.

    Args:
        name: of the figure or study.
        found: what can be reproduced.
        result: what a run found.
        quick: whether it was made at its quick size.
    """
    return "\n\n".join(
        [
            f"# {found.paper or f'Study {name}'}: {_decided_first(result.claims) or found.title}",
            f"*{found.title[0].upper()}{found.title[1:]}.*",
            *(f"![{found.title}]({picture}.png)" for picture in found.draw),
            *([f"**Assumed.** {found.assumed}"] if found.assumed else []),
            *filter(None, [folded(result.tables)]),
            *_claims(result.claims),
            "One command computes this page again:",
            f"    cointoss reproduce {name} {'--quick ' if quick else ''}--out docs",
            "[All figures and claims](../../REPRODUCTION.md)\n",
        ]
    )


def _claims(claims: Sequence[Claim]) -> Iterator[str]:
    """Yield the claims and their verdicts, each with a heading, and what decides them below it."""
    made, kept = ([claim for claim in claims if claim.regression is flag] for flag in (False, True))
    heads = {
        f"**Claims:** {verdicts_of(made)}.": made,
        "**Regression tests:** written after their numbers, so that a change is seen.": kept,
    }
    for head, group in heads.items():
        if group:
            yield head
            yield from (
                f"## {VERDICTS[claim.holds]}: {_escaped(claim.claim)}\n\n{_measured(claim)}"
                for claim in group
            )


def verdicts_of(claims: Iterable[Claim]) -> str:
    """Return how many of the claims have each of the verdicts, in words; regression tests are none."""
    counted = Counter(claim.holds for claim in claims if not claim.regression)
    words = {kind: VERDICTS[kind] if counted[kind] == 1 else plural for kind, plural in _PLURAL.items()}
    counts = [f"{counted[kind]} {word}" for kind, word in words.items() if counted[kind]]
    *most, last = counts or ["none"]
    return " and ".join(filter(None, [", ".join(most), last]))


def _listed(who: str, what: str) -> str:
    """Return an item of a list, with an item below it for each of several findings."""
    parts = re.split(r"; (?![^(]*\))", what)
    return f"- {who}: {what}" if len(parts) == 1 else "\n  - ".join([f"- {who}:", *parts])


def _decided_first(claims: Iterable[Claim]) -> str:
    """Return the first claim that was decided and is short, as a title has it; empty where there is none.

    Regression tests come last.
    """
    ordered = sorted(claims, key=lambda claim: claim.regression)
    decided = (claim for claim in ordered if claim.holds is not None and len(claim.claim) <= MOST_IN_TITLE)
    first = next(decided, None)
    return "" if first is None else "it does not hold that " * (not first.holds) + _escaped(first.claim)


def _escaped(text: str) -> str:
    return escape(text, quote=False)


def _measured(claim: Claim) -> str:
    """Return what decides a claim; a long table is folded."""
    told = {"Analytic": claim.analytic, "MuJoCo": claim.mujoco, "Open": claim.wanted or "-"}
    words = "\n".join(_listed(who, what) for who, what in told.items() if what != "-")
    rows = [[each.quantity, each.value, each.accepted, each.reason] for each in claim.criteria]
    criteria = table(["measured", "found", "threshold", "its reason"], rows, words=True) if rows else ""
    if len(rows) > MOST_ROWS:
        criteria = unfolding(f"{len(rows)} measured quantities", criteria)
    return "\n\n".join(filter(None, [words, criteria]))
