"""Draw the times of commits and write the table of SPEED, from what `make bench KEEP=1` kept."""

import csv
import hashlib
import re
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from places import fill

from cointoss.compare.output.style import BLUE, GREEN, PURPLE, STYLE, VERMILION
from cointoss.compare.output.tables import table

PAGE, TABLE, PICTURE = "SPEED.md", "benchmarks.csv", "benchmarks.svg"
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
Row = dict[str, str]


def read(docs: Path) -> list[Row]:
    """Return the rows of the table, by the date of their commits."""
    with (docs / TABLE).open(encoding="utf-8", newline="") as file:
        return sorted(csv.DictReader(file), key=lambda row: datetime.fromisoformat(row["date"]))


def drawn(rows: Sequence[Row]) -> Figure:
    """Return a panel for each benchmark: its time over that of the reference, commit by commit."""
    commits = list(dict.fromkeys(row["commit"] for row in rows))
    dates = {row["commit"]: datetime.fromisoformat(row["date"]) for row in rows}
    machines = list(dict.fromkeys(row["machine"] for row in rows))
    figure = Figure(figsize=(8.6, 5.0))
    panels = figure.subplots(2, 3, sharex=True)
    for panel, (name, about) in zip(panels.flat, SHOWN.items(), strict=True):
        panel.set_title(about.replace("`", ""), fontsize=9.5)
        for machine, color in zip(machines, COLORS, strict=False):
            found = [row for row in rows if (row["benchmark"], row["machine"]) == (name, machine)]
            places = [commits.index(row["commit"]) for row in found]
            ratios = np.array([float(row["ratio"]) for row in found])
            spreads = [float(row["spread"]) / float(row["reference"]) for row in found]
            panel.errorbar(places, ratios, spreads, fmt="o-", color=color, markersize=4, label=machine)
        panel.margins(y=0.15)
        panel.set_ylim(bottom=0)
        panel.set_xlim(-0.5, len(commits) - 0.5)
        panel.set_xticks(
            range(len(commits)),
            [f"{commit[:7]}  {dates[commit]:%d %b %y}" for commit in commits],
            rotation=90,
            fontsize=7.5,
        )
    figure.supylabel("processor time / that of the reference", fontsize=9.5)
    if len(machines) > 1:
        figure.legend(*panels.flat[0].get_legend_handles_labels(), loc="outside lower center")
    return figure


def newest(rows: Sequence[Row]) -> str:
    """Return the table of the last commit that was timed."""
    of = [
        row for row in rows if row["commit"] == rows[-1]["commit"] and row["machine"] == rows[-1]["machine"]
    ]
    by_name = {row["benchmark"]: row for row in of}
    cells = [
        [about, _time(row["seconds"]), f"± {_time(row['spread'])}", row["rounds"], row["ratio"]]
        for name, about in SHOWN.items()
        if (row := by_name.get(name))
    ]
    found = table("benchmark | best round | spread | rounds | ratio", cells)
    told = f"Commit {rows[-1]['commit'][:7]} of {rows[-1]['date'][:10]}, on {rows[-1]['machine']}"
    return f"<details>\n<summary>{told}</summary>\n\n{found}\n\n</details>"


def _time(seconds: str) -> str:
    """Return a time in the unit in which it has one to three digits before its point."""
    value = float(seconds)
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if value >= size:
            return f"{value / size:.3g} {unit}"
    return f"{value / 1e-6:.3g} µs"


def mark(docs: Path) -> str:
    """Return what the picture of the table carries, so that one knows that it is of this table."""
    return f"sha256:{hashlib.sha256((docs / TABLE).read_bytes()).hexdigest()}"


def write(docs: Path) -> None:
    """Draw the picture, and write the table into its place on the page."""
    rows = read(docs)
    with mpl.rc_context(STYLE):
        drawn(rows).savefig(docs / PICTURE, metadata={"Date": None, "Identifier": mark(docs)})
    # Matplotlib ends lines with blanks.
    text = (docs / PICTURE).read_text(encoding="utf-8")
    (docs / PICTURE).write_text(re.sub(r" +$", "", text, flags=re.MULTILINE), encoding="utf-8")
    fill(docs / PAGE, {"benchmarks": newest(rows)})
