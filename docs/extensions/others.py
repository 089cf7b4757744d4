"""The picture and the tables of docs/OTHER_ENGINES.md, from the cards beside the adapters."""

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure

from cointoss.study import GREY, PALE, STYLE, table
from cointoss_reproduction.frame.tables import unfolding
from cointoss_yardstick.suite.case import cases

PICTURE = "other_engines.png"
ADAPTERS = "yardstick/adapters"
LEVELS = (0.0, 0.01, 0.1, 1.0)
"""Errors at which the colour changes; the last is for all above."""
COLORS = ("#cfe8dc", "#fff3c9", "#fbd9b4", "#f4b6a6")
NONE = {"status": "not measured", "error": None, "order": None, "runs": []}
"""What a card has of a case that is younger."""
NEAR = 0.01
"""The error whose processor time is shown."""
TIMED = "tilted"
"""The case that is timed."""
KNOWN = {case.name: case for case in cases()}
SHEET = {
    "e = 1": ("flat_1", lambda case: case["found"][0]),
    "height, 1": ("ten_bounces_1", lambda case: case["found"][0]),
    "height, 0.8": ("ten_bounces_80", lambda case: case["found"][0] / KNOWN["ten_bounces_80"].right[0]),
    "ten touches": ("energy", lambda case: math.exp(10 * case["found"][0])),
    "rest": ("rest", lambda case: 1e3 * case["found"][0]),
    "slides": ("coulomb_slip", lambda case: case["found"][1] / case["found"][2] / 0.15),
    "sticks": ("coulomb_stick", lambda case: case["found"][1] / KNOWN["coulomb_stick"].right[1]),
    "spin": ("spin_kept", lambda case: case["found"][-1] / 1000),
    "gap": ("flat_50", lambda case: math.nan if case.get("height") is None else 1e3 * case["height"]),
    "wobble": ("precession", lambda case: case["error"]),
}
"""The columns of the table of engines: the case, and the number of what came of it."""


def cards(adapters: Path) -> list[dict[str, Any]]:
    """Return the cards of all engines, in the order of their names."""
    found = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(adapters.glob("*/*.json"))]
    return sorted(found, key=lambda card: card["engine"].lower())


def blocks(docs: Path) -> dict[str, str]:
    """Return the tables by the names of their files."""
    known = cards(docs.parent / ADAPTERS)
    return {
        "errors": errors(known),
        "orders": orders(known),
        "settings": settings(known),
        "sheet": sheet(known),
        "findings": findings(docs.parent / ADAPTERS),
    }


def findings(adapters: Path) -> str:
    """Return what was found in each engine, as its adapter's findings.md has it, folded below its title.

    Its scripts run in the engine's environment, and not as those of a page.
    """
    pages = (
        re.sub(r"^```\w+$", "```py", path.read_text(encoding="utf-8"), flags=re.MULTILINE).partition("\n")
        for path in sorted(adapters.glob("*/findings.md"))
    )
    return "\n\n".join(unfolding(title.removeprefix("# "), text.strip()) for title, _, text in pages)


def errors(known: list[dict[str, Any]]) -> str:
    """Return each engine's error in each case, at its own step."""
    rows = [
        [case.title, *(shown(of_case(card, case.name)) for card in known), f"{case.tolerance['stepping']:g}"]
        for case in cases()
    ]
    return table(["case", *(card["engine"] for card in known), "limit"], rows, words=True)


def orders(known: list[dict[str, Any]]) -> str:
    """Return for each engine its step, the cases it meets, orders, and the processor time for 1 %."""
    rows = [
        [
            card["engine"],
            f"{1e3 * card['dt']:.3g} ms",
            f"{sum(case['status'] == 'met' for case in card['cases'])} of "
            f"{sum(case['status'] != 'not realisable' for case in card['cases'])}",
            *(
                "–" if found["order"] is None else f"{found['order']:.1f}"
                for found in (of_case(card, name) for name in ("parabola", TIMED, "touch_spin"))
            ),
            cost(card),
        ]
        for card in known
    ]
    heads = (
        "engine | own step | met, of those it can do | order: fall | order: rim | order: spin | time for 1 %"
    )
    return table(heads, rows, words=True)


def settings(known: list[dict[str, Any]]) -> str:
    """Return the settings of each engine, and the causes that its card names."""
    rows = [
        [
            card["engine"],
            ", ".join(f"{name} = {value}" for name, value in card["settings"].items()),
            "; ".join(card.get("hints", ())) or "–",
        ]
        for card in known
    ]
    return table("engine | settings | likely", rows, words=True)


def sheet(known: list[dict[str, Any]]) -> str:
    """Return what each engine does at a touch, at rest and in flight, by version and date."""
    rows = [
        [card["engine"], card["date"], *(_number(of_case(card, case), of) for case, of in SHEET.values())]
        for card in known
    ]
    return table(["engine", "measured", *SHEET], rows)


def _number(case: dict[str, Any], of: Callable[[dict[str, Any]], float]) -> str:
    return shown(case) if case["error"] is None else f"{of(case):.3g}".replace("nan", "")


def of_case(card: dict[str, Any], name: str) -> dict[str, Any]:
    """Return what came of a case; of one that is younger than the card, nothing."""
    return next((case for case in card["cases"] if case["name"] == name), NONE)


def shown(case: dict[str, Any]) -> str:
    """Return the error of a case, with an arrow where the height is off, or why there is none."""
    if case["error"] is None:
        return {"failed": "failed", "not measured": ""}.get(case["status"], "–")
    height = case.get("height") or 0.0
    return f"{case['error']:.1g}{'↓' * (height < 0)}{'↑' * (height > 0)}"


def cost(card: dict[str, Any]) -> str:
    """Return the least processor time of a simulated second in which the rim's rebound is 1 % off at most."""
    near = [
        run[2] / KNOWN[TIMED].until
        for run in of_case(card, TIMED)["runs"]
        if run[1] is not None and run[1] <= NEAR
    ]
    return f"{min(near):.2g} s" if near else "not reached"


def draw(docs: Path) -> None:
    """Draw the errors of all engines in all cases, at their own steps."""
    known = cards(docs.parent / ADAPTERS)
    with mpl.rc_context(STYLE):
        drawn(known).savefig(docs / PICTURE, dpi=110, metadata={"Software": None})


def drawn(known: list[dict[str, Any]]) -> Figure:
    """Return a table of errors, an engine a row, coloured by their size."""
    names = [case.name for case in cases()]
    found = np.array([[_size(of_case(card, name)) for name in names] for card in known])
    figure = Figure(figsize=(0.42 * len(names) + 3.2, 0.34 * len(known) + 1.9))
    axes = figure.add_subplot()
    levels = BoundaryNorm([*LEVELS, math.inf], len(COLORS))
    axes.imshow(found, cmap=ListedColormap(COLORS), norm=levels, aspect="auto")
    for i, card in enumerate(known):
        for k, name in enumerate(names):
            text = shown(of_case(card, name)).replace("failed", "×")
            axes.text(
                k, i, text, ha="center", va="center", fontsize=6.5, color=PALE if text == "–" else "black"
            )
    axes.set_xticks(range(len(names)), [name.replace("_", " ") for name in names], rotation=60, ha="right")
    axes.set_yticks(range(len(known)), [card["engine"] for card in known])
    axes.tick_params(length=0, colors=GREY)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)
    return figure


def _size(case: dict[str, Any]) -> float:
    if case["status"] == "failed":
        return 10 * LEVELS[-1]
    return math.nan if case["error"] is None else case["error"]
