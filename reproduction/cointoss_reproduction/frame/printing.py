"""The result of a run, as text for a terminal."""

import textwrap
from collections.abc import Iterator
from pathlib import Path

from cointoss.study import laid_out
from cointoss_reproduction.frame.claim import MARKS, VERDICTS, Claim
from cointoss_reproduction.frame.pages import verdicts_of
from cointoss_reproduction.frame.result import Result


def page(name: str, result: Result, folder: Path, width: int) -> str:
    """Return the tables and the claims of a run, then how many hold and where the files are.

    Args:
        name: of what was run.
        result: what it found.
        folder: of its files.
        width: of the terminal.
    """
    tables = [laid_out(result.tables, width)] if result.tables else []
    claims = ["\n".join(_claim(claim, width)) for claim in result.claims]
    return "\n\n".join([*tables, *claims, f"{name}: {verdicts_of(result.claims)}\n{folder}"])


def _claim(claim: Claim, width: int) -> Iterator[str]:
    """Yield the lines of a claim: its verdict and what it says, and below what was found."""
    yield from _wrapped(f"{MARKS[claim.holds]} ", f"{VERDICTS[claim.holds]}: {claim.claim}", width)
    found = [("analytic", claim.analytic), ("MuJoCo", claim.mujoco)]
    found += [("measured", f"{each.found} ({each.accepted}: {each.reason})") for each in claim.criteria]
    found += [("open", claim.wanted)] if claim.holds is None else []
    for label, text in found:
        if text != "-":
            yield from _wrapped(f"    {label:10}", text, width)


def _wrapped(label: str, text: str, width: int) -> list[str]:
    """Return the lines of a text behind a label, those that follow indented as far."""
    return textwrap.wrap(text, width, initial_indent=label, subsequent_indent=" " * len(label))
