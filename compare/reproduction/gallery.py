"""All reproduced figures of the paper on one page: in Markdown for the reader, in HTML for the classroom."""

import re
from base64 import b64encode
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import jinja2

from compare.output.files import written_together
from compare.output.tables import table
from compare.reproduction import runner
from compare.reproduction.claim import Claim, criteria_of, read_claims, table_of
from compare.reproduction.runner import Reproduction

PAGES = ("REPRODUCTION.md", "gallery.html")
_ORDER = ("Table", "Fig", "Section", "Claims")
SKETCHES = {
    "Fig. 1": "Keller's coin and its axis",
    "Figs 8-11": "the coin, its frames and its rotations",
    "Fig. 16": "the velocities at an impact",
}
"""Figures that show definitions: there is nothing to reproduce."""
_KINDS = {True: "holds", False: "fails", None: "open"}
"""The classes of the verdicts in the gallery."""
_INTRODUCTION = """\
# The paper, figure by figure

Does the paper hold? Of {count} claims of J. Strzalko, J. Grabski, A. Stefanski, P. Perlikowski and
T. Kapitaniak, "Dynamics of coin tossing is predictable", Physics Reports 469 (2008) 59-92, and of papers
that it cites, {held} hold, {failed} do not, and {open} cannot be tested: the paper leaves out what they need,
or more tosses would be needed to tell. Measured quantities and thresholds decide it, and are listed with each
claim. What comes from random tosses has its 99 % confidence interval in brackets, and a threshold inside it
decides nothing. Sketches make no claim: {sketches}. One command makes this page, its pictures and a gallery
to project; a name in the place of `all` makes one figure again:

    cointoss reproduce all {quick}--out docs
"""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One figure of the paper, reproduced."""

    name: str
    found: Reproduction
    claims: Sequence[Claim]
    picture: Path

    @property
    def holds(self) -> bool | None:
        """Whether all claims hold; None where none fails but one cannot be tested."""
        found = {claim.holds for claim in self.claims}
        return False if False in found else None if None in found else True


def of_paper() -> list[str]:
    """Return the names of all figures of the paper, in its order."""
    places = {name: runner.find(name).paper for name in runner.names()}
    return sorted((name for name, place in places.items() if place), key=lambda name: _place(places[name]))


def _place(paper: str) -> tuple[int, list[int], str]:
    first = next((i for i, word in enumerate(_ORDER) if paper.startswith(word)), len(_ORDER))
    return first, [int(number) for number in re.findall(r"\d+", paper)], paper


def write(out: Path, names: Sequence[str], *, quick: bool) -> None:
    """Write `PAGES` over the figures `names` into the folder `out`; both or none.

    Raises:
        UnwritableError: naming the folder and why.
    """
    shown = entries(out, names)
    with written_together(out, PAGES) as aside:
        (aside / PAGES[0]).write_text(markdown(shown, quick=quick), encoding="utf-8")
        (aside / PAGES[1]).write_text(html(shown), encoding="utf-8")


def entries(out: Path, names: Sequence[str]) -> list[Entry]:
    """Return what runs of the figures `names` left in their folders below `out`."""
    return [
        Entry(
            name=name,
            found=runner.find(name),
            claims=read_claims(runner.folder_of(name, out) / "claims.json"),
            picture=runner.folder_of(name, out) / "figure.png",
        )
        for name in names
    ]


def markdown(shown: Sequence[Entry], *, quick: bool) -> str:
    """Return the page of the reader.

    Args:
        shown: the figures.
        quick: whether they were made at their quick size.
    """
    claims = [claim for entry in shown for claim in entry.claims]
    verdicts = Counter(claim.holds for claim in claims)
    size = "--quick " if quick else ""
    lines = [
        _INTRODUCTION.format(
            count=len(claims),
            held=verdicts[True],
            failed=verdicts[False],
            open=verdicts[None],
            sketches=", ".join(f"{place} ({shows})" for place, shows in SKETCHES.items()),
            quick=size,
        ),
        table(
            ["figure", "the paper", "measured (threshold)", "verdict"],
            [
                (
                    f"[{entry.found.paper}](#{entry.name})",
                    claim.claim,
                    criteria_of(claim, reasons=False),
                    claim.verdict,
                )
                for entry in shown
                for claim in entry.claims
            ],
            words=True,
        ),
    ]
    for entry in shown:
        title, folder = entry.found.title, runner.folder_of(entry.name, Path())
        lines += ["", f'## <a id="{entry.name}"></a>{entry.found.paper}: {title}', ""]
        if entry.found.assumed:
            lines += [f"Assumed: {entry.found.assumed}", ""]
        lines += [table_of(entry.claims), "", f"![{title}]({folder.as_posix()}/figure.png)", ""]
        lines += [f"    cointoss reproduce {entry.name} {size}--out docs"]
    return "\n".join(lines) + "\n"


def html(shown: Sequence[Entry]) -> str:
    """Return the gallery, one self-contained page."""
    template = (resources.files("compare.reproduction") / "gallery.html.j2").read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
    pictures = {entry.name: b64encode(entry.picture.read_bytes()).decode("ascii") for entry in shown}
    return environment.from_string(template).render(entries=shown, pictures=pictures, kinds=_KINDS)
