"""Results as pages show them, in Markdown: each claim unfolds to its numbers, long tables fold."""

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path

from cointoss.study import folded, sheets, table, unfolding, write_text
from cointoss_reproduction.frame.claim import VERDICTS, Claim
from cointoss_reproduction.frame.files import PAGE, folder_of
from cointoss_reproduction.frame.result import Reproduction, Result

_PLURAL = {True: "hold", False: "do not hold", None: "cannot be tested"}


def write(folder: Path, name: str, found: Reproduction, result: Result, *, quick: bool = False) -> None:
    """Write the page of a figure of the paper, and the long tables of every result, into its folder."""
    for sheet, text in sheets(result.tables).items():
        (folder / sheet).write_text(text, encoding="utf-8")
    if found.paper:
        (folder / PAGE).write_text(page_of(name, found, result, quick=quick), encoding="utf-8")


def page_of(name: str, found: Reproduction, result: Result, *, quick: bool = False) -> str:
    """Return the page of a figure of the paper, which lies beside its pictures.

    Args:
        name: of the figure.
        found: what can be reproduced.
        result: what a run found.
        quick: whether it was made at its quick size.
    """
    return "\n\n".join(
        [
            f"# {found.paper}",
            f"*{found.title[0].upper()}{found.title[1:]}.*",
            *(f"![{found.title}]({picture}.png)" for picture in found.draw),
            *([f"**Assumed.** {found.assumed}"] if found.assumed else []),
            claims_of(result.claims),
            "One command computes this page again:",
            f"    cointoss reproduce {name} {'--quick ' if quick else ''}--out docs",
            "[All figures and claims](../../REPRODUCTION.md)\n",
        ]
    )


def block_of(name: str, result: Result) -> str:
    """Return what a page in the folder of all that is reproduced shows of a study."""
    tables = folded(result.tables, folder_of(name, Path()).as_posix())
    return "\n\n".join([*filter(None, [tables]), claims_of(result.claims)])


def write_blocks(out: Path, name: str, result: Result) -> None:
    """Write a study's results into the pages in `out` that have a place for them.

    Raises:
        UnwritableError: naming the page and why.
    """
    place = rf"(<!-- written by: cointoss reproduce {name} -->\n).*?(\n<!-- end -->\n)"
    block = f"\n{block_of(name, result)}\n"
    for path in sorted(out.glob("*.md")):
        page = path.read_text(encoding="utf-8")
        written = re.sub(place, lambda found: found[1] + block + found[2], page, flags=re.DOTALL)
        if written != page:
            write_text(path, written)


def claims_of(claims: Sequence[Claim]) -> str:
    """Return the claims and their verdicts, each unfolding to what decides it."""
    made, kept = ([claim for claim in claims if claim.regression is flag] for flag in (False, True))
    counted = [f"**Claims:** {verdicts_of(made)}."] if made else []
    named = ["**Regression tests:** written after their numbers, so that a change is seen."] if kept else []
    return "\n\n".join([*counted, *map(_unfolding, made), *named, *map(_unfolding, kept)])


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


def _unfolding(claim: Claim) -> str:
    told = {"Analytic": claim.analytic, "MuJoCo": claim.mujoco, "Open": claim.wanted or "-"}
    words = "\n".join(_listed(who, what) for who, what in told.items() if what != "-")
    rows = [[each.quantity, each.value, each.accepted, each.reason] for each in claim.criteria]
    criteria = table(["measured", "found", "threshold", "its reason"], rows, words=True) if rows else ""
    summary = f"<b>{VERDICTS[claim.holds]}:</b> {escape(claim.claim, quote=False)}"
    return unfolding(summary, *filter(None, [words, criteria]))
