"""All reproduced figures of the paper: a table of verdicts for the reader, one page for the classroom."""

import re
from base64 import b64encode
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import jinja2

from cointoss.study import sheet, table, written_together
from cointoss_reproduction.frame import runner
from cointoss_reproduction.frame.claim import MARKS, VERDICTS, Claim, criteria_of, read_claims
from cointoss_reproduction.frame.files import CLAIMS, PAGE
from cointoss_reproduction.frame.pages import verdicts_of
from cointoss_reproduction.frame.result import Reproduction

PAGES = ("REPRODUCTION.md", "claims.csv", "gallery.html")
_ORDER = ("Table", "Fig", "Section", "Claims")
SKETCHES = {
    "Fig. 1": "Keller's coin and its axis",
    "Figs 8-11": "the coin, its frames and its rotations",
    "Fig. 16": "the velocities at an impact",
}
"""Figures that show definitions: there is nothing to reproduce."""
_KINDS = {True: "holds", False: "fails", None: "open"}
"""The classes of the verdicts in the gallery."""


@dataclass(frozen=True, kw_only=True)
class MainClaim:
    """One of the paper's main claims, with which the page opens."""

    says: str
    """The claim in a sentence."""
    sources: Sequence[tuple[str, str]]
    """Names of the figures or studies that test the claim, each with its picture; the first that was
    reproduced is shown."""
    number: int = 0
    """The number of the headline among those of that test, from 0."""


MAIN = (
    MainClaim(
        says="The boundaries between heads and tails are smooth: some accuracy makes any toss predictable.",
        sources=(("predictability", "predictability.png"), ("fig30", "figure.png")),
    ),
    MainClaim(
        says="If a release's error ε is far below the width W of the stripes, the outcome is predictable.",
        sources=(("accuracy-and-stripes", "below-the-width.png"),),
    ),
    MainClaim(
        says="If ε is far above W, heads and tails are as likely: the toss is left to chance.",
        sources=(("accuracy-and-stripes", "above-the-width.png"),),
        number=1,
    ),
)
_INTRODUCTION = """\
# What holds of the paper

*Do the figures and claims of "Dynamics of coin tossing is predictable" hold when they are computed again?*

Of {count} claims of the paper, and of papers that it cites, {verdicts}. Do not read the
count of verdicts as a score: it depends on how claims are divided. The main claims, and what we find:

{main}

![{pictured}]({picture})

- **A claim holds** if every measured quantity meets its threshold. Brackets are 99 % confidence intervals; a
  threshold inside one decides nothing. Regression tests are written after their numbers, and not counted.
- **A claim cannot be tested** if the paper's text leaves out what the test needs, or if more tosses are
  needed. We did not see the pictures.
- **Weak** are the verdicts on Figs 24, 27 and 28, where we had to choose coin, floor or method.

The paper is by Strzalko, Grabski, Stefanski, Perlikowski and Kapitaniak, Physics Reports 469 (2008) 59-92.
One command computes all figures again:

    cointoss reproduce all {quick}--out docs

## Verdicts

Each row links to the figure, its claims and what was measured. [A CSV file](claims.csv) has all claims.

"""


@dataclass(frozen=True, kw_only=True)
class GalleryEntry:
    """One figure of the paper, reproduced."""

    name: str
    found: Reproduction
    claims: Sequence[Claim]
    picture: Path

    @property
    def verdicts(self) -> dict[bool | None, int]:
        """How many of the claims have each of the verdicts."""
        counted = Counter(claim.holds for claim in self.claims if not claim.regression)
        return {kind: counted[kind] for kind in VERDICTS}


def of_paper() -> list[str]:
    """Return the names of all figures of the paper, in its order."""
    places = {name: runner.told(name).get("paper", "") for name in runner.names()}
    return sorted(filter(places.get, places), key=lambda name: _place(places[name]))


def _place(paper: str) -> tuple[int, list[int], str]:
    first = next((i for i, word in enumerate(_ORDER) if paper.startswith(word)), len(_ORDER))
    return first, [int(number) for number in re.findall(r"\d+", paper)], paper


def write(out: Path, names: Sequence[str], *, quick: bool) -> None:
    """Write `PAGES` over the figures `names` into the folder `out`; all or none.

    Raises:
        UnwritableError: naming the folder and why.
    """
    shown = entries(out, names)
    texts = (markdown(out, shown, quick=quick), claims_sheet(shown), html(out, shown))
    with written_together(out, PAGES) as aside:
        for page, text in zip(PAGES, texts, strict=True):
            (aside / page).write_text(text, encoding="utf-8")


def entries(out: Path, names: Sequence[str]) -> list[GalleryEntry]:
    """Return what runs of the figures `names` left in their folders below `out`."""
    return [
        GalleryEntry(
            name=name,
            found=runner.find(name),
            claims=read_claims(runner.folder_of(name, out) / CLAIMS),
            picture=runner.folder_of(name, out) / "figure.png",
        )
        for name in names
    ]


def markdown(out: Path, shown: Sequence[GalleryEntry], *, quick: bool) -> str:
    """Return the page of the reader.

    Args:
        out: folder of all that was reproduced.
        shown: the figures.
        quick: whether they were made at their quick size.
    """
    opened = opening(out)
    main = (f"- **{one.says}** {found}" for one, found, _ in opened)
    sketches = "; ".join(f"{place}, {shows}" for place, shows in SKETCHES.items())
    rows = [
        (
            entry.found.paper,
            f"[{entry.found.title}]({(runner.folder_of(entry.name, Path()) / PAGE).as_posix()})",
            verdicts_of(entry.claims),
        )
        for entry in shown
    ]
    return (
        _INTRODUCTION.format(
            count=sum(sum(entry.verdicts.values()) for entry in shown),
            verdicts=verdicts_of(claim for entry in shown for claim in entry.claims),
            main="\n".join(main),
            pictured=opened[0][0].says,
            picture=opened[0][2].relative_to(out).as_posix(),
            quick="--quick " if quick else "",
        )
        + table(["the paper", "what it shows", "its claims"], [*rows], words=True)
        + f"\n\nNot computed, because each sketches a definition: {sketches}.\n"
    )


def claims_sheet(shown: Sequence[GalleryEntry]) -> str:
    """Return all claims as comma-separated values, a row for each criterion."""
    head = [
        "name",
        "paper",
        "claim",
        "claimed",
        "verdict",
        "measured",
        "value",
        "low",
        "high",
        "relation",
        "threshold",
        "reason",
    ]
    rows = [
        (entry.name, entry.found.paper, claim.claim, claimed, VERDICTS[claim.holds], *criterion)
        for entry in shown
        for claim in entry.claims
        for claimed in ("no" if claim.regression else "yes",)
        for criterion in [each.row for each in claim.criteria] or [("", "", "", "", "", "", claim.missing)]
    ]
    return sheet(head, rows)


def opening(out: Path) -> list[tuple[MainClaim, str, Path]]:
    """Return the main claims of which something was reproduced, with what was found and a picture of it."""
    found = []
    for main in MAIN:
        for name, picture in main.sources:
            folder = runner.folder_of(name, out)
            if (folder / CLAIMS).exists() and (folder / picture).exists():
                claims = read_claims(folder / CLAIMS)
                headlines = [claim.headline for claim in claims if claim.headline]
                found.append((main, (headlines or _verdicts(claims))[main.number], folder / picture))
                break
    return found


def _verdicts(claims: Sequence[Claim]) -> list[str]:
    """Return the first claims with their verdicts, where none has a headline."""
    parts = [
        f"{claim.claim[0].upper()}{claim.claim[1:]}: {claim.verdict} ({criteria_of(claim)})."
        for claim in claims[:2]
    ]
    return [" ".join(parts)]


def html(out: Path, shown: Sequence[GalleryEntry]) -> str:
    """Return the gallery, one self-contained page.

    Args:
        out: folder of all that was reproduced.
        shown: the figures.
    """
    template = (resources.files(__name__.rpartition(".")[0]) / "gallery.html.j2").read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
    pictures = {entry.name: _embedded(entry.picture) for entry in shown}
    opened = [(main.says, found, _embedded(picture)) for main, found, picture in opening(out)]
    return environment.from_string(template).render(
        entries=shown, pictures=pictures, kinds=_KINDS, marks=MARKS, words=VERDICTS, opened=opened
    )


def _embedded(picture: Path) -> str:
    """Return a picture in base 64."""
    return b64encode(picture.read_bytes()).decode("ascii")
