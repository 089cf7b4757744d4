"""All reproduced figures of the paper on one page: in Markdown for the reader, in HTML for the classroom."""

import re
from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import jinja2

from compare.output.files import written_together
from compare.reproduction import runner
from compare.reproduction.findings import Finding, read_findings, table, verdict
from compare.reproduction.runner import Figure

PAGES = ("REPRODUCTION.md", "gallery.html")
_ORDER = ("Table", "Fig", "Section", "Claims")
_INTRODUCTION = """\
# The paper, figure by figure

What J. Strzalko, J. Grabski, A. Stefanski, P. Perlikowski and T. Kapitaniak, "Dynamics of coin tossing is
predictable", Physics Reports 469 (2008) 59-92, shows and says, and what the paper's own mechanics and MuJoCo
give here. One command makes this page, its pictures and a gallery to project; a name in the place of `all`
makes one figure again:

    cointoss reproduce all {quick}--out docs
"""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One figure of the paper, reproduced."""

    name: str
    figure: Figure
    findings: Sequence[Finding]
    picture: Path

    @property
    def in_full(self) -> bool:
        """Whether all claims hold."""
        return all(finding.holds for finding in self.findings)


def of_paper() -> list[str]:
    """Give the names of all figures of the paper, in its order."""
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
    """Read what runs of the figures `names` left in their folders in `out`."""
    return [
        Entry(
            name=name,
            figure=runner.find(name),
            findings=read_findings(out / name),
            picture=out / name / "figure.png",
        )
        for name in names
    ]


def markdown(shown: Sequence[Entry], *, quick: bool) -> str:
    """Give the page of the reader.

    Args:
        shown: the figures.
        quick: whether they were made at their quick size.
    """
    lines = [
        _INTRODUCTION.format(quick="--quick " if quick else ""),
        "| figure | the paper | here | MuJoCo | verdict |",
        "|---|---|---|---|---|",
    ]
    for entry in shown:
        for finding in entry.findings:
            row = (finding.claim, finding.ours, finding.mujoco, verdict(finding))
            lines.append(f"| [{entry.figure.paper}](#{entry.name}) | {' | '.join(row)} |")
    for entry in shown:
        lines += ["", f'## <a id="{entry.name}"></a>{entry.figure.paper}: {entry.figure.title}', ""]
        if entry.figure.assumed:
            lines += [f"Assumed: {entry.figure.assumed}", ""]
        lines += [table(entry.findings), "", f"![{entry.figure.title}]({entry.name}/figure.png)", ""]
        size = " --quick" if quick else ""
        lines += [f"    cointoss reproduce {entry.name}{size} --out docs"]
    return "\n".join(lines) + "\n"


def html(shown: Sequence[Entry]) -> str:
    """Give the gallery, one self-contained page."""
    template = (resources.files("compare.reproduction") / "gallery.html.j2").read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True)
    pictures = {entry.name: b64encode(entry.picture.read_bytes()).decode("ascii") for entry in shown}
    return environment.from_string(template).render(entries=shown, pictures=pictures, verdict=verdict)
