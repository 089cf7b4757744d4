"""Results as pages show them, in Markdown: claims and what was measured; long tables fold."""

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path

from cointoss.study import folded, sheets, table, unfolding, write_text
from cointoss_reproduction.frame.claim import VERDICTS, Claim
from cointoss_reproduction.frame.files import PAGE, folder_of
from cointoss_reproduction.frame.result import Reproduction, Result

MOST_IN_TITLE = 100
"""Letters of a claim that a title holds."""
MOST_ROWS = 5
"""Of a table of what was measured; a longer one is folded below a heading."""
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
            f"# {found.paper}: {_decided_first(result.claims) or found.title}",
            f"*{found.title[0].upper()}{found.title[1:]}.*",
            *(f"![{found.title}]({picture}.png)" for picture in found.draw),
            *([f"**Assumed.** {found.assumed}"] if found.assumed else []),
            claims_of(result.claims, are_apart=True),
            "One command computes this page again:",
            f"    cointoss reproduce {name} {'--quick ' if quick else ''}--out docs",
            "[All figures and claims](../../REPRODUCTION.md)\n",
        ]
    )


def block_of(name: str, result: Result) -> str:
    """Return what a page in the folder of all that is reproduced shows of a study."""
    tables = folded(result.tables, folder_of(name, Path()).as_posix())
    return "\n\n".join([*filter(None, [tables]), claims_of(result.claims, are_apart=False)])


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


def claims_of(claims: Sequence[Claim], *, are_apart: bool) -> str:
    """Return the claims and their verdicts, with what decides them.

    Args:
        claims: of one figure or study.
        are_apart: whether each has a heading, and what decides it below; else all that folds together.
    """
    made, kept = ([claim for claim in claims if claim.regression is flag] for flag in (False, True))
    heads = {
        f"**Claims:** {verdicts_of(made)}.": made,
        "**Regression tests:** written after their numbers, so that a change is seen.": kept,
    }
    shown = {head: group for head, group in heads.items() if group}
    parts = []
    for head, group in shown.items():
        if are_apart:
            parts.append(head)
            parts += [f"## {_sentence(one)}\n\n{_measured(one, is_folded=False)}" for one in group]
        else:
            parts += [head, "\n".join(f"- {_sentence(one)}" for one in group)]
    measured = [f"**{_sentence(one)}**\n\n{_measured(one, is_folded=True)}" for one in (*made, *kept)]
    return "\n\n".join(parts if are_apart else [*parts, unfolding("What was measured", *measured)])


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


def _sentence(claim: Claim) -> str:
    return f"{VERDICTS[claim.holds]}: {_escaped(claim.claim)}"


def _escaped(text: str) -> str:
    return escape(text, quote=False)


def _measured(claim: Claim, *, is_folded: bool) -> str:
    """Return what decides a claim, a long table being folded unless all of it `is_folded`."""
    told = {"Analytic": claim.analytic, "MuJoCo": claim.mujoco, "Open": claim.wanted or "-"}
    words = "\n".join(_listed(who, what) for who, what in told.items() if what != "-")
    rows = [[each.quantity, each.value, each.accepted, each.reason] for each in claim.criteria]
    criteria = table(["measured", "found", "threshold", "its reason"], rows, words=True) if rows else ""
    if len(rows) > MOST_ROWS and not is_folded:
        criteria = unfolding(f"{len(rows)} measured quantities", criteria)
    return "\n\n".join(filter(None, [words, criteria]))
