"""What the paper claims and what both engines find: the shape of every reproduced figure of the paper."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure as Picture
from numpy.typing import NDArray
from PIL import Image

from compare.output.style import STYLE
from compare.reproduction.runner import Figure, Made, Progress

FILES = ("findings.json", "data.npz", "figure.png")
"""What every figure of the paper leaves."""
_COLORS = 128


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One claim of the paper beside the numbers of both engines."""

    claim: str
    """What the paper shows or says."""
    ours: str
    """What the paper's mechanics gives here."""
    mujoco: str = "-"
    """What MuJoCo gives, or how far it is from ours; "-" where it has nothing to say."""
    holds: bool | np.bool_
    """Whether the numbers bear the claim out."""
    expected: bool = True
    """Whether they are known to; a claim of the paper that fails is known not to."""


@dataclass(frozen=True, kw_only=True)
class Result:
    """A reproduced figure of the paper."""

    findings: Sequence[Finding]
    draw: Callable[[], Picture]
    """Draws it."""
    data: Mapping[str, NDArray[Any]]
    """The numbers of the picture, by name."""


def paper_figure(
    *,
    paper: str,
    title: str,
    assumed: str,
    seconds: float,
    make: Callable[[Progress], Result],
    quick_seconds: float | None = None,
    quick: Callable[[Progress], Result] | None = None,
) -> Figure:
    """Describe a figure of the paper that can be reproduced.

    Args:
        paper: its place there, as in "Fig. 3".
        title: what it shows, in a few words.
        assumed: what the paper leaves unsaid, and what is taken here; empty where it says all.
        seconds: roughly how long it takes on two cores [s].
        make: computes it.
        quick_seconds: roughly how long its quick size takes, by default as long [s].
        quick: computes that, by default the same.
    """
    return Figure(
        title=title,
        seconds=seconds,
        files=FILES,
        run=lambda folder, progress: _saved(folder, make(progress)),
        quick=lambda folder, progress: _saved(folder, (quick or make)(progress)),
        quick_seconds=seconds if quick_seconds is None else quick_seconds,
        paper=paper,
        assumed=assumed,
    )


def _saved(folder: Path, result: Result) -> Made:
    listed = [asdict(finding) for finding in result.findings]
    (folder / "findings.json").write_text(
        # What NumPy compares is of its own type.
        json.dumps(listed, indent=1, ensure_ascii=False, default=bool) + "\n",
        encoding="utf-8",
    )
    np.savez_compressed(folder / "data.npz", allow_pickle=False, **result.data)
    with mpl.rc_context(STYLE):
        result.draw().savefig(folder / "figure.png", dpi=110)
    # A map's fine stripes would make a large file in full colour.
    with Image.open(folder / "figure.png") as drawn:
        few = drawn.convert("RGB").quantize(_COLORS)
    few.save(folder / "figure.png", optimize=True)
    return Made(text=table(result.findings), failed=failed(result.findings))


def read_findings(folder: Path) -> tuple[Finding, ...]:
    """Read the findings that a run left in its folder."""
    return tuple(Finding(**one) for one in json.loads((folder / "findings.json").read_text(encoding="utf-8")))


def failed(findings: Sequence[Finding]) -> tuple[str, ...]:
    """Give the claims whose verdict is not the known one."""
    return tuple(finding.claim for finding in findings if finding.holds != finding.expected)


def verdict(finding: Finding) -> str:
    """Give the verdict on a claim in words."""
    return "holds" if finding.holds else "does not hold"


def table(findings: Sequence[Finding]) -> str:
    """Give the findings as a table, in Markdown."""
    rows = [f"| {f.claim} | {f.ours} | {f.mujoco} | {verdict(f)} |" for f in findings]
    return "\n".join(["| the paper | here | MuJoCo | verdict |", "|---|---|---|---|", *rows])
