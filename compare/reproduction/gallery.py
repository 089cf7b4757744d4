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
from compare.reproduction.claim import MARKS, VERDICTS, Claim, criteria_of, read_claims, table_of
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


@dataclass(frozen=True, kw_only=True)
class MainClaim:
    """One of the paper's main claims, with which the page opens."""

    says: str
    """The claim in a sentence."""
    sources: Sequence[tuple[str, str]]
    """Names of what tests it, each with its picture; the first that was reproduced is shown."""
    number: int = 0
    """Which of its headlines, from 0."""


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
# Is coin tossing predictable?

J. Strzalko, J. Grabski, A. Stefanski, P. Perlikowski and T. Kapitaniak, "Dynamics of coin tossing is
predictable", Physics Reports 469 (2008) 59-92, make three main claims. What we find is below each.

{main}

Of {count} claims of the paper, and of papers that it cites, {held} hold, {failed} do not, and {open} cannot
be tested: the paper leaves out what they need, or more tosses would be needed to tell. Measured quantities
and thresholds decide it. What comes from random tosses has its 99 % confidence interval in brackets, and a
threshold inside it decides nothing. One command makes this page, its pictures and a gallery to project; a
name in the place of `all` makes one figure again:

    cointoss reproduce all {quick}--out docs

## All figures and claims
"""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One figure of the paper, reproduced."""

    name: str
    found: Reproduction
    claims: Sequence[Claim]
    picture: Path

    @property
    def verdicts(self) -> dict[bool | None, int]:
        """How many of the claims have each of the verdicts."""
        counted = Counter(claim.holds for claim in self.claims)
        return {kind: counted[kind] for kind in VERDICTS}


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
        (aside / PAGES[0]).write_text(markdown(out, shown, quick=quick), encoding="utf-8")
        (aside / PAGES[1]).write_text(html(out, shown), encoding="utf-8")


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


def markdown(out: Path, shown: Sequence[Entry], *, quick: bool) -> str:
    """Return the page of the reader.

    Args:
        out: folder of all that was reproduced.
        shown: the figures.
        quick: whether they were made at their quick size.
    """
    claims = [claim for entry in shown for claim in entry.claims]
    verdicts = Counter(claim.holds for claim in claims)
    size = "--quick " if quick else ""
    lines = [
        _INTRODUCTION.format(
            main=_main_table(out),
            count=len(claims),
            held=verdicts[True],
            failed=verdicts[False],
            open=verdicts[None],
            quick=size,
        ),
        _contents(shown),
    ]
    for entry in shown:
        title, folder = entry.found.title, runner.folder_of(entry.name, Path())
        lines += ["", f'## <a id="{entry.name}"></a>{entry.found.paper}: {title}', ""]
        if entry.found.assumed:
            lines += [f"Assumed: {entry.found.assumed}", ""]
        lines += [table_of(entry.claims), "", f"![{title}]({folder.as_posix()}/figure.png)", ""]
        lines += [f"    cointoss reproduce {entry.name} {size}--out docs"]
    return "\n".join(lines) + "\n"


def _main_table(out: Path) -> str:
    """Return the main claims side by side, each over its picture and what was found."""
    opened = opening(out)
    pictures = [f"![{main.says}]({picture.relative_to(out).as_posix()})" for main, _, picture in opened]
    heads, found = [f"**{main.says}**" for main, _, _ in opened], [found for _, found, _ in opened]
    return table(heads, [pictures, found], words=True)


def _contents(shown: Sequence[Entry]) -> str:
    """Return the table of all figures, with how many of their claims have which verdict."""
    rows: list[tuple[str, ...]] = []
    for entry in shown:
        numbers = (str(count or "") for count in entry.verdicts.values())
        rows.append((entry.found.paper, f"[{entry.found.title}](#{entry.name})", *numbers))
    rows += [(place, f"{shows}: a sketch", "", "", "") for place, shows in SKETCHES.items()]
    rows.sort(key=lambda row: _place(row[0]))
    return table(["the paper", "what it shows", *VERDICTS.values()], rows, words=True)


def opening(out: Path) -> list[tuple[MainClaim, str, Path]]:
    """Return the main claims of which something was reproduced, with what was found and a picture of it."""
    found = []
    for main in MAIN:
        for name, picture in main.sources:
            folder = runner.folder_of(name, out)
            if (folder / "claims.json").exists() and (folder / picture).exists():
                claims = read_claims(folder / "claims.json")
                headlines = [claim.headline for claim in claims if claim.headline]
                found.append((main, (headlines or _verdicts(claims))[main.number], folder / picture))
                break
    return found


def _verdicts(claims: Sequence[Claim]) -> list[str]:
    """Return the first claims with their verdicts, where none has a headline."""
    parts = [
        f"{claim.claim[0].upper()}{claim.claim[1:]}: {claim.verdict} ({criteria_of(claim, reasons=False)})."
        for claim in claims[:2]
    ]
    return [" ".join(parts)]


def html(out: Path, shown: Sequence[Entry]) -> str:
    """Return the gallery, one self-contained page.

    Args:
        out: folder of all that was reproduced.
        shown: the figures.
    """
    template = (resources.files("compare.reproduction") / "gallery.html.j2").read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
    pictures = {entry.name: _embedded(entry.picture) for entry in shown}
    opened = [(main.says, found, _embedded(picture)) for main, found, picture in opening(out)]
    return environment.from_string(template).render(
        entries=shown, pictures=pictures, kinds=_KINDS, marks=MARKS, words=VERDICTS, opened=opened
    )


def _embedded(picture: Path) -> str:
    """Return a picture in base 64."""
    return b64encode(picture.read_bytes()).decode("ascii")
