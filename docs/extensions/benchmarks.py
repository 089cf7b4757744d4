"""Draw the times of commits, docs/benchmarks.svg, from what `make bench KEEP=1` kept."""

import hashlib
import re
from pathlib import Path

import matplotlib as mpl
import pandas as pd
from matplotlib.figure import Figure

from cointoss.compare.output.style import BLUE, GREEN, PURPLE, STYLE, VERMILION

TABLE, PICTURE = "benchmarks.csv", "benchmarks.svg"
SHOWN = {
    "fig24a[by_its_event_loop]": "Fig. 24(a), the event loop",
    "fig24a[by_the_engine]": "Fig. 24(a), `analytic.toss`",
    "many_tosses[one-air0]": "8,192 planar coins, in air",
    "whole_tosses[thick, imperfect, air, coulomb]": "64 general coins, in air",
    "a_process_starts[cointoss toss fig24a, kept]": "a process that tosses, code kept",
    "fig24a[by_heyoka]": "Fig. 24(a), heyoka",
}
"""Benchmarks that are drawn, and what they time."""
COLORS = (BLUE, VERMILION, GREEN, PURPLE)
"""Of machines, in turn."""


def read(docs: Path) -> pd.DataFrame:
    """Return the rows of the table, by the date of their commits."""
    times = pd.read_csv(docs / TABLE, dtype={"commit": str})
    times["date"] = pd.to_datetime(times["date"], utc=True)
    return times.sort_values("date", kind="stable")


def drawn(times: pd.DataFrame) -> Figure:
    """Return a panel for each benchmark: its time over that of the reference, commit by commit."""
    commits = times.drop_duplicates("commit").reset_index(drop=True)
    labels = [
        f"{commit[:7]}  {date:%d %b %y}" for commit, date in zip(commits.commit, commits.date, strict=True)
    ]
    place = pd.Series(commits.index, commits.commit)
    figure = Figure(figsize=(8.6, 5.0))
    panels = figure.subplots(2, 3, sharex=True)
    for panel, (name, about) in zip(panels.flat, SHOWN.items(), strict=True):
        of = times[times.benchmark == name]
        for (machine, rows), color in zip(of.groupby("machine", sort=False), COLORS, strict=False):
            spread = rows.spread / rows.reference
            panel.errorbar(
                rows.commit.map(place), rows.ratio, spread, fmt="o-", color=color, markersize=4, label=machine
            )
        panel.set_title(about.replace("`", ""), fontsize=9.5)
        panel.margins(y=0.15)
        panel.set_ylim(bottom=0)
        panel.set_xticks(range(len(labels)), labels, rotation=90, fontsize=7.5)
    figure.supylabel("processor time / that of the reference", fontsize=9.5)
    if times.machine.nunique() > 1:
        figure.legend(*panels.flat[0].get_legend_handles_labels(), loc="outside lower center")
    return figure


def mark(docs: Path) -> str:
    """Return what the picture of the table carries, so that one knows that it is of this table."""
    return f"sha256:{hashlib.sha256((docs / TABLE).read_bytes()).hexdigest()}"


def draw(docs: Path) -> None:
    """Draw the picture."""
    with mpl.rc_context(STYLE):
        drawn(read(docs)).savefig(docs / PICTURE, metadata={"Date": None, "Identifier": mark(docs)})
    # Matplotlib ends lines with blanks.
    text = (docs / PICTURE).read_text(encoding="utf-8")
    (docs / PICTURE).write_text(re.sub(r" +$", "", text, flags=re.MULTILINE), encoding="utf-8")
